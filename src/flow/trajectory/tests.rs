//! Motions against closed forms and energy balances.

use proptest::prelude::*;

use super::*;
use crate::model::{Parameters, State};
use crate::numerics::elementary::{exp2, log2};

fn problem(parameters: [f64; 4], initial: (f64, f64), method: Method) -> Problem {
    let [d, d2, d3, r] = parameters;
    Problem {
        parameters: Parameters { d, d2, d3, r },
        initial: State { q: initial.0, v: initial.1 },
        until: 60.0,
        method,
        tolerance: 1e-12,
        step: 1e-3,
        ..Problem::default()
    }
}

fn run(problem: &Problem) -> Motion {
    let detail = Detail { samples_per_step: 4, energy: true, ..Detail::default() };
    trajectory(problem, detail, &Limits::PATIENT)
}

/// The methods that find events and control their error.
const METHODS_UNDER_TEST: [Method; 5] =
    [Method::Auto, Method::Taylor, Method::Dop853, Method::Dopri5, Method::Stiff];

#[test]
fn methods_agree_with_the_closed_form() {
    for d in [-0.999, -0.1, -1e-12, -0.0, 0.05, 0.7, 1.0, 2.0] {
        for start in [(2.0, 0.0), (-0.4, 1.5), (0.1, -1e-3)] {
            let exact = run(&problem([d, 0.0, 0.0, 0.1], start, Method::Exact));
            for method in METHODS_UNDER_TEST {
                let motion = run(&problem([d, 0.0, 0.0, 0.1], start, method));
                assert_eq!(motion.crossings.len(), exact.crossings.len(), "{method} D = {d}");
                for (one, other) in motion.crossings.iter().zip(&exact.crossings) {
                    let scale = other.q.abs().max(1.0) / (1.0 - d.abs()).abs().clamp(1e-3, 1.0);
                    assert!((one.q - other.q).abs() < 1e-9 * scale, "{method} D = {d}");
                }
            }
        }
    }
}

#[test]
fn a_start_in_the_sticking_set_stays_there() {
    for q in [-0.5, -0.0, 0.3, 0.5] {
        let motion = run(&problem([-0.1, 0.3, 1.0, 0.5], (q, 0.0), Method::Taylor));
        assert_eq!(motion.outcome, Outcome::Captured { tau: 0.0, q });
        assert!(motion.crossings.is_empty() && motion.cost.evaluations == 0);
    }
}

#[test]
fn one_ulp_outside_the_sticking_set_the_motion_swings_once_and_is_captured() {
    for method in METHODS_UNDER_TEST {
        let motion = run(&problem([-0.1, 0.3, 1.0, 0.5], (0.5_f64.next_up(), 0.0), method));
        assert_eq!(motion.crossings.len(), 1);
        assert!(matches!(motion.outcome, Outcome::Captured { q, .. } if q < 0.5 && q > 0.49));
    }
}

/// Without friction the field is smooth across `v = 0`: the same motion takes fewer steps.
#[test]
fn without_friction_nobody_looks_for_events_unless_asked() {
    for method in METHODS_UNDER_TEST {
        for parameters in [[-0.1, 0.2, 0.3, 0.0], [-0.1, 0.0, 0.0, 0.0]] {
            let question = problem(parameters, (2.0, -0.3), method);
            let ask = |crossings| {
                let detail = Detail { crossings, energy: true, ..Detail::default() };
                trajectory(&question, detail, &Limits::PATIENT)
            };
            let (with, without) = (ask(true), ask(false));
            assert!(with.crossings.len() > 15 && without.crossings.is_empty());
            assert!(without.cost.steps < with.cost.steps, "{method}: {:?}", without.cost);
            assert!(without.cost.evaluations < with.cost.evaluations);
            let (Outcome::Moving { q, v, .. }, Outcome::Moving { q: other_q, v: other_v, .. }) =
                (with.outcome, without.outcome)
            else {
                panic!("{with:?}")
            };
            assert!((q - other_q).abs().max((v - other_v).abs()) < 1e-10, "{method}");
            let ledger = without.ledger.unwrap();
            assert!(ledger.residual.abs() < 2e-11 * (ledger.start + ledger.end), "{method}");
            assert_eq!(ledger.work("friction"), 0.0);
        }
    }
}

#[test]
fn with_friction_events_are_found_whether_asked_for_or_not() {
    let question = problem([-0.1, 0.0, 0.05, 0.1], (2.0, 0.0), Method::Taylor);
    let detail = Detail { crossings: false, ..Detail::default() };
    let motion = trajectory(&question, detail, &Limits::PATIENT);
    assert_eq!(motion.crossings.len(), 19);
}

/// A fixed step that is unstable under the damping is refused, never taken.
#[test]
fn a_fixed_step_that_is_too_long_is_refused() {
    for method in [Method::Rk4, Method::SignRk4, Method::TimeStepping] {
        let question = problem([0.0, 0.0, 1.0, 0.1], (1e3, 0.0), method);
        let motion = run(&Problem { step: 0.1, ..question });
        assert!(
            matches!(motion.outcome, Outcome::GaveUp { reason: Reason::StepTooLong { .. }, .. }),
            "{method}: {:?}",
            motion.outcome
        );
    }
}

