//! The methods that ignore `v = 0`, which are included for comparison.

use super::super::explicit::ExplicitStepper;
use super::super::stiff::StiffStepper;
use super::super::tableau::DOP853;
use super::super::trajectory::{MotionRun, trajectory};
use super::super::{Detail, Limits, METHODS, Method, Motion, Outcome, Problem};
use crate::model::{Parameters, State};

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

fn run(problem: &Problem) -> Motion {
    trajectory(problem, Detail::default(), &Limits::PATIENT)
}

fn end(motion: &Motion) -> f64 {
    match motion.outcome {
        Outcome::Moving { q, .. } | Outcome::Captured { q, .. } => q,
        ref other => panic!("{other:?}"),
    }
}

#[test]
fn smoothed_friction_creeps_and_costs_as_the_inverse_of_its_width() {
    let creep =
        [(1e-2, 0.131), (1e-3, 0.351), (1e-4, 0.395), (1e-5, 0.3995)].map(|(epsilon, place)| {
            let motion = run(&Problem { method: Method::Smoothed, epsilon, ..from(0.4) });
            assert!((end(&motion) - place).abs() < 5e-4, "{epsilon}: {:?}", motion.outcome);
            assert!(matches!(motion.outcome, Outcome::Moving { .. }));
            motion.cost.evaluations
        });
    assert!(creep[3] > 9 * creep[2], "{creep:?}");
}

/// Creeping is a property of the smoothed law; only its cost depends on the integrator.
#[test]
fn an_implicit_method_creeps_to_the_same_place() {
    let problem = Problem { epsilon: 1e-4, ..from(0.4) };
    let start = || MotionRun::new(&problem, Method::Smoothed, Detail::default(), &Limits::PATIENT);
    let epsilon = Some(problem.epsilon);
    let stepper = |field| ExplicitStepper::new(&DOP853, field, 1e-8);
    let explicit = start().walk(epsilon, false, stepper);
    let implicit = start().walk(epsilon, false, |field| StiffStepper::new(field, 1e-8));
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

/// From there the linear oscillator turns beyond the largest number, whether or not a method locates the turn.
#[test]
fn no_crossing_lies_beyond_the_largest_number() {
    for row in METHODS.iter() {
        let problem = Problem {
            parameters: Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.0 },
            initial: State { q: f64::MAX, v: f64::MAX },
            method: row.method,
            step: 1e-2,
            ..from(0.0)
        };
        let detail = Detail { crossings: true, ..Detail::default() };
        let motion =
            trajectory(&problem, detail, &Limits { evaluations: 20_000, ..Limits::PATIENT });
        assert!(motion.crossings.is_empty(), "{}: {:?}", row.name, motion.crossings);
        assert!(!matches!(motion.outcome, Outcome::Captured { .. }), "{}", row.name);
    }
}
