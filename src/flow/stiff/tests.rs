//! The implicit method against closed forms and other methods.

use super::super::auto::AutoStepper;
use super::super::swing::{Swing, swing};
use super::super::taylor::Taylor;
use super::super::trajectory::trajectory;
use super::super::{Detail, Limits, Method, Outcome, Problem};
use super::*;
use crate::model::{Field, Parameters, State};

fn far_out(tolerance: f64) -> Problem {
    Problem {
        parameters: Parameters { d: -0.1, d2: 0.0, d3: 1.0, r: 0.1 },
        initial: State { q: 1e6, v: 0.0 },
        until: 20_000.0,
        method: Method::Stiff,
        tolerance,
        ..Problem::default()
    }
}

/// On the slow manifold `v^3 = -x` the inward motion takes `1.5 q^(2/3)` = 15,000.
#[test]
fn far_out_some_hundred_steps_do_what_an_explicit_method_needs_a_hundred_million_for() {
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let motion = trajectory(&far_out(tolerance), Detail::default(), &Limits::PATIENT);
        assert!(motion.cost.steps < 130, "{} steps", motion.cost.steps);
        assert!(matches!(motion.outcome, Outcome::Captured { .. }));
        // From a run with tolerance 1e-14.
        let expected = [15_000.005_326_401_7, 15_012.606_267_750_5];
        let found = [motion.crossings[0].tau, motion.crossings[4].tau];
        for (found, expected) in found.iter().zip(expected) {
            let error = (found / expected - 1.0).abs();
            assert!(error < tolerance, "{tolerance}: {found} for {expected}");
        }
    }
}

/// Against the damping of D2, a motion creeps along `v^2 = -x/D2` and then stops within a step or two, at
/// `1/(2 D2)` to within a relative D3/D2^2. The reference time comes from the series with steps exact to rounding.
#[test]
fn a_step_that_begins_stiff_and_ends_at_rest_keeps_the_digits_of_its_end() {
    let field = HalfPlane { d: 0.0, d2: 122.0, d3: 0.015 };
    let start = StepPoint { x: -1.0, v: 0.0 };
    let series = run(&mut Taylor::new(1e-16), &field, start);
    for tolerance in [1e-6, 1e-9, 1e-11, 1e-13] {
        for first in [1e-2, 1.0, 10.0] {
            let mut stiff = StiffStepper::new(field, tolerance);
            stiff.next = first;
            let implicit = run(&mut stiff, &field, start);
            let error = (implicit.duration / series.duration - 1.0).abs();
            assert!(error < 10.0 * tolerance, "{tolerance:e}: {error:e}");
        }
        let auto = run(&mut AutoStepper::new(tolerance), &field, start);
        let error = (auto.duration / series.duration - 1.0).abs();
        assert!(error < 10.0 * tolerance, "{tolerance:e}, auto: {error:e}");
    }
}

fn run<S: Stepper>(stepper: &mut S, field: &HalfPlane, start: StepPoint) -> Swing {
    swing(stepper, field, (start, 0), (60.0, true), &Limits::PATIENT, |_, _, _, _| true)
}

#[test]
fn the_error_follows_the_tolerance() {
    let problem = |method, tolerance| Problem {
        parameters: Parameters { d: -0.1, d2: 0.3, d3: 0.4, r: 0.05 },
        initial: State { q: 2.0, v: -1.0 },
        until: 30.0,
        method,
        tolerance,
        ..Problem::default()
    };
    let run = |method, tolerance| {
        trajectory(&problem(method, tolerance), Detail::default(), &Limits::PATIENT).crossings
    };
    let reference = run(Method::Taylor, 1e-16);
    for tolerance in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13] {
        let found = run(Method::Stiff, tolerance);
        assert_eq!(found.len(), reference.len());
        let pairs = found.iter().zip(&reference);
        let error = pairs.map(|(one, other)| (one.q - other.q).abs()).fold(0.0, f64::max);
        assert!(error < 10.0 * tolerance, "{tolerance:e}: {error:e}");
    }
}

#[test]
fn dense_output_satisfies_the_equation_inside_a_step() {
    let field = HalfPlane { d: 0.3, d2: 0.2, d3: 5.0 };
    let mut stepper = StiffStepper::new(field, 1e-10);
    stepper.begin(&field);
    let mut point = StepPoint { x: -1.0, v: 0.2 };
    for _ in 0..6 {
        let step = stepper.advance(point, 10.0, true).unwrap();
        let time = 0.37 * step.duration;
        let (here, h) = (stepper.at(time), 1e-4 * step.duration);
        let (before, after) = (stepper.at(time - h), stepper.at(time + h));
        let slope =
            StepPoint { x: (after.x - before.x) / (2.0 * h), v: (after.v - before.v) / (2.0 * h) };
        assert!((slope.x - here.v).abs() < 1e-6);
        assert!((slope.v - field.acceleration(here.x, here.v)).abs() < 1e-5);
        assert_eq!(stepper.at(step.duration), step.end);
        point = step.end;
    }
}
