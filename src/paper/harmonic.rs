//! Sections 5.2 to 6.2: the harmonic approximation and how near it comes; stationary amplitudes, the fold, characteristic
//! points and asymptotes.

use std::f64::consts::{E, PI, TAU};

use super::{
    Approximation, Check, ClaimCase, Conclusion, Evidence, always, at_rest, missing, tends, worst,
};
use crate::accuracy::harmonic_balance;
use crate::branch::{FoldPoint, fold};
use crate::closed_form::{HarmonicCycle, amplitudes, harmonic, mean as harmonic_mean};
use crate::flow::Result;
use crate::model::Parameters;
use crate::numerics::interval::PI as PI_BOUNDS;
use crate::numerics::{Interval, cbrt, powi, sin};
use crate::portrait::cycles;

pub(super) const CHECKS: &[Check] = &[
    worst("Fourier series", |it| {
        let [few, many] = [3, 31].map(|number| by_harmonics(it, number));
        let computed = it.smallest()?.amplitude();
        Ok(Evidence::tends((few?, computed), (many?, computed)))
    }),
    worst("second derivative", |_| {
        // Central differences of the velocity - A eta sin(eta tau), two of them.
        let (size, eta) = (0.7, 1.3);
        let velocity = |tau: f64| -size * eta * sin(eta * tau);
        let slope = |h: f64| {
            (8.0 * (velocity(h) - velocity(-h)) - velocity(2.0 * h) + velocity(-2.0 * h))
                / (12.0 * h)
        };
        let computed = Approximation::twice(slope(1e-3), slope(2e-3));
        Ok(Evidence::equal(0.0, computed).corrected(-size * eta * eta))
    }),
    worst("frequency of cycles", |it| {
        let cycle = it.smallest()?;
        let frequency = cycle.known(TAU / cycle.period, |it| PI_BOUNDS.twice() / it.period);
        Ok(Evidence::near(1.0, frequency))
    }),
    tends("harmonic cycles", |it| {
        let cycle = it.smallest()?;
        Ok((1.0, cycle.known(cycle.v_max / cycle.q_max, |it| it.v_max / it.q_max)))
    }),
    worst("mean displacement", |it| {
        let (cycle, amplitude) = (it.largest()?, largest_amplitude(it)?);
        Ok(Evidence::near(harmonic_mean(it.d2, amplitude), it.mean(&cycle)?))
    }),
    worst("slow change of amplitude", |it| {
        let size = it.more;
        let [left, _] = it.half_swing(size)?;
        let [right, _] = it.half_swing(left.value)?;
        let turns = it.enclosed(at_rest(size), 10.0).turns;
        let bounds = turns.get(1).and_then(|turn| Some(turn.q? - Interval::point(size)));
        let computed =
            Approximation::new(right.value - size, right.error + left.error).within(bounds);
        let Parameters { d, d3, r, .. } = **it;
        let printed = -4.0 * r / PI - 2.0 * d * size - 0.75 * d3 * powi(size, 3);
        Ok(Evidence::near(TAU * printed, computed).corrected(PI * printed))
    }),
    worst("amplitude as size", |it| {
        Ok(Evidence::near(largest_amplitude(it)?, it.smallest()?.amplitude()))
    }),
    tends("A_q at D = -1", |it| Ok((1.0, it.smallest()?.extent()))),
    tends("A_q and A_v at D = 0", |it| {
        let cycle = it.smallest()?;
        Ok((cycle.v_max, cycle.extent()))
    }),
    worst("amplitude between extents", |it| {
        amplitude_and_extents(it, |a, low, high| low <= a && a <= high)
    }),
    worst("amplitude below extents", |it| amplitude_and_extents(it, |a, low, _| a < low)),
    tends("A_v at D = -1", |it| Ok((2.0 / E, it.smallest()?.speed()))),
    worst("unstable amplitude", |it| {
        let unstable = amplitudes(it).first().ok_or(missing("a stationary amplitude"))?.amplitude;
        Ok(Evidence::near(unstable, it.smallest()?.amplitude()))
    }),
    worst("stable amplitude", |it| {
        Ok(Evidence::near(largest_amplitude(it)?, it.largest()?.amplitude()))
    }),
    worst("discriminant", |it| {
        let Parameters { d, d3, r, .. } = **it;
        let (a, b) = (8.0 * d / (3.0 * d3), 16.0 * r / (3.0 * PI * d3));
        let (cube, square) = (-4.0 * a * a * a, 27.0 * b * b);
        // What is left of the difference of two terms is uncertain by their rounding.
        let error = 32.0 * f64::EPSILON * (cube.abs() + square);
        let computed = Approximation::new(cube - square, error);
        let scale = powi(16.0 / (3.0 * d3), 2) / 3.0;
        let formula = scale * (-8.0 * d * d * (d / d3) - powi(9.0 / PI, 2) * r * r);
        Ok(Evidence::equal(formula, computed))
    }),
    always("number of roots", |it| {
        let positive = harmonic::discriminant(it).is_some_and(|value| value > 0.0);
        Ok((real_roots(it) == if positive { 3 } else { 1 }).into())
    }),
    always("cycles for D3 > 0", |it| {
        let fold = printed_fold(it.d3, it.r);
        // The place has D itself, or D in units of the fold.
        let d = if it.d == 0.0 { it.more * fold } else { it.d };
        count_is(&it.of(Parameters { d, ..**it }), 2 * usize::from(d < fold))
    }),
    always("cycles for D3 < 0", |it| count_is(it, 1)),
    always("cycles for D3 = 0", |it| count_is(it, usize::from(it.d <= 0.0))),
    worst("fold", fold_against),
    worst("fold with D2", fold_against),
    always("basin about the fold", |it| {
        let d = it.more * printed_fold(it.d3, it.r);
        let found = it.of(Parameters { d, ..**it }).cycles()?;
        Ok(found.map(|found| !found.is_empty()).is(it.more > 1.0))
    }),
    worst("amplitude at the fold", |it| {
        let formula = cbrt(8.0 * it.r / (3.0 * PI * it.d3));
        // Next to a fold an amplitude is known to the root of what D is.
        Ok(Evidence::near(formula, Approximation::relative(found_fold(it)?.q_max, 1e-7)))
    }),
    worst("amplitude at D = 0", |it| {
        let formula = cbrt(-16.0 * it.r / (3.0 * PI * it.d3));
        Ok(Evidence::near(formula, it.smallest()?.amplitude()))
    }),
    worst("A_1 as a root", |it| {
        let (d, root) = (it.d, largest_amplitude(it)?);
        let left = 4.0 * it.r / PI + 2.0 * d * root;
        let computed = Approximation::new(root - left / (2.0 * d), f64::EPSILON * root);
        Ok(Evidence::equal(small(it), computed))
    }),
    worst("A_1 as an amplitude", |it| Ok(Evidence::equal(small(it), it.smallest()?.extent()))),
    worst("A_1 with D3", |it| Ok(Evidence::near(small(it), it.smallest()?.amplitude()))),
    worst("A_1 in short", |_| {
        let root = largest_amplitude(&[-1.0, 0.0, 0.0, 1.0].into())?;
        Ok(Evidence::near(0.6, Approximation::relative(root, 1e-15)))
    }),
    worst("divided equation", |it| {
        let root = largest_amplitude(it)?;
        let computed = Approximation::relative(small(it), 1e-14);
        let terms = |factor: f64| root + factor * it.d3 / it.d * powi(root, 3);
        Ok(Evidence::equal(terms(8.0 / 3.0), computed).corrected(terms(3.0 / 8.0)))
    }),
    worst("A_2", |it| Ok(Evidence::near(large(it), it.largest()?.amplitude()))),
    tends("asymptotes for D3 > 0", asymptote),
    always("stability of branches", |it| {
        Ok(it.cycles()?.map(|found| found.iter().map(|cycle| cycle.stable).eq([false, true])))
    }),
    always("stability for D3 < 0", |it| {
        Ok(it.cycles()?.map(|found| found.iter().all(|it| !it.stable)))
    }),
    tends("asymptotes for D3 < 0", asymptote),
];

