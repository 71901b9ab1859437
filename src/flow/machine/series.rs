//! The Taylor series of a motion within one phase.
//!
//! `x' = y`, `y' = -(x + offset) + h(y)`: h is a polynomial about the present velocity, composed with the
//! series by Horner's scheme, plus an exponential with a recurrence of its own. The step is the one that
//! keeps the last terms below rounding (Jorba and Zou, Experimental Mathematics 14, 2005).

use super::curve::INVERSE;
use super::{MachineCurve, MachineStep, ORDER, TERMS, Terms};
use crate::model::{ContactState, Fall, ForceBranch, ForcePiece, shift};
use crate::numerics::{exp2, gauss, integral, log2, pow, real, value, value_and_slope};

/// The series of one step, and what it takes to compute them.
#[derive(Clone, Debug)]
pub struct PhaseSeries {
    /// The step.
    pub step: MachineStep,
    /// For how long the motion is still to be followed at its start, in `1/omega_0`.
    pub left: f64,
    /// Coefficients of h about the present velocity.
    local: Vec<f64>,
    /// Partial sums of Horner's scheme, as series.
    rows: Vec<Terms>,
    /// Powers of the slip up to the exponent of the falling part.
    powers: Vec<Terms>,
    /// The derivative of the last of them, each term multiplied by its time.
    slopes: Terms,
    /// The falling part, if it counts here.
    falling: Option<Fall>,
    fall: Terms,
}

impl PhaseSeries {
    pub fn new() -> Self {
        PhaseSeries {
            step: MachineStep::even(ContactState::Rests, 0.0, [0.0; 2], 0.0),
            left: f64::INFINITY,
            local: Vec::new(),
            rows: Vec::new(),
            powers: Vec::new(),
            slopes: [0.0; TERMS],
            falling: None,
            fall: [0.0; TERMS],
        }
    }

    /// Expands the motion at displacement `x` from the balance and velocity `y`; `forward` is 1, or -1 for
    /// time reversed. `acceleration` replaces the first derivative where it is known exactly.
    pub fn expand(
        &mut self,
        (side, piece): (&ForceBranch, &ForcePiece),
        (x, y): (f64, f64),
        forward: f64,
        acceleration: Option<f64>,
    ) {
        self.local.clear();
        self.local.extend_from_slice(&piece.coefficients);
        shift(&mut self.local, y - piece.center);
        let degree = self.local.len() - 1;
        let products = degree.saturating_sub(1);
        if self.rows.len() < products {
            self.rows.resize(products, [0.0; TERMS]);
        }
        for row in 0..products {
            self.rows[row][0] = self.local[row + 1];
        }
        let mut force = self.local[0];
        self.falling = side.fall.filter(|_| piece.falls);
        if let Some(fall) = self.falling {
            force += fall.value(y);
            self.begin_fall(&fall, y);
        }
        (self.step.x[0], self.step.y[0]) = (x, y);
        for k in 0..ORDER {
            let known = acceleration.filter(|_| k == 0);
            let rate = known.unwrap_or(force - self.step.x[k]);
            let factor = forward * INVERSE[k + 1];
            self.step.x[k + 1] = factor * self.step.y[k];
            self.step.y[k + 1] = factor * rate;
            force = self.polynomial(k + 1, degree);
            if let Some(fall) = self.falling {
                force += self.next_fall(&fall, k + 1);
            }
        }
    }

    /// Coefficient k of the polynomial part of h, k > 0.
    fn polynomial(&mut self, k: usize, degree: usize) -> f64 {
        if degree < 2 {
            return self.local.get(1).map_or(0.0, |slope| slope * self.step.y[k]);
        }
        // Row r holds `c_(r+1) + d (c_(r+2) + d (..))` with d = y - y(0); the last of all is a constant.
        for row in 0..degree - 1 {
            self.rows[row][k] = if row + 2 == degree {
                self.local[degree] * self.step.y[k]
            } else {
                product(&self.step.y, &self.rows[row + 1], k)
            };
        }
        product(&self.step.y, &self.rows[0], k)
    }

    fn begin_fall(&mut self, fall: &Fall, y: f64) {
        self.fall[0] = fall.full(y);
        let ratio = fall.slip(y) / fall.velocity;
        if let Some(exponent) = whole(fall) {
            self.powers.resize(exponent, [0.0; TERMS]);
            let mut power = 1.0;
            for row in &mut self.powers {
                power *= ratio;
                row[0] = power;
            }
        } else {
            self.powers.resize(1, [0.0; TERMS]);
            self.powers[0][0] = pow(ratio.max(LEAST_SLIP), fall.exponent);
        }
    }

