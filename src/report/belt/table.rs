//! A machine's answer as text to read, and as rows of comma-separated values.

use serde::Serialize;

use super::document::kind;
use super::expansion::Expansion;
use super::{BeltAnswer, PLACES, RestShare, finite, line, margins, numbers};
use crate::machine::guarantee::{GuaranteedKicks, MachineUncertain};
use crate::machine::motion::{MachineOutcome, MachineState};
use crate::machine::stepped::Stepped;
use crate::machine::survey::{Course, Second};
use crate::machine::varied::Varied;
use crate::machine::{MachineBorder, MachineCycle, MachineFate, Portrait};
use crate::oscillator::Interval;
use crate::oscillator::belt::{Derivatives, FrictionLaw};
use crate::report::csv::Sheet;
use crate::report::table::Table;
use crate::words::number::{duration, significant};
use crate::words::quantity::with_unit;
use crate::words::stability;

/// Digits of a dimensionless number.
const DIGITS: usize = 10;

/// One line of the answer: what, its dimensionless value, its physical value and unit.
struct Row {
    what: &'static str,
    dimensionless: Option<f64>,
    physical: Option<(f64, &'static str)>,
}

/// The numbers about a machine that stand alone.
fn rows(answer: &BeltAnswer) -> Vec<Row> {
    let survey = answer.survey;
    let (belt, reduced) = (&survey.belt, &survey.reduced);
    let (parameters, units) = (&reduced.parameters, &reduced.units);
    let [displacement, impulse] = margins(&survey.course.portrait);
    let pure = |what, value| Row { what, dimensionless: Some(value), physical: None };
    let scaled = |what, value: Option<f64>, scale: f64, unit| Row {
        what,
        dimensionless: value.map(|value| value / scale),
        physical: value.map(|value| (value, unit)),
    };
    let velocity = impulse.map(|impulse| impulse / belt.mass);
    let held = belt.static_guide.unwrap_or(belt.friction) / belt.stiffness;
    vec![
        pure("D", parameters.d),
        pure("D2", parameters.d2),
        pure("D3", parameters.d3),
        scaled("friction r", Some(belt.friction), units.force, "N"),
        scaled("unit of displacement x0", Some(units.displacement), units.displacement, "m"),
        scaled("unit of time", Some(units.time), units.time, "s"),
        scaled("rests within +-", Some(held), units.displacement, "m"),
        scaled("sticks to the belt at", Some(belt.belt_speed), units.velocity, "m/s"),
        scaled("margin: displacement", displacement, units.displacement, "m"),
        scaled("margin: impulse", impulse, units.impulse, "N s"),
        scaled("margin: velocity", velocity, units.velocity, "m/s"),
    ]
}

/// Everything that is said about a machine, to read.
pub fn table(answer: &BeltAnswer) -> String {
    let survey = answer.survey;
    let (belt, reduced) = (&survey.belt, &survey.reduced);
    let machine = answer.machine;
    let mut out = format!("{}: {}\n", machine.name, machine.title);
    out += &format!("{}\n{}\n\n", line(&numbers(belt)), friction(&belt.law, &reduced.mu));
    let mut numbers = Table::new(&["", "dimensionless", "physical"]);
    for Row { what, dimensionless, physical } in rows(answer) {
        let number = |value| significant(value, DIGITS);
        numbers.row(vec![
            what.to_owned(),
            dimensionless.map_or_else(|| "-".to_owned(), number),
            physical.map_or_else(String::new, |(value, unit)| with_unit(value, PLACES, unit)),
        ]);
    }
    out += &format!("{numbers}\n{}\n\n", border(&survey.course.portrait));
    if let Some(certain) = &answer.certain {
        out += &format!("{}\n", guaranteed(answer, certain));
    }
    out += &cycles(&survey.course.portrait.cycles);
    out += &gaps(&survey.course.portrait);
    let start = (machine.displacement, machine.velocity);
    out += &format!("{}\n", fate(start, &survey.course));
    out += &answer.rest_share.line();
    out += &format!("{}\n", expansion(answer));
    if let Some(designed) = &answer.design {
        out += &format!("{}\n", designed.sentence());
    }
    out + &format!("{} steps, {}\n", survey.course.portrait.steps, duration(answer.seconds))
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

/// What borders the basin of rest, in a sentence.
pub(super) fn border(portrait: &Portrait) -> &'static str {
    match portrait.border {
        MachineBorder::None if portrait.margin.is_some() => {
            "every kick within the margin is survived; larger ones are not known"
        }
        MachineBorder::None => "every kick is survived: whatever happens, the mass comes to rest",
        MachineBorder::NoBasin => "no kick is survived, however small: rest repels",
        MachineBorder::Cycle(..) => "beyond the margin an unstable cycle is crossed",
        MachineBorder::Grazing(_) if portrait.neutral => {
            "within the margin every motion is periodic; beyond it the mass sticks to the belt"
        }
        MachineBorder::Grazing(_) if portrait.border.touches() => {
            "beyond the margin the mass comes to stick to the belt"
        }
        MachineBorder::Grazing(_) => {
            "beyond the margin the guide catches the mass no more, and it is carried off"
        }
    }
}

/// The nominal margins and those that hold for certain, side by side, and what they allow for.
fn guaranteed(answer: &BeltAnswer, certain: &Result<GuaranteedKicks, MachineUncertain>) -> String {
    let tolerances = &answer.machine.tolerances;
    let unit = |varied: Varied, value| with_unit(value, 12, varied.unit());
    let number = |(varied, interval): (Varied, Interval)| {
        format!(
            "{} in {} .. {}",
            varied.name(),
            unit(varied, interval.lower()),
            unit(varied, interval.upper())
        )
    };
    let disturbance = Some(tolerances.disturbance).filter(|force| *force > 0.0);
    let disturbance = disturbance.map(|force| format!("disturbance {}", with_unit(force, 12, "N")));
    let known: Vec<String> =
        answer.uncertain().into_iter().map(number).chain(disturbance).collect();
    let both = |displacement: Option<f64>, impulse: Option<f64>| {
        let told = |value: Option<f64>, unit| {
            value.map_or_else(|| "any".to_owned(), |value| with_unit(value, PLACES, unit))
        };
        format!("displacement {}, impulse {}", told(displacement, "m"), told(impulse, "N s"))
    };
    // What is certain is not rounded up.
    let below = |value: f64| finite(value * (1.0 - 5e-5));
    let [displacement, impulse] = margins(&answer.survey.course.portrait);
    let certain = match certain {
        Ok(kicks) => both(below(kicks.displacement), below(kicks.impulse)),
        Err(reason) => format!("nothing: {reason}"),
    };
    format!(
        "nominal     {}\nguaranteed  {certain}\n            for {}\n",
        both(displacement, impulse),
        known.join(", ")
    )
}

/// What is not known of a machine, a line each.
pub(super) fn gaps(portrait: &Portrait) -> String {
    let length = |x| with_unit(x, PLACES, "m");
    let limit = portrait.stop.map(|stop| {
        format!("motions that turn beyond x = {} are not known: {stop}\n", length(portrait.known))
    });
    let unresolved = portrait.unresolved.iter().map(|(from, to)| {
        let (from, to) = (length(*from), length(*to));
        format!("between x = {from} and {to} the search for cycles did not settle\n")
    });
    limit.into_iter().chain(unresolved).collect()
}

/// The cycles, a row each.
pub(super) fn cycles(cycles: &[MachineCycle]) -> String {
    if cycles.is_empty() {
        return "no cycle\n".to_owned();
    }
    let mut table = Table::new(&[&[""], CYCLE].concat());
    for cycle in cycles {
        table.row(cells(cycle));
    }
    table.to_string()
}

/// Titles of the columns that tell a cycle, behind that of its kind.
pub(super) const CYCLE: &[&str] =
    &["x from", "to", "v from", "to", "period", "on the belt", "multiplier"];

/// The cells of these columns, behind the kind.
pub(super) fn cells(cycle: &MachineCycle) -> Vec<String> {
    let over = if cycle.overtakes { ", overtaking" } else { "" };
    let mut cells = vec![format!("{} {}{over}", stability(cycle.stable), kind(cycle))];
    let ([from, to], [slowest, fastest]) = ([cycle.x.0, cycle.x.1], [cycle.v.0, cycle.v.1]);
    let numbers = [(from, "m"), (to, "m"), (slowest, "m/s"), (fastest, "m/s")];
    let times = [(cycle.period, "s"), (cycle.stick_duration, "s")];
    cells.extend(
        numbers.into_iter().chain(times).map(|(value, unit)| with_unit(value, PLACES, unit)),
    );
    cells.push(significant(cycle.multiplier, PLACES));
    cells
}

/// What becomes of the motion, in a sentence.
pub(super) fn fate((x, v): (f64, f64), course: &Course) -> String {
    let length = |x| with_unit(x, PLACES, "m");
    let from = format!("from x = {}, v = {}: ", length(x), with_unit(v, PLACES, "m/s"));
    let end = &course.motion.end;
    from + &match course.fate {
        MachineFate::Rest => {
            let place = course.rest.map_or_else(String::new, |x| format!(" at x = {}", length(x)));
            if course.motion.outcome == MachineOutcome::Rests {
                format!("comes to rest{place}, at t = {}", with_unit(end.t, PLACES, "s"))
            } else {
                format!("comes to rest{place}")
            }
        }
        MachineFate::Cycle(index) => {
            let cycle = &course.portrait.cycles[index];
            format!("ends on the {} cycle up to x = {}", kind(cycle), length(cycle.x.1))
        }
        MachineFate::Neutral => "is periodic, one of a family".to_owned(),
        MachineFate::Escaped => "grows without bound".to_owned(),
        MachineFate::Unknown(stop) => format!("is not known: {stop}"),
    } + &course.second.as_ref().map_or_else(String::new, |second| by(second, course))
}

/// The motion by another method beside the first, in a sentence.
fn by(Second { way, tolerance, found }: &Second, course: &Course) -> String {
    let MachineState { t, x, v } = course.motion.end;
    let lead = format!("\nby {} at {tolerance:e}: ", way.name());
    lead + &match found {
        Ok(Stepped { end, .. }) => format!(
            "at t = {} x = {}, v = {}; Taylor series differ by {} and {}",
            with_unit(t, PLACES, "s"),
            with_unit(end.x, 12, "m"),
            with_unit(end.v, 12, "m/s"),
            with_unit((end.x - x).abs(), 2, "m"),
            with_unit((end.v - v).abs(), 2, "m/s"),
        ),
        Err(stop) => stop.to_string(),
    }
}

/// What the cubic expansion says instead, in a sentence.
fn expansion(answer: &BeltAnswer) -> String {
    let survey = answer.survey;
    let found = Expansion::new(survey);
    let lead = "friction as a cubic (the oscillator of the paper) says: ";
    let Some(margin) = found.margin else {
        let reason = survey.expansion.as_ref().err().map(ToString::to_string);
        return format!("{lead}nothing; {}", reason.unwrap_or_default());
    };
    let size = match (margin.physical.displacement, margin.error.displacement) {
        (None, _) => "every kick is survived".to_owned(),
        (Some(own), None) => format!("margin {}", with_unit(own, PLACES, "m")),
        (Some(own), Some(error)) => {
            let percent = significant(100.0 * error.abs() / (own - error).abs(), 2);
            let way = if error > 0.0 { "large" } else { "small" };
            let judged = if error == 0.0 || own == error {
                String::new()
            } else {
                format!(", {percent} % too {way}")
            };
            format!("margin {}{judged}", with_unit(own, PLACES, "m"))
        }
    };
    let count = |stable| found.cycles.iter().filter(|cycle| cycle.stable == stable).count();
    format!("{lead}{size}; {} unstable and {} stable cycles", count(false), count(true))
}

/// One row for each number, in SI units.
pub fn csv(answer: &BeltAnswer) -> String {
    let mut out = sheet();
    for Row { what, dimensionless, physical } in rows(answer) {
        let (value, unit) = physical.map_or((None, ""), |(value, unit)| (Some(value), unit));
        put(&mut out, what, dimensionless, value, unit);
    }
    if let Some(certain) = &answer.certain {
        let kicks = certain.ok();
        let value = |pick: fn(&GuaranteedKicks) -> f64| kicks.as_ref().map(pick).and_then(finite);
        put(&mut out, "guaranteed: displacement", None, value(|it| it.displacement), "m");
        put(&mut out, "guaranteed: impulse", None, value(|it| it.impulse), "N s");
    }
    csv_rows(&mut out, &answer.survey.course.portrait, answer.rest_share);
    if let Some(designed) = &answer.design {
        put(&mut out, "R for the margin", None, designed.force(), "N");
    }
    out.into_text()
}

/// A number in SI units.
#[derive(Default, Serialize)]
struct Number<'a> {
    what: &'a str,
    dimensionless: Option<f64>,
    physical: Option<f64>,
    unit: &'a str,
}

pub(super) fn sheet() -> Sheet {
    Sheet::like(&Number::default(), &[])
}

fn put(
    sheet: &mut Sheet,
    what: &str,
    dimensionless: Option<f64>,
    physical: Option<f64>,
    unit: &str,
) {
    sheet.row(&Number { what, dimensionless, physical, unit });
}

/// Adds a row for each number of each cycle, and the share.
pub(super) fn csv_rows(out: &mut Sheet, portrait: &Portrait, rest_share: RestShare) {
    for (index, cycle) in portrait.cycles.iter().enumerate() {
        let lead = format!("{} {} cycle {index}", stability(cycle.stable), kind(cycle));
        for (name, value, unit) in [
            ("x_min", cycle.x.0, "m"),
            ("x_max", cycle.x.1, "m"),
            ("v_min", cycle.v.0, "m/s"),
            ("v_max", cycle.v.1, "m/s"),
            ("period", cycle.period, "s"),
            ("stick_duration", cycle.stick_duration, "s"),
            ("multiplier", cycle.multiplier, ""),
        ] {
            put(out, &format!("{lead}: {name}"), None, Some(value), unit);
        }
    }
    if !rest_share.is_not_asked() {
        put(out, "rest share of the window", rest_share.known(), None, "");
    }
}
