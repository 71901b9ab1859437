//! The oscillator of the paper as a machine: where a motion of it reaches the speed of the belt, which is not a part of
//! its equation.

use crate::flow::Trajectory;
use crate::model::{HalfPlane, Parameters, Side, State};
use crate::numerics::polynomial::Hermite;
use crate::numerics::root::{TO_ROUNDING, bisect};

/// A motion until it first reaches a velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowedOnBelt {
    /// Smallest and largest velocity.
    pub velocity: (f64, f64),
    /// Smallest and largest displacement of the samples.
    pub displacement: (f64, f64),
    /// Time and displacement where the velocity is first reached; `None` where it is not.
    pub sticks: Option<(f64, f64)>,
}

impl FollowedOnBelt {
    /// Follows the samples of a motion; between two of them the velocity is the cubic with the values and
    /// accelerations at both, whose error is of fourth order in their small distance.
    pub fn of(motion: &Trajectory, sticking: f64) -> Self {
        let parameters = &motion.problem.parameters;
        let State { q, v } = motion.problem.initial;
        let mut found = FollowedOnBelt { velocity: (v, v), displacement: (q, q), sticks: None };
        if v >= sticking {
            found.sticks = Some((0.0, q));
            return found;
        }
        for pair in motion.samples.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let h = to.tau - from.tau;
            // Both ends of the pair belong to the half swing between them.
            let side = if from.v + to.v >= 0.0 { Side::Upper } else { Side::Lower };
            let slope = |q, v| h * acceleration(parameters, side, q, v);
            let curve = Hermite {
                values: (from.v, to.v),
                slopes: (slope(from.q, from.v), slope(to.q, to.v)),
            };
            for peak in curve.extrema().into_iter().flatten().chain([1.0]) {
                let v = curve.at(peak);
                if v >= sticking {
                    let (_, part) =
                        bisect(0.0, peak, TO_ROUNDING, |part| curve.at(part) >= sticking);
                    let q = from.q + part * (to.q - from.q);
                    found.velocity.1 = sticking;
                    found.displacement = widened(found.displacement, q);
                    found.sticks = Some((from.tau + part * h, q));
                    return found;
                }
                found.velocity = widened(found.velocity, v);
            }
            found.displacement = widened(found.displacement, to.q);
        }
        found
    }
}

/// A range with a value in it.
fn widened((low, high): (f64, f64), value: f64) -> (f64, f64) {
    (low.min(value), high.max(value))
}

/// Acceleration on one side of `v = 0`, dry friction included.
fn acceleration(parameters: &Parameters, side: Side, q: f64, v: f64) -> f64 {
    let field = HalfPlane::new(parameters, side);
    side.sign() * field.acceleration(side.position(q, parameters.r), side.sign() * v)
}
