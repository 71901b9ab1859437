//! Questions that the screen asks, and their answers.
//!
//! A [`Request`] names exactly the inputs of one question, its [`Topic`] what it is about, and [`answer_for`] is
//! the only place where a question becomes a computation. What is asked about a machine is asked by the same
//! request as about the oscillator of the paper, with the machine in it. What a user says about a record beside its
//! file is read by [`record`], on the command line and in the explorer.

pub mod answer;
pub mod fit;
pub mod record;
pub mod request;
pub mod zones;

pub use self::{answer::*, fit::*, request::*, zones::*};
