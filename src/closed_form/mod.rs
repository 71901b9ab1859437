//! What the paper gives in formulas, corrected and numerically safe.
//!
//! Nothing here is integrated. [`linear`] and [`piecewise_linear`] are exact for `D2 = D3 = 0`;
//! [`harmonic`] (with its [`cubic`]) approximates cycles by one harmonic, [`harmonics`] by any number of
//! them, which takes linear algebra and Newton's method; [`lyapunov`] bounds the basin by a circle.
//! [`twofold`] and [`wide`] are the two kinds of number that keep the digits and the range which the
//! formulas as printed lose.

pub mod cubic;
pub mod harmonic;
pub mod harmonics;
pub mod linear;
pub mod lyapunov;
pub mod piecewise_linear;
pub mod twofold;
pub mod wide;

#[cfg(test)]
#[rustfmt::skip]
#[expect(clippy::unreadable_literal, clippy::approx_constant, reason = "a table of digits")]
mod reference;
