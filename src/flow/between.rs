//! A computed motion between its samples, for animation.

use super::motion::{Outcome, Sample, Trajectory};
use crate::numerics::hermite::Hermite;

impl Trajectory {
    /// When the motion ended: the time of its outcome.
    pub fn end(&self) -> f64 {
        match self.outcome {
            Outcome::Captured { tau, .. }
            | Outcome::Moving { tau, .. }
            | Outcome::Escaped { tau }
            | Outcome::GaveUp { tau, .. } => tau,
        }
    }

    /// The motion at any time from its start: between two samples on the cubic through their displacements and
    /// velocities, and at rest after capture. `None` without samples.
    pub fn at(&self, tau: f64) -> Option<Sample> {
        let last = *self.samples.last()?;
        if let Outcome::Captured { tau: since, q } = self.outcome
            && tau >= since
        {
            return Some(Sample { tau, q, v: 0.0 });
        }
        let after = self.samples.partition_point(|sample| sample.tau <= tau);
        let Some(to) = self.samples.get(after) else { return Some(last) };
        let Some(from) = after.checked_sub(1).and_then(|before| self.samples.get(before)) else {
            return Some(*to);
        };
        let h = to.tau - from.tau;
        let t = (tau - from.tau) / h;
        let q = Hermite { values: (from.q, to.q), slopes: (h * from.v, h * to.v) };
        Some(Sample { tau, q: q.at(t), v: q.slope(t) / h })
    }
}

#[cfg(test)]
mod tests {
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Limits, Problem};
    use crate::model::{Parameters, State};

    #[test]
    fn between_samples_a_motion_is_where_it_is_computed_to_be() {
        let parameters = Parameters { d: -0.1, d2: 0.1, d3: 0.4, r: 0.1 };
        let problem =
            Problem { parameters, initial: State { q: 1.0, v: 0.2 }, ..Problem::default() };
        let detail = Detail { samples_per_step: 16, ..Detail::default() };
        let motion = trajectory(&problem, detail, &Limits::PATIENT);
        for tau in [0.0, 0.013, 1.0, 3.3, 7.77] {
            let end = trajectory(&Problem { until: tau, ..problem }, detail, &Limits::PATIENT);
            let (found, exact) = (motion.at(tau).unwrap(), *end.samples.last().unwrap());
            assert!((found.q - exact.q).abs() < 1e-6, "tau = {tau}: {found:?} {exact:?}");
            assert!((found.v - exact.v).abs() < 1e-4, "tau = {tau}: {found:?} {exact:?}");
        }
    }

    #[test]
    fn after_its_capture_it_rests() {
        let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.25 };
        let problem = Problem { parameters, ..Problem::default() };
        let detail = Detail { samples_per_step: 4, ..Detail::default() };
        let motion = trajectory(&problem, detail, &Limits::PATIENT);
        let end = motion.end();
        let (one, other) = (motion.at(end).unwrap(), motion.at(end + 9.0).unwrap());
        assert_eq!((one.q, one.v, other.v), (other.q, 0.0, 0.0));
    }
}
