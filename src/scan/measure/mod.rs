//! What can be measured at a point of a scan.
//!
//! [`MEASURES`] is the one table: what a measure is called, what it means and which columns it fills;
//! [`Measure::with`] says with which other it is computed. Each computation is done at most once for a point, however many measures rest on it.

mod point;
mod row;
mod settling;
mod table;

pub use row::ScanRow;
pub use table::{Conditions, MEASURES, Measure, MeasureSpec, OF_THE_PAPER, Value};

use std::collections::BTreeSet;

use crate::flow::{Limits, Reason, Subject};
use row::Cells;

/// Fills the columns of these measures at a point, in their order. What could not be computed is [`Value::Nothing`],
/// and [`ScanRow::reason`] says why. Fails with [`Reason::Interrupted`], and no other.
pub fn measure(
    subject: &Subject,
    measures: &[Measure],
    conditions: &Conditions,
    limits: &Limits,
) -> Result<ScanRow, Reason> {
    // Those with which each of them is computed.
    let mut wanted: BTreeSet<_> = measures.iter().map(|measure| measure.with()).collect();
    // Of a machine cycles and margin are one computation, on which repeated kicks rest.
    if subject.paper().is_none()
        && (wanted.remove(&Measure::Margin) || wanted.contains(&Measure::Repeated))
    {
        wanted.insert(Measure::Cycles);
    }
    let stops = || if (limits.interrupted)() { Err(Reason::Interrupted) } else { Ok(()) };
    let mut cells = Cells::new(subject, measures, conditions, limits);
    for measure in wanted {
        stops()?;
        let computed = cells.compute(measure);
        stops()?;
        if let Err(why) = computed {
            cells.reasons.push(format!("{}: {why}", measure.spec().name));
        }
    }
    Ok(cells.row())
}

#[cfg(test)]
mod tests;
