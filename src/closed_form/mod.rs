//! What the paper gives in formulas, corrected and numerically safe.
//!
//! Nothing here is integrated. [`linear`] and [`piecewise_linear`] are exact for `D2 = D3 = 0`;
//! [`harmonic`] (with its [`cubic`]) approximates cycles by one harmonic, [`harmonics`] by any number of
//! them, which takes linear algebra and Newton's method; [`lyapunov`] bounds the basin by a circle.
//! The numbers of [`crate::numerics`] keep the digits and the range which the formulas as printed lose.

pub(crate) mod cubic;
#[doc(hidden)]
pub mod harmonic;
#[doc(hidden)]
pub mod harmonics;
pub(crate) mod linear;
pub(crate) mod lyapunov;
pub mod piecewise_linear;

#[cfg(test)]
#[rustfmt::skip]
#[expect(clippy::unreadable_literal, clippy::approx_constant, reason = "a table of digits")]
mod reference;
