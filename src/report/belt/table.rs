//! The answer about a machine as readable text, and as rows of comma-separated values.

use super::cycle::{NUMBERS, described, number_columns};
use super::{MachineAnswer, OnBelt, PLACES, expansion};
use crate::flow::machine::motion::MachineState;
use crate::flow::{Fate, MachineMotion};
use crate::model::belt::{Derivatives, FrictionLaw};
use crate::model::{Interval, Knob};
use crate::portrait::guarantee::machine::MachineUncertain;
use crate::portrait::{Border, Course, CubicExpansion, Cycle, Margin, Portrait};
use crate::report::columns::{Columns, Quantity};
use crate::report::table::Table;
use crate::words::number::{duration, significant};
use crate::words::quantity::with_unit;
use crate::words::stability;

/// What stands in place of an empty table of cycles.
pub(super) const NO_CYCLE: &str = "no cycle";

/// A number of the answer: a label, the dimensionless value, and the physical value with its SI unit.
struct QuantityRow {
    what: String,
    dimensionless: Option<f64>,
    physical: Option<f64>,
    unit: &'static str,
}

impl QuantityRow {
    fn pure(what: &str, value: Option<f64>) -> Self {
        QuantityRow { what: what.to_owned(), dimensionless: value, physical: None, unit: "" }
    }

    fn physical(what: &str, value: Option<f64>, unit: &'static str) -> Self {
        QuantityRow { what: what.to_owned(), dimensionless: None, physical: value, unit }
    }

    /// With its dimensionless value, of which the physical one is `scale` times as large.
    fn scaled(what: &str, value: Option<f64>, scale: f64, unit: &'static str) -> Self {
        let dimensionless = value.map(|value| value / scale);
        let unit = value.map_or("", |_| unit);
        QuantityRow { what: what.to_owned(), dimensionless, physical: value, unit }
    }
}

/// The columns of these numbers.
fn quantity_columns<'a>() -> Columns<'a, QuantityRow> {
    let physical = |row: &QuantityRow| Quantity::of(row.unit, PLACES).or("").text(row.physical);
    Columns::default()
        .word("what", |row: &QuantityRow| row.what.clone())
        .titled("")
        .number("dimensionless", Quantity::pure(10), |row| row.dimensionless)
        .file("physical", |row| row.physical)
        .text("physical", physical)
        .file("unit", |row| row.unit)
}

/// The single numbers that describe a mass on a belt.
fn rows(
    CubicExpansion { belt, reduced, .. }: &CubicExpansion,
    portrait: &Portrait,
) -> Vec<QuantityRow> {
    let (parameters, units) = (&reduced.parameters, &reduced.units);
    let Margin { displacement, impulse, from_rest } = portrait.margin;
    let (pure, scaled) = (QuantityRow::pure, QuantityRow::scaled);
    let velocity = impulse.map(|impulse| impulse / belt.mass);
    let held = belt.static_guide.unwrap_or(belt.friction) / belt.stiffness;
    vec![
        pure("D", Some(parameters.d)),
        pure("D2", Some(parameters.d2)),
        pure("D3", Some(parameters.d3)),
        scaled("friction r", Some(belt.friction), units.force, "N"),
        scaled("unit of displacement x0", Some(units.displacement), units.displacement, "m"),
        scaled("unit of time", Some(units.time), units.time, "s"),
        scaled("rests within +-", Some(held), units.displacement, "m"),
        scaled("sticks to the belt at", Some(belt.belt_speed), units.velocity, "m/s"),
        scaled("from rest: displacement", from_rest.displacement, units.displacement, "m"),
        scaled("from rest: impulse", from_rest.impulse, units.impulse, "N s"),
        scaled("margin: displacement", displacement, units.displacement, "m"),
        scaled("margin: impulse", impulse, units.impulse, "N s"),
        scaled("margin: velocity", velocity, units.velocity, "m/s"),
    ]
}

/// The whole answer about a machine as text.
pub fn table(answer: &MachineAnswer) -> String {
    let (head, portrait) = (answer.head, &answer.course.portrait);
    let mut out = format!("{}: {}\n{}\n", head.name, head.title, head.numbers_without(&[]));
    out += &answer.on_belt.as_ref().map_or_else(
        || survived(portrait),
        |OnBelt { expansion, .. }| {
            let mu = friction(&expansion.belt.law, &expansion.reduced.mu);
            format!("{mu}\n\n{}\n", quantities(expansion, portrait))
        },
    );
    out += &format!("{}\n\n", border(portrait));
    if let Some((belt, certain)) =
        answer.on_belt.as_ref().and_then(|it| Some((it, it.certain.as_ref()?)))
    {
        out += &format!("{}\n", guaranteed(belt, portrait, certain));
    }
    let cycles = cycles(&portrait.cycles);
    out += &if cycles.is_empty() { NO_CYCLE.to_owned() + "\n" } else { cycles.to_string() };
    for gap in gaps(portrait) {
        out += &format!("{gap}\n");
    }
    out += &format!("{}\n", fate(answer.start, &answer.course));
    out += &answer.rest_share.line();
    if let Some(OnBelt { expansion, .. }) = &answer.on_belt {
        out += &format!("{}\n", expansion::sentence(expansion, portrait));
    }
    if let Some(designed) = &answer.design {
        out += &format!("{}\n", designed.sentence());
    }
    out + &format!("{} steps, {}\n", portrait.steps, duration(answer.seconds))
}

