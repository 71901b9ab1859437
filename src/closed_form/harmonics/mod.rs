//! Harmonic balance of N harmonics (equations 34 to 36), with the friction projected exactly.
//!
//! The paper approximates a cycle by `q = A0 + sum of a_k cos(k eta tau) + b_k sin(k eta tau)` and then
//! takes N = 1. Here N is chosen freely. [`harmonic_cycle`] begins at a first-order answer
//! ([`super::harmonic`]) and follows it: first in the *strength* of damping and friction, then in N.
//! With `D, D2, D3, r` all multiplied by a strength s, the first-order amplitude stays what it is and
//! becomes exact as `s -> 0`, so that every first-order answer is the beginning of one branch of
//! N-harmonic answers. Where that branch ends before `s = 1`, as it does between the first-order fold
//! and the fold of N harmonics, there is no answer, and this is said.
//!
//! Friction jumps where the velocity changes its sign, so that q has jumps in its second derivative and
//! its series converges slowly: the error of the amplitude falls as `1/N^2`, that of the frequency, which
//! feels the shift of the sign changes themselves, as `1/N`. Without friction both fall exponentially.
//!
//! - [`fourier`]: finite series, their products and their roots, none missed.
//! - [`galerkin`]: the equations, their Jacobian and their solution.

pub mod fourier;
pub mod galerkin;

pub(crate) use self::{fourier::*, galerkin::*};

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::Harmonic;
use crate::model::{Parameters, Reason, Result, State};
use crate::numerics::{exponent, range, real, times_power};

/// Maximum number of harmonics: the linear algebra costs as their cube.
pub const MOST: usize = 255;

/// A cycle as N harmonics have it.
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicCycle {
    /// Whether it attracts; the branch inherits that from the first-order answer.
    pub stable: bool,
    /// Left turning point.
    pub q_min: f64,
    /// Right turning point.
    pub q_max: f64,
    /// Smallest velocity.
    pub v_min: f64,
    /// Largest velocity.
    pub v_max: f64,
    /// Mean displacement A0.
    pub mean: f64,
    /// Frequency eta.
    pub frequency: f64,
    /// `2 pi/eta`.
    pub period: f64,
    /// Instants of a turn at which `v = 0`. A cycle has two; more say that N harmonics do not describe
    /// what is there, or that nothing is there to be described.
    pub crossings: usize,
    /// The most that any Galerkin equation leaves, relative to the largest term in them.
    pub residual: f64,
    /// Displacement over the angle `eta tau`.
    pub displacement: Fourier,
}

/// The cycle of `count` harmonics (at least 1, at most [`MOST`]) that begins at a first-order answer.
///
/// One harmonic is the first-order answer itself. Guarantee: the Galerkin equations hold to rounding;
/// how far the cycle is from the true one is another question, which `accuracy::harmonic_error` answers. The
/// mirrored oscillator has the mirrored cycle, to the last bit.
///
/// # Errors
/// [`Reason`] says why there is none.
pub fn harmonic_cycle(
    parameters: &Parameters,
    first: &Harmonic,
    count: usize,
    interrupted: &dyn Fn() -> bool,
) -> Result<HarmonicCycle> {
    // Where N is too small for the cycle, rounding decides between branches: only one of the mirror images is computed.
    if parameters.d2 < 0.0 {
        let first = Harmonic { mean: -first.mean, ..*first };
        let cycle = harmonic_cycle(&parameters.mirrored(), &first, count, interrupted)?;
        return Ok(cycle.mirrored());
    }
    Continuation::new(parameters, first, interrupted).cycle(count.clamp(1, MOST))
}

/// The branch of solutions that begins at one first-order answer, in units of a power of two that makes
/// the first-order amplitude about 1.
struct Continuation<'a> {
    parameters: Parameters,
    first: Ansatz,
    stable: bool,
    /// Exponent of the unit of length.
    unit: i32,
    interrupted: &'a dyn Fn() -> bool,
}

