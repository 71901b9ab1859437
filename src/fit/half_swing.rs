//! One half swing with its derivatives, in the frame of its half plane ([`HalfPlane`]).
//!
//! Along with the motion `x' = v, v' = f(x, v)`, four solutions of the variational equation
//! `y' = w, w' = -y + (df/dv) w + g` are computed: a homogeneous one that starts across the flow, and those for
//! D, D2 and D3 with `g = -2 v, -v^2, -v^3`. All other derivatives are combinations of these and of the flow
//! itself: a shift of the start splits into a part along the flow, which only delays the motion, and a part
//! across it. If the damping is linear and stays so, everything has a closed form; otherwise the Taylor
//! coefficients of motion and derivatives obey one recurrence.

use crate::model::HalfPlane;
use crate::numerics::count::real;
use crate::numerics::elementary::{atan2, exp, pow, sin_cos};
use crate::numerics::root::{Bracket, PlaceTolerance, newton};

/// Number of solutions of the variational equation: across the flow, and the derivatives with respect to D, D2 (of
/// this frame) and D3.
pub const WAYS: usize = 4;

/// Order of the Taylor series.
const ORDER: usize = 18;

/// Largest truncation error of a step, relative to the state.
const TOLERANCE: f64 = 1e-13;

/// Longest step, too short for two arrivals at `v = 0`.
const LONGEST: f64 = 2.0;

/// `x`, `v`, then the derivatives of the position in the order of [`WAYS`], padded to a width that vectorizes.
type Lanes = [f64; 8];

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

/// A part of a half swing that is described by one formula.
#[derive(Clone, Debug)]
pub struct Stretch {
    field: HalfPlane,
    /// Whether derivatives are computed.
    with_derivatives: bool,
    formula: Formula,
    /// Time for which the formula holds.
    pub duration: f64,
    /// Whether the stretch ends at `v = 0`.
    pub arrives: bool,
}

#[derive(Clone, Debug)]
enum Formula {
    /// The linear oscillation from this point, `abs(D) < 1`, with frequency `omega`.
    Linear { start: Jet, omega: f64 },
    /// Taylor coefficients.
    Series(Box<[Lanes; ORDER + 1]>),
}

/// Damping above which the closed form loses digits because `omega` is small.
const OSCILLATORY: f64 = 0.9;

impl Stretch {
    /// The first stretch of the motion from `start`; in closed form if `linear` is set and the damping allows it.
    /// `linear` requires `D2 = D3 = 0` and leaves out the derivatives with respect to them.
    ///
    /// `None` if numbers overflow.
    pub fn new(field: HalfPlane, start: Jet, linear: bool, with_derivatives: bool) -> Option<Self> {
        if linear && field.d.abs() < OSCILLATORY {
            return Some(Self::linear(field, start, with_derivatives));
        }
        let empty = Formula::Series(Box::new([[0.0; 8]; ORDER + 1]));
        let mut stretch =
            Stretch { field, with_derivatives, formula: empty, duration: 0.0, arrives: false };
        stretch.advance(start).then_some(stretch)
    }

    fn linear(field: HalfPlane, start: Jet, with_derivatives: bool) -> Self {
        let omega = ((1.0 - field.d) * (1.0 + field.d)).sqrt();
        let phase = atan2(omega * start.v, start.x + field.d * start.v);
        let formula = Formula::Linear { start, omega };
        Stretch { field, with_derivatives, formula, duration: phase / omega, arrives: true }
    }

    /// Replaces the stretch with the one that begins at `start`; `false` if numbers overflow.
    pub fn advance(&mut self, start: Jet) -> bool {
        let Formula::Series(terms) = &mut self.formula else { return false };
        let duration = if self.with_derivatives {
            expand::<true>(terms, &self.field, &start)
        } else {
            expand::<false>(terms, &self.field, &start)
        };
        self.duration = duration;
        self.arrives = false;
        if !(duration > 0.0 && velocity(terms, duration).is_finite()) {
            return false;
        }
        if velocity(terms, duration) <= 0.0 {
            self.duration = arrival(terms, duration);
            self.arrives = true;
        }
        true
    }

    /// Position, velocity, and the derivatives of the position.
    #[inline]
    pub fn at(&self, t: f64) -> (f64, f64, [f64; WAYS]) {
        match &self.formula {
            Formula::Linear { .. } => {
                let Jet { x, v, y, .. } = self.jet(t);
                (x, v, y)
            }
            Formula::Series(terms) => {
                let mut sum = terms[ORDER];
                for term in terms[..ORDER].iter().rev() {
                    for (sum, term) in sum.iter_mut().zip(term) {
                        *sum = *sum * t + term;
                    }
                }
                (sum[0], sum[1], [sum[2], sum[3], sum[4], sum[5]])
            }
        }
    }

    /// The point `t` after the start of this stretch, with all derivatives.
    pub fn jet(&self, t: f64) -> Jet {
        match &self.formula {
            Formula::Linear { start, omega } => linear_jet(self.field.d, *omega, start, t),
            Formula::Series(terms) => {
                let (x, v, y) = self.at(t);
                let mut w = [0.0; WAYS];
                for (order, term) in terms.iter().enumerate().skip(1).rev() {
                    for (w, term) in w.iter_mut().zip(&term[2..]) {
                        *w = *w * t + real(order) * term;
                    }
                }
                Jet { x, v, y, w }
            }
        }
    }
}

/// The linear oscillation: `C = cos(omega t)`, `S = sin(omega t)/omega`, both times `e^(-D t)`.
fn linear_jet(d: f64, omega: f64, start: &Jet, t: f64) -> Jet {
    let decay = exp(-d * t);
    let (sine, cosine) = sin_cos(omega * t);
    let (c, s) = (decay * cosine, decay * sine / omega);
    let flow = |x: f64, v: f64| (c * x + s * (v + d * x), c * v - s * (x + d * v));
    let (x, v) = flow(start.x, start.v);
    // dC/dD = t D S and dS/dD = -D (t C - S)/omega^2; the decay adds a factor -t.
    let bend = d / (omega * omega);
    let (c_by_d, s_by_d) = (t * (d * s - c), -t * s - bend * (t * c - s));
    let mut jet = Jet { x, v, ..Jet::default() };
    (jet.y[0], jet.w[0]) = flow(start.y[0], start.w[0]);
    let (y, w) = flow(start.y[1], start.w[1]);
    jet.y[1] = y + c_by_d * start.x + s_by_d * (start.v + d * start.x) + s * start.x;
    jet.w[1] = w + c_by_d * start.v - s_by_d * (start.x + d * start.v) - s * start.v;
    jet
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
    let [y0, y1, y2, y3] = start.y;
    terms[0] = [start.x, start.v, y0, y1, y2, y3, 0.0, 0.0];
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
                w[k + 1][way] = part * (sum[way] - terms[k][2 + way]);
                terms[k + 1][2 + way] = part * w[k][way];
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
    newton(
        Bracket::falling(0.0, end),
        end,
        PlaceTolerance::Absolute(2.0 * f64::EPSILON * end),
        value,
    )
    .at
}
