//! What was proved about cycles, written down so that [`crate::check`] can verify it step by step.
//!
//! A proof tells how many cycles there are and about where. From this the steps are computed again, by the map of the
//! checker: it walks from the sticking set outwards, as far at a time as the image of where it stands.

use super::cycles::{Proof, ProvedCycle};
use super::map::{Direction, ReturnMap};
use super::theorems::Theorem;
use crate::check::map::{After, Map};
use crate::check::{self, Certificate, Numbers, Parameters, Step};
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
    let parameters = Parameters { d: bounds(d), d2: bounds(d2), d3: bounds(d3), r: bounds(r) };
    if let Some(theorem) = proof.theorem {
        let name = match theorem {
            Theorem::OneWay => check::Theorem::OneWay,
            Theorem::Overdamped => check::Theorem::Overdamped,
            Theorem::Affine => check::Theorem::Affine,
            Theorem::Frictionless => check::Theorem::Frictionless,
        };
        let steps = vec![Step::Theorem { name }];
        return Ok(Certificate::new(parameters, proof.cycles.len(), steps));
    }
    let mut walk = Walk { map: Map::new([d, d2, d3, r]), at: 0.0, above: false, steps: Vec::new() };
    walk.rest(proof)?;
    for cycle in &proof.cycles {
        walk.pass(cycle)?;
    }
    walk.leave()?;
    Ok(Certificate::new(parameters, proof.cycles.len(), walk.steps))
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
    /// From where motions come to rest within a turn.
    fn rest(&mut self, proof: &Proof) -> Result<(), String> {
        let mut map = ReturnMap::new(&proof.parameters);
        let second = map.half(1, Direction::Backward, Interval::point(0.0)).lower();
        let first = map.half(0, Direction::Backward, Interval::point(second)).lower();
        let mut to = if first < f64::INFINITY { 0.95 * first } else { map.gap.upper() };
        for _ in 0..20 {
            if to > 0.0 && self.map.after(false, to) == After::Rest {
                self.steps.push(Step::Rest { to });
                self.at = to;
                return Ok(());
            }
            to *= 0.5;
        }
        Err("no start is certain to come to rest within a turn".to_owned())
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
        let step = if self.above { Step::Above { from, to } } else { Step::Below { from, to } };
        self.steps.push(step);
        self.at = to;
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
        self.steps.push(Step::Cycle { from, to, numbers });
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
        let multiplier = if stable { turn.slope } else { Interval::point(1.0) / turn.slope };
        Ok(Numbers {
            stable,
            clearance: [low, high],
            left: bounds(turn.left),
            period: bounds(turn.time),
            multiplier: bounds(multiplier),
        })
    }

    /// Beyond all cycles.
    fn leave(&mut self) -> Result<(), String> {
        let greatest = self.map.greatest_image();
        loop {
            let from = self.at;
            if !self.above && greatest < from {
                self.steps.push(Step::Damped { from });
                return Ok(());
            }
            if self.reach() == After::Never {
                // What follows a cycle has to show on which side G lies, and does.
                let last =
                    if self.above { Step::Escapes { from } } else { Step::OutOfReach { from } };
                self.steps.push(last);
                return Ok(());
            }
            self.step(f64::MAX)?;
        }
    }
}
