//! Writes down what was proved about cycles, so that [`crate::check`] can verify it step by step.
//!
//! A proof gives the number of cycles and their approximate places. From this the steps are computed again with
//! the map of the checker: a walk from the sticking set outwards, each step up to the image of its start.

use super::{Proof, ProvedCycle, ProvedHalf, ProvedMap, Theorem, fences};
use crate::check::map::Map;
use crate::check::{Bounds, Certificate, CertificateStep, StepKind};
use crate::numerics::Interval;

/// Makes the certificate of a proof.
///
/// # Errors
/// Why there is no certificate.
pub fn certificate(proof: &Proof) -> Result<Certificate, String> {
    if !proof.is_complete() {
        return Err("the number of cycles is not proved".to_owned());
    }
    let parameters = proof.parameters.numbers();
    let steps = if let Some(theorem) = proof.theorem {
        let kind = match theorem {
            Theorem::OneWay => StepKind::OneWay,
            Theorem::Overdamped => StepKind::Overdamped,
            Theorem::Affine => StepKind::Affine,
            Theorem::Frictionless => StepKind::Frictionless,
        };
        vec![CertificateStep { kind, from: 0.0, to: None, clearance: None, fences: None }]
    } else {
        let mut walk = Walk { parameters, at: 0.0, above: false, steps: Vec::new() };
        walk.begin(proof)?;
        for cycle in &proof.cycles {
            walk.pass(cycle)?;
        }
        walk.leave()?;
        walk.steps
    };
    let bounds = |it: Interval| [it.lower(), it.upper()];
    Ok(Certificate { parameters: parameters.map(bounds), cycles: proof.cycles.len(), steps })
}

/// The file: one line for each step, every number in its shortest form that parses back exactly.
///
/// # Errors
/// If a number is infinite or NaN.
pub fn text(of: &Certificate) -> Result<String, serde_json::Error> {
    let steps: Result<Vec<_>, _> = of.steps.iter().map(serde_json::to_string).collect();
    let parameters = serde_json::to_string(&of.parameters)?;
    let (cycles, steps) = (of.cycles, steps?.join(",\n"));
    Ok(format!(
        "{{\n\"parameters\": {parameters},\n\"cycles\": {cycles},\n\"steps\": [\n{steps}\n]\n}}\n"
    ))
}

/// The walk from the sticking set outwards.
struct Walk {
    parameters: [Interval; 4],
    at: f64,
    /// Whether G is above the diagonal at `at`.
    above: bool,
    steps: Vec<CertificateStep>,
}

/// Steps after which a certificate is abandoned.
const MOST: usize = 3_000;

/// The fence velocities of the two half swings, or none.
type Fences = Option<[f64; 2]>;

impl Walk {
    /// G or its inverse, without fences and with them.
    fn maps(&self, inverse: bool) -> [(Fences, Map); 2] {
        let [d, d2, d3, _] = self.parameters.map(Interval::middle);
        let sign = if inverse { -1.0 } else { 1.0 };
        let fences = [-d2, d2].map(|b| {
            let known = fences([2.0 * d * sign, b, d3 * sign]);
            known.map_or(0.0, |(speed, _)| speed)
        });
        [None, Some(fences)]
            .map(|fences| (fences, Map::new(self.parameters, inverse, fences.unwrap_or_default())))
    }

    /// The first step: up to where motions still come to rest within a turn, or out of the neighbourhood of a
    /// repelling node.
    fn begin(&mut self, proof: &Proof) -> Result<(), String> {
        let map = ProvedMap::new(&proof.parameters);
        let before = |at: f64, it: &ProvedHalf| it.image(Interval::point(at)).lower();
        let first = map.backward.0.iter().fold(0.0, before);
        let known = first > 0.0 && first < f64::INFINITY;
        let mut to = if known { 0.95 * first } else { map.gap.upper() };
        for _ in 0..40 {
            for (fences, map) in self.maps(false) {
                if map.images(Interval::point(to)) < 0.0 {
                    self.add(StepKind::Within, Some(to), None, fences);
                    return Ok(());
                }
            }
            to *= 0.5;
        }
        self.above = true;
        let most = proof.cycles.first().map_or(f64::MAX, |cycle| 0.5 * cycle.within.lower());
        self.step(most).map_err(|_| "no start is certain to come to rest within a turn".to_owned())
    }

