//! What N harmonics must give: known numbers, exact laws, and honest failures.

use proptest::prelude::*;

use super::*;
use crate::closed_form::harmonic::{amplitudes, fold};
use crate::closed_form::piecewise_linear::LinearCycle;
use crate::numerics::elementary::{log2, powi};

fn oscillator(d: f64, d2: f64, d3: f64, r: f64) -> Parameters {
    Parameters { d, d2, d3, r }
}

/// The cycles that begin at each first-order answer.
fn all(parameters: &Parameters, count: usize) -> Vec<Result<HarmonicCycle, Lost>> {
    let from = |first: &Harmonic| harmonic_cycle(parameters, first, count, &|| false);
    amplitudes(parameters).iter().map(from).collect()
}

fn only(parameters: &Parameters, count: usize) -> HarmonicCycle {
    match all(parameters, count).pop() {
        Some(Ok(cycle)) => cycle,
        other => panic!("{parameters:?}, N = {count}: {other:?}"),
    }
}

/// Relative errors of amplitude and frequency against the closed form.
fn errors(d: f64, count: usize) -> (f64, f64) {
    let exact = LinearCycle::new(d, 0.1).unwrap();
    let cycle = only(&oscillator(d, 0.0, 0.0, 0.1), count);
    (1.0 - cycle.q_max / exact.q_max, cycle.frequency * exact.period / TAU - 1.0)
}

#[test]
fn more_harmonics_come_closer_to_the_true_amplitude() {
    for (count, expected) in [(1, 0.0909), (3, 0.1018), (9, 0.1075), (31, 0.1093)] {
        let cycle = only(&oscillator(-0.7, 0.0, 0.0, 0.1), count);
        assert!((cycle.q_max - expected).abs() <= 0.5001e-4, "{count}: {}", cycle.q_max);
        assert_eq!(cycle.crossings, 2);
    }
    assert!((LinearCycle::new(-0.7, 0.1).unwrap().q_max - 0.10964).abs() < 0.5e-5);
}

#[test]
fn friction_makes_the_amplitude_converge_as_the_square_and_the_frequency_as_the_first_power() {
    for d in [-0.1, -0.4, -0.7] {
        let ((amplitude, frequency), (amplitude_of_more, frequency_of_more)) =
            (errors(d, 63), errors(d, 127));
        let gain = |few: f64, more: f64| log2(few / more);
        let orders = (gain(amplitude, amplitude_of_more), gain(frequency, frequency_of_more));
        assert!((1.8..2.2).contains(&orders.0), "amplitude, D = {d}: {}", orders.0);
        assert!((0.9..1.1).contains(&orders.1), "frequency, D = {d}: {}", orders.1);
    }
}

#[test]
fn without_friction_the_series_converges_exponentially() {
    let cycle = |count| only(&oscillator(-0.3, 0.2, 0.5, 0.0), count);
    let exact = cycle(63);
    let error = |count: usize| (cycle(count).amplitude() - exact.amplitude()).abs();
    let errors = [3, 7, 15, 31].map(error);
    assert!(errors[0] < 1e-1 && errors[1] < 1e-3 && errors[2] < 1e-6, "{errors:?}");
    assert!(errors[3] < 1e-12, "{errors:?}");
}

#[test]
fn weak_damping_and_friction_make_one_harmonic_exact() {
    for count in [3, 31] {
        let cycle = only(&oscillator(-1e-12, 0.0, 0.0, 0.1), count);
        let exact = LinearCycle::new(-1e-12, 0.1).unwrap();
        assert!((cycle.q_max / exact.q_max - 1.0).abs() < 1e-14, "{}", cycle.q_max / exact.q_max);
        assert!((cycle.frequency - 1.0).abs() < 1e-14);
    }
}

#[test]
fn between_the_folds_of_one_and_of_many_harmonics_the_branch_ends() {
    let Some(first) = fold(0.5, 0.1) else { panic!("a fold") };
    // The true fold at D2 = 0.2 lies at -0.17278, that of one harmonic at -0.17246.
    let beyond = all(&oscillator(0.5 * (first.d - 0.17278), 0.2, 0.5, 0.1), 9);
    assert_eq!(beyond.len(), 2);
    for lost in beyond {
        let Err(Lost::Ends { harmonics: 9, strength }) = lost else { panic!("{lost:?}") };
        assert!(strength > 0.5 && strength < 1.0, "{strength}");
    }
    let [Ok(inner), Ok(outer)] = &all(&oscillator(-0.1729, 0.2, 0.5, 0.1), 9)[..] else {
        panic!("two cycles")
    };
    assert!(!inner.stable && outer.stable && inner.q_max < outer.q_max);
}