/// Harmonics that are enough to follow a branch in the strength.
const COARSE: usize = 7;

impl<'a> Continuation<'a> {
    fn new(parameters: &Parameters, first: &Harmonic, interrupted: &'a dyn Fn() -> bool) -> Self {
        let unit = exponent(first.amplitude);
        let mean = Complex::from(times_power(first.mean, -unit));
        let wave = Complex::from(0.5 * times_power(first.amplitude, -unit));
        let first_order = Ansatz { frequency: 1.0, q: Fourier { coefficients: vec![mean, wave] } };
        let parameters = parameters.times_power(-unit);
        Continuation { parameters, first: first_order, stable: first.stable, unit, interrupted }
    }

    fn cycle(&self, count: usize) -> Result<HarmonicCycle> {
        if count == 1 {
            let residual = BalanceResidual::new(&self.parameters, count, &self.first);
            return self.describe(&residual);
        }
        let mut solution = match self.strengthened(count.min(COARSE)) {
            // The folds of few and of many harmonics differ a little.
            Err(Reason::Harmonics { .. }) if count > COARSE => self.strengthened(count)?,
            other => other?,
        };
        while solution.ansatz.q.degree() < count {
            let more = (2 * solution.ansatz.q.degree() + 1).min(count);
            solution = match self.solve(&self.parameters, more, &solution.ansatz) {
                Err(Reason::Harmonics { .. }) => self.strengthened(count)?,
                other => other?,
            };
        }
        self.describe(&solution)
    }

    /// Follows the branch from no damping and friction to all of it, with secants as predictors.
    fn strengthened(&self, count: usize) -> Result<BalanceResidual> {
        /// Smallest step.
        const SMALLEST: f64 = 1.0 / 256.0;
        let (mut here, mut step) = (BranchPlace { strength: 0.0, ansatz: self.first.clone() }, 1.0);
        here.ansatz.q.coefficients[0] = Complex::default();
        // Of the first-order answer only its mean (equation 40) depends on the strength, in proportion to it.
        let mut before = Some(BranchPlace { strength: 1.0, ansatz: self.first.clone() });
        loop {
            let s = f64::min(here.strength + step, 1.0);
            let weaker = self.parameters.map(|number| s * number);
            let onwards = before.as_ref().map(|before| secant(before, &here, s));
            let start = onwards.unwrap_or_else(|| here.ansatz.clone());
            match self.solve(&weaker, count, &start) {
                Ok(solution) if s == 1.0 => return Ok(solution),
                Ok(solution) => {
                    let there = BranchPlace { strength: s, ansatz: solution.ansatz };
                    let was = std::mem::replace(&mut here, there);
                    before = Some(was).filter(|was| was.strength > 0.0);
                    step *= 2.0;
                }
                Err(Reason::Harmonics { .. }) if step > SMALLEST => step *= 0.5,
                Err(Reason::Harmonics { count, .. }) => {
                    return Err(Reason::Harmonics { count, strength: here.strength });
                }
                Err(lost) => return Err(lost),
            }
        }
    }

    /// A solution on this branch, not on another one.
    fn solve(
        &self,
        parameters: &Parameters,
        count: usize,
        start: &Ansatz,
    ) -> Result<BalanceResidual> {
        /// Part of the first-order amplitude below which a solution is the steady state.
        const VANISHED: f64 = 1e-6;
        let (solution, unstable) = solve(parameters, count, start, self.interrupted)?;
        let Ansatz { frequency, q } = &solution.ansatz;
        if unstable == self.stable || q.cosine(1) < VANISHED || *frequency <= 0.0 {
            return Err(Reason::Harmonics { count, strength: 1.0 });
        }
        Ok(solution)
    }