    /// Appends one step.
    fn add(&mut self, kind: StepKind, to: Option<f64>, within: Option<Bounds>, fences: Fences) {
        let (from, clearance) = (self.at, within);
        self.steps.push(CertificateStep { kind, from, to, clearance, fences });
        self.at = to.unwrap_or(f64::INFINITY);
    }

    fn aside(&self) -> StepKind {
        if self.above { StepKind::Above } else { StepKind::Below }
    }

    /// How far the image of the current point lets the walk go (infinitely far if it never turns), and the
    /// fences used.
    fn reach(&self) -> (f64, Fences) {
        let at = Interval::point(self.at);
        let reach = |(fences, map): (Fences, Map)| (map.images(at).lower(), fences);
        let [plain, fenced] = self.maps(!self.above);
        let (end, fences) = reach(plain);
        if end > self.at { (end, fences) } else { reach(fenced) }
    }

    /// One step, at most up to `most`.
    fn step(&mut self, most: f64) -> Result<(), String> {
        /// A fraction of what the image allows, so that rounding cannot matter.
        const PART: f64 = 0.95;
        let (from, (reach, fences)) = (self.at, self.reach());
        let to = if reach < f64::INFINITY {
            most.min(from + PART * (reach - from))
        } else {
            most
        };
        if !(to > from && to < f64::INFINITY && self.steps.len() < MOST) {
            return Err(format!("a turn from the clearance {from:?} is not certain"));
        }
        self.add(self.aside(), Some(to), None, fences);
        Ok(())
    }

    /// Walks up to a cycle and past it.
    fn pass(&mut self, cycle: &ProvedCycle) -> Result<(), String> {
        /// Relative amounts by which the step extends beyond the cycle's bounds, widest first, and by which the
        /// bounds of the clearance are widened, narrowest first.
        const WIDTHS: [f64; 11] = [0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10];
        const WIDER: [f64; 11] =
            [1e-13, 1e-12, 1e-11, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1];
        let bounds = cycle.enclosure.map_or(cycle.within, |it| it.clearance);
        let ends = |part: f64| [bounds.lower() * (1.0 - part), bounds.upper() * (1.0 + part)];
        let mut why = "the derivative of the map at a cycle is too close to 1";
        for (fences, map) in self.maps(!cycle.stable) {
            let narrow = |&[from, to]: &Bounds| {
                let slope = map.slope(Interval::new(from, to));
                from > self.at && slope.is_some_and(|slope| slope < 1.0)
            };
            let image = |z: f64| map.images(Interval::point(z));
            if !image(bounds.middle()).is_finite() {
                continue;
            }
            let certain = |&[low, high]: &Bounds| image(low) > low && image(high) < high;
            let Some([from, to]) = WIDTHS.map(ends).into_iter().find(narrow) else { continue };
            let Some(clearance) = WIDER.map(ends).into_iter().find(certain) else {
                why = "a cycle cannot be bounded";
                continue;
            };
            while self.at < from {
                self.step(from)?;
            }
            let kind = if cycle.stable {
                StepKind::Stable
            } else {
                StepKind::Unstable
            };
            self.add(kind, Some(to), Some(clearance), fences);
            self.above = !cycle.stable;
            return Ok(());
        }
        Err(why.to_owned())
    }

    /// Covers everything beyond the last cycle.
    fn leave(&mut self) -> Result<(), String> {
        let all = Interval::new(0.0, f64::INFINITY);
        let [_, (fences, map)] = self.maps(false);
        let greatest = map.images(all).upper();
        loop {
            if !self.above && greatest < self.at {
                self.add(StepKind::Within, None, None, fences);
                return Ok(());
            }
            if let (f64::INFINITY, fences) = self.reach() {
                self.add(self.aside(), None, None, fences);
                return Ok(());
            }
            self.step(f64::MAX)?;
        }
    }
}
