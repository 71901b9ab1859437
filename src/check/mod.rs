//! Certificates of limit cycles, and the program that checks them.
//!
//! A certificate states that, for given parameters, there are exactly so many limit cycles, at any amplitude.
//! Its steps cover all clearances `z > 0` of right turning points, from 0 to infinity. Each step makes one
//! statement about the return map G, which is increasing, for z between `from` and `to`; if `to` is omitted it
//! is infinite.
//!
//! | step | statement | shown by |
//! |---|---|---|
//! | `within` | no cycle: images lie below `from` | `G(to) < from`, or the motion comes to rest within a turn |
//! | `below` | no cycle: `G(z) < z` | `G^-1(from) > to`, or the inverse never turns |
//! | `above` | no cycle: `G(z) > z` | `G(from) > to`, or the motion never turns |
//! | `stable` | one cycle | G contracts, and takes the bounds of the clearance inwards |
//! | `unstable` | one cycle | so does `G^-1` |
//! | theorems | the number of cycles | their conditions |
//!
//! This module shares only interval arithmetic ([`crate::numerics::interval`]) with the search for cycles and
//! with the proofs that produced the certificate. [`motion`] encloses half swings, [`map`] combines them into G.

pub mod map;
pub mod motion;

use serde::{Deserialize, Serialize};

use crate::numerics::Interval;
use map::Map;

/// Lower and upper bound.
pub type Bounds = [f64; 2];

/// The content of a certificate file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Bounds of D, D2, D3 and r; the certificate holds for all values between them.
    pub parameters: [Bounds; 4],
    /// Number of limit cycles.
    pub cycles: usize,
    /// The steps, in order.
    pub steps: Vec<CertificateStep>,
}

/// One step of a certificate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertificateStep {
    #[serde(rename = "step")]
    pub kind: StepKind,
    pub from: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
    /// For a cycle: bounds of its clearance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance: Option<Bounds>,
    /// Where half swings are stiff: the velocity of the fence of each, 0 for none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fences: Option<[f64; 2]>,
}

/// The statement of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StepKind {
    Within,
    Below,
    Above,
    Stable,
    Unstable,
    /// No cycle, by the theorem: `r + 2 D w + D3 w^3` has one sign for all `w >= 0`, so that a first integral
    /// of the motion with D2 alone only decreases, or only increases.
    OneWay,
    /// No cycle, by the theorem: `D <= -1`, `D3 <= 0`; in one half plane no motion turns.
    Overdamped,
    /// One cycle, by the theorem: `D2 = D3 = 0`, `-1 < D < 0 < r`; half swings are affine.
    Affine,
    /// One cycle, by the theorem of A. Lins, W. de Melo and C. C. Pugh, *On Lienard's equation* (1977):
    /// `r = 0`, `D D3 < 0`.
    Frictionless,
}

/// An error with the text `what` unless the condition holds.
fn known(holds: bool, what: &str) -> Result<(), String> {
    if holds { Ok(()) } else { Err(what.to_owned()) }
}

/// Checks a file: that every step holds, that the steps leave no gap, and how many cycles they show.
///
/// # Errors
/// The first statement that does not hold, after its line number.
pub fn check(text: &str) -> Result<Certificate, String> {
    let given: Certificate = serde_json::from_str(text).map_err(|error| {
        let why = error.to_string();
        format!("line {}: {}", error.line(), why.split(" at line").next().unwrap_or_default())
    })?;
    let at_line = |word: &str, number: usize, why: String| {
        // Several steps may share a line.
        let lines = (1..).zip(text.lines()).filter(|(_, line)| line.contains(word));
        let last = lines.take(number + 1).last();
        format!("line {}: {why}", last.map_or(1, |(line, _)| line))
    };
    let ordered = |[low, high]: Bounds| low <= high && low.is_finite() && high.is_finite();
    let sensible = given.parameters.into_iter().all(ordered) && given.parameters[3][0] >= 0.0;
    known(sensible, "these are not bounds of parameters")
        .map_err(|why| at_line("\"parameters\"", 0, why))?;
    let parameters = given.parameters.map(|[low, high]| Interval::new(low, high));
    // The clearance up to which the steps have come, and the cycles shown so far.
    let (mut at, mut cycles) = (0.0, 0);
    for (number, step) in given.steps.iter().enumerate() {
        let shown = step.verify(parameters, at);
        cycles += shown.map_err(|why| at_line("\"step\"", number, why))?;
        at = step.to.unwrap_or(f64::INFINITY);
    }
    known(at == f64::INFINITY, &format!("nothing is said of clearances beyond {at:?}"))
        .map_err(|why| at_line("\"step\"", given.steps.len().saturating_sub(1), why))?;
    let differ = format!("{} cycles are claimed, {cycles} shown", given.cycles);
    known(cycles == given.cycles, &differ).map_err(|why| at_line("\"cycles\"", 0, why))?;
    Ok(given)
}

