//! What can be measured at a point of a scan.
//!
//! [`MEASURES`] is the one table: what a measure is called, what it means and which columns it fills;
//! [`Measure::with`] says with which other it is computed. Each computation is done at most once for a point, however
//! many measures rest on it.

mod point;
mod row;
mod settling;
mod table;

pub use row::{ScanRow, measure};
pub use table::{
    Conditions, MEASURES, Measure, MeasureSpec, OF_THE_PAPER, Origin, Value, holds_words, is_regime,
};

#[cfg(test)]
mod tests;
