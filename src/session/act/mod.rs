//! The effects of commands on a session, one family of commands per file.

pub mod answers;
pub mod copy;
pub mod files;
pub mod general;
pub mod history;
pub mod lists;
pub mod motions;
pub mod notice;
pub mod parameters;
pub mod plots;
pub mod prompt;
pub mod scan;
pub mod screen_setup;
pub mod values;
pub mod walk;

pub(crate) use notice::{attempt, inform, inform_of_keys, refuse, warn_of_units, with_keys};
