//! How much friction a margin needs.

pub(crate) mod machine;
#[warn(clippy::missing_errors_doc)]
pub mod oscillator;