/// The kicks that are survived, a line each.
fn survived(portrait: &Portrait) -> String {
    let Margin { displacement, impulse, from_rest } = portrait.margin;
    let line = |(from, kick, unit, size): (&str, &str, &'static str, Option<f64>)| {
        let size = Quantity::of(unit, PLACES).or("every one").text(size);
        format!("from {from}, survives {kick} up to: {size}\n")
    };
    let lines = [
        ("any rest position", "displacements", "m", from_rest.displacement),
        ("any rest position", "impulses", "N s", from_rest.impulse),
        ("the steady position", "displacements", "m", displacement),
        ("the steady position", "impulses", "N s", impulse),
    ];
    format!("\n{}", lines.map(line).concat())
}

/// The table of these numbers.
pub(super) fn quantities(expansion: &CubicExpansion, portrait: &Portrait) -> Table {
    quantity_columns().table(rows(expansion, portrait))
}

/// The friction law at the belt speed.
pub(super) fn friction(law: &FrictionLaw, mu: &Derivatives) -> String {
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

/// The border of the basin of rest, in a sentence.
pub(in crate::report) fn border(portrait: &Portrait) -> &'static str {
    match portrait.border {
        Border::Unknown(_) => "every kick within the margin is survived; larger ones are not known",
        Border::None => "every kick is survived: whatever happens, the mass comes to rest",
        Border::NoBasin => "no kick is survived, however small: rest repels",
        Border::Separatrix => "beyond the margin motions grow without bound",
        Border::Cycle => "beyond the margin an unstable cycle is crossed",
        Border::Grazing | Border::Capture if portrait.neutral => {
            "within the margin every motion is periodic; beyond it the mass sticks to the belt"
        }
        Border::Grazing => "beyond the margin the mass comes to stick to the belt",
        Border::Capture => {
            "beyond the margin the guide catches the mass no more, and it is carried off"
        }
    }
}

/// Margins as text: nominal or guaranteed, from where the kick comes, displacement and impulse.
pub(super) struct MarginRow {
    pub what: &'static str,
    pub from: &'static str,
    pub displacement: String,
    pub impulse: String,
}

/// The two rows of a margin.
fn margin_rows(what: &'static str, margin: Margin) -> [MarginRow; 2] {
    let size = |value, unit| Quantity::of(unit, PLACES).or("any").text(value);
    let row = |from, displacement: Option<f64>, impulse: Option<f64>| MarginRow {
        what,
        from,
        displacement: size(displacement, "m"),
        impulse: size(impulse, "N s"),
    };
    let Margin { displacement, impulse, from_rest } = margin;
    [
        row("from rest", from_rest.displacement, from_rest.impulse),
        row("from x = 0", displacement, impulse),
    ]
}

/// The rows of the nominal margins.
pub(super) fn nominal(portrait: &Portrait) -> [MarginRow; 2] {
    margin_rows("nominal", portrait.margin)
}

/// The rows of the guaranteed margins, rounded down.
pub(super) fn certain(margin: Margin) -> [MarginRow; 2] {
    let below = |value: f64| value * (1.0 - 5e-5);
    margin_rows("guaranteed", margin.map(below, below))
}

/// The numbers that are not known exactly, each with its interval.
pub(super) fn varying(belt: &OnBelt) -> Vec<String> {
    let unit = |varied: Knob, value| with_unit(value, 12, varied.spec().unit);
    let number = |(varied, interval): (Knob, Interval)| {
        format!(
            "{} in {} .. {}",
            varied.spec().name,
            unit(varied, interval.lower()),
            unit(varied, interval.upper())
        )
    };
    belt.uncertain().into_iter().map(number).collect()
}

/// The largest force of a disturbance, if there is one.
pub(super) fn disturbance(belt: &OnBelt) -> Option<String> {
    let force = Some(belt.tolerances.disturbance).filter(|force| *force > 0.0);
    force.map(|force| with_unit(force, 12, "N"))
}

/// What the guaranteed margins allow for.
pub(super) fn allowed(belt: &OnBelt) -> String {
    let disturbance = disturbance(belt).map(|force| format!("disturbance {force}"));
    varying(belt).into_iter().chain(disturbance).collect::<Vec<_>>().join(", ")
}

