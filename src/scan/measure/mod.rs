//! What can be measured at a point of a scan.
//!
//! [`MEASURES`] is the one table: what a measure is called, what it means, which columns it fills and
//! with which other it is computed. Each computation is done at most once for a point, however many measures rest on it.

mod machine;
mod oscillator;
mod row;
mod settling;
mod table;

pub use row::ScanRow;
pub use table::{Conditions, MEASURES, Measure, MeasureSpec, OF_THE_PAPER, Value, computed};

use super::source::ScanSource;
use crate::flow::{Limits, Reason};
use machine::MachinePoint;
use oscillator::OscillatorPoint;
use row::Cells;

/// Fills the columns of these measures at a point, in their order. What could not be computed is [`Value::Nothing`],
/// and [`ScanRow::reason`] says why. Fails with [`Reason::Interrupted`], and no other.
pub fn measure(
    source: &ScanSource,
    measures: &[Measure],
    conditions: &Conditions,
    limits: &Limits,
) -> Result<ScanRow, Reason> {
    let mut cells = Cells::new(measures, conditions);
    let wanted = computed(measures);
    match source {
        ScanSource::Oscillator(problem) => {
            let mut point = OscillatorPoint::new(problem, limits);
            cells.compute(wanted, limits, |measure, cells| point.compute(measure, cells))?;
        }
        ScanSource::Machine(problem) => {
            let mut point = MachinePoint::new(problem);
            let wanted = MachinePoint::computed(wanted);
            cells.compute(wanted, limits, |measure, cells| point.compute(measure, cells))?;
        }
    }
    Ok(cells.row())
}

#[cfg(test)]
mod tests;
