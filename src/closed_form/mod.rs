//! What the paper gives in formulas, corrected and numerically safe.

pub mod harmonic;
pub mod linear;
pub mod piecewise_linear;
pub mod twofold;

#[cfg(test)]
#[rustfmt::skip]
#[expect(clippy::unreadable_literal, clippy::excessive_precision, reason = "a table of digits")]
mod reference;
