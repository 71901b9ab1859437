//! Arithmetic used by every other ring, independent of oscillators.
//!
//! - Numbers: [`interval`] rounds outwards, [`twofold`] carries twice the digits, [`scalar`] says what both have in
//!   common with doubles, [`scaling`] multiplies by powers of two without error, [`sum`] compensates rounding,
//!   [`mod@count`] converts between counts and real numbers, and leaves out repetitions, [`random`] simulates noise.
//! - Functions: [`elementary`] has those of the standard library, [`root`] finds zeros inside brackets, [`quadrature`]
//!   integrates, [`polynomial`] evaluates and interpolates by cubics, [`spline`] smooths measured points.
//! - Texts: [`mod@decimal`] writes numbers and steps from one round number to the next, [`similar`] finds the name that was
//!   meant, [`table`] reads the tables of the program and the names in them.

pub(crate) mod count;
pub(crate) mod decimal;
pub mod elementary;
pub(crate) mod interval;
pub(crate) mod polynomial;
pub(crate) mod quadrature;
pub mod random;
pub(crate) mod root;
pub(crate) mod scalar;
pub mod scaling;
pub(crate) mod similar;
pub(crate) mod spline;
pub(crate) mod sum;
pub(crate) mod table;
pub mod twofold;

pub(crate) use count::{amount, distinct, real, reciprocals, truncated};
pub(crate) use decimal::{StepSize, brief, decade, decimal, shortest};
pub(crate) use elementary::{
    asin, atan, atan2, cbrt, cos, erfc, exp, exp_m1, exp2, hypot, ln, ln_1p, log2, log10, pow,
    powi, sin, sin_cos, tanh,
};
pub use interval::Interval;
pub(crate) use polynomial::Hermite;
pub(crate) use quadrature::{Integral, integrate};
pub(crate) use random::Random;
pub(crate) use root::{
    Bracket, PlaceTolerance, TO_ROUNDING, bisect, illinois, maximum, newton, try_bisect,
    try_maximum, try_newton,
};
pub(crate) use scalar::Scalar;
pub(crate) use scaling::{exponent, rough_exp2, rough_log2, times_power};
pub(crate) use similar::most_similar;
pub(crate) use spline::SmoothingSpline;
pub(crate) use sum::Sum;
pub(crate) use table::{cells, named};
pub(crate) use twofold::Twofold;
