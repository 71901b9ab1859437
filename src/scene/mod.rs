//! What is on show: a scene, the requests it needs answered, and their answers.

pub mod answer;
pub mod request;

pub use answer::{Answer, Answered};
pub use request::{Request, Slot};
