//! Motions by steps that ignore `v = 0`: the driver of the methods included for comparison.

use super::limits::{Limits, Reason};
use super::motion::{Crossing, Outcome, Problem, Sample, Trajectory};
use super::run::{MotionRun, sample};
use super::step::{Field, Step, StepPoint, Stepper};
use super::swing::time_to_blow_up;
use crate::model::parameters::rests;
use crate::model::{HalfPlane, Side, State};

impl MotionRun {
    /// Takes steps until the end time, and counts sign changes of the velocity as crossings.
    ///
    /// `sticks` says whether a motion that this method brings to `v = 0` inside the sticking set stays there.
    /// Positions at crossings assume a velocity that is linear within the step.
    pub fn walk<F: Field, S: Stepper<F>>(
        mut self,
        stepper: &mut S,
        sticks: bool,
        limits: &Limits,
    ) -> Trajectory {
        let Problem { parameters, initial, until, .. } = self.found.problem;
        let field = HalfPlane::new(&parameters, Side::Upper);
        let mut point = StepPoint { x: initial.q, v: initial.v };
        let outcome = loop {
            let tau = self.time.value();
            let here = State { q: point.x, v: point.v };
            if sticks && rests(here, parameters.r) {
                break Outcome::Captured { tau, q: here.q };
            }
            let remaining = until - tau;
            if remaining <= 0.0 {
                break Outcome::Moving { tau: until, q: here.q, v: here.v };
            }
            if let Some(rest) = time_to_blow_up(&field, point, tau)
                && rest <= remaining
            {
                break Outcome::Escaped { tau: tau + rest };
            }
            let evaluations = stepper.evaluations();
            if (limits.interrupted)() {
                break Outcome::GaveUp { tau, reason: Reason::Interrupted };
            }
            if evaluations > limits.evaluations {
                break Outcome::GaveUp { tau, reason: Reason::Budget { evaluations } };
            }
            match stepper.pass(point, remaining) {
                Err(reason) => break Outcome::GaveUp { tau, reason },
                Ok(step) if tau + step.duration == tau => {
                    let reason = Reason::StepTooSmall { step: step.duration };
                    break Outcome::GaveUp { tau, reason };
                }
                Ok(step) => {
                    self.book_step(stepper, &field, point, &step);
                    point = step.end;
                    if let Some(full) = self.full() {
                        break full;
                    }
                }
            }
        };
        self.close(outcome, stepper.evaluations(), stepper.rejected())
    }

    /// Records what was requested of a step from `start`.
    fn book_step<F: Field, S: Stepper<F>>(
        &mut self,
        stepper: &mut S,
        field: &HalfPlane,
        start: StepPoint,
        step: &Step,
    ) {
        let (time, count) = (self.time, self.detail.samples_per_step);
        if count > 0 {
            sample(stepper, step, count, |offset, StepPoint { x: q, v }| {
                self.found.samples.push(Sample { tau: time.plus(offset), q, v });
            });
        }
        if self.detail.energy {
            self.works.add(&stepper.powers(), field, 0);
        }
        // The path within the step, out and back where the velocity changes sign.
        let end = step.end;
        if start.v != 0.0 && start.v.signum() * end.v <= 0.0 {
            let part = start.v / (start.v - end.v);
            let q = start.x + 0.5 * part * step.duration * start.v;
            self.works.path += (q - start.x).abs() + (end.x - q).abs();
            let tau = time.plus(part * step.duration);
            self.found.crossings.push(Crossing { tau, q });
        } else {
            self.works.path += (end.x - start.x).abs();
        }
        self.found.cost.steps += 1;
        self.time.add(step.duration);
    }
}

#[cfg(test)]
mod tests {
    use super::super::explicit::Dop853;
    use super::super::regularized::{SignLaw, SmoothField};
    use super::super::stiff::Stiff;
    use super::super::trajectory::{Detail, trajectory};
    use super::super::{Limits, Method, Outcome, Problem, Trajectory};
    use super::*;
    use crate::model::Parameters;

    /// Where the motion from (2, 0) rests after three half swings, in closed form.
    const REST: f64 = -0.116_144_440_390_138;

    /// The problem with D = -0.1 and r = 0.5, from rest at `q`.
    fn from(q: f64) -> Problem {
        Problem {
            parameters: Parameters { d: -0.1, d2: 0.0, d3: 0.0, r: 0.5 },
            initial: State { q, v: 0.0 },
            until: 50.0,
            tolerance: 1e-8,
            ..Problem::default()
        }
    }

    fn run(problem: &Problem) -> Trajectory {
        trajectory(problem, Detail::default(), &Limits::PATIENT)
    }

    fn end(motion: &Trajectory) -> f64 {
        match motion.outcome {
            Outcome::Moving { q, .. } | Outcome::Captured { q, .. } => q,
            ref other => panic!("{other:?}"),
        }
    }

    #[test]
    fn smoothed_friction_creeps_and_costs_as_the_inverse_of_its_width() {
        let creep = [(1e-2, 0.131), (1e-3, 0.351), (1e-4, 0.395), (1e-5, 0.3995)].map(
            |(epsilon, place)| {
                let motion = run(&Problem { method: Method::Smoothed, epsilon, ..from(0.4) });
                assert!((end(&motion) - place).abs() < 5e-4, "{epsilon}: {:?}", motion.outcome);
                assert!(matches!(motion.outcome, Outcome::Moving { .. }));
                motion.cost.evaluations
            },
        );
        assert!(creep[3] > 9 * creep[2], "{creep:?}");
    }

    /// Creeping is a property of the smoothed law; only its cost depends on the integrator.
    #[test]
    fn an_implicit_method_creeps_to_the_same_place() {
        let problem = Problem { epsilon: 1e-4, ..from(0.4) };
        let field = SmoothField::new(&problem.parameters, SignLaw::Tanh(problem.epsilon));
        let start = || MotionRun::new(&problem, Method::Smoothed, Detail::default());
        let explicit = start().walk(&mut Dop853::dop853(field, 1e-8), false, &Limits::PATIENT);
        let implicit = start().walk(&mut Stiff::new(field, 1e-8), false, &Limits::PATIENT);
        assert!((end(&explicit) - end(&implicit)).abs() < 1e-8);
        assert!(100 * implicit.cost.evaluations < explicit.cost.evaluations);
    }

    #[test]
    fn time_stepping_sticks_and_nears_the_right_place_with_its_step() {
        let mut before = f64::INFINITY;
        for step in [0.1, 0.01, 0.001] {
            let motion = run(&Problem { method: Method::TimeStepping, step, ..from(2.0) });
            assert!(matches!(motion.outcome, Outcome::Captured { .. }));
            assert_eq!(motion.crossings.len(), 3);
            let error = (end(&motion) - REST).abs();
            assert!(error < 0.02 * before && error < 0.5 * step * step, "{step}: {error:e}");
            before = if before.is_finite() { error } else { f64::INFINITY };
        }
        let rests = run(&Problem { method: Method::TimeStepping, ..from(0.5) });
        assert_eq!(rests.outcome, Outcome::Captured { tau: 0.0, q: 0.5 });
    }
}
