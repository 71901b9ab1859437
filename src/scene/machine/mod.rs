//! Machines: masses on belts in physical units, read from files.

pub mod file;
pub mod library;
pub mod mode;
pub mod path;
pub mod table;
pub mod unlikely;

mod description;
mod running;
mod scaled;
mod setting;

pub use description::Machine;
pub use running::Running;
pub use scaled::ScaledMachine;
pub use setting::Setting;
