//! The field of a half plane with coefficients in intervals.

use std::ops::Neg;

pub use crate::model::ParameterBox;
use crate::model::Side;
use crate::numerics::{Interval, times_power};

impl ParameterBox {
    /// The same parameters with lengths in units of `2^k`.
    pub fn in_units_of(&self, k: i32) -> Self {
        let d3 = scaled(scaled(self.d3, k), k);
        ParameterBox { d: self.d, d2: scaled(self.d2, k), d3, r: scaled(self.r, -k) }
    }

    /// Whether every parameter is a single double.
    #[must_use]
    pub fn is_point(&self) -> bool {
        self.numbers().iter().all(|it| it.is_point())
    }
}

/// `v' = -x - v (a + b v + c v^2)`, `x' = v`: the smooth field of one half plane in its own frame, in
/// which the motion runs from `(-z, 0)` through `v > 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldBox {
    /// `2 D`.
    pub a: Interval,
    /// `D2` above `v = 0`, `-D2` below.
    pub b: Interval,
    /// `D3`.
    pub c: Interval,
}

impl FieldBox {
    /// The field on one side of the switching line.
    pub fn new(parameters: &ParameterBox, side: Side) -> Self {
        let b = if side == Side::Upper {
            parameters.d2
        } else {
            -parameters.d2
        };
        FieldBox { a: parameters.d.twice(), b, c: parameters.d3 }
    }

    /// The field of motions run backward, in the frame `y = -x`.
    pub fn reversed(&self) -> Self {
        self.map(Neg::neg)
    }

    /// The field with these coefficients, as `of` makes them of its own.
    pub fn map(&self, of: impl Fn(Interval) -> Interval) -> Self {
        FieldBox { a: of(self.a), b: of(self.b), c: of(self.c) }
    }

    /// The same field for motions in units of `2^k`.
    pub fn in_units_of(&self, k: i32) -> Self {
        FieldBox { a: self.a, b: scaled(self.b, k), c: scaled(scaled(self.c, k), k) }
    }

    /// The member with the least damping: of all fields here its motion from a given start is the highest.
    pub fn weakest(&self) -> Self {
        self.map(|it| Interval::point(it.lower()))
    }

    /// The member with the most damping.
    pub fn strongest(&self) -> Self {
        self.map(|it| Interval::point(it.upper()))
    }

    /// Whether it is a single field.
    pub fn is_point(&self) -> bool {
        [self.a, self.b, self.c].iter().all(|it| it.is_point())
    }

    /// All accelerations at a point.
    pub fn acceleration(&self, x: Interval, v: Interval) -> Interval {
        -x - self.force(v)
    }

    /// All forces of the damping.
    pub fn force(&self, v: Interval) -> Interval {
        v * (self.a + v * (self.b + v * self.c))
    }

    /// The integral of the slope of the damping over time, from the duration, the way and the integral of `v^2`.
    pub fn integrated_slope(
        &self,
        duration: Interval,
        way: Interval,
        square: Interval,
    ) -> Interval {
        self.a * duration + (self.b * way).twice() + self.c * square * 3.0
    }

    /// All damping slopes `a + 2 b v + 3 c v^2`, minus the divergence of the field.
    pub fn slope(&self, v: Interval) -> Interval {
        v.polynomial(&[self.a, self.b.twice(), self.c * 3.0])
    }
}

/// `value * 2^k`; exact, unless it leaves the normal range, where it is widened by one double on each side.
pub fn scaled(value: Interval, k: i32) -> Interval {
    let bound = |bound: f64, widen: fn(f64) -> f64| {
        let scaled = times_power(bound, k);
        if times_power(scaled, -k) == bound {
            scaled
        } else {
            widen(scaled)
        }
    };
    Interval::new(bound(value.lower(), f64::next_down), bound(value.upper(), f64::next_up))
}
