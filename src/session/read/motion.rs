//! The motion on show at a given time.

use crate::flow::{Method, Outcome, Problem, Sample, Trajectory};
use crate::model::{Parameters, State};
use crate::numerics::elementary::tanh;
use crate::session::state::Session;

impl Session {
    /// The computed state of the motion that is nearest to a time; after it has come to rest, the place of
    /// rest.
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

/// The turning points of a motion in the order of time: the start if it is one, every arrival at `v = 0`, and
/// finally the place of rest.
///
/// Without friction, arrivals are not located, and the turning points are interpolated between samples.
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

/// The displacement where the velocity changes its sign between two samples, by linear interpolation.
fn between(pair: &[Sample]) -> Option<f64> {
    let [one, other] = pair else { return None };
    let turns = (one.v > 0.0 && other.v <= 0.0) || (one.v < 0.0 && other.v >= 0.0);
    let time = (other.tau - one.tau) * one.v / (one.v - other.v);
    turns.then_some(one.q + 0.5 * one.v * time)
}

/// The force of dry friction along a motion as a polyline of (time, force), up to `end` if the motion comes to
/// rest: `-r sign(v)` while it moves, and the force that balances the spring at rest. It lies in `[-r, r]`.
pub fn friction_force(motion: &Trajectory, end: f64) -> Vec<(f64, f64)> {
    let Problem { parameters: Parameters { r, .. }, epsilon, .. } = motion.problem;
    let mut force = Vec::new();
    for pair in motion.samples.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if motion.method == Method::Smoothed {
            force.push((to.tau, -r * tanh(to.v / epsilon)));
            continue;
        }
        // Each half swing begins and ends on v = 0, so the sign comes from the samples between.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Limits};

    fn motion(parameters: Parameters, initial: State, method: Method) -> Trajectory {
        let problem = Problem { parameters, initial, method, until: 30.0, ..Problem::default() };
        let crossings = parameters.r > 0.0;
        let detail = Detail { crossings, samples_per_step: 16, energy: true };
        trajectory(&problem, detail, &Limits::PATIENT)
    }

    const BRAKED: Parameters = Parameters { d: 0.02, d2: 0.1, d3: 0.05, r: 0.125 };
    const START: State = State { q: 1.5, v: 0.0 };

    #[test]
    fn the_friction_force_lies_between_its_limits_and_jumps_at_the_turning_points() {
        for method in [Method::Taylor, Method::Dop853, Method::Smoothed] {
            let found = motion(BRAKED, START, method);
            let force = friction_force(&found, 30.0);
            assert!(force.iter().all(|(_, force)| force.abs() <= BRAKED.r), "{method}");
            assert!(force.windows(2).all(|pair| pair[0].0 <= pair[1].0), "{method}");
        }
        let found = motion(BRAKED, START, Method::Taylor);
        let force = friction_force(&found, 30.0);
        // The mass first moves to the left: friction pulls fully to the right.
        assert_eq!(force[0], (0.0, BRAKED.r));
        let jumps = force.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| pair[0].0);
        let turns = found.crossings.iter().map(|crossing| crossing.tau);
        assert_eq!(jumps.clone().count(), found.crossings.len());
        // The time of a sample is computed from that of its step, with one more rounding.
        assert!(jumps.zip(turns).all(|(jump, turn)| (jump / turn - 1.0).abs() <= f64::EPSILON));
        // At rest, friction balances the spring.
        let Outcome::Captured { q, .. } = found.outcome else { panic!("it comes to rest") };
        assert_eq!(force.last(), Some(&(30.0, q)));
    }

    #[test]
    fn turning_points_end_where_the_motion_rests() {
        let found = motion(BRAKED, START, Method::Taylor);
        let points = turning_points(&found);
        assert_eq!(points[0], START.q);
        assert_eq!(points.len(), found.crossings.len() + 1);
        assert!(points.windows(2).all(|pair| pair[1].abs() < pair[0].abs()));
        assert!(points.last().unwrap().abs() <= BRAKED.r);
        assert!(turning_points(&motion(BRAKED, State { q: 0.0, v: 1.0 }, Method::Taylor))[0] > 0.0);
    }

    #[test]
    fn without_friction_turning_points_are_read_off_the_curve() {
        // Undamped, every turning point is as far out as the first one.
        let centre = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.0 };
        let found = motion(centre, START, Method::Taylor);
        let points = turning_points(&found);
        assert_eq!(points.len(), 10, "nine half turns fit into 30");
        assert!(points.iter().all(|q| (q.abs() - 1.5).abs() < 1e-3), "{points:?}");
    }

    #[test]
    fn a_state_is_read_where_the_motion_was_computed_and_at_rest_for_ever() {
        let mut session =
            Session::new(crate::scene::plain(), crate::session::Size { width: 80, height: 24 });
        assert_eq!(session.state_at(1.0), None);
        session.problem = Problem { parameters: BRAKED, initial: START, ..session.problem };
        let request = session.request(crate::scene::Topic::Trajectory, 0).unwrap();
        let answer = crate::question::answer(&request, &Limits::PATIENT).unwrap();
        session.take(crate::scene::Answered {
            request,
            result: Ok(answer),
            seconds: 0.0,
            complete: true,
        });
        assert_eq!(session.state_at(0.0), Some(START));
        let found = session.trajectory().unwrap();
        let sample = found.samples[40];
        assert_eq!(session.state_at(sample.tau), Some(State { q: sample.q, v: sample.v }));
        let Outcome::Captured { q, .. } = found.outcome else { panic!("it comes to rest") };
        assert_eq!(session.state_at(1e9), Some(State { q, v: 0.0 }));
    }
}
