//! The motions of a mass on a belt or of a vibration mode, in physical units; for a belt also by the oscillator of
//! the paper.

mod document;
mod expansion;
mod text;

pub use expansion::CubicExpansion;

use super::cycle_numbers::{machine_cycles, of_machine};
use super::cycles::{NO_CYCLE, known};
use super::margin::{MarginRow, guaranteed, margin_columns};
use super::{About, Answer, Columns, PLACES, Quantity};
use crate::flow::{Fate, Motion, Subject};
use crate::model::{Interval, Knob};
use crate::portrait::{Cycle, FrictionNeed, Kick, Margin, NoGuarantee, Portrait};
use crate::words::stability;

/// A part of a window; `None` if it is not known.
pub type RestShare = Option<f64>;

/// The whole answer about a mass on a belt or a vibration mode.
pub struct MachineAnswer<'a> {
    pub about: &'a About,
    pub subject: &'a Subject,
    pub portrait: Portrait,
    /// The motion from the start.
    pub motion: Motion,
    /// What it ends as.
    pub fate: Fate,
    /// Where it comes to rest, in m.
    pub rest: Option<f64>,
    /// The same motion by another method, if asked for.
    pub second: Option<Motion>,
    /// The fraction of the starts in a window from which the mass comes to rest, if asked for; of that `None` where motions
    /// from the window leave the range that is known.
    pub rest_share: Option<RestShare>,
    /// The friction needed for a margin, if asked for.
    pub design: Option<DesignAnswer>,
    /// `None` for a mode.
    pub expansion: Option<CubicExpansion<'a>>,
    /// The kicks that are survived for certain, or why none is; `None` if not asked for.
    pub certain: Option<Result<Margin, NoGuarantee>>,
}

impl MachineAnswer<'_> {
    /// The numbers that are not known exactly, each with its interval in SI units.
    fn uncertain(&self) -> Vec<(Knob, Interval)> {
        let belt = self.subject.source.of_belt();
        belt.map(|belt| self.subject.tolerances.intervals(belt)).unwrap_or_default()
    }
}

/// The friction needed for a margin.
#[derive(Clone, Copy, Debug)]
pub struct DesignAnswer {
    /// The kick that is to be survived.
    pub kick: Kick,
    /// Its size: m for a displacement, N s for an impulse.
    pub wanted: f64,
    /// The friction needed, in N.
    pub needed: FrictionNeed,
}

/// The whole answer about a machine.
pub fn machine(found: &MachineAnswer, seconds: f64) -> Answer {
    let MachineAnswer { about, portrait, expansion, .. } = found;
    let certain = found.certain.and_then(Result::ok);
    let margins = [("nominal", portrait.margin)].into_iter();
    let margins = margins.chain(certain.map(|margin| guaranteed(about, margin, PLACES)));
    let kicks = Columns::default()
        .text("margin: smallest kick not survived", |(name, _): &MarginRow| *name)
        .and(margin_columns(about, PLACES));
    let (statement, holds) = text::statement(found);
    let allowance = text::allowance(found).unwrap_or_default();
    let (own, rows) = (of_belt(found), rows(found));
    about
        .answer()
        .and(&document::document(found))
        .csv(&quantity_columns(), own.iter().chain(&rows))
        .statement(statement, holds)
        .lines(known(portrait))
        .heading("Margins")
        .table(kicks.table(margins).transposed().captioned(allowance))
        .heading("Machine")
        .table(quantity_columns().table(&own))
        .lines(expansion.as_ref().map(text::friction))
        .heading("Cycles")
        .table(machine_cycles(|cycle: &Cycle| Some(*cycle)).table(&portrait.cycles))
        .lines(portrait.cycles.is_empty().then_some(NO_CYCLE))
        .heading("Remarks")
        .lines(text::remarks(found))
        .cost(portrait.cost, seconds)
}

