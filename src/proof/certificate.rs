//! What was proved about cycles, written down so that [`crate::check`] can verify it step by step.
//!
//! A proof tells how many cycles there are and about where. From this the steps are computed again, by the map of the
//! checker: it walks from the sticking set outwards, as far at a time as the image of where it stands.

use super::cycles::{Proof, ProvedCycle};
use super::map::{Direction, ReturnMap};
use super::theorems::Theorem;
use crate::check::map::{After, Map};
use crate::check::{Certificate, Kind, Numbers, Step};
use crate::numerics::Interval;

/// Makes the certificate of a proof.
///
/// # Errors
/// Why it cannot be had.
pub fn certificate(proof: &Proof) -> Result<Certificate, String> {
    if !proof.is_complete() {
        return Err("the number of cycles is not proved".to_owned());
    }
    let super::ParameterBox { d, d2, d3, r } = proof.parameters;
    let parameters = [d, d2, d3, r];
    let steps = if let Some(theorem) = proof.theorem {
        let kind = match theorem {
            Theorem::OneWay => Kind::OneWay,
            Theorem::Overdamped => Kind::Overdamped,
            Theorem::Affine => Kind::Affine,
            Theorem::Frictionless => Kind::Frictionless,
        };
        vec![Step { kind, from: 0.0, to: None, numbers: None }]
    } else {
        let map = Map::new(parameters);
        let mut walk = Walk { map, at: 0.0, above: false, steps: Vec::new() };
        walk.begin(proof)?;
        for cycle in &proof.cycles {
            walk.pass(cycle)?;
        }
        walk.leave()?;
        walk.steps
    };
    Ok(Certificate::new(parameters.map(bounds), proof.cycles.len(), steps))
}

/// The file: a line for each step, every number in its shortest form that reads back exactly.
///
/// # Errors
/// If a number is infinite or none.
pub fn text(of: &Certificate) -> Result<String, serde_json::Error> {
    let steps: Result<Vec<_>, _> = of.steps.iter().map(serde_json::to_string).collect();
    let mut out = format!("{{\n\"parameters\": {},\n", serde_json::to_string(&of.parameters)?);
    out += &format!("\"cycles\": {},\n\"steps\": [\n", of.cycles);
    out += &format!("{}\n],\n\"digest\": \"{}\"\n}}\n", steps?.join(",\n"), of.digest);
    Ok(out)
}

fn bounds(it: Interval) -> [f64; 2] {
    [it.lower(), it.upper()]
}

/// On the way outwards.
struct Walk {
    map: Map,
    at: f64,
    /// Whether G lies above the diagonal here.
    above: bool,
    steps: Vec<Step>,
}

/// Steps after which a certificate is given up.
const MOST: usize = 3_000;

impl Walk {
    /// From where motions come to rest within a turn, or from next to a node that repels.
    fn begin(&mut self, proof: &Proof) -> Result<(), String> {
        let mut map = ReturnMap::new(&proof.parameters);
        let second = map.half(1, Direction::Backward, Interval::point(0.0)).lower();
        let first = map.half(0, Direction::Backward, Interval::point(second)).lower();
        let mut to = if first < f64::INFINITY { 0.95 * first } else { map.gap.upper() };
        for _ in 0..20 {
            if to > 0.0 && self.map.after(false, to) == After::Rest {
                self.take(Kind::Rest, Some(to));
                return Ok(());
            }
            to *= 0.5;
        }
        self.above = true;
        let most = proof.cycles.first().and_then(|cycle| cycle.enclosure);
        self.step(most.map_or(f64::MAX, |it| 0.5 * it.clearance.lower()))
            .map_err(|_| "no start is certain to come to rest within a turn".to_owned())
    }

    /// Goes a step.
    fn take(&mut self, kind: Kind, to: Option<f64>) {
        self.steps.push(Step { kind, from: self.at, to, numbers: None });
        self.at = to.unwrap_or(f64::INFINITY);
    }

    /// How far the image of the place allows to go.
    fn reach(&self) -> After {
        self.map.after(!self.above, self.at)
    }

    /// One step, to a place at most.
    fn step(&mut self, most: f64) -> Result<(), String> {
        /// A part of what the image allows, so that it is not a matter of rounding.
        const PART: f64 = 0.95;
        let lost = || format!("a turn from the clearance {:?} is not certain", self.at);
        let from = self.at;
        let to = match self.reach() {
            After::At(image) => most.min(from + PART * (image.lower() - from)),
            After::Never => most,
            After::Rest | After::Unknown => return Err(lost()),
        };
        if !(to > from && to < f64::INFINITY && self.steps.len() < MOST) {
            return Err(lost());
        }
        self.take(if self.above { Kind::Above } else { Kind::Below }, Some(to));
        Ok(())
    }

    /// To a cycle and past it.
    fn pass(&mut self, cycle: &ProvedCycle) -> Result<(), String> {
        /// Widths of the step, as parts of the clearance, widest first.
        const WIDTHS: [f64; 9] = [0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6];
        let bounds = cycle.enclosure.ok_or("a cycle has no bounds")?.clearance;
        let ends = |part: f64| (bounds.lower() * (1.0 - part), bounds.upper() * (1.0 + part));
        let narrow = |&(from, to): &(f64, f64)| {
            let turn = self.map.turn(!cycle.stable, Interval::new(from, to));
            from > self.at && turn.is_some_and(|turn| turn.slope.upper() < 1.0)
        };
        let (from, to) = WIDTHS
            .map(ends)
            .into_iter()
            .find(narrow)
            .ok_or("the derivative of the map at a cycle is too close to 1")?;
        while self.at < from {
            self.step(from)?;
        }
        let numbers = self.numbers(cycle.stable, ends)?;
        self.steps.push(Step { kind: Kind::Cycle, from, to: Some(to), numbers: Some(numbers) });
        (self.at, self.above) = (to, !self.above);
        Ok(())
    }

    /// The numbers of a cycle by the map of the checker.
    fn numbers(&self, stable: bool, ends: impl Fn(f64) -> (f64, f64)) -> Result<Numbers, String> {
        /// How much wider than the proof's the bounds of the clearance are, narrowest first.
        const WIDER: [f64; 9] = [1e-13, 1e-12, 1e-11, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2];
        let image = |z: f64| match self.map.after(!stable, z) {
            After::At(image) => image,
            After::Rest | After::Never | After::Unknown => Interval::ALL,
        };
        let certain =
            |&(low, high): &(f64, f64)| image(low).lower() > low && image(high).upper() < high;
        let (low, high) =
            WIDER.map(ends).into_iter().find(certain).ok_or("a cycle cannot be bounded")?;
        let turn = self.map.turn(!stable, Interval::new(low, high));
        let turn = turn.ok_or("a turn of a cycle is not certain")?;
        Ok(Numbers {
            stable,
            clearance: [low, high],
            left: bounds(turn.left),
            period: bounds(turn.time),
            contraction: bounds(turn.slope),
        })
    }

    /// Beyond all cycles.
    fn leave(&mut self) -> Result<(), String> {
        let greatest = self.map.greatest_image();
        loop {
            let from = self.at;
            if !self.above && greatest < from {
                self.take(Kind::Damped, None);
                return Ok(());
            }
            if self.reach() == After::Never {
                self.take(if self.above { Kind::Above } else { Kind::Below }, None);
                return Ok(());
            }
            self.step(f64::MAX)?;
        }
    }
}
