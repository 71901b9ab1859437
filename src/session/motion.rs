//! The motion on show, read at a time.

use super::state::Session;
use crate::flow::{Method, Outcome, Problem, Sample, Trajectory};
use crate::oscillator::{Parameters, State};

impl Session {
    /// The computed state of the motion nearest to a time; at rest the place of rest.
    #[must_use]
    pub fn state_at(&self, tau: f64) -> Option<State> {
        let found = self.trajectory()?;
        if let Outcome::Captured { tau: rest, q } = found.outcome
            && tau >= rest
        {
            return Some(State { q, v: 0.0 });
        }
        let samples = &found.samples;
        let after = samples.partition_point(|sample| sample.tau < tau);
        let beside = [after.checked_sub(1), Some(after)];
        let candidates = beside.into_iter().flatten().filter_map(|index| samples.get(index));
        let nearest =
            candidates.min_by(|a, b| (a.tau - tau).abs().total_cmp(&(b.tau - tau).abs()))?;
        Some(State { q: nearest.q, v: nearest.v })
    }
}

/// The turning points of a motion, in the order of time: the start if it is one, every arrival at
/// `v = 0`, the place of rest last.
///
/// Without friction the arrivals are not looked for, and are read off the points of the motion.
#[must_use]
pub fn turning_points(motion: &Trajectory) -> Vec<f64> {
    let start = motion.problem.initial;
    let mut points: Vec<f64> = (start.v == 0.0).then_some(start.q).into_iter().collect();
    if motion.crossings.is_empty() && motion.problem.parameters.r == 0.0 {
        points.extend(motion.samples.windows(2).filter_map(between));
    } else {
        points.extend(motion.crossings.iter().map(|crossing| crossing.q));
    }
    points
}

/// Where the velocity changes its sign between two points of a motion, taken to be linear between them.
fn between(pair: &[Sample]) -> Option<f64> {
    let [one, other] = pair else { return None };
    let turns = (one.v > 0.0 && other.v <= 0.0) || (one.v < 0.0 && other.v >= 0.0);
    let time = (other.tau - one.tau) * one.v / (one.v - other.v);
    turns.then_some(one.q + 0.5 * one.v * time)
}

/// The force of dry friction along a motion as a polyline of (time, force), up to `end` if the motion is
/// at rest: `-r sign(v)` while it moves, and what the spring asks for at rest. It lies in `[-r, r]`.
#[must_use]
pub fn friction_force(motion: &Trajectory, end: f64) -> Vec<(f64, f64)> {
    let Problem { parameters: Parameters { r, .. }, epsilon, .. } = motion.problem;
    let mut force = Vec::new();
    for pair in motion.samples.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if motion.method == Method::Smoothed {
            force.push((to.tau, -r * (to.v / epsilon).tanh()));
            continue;
        }
        // Each half swing begins and ends on v = 0, so the sign is that of the points between.
        let sum = from.v + to.v;
        let value = if sum == 0.0 { 0.0 } else { -r * sum.signum() };
        match force.last_mut() {
            Some((last, same)) if *same == value => *last = to.tau,
            _ => force.extend([(from.tau, value), (to.tau, value)]),
        }
    }
    if let Outcome::Captured { tau, q } = motion.outcome {
        force.extend([(tau, q), (end.max(tau), q)]);
    }
    force
}
