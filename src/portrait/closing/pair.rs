//! A pair of half swings, whether it closes or not, and the errors of its numbers.

use super::{Errors, Length, Node, UNIT};
use crate::model::Parameters;
use crate::numerics::{ln, ln_1p};

/// The two swings at one value of the unknown, and how far they are from closing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingPair {
    /// The unknown, and the residual as a difference of two increasing functions of it.
    pub node: Node,
    /// Clearances at which the first and the second swing start.
    pub clearances: [Length; 2],
    /// Duration of both swings.
    pub duration: f64,
    /// Integral of `v^2` over both swings.
    pub square: f64,
    /// Largest speed in the first and in the second swing, if asked for.
    pub fastest: [f64; 2],
    /// Logarithms of what each swing, run forward, makes of a relative error of its clearance.
    pub growth: [f64; 2],
    /// Bounds on the error of the residual and, relative, of the first clearance, if asked for.
    pub noise: f64,
    /// See `noise`.
    pub uncertainty: f64,
    /// Of each swing, the errors at exactly this unknown, and those that a relative error 1 of it makes.
    pub(crate) errors: [[Errors; 2]; 2],
}

/// How far two swings are from closing, in numbers of twice the working precision.
pub struct PreciseSwingPair {
    /// The residual of the route, as a closing in doubles has it.
    pub residual: f64,
    /// Clearance at which the second swing starts.
    pub second: f64,
    /// Duration of both.
    pub duration: f64,
}

/// `d ln(c + gap) / d ln(c)`.
pub fn share(clearance: Length, gap: f64) -> f64 {
    if gap == 0.0 {
        1.0
    } else {
        clearance.value / (clearance.value + gap)
    }
}

/// Relative error that a rounded logarithm leaves of a length.
pub(crate) fn rounding(length: Length) -> f64 {
    f64::EPSILON * length.log.abs().max(1.0)
}

impl SwingPair {
    /// The same with clearances and duration known to all digits of a double, beyond the relative errors given.
    pub fn sharpened(
        self,
        first: f64,
        &PreciseSwingPair { second, duration, .. }: &PreciseSwingPair,
        [uncertainty, passed]: [f64; 2],
    ) -> Self {
        let mut errors = self.errors;
        for ([own, _], error) in errors.iter_mut().zip([0.0, passed]) {
            (own.length, own.duration) = (error, 0.5 * f64::EPSILON * duration);
        }
        // A plain relative error of the first clearance.
        errors[0][1].length = 1.0;
        let clearances = [first, second].map(Length::new);
        SwingPair { clearances, duration, uncertainty, errors, ..self }
    }

    /// Bounds on the errors of each swing, its length being the clearance at which it starts.
    pub fn spread(&self) -> [Errors; 2] {
        self.errors.map(|[own, gain]| own.plus(gain, self.uncertainty))
    }

    /// The cycle of two swings equally fast, known in closed form to a few units in the last place.
    pub fn in_closed_form(
        clearances: [Length; 2],
        duration: f64,
        square: f64,
        fastest: f64,
    ) -> Self {
        let own = clearances.map(|clearance| Errors {
            length: UNIT + rounding(clearance),
            duration: UNIT * (0.5 * duration),
            square: UNIT * (0.5 * square),
            fastest: UNIT * fastest,
        });
        SwingPair {
            node: Node::new(clearances[0].log, 0.0, 0.0, f64::NAN),
            clearances,
            duration,
            square,
            fastest: [fastest; 2],
            growth: [f64::NAN; 2],
            noise: 0.0,
            uncertainty: own[0].length,
            errors: own.map(|own| [own, Errors::default()]),
        }
    }

    /// Logarithm of the Floquet multiplier if this closing is a cycle.
    pub fn log_multiplier(&self, parameters: &Parameters) -> f64 {
        self.log_terms(parameters).iter().sum()
    }

    /// The terms of which it is the sum.
    ///
    /// `mu = c0/(c0 + 2 r) c1/(c1 + 2 r) exp(-integral of (2 D + 3 D3 v^2))`: the divergence with the
    /// turning points built in. The D2 part of the integral vanishes on a closed curve.
    pub fn log_terms(&self, parameters: &Parameters) -> [f64; 4] {
        let Parameters { d, d3, r, .. } = *parameters;
        let [first, second] = self.clearances.map(|it| log_share(it, 2.0 * r));
        // Three times a damping can be too large a number; times the square, which is then small, it is not.
        [first, second, -2.0 * d * self.duration, -3.0 * (d3 * self.square)]
    }
}

/// `ln(c/(c + gap))`, with all digits for large and for underflowing c.
fn log_share(clearance: Length, gap: f64) -> f64 {
    if gap == 0.0 {
        0.0
    } else if gap / clearance.value < 1e10 {
        -ln_1p(gap / clearance.value)
    } else {
        clearance.log - ln(gap + clearance.value)
    }
}
