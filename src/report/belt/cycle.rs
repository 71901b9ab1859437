//! The numbers of a cycle of a machine, in SI units, for every form of output.

use super::PLACES;
use crate::portrait::Cycle;
use crate::report::columns::{Columns, Quantity};
use crate::report::json::Document;
use crate::words::stability;

/// A number of a cycle.
pub(super) struct PhysicalNumber {
    pub name: &'static str,
    /// In text.
    pub title: &'static str,
    pub unit: &'static str,
    /// `None` for a multiplier that overflows.
    pub value: fn(&Cycle) -> Option<f64>,
}

/// All of them.
pub(super) const NUMBERS: [PhysicalNumber; 7] = {
    const fn number(
        name: &'static str,
        title: &'static str,
        unit: &'static str,
        value: fn(&Cycle) -> Option<f64>,
    ) -> PhysicalNumber {
        PhysicalNumber { name, title, unit, value }
    }
    [
        number("x_min", "x from", "m", |it| Some(it.q_min)),
        number("x_max", "to", "m", |it| Some(it.q_max)),
        number("v_min", "v from", "m/s", |it| Some(it.v_min)),
        number("v_max", "to", "m/s", |it| Some(it.v_max)),
        number("period", "period", "s", |it| Some(it.period)),
        number("stick_duration", "on the belt", "s", |it| Some(it.stick_duration())),
        number("multiplier", "multiplier", "", |it| it.multiplier),
    ]
};

/// Stability and kind of a cycle.
pub(in crate::report) fn described(cycle: &Cycle) -> String {
    let over = if cycle.overtakes { ", overtaking" } else { "" };
    format!("{} {}{over}", stability(cycle.stable), cycle.kind())
}

/// A cycle as an object.
pub(super) fn cycle_document(cycle: &Cycle) -> Document {
    let document = Document::default()
        .with("kind", cycle.kind())
        .with("overtakes", cycle.overtakes)
        .with("stable", cycle.stable);
    NUMBERS
        .iter()
        .fold(document, |document, number| document.with(number.name, (number.value)(cycle)))
        // Null for a multiplier of 0.
        .with("log_multiplier", cycle.log_multiplier)
}

/// A column of text for each number of the cycle of a row; empty for a row without.
pub(in crate::report) fn number_columns<'a, R: 'a>(
    columns: Columns<'a, R>,
    cycle: impl Fn(&R) -> Option<Cycle> + Copy + 'a,
) -> Columns<'a, R> {
    NUMBERS.iter().fold(columns, |columns, PhysicalNumber { title, unit, value, .. }| {
        let text = |cycle: Cycle| Quantity::of(unit, PLACES).text(value(&cycle));
        columns.text(title, move |row| cycle(row).map(text).unwrap_or_default())
    })
}
