//! Where a motion of the oscillator of the paper reaches the speed of the belt, which is not a part of its equation.

use crate::flow::Trajectory;
use crate::model::{HalfPlane, Parameters, Side, State};
use crate::numerics::{Hermite, TO_ROUNDING, bisect};

/// Time and displacement where a motion first reaches a velocity; `None` where it does not.
///
/// Between two samples the velocity is the cubic with the values and accelerations at both, whose error is of fourth
/// order in their small distance.
pub fn first_at(motion: &Trajectory, velocity: f64) -> Option<(f64, f64)> {
    let parameters = &motion.problem.parameters;
    let State { q, v } = motion.problem.initial;
    if v >= velocity {
        return Some((0.0, q));
    }
    motion.samples.windows(2).find_map(|pair| {
        let (from, to) = (pair[0], pair[1]);
        let h = to.tau - from.tau;
        // Both ends of the pair belong to the half swing between them.
        let side = if from.v + to.v >= 0.0 { Side::Upper } else { Side::Lower };
        let slope = |q, v| h * acceleration(parameters, side, q, v);
        let curve =
            Hermite { values: (from.v, to.v), slopes: (slope(from.q, from.v), slope(to.q, to.v)) };
        let mut peaks = curve.extrema().into_iter().flatten().chain([1.0]);
        let peak = peaks.find(|peak| curve.at(*peak) >= velocity)?;
        let (_, part) = bisect(0.0, peak, TO_ROUNDING, |part| curve.at(part) >= velocity);
        Some((from.tau + part * h, from.q + part * (to.q - from.q)))
    })
}

/// Acceleration on one side of `v = 0`, dry friction included.
fn acceleration(parameters: &Parameters, side: Side, q: f64, v: f64) -> f64 {
    let field = HalfPlane::new(parameters, side);
    side.sign() * field.acceleration(side.position(q, parameters.r), side.sign() * v)
}

#[cfg(test)]
mod tests;
