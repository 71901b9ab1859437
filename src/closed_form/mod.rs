//! What the paper gives in formulas, corrected and numerically safe.
//!
//! Nothing here is integrated. [`linear`] and [`piecewise_linear`] are exact for `D2 = D3 = 0`;
//! [`harmonic`] (with its [`cubic`]) approximates cycles by one harmonic, [`harmonics`] by any number of
//! them, which takes linear algebra and Newton's method; [`lyapunov`] bounds the basin by a circle.
//! The numbers of [`crate::numerics`] keep the digits and the range which the formulas as printed lose.
//!
//! ```
//! use hopfscope::closed_form::piecewise_linear::{LinearCycle, NoCycle};
//!
//! // Without D2 and D3 the cycle grows in proportion to the friction, and it is unstable.
//! let (one, twice) = (LinearCycle::new(-0.1, 0.5)?, LinearCycle::new(-0.1, 1.0)?);
//! assert!((twice.q_max / one.q_max - 2.0).abs() < 1e-14);
//! assert!(one.log_multiplier > 0.0);
//! # Ok::<(), NoCycle>(())
//! ```

pub(crate) mod cubic;
#[doc(hidden)]
pub mod harmonic;
#[doc(hidden)]
pub mod harmonics;
pub(crate) mod linear;
pub(crate) mod lyapunov;
pub mod piecewise_linear;

#[cfg(test)]
mod reference;
