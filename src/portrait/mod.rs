//! What an oscillator does: its limit cycles, what borders the basin of rest, and the kicks that it survives.

mod border;
mod cycle;
mod margin;

pub use border::Border;
pub use cycle::{Cycle, CycleErrors, Ride};
pub use margin::{Margin, Reach, RestMargin};