/// The amplitude by a number of harmonics.
fn by_harmonics(it: &ClaimCase, number: usize) -> Result<f64> {
    let found = harmonic_balance(it, number, 0, &it.limits)?;
    let cycle = found.balanced.first().and_then(|balanced| balanced.cycle.as_ref().ok());
    cycle.map(HarmonicCycle::amplitude).ok_or(missing("a cycle of some harmonics"))
}

/// The largest stationary amplitude of (42).
fn largest_amplitude(parameters: &Parameters) -> Result<f64> {
    let last = amplitudes(parameters).last().map(|harmonic| harmonic.amplitude);
    last.ok_or(missing("a stationary amplitude"))
}

/// Whether the harmonic amplitude lies where `holds` says, given the smaller and the larger extent, over all dampings.
fn amplitude_and_extents(it: &ClaimCase, holds: fn(f64, f64, f64) -> bool) -> Result<Evidence> {
    Evidence::always((1..20).map(|number| {
        let d = -0.05 * f64::from(number);
        let it = it.of([d, 0.0, 0.0, 0.1].into());
        let (cycle, harmonic) = (it.smallest()?, largest_amplitude(&it)?);
        let (low, high) = (cycle.v_max.min(cycle.q_max), cycle.v_max.max(cycle.q_max));
        let place = format!("D = {d}, r = 0.1: A = {harmonic:.5}, A_v = {low:.5}, A_q = {high:.5}");
        let value = holds(harmonic, low, high);
        let certain = cycle.bounds.is_some_and(|it| {
            let [v, q] = [it.v_max, it.q_max];
            // The formula is rounded, and which of both extents is the larger one is certain.
            let ordered = v.intersection(q).is_none();
            let agrees = |a: f64, v: f64, q: f64| holds(a, v.min(q), v.max(q)) == value;
            let formula = [harmonic * (1.0 - 1e-9), harmonic * (1.0 + 1e-9)];
            ordered
                && formula
                    .iter()
                    .all(|&a| agrees(a, v.lower(), q.lower()) && agrees(a, v.upper(), q.upper()))
        });
        Ok((place, Conclusion { value, certain }))
    }))
}

