//! The session: a pure machine of state, commands and keys.

pub mod history;
pub mod key;
pub mod message;
pub mod overlay;
pub mod replay;
pub mod settings;
pub mod state;
pub mod step;

pub use key::{Code, Key};
pub use message::{Effect, Msg};
pub use overlay::{Entry, List, Overlay};
pub use state::{Framing, Notice, Plot, Price, ROWS, Row, Session, Size, Steps};