/// The nominal margins, the guaranteed ones, and the uncertainties for which these hold.
fn guaranteed(
    belt: &OnBelt,
    portrait: &Portrait,
    certain: &Result<Margin, MachineUncertain>,
) -> String {
    let lines = |rows: [MarginRow; 2]| {
        rows.map(|MarginRow { from, displacement, impulse, .. }| {
            format!("{from:11} displacement {displacement}, impulse {impulse}")
        })
        .join("\n            ")
    };
    let certain = match certain {
        Ok(margin) => lines(self::certain(*margin)),
        Err(reason) => format!("nothing: {reason}"),
    };
    format!(
        "nominal     {}\nguaranteed  {certain}\n            for {}\n",
        lines(nominal(portrait)),
        allowed(belt)
    )
}

/// What is not known about the motions, one line each.
pub(in crate::report) fn gaps(portrait: &Portrait) -> Vec<String> {
    let length = |x| with_unit(x, PLACES, "m");
    let limit = portrait.stop.map(|stop| {
        format!("motions that turn beyond x = {} are not known: {stop}", length(portrait.known))
    });
    let unresolved = portrait.unresolved.iter().map(|(from, to)| {
        let (from, to) = (length(*from), length(*to));
        format!("between x = {from} and {to} the search for cycles did not settle")
    });
    limit.into_iter().chain(unresolved).collect()
}

/// The table of cycles.
pub(super) fn cycles(cycles: &[Cycle]) -> Table {
    number_columns(Columns::default().text("", described), |cycle| Some(*cycle))
        .table(cycles.iter().copied())
}

/// How the motion ends, in a sentence.
pub(super) fn fate((x, v): (f64, f64), course: &Course) -> String {
    let length = |x| with_unit(x, PLACES, "m");
    let from = format!("from x = {}, v = {}: ", length(x), with_unit(v, PLACES, "m/s"));
    let end = &course.motion.end;
    from + &match course.fate {
        Fate::Rest => {
            let place = course.rest.map_or_else(String::new, |x| format!(" at x = {}", length(x)));
            if course.motion.outcome == Fate::Rest {
                format!("comes to rest{place}, at t = {}", with_unit(end.t, PLACES, "s"))
            } else {
                format!("comes to rest{place}")
            }
        }
        Fate::Cycle(index) => {
            let cycle = &course.portrait.cycles[index];
            format!("ends on the {} cycle up to x = {}", cycle.kind(), length(cycle.q_max))
        }
        Fate::Neutral => "is periodic, one of a family".to_owned(),
        Fate::Moving => "still moves".to_owned(),
        Fate::Escapes => "grows without bound".to_owned(),
        Fate::Unknown(stop) => format!("is not known: {stop}"),
    } + &course.second.as_ref().map_or_else(String::new, |second| by(second, course))
}

/// The motion by the second method, compared with the first, in a sentence.
fn by(second: &MachineMotion, course: &Course) -> String {
    let MachineState { t, x, v } = course.motion.end;
    let lead = format!("\nby {} at {:e}: ", second.method, second.tolerance);
    lead + &match second.known_end() {
        Ok(end) => format!(
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

/// One row for each number, in SI units.
pub fn csv(answer: &MachineAnswer) -> String {
    let portrait = &answer.course.portrait;
    let mut rows = Vec::new();
    if let Some(OnBelt { expansion, certain, .. }) = &answer.on_belt {
        rows.extend(self::rows(expansion, portrait));
        if let Some(certain) = certain {
            let Margin { displacement, impulse, from_rest } = certain.unwrap_or(Margin::ENDLESS);
            let physical = QuantityRow::physical;
            rows.extend([
                physical("guaranteed from rest: displacement", from_rest.displacement, "m"),
                physical("guaranteed from rest: impulse", from_rest.impulse, "N s"),
                physical("guaranteed: displacement", displacement, "m"),
                physical("guaranteed: impulse", impulse, "N s"),
            ]);
        }
    }
    for (index, cycle) in portrait.cycles.iter().enumerate() {
        let lead = format!("{} {} cycle {index}", stability(cycle.stable), cycle.kind());
        rows.extend(NUMBERS.iter().map(|number| {
            let what = format!("{lead}: {}", number.name);
            QuantityRow::physical(&what, (number.value)(cycle), number.unit)
        }));
    }
    if !answer.rest_share.is_not_asked() {
        rows.push(QuantityRow::pure("rest share of the window", answer.rest_share.known()));
    }
    if let Some(designed) = &answer.design {
        rows.push(QuantityRow::physical("R for the margin", designed.force(), "N"));
    }
    quantity_columns().csv(rows)
}
