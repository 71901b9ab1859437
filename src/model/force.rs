//! What depends on velocity: the force on the mass in each phase of its motion, less its value at rest.
//!
//! On either side of the belt's speed the force is a polynomial in the velocity `y`, piecewise for a table,
//! plus for Stribeck's law one falling exponential. Both are kept relative to the steady position, where the
//! force vanishes exactly: near rest it keeps all its digits however small the velocity is. Forces are
//! divided by the stiffness, so that they are lengths, and velocities by the natural frequency.

use super::{LawParts, LawPiece};
use crate::numerics::{exp, exp_m1, ln_1p, pow, powi, value_and_slope};

/// A polynomial `sum c_k (y - center)^k` for velocities in `low ..= high`.
#[derive(Clone, Debug, PartialEq)]
pub struct ForcePiece {
    pub low: f64,
    pub high: f64,
    pub center: f64,
    pub coefficients: Vec<f64>,
    /// Whether the exponential part of the law counts here.
    pub falls: bool,
}

/// The polynomial with these coefficients, in powers of the distance from a point `by` further on.
pub fn shifted(coefficients: &[f64], by: f64) -> Vec<f64> {
    let mut shifted = coefficients.to_vec();
    shift(&mut shifted, by);
    shifted
}

/// The same in place.
pub fn shift(coefficients: &mut [f64], by: f64) {
    for start in 1..coefficients.len() {
        for k in (start - 1..coefficients.len() - 1).rev() {
            coefficients[k] += by * coefficients[k + 1];
        }
    }
}

/// The falling part of Stribeck's law, `drop exp(-(slip/velocity)^exponent)`, on one side of the belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fall {
    pub drop: f64,
    pub velocity: f64,
    pub exponent: f64,
    /// Speed of the belt.
    pub speed: f64,
    /// Whether the mass is faster than the belt.
    pub above: bool,
}

impl Fall {
    /// How fast the mass slips on the belt.
    pub fn slip(&self, y: f64) -> f64 {
        if self.above {
            (y - self.speed).max(0.0)
        } else {
            (self.speed - y).max(0.0)
        }
    }

    fn power(&self, slip: f64) -> f64 {
        let ratio = slip / self.velocity;
        if self.exponent == 1.0 {
            ratio
        } else {
            pow(ratio, self.exponent)
        }
    }

    /// `drop exp(..)` with the sign with which it acts on the mass.
    pub fn full(&self, y: f64) -> f64 {
        self.sign() * self.drop * exp(-self.power(self.slip(y)))
    }

    /// The sign with which friction acts on the mass.
    pub fn sign(&self) -> f64 {
        if self.above { -1.0 } else { 1.0 }
    }

    /// Its part of the force: below the belt's speed less that at rest, with all digits near rest.
    pub fn value(&self, y: f64) -> f64 {
        if self.above {
            return self.full(y);
        }
        let rest = self.power(self.speed);
        let rise = if self.exponent == 1.0 {
            y / self.velocity
        } else {
            -rest * exp_m1(self.exponent * ln_1p(-(y / self.speed).min(1.0)))
        };
        if rise.abs() <= 1.0 {
            self.drop * exp(-rest) * exp_m1(rise)
        } else {
            self.full(y) - self.drop * exp(-rest)
        }
    }

    /// Derivative of the exponent by the slip.
    pub fn steepness(&self, y: f64) -> f64 {
        let steepness = if self.exponent == 1.0 {
            1.0
        } else {
            self.exponent * pow(self.slip(y) / self.velocity, self.exponent - 1.0)
        };
        steepness / self.velocity
    }

    /// Derivative of [`Self::value`].
    pub fn slope(&self, y: f64) -> f64 {
        self.sign() * self.full(y) * self.steepness(y)
    }
}

/// The force on one side of the belt's speed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForceBranch {
    /// Pieces that follow one another in y.
    pub pieces: Vec<ForcePiece>,
    /// The exponential part.
    pub fall: Option<Fall>,
}

impl ForceBranch {
    /// The piece for a motion at `y` towards larger or smaller velocities; `None` beyond the law.
    pub fn piece(&self, y: f64, rising: bool) -> Option<&ForcePiece> {
        self.pieces.iter().find(|ForcePiece { low, high, .. }| {
            if rising {
                *low <= y && y < *high
            } else {
                *low < y && y <= *high
            }
        })
    }

