//! Where a motion of the oscillator of the paper reaches the speed of the belt, which is not a part of its equation.

use crate::flow::{Motion, Sample};
use crate::model::{Field, HalfPlane, Side, State};
use crate::numerics::{Hermite, TO_ROUNDING, bisect};

/// Time and displacement where a motion first reaches a velocity; `None` where it does not.
///
/// Between two samples the velocity is the cubic with the values and accelerations at both, whose error is of fourth
/// order in their small distance.
pub fn first_at(motion: &Motion, velocity: f64) -> Option<(f64, f64)> {
    let parameters = &motion.problem.parameters;
    let State { q, v } = motion.problem.initial;
    if v >= velocity {
        return Some((0.0, q));
    }
    motion.samples.windows(2).find_map(|pair| {
        let (from, to) = (pair[0], pair[1]);
        let h = to.tau - from.tau;
        // Both ends of the pair belong to the half swing between them.
        let side = if from.v + to.v >= 0.0 {
            Side::Upper
        } else {
            Side::Lower
        };
        // In the frame of the half plane, dry friction included.
        let (field, sign) = (HalfPlane::new(parameters, side), side.sign());
        let slope = |at: Sample| {
            h * sign * field.acceleration(side.position(at.q, parameters.r), sign * at.v)
        };
        let curve = Hermite { values: (from.v, to.v), slopes: (slope(from), slope(to)) };
        let mut peaks = curve.extrema().into_iter().flatten().chain([1.0]);
        let peak = peaks.find(|peak| curve.at(*peak) >= velocity)?;
        let (_, part) = bisect(0.0, peak, TO_ROUNDING, |part| curve.at(part) >= velocity);
        Some((from.tau + part * h, from.q + part * (to.q - from.q)))
    })
}

#[cfg(test)]
mod tests;
