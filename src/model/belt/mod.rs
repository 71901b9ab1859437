//! A mass on a moving belt: the machine behind the equation, in physical units.
//!
//! A mass `m` on a spring `c` with dampers `d1`, `d3` and a friction element `R` is pressed with the
//! force `F` onto a belt that runs at `v0`. The belt pulls it along with the friction `F mu(v0 - x')`, so
//! that with `x` counted from the displacement `x0 = F mu(v0)/c` at which it rests
//!
//! `m x'' + d1 x' + d3 x'^3 + c x - F [mu(v0 - x') - mu(v0)]  in  [-R, R]`
//!
//! (equations 1 and 2). Where friction falls with velocity it feeds the motion. [`Belt::reduce`] makes
//! the four dimensionless parameters of it, and the units in which they count. Quantities in this module
//! are in SI units.

pub mod friction;
pub mod reduce;

pub(crate) use friction::*;
pub use friction::{Belt, Derivatives, FrictionLaw};
pub use reduce::{ReducedBelt, TaylorError, Units};

#[cfg(test)]
pub(crate) mod tests;