impl StepKind {
    /// The number of cycles by a theorem; `None` if this step is not a theorem, or its conditions do not hold
    /// for all of these parameters.
    pub fn theorem(self, [d, d2, d3, r]: [Interval; 4]) -> Option<usize> {
        let (holds, cycles) = match self {
            StepKind::OneWay => {
                // For D < 0 < D3 the minimum, at `w^2 = -2 D/(3 D3)`, is positive where `32 D^3 + 27 r^2 D3 > 0`.
                let least = d * 32.0 * d.square() + r.square() * 27.0 * d3;
                let gains = r == 0.0 && d.upper() <= 0.0 && d3.upper() <= 0.0;
                let loses = d.lower() >= 0.0 && d3.lower() >= 0.0;
                (gains || loses || (d3 > 0.0 && d < 0.0 && least > 0.0), 0)
            }
            StepKind::Overdamped => (d.upper() <= -1.0 && d3.upper() <= 0.0, 0),
            StepKind::Affine => (d2 == 0.0 && d3 == 0.0 && d > -1.0 && d < 0.0 && r > 0.0, 1),
            StepKind::Frictionless => {
                let opposite = d < 0.0 && d3 > 0.0 || d > 0.0 && d3 < 0.0;
                (r == 0.0 && opposite, 1)
            }
            _ => (false, 0),
        };
        holds.then_some(cycles)
    }
}

impl CertificateStep {
    /// Checks a step that begins at the clearance `at`. Returns the number of cycles it shows.
    fn verify(&self, parameters: [Interval; 4], at: f64) -> Result<usize, String> {
        let (from, to) = (self.from, self.to.unwrap_or(f64::INFINITY));
        let gap = format!("it begins at {from:?}, and the step before ends at {at:?}");
        known(from == at, &gap)?;
        known(from < to, "it does not end beyond its beginning")?;
        let is_cycle = matches!(self.kind, StepKind::Stable | StepKind::Unstable);
        known(is_cycle || self.clearance.is_none(), "only a cycle has a clearance")?;
        let inverse = matches!(self.kind, StepKind::Below | StepKind::Unstable);
        let map = Map::new(parameters, inverse, self.fences.unwrap_or_default());
        match self.kind {
            StepKind::Within => {
                // An infinite interval is bounded by the images of all clearances.
                let of = Interval::new(if to < f64::INFINITY { to } else { 0.0 }, to);
                known(map.images(of) < from, "images of G may lie beyond `from`")?;
            }
            StepKind::Below | StepKind::Above => {
                let least = map.images(Interval::point(from)).lower();
                let beyond = least > to || least == f64::INFINITY;
                known(beyond, "the image of `from` may not lie beyond `to`")?;
            }
            StepKind::Stable | StepKind::Unstable => self.verify_cycle(&map, [from, to])?,
            _ => {
                known(from == 0.0 && to == f64::INFINITY, "a theorem is the only step")?;
                known(self.fences.is_none(), "a theorem needs no fences")?;
                let cycles = self.kind.theorem(parameters);
                return cycles.ok_or_else(|| "its conditions are not met".to_owned());
            }
        }
        Ok(usize::from(is_cycle))
    }

