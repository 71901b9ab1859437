//! Machines: masses on belts in physical units, read from files.

pub mod file;
pub mod library;
pub mod path;
pub mod table;
pub mod unlikely;

mod description;

pub use description::{Description, Machine, NO_BELT, ScaledMachine, Setting};
