//! Certificates of limit cycles, and the program that checks them.
//!
//! A certificate says that at some parameters there are so many limit cycles and no others, at any amplitude. Its
//! steps cover all clearances `z > 0` of right turning points, from 0 to infinity, each by one statement about the
//! return map G, which increases, for z between `from` and `to`; where `to` is left out it is infinite.
//!
//! | step | statement | shown by |
//! |---|---|---|
//! | `rest` | from all z the motion comes to rest within a turn | it does from `to` |
//! | `below` | `G(z) < z` | `G^-1(from) > to`, or the inverse never turns: `G^-1(z) > z` |
//! | `above` | `G(z) > z` | `G(from) > to`, or the motion never turns: `G(z) > z` |
//! | `cycle` | there is one cycle | G is on different sides of the diagonal at both ends, and the one of `G, G^-1` that contracts has a derivative below 1 |
//! | `damped` | `G(z) < z` | all images of G are below `from` |
//! | theorems | the number of cycles | their conditions |
//!
//! Nothing here is shared with the search for cycles or with the proofs that wrote the certificate, but the arithmetic
//! of intervals ([`crate::numerics::interval`]). [`motion`] encloses half swings, [`map`] makes G of them.

pub mod map;
pub mod motion;

use serde::{Deserialize, Serialize};

use crate::numerics::Interval;
use map::{After, Map};

/// Lower and upper bound.
pub type Bounds = [f64; 2];

/// What a file says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Bounds of D, D2, D3 and r; it holds for all values between them.
    pub parameters: [Bounds; 4],
    /// How many limit cycles there are.
    pub cycles: usize,
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// Of all the rest: shows what was changed by accident.
    pub digest: String,
}

/// A step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    #[serde(rename = "step")]
    pub kind: Kind,
    pub from: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
    /// Of a cycle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub numbers: Option<Numbers>,
}

/// What a step shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    Rest,
    Below,
    Above,
    Cycle,
    Damped,
    /// None, by the theorem: `r + 2 D w + D3 w^3` has one sign for all `w >= 0`, so that a first integral of the motion
    /// with D2 alone only falls, or only rises.
    OneWay,
    /// None, by the theorem: `D <= -1`, `D3 <= 0`; in one half plane nothing turns.
    Overdamped,
    /// One, by the theorem: `D2 = D3 = 0`, `-1 < D < 0 < r`; half swings are affine.
    Affine,
    /// One, by the theorem of A. Lins, W. de Melo and C. C. Pugh, *On Lienard's equation* (1977): `r = 0`, `D D3 < 0`.
    Frictionless,
}

/// Bounds of the numbers of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Numbers {
    /// Whether it attracts.
    pub stable: bool,
    /// Clearance of its right turning point.
    pub clearance: Bounds,
    /// Clearance of its left turning point.
    pub left: Bounds,
    pub period: Bounds,
    /// Derivative there of the one of G, `G^-1` that contracts: the multiplier if it attracts, else its inverse.
    pub contraction: Bounds,
}

impl Certificate {
    /// A certificate with its digest: FNV-1a, 64 bits, of the contents in their shortest form.
    pub fn new(parameters: [Bounds; 4], cycles: usize, steps: Vec<Step>) -> Self {
        let text = format!("{parameters:?} {cycles} {steps:?}");
        let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let digest = format!("{:016x}", text.bytes().fold(0xcbf2_9ce4_8422_2325, mix));
        Certificate { parameters, cycles, steps, digest }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// What cannot be read, after the number of its line.
    pub fn read(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|error| {
            let why = error.to_string();
            let why = why.split(" at line").next().unwrap_or_default();
            format!("line {}: {why}", error.line())
        })
    }
}

/// `Err` of what does not hold.
fn known(holds: bool, what: &str) -> Result<(), String> {
    if holds { Ok(()) } else { Err(what.to_owned()) }
}

/// Checks a file: every step, that they leave no gap, and how many cycles they show.
///
/// # Errors
/// The first thing that does not hold, after the number of its line.
pub fn check(text: &str) -> Result<Certificate, String> {
    let given = Certificate::read(text)?;
    let at_line = |word: &str, number: usize, why: String| {
        let mut lines = text.lines().enumerate().filter(|(_, line)| line.contains(word));
        format!("line {}: {why}", lines.nth(number).map_or(0, |(index, _)| index + 1))
    };
    let ordered = |[low, high]: Bounds| low <= high && low.is_finite() && high.is_finite();
    known(
        given.parameters.into_iter().all(ordered) && given.parameters[3][0] >= 0.0,
        "these are no bounds of parameters",
    )
    .map_err(|why| at_line("\"parameters\"", 0, why))?;
    let parameters = given.parameters.map(|[low, high]| Interval::new(low, high));
    let map = Map::new(parameters);
    // How far the steps have come, and whether G lies above the diagonal there; the end of the last one is infinite.
    let (mut at, mut above, mut cycles) = (0.0, false, 0);
    for (number, step) in given.steps.iter().enumerate() {
        let after = given.steps.get(number + 1).and_then(|step| step.kind.above());
        let shown = step.verify(&map, parameters, (at, above), after);
        cycles += shown.map_err(|why| at_line("\"step\"", number, why))?;
        above = step.kind.above().or(after).unwrap_or(above);
        at = step.to.unwrap_or(f64::INFINITY);
    }
    known(at == f64::INFINITY, &format!("nothing is said of clearances beyond {at:?}"))
        .map_err(|why| at_line("\"step\"", given.steps.len().saturating_sub(1), why))?;
    known(
        cycles == given.cycles,
        &format!("{} cycles are claimed, and {cycles} shown", given.cycles),
    )
    .map_err(|why| at_line("\"cycles\"", 0, why))?;
    let whole = Certificate::new(given.parameters, given.cycles, given.steps.clone());
    known(given == whole, "the file was changed after it was written")
        .map_err(|why| at_line("\"digest\"", 0, why))?;
    Ok(given)
}

