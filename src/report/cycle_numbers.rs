//! The numbers that describe a limit cycle, and the columns that show them.

use super::Columns;
use crate::numerics::Interval;
use crate::portrait::{Cycle, CycleErrors};
use crate::proof::Enclosure;
use crate::words::significant;

/// A number that describes a cycle.
pub(super) struct CycleNumber {
    pub name: &'static str,
    /// Its title in a table of a machine; empty if that does not show it.
    pub title: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// `None` where it overflows or underflows.
    pub value: fn(&Cycle) -> Option<f64>,
    /// Its logarithm, which exists then.
    logarithm: fn(&Cycle) -> f64,
    /// Where it is proved to lie; `None` if only machines have it.
    pub bounds: Option<fn(&Enclosure) -> Interval>,
}

impl CycleNumber {
    const fn new(
        name: &'static str,
        title: &'static str,
        unit: &'static str,
        value: fn(&Cycle) -> Option<f64>,
    ) -> Self {
        CycleNumber { name, title, unit, value, logarithm: |_| f64::NAN, bounds: None }
    }

    const fn within(self, bounds: fn(&Enclosure) -> Interval) -> Self {
        CycleNumber { bounds: Some(bounds), ..self }
    }

    const fn or_exp(self, logarithm: fn(&Cycle) -> f64) -> Self {
        CycleNumber { logarithm, ..self }
    }

    /// The name beside which `x` is the displacement.
    pub(super) fn physical_name(&self) -> String {
        self.name.replacen("q_", "x_", 1)
    }

    /// Of the oscillator of the paper.
    pub(super) fn text(&self, cycle: &Cycle, places: usize) -> String {
        let power = || format!("exp({})", significant((self.logarithm)(cycle), places));
        (self.value)(cycle).map_or_else(power, |value| significant(value, places))
    }
}

/// The numbers that describe a cycle.
pub(super) const NUMBERS: [CycleNumber; 8] = [
    CycleNumber::new("q_min", "x from", "m", |it| Some(it.q_min)).within(|it| it.q_min),
    CycleNumber::new("q_max", "to", "m", |it| Some(it.q_max)).within(|it| it.q_max),
    CycleNumber::new("v_min", "v from", "m/s", |it| Some(it.v_min)).within(|it| it.v_min),
    CycleNumber::new("v_max", "to", "m/s", |it| Some(it.v_max)).within(|it| it.v_max),
    CycleNumber::new("period", "period", "s", |it| Some(it.period)).within(|it| it.period),
    CycleNumber::new("stick_duration", "on the belt", "s", |it| Some(it.stick_duration())),
    CycleNumber::new("multiplier", "multiplier", "", |it| it.multiplier)
        .within(|it| it.multiplier)
        .or_exp(|it| it.log_multiplier),
    CycleNumber::new("clearance", "", "m", |it| Some(it.clearance).filter(|it| *it > 0.0))
        .within(|it| it.clearance)
        .or_exp(|it| it.log_clearance),
];

/// A column of text for each number of a cycle of the oscillator of the paper.
pub(super) fn number_columns<'a, R: 'a>(
    columns: Columns<'a, R>,
    cell: impl Fn(&R, &CycleNumber) -> String + Copy + 'a,
) -> Columns<'a, R> {
    let shown = NUMBERS.iter().filter(|number| number.bounds.is_some());
    shown.fold(columns, |all, number| all.text(number.name, move |row| cell(row, number)))
}

/// A column of files for each field of a cycle.
pub(super) fn cycle_fields<'a, R: 'a>(cycle: impl Fn(&R) -> Option<Cycle> + 'a) -> Columns<'a, R> {
    let example = Cycle { errors: Some(CycleErrors::default()), ..Cycle::default() };
    Columns::default().fields(&example, cycle)
}