    /// Reads everything out, in the units of the question.
    fn describe(&self, residual: &BalanceResidual) -> Result<HarmonicCycle> {
        let sized = |value| times_power(value, self.unit);
        let Ansatz { frequency, q } = &residual.ansatz;
        let (frequency, (q_min, q_max)) = (*frequency, extremes(q));
        let (p_min, p_max) = extremes(&q.derivative());
        let cycle = HarmonicCycle {
            stable: self.stable,
            q_min: sized(q_min),
            q_max: sized(q_max),
            v_min: sized(frequency * p_min),
            v_max: sized(frequency * p_max),
            mean: sized(q.mean()),
            frequency,
            period: TAU / frequency,
            crossings: residual.crossings.len(),
            residual: residual.relative(),
            displacement: q.map(sized),
        };
        let numbers =
            [cycle.q_min, cycle.q_max, cycle.v_min, cycle.v_max, cycle.mean, cycle.period];
        let in_range = numbers.iter().all(|number| number.is_finite());
        in_range.then_some(cycle).ok_or(Reason::OutOfRange)
    }
}

/// A place on the branch to all of damping and friction: how much of them there is, and the cycle.
struct BranchPlace {
    strength: f64,
    ansatz: Ansatz,
}

/// The line through two solutions, at strength `s`.
fn secant(before: &BranchPlace, here: &BranchPlace, s: f64) -> Ansatz {
    let ahead = (s - here.strength) / (here.strength - before.strength);
    let mut next = here.ansatz.clone();
    next.frequency += ahead * (here.ansatz.frequency - before.ansatz.frequency);
    for (k, coefficient) in next.q.coefficients.iter_mut().enumerate() {
        *coefficient += (*coefficient - before.ansatz.q.coefficient(k.cast_signed())) * ahead;
    }
    next
}

/// Smallest and largest value: those at the roots of the derivative.
fn extremes(function: &Fourier) -> (f64, f64) {
    let turns = sign_changes(&function.derivative());
    let values = turns.iter().map(|turn| function.at::<1>(turn.angle)[0]);
    range([function.mean()].into_iter().chain(values))
}

impl HarmonicCycle {
    /// Half of what lies between the turning points.
    pub fn amplitude(&self) -> f64 {
        0.5 * (self.q_max - self.q_min)
    }

    /// The cycle with the opposite displacement, half a turn later, where its phase is again that of the paper.
    fn mirrored(mut self) -> Self {
        for even in self.displacement.coefficients.iter_mut().step_by(2) {
            *even = -*even;
        }
        HarmonicCycle {
            q_min: -self.q_max,
            q_max: -self.q_min,
            v_min: -self.v_max,
            v_max: -self.v_min,
            mean: -self.mean,
            ..self
        }
    }

    /// The closed curve in the phase plane, with `points` points evenly spaced in time and the first one
    /// repeated at the end.
    pub fn curve(&self, points: usize) -> Vec<State> {
        let state = |index: usize| {
            let [q, p] = self.displacement.at(TAU * (real(index % points) / real(points)));
            State { q, v: self.frequency * p }
        };
        (0..=points).map(state).collect()
    }
}

#[cfg(test)]
mod tests {
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
    fn all(parameters: &Parameters, count: usize) -> Vec<Result<HarmonicCycle, Reason>> {
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
            assert!(
                (cycle.q_max / exact.q_max - 1.0).abs() < 1e-14,
                "{}",
                cycle.q_max / exact.q_max
            );
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
            let Err(Reason::Harmonics { count: 9, strength }) = lost else { panic!("{lost:?}") };
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
        let q = |index: usize| cycle.displacement.at::<1>(turns[index % turns.len()].angle)[0];
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
                let branch = Continuation::new(&parameters, &first, &|| false);
                if let Ok((_, unstable)) = solve(&branch.parameters, 1, &branch.first, &|| false) {
                    prop_assert_eq!(unstable, !first.stable);
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
            prop_assert!(cycle.displacement.coefficients[1].im == 0.0 && cycle.displacement.cosine(1) > 0.0);
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
}