impl Kind {
    /// Whether a step shows G to lie above the diagonal, at both of its ends, or below.
    fn above(self) -> Option<bool> {
        let one_side = matches!(self, Kind::Rest | Kind::Below | Kind::Damped | Kind::Above);
        one_side.then_some(self == Kind::Above)
    }

    /// How many cycles there are by a theorem; `None` if this is none, or its conditions are not met by all of these
    /// parameters.
    pub fn theorem(self, [d, d2, d3, r]: [Interval; 4]) -> Option<usize> {
        let zero = |it: Interval| it == Interval::point(0.0);
        let (negative, positive) =
            (|it: Interval| it.upper() < 0.0, |it: Interval| it.lower() > 0.0);
        let (holds, cycles) = match self {
            Kind::OneWay => {
                // For D < 0 < D3 the least value, at w^2 = -2 D/(3 D3), is positive where 32 D^3 + 27 r^2 D3 > 0.
                let least = Interval::point(32.0) * d * d.square()
                    + Interval::point(27.0) * r.square() * d3;
                let gains = zero(r) && d.upper() <= 0.0 && d3.upper() <= 0.0;
                let loses = d.lower() >= 0.0 && d3.lower() >= 0.0;
                (gains || loses || (positive(d3) && negative(d) && positive(least)), 0)
            }
            Kind::Overdamped => (d.upper() <= -1.0 && d3.upper() <= 0.0, 0),
            Kind::Affine => {
                (zero(d2) && zero(d3) && d.lower() > -1.0 && negative(d) && positive(r), 1)
            }
            Kind::Frictionless => {
                let opposite = negative(d) && positive(d3) || positive(d) && negative(d3);
                (zero(r) && opposite, 1)
            }
            _ => (false, 0),
        };
        holds.then_some(cycles)
    }
}

impl Step {
    /// Checks a step that begins at a clearance, with G on a side of the diagonal there; `after` is that which the next
    /// step shows. Returns how many cycles it shows.
    fn verify(
        &self,
        map: &Map,
        parameters: [Interval; 4],
        (at, above): (f64, bool),
        after: Option<bool>,
    ) -> Result<usize, String> {
        let (from, to) = (self.from, self.to.unwrap_or(f64::INFINITY));
        let gap = format!("it begins at {from:?}, and the step before ends at {at:?}");
        known(from == at, &gap)?;
        known(from < to, "it does not end beyond its beginning")?;
        let beyond = |inverse: bool| match map.after(inverse, from) {
            After::At(image) => image.lower() > to,
            After::Never => true,
            After::Rest | After::Unknown => false,
        };
        match self.kind {
            Kind::Rest => known(
                from == 0.0 && map.after(false, to) == After::Rest,
                "from `to` it is not certain to come to rest",
            ),
            Kind::Below => known(beyond(true), "the inverse does not lead beyond `to`"),
            Kind::Above => known(beyond(false), "G does not lead beyond `to`"),
            Kind::Damped => known(map.greatest_image() < from, "images of G may lie beyond `from`"),
            Kind::Cycle => {
                let after = after.ok_or("the next step does not show on which side G lies")?;
                known(above != after, "G lies on one side of the diagonal at both ends")?;
                let numbers = self.numbers.as_ref().ok_or("a cycle has numbers")?;
                numbers.verify(map, (from, to), above)?;
                return Ok(1);
            }
            theorem => {
                known(from == 0.0 && to == f64::INFINITY, "a theorem is the only step")?;
                let cycles = theorem.theorem(parameters);
                return cycles.ok_or_else(|| "its conditions are not met".to_owned());
            }
        }?;
        known(self.numbers.is_none(), "only a cycle has numbers")?;
        Ok(0)
    }
}

impl Numbers {
    /// Checks that there is one cycle in an interval, of this stability, and that its numbers lie between their bounds.
    ///
    /// Of G, where the cycle attracts, or `G^-1`, the map K contracts: its derivative is below 1 throughout, so that it has
    /// one fixed point at most, and one because it lies on different sides of the diagonal at both ends. As
    /// `K(z) > z` at one place and `K(z) < z` at another, the fixed point is between them.
    fn verify(&self, map: &Map, (from, to): (f64, f64), stable: bool) -> Result<(), String> {
        let Numbers { clearance: [low, high], left, period, contraction, .. } = *self;
        known(self.stable == stable, "its stability follows from the neighbours, and differs")?;
        let turn = |over| map.turn(!stable, over).ok_or("a turn is not certain");
        let slope = turn(Interval::new(from, to))?.slope;
        known(slope.upper() < 1.0, "the map that should contract may not")?;
        known(from <= low && low <= high && high <= to, "the clearance is not within the step")?;
        let image = |z: f64| match map.after(!stable, z) {
            After::At(image) => image,
            After::Rest | After::Never | After::Unknown => Interval::ALL,
        };
        known(image(low).lower() > low, "the clearance may be below its bounds")?;
        known(image(high).upper() < high, "the clearance may be above its bounds")?;
        let found = turn(Interval::new(low, high))?;
        for (name, found, [lower, upper]) in [
            ("left clearance", found.left, left),
            ("period", found.time, period),
            ("contraction", found.slope, contraction),
        ] {
            let inside = lower <= found.lower() && found.upper() <= upper;
            known(inside, &format!("the {name} is only known to lie in {found}"))?;
        }
        Ok(())
    }
}
