//! Sections 5.2 and 6.1: the harmonic approximation, and how near it comes.

use std::f64::consts::{E, PI, TAU};

use super::known::{Certain, Known};
use super::measure::{Case, at_rest, missing, oscillator};
use super::{Check, Evidence, tends, worst};
use crate::accuracy::harmonic_error::harmonic_balance;
use crate::closed_form::harmonic::{amplitudes, mean as harmonic_mean};
use crate::closed_form::harmonics::HarmonicCycle;
use crate::flow::Reason;
use crate::model::Parameters;
use crate::numerics::interval::PI as PI_BOUNDS;
use crate::numerics::{Interval, powi, sin};

pub const CHECKS: &[Check] = &[
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
        let computed = Known::twice(slope(1e-3), slope(2e-3));
        let evidence = Evidence::equal(0.0, computed).corrected(-size * eta * eta);
        Ok(evidence.at("A = 0.7, eta = 1.3"))
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
        let formula = harmonic_mean(it.d2, largest_amplitude(it)?);
        Ok(Evidence::near(formula, it.mean(&*it.largest()?)?))
    }),
    worst("slow change of amplitude", |it| {
        let size = it.more;
        let [left, _] = it.half_swing(at_rest(size))?;
        let [right, _] = it.half_swing(at_rest(left.value))?;
        let turns = it.enclosed(at_rest(size), 10.0).turns;
        let bounds = turns.get(1).map(|turn| turn.q - Interval::point(size));
        let computed = Known::new(right.value - size, right.error + left.error).within(bounds);
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
        harmonic_against_extents(it, |a, low, high| low <= a && a <= high)
    }),
    worst("amplitude below extents", |it| harmonic_against_extents(it, |a, low, _| a < low)),
    tends("A_v at D = -1", |it| Ok((2.0 / E, it.smallest()?.speed()))),
];

/// The amplitude by a number of harmonics.
fn by_harmonics(it: &Case, number: usize) -> Result<f64, Reason> {
    let found = harmonic_balance(it, number, 0, &it.limits)?;
    let cycle = found.balanced.first().and_then(|balanced| balanced.cycle.as_ref().ok());
    cycle.map(HarmonicCycle::amplitude).ok_or(missing("a cycle of some harmonics"))
}

/// The largest stationary amplitude of (42).
pub(crate) fn largest_amplitude(parameters: &Parameters) -> Result<f64, Reason> {
    let last = amplitudes(parameters).last().map(|harmonic| harmonic.amplitude);
    last.ok_or(missing("a stationary amplitude"))
}

/// Whether the harmonic amplitude lies where `holds` says, given the smaller and the larger extent, over all dampings.
fn harmonic_against_extents(
    it: &Case,
    holds: fn(f64, f64, f64) -> bool,
) -> Result<Evidence, Reason> {
    Evidence::always((1..20).map(|number| {
        let d = -0.05 * f64::from(number);
        let it = it.of(oscillator(d, 0.0, 0.0, 0.1));
        let (cycle, harmonic) = (it.smallest()?, largest_amplitude(&it)?);
        let (low, high) = (cycle.v_max.min(cycle.q_max), cycle.v_max.max(cycle.q_max));
        let place = format!("D = {d}, r = 0.1: A = {harmonic:.5}, A_v = {low:.5}, A_q = {high:.5}");
        let value = holds(harmonic, low, high);
        let certain = cycle.bounds.is_some_and(|it| {
            let [v, q] = [it.v_max, it.q_max];
            // The formula is rounded, and which of both extents is the larger one is certain.
            let ordered = v.upper() < q.lower() || q.upper() < v.lower();
            let agrees = |a: f64, v: f64, q: f64| holds(a, v.min(q), v.max(q)) == value;
            let formula = [harmonic * (1.0 - 1e-9), harmonic * (1.0 + 1e-9)];
            ordered
                && formula
                    .iter()
                    .all(|&a| agrees(a, v.lower(), q.lower()) && agrees(a, v.upper(), q.upper()))
        });
        Ok((place, Certain { value, certain }))
    }))
}