    /// The least of `-force/y` at velocities up to `reach` in size, along the direction of integration: how
    /// strongly each of them decays at least. `None` where no bound is at hand.
    pub fn decay(&self, reach: f64, forward: f64) -> Option<f64> {
        let covers = |it: &&ForcePiece| it.center == 0.0 && it.low <= -reach && reach <= it.high;
        let piece = self.pieces.iter().find(covers)?;
        let fall = match self.fall.filter(|_| piece.falls) {
            None => 0.0,
            // The slope of an exponential is between those at the ends.
            Some(fall) if fall.exponent == 1.0 => {
                let slopes = [-reach, reach].map(|y| -forward * fall.slope(y));
                slopes[0].min(slopes[1])
            }
            Some(_) => return None,
        };
        let higher = piece.coefficients.iter().skip(2).rev();
        let higher = higher.fold(0.0, |sum, coefficient| (sum + coefficient.abs()) * reach);
        Some(fall - forward * piece.coefficients.get(1).unwrap_or(&0.0) - higher)
    }

    /// The force and its derivative; beyond the law the nearest piece continues.
    pub fn at(&self, y: f64) -> (f64, f64) {
        let found = self.pieces.iter().find(|piece| y <= piece.high).or(self.pieces.last());
        let Some(piece) = found else { return (0.0, 0.0) };
        let (value, slope) = value_and_slope(&piece.coefficients, y - piece.center);
        let fall = self.fall.filter(|_| piece.falls);
        fall.map_or((value, slope), |fall| (value + fall.value(y), slope + fall.slope(y)))
    }
}

// The friction law as forces on the mass: on either side of the belt's speed, with the damper's.

/// Beyond this power the exponential part is lost in rounding. It is left out there, because a series cannot
/// see from far what comes up so steeply; where it ends a step ends too.
const LOST: f64 = 42.0;

impl LawParts {
    /// The law as a force: coefficients times `force`, velocities divided by `omega_0`.
    pub(crate) fn scaled(&self, force: f64, omega_0: f64) -> Self {
        let scaled = |(from, to, coefficients): LawPiece| {
            let numbers = (0..).zip(coefficients);
            let numbers = numbers.map(|(k, c)| force * c * powi(omega_0, k)).collect();
            (from / omega_0, to / omega_0, numbers)
        };
        // What falls ends within the first piece.
        let cut = self.fall.map(|(_, velocity, exponent)| velocity * pow(LOST, 1.0 / exponent));
        let split = |(from, to, coefficients): &LawPiece| match cut {
            Some(end) if *from < end && end < *to => vec![
                (*from, end, coefficients.clone()),
                (end, *to, shifted(coefficients, end - from)),
            ],
            _ => vec![(*from, *to, coefficients.clone())],
        };
        let fall = self
            .fall
            .map(|(drop, velocity, exponent)| (force * drop, velocity / omega_0, exponent));
        LawParts {
            pieces: self.pieces.iter().flat_map(split).map(scaled).collect(),
            fall: fall.filter(|(drop, ..)| *drop != 0.0),
        }
    }
}

fn added(mut one: Vec<f64>, other: impl Iterator<Item = f64>) -> Vec<f64> {
    for (k, number) in other.enumerate() {
        if k < one.len() {
            one[k] += number;
        } else {
            one.push(number);
        }
    }
    while one.len() > 1 && one.last() == Some(&0.0) {
        one.pop();
    }
    one
}

/// The force on one side of the belt's speed: `T - x0` less the damper's at velocities up to it, `-T` less the damper's
/// above.
pub(crate) fn branch(
    law: &LawParts,
    damper: &[f64],
    speed: f64,
    pull: f64,
    reach: f64,
    above: bool,
) -> ForceBranch {
    let velocity = |slip: f64| if above { speed + slip } else { speed - slip };
    // Up to the belt's speed the slip falls where the velocity rises.
    let signed =
        |(k, number): (usize, f64)| if above || k % 2 == 1 { 0.0 - number } else { number };
    let piece = |(from, to, coefficients): &LawPiece| {
        let to = to.min(reach);
        if from > &to {
            return None;
        }
        let steady = !above && (*from..=to).contains(&speed);
        let about = if steady { speed } else { *from };
        let center = velocity(about);
        let pull_of = shifted(coefficients, about - from).into_iter().enumerate().map(signed);
        // The damper pulls the other way.
        let brakes = shifted(damper, center).into_iter().map(|number| 0.0 - number);
        let mut coefficients = added(brakes.collect(), pull_of);
        if steady {
            coefficients[0] = 0.0;
        } else if !above {
            coefficients[0] -= pull;
        }
        let (one, other) = (velocity(*from), velocity(to));
        let (low, high) = (one.min(other), one.max(other));
        Some(ForcePiece { low, high, center, coefficients, falls: *from == 0.0 })
    };
    let mut pieces: Vec<ForcePiece> = law.pieces.iter().filter_map(piece).collect();
    if !above {
        pieces.reverse();
    }
    let fall = |(drop, velocity, exponent)| Fall { drop, velocity, exponent, speed, above };
    ForceBranch { pieces, fall: law.fall.map(fall) }
}
