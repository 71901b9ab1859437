//! One half swing with its derivatives, in the frame of its half plane ([`HalfPlane`]).
//!
//! Along with the motion `x' = v, v' = f(x, v)`, four solutions of the variational equation
//! `y' = w, w' = -y + (df/dv) w + g` are computed: a homogeneous one that starts across the flow, and those for D, D2
//! and D3 with `g = -2 v, -v^2, -v^3`. The Taylor coefficients of motion and derivatives obey one
//! recurrence.

use crate::model::HalfPlane;
use crate::numerics::{Bracket, PlaceTolerance, newton, pow, real};

/// Number of solutions of the variational equation: across the flow, and by D, D2 (of this frame) and D3.
pub const WAYS: usize = 4;

/// Order of the Taylor series.
const ORDER: usize = 18;

/// Largest truncation error of a step, relative to the state.
const TOLERANCE: f64 = 1e-13;

/// Longest step, too short for two arrivals at `v = 0`.
const LONGEST: f64 = 2.0;

/// `x`, `v`, then the derivatives of the position in the order of [`WAYS`], padded to a width that vectorizes.
type Lanes = [f64; 8];

/// The first of the derivatives among the lanes.
const FIRST: usize = 2;

/// A point of the motion with its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet {
    /// Position in the frame of the half plane.
    pub x: f64,
    /// Velocity.
    pub v: f64,
    /// Derivatives of the position.
    pub y: [f64; WAYS],
    /// Derivatives of the velocity.
    pub w: [f64; WAYS],
}

/// A part of a half swing that is described by one series.
#[derive(Clone, Debug)]
pub struct Stretch {
    field: HalfPlane,
    /// Whether derivatives are computed.
    with_derivatives: bool,
    /// Taylor coefficients.
    terms: Box<[Lanes; ORDER + 1]>,
    /// Time for which the series holds.
    pub duration: f64,
    /// Whether the stretch ends at `v = 0`.
    pub arrives: bool,
}

impl Stretch {
    /// The first stretch of the half swing from `start`; `None` if numbers overflow.
    pub fn new(field: HalfPlane, start: Jet, with_derivatives: bool) -> Option<Self> {
        let terms = Box::new([[0.0; 8]; ORDER + 1]);
        let mut first = Stretch { field, with_derivatives, terms, duration: 0.0, arrives: false };
        first.advance(start).then_some(first)
    }

    /// Replaces the stretch with the one that begins at `start`; `false` if numbers overflow.
    pub fn advance(&mut self, start: Jet) -> bool {
        let terms = &mut self.terms;
        let duration = if self.with_derivatives {
            expand::<true>(terms, &self.field, &start)
        } else {
            expand::<false>(terms, &self.field, &start)
        };
        let end = velocity(terms, duration);
        self.arrives = end <= 0.0;
        self.duration = if self.arrives { arrival(terms, duration) } else { duration };
        duration > 0.0 && end.is_finite()
    }

    /// The point `t` after the start of this stretch, without the derivatives of the velocity.
    #[inline]
    pub fn at(&self, t: f64) -> Jet {
        let mut sum = self.terms[ORDER];
        for term in self.terms[..ORDER].iter().rev() {
            for (sum, term) in sum.iter_mut().zip(term) {
                *sum = *sum * t + term;
            }
        }
        let [x, v, y @ .., _, _] = sum;
        Jet { x, v, y, ..Jet::default() }
    }

    /// The point `t` after the start of this stretch, with all derivatives.
    pub fn jet(&self, t: f64) -> Jet {
        let mut jet = self.at(t);
        for (order, term) in self.terms.iter().enumerate().skip(1).rev() {
            for (w, term) in jet.w.iter_mut().zip(&term[FIRST..]) {
                *w = *w * t + real(order) * term;
            }
        }
        jet
    }
}

/// Computes the Taylor coefficients; returns the time for which they are accurate enough.
fn expand<const DERIVATIVES: bool>(
    terms: &mut [Lanes; ORDER + 1],
    field: &HalfPlane,
    start: &Jet,
) -> f64 {
    let HalfPlane { d, d2, d3 } = *field;
    let mut v = [0.0; ORDER + 1];
    let mut square = [0.0; ORDER + 1];
    let mut slope = [0.0; ORDER + 1];
    let mut w = [[0.0; WAYS]; ORDER + 1];
    (terms[0][0], terms[0][1]) = (start.x, start.v);
    terms[0][FIRST..FIRST + WAYS].copy_from_slice(&start.y);
    v[0] = start.v;
    w[0] = start.w;
    for k in 0..ORDER {
        let (mut second, mut third) = (0.0, 0.0);
        for i in 0..=k {
            second += v[i] * v[k - i];
        }
        square[k] = second;
        for i in 0..=k {
            third += square[i] * v[k - i];
        }
        let part = 1.0 / real(k + 1);
        let x = terms[k][0];
        v[k + 1] = part * (-x - 2.0 * d * v[k] - d2 * second - d3 * third);
        terms[k + 1][0] = part * v[k];
        terms[k + 1][1] = v[k + 1];
        if DERIVATIVES {
            slope[k] = -2.0 * d2 * v[k] - 3.0 * d3 * second;
            if k == 0 {
                slope[0] -= 2.0 * d;
            }
            let mut sum = [0.0, -2.0 * v[k], -second, -third];
            for i in 0..=k {
                for (sum, w) in sum.iter_mut().zip(&w[k - i]) {
                    *sum += slope[i] * w;
                }
            }
            for way in 0..WAYS {
                w[k + 1][way] = part * (sum[way] - terms[k][FIRST + way]);
                terms[k + 1][FIRST + way] = part * w[k][way];
            }
        }
    }
    let size = start.x.abs().max(start.v.abs());
    let tail = |order: usize, size: f64| {
        let last = terms[order][0].abs().max(v[order].abs());
        pow(TOLERANCE * size / last, 1.0 / real(order))
    };
    let step = tail(ORDER, size).min(tail(ORDER - 1, size));
    // The caller refuses NaN. If the last terms are 0 the step is infinite and LONGEST applies.
    if step.is_nan() { step } else { step.min(LONGEST) }
}

fn velocity(terms: &[Lanes; ORDER + 1], t: f64) -> f64 {
    terms.iter().rev().fold(0.0, |sum, term| sum * t + term[1])
}

/// The first arrival at `v = 0` after the start, given `v(end) <= 0`.
///
/// A start at `v = 0` does not count: the polynomial is then divided by the factor of this root.
fn arrival(terms: &[Lanes; ORDER + 1], end: f64) -> f64 {
    let skip = usize::from(terms[0][1] == 0.0);
    let value = |t: f64| {
        let rest = terms[skip..].iter().rev();
        rest.fold((0.0, 0.0), |(value, slope), term| (value * t + term[1], slope * t + value))
    };
    let settled = PlaceTolerance::Absolute(2.0 * f64::EPSILON * end);
    newton(Bracket::falling(0.0, end), end, settled, value).at
}