#[test]
fn a_cycle_that_is_not_there_shows_by_its_crossings() {
    // Without cubic damping, D2 lets no cycle live above D_c = -0.015958 r abs(D2)/0.02.
    let cycle = only(&oscillator(-0.01, 0.2, 0.0, 0.1), 31);
    assert!(cycle.crossings > 2, "{cycle:?}");
}

#[test]
fn extremes_have_cycles_or_reasons_but_never_nan() {
    let d = [-1.001, -1.0, -0.999_999, -0.999, -1e-12, -0.0, 0.0, 1e-150, 0.5, 2.0];
    let r = [0.0, 1e-150, 1e-12, 1.0, 1e12];
    let d3 = [-1e6, -1e-12, 0.0, 1e-12, 1e6];
    for (d, r, d3) in d.iter().flat_map(|d| r.map(|r| d3.map(|d3| (*d, r, d3)))).flatten() {
        for d2 in [0.0, 0.3, -1e6] {
            for cycle in all(&oscillator(d, d2, d3, r), 5).into_iter().flatten() {
                let numbers = [cycle.q_min, cycle.q_max, cycle.v_min, cycle.v_max, cycle.mean];
                assert!(numbers.iter().all(|number| number.is_finite()), "{cycle:?}");
                assert!(cycle.frequency > 0.0 && cycle.q_min <= cycle.q_max, "{cycle:?}");
                assert!(cycle.residual < 1e-12, "{d} {d2} {d3} {r} {cycle:?}");
            }
        }
    }
}

