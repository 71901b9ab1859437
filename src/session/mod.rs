//! The session: a pure machine of state, commands and keys.

pub mod belt;
pub mod command;
pub mod config;
pub mod fit;
pub mod history;
pub mod input;
pub mod key;
pub mod keymap;
pub mod ledger;
pub mod line;
pub mod message;
pub mod motion;
pub mod opening;
pub mod overlay;
pub mod pending;
pub mod playback;
pub mod plot;
pub mod replay;
pub mod requirement;
pub mod save;
pub mod scan;
pub mod settings;
pub mod state;
pub mod step;
#[cfg(test)]
mod tests;
pub mod trade;
pub mod update;
pub mod variants;
pub mod walk;
pub mod wants;

pub use belt::Stand;
pub use command::{COMMANDS, Command};
pub use input::Input;
pub use key::{Code, Key};
pub use keymap::{Context, Hint, Keymap};
pub use line::{LINES, LineCommand};
pub use message::{Effect, Gesture, Msg, Place, Pointed, Purpose};
pub use overlay::{Entry, List, Listed, Overlay, Prompt};
pub use pending::Pending;
pub use plot::{Framing, Pane, Plot};
pub use scan::Scanned;
pub use state::{Notice, Price, ROWS, Row, Session, Size, Steps};
pub use update::update;
pub use variants::Shown;
pub use walk::Stop;
