//! Section 6.2: stationary amplitudes, the fold, characteristic points and asymptotes.

use std::f64::consts::PI;

use super::harmonic::largest_amplitude;
use super::known::{Certain, Known};
use super::measure::{Case, missing, oscillator};
use super::{Check, Evidence, always, tends, worst};
use crate::branch::fold::fold;
use crate::branch::special::FoldPoint;
use crate::closed_form::harmonic::{self, amplitudes};
use crate::flow::Reason;
use crate::model::Parameters;
use crate::numerics::elementary::{cbrt, powi};
use crate::portrait::basin::cycle::cycles;

pub const CHECKS: &[Check] = &[
    worst("unstable amplitude", |it| {
        Ok(Evidence::near(amplitudes(it)[0].amplitude, it.smallest()?.amplitude()))
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
        let computed = Known::new(cube - square, error);
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
        Ok(Evidence::near(formula, Known::relative(found_fold(it)?.q_max, 1e-7)))
    }),
    worst("amplitude at D = 0", |it| {
        let formula = cbrt(-16.0 * it.r / (3.0 * PI * it.d3));
        Ok(Evidence::near(formula, it.smallest()?.amplitude()))
    }),
    worst("A_1 as a root", |it| {
        let (d, root) = (it.d, largest_amplitude(it)?);
        let left = 4.0 * it.r / PI + 2.0 * d * root;
        let computed = Known::new(root - left / (2.0 * d), f64::EPSILON * root);
        Ok(Evidence::equal(small(it), computed))
    }),
    worst("A_1 as an amplitude", |it| Ok(Evidence::equal(small(it), it.smallest()?.extent()))),
    worst("A_1 with D3", |it| Ok(Evidence::near(small(it), it.smallest()?.amplitude()))),
    worst("A_1 in short", |_| {
        let root = largest_amplitude(&oscillator(-1.0, 0.0, 0.0, 1.0))?;
        Ok(Evidence::near(0.6, Known::relative(root, 1e-15)))
    }),
    worst("divided equation", |it| {
        let Parameters { d, d3, r, .. } = **it;
        let root = largest_amplitude(it)?;
        let computed = Known::relative(-2.0 * r / (PI * d), 1e-14);
        let terms = |factor: f64| root + factor * d3 / d * powi(root, 3);
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

/// How many real roots (42) has: changes of its sign between the places where it turns.
fn real_roots(parameters: &Parameters) -> usize {
    let Parameters { d, d3, r, .. } = *parameters;
    let cubic = |a: f64| 4.0 * r / PI + a * (2.0 * d + 0.75 * d3 * a * a);
    let square = -8.0 * d / (9.0 * d3);
    let turns = if square > 0.0 { vec![-square.sqrt(), square.sqrt()] } else { Vec::new() };
    let far = 1e6;
    let places = [vec![-far], turns, vec![far]].concat();
    places.windows(2).filter(|pair| (cubic(pair[0]) > 0.0) != (cubic(pair[1]) > 0.0)).count()
}

/// Whether there are so many cycles.
fn count_is(it: &Case, expected: usize) -> Result<Certain<bool>, Reason> {
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
pub(crate) fn found_fold(it: &Case) -> Result<FoldPoint, Reason> {
    fold(it, &it.limits)?.0.ok_or(missing("the fold"))
}

/// (48) against the fold of the cycles.
fn fold_against(it: &Case) -> Result<Evidence, Reason> {
    let found = found_fold(it)?;
    Ok(Evidence::near(printed_fold(it.d3, it.r), it.last_cycle(found.d, 1e-12)))
}

/// (51).
fn small(parameters: &Parameters) -> f64 {
    -2.0 * parameters.r / (PI * parameters.d)
}

/// (52).
fn large(parameters: &Parameters) -> f64 {
    (-8.0 * parameters.d / (3.0 * parameters.d3)).sqrt()
}

/// `A_n`, and the solution of (42) that approaches it as abs(D) grows to 1: the smallest for n = 1, the largest for n = 2.
fn asymptote(it: &Case) -> Result<(f64, Known), Reason> {
    let found = amplitudes(it);
    let (formula, root) =
        if it.more == 1.0 { (small(it), found.first()) } else { (large(it), found.last()) };
    let root = root.ok_or(missing("a stationary amplitude"))?;
    Ok((formula, Known::relative(root.amplitude, 1e-14)))
}
