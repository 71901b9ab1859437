//! What the paper does not say: the multiplier, a first integral, escape, and where the cycle ends.

use std::f64::consts::PI;

use super::{
    Approximation, BoundedCycle, Check, ClaimCase, Conclusion, Evidence, always, at_rest, missing,
    model, tends, worst,
};
use crate::branch::escape_point;
use crate::flow::{Outcome, Result};
use crate::model::{Parameters, State};
use crate::numerics::{Interval, exp};
use crate::proof::ProvedFate;

pub(super) const CHECKS: &[Check] = &[
    worst("contact with the belt", model::contact),
    worst("multiplier", |it| {
        Evidence::worst(it.cycles()?.value.into_iter().map(|cycle| {
            let Parameters { d, d3, r, .. } = **it;
            let [rise, fall] = it.arcs(&cycle)?;
            let [square, _, _] = (rise.powers() + fall.powers()).into();
            let share = |turning: f64| (turning - r) / (turning + r);
            // On a closed curve the integral of v vanishes.
            let formula = share(-cycle.q_min)
                * share(cycle.q_max)
                * exp(-2.0 * d * cycle.period - 3.0 * d3 * square);
            let at = format!("{}, q_max = {:.6}", it.place, cycle.q_max);
            Ok(Evidence::equal(formula, return_slope(it, &cycle)?).at(at))
        }))
    }),
    worst("linear multiplier", |it| {
        let formula = exp(-2.0 * PI * it.d / (1.0 - it.d * it.d).sqrt());
        Ok(Evidence::equal(formula, return_slope(it, &it.smallest()?)?))
    }),
    worst("first integral", |it| {
        let start = State { q: 0.3, v: 0.6 };
        let [q, v] = it.state_at(start, it.more)?;
        let before = first_integral(it.d2, start);
        let after = first_integral(it.d2, State { q: q.value, v: v.value });
        let error = 4.0 * (q.error + v.error) + 64.0 * f64::EPSILON;
        let bounds = q.bounds.zip(v.bounds).map(|(q, v)| enclosed_integral(it.d2, q, v));
        Ok(Evidence::equal(before, Approximation::new(after, error).within(bounds)))
    }),
    always("no return", |it| Ok(returns_to(it, it.more)?.is(false))),
    tends("parabola of escape", |it| {
        let impulse = it.portrait()?.margin.impulse;
        let impulse = impulse.ok_or(missing("the separatrix"))?;
        Ok(((0.5 / (it.d2 * it.d2)).sqrt(), Approximation::relative(impulse, 1e-12)))
    }),
    always("escape beyond the cycle", |it| {
        let start = at_rest(it.more * it.smallest()?.q_max);
        let end = it.motion(start, 1e3)?.outcome;
        let fate = it.enclosed(start, 1e3).fate;
        let value = matches!(end, Outcome::Escaped { .. });
        Ok(Conclusion { value, certain: value && fate == ProvedFate::Escaped })
    }),
    worst("end of the cycle", |it| {
        let computed = it.last_cycle(end_of_cycle(it)?);
        Ok(Evidence::near(-(2.0 / PI).sqrt() * it.d2 * it.r, computed))
    }),
    always("cycles about D_c", |it| {
        let found = beside_the_end(it)?.cycles()?;
        Ok(found.map(Vec::len).is(usize::from(it.more > 1.0)))
    }),
    tends("left turning point", |it| {
        let (cycle, minus) = (beside_the_end(it)?.smallest()?, Interval::point(-1.0));
        Ok((0.0, cycle.known(-1.0 / cycle.q_min, |it| minus / it.q_min)))
    }),
];

/// Whether a motion from rest at `q` is at rest there, or further out, one turn later.
fn returns_to(it: &ClaimCase, q: f64) -> Result<Conclusion<bool>> {
    let motion = it.motion(at_rest(q), 60.0)?;
    let value = motion.crossings.get(1).is_some_and(|crossing| crossing.q >= q);
    let bounds = it.enclosed(at_rest(q), 60.0);
    let nearer = match (bounds.turns.get(1), bounds.fate) {
        (Some(turn), _) => turn.q.is_some_and(|place| place.upper() < q),
        (None, ProvedFate::Captured | ProvedFate::Escaped) => true,
        (None, _) => false,
    };
    Ok(Conclusion { value, certain: nearer && !value })
}

/// The slope of the return map of `v = 0, q > r` at a cycle: central differences of integrated motions.
fn return_slope(it: &ClaimCase, cycle: &BoundedCycle) -> Result<Approximation> {
    let q = cycle.q_max;
    let turn = |q: f64| {
        let [left, _] = it.half_swing(q)?;
        it.half_swing(left.value).map(|[right, _]| right.value)
    };
    let slope = |h: f64| -> Result<f64> {
        let wide = (turn(q + 2.0 * h)? - turn(q - 2.0 * h)?) / (4.0 * h);
        let narrow = (turn(q + h)? - turn(q - h)?) / (2.0 * h);
        Ok(narrow + (narrow - wide) / 3.0)
    };
    let step = 1e-3 * (q - it.r);
    let known = Approximation::twice(slope(step)?, slope(2.0 * step)?);
    // The integrated turns themselves are known to some 1e-14.
    let known = Approximation::new(known.value, known.error + 1e-13 * q / step);
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
fn end_of_cycle(it: &ClaimCase) -> Result<f64> {
    escape_point(it, &it.limits)?.0.ok_or(missing("the end of the cycle"))
}

/// The oscillator at a part of `D_c`.
fn beside_the_end<'a>(it: &ClaimCase<'a>) -> Result<ClaimCase<'a>> {
    let d = it.more * end_of_cycle(it)?;
    Ok(it.of(Parameters { d, ..**it }))
}
