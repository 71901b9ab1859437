//! The cycles of a machine over the speed of its belt.

use std::sync::Arc;

use super::kind::Question;
use super::means::Means;
use crate::flow::quality::DRAFT;
use crate::flow::{Cost, Reason};
use crate::machine::branch::{BranchPoint, branch_while};
use crate::machine::special::Special;
use crate::machine::varied::Varied;
use crate::machine::{Cycle, ORDER, Subject};
use crate::oscillator::Belt;
use crate::oscillator::belt::Quantity;

/// The cycles over the speed of the belt, and where they change.
#[derive(Clone, Debug, PartialEq)]
pub struct Speeds {
    /// What was found at each speed that has an answer.
    pub points: Vec<Speed>,
    /// The changes.
    pub special: Vec<Special>,
    /// What it took.
    pub cost: Cost,
}

/// The cycles at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Speed {
    /// Speed of the belt, in m/s.
    pub v0: f64,
    /// The cycles, by amplitude.
    pub cycles: Vec<Cycle>,
    /// Largest displacement to the right from which the mass comes to rest, in m, where the motion that
    /// touches the belt borders it.
    pub touching: Option<f64>,
    /// Whether small motions come to rest.
    pub rests: bool,
}

/// Speeds of the belt that are looked at, and in a draft.
pub const SPEEDS: usize = 81;
const ROUGH: usize = 5;

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The machine; its own speed is put to 1 so that stepping it changes nothing here.
    pub belt: Arc<Belt>,
    /// From and to, in m/s.
    pub range: (f64, f64),
    /// Speeds that are looked at, evenly spaced; one without an answer is left out.
    pub count: usize,
}

impl Question for Asked {
    type Found = Speeds;

    fn answer(&self, means: &Means) -> Result<Speeds, Reason> {
        let varied = Varied::Quantity(Quantity::BeltSpeed);
        let go = || !(means.limits.interrupted)();
        let lost = |_| Reason::NotApplicable { needs: "a belt that runs" };
        let rough = (self.count <= ROUGH).then_some(DRAFT.tolerance);
        let subject = Subject { tolerance: rough, ..self.belt.as_ref().into() };
        let found = branch_while(&subject, varied, self.range, self.count, &go).map_err(lost)?;
        if !go() {
            return Err(Reason::Interrupted);
        }
        let point = |BranchPoint { value, found }: &BranchPoint| {
            let found = found.as_ref().ok()?;
            let (kind, margin) = (found.border.kind(), found.margin);
            let touching = margin.filter(|_| kind == "grazing").map(|margin| margin.displacement.0);
            let rests = kind != "no-basin";
            Some(Speed { v0: *value, cycles: found.cycles.clone(), touching, rests })
        };
        let steps = found.points.iter().filter_map(|point| point.found.as_ref().ok());
        let steps = steps.map(|found| found.steps).sum::<u64>();
        let cost = Cost { evaluations: steps * ORDER as u64, steps, rejected: 0 };
        let points = found.points.iter().filter_map(point).collect();
        Ok(Speeds { points, special: found.special, cost })
    }

    fn draft(&self) -> Option<Self> {
        (self.count > ROUGH).then(|| Asked { count: ROUGH, ..self.clone() })
    }

    fn numbers(&self) -> [f64; 8] {
        [self.range.0, self.range.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}