/// What one turn gives and takes, in works per turn: linear, quadratic and cubic damping, friction.
fn works(parameters: &Parameters, cycle: &HarmonicCycle) -> [f64; 4] {
    let Parameters { d, d2, d3, r } = *parameters;
    let v = cycle.displacement.derivative().map(|p| cycle.frequency * p);
    let square = v.product(&v, 2 * v.degree());
    // The way from turning point to turning point is what friction acts along.
    let turns = sign_changes(&v);
    let q = |index: usize| cycle.displacement.at(turns[index % turns.len()].angle).value;
    let way: f64 = (0..turns.len()).map(|index| (q(index + 1) - q(index)).abs()).sum();
    let mean = |f: &Fourier, g: &Fourier| f.product(g, 0).mean();
    [
        2.0 * d * mean(&v, &v) * cycle.period,
        d2 * mean(&square, &v) * cycle.period,
        d3 * mean(&square, &square) * cycle.period,
        r * way,
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn one_harmonic_is_the_first_order_answer(
        d in -0.99..0.5, d2 in -1.0..1.0, d3 in -1.0..1.0, r in 0.0..0.5,
    ) {
        let parameters = oscillator(d, d2, d3, r);
        for first in amplitudes(&parameters) {
            let cycle = harmonic_cycle(&parameters, &first, 1, &|| false).unwrap();
            prop_assert_eq!((cycle.stable, cycle.frequency), (first.stable, 1.0));
            prop_assert_eq!(cycle.mean, first.mean);
            prop_assert_eq!(cycle.displacement.cosine(1), first.amplitude);
            let scale = f64::EPSILON * (first.mean.abs() + first.amplitude);
            prop_assert!((cycle.q_max - (first.mean + first.amplitude)).abs() <= scale);
            prop_assert!((cycle.q_min - (first.mean - first.amplitude)).abs() <= scale);
            prop_assert!((cycle.v_max - first.amplitude).abs() <= scale);
            // The equations agree that it is their solution, and with its stability.
            prop_assert!(cycle.residual <= 16.0 * f64::EPSILON, "{}", cycle.residual);
            let branch = Followed::new(&parameters, &first, &|| false);
            let basis = Basis::new(&branch.parameters, 1);
            if let Ok(again) = solve(&branch.parameters, basis, &branch.first, &|| false) {
                prop_assert_eq!(again.unstable, !first.stable);
            }
        }
    }

    #[test]
    fn what_one_turn_takes_it_gives(
        d in -0.9..0.3, d2 in -1.0..1.0, d3 in -1.0..1.0, r in 1e-3..0.5, count in 1_usize..20,
    ) {
        let parameters = oscillator(d, d2, d3, r);
        for cycle in all(&parameters, count).into_iter().flatten() {
            let works = works(&parameters, &cycle);
            let size = works.iter().fold(0.0, |size: f64, work| size.max(work.abs()));
            prop_assert!(works.iter().sum::<f64>().abs() < 1e-10 * size, "{works:?} {cycle:?}");
            prop_assert!(cycle.residual < 1e-14, "{cycle:?}");
        }
    }

    #[test]
    fn symmetric_oscillators_have_odd_harmonics_only(
        d in -0.9..0.3, d3 in -1.0..1.0, r in 1e-3..0.5, count in 2_usize..20,
    ) {
        for cycle in all(&oscillator(d, 0.0, d3, r), count).into_iter().flatten() {
            let even = cycle.displacement.coefficients.iter().step_by(2);
            prop_assert!(even.into_iter().all(|c| *c == Complex::default()));
            prop_assert!((cycle.q_min + cycle.q_max).abs() < 1e-14 * cycle.q_max);
            prop_assert!((cycle.v_min + cycle.v_max).abs() < 1e-13 * cycle.v_max);
        }
    }

    #[test]
    fn the_phase_is_that_of_the_paper(d in -0.9..-0.1, d2 in -1.0..1.0, count in 1_usize..20) {
        let cycle = only(&oscillator(d, d2, 0.5, 0.01), count);
        prop_assert!(cycle.displacement.sine(1) == 0.0 && cycle.displacement.cosine(1) > 0.0);
    }

    #[test]
    fn powers_of_two_scale_bit_for_bit(
        d in -0.9..0.3, d2 in -1.0..1.0, d3 in -1.0..1.0, r in 1e-3..0.5, k in -40..40,
    ) {
        let unit = powi(2.0, k);
        let (one, other) = (
            all(&oscillator(d, d2, d3, r), 7),
            all(&oscillator(d, d2 / unit, d3 / (unit * unit), r * unit), 7),
        );
        prop_assert_eq!(one.len(), other.len());
        for (one, other) in one.into_iter().zip(other) {
            match (one, other) {
                (Ok(one), Ok(other)) => {
                    prop_assert_eq!(one.displacement.map(|q| unit * q), other.displacement);
                    prop_assert_eq!(one.frequency, other.frequency);
                    prop_assert_eq!(unit * one.q_max, other.q_max);
                    prop_assert_eq!(unit * one.v_min, other.v_min);
                }
                (one, other) => prop_assert_eq!(one, other),
            }
        }
    }

    #[test]
    fn mirrored_oscillators_have_mirrored_cycles(d in -0.9..0.3, d2 in 0.0..1.0, d3 in -1.0..1.0) {
        let parameters = oscillator(d, d2, d3, 0.1);
        for pair in all(&parameters, 9).into_iter().zip(all(&parameters.mirrored(), 9)) {
            match pair {
                (Ok(one), Ok(other)) => {
                    let (low, high) = extremes(&other.displacement);
                    prop_assert_eq!((one.q_min, one.q_max), (-other.q_max, -other.q_min));
                    prop_assert_eq!((one.v_min, one.v_max), (-other.v_max, -other.v_min));
                    prop_assert_eq!((one.mean, one.frequency), (-other.mean, other.frequency));
                    // The series describes the mirrored cycle, too.
                    let size = one.q_max - one.q_min;
                    prop_assert!((low - other.q_min).abs().max((high - other.q_max).abs()) < 1e-13 * size);
                }
                (one, other) => prop_assert_eq!(one.is_ok(), other.is_ok()),
            }
        }
    }

    #[test]
    fn curves_close_and_pass_through_the_extremes(d in -0.9..-0.1, count in 1_usize..20) {
        let cycle = only(&oscillator(d, 0.3, 0.0, 0.1), count);
        let curve = cycle.curve(2000);
        prop_assert_eq!(curve.first(), curve.last());
        let largest = |of: fn(&State) -> f64| curve.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let (q, v) = (largest(|state| state.q), largest(|state| state.v));
        prop_assert!(q <= cycle.q_max * (1.0 + 1e-14) && q > cycle.q_max * (1.0 - 1e-3));
        prop_assert!(v <= cycle.v_max * (1.0 + 1e-14) && v > cycle.v_max * (1.0 - 1e-3));
    }
}
