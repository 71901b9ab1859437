//! Sections 4 and 5.1: the set of equilibria, what Lyapunov's method says about its basin, and the cycle of the piecewise
//! linear oscillator, which borders it.

use std::f64::consts::{PI, TAU};

use super::{
    Approximation, Check, ClaimCase, Conclusion, Evidence, always, at_rest, missing, tends, worst,
};
use crate::closed_form::{LinearCycle, lyapunov};
use crate::flow::{Outcome, Result};
use crate::model::{Field, HalfPlane, Parameters, Side, State};
use crate::numerics::{Interval, atan, exp, hypot, sin, sin_cos};
use crate::portrait::{Border, proved_kicks};
use crate::proof::ProvedFate;

pub(super) const CHECKS: &[Check] = &[
    always("rest", |it| Ok(it.captured(at_rest(it.more), 1e-3)?.is(it.more.abs() <= it.r))),
    worst("crossing", |it| {
        crossings(it, |upper, lower| (upper * upper > 0.0, upper * lower > 0.0), true)
    }),
    worst("stopping", |it| {
        crossings(it, |upper, lower| (upper * upper < 0.0, upper * lower < 0.0), false)
    }),
    tends("short swings", |it| {
        let [full, _] = it.half_swing(it.more)?;
        let [simple, _] = it.of(linear(it)).half_swing(it.more)?;
        Ok((simple.plus(it.r).value, full.plus(it.r)))
    }),
    worst("shift of the centre", |it| shifted(it, -1.0)),
    // At D = -0.99 the clearance of the basin is some 1e-10.
    always("stability of the set", |it| it.captured(at_rest(it.r + 1e-12), 1e3)),
    always("single equilibria", |it| {
        let (q, start) = (it.more, State { q: it.more, v: 1e-3 });
        let end = it.motion(start, 10.0)?.outcome;
        let value = matches!(end, Outcome::Captured { q: end, .. } if end != q);
        let enclosed = it.enclosed(start, 10.0);
        let elsewhere = enclosed.end.q.is_some_and(|end| !end.contains(q));
        let certain = enclosed.fate == ProvedFate::Captured && elsewhere;
        Ok(Conclusion { value, certain: certain && value })
    }),
    worst("energy with friction (5)", |it| energy(it, -1.0)),
    worst("energy", |it| energy(it, 1.0)),
    tends("energy of slow motions", |it| {
        let rate = |of: &Parameters| lyapunov::energy_rate(of, it.more);
        Ok((rate(&linear(it)), Approximation::relative(rate(it), 1e-15)))
    }),
    always("sign of V'", |it| {
        let v = -it.more * it.r / (2.0 * it.d);
        let rate = lyapunov::energy_rate(it, v);
        Ok(((rate < 0.0) == (it.more.abs() < 1.0)).into())
    }),
    worst("Lyapunov's circle", |it| Ok(Evidence::at_most(circle(it), least_kick(it)?))),
    worst("size of the circle", |it| {
        let least = least_kick(it)?;
        let part = circle(it) / least.value;
        Ok(Evidence::near(0.5 / 0.6, Approximation::relative(part, least.error / least.value)))
    }),
    worst("circle with D2", |it| {
        let evidence = Evidence::at_most(circle(it), least_kick(it)?);
        let full = lyapunov::full_disk(it);
        Ok(if full.is_finite() {
            evidence.corrected(full)
        } else {
            evidence
        })
    }),
    worst("periodic border", |it| {
        let found = it.edge()?;
        let cycles = f64::from(found.value == Border::Cycle);
        // A basin without a border would need none.
        let needed = f64::from(found.value != Border::None);
        let bounds = found.certain.then_some(Interval::point(cycles));
        Ok(Evidence::equal(needed, Approximation::exact(cycles).within(bounds)))
    }),
    always("one cycle", |it| {
        Ok(it.cycles()?.map(|found| found.len() == 1 && found[0].clearance > 0.0))
    }),
    worst("circle of radius r", |it| Ok(Evidence::at_most(it.r, least_kick(it)?))),
    worst("duration of a swing", |it| {
        let [_, tau] = it.half_swing(it.more)?;
        Ok(Evidence::equal(0.5 * closed_form(it)?.period, tau))
    }),
    worst("centre with a false sign", |it| shifted(it, 1.0)),
    worst("velocity on the way", |it| {
        let LinearCycle { d, period, .. } = closed_form(it)?;
        let (omega, tau) = (TAU / period, 0.2 * period);
        let [_, velocity] = it.state_at(at_rest(it.more), tau)?;
        let (a, b) = (-1.0, -d / omega);
        let (sine, cosine) = sin_cos(omega * tau);
        let formula = -(a * d - b * omega) * cosine - (b * d + a * omega) * sine;
        let at = format!("{}, at tau = {tau:.4}", it.place);
        Ok(Evidence::equal(formula * exp(-d * tau), velocity).at(at))
    }),
    worst("end of a swing", |it| {
        let [end, _] = it.half_swing(it.more)?;
        Ok(Evidence::equal(growth(&closed_form(it)?), end.plus(it.r)))
    }),
    worst("clearance", |it| {
        let (cycle, formula) = (it.smallest()?, closed_form(it)?);
        // An exponential has as many times the relative error of its exponent, 70 at D = -0.999.
        let exponent = 1.0 + 0.5 * formula.log_multiplier;
        let error = cycle.error.unwrap_or(f64::INFINITY) + exponent * 1e-14;
        let bounds = cycle.bounds.map(|it| it.clearance);
        let computed = Approximation::relative(cycle.clearance, error).within(bounds);
        Ok(Evidence::equal(formula.clearance, computed))
    }),
    worst("border over the angle", on_the_curve),
    worst("A_q", |it| Ok(Evidence::equal(closed_form(it)?.q_max, it.smallest()?.extent()))),
    worst("A_v", |it| {
        let formula = closed_form(it)?;
        let printed = Evidence::equal(printed_velocity(&formula), it.smallest()?.speed());
        Ok(printed.corrected(formula.v_max))
    }),
    worst("scale of friction", |it| {
        let cycle = |r: f64| it.of(Parameters { r, ..**it }).smallest();
        let (one, three) = (cycle(1.0)?, cycle(3.0)?);
        let unit = one.bounds.map_or(Interval::ALL, |it| it.q_max);
        Ok(Evidence::equal(3.0, three.known(three.q_max / one.q_max, |it| it.q_max / unit)))
    }),
];