/// A number of the answer: what it is, its value without units and in its SI unit, and that unit.
#[derive(Default)]
struct QuantityRow {
    what: String,
    dimensionless: Option<f64>,
    physical: Option<f64>,
    unit: &'static str,
}

/// The columns of these numbers.
fn quantity_columns<'a>() -> Columns<'a, QuantityRow> {
    let physical = |row: &QuantityRow| Quantity::of(row.unit, PLACES).or("").text(row.physical);
    Columns::default()
        .file("what", |row: &QuantityRow| row.what.clone())
        .text("", |row| row.what.clone())
        .number("dimensionless", Quantity::pure(10), |row| row.dimensionless)
        .file("physical", |row| row.physical)
        .text("physical", physical)
        .file("unit", |row| row.unit)
}

/// The single numbers that describe a mass on a belt; none of a mode.
fn of_belt(answer: &MachineAnswer) -> Vec<QuantityRow> {
    let Some(expansion) = &answer.expansion else { return Vec::new() };
    let (CubicExpansion { belt, reduced, .. }, margin) = (expansion, &answer.portrait.margin);
    let (parameters, units) = (&reduced.parameters, &reduced.units);
    let (length, impulse) = ((units.displacement, "m"), (units.impulse, "N s"));
    let velocity = margin.impulse.map(|impulse| impulse / belt.mass);
    let pure = (1.0, "");
    let numbers = [
        ("D", Some(parameters.d), pure),
        ("D2", Some(parameters.d2), pure),
        ("D3", Some(parameters.d3), pure),
        ("friction r", Some(belt.friction), (units.force, "N")),
        ("unit of displacement x0", Some(units.displacement), length),
        ("unit of time", Some(units.time), (units.time, "s")),
        ("rests within +-", Some(expansion.held()), length),
        ("sticks to the belt at", Some(belt.belt_speed), (units.velocity, "m/s")),
        ("from rest: displacement", margin.from_rest.displacement, length),
        ("from rest: impulse", margin.from_rest.impulse, impulse),
        ("margin: displacement", margin.displacement, length),
        ("margin: impulse", margin.impulse, impulse),
        ("margin: velocity", velocity, (units.velocity, "m/s")),
    ];
    let row = |(what, value, (one, unit)): (&str, Option<f64>, (f64, &'static str))| {
        let physical = value.filter(|_| !unit.is_empty());
        QuantityRow {
            what: what.to_owned(),
            dimensionless: value.map(|value| value / one),
            physical,
            unit: physical.map_or("", |_| unit),
        }
    };
    numbers.into_iter().map(row).collect()
}

/// One row for each further number, in SI units.
fn rows(answer: &MachineAnswer) -> Vec<QuantityRow> {
    let mut rows = Vec::new();
    let named = |what: &str| QuantityRow { what: what.to_owned(), ..QuantityRow::default() };
    let physical = |what: &str, physical, unit| QuantityRow { physical, unit, ..named(what) };
    if let Some(certain) = answer.certain {
        let Margin { displacement, impulse, from_rest } = certain.unwrap_or(Margin::ENDLESS);
        rows.extend([
            physical("guaranteed from rest: displacement", from_rest.displacement, "m"),
            physical("guaranteed from rest: impulse", from_rest.impulse, "N s"),
            physical("guaranteed: displacement", displacement, "m"),
            physical("guaranteed: impulse", impulse, "N s"),
        ]);
    }
    for (index, cycle) in answer.portrait.cycles.iter().enumerate() {
        let lead = format!("{} {} cycle {index}", stability(cycle.stable), cycle.kind());
        rows.extend(of_machine().map(|number| {
            let what = format!("{lead}: {}", number.physical_name());
            physical(&what, (number.value)(cycle), number.unit)
        }));
    }
    let share = |share| QuantityRow { dimensionless: share, ..named("rest share of the window") };
    rows.extend(answer.rest_share.map(share));
    let least = |it: DesignAnswer| physical("R for the margin", it.needed.least(), "N");
    rows.extend(answer.design.map(least));
    rows
}
