//! The screen: what a session looks like.
pub mod dots;
pub mod look;
pub mod number;
pub mod ticks;
