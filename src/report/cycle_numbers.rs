//! The numbers that describe a cycle, for tables and enclosures.

use super::columns::Columns;
use crate::numerics::Interval;
use crate::portrait::{Cycle, CycleErrors};
use crate::proof::Enclosure;
use crate::words::number::significant;

/// A number that describes a cycle.
pub(super) struct CycleNumber {
    pub name: &'static str,
    /// `None` where it overflows or underflows.
    value: fn(&Cycle) -> Option<f64>,
    /// Its logarithm, which exists then.
    logarithm: fn(&Cycle) -> f64,
    pub bounds: fn(&Enclosure) -> Interval,
}

/// The numbers that describe a cycle.
pub(super) const NUMBERS: [CycleNumber; 7] = {
    const fn number(
        name: &'static str,
        value: fn(&Cycle) -> Option<f64>,
        logarithm: fn(&Cycle) -> f64,
        bounds: fn(&Enclosure) -> Interval,
    ) -> CycleNumber {
        CycleNumber { name, value, logarithm, bounds }
    }
    [
        number("q_min", |it| Some(it.q_min), |_| f64::NAN, |it| it.q_min),
        number("q_max", |it| Some(it.q_max), |_| f64::NAN, |it| it.q_max),
        number("v_min", |it| Some(it.v_min), |_| f64::NAN, |it| it.v_min),
        number("v_max", |it| Some(it.v_max), |_| f64::NAN, |it| it.v_max),
        number("period", |it| Some(it.period), |_| f64::NAN, |it| it.period),
        number("multiplier", |it| it.multiplier, |it| it.log_multiplier, |it| it.multiplier),
        number(
            "clearance",
            |it| Some(it.clearance).filter(|it| *it > 0.0),
            |it| it.log_clearance,
            |it| it.clearance,
        ),
    ]
};

impl CycleNumber {
    pub(super) fn text(&self, cycle: &Cycle, places: usize) -> String {
        let power = || format!("exp({})", significant((self.logarithm)(cycle), places));
        (self.value)(cycle).map_or_else(power, |value| significant(value, places))
    }
}

/// A column of text for each of these numbers.
pub(super) fn number_columns<'a, R: 'a>(
    columns: Columns<'a, R>,
    cell: impl Fn(&R, &CycleNumber) -> String + Copy + 'a,
) -> Columns<'a, R> {
    let add = |all: Columns<'a, R>, number: &'static CycleNumber| {
        all.text(number.name, move |row| cell(row, number))
    };
    NUMBERS.iter().fold(columns, add)
}

/// A column of files for each field of a cycle.
pub(super) fn cycle_fields<'a, R: 'a>(cycle: impl Fn(&R) -> Option<Cycle> + 'a) -> Columns<'a, R> {
    let example = Cycle { errors: Some(CycleErrors::default()), ..Cycle::default() };
    Columns::default().fields(&example, cycle)
}