/// With linear damping only.
fn linear(it: &Parameters) -> Parameters {
    [it.d, 0.0, 0.0, it.r].into()
}

/// How many places on `v = 0` satisfy a condition on the two limits of `v'`, as printed and corrected,
/// against the number that a motion crosses (or does not).
fn crossings(
    it: &ClaimCase,
    condition: fn(f64, f64) -> (bool, bool),
    crosses: bool,
) -> Result<Evidence> {
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
        printed += f64::from(first);
        corrected += f64::from(second);
        // A motion on its way to the place: a little earlier it was a little above or below.
        let from_above = State { q, v: 1e-9 };
        let from_below = State { v: -from_above.v, ..from_above };
        let [above, below] = [from_above, from_below].map(|state| it.captured(state, 1e-3));
        let (above, below) = (above?, below?);
        certain &= above.certain && below.certain;
        computed += f64::from((above.value && below.value) != crosses);
    }
    let computed =
        Approximation::exact(computed).within(certain.then_some(Interval::point(computed)));
    Ok(Evidence::equal(printed, computed).corrected(corrected))
}

/// Where a half swing above `v = 0` ends, if the motion is linear in `q - shift r`.
fn shifted(it: &ClaimCase, shift: f64) -> Result<Evidence> {
    let [end, _] = it.half_swing(it.more)?;
    let growth = exp(-PI * it.d / (1.0 - it.d * it.d).sqrt());
    let around = |centre: f64| centre - (it.more - centre) * growth;
    let evidence = Evidence::equal(around(shift * it.r), end);
    Ok(if shift < 0.0 {
        evidence
    } else {
        evidence.corrected(around(-it.r))
    })
}

