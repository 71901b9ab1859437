//! The smooth field on one side of `v = 0`, in a frame in which both sides look alike.
//!
//! On the upper side friction pulls with `-r`, on the lower with `+r`. With `x = q + r` above and
//! `x = -(q - r)`, `v -> -v`, `D2 -> -D2` below, both become the same smooth equation
//!
//! `x' = v,  v' = -x - 2 D v - D2 v^2 - D3 v^3,  v > 0`
//!
//! which no longer contains `r` (equation 14; the mirror symmetry of equation 4). A half swing starts
//! at `(-c, 0)`, where `c` is the clearance `abs(q) - r` of its turning point from the sticking set,
//! and ends at `(X, 0)`; the next clearance is `X - 2 r`.

use std::fmt::Debug;

use super::{Parameters, State};
use crate::numerics::{Scalar, times_power};

/// A side of the switching line `v = 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// `v > 0`.
    Upper,
    /// `v < 0`.
    Lower,
}

impl Side {
    /// The side into which a motion through `state` continues, or `None` where it rests.
    ///
    /// The side follows from the sign of `v`; on `v = 0` from `q` alone, which must lie beyond the
    /// sticking set.
    #[must_use]
    pub fn entered_from(state: State, r: f64) -> Option<Self> {
        if state.v > 0.0 || (state.v == 0.0 && state.q < -r) {
            Some(Side::Upper)
        } else if state.v < 0.0 || (state.v == 0.0 && state.q > r) {
            Some(Side::Lower)
        } else {
            None
        }
    }

    /// The other side.
    #[must_use]
    pub fn opposite(self) -> Self {
        if self == Side::Upper {
            Side::Lower
        } else {
            Side::Upper
        }
    }

    /// `+1` above, `-1` below.
    #[must_use]
    pub fn sign(self) -> f64 {
        if self == Side::Upper { 1.0 } else { -1.0 }
    }

    /// Displacement `q` of a point `x` of this side's frame.
    #[must_use]
    pub fn displacement<N: Scalar>(self, x: N, r: f64) -> N {
        N::from(self.sign()) * (x - N::from(r))
    }

    /// Position `x` in this side's frame of a displacement `q`.
    #[must_use]
    pub fn position<N: Scalar>(self, q: N, r: f64) -> N {
        N::from(self.sign()) * q + N::from(r)
    }
}

/// Damping of one side: the right-hand side without friction, as seen in the side's own frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[must_use]
pub struct HalfPlane {
    /// Linear damping D.
    pub d: f64,
    /// Asymmetric damping in this frame: `D2` above, `-D2` below.
    pub d2: f64,
    /// Cubic damping D3.
    pub d3: f64,
}

impl HalfPlane {
    /// The field on one side of the switching line.
    pub fn new(parameters: &Parameters, side: Side) -> Self {
        HalfPlane { d: parameters.d, d2: side.sign() * parameters.d2, d3: parameters.d3 }
    }

    /// The field of motions run backward: with time reversed, `y = -x` obeys the same equation with all
    /// damping of the opposite sign.
    pub fn reversed(&self) -> Self {
        HalfPlane { d: -self.d, d2: -self.d2, d3: -self.d3 }
    }

    /// Whether the field is linear.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.d2 == 0.0 && self.d3 == 0.0
    }
}

/// A smooth field `x' = v, v' = acceleration(x, v)` with `acceleration = -x - (a function of v)`.
pub trait Field: Copy + Debug {
    /// The acceleration `v'`.
    fn acceleration(&self, x: f64, v: f64) -> f64;

    /// Divergence of the field, i.e. the derivative of the acceleration by v; the Jacobian is `[[0, 1], [-1, this]]`.
    fn divergence(&self, v: f64) -> f64;
}

/// A field of the oscillator: on one side of `v = 0`, or on both with friction that is no longer set-valued.
pub trait PlaneField: Field {
    /// The same field for a motion measured in units of `2^k`, exactly.
    #[must_use]
    fn in_units(&self, k: i32) -> Self;

    /// Sum of the magnitudes of all terms of the acceleration, the scale of its rounding error.
    fn magnitude(&self, x: f64, v: f64) -> f64;

    /// The field without friction, which alone drives an escape.
    fn frictionless(&self) -> HalfPlane;
}

/// Equation 8 in the frame of this side.
impl Field for HalfPlane {
    #[inline]
    fn acceleration(&self, x: f64, v: f64) -> f64 {
        -x - v * (2.0 * self.d + v * (self.d2 + v * self.d3))
    }

    #[inline]
    fn divergence(&self, v: f64) -> f64 {
        -(2.0 * self.d + v * (2.0 * self.d2 + v * 3.0 * self.d3))
    }
}

/// D2 is multiplied by `2^k`, D3 by `2^(2 k)` (the scaling symmetry of equation 4).
impl PlaneField for HalfPlane {
    fn in_units(&self, k: i32) -> Self {
        HalfPlane {
            d: self.d,
            d2: times_power(self.d2, k),
            d3: times_power(times_power(self.d3, k), k),
        }
    }

    fn magnitude(&self, x: f64, v: f64) -> f64 {
        let v = v.abs();
        x.abs() + v * (2.0 * self.d.abs() + v * (self.d2.abs() + self.d3.abs() * v))
    }

    fn frictionless(&self) -> HalfPlane {
        *self
    }
}
