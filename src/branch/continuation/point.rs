//! Points of a curve of cycles, and directions along it.

use crate::model::Parameters;
use crate::numerics::{hypot, range};
use crate::portrait::{Route, SwingPair};

/// Length of u that counts as much as the whole range of the parameter.
pub(crate) const UNIT_OF_U: f64 = 4.0;

/// A cycle on the curve.
#[derive(Clone, Copy)]
pub struct CurvePoint {
    /// The unknown `ln c0`.
    pub u: f64,
    /// The parameter.
    pub p: f64,
    /// The closed pair of swings.
    pub closing: SwingPair,
    /// Logarithm of the Floquet multiplier; it changes its sign at a fold.
    pub log_multiplier: f64,
}

impl CurvePoint {
    /// The cycle of a closing at a value of the parameter.
    pub fn of(closing: SwingPair, p: f64, parameters: &Parameters) -> Self {
        let log_multiplier = closing.log_multiplier(parameters);
        CurvePoint { u: closing.node.at, p, closing, log_multiplier }
    }

    /// The route on which its swings are computed best.
    pub fn route(&self) -> Route {
        Route::steadiest(self.closing.growth)
    }
}

/// A direction in the scaled plane, of length 1.
#[derive(Clone, Copy)]
pub struct Tangent {
    /// Component along `u/UNIT_OF_U`.
    pub u: f64,
    /// Component along `p/range`.
    pub p: f64,
}

impl Tangent {
    /// Along u: a correction across it changes only the parameter.
    pub const ACROSS_P: Tangent = Tangent { u: 1.0, p: 0.0 };

    /// Along p: a correction across it changes only u.
    pub const ACROSS_U: Tangent = Tangent { u: 0.0, p: 1.0 };

    /// From one point to another, with how far they are apart.
    pub(crate) fn between(from: &CurvePoint, to: &CurvePoint, scale: f64) -> (Self, f64) {
        let (u, p) = ((to.u - from.u) / UNIT_OF_U, (to.p - from.p) / scale);
        let length = hypot(u, p);
        (Tangent { u: u / length, p: p / length }, length)
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        Tangent { u: factor * self.u, p: factor * self.p }
    }

    pub(crate) fn dot(self, other: Tangent) -> f64 {
        self.u * other.u + self.p * other.p
    }
}

/// Whether a place `(u, p)` of a curve can be one between two neighbouring points: beside the chord, and no further from
/// it than a bend of the curve allows.
pub fn is_beside([one, other]: [&CurvePoint; 2], (u, p): (f64, f64), scale: f64) -> bool {
    /// Distance from the chord, as a part of it, and what counts as nothing along it.
    const BULGE: f64 = 0.5;
    const SLACK: f64 = 1e-9;
    let (chord, length) = Tangent::between(one, other, scale);
    let (u, p) = ((u - one.u) / UNIT_OF_U, (p - one.p) / scale);
    let (along, across) = (u * chord.u + p * chord.p, u * chord.p - p * chord.u);
    (-SLACK..=length + SLACK).contains(&along) && across.abs() <= BULGE * length + SLACK
}

/// Whether a curve that is a graph over the amplitude goes through that of a point.
pub fn covers(curve: &[CurvePoint], point: &CurvePoint) -> bool {
    let beyond = |it: &CurvePoint| it.u > point.u;
    curve.iter().any(beyond) && !curve.iter().all(beyond)
}

/// Whether a curve passes a point: between neighbours in p, and close in u.
pub fn passes(curve: &[CurvePoint], point: &CurvePoint) -> bool {
    curve.windows(2).any(|pair| {
        let (one, other) = (&pair[0], &pair[1]);
        let (low, high) = range([one.p, other.p]);
        let slack = 1e-9 * (high - low);
        if point.p < low - slack || point.p > high + slack {
            return false;
        }
        let fraction = if one.p == other.p {
            0.5
        } else {
            (point.p - one.p) / (other.p - one.p)
        };
        let u = one.u + fraction * (other.u - one.u);
        (u - point.u).abs() <= 0.25 * (other.u - one.u).abs() + 1e-6
    })
}
