//! The numbers of the answer about a machine, one in each row.

use super::{MachineAnswer, OnBelt};
use crate::portrait::{CubicExpansion, Margin, Portrait};
use crate::report::answer::PLACES;
use crate::report::cycle_numbers::of_machine;
use crate::report::{Columns, Quantity};
use crate::words::stability;

/// A number of the answer: a label, the dimensionless value, and the physical value with its SI unit.
pub(super) struct QuantityRow {
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
pub(super) fn columns<'a>() -> Columns<'a, QuantityRow> {
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
pub(super) fn of_belt(
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
pub(super) fn rows(answer: &MachineAnswer) -> Vec<QuantityRow> {
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
        rows.push(QuantityRow::physical("R for the margin", designed.force(), "N"));
    }
    rows
}
