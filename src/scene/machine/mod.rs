//! Machines: masses on belts in physical units, read from files, to be computed with and looked at.

pub mod file;
pub mod library;
pub mod mode;
pub mod path;
pub mod table;
pub mod unit;

mod description;
mod rig;
mod running;

pub use description::Machine;
pub use rig::Rig;
pub use running::Running;
