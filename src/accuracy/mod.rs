//! What accuracy costs, and how far it can be trusted: references, methods against each other, the extremes.

pub mod extremes;
pub mod harmonic_error;
pub(crate) mod reference;
pub mod trade;

pub(crate) use self::{harmonic_error::*, reference::*, trade::*};
