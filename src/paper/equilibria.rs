//! Section 4: the set of equilibria, and what Lyapunov's method says about its basin.

use std::f64::consts::PI;

use super::known::{Certain, Known};
use super::measure::{
    at_rest, captured, enclosed, energy_change, half_swing, motion, oscillator, over, place,
};
use super::{Check, Evidence};
use crate::closed_form::lyapunov::{self, Disk};
use crate::flow::{Limits, Outcome, Reason};
use crate::model::{HalfPlane, Parameters, Side, State};
use crate::numerics::Interval;
use crate::numerics::elementary::{exp, hypot};
use crate::portrait::Margin;
use crate::portrait::basin::basin;
use crate::proof::kicks::kicks;
use crate::proof::motion::ProvedFate;
use crate::proof::{ParameterBox, prove};

pub const CHECKS: &[Check] = &[
    ("rest", |limits| {
        Evidence::always(displacements().map(|q| {
            let rests = captured(&PLAIN, at_rest(q), 1e-3, limits)?;
            Ok((format!("q = {q}"), rests.is(q.abs() <= PLAIN.r)))
        }))
    }),
    ("crossing", |limits| {
        crossings(limits, |upper, lower| (upper * upper > 0.0, upper * lower > 0.0), true)
    }),
    ("stopping", |limits| {
        crossings(limits, |upper, lower| (upper * upper < 0.0, upper * lower < 0.0), false)
    }),
    ("short swings", |limits| {
        let parameters = oscillator(-0.3, 0.5, 0.5, 0.1);
        let swing = |clearance: f64| {
            let start = at_rest(-(parameters.r + clearance));
            let [full, _] = half_swing(&parameters, start, limits)?;
            let [simple, _] = half_swing(&linear(-0.3), start, limits)?;
            Ok((simple.plus(parameters.r).value, full.plus(parameters.r)))
        };
        let evidence = Evidence::tends(swing(0.1)?, swing(0.001)?);
        Ok(evidence.at(format!("{}, from q = -0.101", place(&parameters))))
    }),
    ("shift of the centre", |limits| shifted(limits, -1.0)),
    ("stability of the set", |limits| {
        Evidence::always([-0.99, -0.9, -0.5, -0.1, 0.0, 0.5, 0.99].map(|d| {
            let parameters = oscillator(d, 0.3, -0.5, 1.0);
            // At D = -0.99 the clearance of the basin is some 1e-10.
            let rests = captured(&parameters, at_rest(1.0 + 1e-12), 1e3, limits)?;
            Ok((format!("D = {d}"), rests))
        }))
    }),
    ("single equilibria", |limits| {
        Evidence::always([-0.8, -0.3, 0.0, 0.5].map(|part| {
            let q = part * PLAIN.r;
            let start = State { q, v: 1e-3 };
            let end = motion(&PLAIN, start, 10.0, limits)?.outcome;
            let value = matches!(end, Outcome::Captured { q: end, .. } if end != q);
            let fate = enclosed(&PLAIN, start, 10.0).fate;
            let certain = matches!(fate, ProvedFate::Captured { q: end, .. } if !end.contains(q));
            Ok((format!("q = {q}"), Certain { value, certain: certain && value }))
        }))
    }),
    ("energy with friction (5)", |limits| energy(limits, -1.0)),
    ("energy", |limits| energy(limits, 1.0)),
    ("energy of slow motions", |_| {
        let parameters = oscillator(-0.3, 0.2, 0.5, 0.1);
        let rates = |v: f64| {
            let rate = |it: &Parameters| lyapunov::energy_rate(it, State { q: 0.0, v });
            (rate(&linear(-0.3)), Known::relative(rate(&parameters), 1e-15))
        };
        let evidence = Evidence::tends(rates(0.1), rates(0.001));
        Ok(evidence.at(format!("{}, v = 0.001", place(&parameters))))
    }),
    ("sign of V'", |_| {
        let cases = [-0.9, -0.5, -0.1, -0.01].into_iter().flat_map(|d| {
            [0.5, 0.999, 1.001, 2.0, -0.5, -0.999, -1.001, -2.0].map(|part: f64| {
                let v = -part * linear(d).r / (2.0 * d);
                let rate = lyapunov::energy_rate(&linear(d), State { q: 0.0, v });
                Ok((format!("D = {d}, v = {v}"), (rate < 0.0) == (part.abs() < 1.0)))
            })
        });
        Evidence::always(cases)
    }),
    ("Lyapunov's circle", |limits| {
        over([-0.95, -0.7, -0.4, -0.1, -0.01].map(linear), |parameters| {
            Ok(Evidence::at_most(circle(parameters), least_kick(parameters, limits)?))
        })
    }),
    ("size of the circle", |limits| {
        over([-0.9, -0.7, -0.4, -0.1, -0.01].map(linear), |parameters| {
            let least = least_kick(parameters, limits)?;
            let part = circle(parameters) / least.value;
            Ok(Evidence::near(0.5 / 0.6, Known::relative(part, least.error / least.value)))
        })
    }),
    ("circle with D2", |limits| {
        let parameters = oscillator(-0.02, 0.5, 0.0, 0.1);
        let least = least_kick(&parameters, limits)?;
        let evidence = Evidence::at_most(circle(&parameters), least).at(place(&parameters));
        Ok(match lyapunov::full_disk(&parameters) {
            Disk::Radius(radius) => evidence.corrected(radius),
            Disk::Plane => evidence,
        })
    }),
];

