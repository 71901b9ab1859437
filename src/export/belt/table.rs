//! A machine's answer as text to read, and as rows of comma-separated values.

use super::document::PhysicalOutcome;
use super::{Answer, PLACES, alarm, quantities};
use crate::export::csv::{exact_or_empty, line};
use crate::export::table::Table;
use crate::oscillator::belt::{Derivatives, FrictionLaw, TaylorError};
use crate::study::Edge;
use crate::study::belt::PhysicalMargin;
use crate::view::number::{duration, significant};
use crate::view::quantity::with_unit;

/// Digits of a dimensionless number.
const DIGITS: usize = 10;

/// One line of the answer: what, its dimensionless value, its physical value and unit.
struct Row {
    what: &'static str,
    dimensionless: Option<f64>,
    physical: Option<(f64, &'static str)>,
}

/// The numbers about a machine that stand alone.
fn rows(answer: &Answer) -> Vec<Row> {
    let survey = answer.survey;
    let (belt, reduced) = (&survey.belt, &survey.reduced);
    let parameters = &reduced.parameters;
    let margin = survey.margin();
    let physical = PhysicalMargin::new(&margin, &reduced.units);
    let pure = |what, value| Row { what, dimensionless: Some(value), physical: None };
    let both = |what, dimensionless: Option<f64>, value: Option<f64>, unit| Row {
        what,
        dimensionless,
        physical: value.map(|value| (value, unit)),
    };
    let unit = |what, value, unit| both(what, Some(1.0), Some(value), unit);
    vec![
        pure("D", parameters.d),
        pure("D2", parameters.d2),
        pure("D3", parameters.d3),
        both("friction r", Some(parameters.r), Some(belt.friction), "N"),
        unit("unit of displacement x0", reduced.units.displacement, "m"),
        unit("unit of time", reduced.units.time, "s"),
        both("rests within +-", Some(parameters.r), Some(belt.friction / belt.stiffness), "m"),
        both(
            "sticks to the belt at",
            Some(reduced.sticking_velocity),
            Some(belt.belt_speed),
            "m/s",
        ),
        both("margin: displacement", margin.displacement, physical.displacement, "m"),
        both("margin: impulse", margin.impulse, physical.impulse, "N s"),
        both("margin: velocity", margin.impulse, physical.velocity, "m/s"),
    ]
}

/// Everything that is said about a machine, to read.
#[must_use]
pub fn table(answer: &Answer) -> String {
    let survey = answer.survey;
    let (belt, reduced) = (&survey.belt, &survey.reduced);
    let machine = answer.machine;
    let mut out = format!("{}: {}\n", machine.name, machine.title);
    out += &format!("{}\n{}\n\n", quantities(belt, None), friction(&belt.law, &reduced.mu));
    let mut numbers = Table::new(&["", "dimensionless", "physical"]);
    for Row { what, dimensionless, physical } in rows(answer) {
        let number = |value| significant(value, DIGITS);
        numbers.row(vec![
            what.to_owned(),
            dimensionless.map_or_else(|| "-".to_owned(), number),
            physical.map_or_else(String::new, |(value, unit)| with_unit(value, PLACES, unit)),
        ]);
    }
    out += &format!("{numbers}\n");
    out += match survey.cycles.edge {
        Edge::None => {
            "every kick is survived: the whole plane comes to rest, or nothing borders it\n"
        }
        Edge::Cycle => "beyond the margin the unstable cycle is crossed\n",
        Edge::Separatrix => "beyond the margin the velocity runs away\n",
    };
    out.push('\n');
    out += &reaches(answer);
    for found in survey.alarms() {
        out += &format!("alarm: {}\n", alarm(&found, belt));
    }
    if let Some(designed) = &answer.design {
        out += &format!("{}\n", designed.sentence(belt, &reduced.units));
    }
    let mut evaluations = survey.cost.evaluations;
    evaluations += answer.design.map_or(0, |designed| designed.design.cost.evaluations);
    out + &format!("{evaluations} evaluations, {}\n", duration(answer.seconds))
}

/// The friction law at the belt speed.
fn friction(law: &FrictionLaw, mu: &Derivatives) -> String {
    let Derivatives { value, first, second, third } = *mu;
    let from = match law {
        FrictionLaw::Table(spline) => format!(
            "the smoothest curve near {} points, {} away in the quadratic mean",
            spline.points(),
            significant(spline.missed(), 3)
        ),
        _ => law.name().to_owned(),
    };
    let number = |value| significant(value, PLACES);
    format!(
        "friction ({from}) at v0: mu = {}, mu' = {} s/m, mu'' = {} s^2/m^2, mu''' = {} s^3/m^3",
        number(value),
        number(first),
        number(second),
        number(third)
    )
}

/// How far the cycles and the motion reach, and what the Taylor expansion leaves out on the way.
fn reaches(answer: &Answer) -> String {
    let survey = answer.survey;
    let units = &survey.reduced.units;
    let titles = ["", "x from", "to", "v from", "to", "period", "Taylor error", "of F mu(v0)"];
    let mut table = Table::new(&titles);
    let speed = |value| with_unit(value, PLACES, "m/s");
    let taylor = |error: &Option<TaylorError>| match error {
        Some(error) => {
            let part = if error.complete { "" } else { " (in part)" };
            [with_unit(error.force, 3, "N"), significant(error.of_friction, 3) + part]
        }
        None => ["-".to_owned(), "-".to_owned()],
    };
    for (cycle, reach) in survey.cycles.cycles.iter().zip(&survey.reaches) {
        let name = if cycle.stable { "stable cycle" } else { "unstable cycle" };
        let length = |q: f64| with_unit(q * units.displacement, PLACES, "m");
        let mut cells = vec![name.to_owned(), length(cycle.q_min), length(cycle.q_max)];
        cells.extend([speed(reach.velocity.0), speed(reach.velocity.1)]);
        cells.push(with_unit(cycle.period * units.time, PLACES, "s"));
        cells.extend(taylor(&reach.taylor));
        table.row(cells);
    }
    let reach = &survey.reach;
    let mut cells = vec!["the motion".to_owned()];
    cells.extend([reach.displacement.0, reach.displacement.1].map(|x| with_unit(x, PLACES, "m")));
    cells.extend([speed(reach.velocity.0), speed(reach.velocity.1), String::new()]);
    cells.extend(taylor(&reach.taylor));
    table.row(cells);
    format!("{table}\n{}\n", outcome(&PhysicalOutcome::new(survey), answer))
}

/// How the motion ended, in a sentence.
fn outcome(outcome: &PhysicalOutcome, answer: &Answer) -> String {
    let length = |x| with_unit(x, PLACES, "m");
    let time = |t| with_unit(t, PLACES, "s");
    let start = answer.machine;
    let from = format!(
        "from x = {}, v = {}: ",
        length(start.displacement),
        with_unit(start.velocity, PLACES, "m/s")
    );
    from + &match outcome {
        PhysicalOutcome::SticksToBelt { t, x } => {
            format!("reaches the belt's speed at t = {}, x = {}", time(*t), length(*x))
        }
        PhysicalOutcome::Captured { t, x } => {
            format!("at rest at x = {} since t = {}", length(*x), time(*t))
        }
        PhysicalOutcome::Moving { t, x, .. } => {
            format!("still moving at t = {}, x = {}", time(*t), length(*x))
        }
        PhysicalOutcome::Escaped { t } => format!("runs away at t = {}", time(*t)),
        PhysicalOutcome::GaveUp { t, reason } => format!("gave up at t = {}: {reason}", time(*t)),
    }
}

/// One row for each number, in SI units.
#[must_use]
pub fn csv(answer: &Answer) -> String {
    let mut out = String::from("what,dimensionless,physical,unit\n");
    for Row { what, dimensionless, physical } in rows(answer) {
        let (value, unit) = physical.map_or((None, ""), |(value, unit)| (Some(value), unit));
        let cells = [
            what.to_owned(),
            exact_or_empty(dimensionless),
            exact_or_empty(value),
            unit.to_owned(),
        ];
        out += &line(&cells);
    }
    if let Some(designed) = &answer.design {
        let force = designed.force(&answer.survey.reduced.units);
        let cells =
            ["R for the margin".to_owned(), String::new(), exact_or_empty(force), "N".to_owned()];
        out += &line(&cells);
    }
    out
}
