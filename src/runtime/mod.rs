//! What runs: the loop, the worker, and the threads that listen to keyboard and signals.
//!
//! Everything that happens arrives as an [`Event`] in one channel. Three threads send into it, each
//! blocked in one place while nothing happens: [`input`] reads the terminal, [`signals`] waits for
//! signals, [`worker`] computes. The [`pump`] takes events out, hands them to the session, asks the
//! worker what the session then wants, and draws.

pub mod application;
pub mod bounded;
pub mod effects;
pub mod event;
pub mod explorer;
pub mod figure_writer;
pub mod headless;
pub mod input;
mod journal;
pub mod launch;
mod lines;
pub mod merging;
pub mod panics;
pub mod picture;
pub mod print;
pub mod provenance_file;
pub mod pump;
mod queue;
pub mod record;
pub mod scan_file;
pub mod scanning;
pub mod signals;
pub mod worker;
pub mod workers;

pub use application::Application;
pub use event::{Event, LoopEnd};
pub use explorer::{Explorer, explore, replay};
pub use launch::{Options, launch};
pub use pump::Pump;
pub use record::RecordingFile;
pub use worker::Worker;
