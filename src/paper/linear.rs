//! Section 5.1: the cycle of the piecewise linear oscillator, and the basin that it borders.

use std::f64::consts::PI;

use super::equilibria::{least_kick, shifted};
use super::known::Known;
use super::measure::{Case, at_rest};
use super::{Check, Evidence, always, worst};
use crate::flow::Reason;
use crate::model::{Parameters, State};
use crate::numerics::{Interval, atan, atan2, exp, sin, sin_cos};
use crate::portrait::Border;

pub const CHECKS: &[Check] = &[
    worst("periodic border", |it| {
        let found = it.edge()?;
        let cycles = f64::from(u8::from(found.value == Border::Cycle));
        // A basin without a border would need none.
        let needed = f64::from(u8::from(found.value != Border::None));
        let bounds = found.certain.then_some(Interval::point(cycles));
        Ok(Evidence::equal(needed, Known::exact(cycles).within(bounds)))
    }),
    always("one cycle", |it| {
        Ok(it.cycles()?.map(|found| found.len() == 1 && found[0].clearance > 0.0))
    }),
    worst("circle of radius r", |it| Ok(Evidence::at_most(it.r, least_kick(it)?))),
    worst("duration of a swing", |it| {
        let [_, tau] = it.half_swing(at_rest(it.more))?;
        Ok(Evidence::equal(PI / LinearSwing::of(it).omega, tau))
    }),
    worst("centre with a false sign", |it| shifted(it, 1.0)),
    worst("velocity on the way", |it| {
        let swing = LinearSwing::of(it);
        let tau = 0.4 * PI / swing.omega;
        let [_, velocity] = it.state_at(at_rest(it.more), tau)?;
        let (d, a, b) = (swing.d, -1.0, -swing.d / swing.omega);
        let (sine, cosine) = sin_cos(swing.omega * tau);
        let formula = -(a * d - b * swing.omega) * cosine - (b * d + a * swing.omega) * sine;
        let at = format!("{}, at tau = {tau:.4}", it.place);
        Ok(Evidence::equal(formula * exp(-d * tau), velocity).at(at))
    }),
    worst("end of a swing", |it| {
        let [end, _] = it.half_swing(at_rest(it.more))?;
        Ok(Evidence::equal(LinearSwing::of(it).growth, end.plus(it.r)))
    }),
    worst("clearance", |it| {
        let (cycle, swing) = (it.smallest()?, LinearSwing::of(it));
        // An exponential has as many times the relative error of its exponent, 70 at D = -0.999.
        let exponent = 1.0 + PI * swing.d.abs() / swing.omega;
        let error = cycle.error.unwrap_or(f64::INFINITY) + exponent * 1e-14;
        let bounds = cycle.bounds.map(|it| it.clearance);
        let computed = Known::relative(cycle.clearance, error).within(bounds);
        Ok(Evidence::equal(swing.clearance(), computed))
    }),
    worst("border over the angle", on_the_curve),
    worst("A_q", |it| {
        let LinearSwing { growth, .. } = LinearSwing::of(it);
        Ok(Evidence::equal((growth + 1.0) / (growth - 1.0), it.smallest()?.extent()))
    }),
    worst("A_v", |it| {
        let swing = LinearSwing::of(it);
        let printed = Evidence::equal(swing.printed_velocity(), it.smallest()?.speed());
        Ok(printed.corrected(swing.largest_velocity()))
    }),
    worst("scale of friction", |it| {
        let cycle = |r: f64| it.of(Parameters { r, ..**it }).smallest();
        let (one, three) = (cycle(1.0)?, cycle(3.0)?);
        let unit = one.bounds.map_or(Interval::ALL, |it| it.q_max);
        Ok(Evidence::equal(3.0, three.known(three.q_max / one.q_max, |it| it.q_max / unit)))
    }),
];

/// What the formulas of a half swing are made of, in units of friction.
struct LinearSwing {
    d: f64,
    /// Frequency `omega_d`.
    omega: f64,
    /// `e^(-pi D/omega_d)`.
    growth: f64,
}

impl LinearSwing {
    fn of(parameters: &Parameters) -> Self {
        let d = parameters.d;
        let omega = (1.0 - d * d).sqrt();
        LinearSwing { d, omega, growth: exp(-PI * d / omega) }
    }

    fn clearance(&self) -> f64 {
        2.0 / (self.growth - 1.0)
    }

    /// (33) as it stands in the paper.
    fn printed_velocity(&self) -> f64 {
        let LinearSwing { d, omega, growth } = *self;
        let angle = atan(omega / d);
        2.0 * exp(-d * PI) / (omega * (growth - 1.0)) * exp(-d / omega * angle) * sin(omega + angle)
    }

    /// (33) as it should read: the maximum of (31).
    fn largest_velocity(&self) -> f64 {
        let angle = atan2(self.omega, self.d);
        self.clearance() * exp(-self.d / self.omega * angle)
    }

    /// (31), on the upper half.
    fn curve(&self, angle: f64) -> State {
        let LinearSwing { d, omega, growth } = *self;
        let grown = 2.0 / (growth - 1.0) * exp(-d / omega * angle);
        let (sine, cosine) = sin_cos(angle);
        State { q: -1.0 - grown * (cosine + d / omega * sine), v: grown / omega * sine }
    }
}

/// Both coordinates of (31) against the motion that starts at the turning point of the cycle.
fn on_the_curve(it: &Case) -> Result<Evidence, Reason> {
    const ANGLE: f64 = 2.0;
    let swing = LinearSwing::of(it);
    let start = at_rest(swing.curve(0.0).q);
    let state = it.state_at(start, ANGLE / swing.omega)?;
    // The start is rounded, and near D = -1 its clearance is a small fraction of it.
    let rounded = 4.0 * f64::EPSILON * swing.growth * swing.clearance().max(1.0);
    let State { q, v } = swing.curve(ANGLE);
    Evidence::worst([("q", q, state[0]), ("v", v, state[1])].map(|(name, formula, known)| {
        let known = Known { error: known.error + rounded, ..known };
        Ok(Evidence::equal(formula, known).at(format!("{name} at {}", it.place)))
    }))
}