/// How many real roots (42) has: changes of its sign between the places where it turns, or beside 0 where it does not.
fn real_roots(parameters: &Parameters) -> usize {
    let Parameters { d, d3, r, .. } = *parameters;
    let cubic = |a: f64| 4.0 * r / PI + a * (2.0 * d + 0.75 * d3 * a * a);
    let turn = (-8.0 * d / (9.0 * d3)).max(0.0).sqrt();
    let places = [-1e6, -turn, turn, 1e6];
    places.windows(2).filter(|pair| (cubic(pair[0]) > 0.0) != (cubic(pair[1]) > 0.0)).count()
}

/// Whether there are so many cycles.
fn count_is(it: &ClaimCase, expected: usize) -> Result<Conclusion<bool>> {
    // The search has nothing to go by where the motion is linear and no swing ends.
    let found = if it.omega().is_none() && it.is_piecewise_linear() {
        it.beside_proof(cycles(it, &it.limits)?.cycles)
    } else {
        it.cycles()?
    };
    Ok(found.map(Vec::len).is(expected))
}

fn printed_fold(d3: f64, r: f64) -> f64 {
    -0.5 * cbrt(powi(9.0 / PI, 2) * r * r * d3)
}

/// The fold of the cycles.
pub(super) fn found_fold(it: &ClaimCase) -> Result<FoldPoint> {
    fold(it, &it.limits)?.0.ok_or(missing("the fold"))
}

/// (48) against the fold of the cycles.
fn fold_against(it: &ClaimCase) -> Result<Evidence> {
    let found = found_fold(it)?;
    Ok(Evidence::near(printed_fold(it.d3, it.r), it.last_cycle(found.d)))
}

/// (51).
pub(super) fn small(parameters: &Parameters) -> f64 {
    -2.0 * parameters.r / (PI * parameters.d)
}

/// (52).
pub(super) fn large(parameters: &Parameters) -> f64 {
    (-8.0 * parameters.d / (3.0 * parameters.d3)).sqrt()
}

/// `A_n`, and the solution of (42) that approaches it as abs(D) grows to 1.
fn asymptote(it: &ClaimCase) -> Result<(f64, Approximation)> {
    let (formula, root) = approached(it, [small(it), large(it)])?;
    Ok((formula, Approximation::relative(root, 1e-14)))
}

/// The formula for `A_n`, of those for n = 1 and n = 2, and the solution of (42) that approaches it as abs(D) grows to 1:
/// the smallest for n = 1, the largest for n = 2.
pub(super) fn approached(it: &ClaimCase, [first, second]: [f64; 2]) -> Result<(f64, f64)> {
    let found = amplitudes(it);
    let (formula, root) = if it.more == 1.0 {
        (first, found.first())
    } else {
        (second, found.last())
    };
    let root = root.ok_or(missing("a stationary amplitude"))?;
    Ok((formula, root.amplitude))
}
