//! What accuracy costs, and how far it can be trusted: references, methods against each other, the extremes.

#[doc(hidden)]
pub mod extremes;
#[doc(hidden)]
pub mod harmonic_error;
#[doc(hidden)]
pub(crate) mod reference;
#[doc(hidden)]
pub mod trade;
