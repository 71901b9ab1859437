//! Machines by the whole model: friction by its own law, sticking to the belt, and overtaking it.

pub mod arc;
pub mod branch;
pub mod curve;
pub mod cycles;
pub mod design;
mod force;
pub mod landmarks;
pub mod ledger;
pub mod model;
pub mod motion;
pub mod portrait;
mod reach;
pub mod return_map;
pub mod search;
mod series;
pub mod special;
pub mod survey;
pub mod turn;
pub mod varied;

pub use arc::{Flow, Stop};
pub use cycles::Cycle;
pub use ledger::Ledger;
pub use model::{Lines, Model, Phase, Unfit};
pub use motion::Motion;
pub use portrait::{Border, Fate, Margin, Portrait};
