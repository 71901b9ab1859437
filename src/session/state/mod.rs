//! The state of a session: plain data.

pub mod answers;
pub mod history;
pub mod keymap;
pub mod overlay;
pub mod scan;
pub mod session;
pub mod settings;
pub mod setup;
