//! The running program: the loop, the workers, and the threads that listen to keyboard and signals.
//!
//! Everything that happens arrives as an [`Event`] in one channel. Several threads send into it, each blocked
//! in one place while nothing happens: [`input`] reads the terminal, [`signals`] waits for signals, and those of
//! [`workers`] compute, or write a figure. The [`pump`] takes events out, hands
//! them to the session, passes the session's requests to the workers, and draws.

pub mod application;
pub mod arrays;
pub mod bounded;
pub mod effects;
pub mod explorer;
pub mod failure;
pub mod input;
mod journal;
pub mod launch;
pub mod new_file;
pub mod packed;
pub mod panics;
#[cfg(feature = "parquet")]
mod parquet;
pub mod print;
pub mod provenance_file;
pub mod pump;
pub mod record;
pub mod scan_file;
pub mod scan_part;
pub mod scanning;
#[cfg(unix)]
pub mod signals;
pub mod standard;
#[cfg_attr(windows, path = "windows/system.rs")]
mod system;
pub mod wav;
pub mod workers;

pub use self::{
    application::*,
    effects::Files,
    explorer::*,
    failure::Failure,
    launch::launch,
    new_file::{NewFile, Readers},
    pump::*,
    record::*,
    scan_file::ScanFile,
    scan_part::*,
    standard::tell,
    workers::*,
};