/// Change of the energy along a motion by (19), with friction's part multiplied by `sign`.
fn energy(it: &ClaimCase, sign: f64) -> Result<Evidence> {
    let [change, linear, friction] = it.energy_change(it.more, 20.0)?;
    let by_rate = |sign: f64| linear.value + sign * friction.value;
    let error = change.error + linear.error + friction.error;
    let evidence = Evidence::equal(by_rate(sign), Approximation { error, ..change });
    Ok(if sign > 0.0 {
        evidence
    } else {
        evidence.corrected(by_rate(1.0))
    })
}

/// Radius (24).
fn circle(parameters: &Parameters) -> f64 {
    -parameters.r / (2.0 * parameters.d)
}

/// Distance of the border of the basin from the origin.
fn least_kick(it: &ClaimCase) -> Result<Approximation> {
    /// Points on each step of the border, and the relative error of a distance between them.
    const POINTS: (u16, f64) = (200, 1e-5);
    let basin = it.portrait()?;
    let border = basin.borders.first().map(|border| border.curve(POINTS.0)).unwrap_or_default();
    let least = border.iter().map(|point| hypot(point.q, point.v)).fold(f64::INFINITY, f64::min);
    // It is at most that of two of its points, where these are enclosed.
    let kicks = proved_kicks(it, &basin);
    let nearest = kicks.sizes.displacement.zip(kicks.sizes.impulse);
    let bounds = nearest
        .map(|(one, other)| Interval::new(f64::NEG_INFINITY, one.upper().min(other.upper())));
    Ok(Approximation::relative(least, POINTS.1).within(bounds))
}

/// The cycle by (30), (32) and (33) as it should read.
fn closed_form(it: &Parameters) -> Result<LinearCycle> {
    LinearCycle::new(it.d, it.r).ok_or(missing("a limit cycle"))
}

/// `e^(-pi D/omega_d)`, by which the clearance grows in a half swing.
fn growth(cycle: &LinearCycle) -> f64 {
    exp(0.5 * cycle.log_multiplier)
}

/// (33) as it stands in the paper.
fn printed_velocity(cycle: &LinearCycle) -> f64 {
    let LinearCycle { d, clearance, period, .. } = *cycle;
    let omega = TAU / period;
    let angle = atan(omega / d);
    clearance * exp(-d * PI) / omega * exp(-d / omega * angle) * sin(omega + angle)
}

/// (31), on the upper half.
fn curve(cycle: &LinearCycle, angle: f64) -> State {
    let LinearCycle { d, r, clearance, period, .. } = *cycle;
    let omega = TAU / period;
    let grown = clearance * exp(-d / omega * angle);
    let (sine, cosine) = sin_cos(angle);
    State { q: -r - grown * (cosine + d / omega * sine), v: grown / omega * sine }
}

/// Both coordinates of (31) against the motion that starts at the turning point of the cycle.
fn on_the_curve(it: &ClaimCase) -> Result<Evidence> {
    const ANGLE: f64 = 2.0;
    let formula = closed_form(it)?;
    let start = at_rest(-formula.q_max);
    let state = it.state_at(start, ANGLE * formula.period / TAU)?;
    // The start is rounded, and near D = -1 its clearance is a small fraction of it.
    let rounded = 4.0 * f64::EPSILON * growth(&formula) * formula.clearance.max(1.0);
    let State { q, v } = curve(&formula, ANGLE);
    Evidence::worst([("q", q, state[0]), ("v", v, state[1])].map(|(name, formula, known)| {
        let known = Approximation { error: known.error + rounded, ..known };
        Ok(Evidence::equal(formula, known).at(format!("{name} at {}", it.place)))
    }))
}
