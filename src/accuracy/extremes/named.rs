//! Extremes that have names: what is known of them, and how far from it each method ends.

use serde::Serialize;

use super::UNTIL;
use super::verdict::methods;
use crate::flow::{Cost, Crossing, Detail, Limits, Method, Motion, Outcome, Problem, trajectory};
use crate::model::{Parameters, State, energy};
use crate::numerics::{amount, cells, times_power};

/// One of them by one method.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct NamedExtreme {
    pub what: &'static str,
    pub method: Method,
    pub measure: &'static str,
    /// The measured value; infinite where the answer is of the wrong kind.
    pub measured: f64,
    /// The largest value that is right.
    pub allowed: f64,
    pub cost: Cost,
}

/// Motions that run to infinity, and when they get there.
const BLOW_UPS: &str = include_str!("../../../assets/blow_ups.txt");

/// Every named extreme by the methods that serve it.
pub fn named(limits: &Limits) -> Vec<NamedExtreme> {
    let mut all = vec![
        many_swings(Method::Exact, 1e-13, 1e-15, limits),
        many_swings(Method::Taylor, 1e-15, 1e-13, limits),
    ];
    for [what, numbers @ ..] in BLOW_UPS.lines().filter_map(cells::<7>) {
        let numbers = numbers.map(|number| number.parse().unwrap_or(f64::NAN));
        all.extend(methods(false).map(|method| blow_up(what, numbers, method, limits)));
    }
    all.extend([Method::Auto, Method::Stiff].map(|method| far_out(method, limits)));
    all.extend(methods(false).map(|method| scaled_and_mirrored(method, limits)));
    all
}

impl NamedExtreme {
    /// What is measured of a motion, infinite where it is `None`, and the largest value that is right.
    fn of(
        what: &'static str,
        (measure, allowed): (&'static str, f64),
        problem: &Problem,
        limits: &Limits,
        measured: impl Fn(&Motion) -> Option<f64>,
    ) -> Self {
        let motion = trajectory(problem, Detail::default(), limits);
        let measured = measured(&motion).unwrap_or(f64::INFINITY);
        let (method, cost) = (problem.method, motion.cost);
        NamedExtreme { what, method, measure, measured, allowed, cost }
    }
}

/// A million half swings of the undamped oscillator, and what they did to its energy.
fn many_swings(method: Method, tolerance: f64, allowed: f64, limits: &Limits) -> NamedExtreme {
    const SWINGS: f64 = 1e6;
    let until = (SWINGS + 0.5) * std::f64::consts::PI;
    let undamped = Problem::new([0.0; 4].into(), State { q: 1.0, v: 0.0 }, until);
    let problem = Problem { method, tolerance, ..undamped };
    let measure = ("energy gained or lost", allowed);
    let what = "a million half swings at D = r = 0";
    NamedExtreme::of(what, measure, &problem, limits, |motion| {
        let Outcome::Moving { q, v, .. } = motion.outcome else { return None };
        let changed = energy(State { q, v }) / energy(problem.initial) - 1.0;
        (motion.crossings.len() == 1_000_000).then_some(changed.abs())
    })
}

/// A motion that runs to infinity, whose line has these numbers.
fn blow_up(
    what: &'static str,
    [d, d2, d3, q, v, time]: [f64; 6],
    method: Method,
    limits: &Limits,
) -> NamedExtreme {
    let parameters = [d, d2, d3, 0.0].into();
    let problem = Problem { method, ..Problem::new(parameters, State { q, v }, UNTIL) };
    let measure = ("relative error of its time", 1e-8);
    NamedExtreme::of(what, measure, &problem, limits, |motion| match motion.outcome {
        Outcome::Escaped { tau } => Some((tau / time - 1.0).abs()),
        _ => None,
    })
}

/// The start from which an explicit method needs a hundred million steps.
fn far_out(method: Method, limits: &Limits) -> NamedExtreme {
    let parameters = Parameters { d: -0.1, d2: 0.0, d3: 1.0, r: 0.1 };
    let problem = Problem { method, ..Problem::new(parameters, State { q: 1e6, v: 0.0 }, 2e4) };
    let what = "far out at q0 = 1e6, D3 = 1, until it rests";
    NamedExtreme::of(what, ("steps", 5_000.0), &problem, limits, |motion| {
        let rests = matches!(motion.outcome, Outcome::Captured { .. });
        rests.then_some(amount(motion.cost.steps))
    })
}

/// One motion in units of every power of two from -240 to 240, and its mirror image in each.
fn scaled_and_mirrored(method: Method, limits: &Limits) -> NamedExtreme {
    let parameters = Parameters { d: -0.1, d2: 0.3, d3: 0.4, r: 0.05 };
    let plain = Problem { method, ..Problem::new(parameters, State { q: 2.0, v: -1.0 }, 20.0) };
    let follow = |problem: &Problem| trajectory(problem, Detail::default(), limits);
    let reference = follow(&plain);
    let mut cost = reference.cost;
    let mut different = 0.0;
    for k in -240..=240 {
        let scaled = Problem {
            parameters: parameters.times_power(k),
            initial: State { q: times_power(2.0, k), v: times_power(-1.0, k) },
            ..plain
        };
        let mirrored = Problem {
            parameters: scaled.parameters.mirrored(),
            initial: scaled.initial.mirrored(),
            ..scaled
        };
        for (problem, sign) in [(scaled, 1.0), (mirrored, -1.0)] {
            let motion = follow(&problem);
            cost += motion.cost;
            different += f64::from(!is_image(&motion, &reference, sign, k));
        }
    }
    let what = "scaled by 2^k, k = -240 .. 240, and mirrored";
    let measure = "images that differ in any bit";
    NamedExtreme { what, method, measure, measured: different, allowed: 0.0, cost }
}

/// Whether a motion is `sign * 2^k` times another one, to the last bit.
fn is_image(motion: &Motion, of: &Motion, sign: f64, k: i32) -> bool {
    let is_image = |q: f64, of: f64| q.to_bits() == (sign * times_power(of, k)).to_bits();
    let ends = motion.outcome.state().zip(of.outcome.state());
    // The velocity of what rests has no sign.
    let same_end = ends.is_some_and(|((q, v), (from, speed))| {
        is_image(q, from) && (is_image(v, speed) || matches!(of.outcome, Outcome::Captured { .. }))
    });
    let turn = |it: &Crossing, from: &Crossing| it.tau == from.tau && is_image(it.q, from.q);
    motion.outcome.word() == of.outcome.word()
        && motion.outcome.tau() == of.outcome.tau()
        && same_end
        && motion.crossings.len() == of.crossings.len()
        && motion.crossings.iter().zip(&of.crossings).all(|(one, from)| turn(one, from))
}
