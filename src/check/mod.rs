//! Certificates of limit cycles, and the program that checks them.
//!
//! A certificate says that at some parameters there are so many limit cycles and no others, at any amplitude. Its
//! steps cover all clearances `z > 0` of right turning points, from 0 to infinity, each by one statement about the
//! return map G, which increases:
//!
//! | step | statement | shown by |
//! |---|---|---|
//! | `rest` | from all z up to `to` the motion comes to rest within a turn | it does from `to` |
//! | `below` | `G(z) < z` on `[from, to]` | `G^-1(from) > to`: `G^-1(z) > z` |
//! | `above` | `G(z) > z` on `[from, to]` | `G(from) > to`: `G(z) > z` |
//! | `cycle` | one cycle in `[from, to]` | G is on different sides of the diagonal at both ends, and the one of `G, G^-1` that contracts has a derivative below 1 |
//! | `out-of-reach` | no cycle from `from` on | nothing that starts at or beyond `from` comes from a turn: the inverse never turns |
//! | `damped` | no cycle from `from` on | all images of G are below `from` |
//! | `escapes` | no cycle from `from` on | from `from` the motion never turns |
//! | `theorem` | the number of cycles | its conditions |
//!
//! Nothing here is shared with the search for cycles or with the proofs that wrote the certificate, but the arithmetic
//! of intervals ([`crate::numerics::interval`]). [`motion`] encloses half swings, [`map`] makes G of them.

pub mod map;
pub mod motion;

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::numerics::Interval;
use map::{After, Map};

/// Lower and upper bound.
pub type Bounds = [f64; 2];

/// What a file says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// The parameters, each between two bounds; it holds for all values between them.
    pub parameters: Parameters,
    /// How many limit cycles there are.
    pub cycles: usize,
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// Of all the rest: shows what was changed by accident.
    pub digest: String,
}

/// Bounds of the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "they are named as in the equation")]
pub struct Parameters {
    #[serde(rename = "D")]
    pub d: Bounds,
    #[serde(rename = "D2")]
    pub d2: Bounds,
    #[serde(rename = "D3")]
    pub d3: Bounds,
    pub r: Bounds,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "step", rename_all = "kebab-case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table above says what the fields are")]
pub enum Step {
    Rest { to: f64 },
    Below { from: f64, to: f64 },
    Above { from: f64, to: f64 },
    Cycle { from: f64, to: f64, numbers: Numbers },
    OutOfReach { from: f64 },
    Damped { from: f64 },
    Escapes { from: f64 },
    Theorem { name: Theorem },
}

/// A theorem that gives the number of cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Theorem {
    /// `r + 2 D w + D3 w^3 >= 0` for all `w >= 0`: a first integral of the motion with D2 alone only falls. None.
    OneWay,
    /// `D <= -1`, `D3 <= 0`: in one half plane nothing turns. None.
    Overdamped,
    /// `D2 = D3 = 0`, `-1 < D < 0 < r`: half swings are affine. One.
    Affine,
    /// `r = 0`, `D D3 < 0`: A. Lins, W. de Melo and C. C. Pugh, *On Lienard's equation* (1977). One.
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
    pub multiplier: Bounds,
}

/// Why a certificate is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The line of the file.
    pub line: usize,
    /// What does not hold.
    pub why: String,
}

impl fmt::Display for Refusal {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "line {}: {}", self.line, self.why)
    }
}

/// On which side of the diagonal G lies at a clearance, as the steps so far have shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Below,
    Above,
}

impl Certificate {
    /// A certificate with its digest.
    pub fn new(parameters: Parameters, cycles: usize, steps: Vec<Step>) -> Self {
        let mut made = Certificate { parameters, cycles, steps, digest: String::new() };
        made.digest = made.fingerprint();
        made
    }

    /// FNV-1a, 64 bits, of the contents in their shortest form.
    pub fn fingerprint(&self) -> String {
        let text = format!("{:?} {} {:?}", self.parameters, self.cycles, self.steps);
        let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        format!("{:016x}", text.bytes().fold(0xcbf2_9ce4_8422_2325, mix))
    }