    /// Coefficient k of the exponential part, k > 0: `E' = -((slip/velocity)^n)' E`.
    fn next_fall(&mut self, fall: &Fall, k: usize) -> f64 {
        let toward = -fall.sign() / fall.velocity;
        if let Some(exponent) = whole(fall) {
            self.powers[0][k] = toward * self.step.y[k];
            for row in 1..exponent {
                let (slip, below) = (&self.powers[0], &self.powers[row - 1]);
                self.powers[row][k] = product(slip, below, k) + slip[0] * below[k];
            }
        } else {
            // slip P' = n slip' P for the power P of the slip.
            let ratio = (fall.slip(self.step.y[0]) / fall.velocity).max(LEAST_SLIP);
            let weight = |j: usize| fall.exponent * real(j) - real(k - j);
            let power = &self.powers[0];
            let sum: f64 =
                (1..=k).map(|j| weight(j) * toward * self.step.y[j] * power[k - j]).sum();
            self.powers[0][k] = sum / ratio * INVERSE[k];
        }
        let last = self.powers.len() - 1;
        self.slopes[k] = real(k) * self.powers[last][k];
        self.fall[k] = -product(&self.slopes, &self.fall, k) * INVERSE[k];
        self.fall[k]
    }

    /// The longest step that keeps the last terms below `aim`, relative to the state; infinite for a state
    /// that does not move.
    pub fn length(&self, aim: f64) -> f64 {
        let size = self.step.x[0].abs().max(self.step.y[0].abs());
        let allowed = |k: usize| {
            let term = self.step.x[k].abs().max(self.step.y[k].abs());
            if term > 0.0 {
                log2(aim * size / term) * INVERSE[k]
            } else {
                f64::INFINITY
            }
        };
        exp2((ORDER - 2..=ORDER).map(allowed).fold(f64::INFINITY, f64::min))
    }

    /// The integral of the divergence of the field, the derivative of the force by the velocity, over the step; 0 on the
    /// belt.
    pub fn divergence(&self) -> f64 {
        let duration = self.step.duration;
        if self.step.place == ContactState::Sticks {
            return 0.0;
        }
        let velocity = |part: f64| value(&self.step.y, part * duration);
        let polynomial = match self.local[..] {
            [] | [_] => 0.0,
            [_, slope] => duration * slope,
            // With d = y - y(0), the slope of a cubic P is 3 (P - P(0))/d - c_2 d - 2 c_1.
            [_, slope, bend] | [_, slope, bend, _] => {
                let way = integral(&self.step.y, duration) - duration * self.step.y[0];
                3.0 * integral(&self.rows[0], duration) - bend * way - 2.0 * duration * slope
            }
            _ => {
                let distance = |part| velocity(part) - self.step.y[0];
                duration * gauss(|part| value_and_slope(&self.local, distance(part)).1)
            }
        };
        let fall = self.falling.map(|fall| {
            if fall.exponent == 1.0 {
                // Its slope is a multiple of itself.
                return fall.sign() / fall.velocity * integral(&self.fall, duration);
            }
            let full = |part| value(&self.fall, part * duration);
            let slope = |part| full(part) * fall.steepness(velocity(part));
            fall.sign() * duration * gauss(slope)
        });
        polynomial + fall.unwrap_or(0.0)
    }
}

impl MachineCurve {
    /// What keeps the steps of a motion that is followed.
    pub fn keeper(&mut self) -> impl FnMut(&PhaseSeries) {
        |series| self.steps.push(series.step.clone())
    }
}

/// Where a law with a broken exponent has no derivatives, at slip 0, it is expanded this far beside it, in
/// units of its own velocity: a distance that velocities can still resolve.
const LEAST_SLIP: f64 = 1e-10;

/// The exponent as a whole number, if it is a small one.
fn whole(fall: &Fall) -> Option<usize> {
    (1..=10).find(|n| real(*n) == fall.exponent)
}

/// Coefficient k of the product of a series without its constant and another.
fn product(one: &Terms, other: &Terms, k: usize) -> f64 {
    one[1..=k].iter().zip(other[..k].iter().rev()).map(|(a, b)| a * b).sum()
}
