//! Kicks that are survived for certain, whatever is not known exactly and whatever disturbs.

#[doc(hidden)]
pub mod machine;
#[warn(clippy::missing_errors_doc)]
pub mod oscillator;
