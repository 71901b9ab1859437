//! All limit cycles for given parameters, proved: their number, and bounds of their characteristics.

use serde::Serialize;

use super::affine::affine_cycle;
use super::count::Count;
use super::enclose::{Enclosure, enclose};
use super::ends::{SearchEnd, inner_end, outer_end};
use super::field::{ParameterBox, scaled};
use super::map::ProvedMap;
use super::theorems::{Theorem, theorem};
use crate::numerics::Interval;
use crate::numerics::scaling::exponent;

/// A limit cycle that exists and is unique in an interval of clearances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvedCycle {
    /// Contains its clearance `q_max - r` and that of no other cycle.
    pub within: Interval,
    /// Whether it attracts.
    pub stable: bool,
    /// Bounds of its characteristics, where they could be computed.
    pub enclosure: Option<Enclosure>,
}

/// Clearances for which nothing is proved.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Open {
    /// Smallest clearance.
    pub lower: f64,
    /// Largest clearance; infinite where there is no bound.
    pub upper: f64,
    /// Why they are open.
    pub reason: &'static str,
}

/// What is proved about the limit cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// The parameters for all of which it holds.
    pub parameters: ParameterBox,
    /// The theorem that gave the number of cycles without computing motions.
    pub theorem: Option<Theorem>,
    /// The cycles, by amplitude.
    pub cycles: Vec<ProvedCycle>,
    /// What could not be decided. If this is empty, there are these cycles and no others.
    pub open: Vec<Open>,
    /// Number of certified half swings computed.
    pub swings: u32,
}

impl Proof {
    /// Whether the number of cycles is proved.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.open.is_empty()
    }
}

const STIFF: &str = "a half swing is too stiff to be enclosed";
const CLOSE: &str = "the return map comes closer to its diagonal than it can be bounded";
const PARTLY: &str =
    "the number of cycles differs, or may differ, within the parameters' intervals";

/// Proves the number of cycles and encloses them; `hints` are clearances near which cycles may lie.
#[must_use]
pub fn prove(parameters: &ParameterBox, hints: &[f64]) -> Proof {
    let (local, unit) = in_own_units(parameters);
    let hints: Vec<f64> =
        hints.iter().map(|&hint| scaled(Interval::point(hint), -unit).middle()).collect();
    let mut proof = prove_in_units(&local, &hints);
    proof.parameters = *parameters;
    for cycle in &mut proof.cycles {
        cycle.within = scaled(cycle.within, unit);
        cycle.enclosure = cycle.enclosure.map(|it| it.times_power(unit));
    }
    for open in &mut proof.open {
        let clearances = scaled(Interval::new(open.lower, open.upper), unit);
        (open.lower, open.upper) = (clearances.lower(), clearances.upper());
    }
    proof
}

/// Whether each cycle attracts, smallest cycle first, or `None` where their number is not proved; and the
/// integration steps that it took. This costs a part of [`prove`], as no cycle is enclosed.
pub(crate) fn stabilities(parameters: &ParameterBox) -> (Option<Vec<bool>>, u32) {
    let (local, _) = in_own_units(parameters);
    let mut map = ProvedMap::new(&local);
    let count = counted(theorem(&local), &mut map);
    let stable = || count.unique.iter().map(|(_, stable)| *stable).collect();
    (count.open.is_empty().then(stable), map.steps)
}

/// The parameters in units of `2^k`, and k: near the limits of the range of doubles, r is scaled to about 1,
/// exactly or as an interval.
fn in_own_units(parameters: &ParameterBox) -> (ParameterBox, i32) {
    let unit = if parameters.r.lower() > 0.0 { exponent(parameters.r.middle()) } else { 0 };
    let unit = if unit.abs() > 300 { unit } else { 0 };
    (parameters.in_units_of(unit), unit)
}

fn prove_in_units(parameters: &ParameterBox, hints: &[f64]) -> Proof {
    let theorem = theorem(parameters);
    let mut map = ProvedMap::new(parameters);
    let mut proof =
        Proof { parameters: *parameters, theorem, cycles: Vec::new(), open: Vec::new(), swings: 0 };
    let known = counted(theorem, &mut map);
    let reason = if parameters.is_point() { CLOSE } else { PARTLY };
    for (within, stable) in known.unique {
        let hint = hints.iter().copied().find(|&hint| within.contains(hint));
        let guess = hint.unwrap_or(if within.is_finite() { within.middle() } else { 1.0 });
        let enclosure = match theorem {
            Some(Theorem::Affine) => affine_cycle(parameters),
            _ => enclose(&mut map, guess, within, stable),
        };
        let enclosure = enclosure.filter(|it| it.clearance.intersection(within).is_some());
        proof.cycles.push(ProvedCycle { within, stable, enclosure });
    }
    for open in known.open {
        let reason = if open.upper() == f64::INFINITY { STIFF } else { reason };
        proof.open.push(Open { lower: open.lower(), upper: open.upper(), reason });
    }
    proof.swings = map.swings;
    proof
}

/// Counts cycles by the theorem, or by the return map.
fn counted(theorem: Option<Theorem>, map: &mut ProvedMap) -> Count {
    let one = |stable| {
        let within = Interval::new(0.0, f64::INFINITY);
        Count { unique: vec![(within, stable)], open: Vec::new() }
    };
    match theorem {
        Some(Theorem::OneWay | Theorem::Overdamped) => Count::default(),
        Some(Theorem::Affine) => one(false),
        Some(Theorem::Frictionless) => one(map.parameters.d.upper() < 0.0),
        None => searched(map),
    }
}

/// Counts cycles by the return map.
fn searched(map: &mut ProvedMap) -> Count {
    /// Halvings of the whole range before a gap is left open.
    const HALVINGS: u32 = 60;
    let mut count = Count::default();
    let all =
        |from: f64| Count { unique: Vec::new(), open: vec![Interval::new(from, f64::INFINITY)] };
    let low = match inner_end(map) {
        SearchEnd::At(clearance, sign) => (clearance, sign),
        SearchEnd::Empty => return count,
        SearchEnd::Open => return all(0.0),
    };
    let high = match outer_end(map, low.0) {
        SearchEnd::At(clearance, sign) => (clearance, sign),
        SearchEnd::Empty => return count,
        SearchEnd::Open => return all(low.0),
    };
    count.decide(map, low, high, HALVINGS);
    count
}
