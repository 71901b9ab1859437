//! The state of a session: plain data.

pub mod answers;
pub mod command;
pub mod context;
pub mod history;
pub mod input;
pub mod kept;
pub mod keymap;
pub mod marks;
pub mod overlay;
pub mod pending;
pub mod playback;
pub mod plot;
pub mod rows;
pub mod scan;
pub mod scan_form;
pub mod session;
pub mod settings;
pub mod setup;
pub mod starts;
pub mod step_size;
pub mod stop;
pub mod uncertainty;
pub mod waiting;
