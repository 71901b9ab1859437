//! The lattice of extremes: values of each parameter, and starts.

use serde::Serialize;

use crate::model::{Parameters, State};

/// Linear damping: a node that repels, both sides of critical, nearly none, none, and much.
pub const D: [f64; 12] =
    [-1.0 - 1e-3, -1.0, -0.999_999, -0.999, -0.1, -1e-12, -0.0, 0.0, 1e-150, 0.5, 1.0, 2.0];

/// Friction, from none through the least there may be to a sticking set larger than most starts.
pub const R: [f64; 5] = [0.0, 1e-150, 1e-12, 1.0, 1e12];

/// The least start that is not 0.
const LEAST: f64 = 1e-150;

/// Asymmetric and cubic damping.
pub const D2_D3: [f64; 5] = [-1e6, -1e-12, 0.0, 1e-12, 1e6];

/// A start, by what is special about it, at given parameters.
type SpecialStart = (&'static str, fn(&Parameters) -> State);

/// Every start.
pub const STARTS: [SpecialStart; 14] = [
    // At rest in the middle of the sticking set.
    ("centre", |_| at(0.0)),
    ("right-end", |parameters| at(parameters.r)),
    ("left-end", |parameters| at(-parameters.r)),
    // One unit in the last place inside an end of the sticking set; 1e-150 where there is no friction.
    ("inside-right", |parameters| at(-above(-parameters.r))),
    ("inside-left", |parameters| at(above(-parameters.r))),
    // One unit in the last place outside.
    ("outside-right", |parameters| at(above(parameters.r))),
    ("outside-left", |parameters| at(-above(parameters.r))),
    // Three clearances beyond the right end.
    ("negative-zero", |parameters| State { q: 4.0 * parameters.r.max(1e-3), v: -0.0 }),
    // At the centre with the smallest velocity.
    ("smallest-up", |_| State { q: 0.0, v: LEAST }),
    ("smallest-down", |_| State { q: 0.0, v: -LEAST }),
    ("tiny", |_| at(LEAST)),
    // Far out, where cubic damping is stiff.
    ("far", |_| at(1e6)),
    ("huge", |_| at(1e150)),
    ("escaping", escaping),
];

fn at(q: f64) -> State {
    State { q, v: 0.0 }
}

fn above(q: f64) -> f64 {
    if q == 0.0 { LEAST } else { q.next_up() }
}

/// At the centre with a velocity far beyond which motions escape, where there is such a one.
fn escaping(parameters: &Parameters) -> State {
    /// How far beyond the balance of all other terms it is.
    const BEYOND: f64 = 100.0;
    let Parameters { d, d2, d3, r } = *parameters;
    let others = 1.0 + 2.0 * d.abs();
    let quadratic = if d2 == 0.0 { 0.0 } else { others / d2.abs() };
    let cubic = if d3 == 0.0 {
        0.0
    } else {
        others.sqrt() / d3.abs().sqrt()
    };
    let beyond = BEYOND * quadratic.max(cubic).max(r.sqrt()).max(1.0);
    State { q: 0.0, v: if d2 > 0.0 { -beyond } else { beyond } }
}

/// End time of every motion: some twenty half swings.
pub const UNTIL: f64 = 60.0;

/// Every how many motions the thin lattice takes one. It has no factor in common with the number of
/// values of any parameter or of starts, so every value meets every other one.
pub const THIN: usize = 11;

/// One motion of the lattice.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Case {
    pub parameters: Parameters,
    /// What is special about its start.
    pub start: &'static str,
    /// Its start.
    pub initial: State,
}

/// The parameters of the lattice.
pub fn all_parameters() -> impl Iterator<Item = Parameters> {
    D.iter().flat_map(|&d| {
        let rows = R.iter().flat_map(move |&r| D2_D3.map(|d2| (r, d2)));
        rows.flat_map(move |(r, d2)| D2_D3.map(|d3| Parameters { d, d2, d3, r }))
    })
}

/// The motions of the lattice, every one or, if `thin`, each [`THIN`]th.
pub fn cases(thin: bool) -> impl Iterator<Item = Case> {
    let all = all_parameters().flat_map(|parameters| {
        STARTS.map(|(start, state)| Case { parameters, start, initial: state(&parameters) })
    });
    all.step_by(if thin { THIN } else { 1 })
}
