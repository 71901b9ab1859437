//! The cycles of a machine over the speed of its belt.

use crate::flow::{Cost, Limits, Reason};
use crate::machine::branch::{BranchPoint, branch_while};
use crate::machine::special::Special;
use crate::machine::varied::Varied;
use crate::machine::{Cycle, ORDER};
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

/// The cycles at so many speeds, evenly spaced.
///
/// # Errors
/// [`Reason::Interrupted`]; a speed without an answer is left out.
pub fn speeds(
    belt: &Belt,
    range: (f64, f64),
    count: usize,
    limits: &Limits,
) -> Result<Speeds, Reason> {
    let varied = Varied::Quantity(Quantity::BeltSpeed);
    let go = || !(limits.interrupted)();
    let lost = |_| Reason::NotApplicable { needs: "a belt that runs" };
    let found = branch_while(belt, varied, range, count, &go).map_err(lost)?;
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
