//! The session: a pure machine of state, commands and keys.

pub mod key;
pub mod message;

pub use key::{Code, Key};
pub use message::{Effect, Msg};
