//! The lattice of extremes: values of each parameter, and starts.

use std::fmt;

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

/// A start, by what is special about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpecialStart {
    /// At rest in the middle of the sticking set.
    Centre,
    /// At `q = r`.
    RightEnd,
    /// At `q = -r`.
    LeftEnd,
    /// One unit in the last place inside the right end; 1e-150 where there is no friction.
    InsideRight,
    /// The same at the left end.
    InsideLeft,
    /// One unit in the last place outside the right end.
    OutsideRight,
    /// The same at the left end.
    OutsideLeft,
    /// Three clearances beyond the right end, with `v = -0.0`.
    NegativeZero,
    /// At the centre with the smallest velocity.
    SmallestUp,
    /// The same downwards.
    SmallestDown,
    /// At `q = 1e-150`.
    Tiny,
    /// At `q = 1e6`: far out, where cubic damping is stiff.
    Far,
    /// At `q = 1e150`.
    Huge,
    /// At the centre with a velocity far beyond which motions escape, where there is such a one.
    Escaping,
}

impl fmt::Display for SpecialStart {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.pad(match self {
            SpecialStart::Centre => "centre",
            SpecialStart::RightEnd => "right-end",
            SpecialStart::LeftEnd => "left-end",
            SpecialStart::InsideRight => "inside-right",
            SpecialStart::InsideLeft => "inside-left",
            SpecialStart::OutsideRight => "outside-right",
            SpecialStart::OutsideLeft => "outside-left",
            SpecialStart::NegativeZero => "negative-zero",
            SpecialStart::SmallestUp => "smallest-up",
            SpecialStart::SmallestDown => "smallest-down",
            SpecialStart::Tiny => "tiny",
            SpecialStart::Far => "far",
            SpecialStart::Huge => "huge",
            SpecialStart::Escaping => "escaping",
        })
    }
}

/// Every start.
pub const STARTS: [SpecialStart; 14] = [
    SpecialStart::Centre,
    SpecialStart::RightEnd,
    SpecialStart::LeftEnd,
    SpecialStart::InsideRight,
    SpecialStart::InsideLeft,
    SpecialStart::OutsideRight,
    SpecialStart::OutsideLeft,
    SpecialStart::NegativeZero,
    SpecialStart::SmallestUp,
    SpecialStart::SmallestDown,
    SpecialStart::Tiny,
    SpecialStart::Far,
    SpecialStart::Huge,
    SpecialStart::Escaping,
];

/// End time of every motion: some twenty half swings.
pub const UNTIL: f64 = 60.0;

/// Every how many motions the thin lattice takes one. It has no factor in common with the number of
/// values of any parameter or of starts, so every value meets every other one.
pub const THIN: usize = 11;

/// One motion of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Case {
    pub parameters: Parameters,
    /// What is special about its start.
    pub start: SpecialStart,
    /// Its start.
    pub initial: State,
}

impl SpecialStart {
    /// The start at these parameters.
    pub fn state(self, parameters: &Parameters) -> State {
        /// How far beyond the balance of all other terms the escaping velocity is.
        const BEYOND: f64 = 100.0;
        let Parameters { d, d2, d3, r } = *parameters;
        let at = |q| State { q, v: 0.0 };
        let above = |q: f64| if q == 0.0 { LEAST } else { q.next_up() };
        match self {
            SpecialStart::Centre => at(0.0),
            SpecialStart::RightEnd => at(r),
            SpecialStart::LeftEnd => at(-r),
            SpecialStart::InsideRight => at(-above(-r)),
            SpecialStart::InsideLeft => at(above(-r)),
            SpecialStart::OutsideRight => at(above(r)),
            SpecialStart::OutsideLeft => at(-above(r)),
            SpecialStart::NegativeZero => State { q: 4.0 * r.max(1e-3), v: -0.0 },
            SpecialStart::SmallestUp => State { q: 0.0, v: LEAST },
            SpecialStart::SmallestDown => State { q: 0.0, v: -LEAST },
            SpecialStart::Tiny => at(LEAST),
            SpecialStart::Far => at(1e6),
            SpecialStart::Huge => at(1e150),
            SpecialStart::Escaping => {
                let others = 1.0 + 2.0 * d.abs();
                let quadratic = if d2 == 0.0 { 0.0 } else { others / d2.abs() };
                let cubic = if d3 == 0.0 { 0.0 } else { others.sqrt() / d3.abs().sqrt() };
                let beyond = BEYOND * quadratic.max(cubic).max(r.sqrt()).max(1.0);
                State { q: 0.0, v: if d2 > 0.0 { -beyond } else { beyond } }
            }
        }
    }
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
        STARTS.map(|start| Case { parameters, start, initial: start.state(&parameters) })
    });
    all.step_by(if thin { THIN } else { 1 })
}
