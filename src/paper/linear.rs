//! Section 5.1: the cycle of the piecewise linear oscillator, and the basin that it borders.

use std::f64::consts::PI;

use super::equilibria::{least_kick, shifted};
use super::harmonic::units_of_friction;
use super::known::Known;
use super::measure::{
    at_rest, cycles, edge, extent, half_swing, of_cycle, oscillator, over, place, smallest, speed,
    state_at,
};
use super::{Check, Evidence};
use crate::flow::{Limits, Reason};
use crate::model::{Parameters, State};
use crate::numerics::Interval;
use crate::numerics::elementary::{atan, atan2, exp, sin, sin_cos};
use crate::portrait::Border;

pub const CHECKS: &[Check] = &[
    ("periodic border", |limits| {
        let parameters = oscillator(-0.02, 0.5, 0.0, 0.1);
        let found = edge(&parameters, limits)?;
        let cycles = f64::from(u8::from(found.value == Border::Cycle));
        let at = format!("{}, where starts beyond a finite border escape", place(&parameters));
        // A basin without a border would need none.
        let needed = f64::from(u8::from(found.value != Border::None));
        let bounds = found.certain.then_some(Interval::point(cycles));
        Ok(Evidence::equal(needed, Known::exact(cycles).within(bounds)).at(at))
    }),
    ("one cycle", |limits| {
        Evidence::always(DAMPINGS.map(|d| {
            let found = cycles(&units_of_friction(d), limits)?;
            let further = found.map(|found| found.len() == 1 && found[0].clearance > 0.0);
            Ok((format!("D = {d}"), further))
        }))
    }),
    ("circle of radius r", |limits| {
        over(DAMPINGS.map(units_of_friction), |parameters| {
            Ok(Evidence::at_most(parameters.r, least_kick(parameters, limits)?))
        })
    }),
    ("duration of a swing", |limits| over_swings(limits, |swing| PI / swing.omega, |[_, tau]| tau)),
    ("centre with a false sign", |limits| shifted(limits, 1.0)),
    ("velocity on the way", |limits| {
        over(DAMPINGS.map(units_of_friction), |parameters| {
            let swing = LinearSwing::of(parameters);
            let tau = 0.4 * PI / swing.omega;
            let start = at_rest(-parameters.r - 1.0);
            let [_, velocity] = state_at(parameters, start, tau, limits)?;
            let (d, a, b) = (swing.d, -1.0, -swing.d / swing.omega);
            let (sine, cosine) = sin_cos(swing.omega * tau);
            let formula = -(a * d - b * swing.omega) * cosine - (b * d + a * swing.omega) * sine;
            let at = format!("{}, from q = -2, at tau = {tau:.4}", place(parameters));
            Ok(Evidence::equal(formula * exp(-d * tau), velocity).at(at))
        })
    }),
    ("end of a swing", |limits| {
        over_swings(limits, |swing| swing.growth, |[end, _]| end.plus(1.0))
    }),
    ("clearance", |limits| {
        over(std::iter::once(-0.999).chain(DAMPINGS).map(units_of_friction), |parameters| {
            let (cycle, swing) = (smallest(parameters, limits)?, LinearSwing::of(parameters));
            // An exponential has as many times the relative error of its exponent, 70 at D = -0.999.
            let exponent = 1.0 + PI * swing.d.abs() / swing.omega;
            let error = cycle.error.unwrap_or(f64::INFINITY) + exponent * 1e-14;
            let bounds = cycle.bounds.map(|it| it.clearance);
            let computed = Known::relative(cycle.clearance, error).within(bounds);
            Ok(Evidence::equal(swing.clearance(), computed))
        })
    }),
    ("border over the angle", on_the_curve),
    ("A_q", |limits| {
        over(DAMPINGS.map(units_of_friction), |parameters| {
            let LinearSwing { growth, .. } = LinearSwing::of(parameters);
            let formula = (growth + 1.0) / (growth - 1.0);
            Ok(Evidence::equal(formula, extent(&smallest(parameters, limits)?)))
        })
    }),
    ("A_v", |limits| {
        over(DAMPINGS.map(units_of_friction), |parameters| {
            let swing = LinearSwing::of(parameters);
            let computed = speed(&smallest(parameters, limits)?);
            let printed = Evidence::equal(swing.printed_velocity(), computed);
            Ok(printed.corrected(swing.largest_velocity()))
        })
    }),
    ("scale of friction", |limits| {
        let cycle = |r: f64| smallest(&oscillator(-0.4, 0.0, 0.0, r), limits);
        let (one, three) = (cycle(1.0)?, cycle(3.0)?);
        let ratio = three.q_max / one.q_max;
        let unit = one.bounds.map_or(Interval::ALL, |it| it.q_max);
        let ratio = of_cycle(&three, ratio, |it| it.q_max / unit);
        Ok(Evidence::equal(3.0, ratio).at("D = -0.4, D2 = D3 = 0"))
    }),
];

/// Dampings at which formulas of the piecewise linear oscillator are tested.
const DAMPINGS: [f64; 5] = [-0.9, -0.7, -0.4, -0.1, -0.01];

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

/// A formula of the half swing from `(-2, 0)` against the integrated one, at the worst of some dampings.
fn over_swings(
    limits: &Limits,
    formula: fn(&LinearSwing) -> f64,
    read: fn([Known; 2]) -> Known,
) -> Result<Evidence, Reason> {
    over(DAMPINGS.map(units_of_friction), |parameters| {
        let computed = read(half_swing(parameters, at_rest(-2.0), limits)?);
        let at = format!("{}, from q = -2", place(parameters));
        Ok(Evidence::equal(formula(&LinearSwing::of(parameters)), computed).at(at))
    })
}

/// Both coordinates of (31) against the motion that starts at the turning point of the cycle.
fn on_the_curve(limits: &Limits) -> Result<Evidence, Reason> {
    const ANGLE: f64 = 2.0;
    let mut cases = Vec::new();
    for parameters in DAMPINGS.map(units_of_friction) {
        let swing = LinearSwing::of(&parameters);
        let start = at_rest(swing.curve(0.0).q);
        let state = state_at(&parameters, start, ANGLE / swing.omega, limits)?;
        // The start is rounded, and near D = -1 its clearance is a small fraction of it.
        let rounded = 4.0 * f64::EPSILON * swing.growth * swing.clearance().max(1.0);
        let State { q, v } = swing.curve(ANGLE);
        for (name, formula, known) in [("q", q, state[0]), ("v", v, state[1])] {
            let known = Known { error: known.error + rounded, ..known };
            let at = format!("{name} at {}", place(&parameters));
            cases.push(Ok(Evidence::equal(formula, known).at(at)));
        }
    }
    Evidence::worst(cases)
}
