//! Sections 5.2 and 6.1: the harmonic approximation, and how near it comes.

use std::f64::consts::{E, PI, TAU};

use super::known::{Certain, Known};
use super::measure::{
    amplitude, at_rest, enclosed, extent, half_swing, largest, mean, missing, of_cycle, oscillator,
    over, place, smallest, speed, towards,
};
use super::{Check, Evidence};
use crate::accuracy::harmonic_error::harmonic_balance;
use crate::closed_form::harmonic::{amplitudes, mean as harmonic_mean};
use crate::closed_form::harmonics::HarmonicCycle;
use crate::flow::{Limits, Reason};
use crate::model::Parameters;
use crate::numerics::Interval;
use crate::numerics::elementary::{powi, sin};
use crate::numerics::interval::PI as PI_BOUNDS;

pub const CHECKS: &[Check] = &[
    ("Fourier series", |limits| {
        let parameters = linear(-0.7);
        let [few, many] = [3, 31].map(|number| by_harmonics(&parameters, number, limits));
        let computed = amplitude(&smallest(&parameters, limits)?);
        Ok(Evidence::tends((few?, computed), (many?, computed)).at(place(&parameters)))
    }),
    ("second derivative", |_| {
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
    ("frequency of cycles", |limits| {
        over(DAMPINGS.map(linear), |parameters| {
            let cycle = smallest(parameters, limits)?;
            let frequency =
                of_cycle(&cycle, TAU / cycle.period, |it| PI_BOUNDS.twice() / it.period);
            Ok(Evidence::near(1.0, frequency))
        })
    }),
    ("harmonic cycles", |limits| {
        towards([-0.9, -0.999].map(units_of_friction), |parameters| {
            let cycle = smallest(parameters, limits)?;
            let ratio = cycle.v_max / cycle.q_max;
            Ok((1.0, of_cycle(&cycle, ratio, |it| it.v_max / it.q_max)))
        })
    }),
    ("mean displacement", |limits| {
        let cases = [-0.4, -0.2, -0.1, -0.05, -0.02].map(|d| oscillator(d, 0.2, 0.2, 1e-3));
        over(cases, |parameters| {
            let cycle = largest(parameters, limits)?;
            let formula = harmonic_mean(parameters.d2, largest_amplitude(parameters)?);
            Ok(Evidence::near(formula, mean(parameters, &cycle, limits)?))
        })
    }),
    ("slow change of amplitude", |limits| {
        Evidence::worst([0.5, 1.0, 2.0].map(|size| {
            let parameters = oscillator(-1e-3, 0.0, 2e-3, 1e-3);
            let [left, _] = half_swing(&parameters, at_rest(size), limits)?;
            let [right, _] = half_swing(&parameters, at_rest(left.value), limits)?;
            let turns = enclosed(&parameters, at_rest(size), 10.0).turns;
            let bounds = turns.get(1).map(|turn| turn.q - Interval::point(size));
            let computed = Known::new(right.value - size, right.error + left.error).within(bounds);
            let Parameters { d, d3, r, .. } = parameters;
            let printed = -4.0 * r / PI - 2.0 * d * size - 0.75 * d3 * powi(size, 3);
            let evidence = Evidence::near(TAU * printed, computed).corrected(PI * printed);
            Ok(evidence.at(format!("{}, A = {size}", place(&parameters))))
        }))
    }),
    ("amplitude as size", |limits| {
        over(DAMPINGS.map(linear), |parameters| {
            let cycle = smallest(parameters, limits)?;
            Ok(Evidence::near(largest_amplitude(parameters)?, amplitude(&cycle)))
        })
    }),
    ("A_q at D = -1", |limits| {
        towards([-0.7, -0.9].map(units_of_friction), |parameters| {
            Ok((1.0, extent(&smallest(parameters, limits)?)))
        })
    }),
    ("A_q and A_v at D = 0", |limits| {
        towards([-0.4, -0.02].map(linear), |parameters| {
            let cycle = smallest(parameters, limits)?;
            Ok((cycle.v_max, extent(&cycle)))
        })
    }),
    ("amplitude between extents", |limits| {
        harmonic_against_extents(limits, |a, low, high| low <= a && a <= high)
    }),
    ("amplitude below extents", |limits| harmonic_against_extents(limits, |a, low, _| a < low)),
    ("A_v at D = -1", |limits| {
        towards([-0.9, -0.999].map(units_of_friction), |parameters| {
            Ok((2.0 / E, speed(&smallest(parameters, limits)?)))
        })
    }),
];

/// Dampings at which the first-order answer is compared with the cycle.
const DAMPINGS: [f64; 6] = [-0.9, -0.7, -0.4, -0.2, -0.1, -0.01];

/// The piecewise linear oscillator, with the friction of Fig. 9.
fn linear(d: f64) -> Parameters {
    oscillator(d, 0.0, 0.0, 0.1)
}

/// The piecewise linear oscillator in units of its friction.
pub(crate) fn units_of_friction(d: f64) -> Parameters {
    oscillator(d, 0.0, 0.0, 1.0)
}

/// The amplitude by a number of harmonics.
fn by_harmonics(parameters: &Parameters, number: usize, limits: &Limits) -> Result<f64, Reason> {
    let found = harmonic_balance(parameters, number, 0, limits)?;
    let cycle = found.balanced.first().and_then(|balanced| balanced.cycle.as_ref().ok());
    cycle.map(HarmonicCycle::amplitude).ok_or(missing("a cycle of some harmonics"))
}

/// The largest stationary amplitude of (42).
pub(crate) fn largest_amplitude(parameters: &Parameters) -> Result<f64, Reason> {
    let last = amplitudes(parameters).last().map(|harmonic| harmonic.amplitude);
    last.ok_or(missing("a stationary amplitude"))
}

/// Whether the harmonic amplitude lies where `holds` says, given the smaller and the larger extent.
fn harmonic_against_extents(
    limits: &Limits,
    holds: fn(f64, f64, f64) -> bool,
) -> Result<Evidence, Reason> {
    Evidence::always((1..20).map(|number| {
        let parameters = linear(-0.05 * f64::from(number));
        let cycle = smallest(&parameters, limits)?;
        let harmonic = largest_amplitude(&parameters)?;
        let (low, high) = (cycle.v_max.min(cycle.q_max), cycle.v_max.max(cycle.q_max));
        let place =
            format!("{}: A = {harmonic:.5}, A_v = {low:.5}, A_q = {high:.5}", place(&parameters));
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
