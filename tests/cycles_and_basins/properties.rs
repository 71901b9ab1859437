//! Motions over the whole range of floating-point numbers, and cycles over that of the program, have typed answers within
//! their budget, and every number in them is finite.

use hopfscope::flow::trajectory::trajectory;
use hopfscope::flow::{Detail, Limits, METHODS, Outcome, Problem};
use hopfscope::model::{Parameters, State};
use hopfscope::numerics::elementary::pow;
use hopfscope::portrait::basin::cycle::cycles;
use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
use proptest::prelude::*;

/// Any finite number, including subnormal ones and both zeros.
fn any_number() -> impl Strategy<Value = f64> {
    let moderate = prop_oneof![-2.0..2.0, -1e6..1e6];
    prop_oneof![
        3 => POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO,
        3 => moderate,
        1 => prop::sample::select(&[0.0, -0.0, 1.0, -1.0, 5e-324, f64::MAX, f64::MIN, f64::EPSILON][..]),
    ]
}

/// A number that the program takes: 0, or 1e-150 .. 1e150 in magnitude.
fn within_range(number: f64) -> f64 {
    if number.abs() < 1e-150 {
        0.0
    } else {
        number.clamp(-1e150, 1e150)
    }
}

fn any_parameters() -> impl Strategy<Value = Parameters> {
    (any_number(), any_number(), any_number(), any_number()).prop_map(|(d, d2, d3, r)| Parameters {
        d,
        d2,
        d3,
        r: r.abs(),
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_500))]

    #[test]
    fn motions_have_typed_answers(
        parameters in any_parameters(),
        (q, v) in (any_number(), any_number()),
        method in 0..METHODS.len(),
        exponent in -15.0..-2.0_f64,
        (until, step, epsilon) in (0.0..1e9_f64, 1e-7..1.0_f64, 1e-12..1e6_f64),
        (crossings, energy, samples_per_step) in (any::<bool>(), any::<bool>(), 0..3_usize),
    ) {
        /// The budget of evaluations, and the maximum number for a step that begins just below it.
        const BUDGET: (u64, u64) = (4_000, 20_000);
        let problem = Problem {
            parameters,
            initial: State { q, v },
            until,
            method: METHODS[method].method,
            tolerance: pow(10.0, exponent),
            step,
            epsilon,
        };
        let limits = Limits { evaluations: BUDGET.0, ..Limits::PATIENT };
        let motion = trajectory(&problem, Detail { crossings, energy, samples_per_step }, &limits);
        prop_assert!(motion.cost.evaluations <= BUDGET.0 + BUDGET.1, "{:?}", motion.cost);
        let end = match motion.outcome {
            Outcome::Captured { tau, q } => [tau, q, 0.0],
            Outcome::Moving { tau, q, v } => [tau, q, v],
            Outcome::Escaped { tau } | Outcome::GaveUp { tau, .. } => [tau, 0.0, 0.0],
        };
        prop_assert!(end.iter().all(|number| number.is_finite()), "{:?}", motion.outcome);
        prop_assert!((0.0..=until).contains(&end[0]), "{:?}", motion.outcome);
        for crossing in &motion.crossings {
            prop_assert!(crossing.tau.is_finite() && crossing.q.is_finite(), "{crossing:?}");
        }
        prop_assert!(motion.crossings.windows(2).all(|pair| pair[0].tau <= pair[1].tau));
        for sample in &motion.samples {
            prop_assert!(!(sample.tau.is_nan() || sample.q.is_nan() || sample.v.is_nan()));
        }
        if let Some(ledger) = motion.ledger {
            prop_assert!(ledger.residual.is_finite());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn cycles_have_typed_answers(any in any_parameters()) {
        let Parameters { d, d2, d3, r } = any;
        let [d, d2, d3, r] = [d, d2, d3, r].map(within_range);
        let parameters = Parameters { d, d2, d3, r };
        let limits = Limits { evaluations: 10_000, ..Limits::PATIENT };
        let Ok(found) = cycles(&parameters, &limits) else { return Ok(()) };
        for cycle in &found.cycles {
            let numbers = [
                cycle.q_min, cycle.q_max, cycle.v_min, cycle.v_max, cycle.period, cycle.clearance,
                cycle.log_clearance, cycle.log_multiplier,
            ];
            prop_assert!(numbers.iter().all(|number| number.is_finite()), "{cycle:?}");
            prop_assert!(cycle.multiplier.is_none_or(f64::is_finite));
            prop_assert!(cycle.q_max >= parameters.r && cycle.q_min <= -parameters.r, "{cycle:?}");
            prop_assert!(cycle.v_min <= 0.0 && 0.0 <= cycle.v_max && cycle.period > 0.0, "{cycle:?}");
            prop_assert_eq!(cycle.stable, cycle.log_multiplier < 0.0);
        }
        // Nested, since no motion can pass from one cycle to another.
        for pair in found.cycles.windows(2) {
            prop_assert!(pair[0].q_max <= pair[1].q_max && pair[0].q_min >= pair[1].q_min);
            prop_assert!(pair[0].stable != pair[1].stable, "{pair:?}");
        }
    }
}

#[test]
fn the_multiplier_beside_the_largest_cubic_damping_is_a_number() {
    let parameters = Parameters {
        d: -0.409_517_798_157_504_83,
        d2: 1.805_365_189_941_928_8e-284,
        d3: f64::MAX,
        r: 7.460_669_323_394_54e-309,
    };
    let limits = Limits { evaluations: 10_000, ..Limits::PATIENT };
    let found = cycles(&parameters, &limits).unwrap();
    let [cycle, outer] = &found.cycles[..] else { panic!("{found:?}") };
    assert!(outer.stable && outer.log_multiplier < 0.0, "{outer:?}");
    // Such a small cycle is unaffected by D3: its multiplier is that of the linear equation, e^(2 x).
    let x = -std::f64::consts::PI * parameters.d / parameters.omega().unwrap();
    assert!((cycle.log_multiplier / (2.0 * x) - 1.0).abs() < 1e-6, "{cycle:?}");
}