    /// Checks that there is exactly one cycle, and that its clearance lies between its bounds.
    ///
    /// The map K, which is G where the cycle attracts and its inverse otherwise, has a derivative below 1
    /// throughout, so it has at most one fixed point. Since `K(z) > z` at one bound and `K(z) < z` at the
    /// other, there is one between them.
    fn verify_cycle(&self, map: &Map, [from, to]: Bounds) -> Result<(), String> {
        let slope = map.slope(Interval::new(from, to)).ok_or("a turn is not certain")?;
        known(slope < 1.0, "the map that should contract may not")?;
        let [low, high] = self.clearance.ok_or("a cycle has a clearance")?;
        let inside = from <= low && low <= high && high <= to;
        known(inside, "the clearance is not within the step")?;
        let [above, below] = [low, high].map(|z| map.images(Interval::point(z)));
        known(above > low, "the clearance may be below its bounds")?;
        known(below < high, "the clearance may be above its bounds")
    }
}

#[cfg(test)]
mod tests {
    //! Statements that a closed form proves true are accepted; false ones next to them are refused.

    use super::*;
    use crate::numerics::interval::PI;

    fn point(value: f64) -> Interval {
        Interval::point(value)
    }

    /// Whether a cycle step is accepted.
    fn shown(
        kind: StepKind,
        parameters: [f64; 4],
        [from, to]: Bounds,
        clearance: Bounds,
    ) -> Result<usize, String> {
        let step =
            CertificateStep { kind, from, to: Some(to), clearance: Some(clearance), fences: None };
        step.verify(parameters.map(point), from)
    }

    /// Without D2 and D3 both half swings multiply by `m = exp(-pi D/sqrt(1 - D^2))`, so that `G' = m^2`.
    fn stretch(d: f64) -> Interval {
        (-(PI * d) / ((point(1.0) + d) * (point(1.0) - d)).sqrt()).exp()
    }

    #[test]
    fn the_derivative_of_linear_swings_is_held() {
        for (d, r) in [(-0.2, 0.1), (-0.05, 0.0), (0.1, 0.02), (0.3, 0.1)] {
            let square = stretch(d).square();
            let linear = [d, 0.0, 0.0, r].map(point);
            for (inverse, exact) in [(false, square), (true, point(1.0) / square)] {
                for z in [0.7, 3.0] {
                    let slope = Map::new(linear, inverse, [0.0; 2]).slope(point(z));
                    let Some(slope) = slope.filter(|it| it.lower() > 0.0) else {
                        // In forward time these have come to rest.
                        assert!(!inverse && d > 0.0 && r > 0.0, "{d} {r} {z}");
                        continue;
                    };
                    assert!(slope.intersection(exact).is_some(), "{d} {r} {z}: {slope} {exact}");
                    assert!(slope.width() < 1e-11, "{d} {r} {z}: {slope}");
                }
            }
        }
    }

    /// The cycle of linear swings has the clearance `2 r/(m - 1)`.
    #[test]
    fn bounds_of_a_clearance_that_miss_it_are_refused() {
        let (d, r) = (-0.2, 0.1);
        let exact = (point(2.0 * r) / (stretch(d) - 1.0)).middle();
        let linear = [d, 0.0, 0.0, r];
        let within = [0.9999 * exact, 1.0001 * exact];
        let shown = |low: f64, high: f64| {
            shown(StepKind::Unstable, linear, within, [exact * (1.0 + low), exact * (1.0 + high)])
        };
        let off = 1e-12;
        assert_eq!(shown(-off, off), Ok(1));
        assert_eq!(shown(off, 2.0 * off).unwrap_err(), "the clearance may be below its bounds");
        assert_eq!(shown(-2.0 * off, -off).unwrap_err(), "the clearance may be above its bounds");
    }

