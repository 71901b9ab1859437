//! The motions of a mass on a belt or of a vibration mode, in physical units; for a belt also by the oscillator of
//! the paper.

mod document;
mod text;

use super::answer::PLACES;
use super::cycle_numbers::{machine_cycles, of_machine};
use super::cycles::{NO_CYCLE, known};
use super::margin::{GUARANTEED, margin_columns};
use super::page::SourceFile;
use super::{About, Answer, Columns, Quantity};
use crate::model::{Interval, Knob, Tolerances};
use crate::portrait::guarantee::Uncertain;
use crate::portrait::{Course, CubicExpansion, Cycle, FrictionNeeded, Kick, Margin, Portrait};
use crate::words::provenance::Provenance;
use crate::words::stability;

/// A part of a window; `None` if it is not known.
pub type RestShare = Option<f64>;

/// The whole answer about a mass on a belt or a vibration mode.
pub struct MachineAnswer<'a> {
    pub about: &'a About,
    /// Displacement (m) and velocity (m/s) at the start.
    pub start: (f64, f64),
    pub course: Course,
    /// The fraction of the starts in a window from which the mass comes to rest, if asked for; of that `None` where motions
    /// from the window leave the range that is known.
    pub rest_share: Option<RestShare>,
    /// The friction needed for a margin, if asked for.
    pub design: Option<DesignAnswer>,
    /// `None` for a mode.
    pub on_belt: Option<OnBelt<'a>>,
    pub seconds: f64,
}

/// The part of the answer that only a mass on a belt has.
pub struct OnBelt<'a> {
    pub expansion: CubicExpansion,
    pub tolerances: &'a Tolerances,
    /// The kicks that are survived for certain, or why none is; `None` if not asked for.
    pub certain: Option<Result<Margin, Uncertain>>,
}

impl OnBelt<'_> {
    /// The numbers that are not known exactly, each with its interval in SI units.
    pub(super) fn uncertain(&self) -> Vec<(Knob, Interval)> {
        self.tolerances.intervals(&self.expansion.belt)
    }
}

/// The friction needed for a margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignAnswer {
    /// The kick that is to be survived.
    pub kick: Kick,
    /// Its size: m for a displacement, N s for an impulse.
    pub wanted: f64,
    /// The friction needed, in N.
    pub needed: FrictionNeeded,
    /// Speed of the belt in m/s; `None` for a mode.
    pub at: Option<f64>,
    /// The friction that the machine has, in N.
    pub has: f64,
}

/// The whole answer about a machine.
pub fn machine<'a>(found: &'a MachineAnswer) -> Answer<'a> {
    let MachineAnswer { about, course, on_belt, .. } = found;
    let (about, portrait) = (*about, &course.portrait);
    let belt = on_belt.as_ref();
    let guaranteed = belt.and_then(|belt| belt.certain?.ok());
    let margins = [("nominal", portrait.margin)].into_iter();
    let margins = margins.chain(guaranteed.map(|margin| (GUARANTEED, margin)));
    let kicks = Columns::default()
        .text("smallest kick that is not survived", |(name, _): &(&str, Margin)| (*name).to_owned())
        .and(margin_columns(about, PLACES));
    let (statement, holds) = text::statement(found);
    let friction = belt
        .map(|OnBelt { expansion, .. }| text::friction(&expansion.belt.law, &expansion.reduced.mu));
    let numbers = belt.into_iter().flat_map(|belt| of_belt(&belt.expansion, portrait));
    about
        .answer()
        .fields(move |all| document::document(all, found))
        .csv(quantity_columns(), rows(found))
        .statement(statement, holds)
        .lines(known(portrait))
        .heading("Margins")
        .captioned(belt.and_then(text::allowance).unwrap_or_default(), move || {
            kicks.table(margins).transposed()
        })
        .heading("Machine")
        .table(quantity_columns(), numbers)
        .lines(friction)
        .heading("Cycles")
        .table(machine_cycles(|cycle: &Cycle| Some(*cycle)), &portrait.cycles)
        .lines(portrait.cycles.is_empty().then_some(NO_CYCLE))
        .heading("Remarks")
        .lines(text::remarks(found))
        .cost(portrait.cost, found.seconds)
}

/// The page of a machine: with its pictures, what computed it, and the files of the machine.
pub fn page(
    answer: &MachineAnswer,
    pictures: &[String],
    provenance: &Provenance,
    sources: &[SourceFile],
) -> String {
    let kind = if answer.on_belt.is_some() { "A mass on a belt" } else { "A vibration mode" };
    machine(answer).page(kind, pictures, provenance, sources)
}

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
fn of_belt(
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

/// One row for each number, in SI units.
fn rows(answer: &MachineAnswer) -> Vec<QuantityRow> {
    let portrait = &answer.course.portrait;
    let mut rows = Vec::new();
    if let Some(OnBelt { expansion, certain, .. }) = &answer.on_belt {
        rows.extend(of_belt(expansion, portrait));
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
        rows.extend(of_machine().map(|number| {
            let what = format!("{lead}: {}", number.physical_name());
            QuantityRow::physical(&what, (number.value)(cycle), number.unit)
        }));
    }
    let share = |share| QuantityRow::pure("rest share of the window", share);
    rows.extend(answer.rest_share.map(share));
    if let Some(designed) = &answer.design {
        rows.push(QuantityRow::physical("R for the margin", designed.needed.least(), "N"));
    }
    rows
}

/// A margin of an expansion in m and N s.
fn in_units(own: &Margin, expansion: &CubicExpansion) -> Margin {
    let units = &expansion.reduced.units;
    own.map(|size| size * units.displacement, |size| size * units.impulse)
}

/// By how much a kick of the expansion exceeds that of the whole model, where both exist.
fn excess(own: Option<f64>, whole: Option<f64>) -> Option<f64> {
    Some(own? - whole?)
}
