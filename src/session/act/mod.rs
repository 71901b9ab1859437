//! The effects of commands on a session, one family of commands per file.

pub mod answers;
pub mod axes;
pub mod copy;
pub mod entry;
pub mod files;
pub mod focus;
pub mod general;
pub mod history;
pub mod lists;
pub mod marks;
pub mod measurement;
pub mod mouse;
pub mod notice;
pub mod palette;
pub mod parameters;
pub mod pending;
pub mod playback;
pub mod plots;
pub mod prompt;
pub mod scan;
pub mod screen_setup;
pub mod starts;
pub mod typing;
pub mod values;
pub mod walk;
