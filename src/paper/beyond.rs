//! What the paper does not say: the multiplier, a first integral, escape, and where the cycle ends.

use std::f64::consts::PI;

use super::known::{Certain, Known};
use super::measure::{
    BoundedCycle, arcs, at_rest, cycles, enclosed, half_swing, last_cycle, missing, motion,
    of_cycle, oscillator, place, smallest, state_at, towards,
};
use super::{Check, Evidence, belt};
use crate::branch::escape::escape_point;
use crate::flow::{Limits, Outcome, Reason};
use crate::model::{Parameters, State};
use crate::numerics::Interval;
use crate::numerics::elementary::exp;
use crate::portrait::basin::basin;
use crate::proof::motion::ProvedFate;

pub const CHECKS: &[Check] = &[
    ("contact with the belt", belt::contact),
    ("multiplier", |limits| {
        let parameters = oscillator(-0.3, 0.2, 0.5, 0.1);
        Evidence::worst(cycles(&parameters, limits)?.value.into_iter().map(|cycle| {
            let Parameters { d, d3, r, .. } = parameters;
            let [rise, fall] = arcs(&parameters, &cycle, limits)?;
            let square = rise.area() + fall.area();
            let share = |turning: f64| (turning - r) / (turning + r);
            // On a closed curve the integral of v vanishes.
            let formula = share(-cycle.q_min)
                * share(cycle.q_max)
                * exp(-2.0 * d * cycle.period - 3.0 * d3 * square);
            let computed = return_slope(&parameters, &cycle, limits)?;
            let at = format!("{}, q_max = {:.6}", place(&parameters), cycle.q_max);
            Ok(Evidence::equal(formula, computed).at(at))
        }))
    }),
    ("linear multiplier", |limits| {
        let parameters = oscillator(-0.4, 0.0, 0.0, 0.1);
        let cycle = smallest(&parameters, limits)?;
        let omega = (1.0 - parameters.d * parameters.d).sqrt();
        let computed = return_slope(&parameters, &cycle, limits)?;
        let formula = exp(-2.0 * PI * parameters.d / omega);
        Ok(Evidence::equal(formula, computed).at(place(&parameters)))
    }),
    ("first integral", |limits| {
        let parameters = oscillator(0.0, 0.4, 0.0, 0.0);
        let start = State { q: 0.3, v: 0.6 };
        let [q, v] = state_at(&parameters, start, 4.0, limits)?;
        let before = first_integral(parameters.d2, start);
        let after = first_integral(parameters.d2, State { q: q.value, v: v.value });
        let error = 4.0 * (q.error + v.error) + 64.0 * f64::EPSILON;
        let at = format!("{}, from (0.3, 0.6) until tau = 4", place(&parameters));
        let bounds = q.bounds.zip(v.bounds).map(|(q, v)| enclosed_integral(parameters.d2, q, v));
        Ok(Evidence::equal(before, Known::new(after, error).within(bounds)).at(at))
    }),
    ("no return", |limits| {
        let oscillators = [
            oscillator(0.0, 0.5, 0.0, 0.1),
            oscillator(0.0, 2.0, 0.5, 0.01),
            oscillator(0.01, -1.0, 0.0, 0.1),
            oscillator(0.3, 0.3, 0.3, 0.0),
        ];
        let cases = oscillators.iter().flat_map(|it| [0.2, 1.0, 3.0].map(|q| (it, q)));
        Evidence::always(cases.map(|(parameters, q)| {
            let returned = returns_to(parameters, q, limits)?;
            Ok((format!("{}, q = {q}", place(parameters)), returned.is(false)))
        }))
    }),
    ("parabola of escape", |limits| {
        let impulse = |part: f64| {
            let parameters = oscillator(-1e-3 * part, 0.5, 0.0, 1e-2 * part);
            let margin = basin(&parameters, 10.0, limits)?.margin();
            let impulse = margin.impulse.ok_or(missing("the separatrix"))?;
            let formula = (0.5 / (parameters.d2 * parameters.d2)).sqrt();
            Ok((formula, Known::relative(impulse, 1e-12)))
        };
        let evidence = Evidence::tends(impulse(1.0)?, impulse(0.01)?);
        Ok(evidence.at("D = -1e-5, D2 = 0.5, r = 1e-4"))
    }),
    ("escape beyond the cycle", |limits| {
        let mut cases = Vec::new();
        for d in [-0.3, 0.0, 0.3] {
            let parameters = oscillator(d, 0.2, -0.5, 0.1);
            let cycle = smallest(&parameters, limits)?;
            for part in [1.001, 1.5, 10.0] {
                let start = at_rest(part * cycle.q_max);
                let end = motion(&parameters, start, 1e3, limits)?.outcome;
                let case = format!("{}, q = {:.6}", place(&parameters), start.q);
                let fate = enclosed(&parameters, start, 1e3).fate;
                let value = matches!(end, Outcome::Escaped { .. });
                let certain = value && matches!(fate, ProvedFate::Escaped { .. });
                cases.push(Ok((case, Certain { value, certain })));
            }
        }
        Evidence::always(cases)
    }),
    ("end of the cycle", |limits| {
        Evidence::worst([0.02, 0.05, 0.1, 0.25, 0.5, 1.0].map(|d2| {
            let parameters = oscillator(0.0, d2, 0.0, 1.0);
            let end = end_of_cycle(&parameters, limits)?;
            let computed = last_cycle(&parameters, end, 1e-12);
            let formula = -(2.0 / PI).sqrt() * d2;
            Ok(Evidence::near(formula, computed).at(format!("D2 = {d2}, r = 1")))
        }))
    }),
    ("cycles about D_c", |limits| {
        let mut cases = Vec::new();
        for d2 in [0.1, 0.5, 2.0] {
            let end = end_of_cycle(&oscillator(0.0, d2, 0.0, 0.3), limits)?;
            for (part, expected) in [(1.5, 1), (1.01, 1), (0.99, 0), (0.5, 0)] {
                let parameters = oscillator(part * end, d2, 0.0, 0.3);
                let case = format!("D = {part} D_c, D2 = {d2}, r = 0.3");
                cases.push(Ok((case, cycles(&parameters, limits)?.map(Vec::len).is(expected))));
            }
        }
        Evidence::always(cases)
    }),
    ("left turning point", |limits| {
        let end = end_of_cycle(&oscillator(0.0, 0.5, 0.0, 0.1), limits)?;
        let cases = [2.0, 1.000_001].map(|part| oscillator(part * end, 0.5, 0.0, 0.1));
        let evidence = towards(cases, |parameters| {
            let (cycle, minus) = (smallest(parameters, limits)?, Interval::point(-1.0));
            Ok((0.0, of_cycle(&cycle, -1.0 / cycle.q_min, |it| minus / it.q_min)))
        })?;
        Ok(evidence.at("D = 1.000001 D_c, D2 = 0.5, r = 0.1"))
    }),
];

