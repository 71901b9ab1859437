//! A pair of half swings, whether it closes or not, and the errors of its numbers.

use super::half_map::{HalfSwing, Length};
use super::roundoff::{Errors, UNIT};
use super::search::Node;
use crate::model::Parameters;
use crate::numerics::elementary::{ln, ln_1p};

/// The two swings at one value of the unknown, and how far they are from closing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    /// The unknown, and the residual as a difference of two increasing functions of it.
    pub node: Node,
    /// Clearance at which the first swing starts.
    pub first: Length,
    /// Clearance at which the second swing starts.
    pub second: Length,
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
    /// Errors of the other numbers at exactly this unknown, and those that a relative error 1 of it makes.
    errors: [Spread; 2],
}

/// Errors of what a closing gives: of the clearances relative, of all others absolute.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Of the clearances at which the swings start.
    pub clearance: [f64; 2],
    pub duration: f64,
    /// Of the integral of `v^2`.
    pub square: f64,
    /// Of the largest speeds.
    pub fastest: [f64; 2],
}

impl Spread {
    /// From the relative errors of the clearances and the errors of the two swings.
    pub(crate) fn new(clearance: [f64; 2], [first, second]: [Errors; 2]) -> Self {
        Spread {
            clearance,
            duration: first.duration + second.duration,
            square: first.square + second.square,
            fastest: [first.fastest, second.fastest],
        }
    }
}

/// `d ln(c + gap) / d ln(c)`.
pub fn share(clearance: Length, gap: f64) -> f64 {
    if gap == 0.0 { 1.0 } else { clearance.value / (clearance.value + gap) }
}

impl HalfSwing {
    /// The swing that creeps back to the centre forever: its end is 0.
    pub(crate) fn collapsed(start: Length) -> Self {
        HalfSwing { duration: f64::INFINITY, ..HalfSwing::nothing(start) }
    }

    /// No swing at all.
    pub(crate) fn nothing(start: Length) -> Self {
        HalfSwing {
            start,
            end: Length { value: 0.0, log: f64::NEG_INFINITY },
            duration: 0.0,
            square: 0.0,
            fastest: 0.0,
            log_elasticity: f64::NEG_INFINITY,
            errors: [Errors::default(); 2],
        }
    }
}

/// Relative error that a rounded logarithm leaves of a length.
pub(crate) fn rounding(length: Length) -> f64 {
    f64::EPSILON * length.log.abs().max(1.0)
}

impl Closing {
    pub(crate) fn of(node: Node, [first, second]: [Length; 2], swings: [HalfSwing; 2]) -> Self {
        Closing {
            node,
            first,
            second,
            duration: swings[0].duration + swings[1].duration,
            square: swings[0].square + swings[1].square,
            fastest: [swings[0].fastest, swings[1].fastest],
            growth: [f64::NAN; 2],
            noise: 0.0,
            uncertainty: 0.0,
            errors: [Spread::default(); 2],
        }
    }

    pub(crate) fn with_errors(self, growth: [f64; 2], noise: f64, errors: [Spread; 2]) -> Self {
        let uncertainty = (self.node.value().abs() + noise) / self.node.slope.abs();
        Closing { growth, noise, uncertainty, errors, ..self }
    }

    /// The same with clearances and duration known to all digits of a double, beyond the relative errors given.
    pub fn sharpened(
        self,
        (first, second, duration): (f64, f64, f64),
        [uncertainty, passed]: [f64; 2],
    ) -> Self {
        let [mut own, mut gain] = self.errors;
        (own.clearance, own.duration) = ([0.0, passed], f64::EPSILON * duration);
        // A plain relative error of the first clearance.
        gain.clearance[0] = 1.0;
        let (first, second) = (Length::new(first), Length::new(second));
        Closing { first, second, duration, uncertainty, errors: [own, gain], ..self }
    }

    /// How errors of rounding and of the first clearance reach the others.
    pub fn errors(&self) -> &[Spread; 2] {
        &self.errors
    }

    /// Bounds on the errors of its numbers.
    pub fn spread(&self) -> Spread {
        let [own, gain] = &self.errors;
        let sum =
            |own: f64, gain: f64| own + if gain == 0.0 { 0.0 } else { gain * self.uncertainty };
        let pair =
            |of: fn(&Spread) -> [f64; 2]| [0, 1].map(|index| sum(of(own)[index], of(gain)[index]));
        Spread {
            clearance: pair(|it| it.clearance),
            duration: sum(own.duration, gain.duration),
            square: sum(own.square, gain.square),
            fastest: pair(|it| it.fastest),
        }
    }

    /// The cycle of two swings equally fast, known in closed form to a few units in the last place.
    pub fn in_closed_form(
        clearances: [Length; 2],
        duration: f64,
        square: f64,
        fastest: f64,
    ) -> Self {
        let [first, second] = clearances;
        let node = Node::new(first.log, 0.0, 0.0, f64::NAN);
        let own = Spread {
            clearance: clearances.map(|clearance| UNIT + rounding(clearance)),
            duration: UNIT * duration,
            square: UNIT * square,
            fastest: [UNIT * fastest; 2],
        };
        Closing {
            node,
            first,
            second,
            duration,
            square,
            fastest: [fastest; 2],
            growth: [f64::NAN; 2],
            noise: 0.0,
            uncertainty: own.clearance[0],
            errors: [own, Spread::default()],
        }
    }

    /// Outside the domain of one of the two functions: it is infinite, the other still bounds what lies further
    /// in or out.
    pub(crate) fn beyond(start: Length, rise: f64, fall: f64) -> Self {
        let node = Node::new(start.log, rise, fall, f64::NAN);
        let nothing = HalfSwing::nothing(start);
        Closing::of(node, [start, nothing.end], [nothing; 2])
    }

    /// Logarithm of the Floquet multiplier if this closing is a cycle.
    ///
    /// `mu = c0/(c0 + 2 r) c1/(c1 + 2 r) exp(-integral of (2 D + 3 D3 v^2))`: the divergence with the
    /// turning points built in. The D2 part of the integral vanishes on a closed curve.
    pub fn log_multiplier(&self, parameters: &Parameters) -> f64 {
        let gap = 2.0 * parameters.r;
        let past_friction: f64 =
            [self.first, self.second].iter().map(|&clearance| log_share(clearance, gap)).sum();
        // Three times a damping can be too large a number; times the square, which is then small, it is not.
        let cubic = 3.0 * (parameters.d3 * self.square);
        past_friction - 2.0 * parameters.d * self.duration - cubic
    }
}

impl Closing {
    /// Sum of the magnitudes of the terms of [`Closing::log_multiplier`].
    pub fn log_terms(&self, parameters: &Parameters) -> f64 {
        let Parameters { d, d3, r, .. } = *parameters;
        let shares = [self.first, self.second].map(|it| log_share(it, 2.0 * r).abs());
        shares[0] + shares[1] + 2.0 * d.abs() * self.duration + 3.0 * (d3.abs() * self.square)
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