#[test]
fn the_classical_method_is_of_order_four_crossings_included() {
    let error = |step| {
        let question = problem([-0.1, 0.0, 0.05, 0.1], (2.0, 0.0), Method::Rk4);
        let fine = run(&Problem { method: Method::Taylor, ..question });
        let coarse = run(&Problem { step, ..question });
        assert_eq!(coarse.crossings.len(), fine.crossings.len());
        let pairs = coarse.crossings.iter().zip(&fine.crossings);
        pairs.map(|(one, other)| (one.q - other.q).abs()).fold(0.0, f64::max)
    };
    let order = log2(error(0.08) / error(0.005)) / 4.0;
    assert!((order - 4.0).abs() < 0.2, "{order}");
}

/// Newton's method finds the last step of a swing. The work must be that of this step, not of one that is
/// longer by the last correction.
#[test]
fn the_energy_ledger_of_a_short_motion_closes_to_rounding() {
    let parameters =
        [-0.365_483_966_295_592_54, -0.346_593_470_898_714_73, 0.0, 0.467_576_433_506_401_7];
    let start = (0.114_709_554_525_375_17, 0.240_786_143_619_961_45);
    for method in METHODS_UNDER_TEST {
        let ledger = run(&problem(parameters, start, method)).ledger.unwrap();
        assert!(ledger.residual.abs() < 1e-12 * ledger.start, "{method} {ledger:?}");
    }
}

fn parameters() -> impl Strategy<Value = [f64; 4]> {
    [-0.9..0.9, -1.0..1.0, -1.0..2.0, 0.0..0.5]
}

fn start() -> impl Strategy<Value = (f64, f64)> {
    (-3.0..3.0, prop_oneof![Just(0.0), -3.0..3.0])
}

#[test]
fn a_motion_without_end_gives_up_where_its_half_swings_fill_the_memory() {
    let problem = Problem { until: 1e9, ..problem([0.0; 4], (3.0, 0.0), Method::Auto) };
    let motion = trajectory(&problem, Detail::default(), &Limits::PATIENT);
    let Outcome::GaveUp { tau, reason: Reason::HalfSwings { most } } = motion.outcome else {
        panic!("{:?}", motion.outcome)
    };
    assert_eq!(motion.crossings.len(), most);
    let expected = std::f64::consts::PI * crate::numerics::count::real(most);
    assert!((tau / expected - 1.0).abs() < 1e-12, "{tau}");
    // Nothing happens at v = 0 without friction: where these are not asked for, it is followed to the end.
    let detail = Detail { crossings: false, ..Detail::default() };
    let glided = trajectory(&problem, detail, &Limits::PATIENT);
    assert!(matches!(glided.outcome, Outcome::Moving { tau: 1e9, .. }), "{:?}", glided.outcome);
}

proptest! {
    #[test]
    fn scaling_by_a_power_of_two_changes_no_bit(
        parameters in parameters(), start in start(), k in -400_i32..=400,
    ) {
        let unit = exp2(f64::from(k));
        for method in METHODS_UNDER_TEST {
            let plain = run(&problem(parameters, start, method));
            let [d, d2, d3, r] = parameters;
            let scaled = [d, d2 / unit, d3 / unit / unit, r * unit];
            let big = run(&problem(scaled, (start.0 * unit, start.1 * unit), method));
            prop_assert_eq!(plain.crossings.len(), big.crossings.len());
            for (plain, big) in plain.crossings.iter().zip(&big.crossings) {
                prop_assert_eq!((plain.q * unit).to_bits(), big.q.to_bits());
                prop_assert_eq!(plain.tau.to_bits(), big.tau.to_bits());
            }
            for (plain, big) in plain.samples.iter().zip(&big.samples) {
                prop_assert_eq!((plain.q * unit, plain.v * unit), (big.q, big.v));
            }
        }
    }

    #[test]
    fn a_mirrored_motion_is_the_mirror_image(parameters in parameters(), start in start()) {
        for method in METHODS_UNDER_TEST {
            let plain = problem(parameters, start, method);
            let mirrored = Problem {
                parameters: plain.parameters.mirrored(),
                initial: plain.initial.mirrored(),
                ..plain
            };
            let (plain, mirrored) = (run(&plain), run(&mirrored));
            prop_assert_eq!(plain.samples.len(), mirrored.samples.len());
            for (one, other) in plain.samples.iter().zip(&mirrored.samples) {
                prop_assert_eq!((one.tau, one.q, one.v), (other.tau, -other.q, -other.v));
            }
        }
    }

    #[test]
    fn the_energy_ledger_closes(parameters in parameters(), start in start()) {
        for method in METHODS_UNDER_TEST {
            if let Some(ledger) = run(&problem(parameters, start, method)).ledger {
                prop_assert!(ledger.imbalance().abs() <= 2e-11, "{method} {ledger:?}");
            }
        }
    }

    #[test]
    fn friction_never_gains_and_time_never_runs_back(
        parameters in parameters(), start in start(),
    ) {
        let motion = run(&problem(parameters, start, Method::Taylor));
        prop_assert!(motion.samples.windows(2).all(|pair| pair[0].tau <= pair[1].tau));
        if let Some(ledger) = motion.ledger {
            prop_assert!(ledger.work("friction") <= 0.0);
        }
    }
}
