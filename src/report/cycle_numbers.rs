//! The numbers that describe a limit cycle, and the columns that show them.

use super::{Columns, PLACES, Quantity};
use crate::numerics::Interval;
use crate::portrait::{Cycle, CycleErrors};
use crate::proof::Enclosure;
use crate::words::{significant, stability};

/// A number that describes a cycle.
pub(super) struct CycleNumber {
    pub name: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// `None` where it overflows or underflows.
    pub value: fn(&Cycle) -> Option<f64>,
    /// Where it is proved to lie.
    pub bounds: fn(&Enclosure) -> Interval,
}

impl CycleNumber {
    /// The name beside which `x` is the displacement.
    pub(super) fn physical_name(&self) -> String {
        self.name.replacen("q_", "x_", 1)
    }

    /// Of the oscillator of the paper; by its logarithm where it overflows or underflows.
    pub(super) fn text(&self, cycle: &Cycle, places: usize) -> String {
        let logarithm = if self.name == "clearance" {
            cycle.log_clearance
        } else {
            cycle.log_multiplier
        };
        let power = || format!("exp({})", significant(logarithm, places));
        (self.value)(cycle).map_or_else(power, |value| significant(value, places))
    }
}

const fn number(
    name: &'static str,
    unit: &'static str,
    value: fn(&Cycle) -> Option<f64>,
    bounds: fn(&Enclosure) -> Interval,
) -> CycleNumber {
    CycleNumber { name, unit, value, bounds }
}

/// The time per turn on the belt, which only a machine has.
const STICKING: CycleNumber =
    number("stick_duration", "s", |it| Some(it.stick_duration()), |_| Interval::point(0.0));

/// The numbers that describe a cycle of the oscillator of the paper.
pub(super) const NUMBERS: [CycleNumber; 7] = [
    number("q_min", "m", |it| Some(it.q_min), |it| it.q_min),
    number("q_max", "m", |it| Some(it.q_max), |it| it.q_max),
    number("v_min", "m/s", |it| Some(it.v_min), |it| it.v_min),
    number("v_max", "m/s", |it| Some(it.v_max), |it| it.v_max),
    number("period", "s", |it| Some(it.period), |it| it.period),
    number("multiplier", "", |it| it.multiplier, |it| it.multiplier),
    number("clearance", "m", |it| Some(it.clearance).filter(|it| *it > 0.0), |it| it.clearance),
];

/// Those that describe a cycle of a machine.
pub(super) fn of_machine() -> impl Iterator<Item = &'static CycleNumber> {
    let (before, after) = NUMBERS.split_at(5);
    before.iter().chain([&STICKING]).chain(&after[..1])
}

/// A column of text for each number of a cycle of the oscillator of the paper.
pub(super) fn number_columns<'a, R: 'a>(
    columns: Columns<'a, R>,
    cell: impl Fn(&R, &CycleNumber) -> String + Copy + 'a,
) -> Columns<'a, R> {
    NUMBERS.iter().fold(columns, |all, number| all.text(number.name, move |row| cell(row, number)))
}

/// A column of files for each field of a cycle.
pub(super) fn cycle_fields<'a, R: 'a>(cycle: impl Fn(&R) -> Option<Cycle> + 'a) -> Columns<'a, R> {
    let example = Cycle { errors: Some(CycleErrors::default()), ..Cycle::default() };
    Columns::default().fields(&example, cycle)
}

/// The columns of cycles of a machine: those of every oscillator, and what machines add.
pub(super) fn machine_cycles<'a, R: 'a>(
    cycle: impl Fn(&R) -> Option<Cycle> + Copy + 'a,
) -> Columns<'a, R> {
    let described = |cycle: Cycle| {
        let over = if cycle.overtakes { ", overtaking" } else { "" };
        format!("{} {}{over}", stability(cycle.stable), cycle.kind())
    };
    let columns = Columns::default()
        .file("kind", move |row| cycle(row).map(|it| it.kind()))
        .file("overtakes", move |row| cycle(row).map(|it| it.overtakes))
        .and(cycle_fields(cycle))
        .file("stick_duration", move |row| cycle(row).map(|it| it.stick_duration()))
        .text("cycle", move |row| cycle(row).map(described));
    of_machine().fold(columns, |columns, CycleNumber { name, unit, value, .. }| {
        let text = |cycle: Cycle| Quantity::of(unit, PLACES).text(value(&cycle));
        columns.text(name, move |row| cycle(row).map(text).unwrap_or_default())
    })
}
