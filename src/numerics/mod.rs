//! Arithmetic used by every other ring, independent of oscillators.
//!
//! - Numbers: [`interval`] rounds outwards, [`twofold`] carries twice the digits, [`scalar`] says what both have in
//!   common with doubles, [`scaling`] multiplies by powers of two without error, [`sum`] compensates rounding,
//!   [`mod@count`] converts between counts and real numbers, orders by a number, goes in circles and leaves out
//!   repetitions, [`random`] simulates noise.
//! - Functions: [`elementary`] has those of the standard library, [`root`] finds zeros inside brackets, [`quadrature`]
//!   integrates, [`polynomial`] evaluates and interpolates by cubics, [`spline`] smooths measured points.
//! - Texts: [`mod@decimal`] writes numbers and steps from one round number to the next, [`mod@similar`] finds the name that was
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

pub(crate) use self::{
    count::*, decimal::*, elementary::*, polynomial::*, quadrature::*, random::*, root::*,
    scalar::*, scaling::*, similar::*, spline::*, sum::*, table::*, twofold::*,
};
pub use interval::Interval;
