//! Where the energy of a motion comes from and goes: the belt's work against the damper's and the guide's.

use super::arc::{SeriesStep, Watch};
use crate::model::{Ledger, Model, Phase, Work};
use crate::numerics::polynomial::value;
use crate::numerics::quadrature::GAUSS;

/// The works of the steps, divided by the stiffness.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StepWorks {
    pub belt: f64,
    pub damper: f64,
    pub guide: f64,
}

impl StepWorks {
    /// Counts a step in slip up to `duration`.
    pub fn slip(&mut self, model: &Model, step: &SeriesStep, duration: f64) {
        let mut belt = 0.0;
        let mut damper = 0.0;
        for (node, weight) in GAUSS {
            let y = value(&step.series.y, node * duration);
            belt += weight * y * model.pull_at(step.phase, y);
            damper += weight * y * model.damper(y);
        }
        self.belt += belt * duration;
        self.damper += damper * duration;
        let way = value(&step.series.x, duration) - step.series.x[0];
        self.guide += model.guide * way.abs();
    }

    /// Counts a ride on the belt, which pulls as much as it takes to hold the mass at its speed.
    pub fn ride(&mut self, model: &Model, from: f64, to: f64) {
        let way = to - from;
        let damper = model.damper(model.speed) * way;
        let guide = model.guide * way;
        self.belt += way * (0.5 * (from + to) + model.pull) + damper + guide;
        self.damper += damper;
        self.guide += guide;
    }

    /// The whole ledger of a motion between two states, in J.
    pub fn ledger(&self, model: &Model, start: (f64, f64), end: (f64, f64)) -> Ledger {
        let energy = |(x, y): (f64, f64)| 0.5 * ((x + model.pull) * (x + model.pull) + y * y);
        let works = [("belt", self.belt), ("damper", -self.damper), ("guide", -self.guide)];
        let work = |(source, amount)| Work { source, amount, acts: amount != 0.0 };
        let works = works.into_iter().map(work).collect();
        Ledger::new((energy(start), energy(end)), works).scaled(model.stiffness)
    }
}

impl Watch for StepWorks {
    fn step(&mut self, model: &Model, step: &SeriesStep) {
        self.slip(model, step, step.duration);
    }

    fn stick(&mut self, model: &Model, from: f64, to: f64) {
        self.ride(model, from, to);
    }
}

impl Model {
    /// The belt's pull in a phase of slip.
    fn pull_at(&self, phase: Phase, y: f64) -> f64 {
        let offset = if phase == Phase::Above { 0.0 } else { self.pull };
        offset + self.force(phase, y).0 + self.damper(y)
    }
}