/// The plain oscillator.
const PLAIN: Parameters = linear(-0.1);

/// With linear damping only.
const fn linear(d: f64) -> Parameters {
    Parameters { d, d2: 0.0, d3: 0.0, r: 0.1 }
}

/// Places at rest inside and outside of the sticking set, its ends included.
fn displacements() -> impl Iterator<Item = f64> {
    const PARTS: [f64; 7] = [0.0, 0.3, 0.9, 1.0, 1.001, 1.5, 3.0];
    PARTS.into_iter().flat_map(|part| [part, -part]).map(|part| part * PLAIN.r).skip(1)
}

/// How many places on `v = 0` satisfy a condition on the two limits of `v'`, as printed and corrected,
/// against the number that a motion crosses (or does not).
fn crossings(
    limits: &Limits,
    condition: fn(f64, f64) -> (bool, bool),
    crosses: bool,
) -> Result<Evidence, Reason> {
    let (mut printed, mut corrected, mut computed) = (0.0, 0.0, 0.0);
    let mut certain = true;
    // At the ends of the set one of the limits vanishes, and neither condition speaks of them.
    for q in displacements().filter(|q| q.abs() != PLAIN.r) {
        let limit = |side: Side| {
            let field = HalfPlane::new(&PLAIN, side);
            side.sign() * field.acceleration(side.position(q, PLAIN.r), 0.0)
        };
        let (first, second) = condition(limit(Side::Upper), limit(Side::Lower));
        printed += f64::from(u8::from(first));
        corrected += f64::from(u8::from(second));
        // A motion on its way to the place: a little earlier it was a little above or below.
        let from_above = State { q, v: 1e-9 };
        let from_below = State { v: -from_above.v, ..from_above };
        let [above, below] =
            [from_above, from_below].map(|state| captured(&PLAIN, state, 1e-3, limits));
        let (above, below) = (above?, below?);
        certain &= above.certain && below.certain;
        computed += f64::from(u8::from((above.value && below.value) != crosses));
    }
    let at = format!("{} places beside the ends, {}", 11, place(&PLAIN));
    let computed = Known::exact(computed).within(certain.then_some(Interval::point(computed)));
    Ok(Evidence::equal(printed, computed).corrected(corrected).at(at))
}

/// Where a half swing above `v = 0` ends, if the motion is linear in `q - shift r`.
pub(crate) fn shifted(limits: &Limits, shift: f64) -> Result<Evidence, Reason> {
    let parameters = oscillator(-0.1, 0.0, 0.0, 0.2);
    let start = at_rest(-1.0);
    let [end, _] = half_swing(&parameters, start, limits)?;
    let (d, r) = (parameters.d, parameters.r);
    let growth = exp(-PI * d / (1.0 - d * d).sqrt());
    let around = |centre: f64| centre - (start.q - centre) * growth;
    let evidence = Evidence::equal(around(shift * r), end);
    let evidence = if shift < 0.0 { evidence } else { evidence.corrected(around(-r)) };
    Ok(evidence.at(format!("{}, from q = -1", place(&parameters))))
}

/// Change of the energy along a motion by (19), with friction's part multiplied by `sign`.
fn energy(limits: &Limits, sign: f64) -> Result<Evidence, Reason> {
    let parameters = oscillator(-0.1, 0.0, 0.0, 0.1);
    let [change, linear, friction] = energy_change(&parameters, at_rest(1.5), 20.0, limits)?;
    let by_rate = |sign: f64| linear.value + sign * friction.value;
    let error = change.error + linear.error + friction.error;
    let evidence = Evidence::equal(by_rate(sign), Known { error, ..change });
    let evidence = if sign > 0.0 { evidence } else { evidence.corrected(by_rate(1.0)) };
    Ok(evidence.at(format!("{}, from q = 1.5 until tau = 20", place(&parameters))))
}

/// Radius (24).
fn circle(parameters: &Parameters) -> f64 {
    -parameters.r / (2.0 * parameters.d)
}

/// Distance of the border of the basin from the origin.
pub(crate) fn least_kick(parameters: &Parameters, limits: &Limits) -> Result<Known, Reason> {
    /// Points on each step of the border, and the relative error of a distance between them.
    const POINTS: (u16, f64) = (200, 1e-5);
    let basin = basin(parameters, 10.0, limits)?;
    let border = basin.borders.first().map(|border| border.curve(POINTS.0)).unwrap_or_default();
    let least = border.iter().map(|point| hypot(point.q, point.v)).fold(f64::INFINITY, f64::min);
    Ok(Known::relative(least, POINTS.1).within(at_most(parameters, &basin.margin())))
}

/// The distance of the border is at most that of two of its points, where these are enclosed.
fn at_most(parameters: &Parameters, margin: &Margin) -> Option<Interval> {
    let proof = prove(&ParameterBox::from(parameters), &[]);
    let found = kicks(&proof, [margin.displacement, margin.impulse, None]);
    let nearer = found.displacement?.upper().min(found.impulse?.upper());
    Some(Interval::new(f64::NEG_INFINITY, nearer))
}