    /// The file: a line for each step, every number in its shortest form that reads back exactly.
    ///
    /// # Errors
    /// If a number is infinite or none.
    pub fn text(&self) -> Result<String, serde_json::Error> {
        let mut out = String::from("{\n");
        out += &format!("\"parameters\": {},\n", serde_json::to_string(&self.parameters)?);
        out += &format!("\"cycles\": {},\n\"steps\": [\n", self.cycles);
        let steps: Result<Vec<_>, _> = self.steps.iter().map(serde_json::to_string).collect();
        out += &format!("{}\n],\n\"digest\": \"{}\"\n}}\n", steps?.join(",\n"), self.digest);
        Ok(out)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// The line that cannot be read.
    pub fn read(text: &str) -> Result<Self, Refusal> {
        let refused = |error: serde_json::Error| {
            let why = error.to_string();
            let why = why.split(" at line").next().unwrap_or_default().to_owned();
            Refusal { line: error.line(), why }
        };
        serde_json::from_str(text).map_err(refused)
    }
}

/// Checks a file: every step, that they leave no gap, and how many cycles they show.
///
/// # Errors
/// The first line that does not hold.
pub fn check(text: &str) -> Result<Certificate, Refusal> {
    let given = Certificate::read(text)?;
    let line = |word: &str, number: usize| {
        let mut lines = text.lines().enumerate().filter(|(_, line)| line.contains(word));
        lines.nth(number).map_or(0, |(index, _)| index + 1)
    };
    let refuse = |line: usize, why: String| Err(Refusal { line, why });
    let Parameters { d, d2, d3, r } = given.parameters;
    let ordered = |[low, high]: Bounds| low <= high && low.is_finite() && high.is_finite();
    if ![d, d2, d3, r].into_iter().all(ordered) || r[0] < 0.0 {
        return refuse(line("\"parameters\"", 0), "these are no bounds of parameters".to_owned());
    }
    let parameters = [d, d2, d3, r].map(|[low, high]| Interval::new(low, high));
    let map = Map::new(parameters);
    // How far the steps have come, and where G lies there; the end of the last one is infinite.
    let (mut at, mut side, mut cycles) = (0.0, Side::Below, 0);
    for (number, step) in given.steps.iter().enumerate() {
        let here = line("\"step\"", number);
        let came =
            verify(step, &map, parameters, (at, side), next_side(given.steps.get(number + 1)));
        let (to, next, found) = match came {
            Ok(came) => came,
            Err(why) => return refuse(here, why),
        };
        (at, side, cycles) = (to, next, cycles + found);
    }
    if at != f64::INFINITY {
        let last = line("\"step\"", given.steps.len().saturating_sub(1));
        return refuse(last, format!("nothing is said of clearances beyond {at:?}"));
    }
    if cycles != given.cycles {
        let why = format!("{} cycles are claimed, and {cycles} shown", given.cycles);
        return refuse(line("\"cycles\"", 0), why);
    }
    if given.digest != given.fingerprint() {
        return refuse(
            line("\"digest\"", 0),
            "the file was changed after it was written".to_owned(),
        );
    }
    Ok(given)
}

/// On which side of the diagonal a step shows G to lie at its lower end.
fn next_side(step: Option<&Step>) -> Option<Side> {
    match step? {
        Step::Below { .. } | Step::Damped { .. } | Step::OutOfReach { .. } => Some(Side::Below),
        Step::Above { .. } | Step::Escapes { .. } => Some(Side::Above),
        Step::Rest { .. } | Step::Cycle { .. } | Step::Theorem { .. } => None,
    }
}

/// Checks a step that begins at a clearance, with G on a side of the diagonal there; `after` is the side that the
/// next step shows. Returns where it ends, the side there, and how many cycles it shows.
fn verify(
    step: &Step,
    map: &Map,
    parameters: [Interval; 4],
    (at, side): (f64, Side),
    after: Option<Side>,
) -> Result<(f64, Side, usize), String> {
    let begins = |from: f64, to: f64| {
        if from != at {
            return Err(format!("it begins at {from:?}, and the step before ends at {at:?}"));
        }
        if from < to { Ok(()) } else { Err(format!("{from:?} is not below {to:?}")) }
    };
    let known = |holds: bool, what: &str| if holds { Ok(()) } else { Err(what.to_owned()) };
    let beyond = |after: After, to: f64| match after {
        After::At(image) => image.lower() > to,
        After::Never => true,
        After::Rest | After::Unknown => false,
    };
    match step {
        Step::Rest { to } => {
            known(at == 0.0 && *to > 0.0, "rest is the first step, from 0 to a clearance")?;
            known(map.after(false, *to) == After::Rest, "it is not certain to come to rest")?;
            Ok((*to, Side::Below, 0))
        }
        Step::Below { from, to } => {
            begins(*from, *to)?;
            known(beyond(map.after(true, *from), *to), "the inverse does not lead beyond `to`")?;
            Ok((*to, Side::Below, 0))
        }
        Step::Above { from, to } => {
            begins(*from, *to)?;
            known(beyond(map.after(false, *from), *to), "G does not lead beyond `to`")?;
            Ok((*to, Side::Above, 0))
        }
        Step::Cycle { from, to, numbers } => {
            begins(*from, *to)?;
            let after = after.ok_or("the next step does not show on which side G lies")?;
            known(side != after, "G lies on one side of the diagonal at both ends")?;
            cycle(map, (*from, *to), side == Side::Above, numbers)?;
            Ok((*to, after, 1))
        }
        Step::OutOfReach { from } => {
            begins(*from, f64::INFINITY)?;
            known(map.after(true, *from) == After::Never, "the inverse may turn")?;
            Ok((f64::INFINITY, side, 0))
        }
        Step::Damped { from } => {
            begins(*from, f64::INFINITY)?;
            known(map.greatest_image() < *from, "images of G may lie beyond `from`")?;
            Ok((f64::INFINITY, side, 0))
        }
        Step::Escapes { from } => {
            begins(*from, f64::INFINITY)?;
            known(map.after(false, *from) == After::Never, "the motion may turn")?;
            Ok((f64::INFINITY, side, 0))
        }
        Step::Theorem { name } => {
            known(at == 0.0, "a theorem is the only step")?;
            known(name.applies(parameters), "its conditions are not met")?;
            let one = matches!(name, Theorem::Affine | Theorem::Frictionless);
            Ok((f64::INFINITY, side, usize::from(one)))
        }
    }
}

/// Checks that there is one cycle in an interval, of this stability, and that its numbers lie between their bounds.
///
/// Of G, where the cycle attracts, or `G^-1`, the map K contracts: its derivative is below 1 throughout, so that it has one
/// fixed point at most, and one because it lies on different sides of the diagonal at both ends. As
/// `K(z) > z` at one place and `K(z) < z` at another, the fixed point is between them.
fn cycle(map: &Map, (from, to): (f64, f64), stable: bool, numbers: &Numbers) -> Result<(), String> {
    let Numbers { clearance: [low, high], left, period, multiplier, .. } = *numbers;
    let known = |holds: bool, what: &str| if holds { Ok(()) } else { Err(what.to_owned()) };
    known(numbers.stable == stable, "its stability follows from the neighbours, and differs")?;
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
    let one = Interval::point(1.0);
    let factor = if stable { found.slope } else { one / found.slope };
    for (name, found, [lower, upper]) in [
        ("left clearance", found.left, left),
        ("period", found.time, period),
        ("multiplier", factor, multiplier),
    ] {
        let inside = lower <= found.lower() && found.upper() <= upper;
        known(inside, &format!("the {name} is only known to lie in {found}"))?;
    }
    Ok(())
}

impl Theorem {
    /// Whether its conditions hold for all of these parameters.
    pub fn applies(self, [d, d2, d3, r]: [Interval; 4]) -> bool {
        let zero = |it: Interval| it == Interval::point(0.0);
        match self {
            Theorem::OneWay => {
                // For D < 0 < D3 the least value, at w^2 = -2 D/(3 D3), is positive where 32 D^3 + 27 r^2 D3 > 0.
                let least = Interval::point(32.0) * d * d.square()
                    + Interval::point(27.0) * r.square() * d3;
                let gains = zero(r) && d.upper() <= 0.0 && d3.upper() <= 0.0;
                let loses = d.lower() >= 0.0 && d3.lower() >= 0.0;
                gains || loses || (d3.lower() > 0.0 && d.upper() < 0.0 && least.lower() > 0.0)
            }
            Theorem::Overdamped => d.upper() <= -1.0 && d3.upper() <= 0.0,
            Theorem::Affine => {
                zero(d2) && zero(d3) && d.lower() > -1.0 && d.upper() < 0.0 && r.lower() > 0.0
            }
            Theorem::Frictionless => {
                let opposite =
                    d.upper() < 0.0 && d3.lower() > 0.0 || d.lower() > 0.0 && d3.upper() < 0.0;
                zero(r) && opposite
            }
        }
    }
}
