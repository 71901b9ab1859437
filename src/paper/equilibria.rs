//! Section 4: the set of equilibria, and what Lyapunov's method says about its basin.

use std::f64::consts::PI;

use super::known::{Certain, Known};
use super::measure::{Case, at_rest, oscillator};
use super::{Check, Evidence, always, tends, worst};
use crate::closed_form::lyapunov::{self, Disk};
use crate::flow::{Outcome, Reason};
use crate::model::{HalfPlane, Parameters, Side, State};
use crate::numerics::{Interval, exp, hypot};
use crate::portrait::Margin;
use crate::portrait::Portrait;
use crate::proof::kicks::kicks;
use crate::proof::motion::ProvedFate;
use crate::proof::{ParameterBox, prove};

pub const CHECKS: &[Check] = &[
    always("rest", |it| Ok(it.captured(at_rest(it.more), 1e-3)?.is(it.more.abs() <= it.r))),
    worst("crossing", |it| {
        crossings(it, |upper, lower| (upper * upper > 0.0, upper * lower > 0.0), true)
    }),
    worst("stopping", |it| {
        crossings(it, |upper, lower| (upper * upper < 0.0, upper * lower < 0.0), false)
    }),
    tends("short swings", |it| {
        let [full, _] = it.half_swing(at_rest(it.more))?;
        let [simple, _] = it.of(linear(it)).half_swing(at_rest(it.more))?;
        Ok((simple.plus(it.r).value, full.plus(it.r)))
    }),
    worst("shift of the centre", |it| shifted(it, -1.0)),
    // At D = -0.99 the clearance of the basin is some 1e-10.
    always("stability of the set", |it| it.captured(at_rest(it.r + 1e-12), 1e3)),
    always("single equilibria", |it| {
        let (q, start) = (it.more, State { q: it.more, v: 1e-3 });
        let end = it.motion(start, 10.0)?.outcome;
        let value = matches!(end, Outcome::Captured { q: end, .. } if end != q);
        let fate = it.enclosed(start, 10.0).fate;
        let certain = matches!(fate, ProvedFate::Captured { q: end, .. } if !end.contains(q));
        Ok(Certain { value, certain: certain && value })
    }),
    worst("energy with friction (5)", |it| energy(it, -1.0)),
    worst("energy", |it| energy(it, 1.0)),
    tends("energy of slow motions", |it| {
        let rate = |of: &Parameters| lyapunov::energy_rate(of, State { q: 0.0, v: it.more });
        Ok((rate(&linear(it)), Known::relative(rate(it), 1e-15)))
    }),
    always("sign of V'", |it| {
        let v = -it.more * it.r / (2.0 * it.d);
        let rate = lyapunov::energy_rate(it, State { q: 0.0, v });
        Ok(((rate < 0.0) == (it.more.abs() < 1.0)).into())
    }),
    worst("Lyapunov's circle", |it| Ok(Evidence::at_most(circle(it), least_kick(it)?))),
    worst("size of the circle", |it| {
        let least = least_kick(it)?;
        let part = circle(it) / least.value;
        Ok(Evidence::near(0.5 / 0.6, Known::relative(part, least.error / least.value)))
    }),
    worst("circle with D2", |it| {
        let evidence = Evidence::at_most(circle(it), least_kick(it)?);
        Ok(match lyapunov::full_disk(it) {
            Disk::Radius(radius) => evidence.corrected(radius),
            Disk::Plane => evidence,
        })
    }),
];

/// With linear damping only.
fn linear(it: &Parameters) -> Parameters {
    oscillator(it.d, 0.0, 0.0, it.r)
}

/// How many places on `v = 0` satisfy a condition on the two limits of `v'`, as printed and corrected,
/// against the number that a motion crosses (or does not).
fn crossings(
    it: &Case,
    condition: fn(f64, f64) -> (bool, bool),
    crosses: bool,
) -> Result<Evidence, Reason> {
    /// Inside and outside of the sticking set. At its ends one of the limits vanishes, and neither condition speaks of them.
    const PARTS: [f64; 11] = [0.0, 0.3, -0.3, 0.9, -0.9, 1.001, -1.001, 1.5, -1.5, 3.0, -3.0];
    let (mut printed, mut corrected, mut computed) = (0.0, 0.0, 0.0);
    let mut certain = true;
    for q in PARTS.map(|part| part * it.r) {
        let limit = |side: Side| {
            let field = HalfPlane::new(it, side);
            side.sign() * field.acceleration(side.position(q, it.r), 0.0)
        };
        let (first, second) = condition(limit(Side::Upper), limit(Side::Lower));
        printed += f64::from(u8::from(first));
        corrected += f64::from(u8::from(second));
        // A motion on its way to the place: a little earlier it was a little above or below.
        let from_above = State { q, v: 1e-9 };
        let from_below = State { v: -from_above.v, ..from_above };
        let [above, below] = [from_above, from_below].map(|state| it.captured(state, 1e-3));
        let (above, below) = (above?, below?);
        certain &= above.certain && below.certain;
        computed += f64::from(u8::from((above.value && below.value) != crosses));
    }
    let computed = Known::exact(computed).within(certain.then_some(Interval::point(computed)));
    Ok(Evidence::equal(printed, computed).corrected(corrected))
}

/// Where a half swing above `v = 0` ends, if the motion is linear in `q - shift r`.
pub(crate) fn shifted(it: &Case, shift: f64) -> Result<Evidence, Reason> {
    let [end, _] = it.half_swing(at_rest(it.more))?;
    let growth = exp(-PI * it.d / (1.0 - it.d * it.d).sqrt());
    let around = |centre: f64| centre - (it.more - centre) * growth;
    let evidence = Evidence::equal(around(shift * it.r), end);
    Ok(if shift < 0.0 { evidence } else { evidence.corrected(around(-it.r)) })
}

/// Change of the energy along a motion by (19), with friction's part multiplied by `sign`.
fn energy(it: &Case, sign: f64) -> Result<Evidence, Reason> {
    let [change, linear, friction] = it.energy_change(at_rest(it.more), 20.0)?;
    let by_rate = |sign: f64| linear.value + sign * friction.value;
    let error = change.error + linear.error + friction.error;
    let evidence = Evidence::equal(by_rate(sign), Known { error, ..change });
    Ok(if sign > 0.0 { evidence } else { evidence.corrected(by_rate(1.0)) })
}

/// Radius (24).
fn circle(parameters: &Parameters) -> f64 {
    -parameters.r / (2.0 * parameters.d)
}

/// Distance of the border of the basin from the origin.
pub(crate) fn least_kick(it: &Case) -> Result<Known, Reason> {
    /// Points on each step of the border, and the relative error of a distance between them.
    const POINTS: (u16, f64) = (200, 1e-5);
    let basin = Portrait::of_oscillator(it, 10.0, &it.limits)?;
    let border = basin.borders.first().map(|border| border.curve(POINTS.0)).unwrap_or_default();
    let least = border.iter().map(|point| hypot(point.q, point.v)).fold(f64::INFINITY, f64::min);
    Ok(Known::relative(least, POINTS.1).within(at_most(it, &basin.margin)))
}

/// The distance of the border is at most that of two of its points, where these are enclosed.
fn at_most(parameters: &Parameters, margin: &Margin) -> Option<Interval> {
    let proof = prove(&ParameterBox::from(parameters), &[]);
    let found = kicks(&proof, [margin.displacement, margin.impulse, None]);
    let nearer = found.displacement?.upper().min(found.impulse?.upper());
    Some(Interval::new(f64::NEG_INFINITY, nearer))
}
