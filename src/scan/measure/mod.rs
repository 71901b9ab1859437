//! What can be measured at a point of a scan.
//!
//! [`MEASURES`] is the one table: what a measure is called, what it means, which columns it fills and
//! which computations it [`MeasureNeed`]s. [`ScanPoint`], and [`MachinePoint`] by the whole model of a machine, does each of
//! these at most once for a point, however many measures ask for it.

mod machine;
mod point;
mod table;

pub use machine::MachinePoint;
pub use point::{ScanPoint, measure};
pub use table::Conditions;
pub use table::{MEASURES, Measure, MeasureNeed, MeasureSpec, OF_THE_PAPER, Value, needs_of};