/// Whether a motion from rest at `q` is at rest there, or further out, one turn later.
fn returns_to(parameters: &Parameters, q: f64, limits: &Limits) -> Result<Certain<bool>, Reason> {
    let motion = motion(parameters, at_rest(q), 60.0, limits)?;
    let value = motion.crossings.get(1).is_some_and(|crossing| crossing.q >= q);
    let bounds = enclosed(parameters, at_rest(q), 60.0);
    let nearer = match (bounds.turns.get(1), bounds.fate) {
        (Some(turn), _) => turn.q.upper() < q,
        (None, ProvedFate::Captured { .. } | ProvedFate::Escaped { .. }) => true,
        (None, _) => false,
    };
    Ok(Certain { value, certain: nearer && !value })
}

/// The slope of the return map of `v = 0, q > r` at a cycle: central differences of integrated motions.
fn return_slope(
    parameters: &Parameters,
    cycle: &BoundedCycle,
    limits: &Limits,
) -> Result<Known, Reason> {
    let q = cycle.q_max;
    let turn = |q: f64| {
        let [left, _] = half_swing(parameters, at_rest(q), limits)?;
        half_swing(parameters, at_rest(left.value), limits).map(|[right, _]| right.value)
    };
    let slope = |h: f64| -> Result<f64, Reason> {
        let wide = (turn(q + 2.0 * h)? - turn(q - 2.0 * h)?) / (4.0 * h);
        let narrow = (turn(q + h)? - turn(q - h)?) / (2.0 * h);
        Ok(narrow + (narrow - wide) / 3.0)
    };
    let step = 1e-3 * (q - parameters.r);
    let known = Known::twice(slope(step)?, slope(2.0 * step)?);
    // The integrated turns themselves are known to some 1e-14.
    let known = Known::new(known.value, known.error + 1e-13 * q / step);
    Ok(known.within(cycle.bounds.map(|it| it.multiplier)))
}

/// The first integral of the motion with D2 alone.
fn first_integral(d2: f64, State { q, v }: State) -> f64 {
    (0.5 * v * v + q / (2.0 * d2) - 1.0 / (4.0 * d2 * d2)) * exp(2.0 * d2 * q)
}

/// The same, of all states of a box.
fn enclosed_integral(d2: f64, q: Interval, v: Interval) -> Interval {
    let [one, double] = [1.0, 2.0 * d2].map(Interval::point);
    let bracket = v.square() * 0.5 + q / double - one / double.square();
    bracket * (double * q).exp()
}

/// `D_c`.
fn end_of_cycle(parameters: &Parameters, limits: &Limits) -> Result<f64, Reason> {
    escape_point(parameters, limits)?.0.ok_or(missing("the end of the cycle"))
}
