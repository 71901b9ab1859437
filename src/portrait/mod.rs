//! What an oscillator does: its limit cycles, what borders the basin of rest, and the kicks that it survives.

mod border;
mod cycle;
mod gaps;
mod margin;
#[expect(clippy::module_inception, reason = "the portrait itself, beside what belongs to it")]
mod portrait;
mod without_belt;

pub use border::Border;
pub use cycle::{Cycle, CycleErrors, Ride};
pub use margin::{Margin, Reach, RestMargin};
pub use portrait::Portrait;