    /// Next to a fold two cycles are close: the derivative of G is 1.0022 at one and 0.9978 at the other. A step
    /// that contains both and claims one is wrong by that little.
    #[test]
    fn a_step_that_holds_two_cycles_is_refused() {
        let near_fold = [-0.172_784_28, 0.2, 0.5, 0.1];
        let [repelling, attracting] = [0.415_062_415_659, 0.416_021_602_729];
        let around = [attracting - 1e-9, attracting + 1e-9];
        let shown =
            |from: f64| shown(StepKind::Stable, near_fold, [from, attracting + 1e-6], around);
        assert_eq!(shown(attracting - 1e-6), Ok(1));
        assert_eq!(shown(repelling - 1e-6).unwrap_err(), "the map that should contract may not");
    }

    /// `r + 2 D w + D3 w^3` for `D = -3/8`, `D3 = 1/4` has its minimum at `w = 1`: `r - 1/2`.
    #[test]
    fn the_first_integral_falls_where_its_rate_has_one_sign() {
        for (off, holds) in [(1e-12, Some(0)), (-1e-12, None)] {
            let parameters = [-0.375, 0.2, 0.25, 0.5 * (1.0 + off)];
            assert_eq!(StepKind::OneWay.theorem(parameters.map(point)), holds, "{off}");
        }
    }

    /// Each set meets all conditions of its theorem, or all but one.
    #[test]
    fn a_theorem_needs_each_of_its_conditions() {
        use StepKind::{Affine, Frictionless, OneWay, Overdamped};
        for (kind, parameters, shown) in [
            (Overdamped, [-1.0, 0.3, 0.0, 0.1], Some(0)),
            (Overdamped, [-0.999, 0.3, 0.0, 0.1], None),
            (Overdamped, [-1.0, 0.3, 1e-9, 0.1], None),
            (Affine, [-0.2, 0.0, 0.0, 0.1], Some(1)),
            (Affine, [-0.2, 1e-9, 0.0, 0.1], None),
            (Affine, [-0.2, 0.0, 1e-9, 0.1], None),
            (Affine, [-1.0, 0.0, 0.0, 0.1], None),
            (Affine, [0.0, 0.0, 0.0, 0.1], None),
            (Affine, [-0.2, 0.0, 0.0, 0.0], None),
            (Frictionless, [-0.2, 0.3, 0.5, 0.0], Some(1)),
            (Frictionless, [0.2, 0.3, -0.5, 0.0], Some(1)),
            (Frictionless, [-0.2, 0.3, 0.5, 1e-9], None),
            (Frictionless, [-0.2, 0.3, -0.5, 0.0], None),
            (OneWay, [-0.2, 0.3, -0.5, 0.0], Some(0)),
            (OneWay, [-0.2, 0.3, -0.5, 1e-9], None),
            (OneWay, [0.2, 0.3, 0.0, 0.1], Some(0)),
            (OneWay, [0.2, 0.3, -1e-9, 0.1], None),
            (OneWay, [-0.2, 0.3, 0.0, 0.1], None),
        ] {
            assert_eq!(kind.theorem(parameters.map(point)), shown, "{kind:?} {parameters:?}");
        }
    }

    /// Bounds in the wrong order contain nothing, of which any statement would be true; and friction is never negative.
    #[test]
    fn bounds_that_hold_no_parameters_are_refused() {
        let with = |d: &str, r: &str| {
            let steps = r#"[{"step": "one-way", "from": 0.0}]"#;
            check(&format!(
                r#"{{"parameters": [{d}, [0, 0], [0, 0], {r}], "cycles": 0, "steps": {steps}}}"#
            ))
        };
        assert!(with("[0.1, 0.2]", "[0.1, 0.1]").is_ok());
        for (d, r) in [("[0.2, 0.1]", "[0.1, 0.1]"), ("[0.1, 0.2]", "[-0.1, 0.1]")] {
            assert_eq!(with(d, r).unwrap_err(), "line 1: these are not bounds of parameters");
        }
        assert!(with("[0.1, 1e999]", "[0.1, 0.1]").is_err());
    }
}
