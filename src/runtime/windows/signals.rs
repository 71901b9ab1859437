//! The signals of Windows: Ctrl-C, which in raw mode is a key, and an end that is asked for. The console itself tells its
//! size, and no shell continues a program.

use std::io;

use crossbeam_channel::Sender;
use signal_hook::consts::{SIGINT, SIGTERM};

use super::Event;
use crate::terminal::Guard;

/// The number that the signal of a terminal that is gone has elsewhere.
pub const SIGHUP: i32 = 1;

pub const STOPPING: [i32; 2] = [SIGINT, SIGTERM];

pub fn start(_: Sender<Event>, _: Guard) -> io::Result<()> {
    Ok(())
}

pub fn can_be_continued() -> bool {
    false
}

pub fn stop() -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

pub use stop as suspend_job;
