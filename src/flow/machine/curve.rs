//! A motion of a machine as a curve: the series of its steps, in slip and while the mass rides on the belt; and where
//! its energy comes from and goes, the belt's work against the damper's and the guide's.

use nalgebra::{Vector2, Vector3};

use crate::model::{ContactState, Ledger, Model, Phase, State, Work};
use crate::numerics::{
    Bracket, GAUSS, PlaceTolerance, gauss, newton, powi, reciprocals, value, value_and_slope,
};

/// Order of the series; near the one that costs least at full precision.
pub const ORDER: usize = 20;

/// Terms of a series.
pub const TERMS: usize = ORDER + 1;

/// Coefficients in powers of time.
pub type Terms = [f64; TERMS];

/// `1/k`.
pub(super) const INVERSE: Terms = reciprocals();

/// A step of a motion: its series hold everywhere between its ends.
#[derive(Clone, Debug)]
pub struct MachineStep {
    /// What the mass does.
    pub place: ContactState,
    /// Duration, in `1/omega_0`.
    pub duration: f64,
    /// Where the velocity has its extremum in the step; on the belt anywhere.
    pub peak: Option<f64>,
    /// What is added to a displacement in the series of `x`: the distance to the balance of a phase.
    pub(super) offset: f64,
    pub(super) x: Terms,
    pub(super) y: Terms,
}

impl MachineStep {
    /// A ride on the belt, or another piece of its line, from one displacement to another.
    pub fn ride(from: f64, to: f64, speed: f64) -> Self {
        let duration = (to - from) / speed;
        Self::even(ContactState::Sticks, duration, [from, speed], speed)
    }

    /// A step of one velocity, whose displacement begins here and changes at this rate.
    pub(super) fn even(place: ContactState, duration: f64, [x, rate]: [f64; 2], y: f64) -> Self {
        let [mut places, mut velocities] = [[0.0; TERMS]; 2];
        (places[0], places[1], velocities[0]) = (x, rate, y);
        let (peak, offset) = (Some(0.0), 0.0);
        MachineStep { place, duration, peak, offset, x: places, y: velocities }
    }

    /// Displacement and velocity (divided by the natural frequency) at a time from the start of the step.
    pub fn at(&self, t: f64) -> (f64, f64) {
        (value(&self.x, t) - self.offset, value(&self.y, t))
    }

    /// The velocity where the step passes a displacement; `None` where it does not.
    fn velocity_at(&self, x: f64) -> Option<f64> {
        let target = x + self.offset;
        let (from, to) = (self.x[0], value(&self.x, self.duration));
        if from.min(to) > target || from.max(to) < target {
            return None;
        }
        // A piece of the belt's line may be passed backward.
        let (low, high) = (self.duration.min(0.0), self.duration.max(0.0));
        let bracket = Bracket { low, high, rising: (to > from) == (self.duration > 0.0) };
        let settled = PlaceTolerance::Absolute(1e-16 * self.duration.abs());
        let height = |t: f64| {
            let (height, slope) = value_and_slope(&self.x, t);
            (height - target, slope)
        };
        let time = newton(bracket, bracket.middle(), settled, height);
        Some(value(&self.y, time))
    }

    /// The works of belt, damper and guide up to a time from the start of the step, divided by the stiffness.
    ///
    /// In slip the belt pulls by its law; a mass that rides is pulled as much as it takes to hold it at the belt's speed.
    pub(super) fn works(&self, model: &Model, until: f64) -> Vector3<f64> {
        let powers = GAUSS.iter().map(|&(node, weight)| {
            let (x, y) = self.at(node * until);
            let damper = model.damper(y);
            let belt = match self.place {
                ContactState::Slips(Phase::Above) => model.force(Phase::Above, y).0 + damper,
                ContactState::Slips(phase) => model.pull + model.force(phase, y).0 + damper,
                _ => x + model.pull + damper + model.guide,
            };
            weight * (y * Vector2::new(belt, damper))
        });
        let [belt, damper] = (powers.sum::<Vector2<f64>>() * until).into();
        let way = value(&self.x, until) - self.x[0];
        Vector3::new(belt, damper, model.guide * way.abs())
    }
}

/// A motion, or the border of a basin, as a curve in the phase plane.
#[derive(Clone, Debug, Default)]
pub struct MachineCurve {
    /// Its steps, in the order in which they were computed, forward or backward in time.
    pub steps: Vec<MachineStep>,
}

impl MachineCurve {
    /// The velocities at which it passes a displacement, at `y > 0` and at `y < 0`.
    pub fn velocities_at(&self, x: f64) -> (Option<f64>, Option<f64>) {
        let mut found = (None, None);
        for step in &self.steps {
            let below = step.place == ContactState::Slips(Phase::Below);
            let side = if below { &mut found.1 } else { &mut found.0 };
            *side = step.velocity_at(x).or(*side);
        }
        found
    }

    /// The area within a closed curve: the integral of `y dx` along it, which is that of `y^2` over time.
    pub fn area(&self) -> f64 {
        let square = |it: &MachineStep| gauss(|part| powi(it.at(part * it.duration).1, 2));
        self.steps.iter().map(|step| square(step) * step.duration.abs()).sum()
    }

    /// The displacements at which its steps end: it is smooth between them.
    pub fn ends(&self) -> Vec<f64> {
        self.steps.iter().flat_map(|step| [0.0, step.duration].map(|t| step.at(t).0)).collect()
    }

    /// Its points, one more than this number on each step in slip and on each ride; velocities divided by the natural
    /// frequency.
    pub fn points(&self, (in_slip, on_belt): (u16, u16)) -> Vec<State> {
        let points = self.steps.iter().flat_map(|step| {
            let rides = step.place == ContactState::Sticks;
            let between = if rides { on_belt } else { in_slip }.max(1);
            let part = move |point: u16| f64::from(point) / f64::from(between);
            (0..=between).map(move |point| step.at(step.duration * part(point)))
        });
        points.map(|(q, v)| State { q, v }).collect()
    }

    /// The ledger of a closed curve, in J.
    pub fn ledger(&self, model: &Model) -> Ledger {
        let sum = self.steps.iter().map(|step| step.works(model, step.duration)).sum();
        let start = self.steps.first().map_or((0.0, 0.0), |step| step.at(0.0));
        ledger(model, sum, [start; 2])
    }

    /// The same as a closed curve to be drawn, on which the belt's line needs its ends alone.
    pub fn closed(&self, between: u16) -> Vec<State> {
        let mut found = self.points((between, 1));
        found.extend(found.first().copied());
        found
    }
}

/// The ledger of a motion between two states with these works of belt, damper and guide, in J.
pub(super) fn ledger(model: &Model, works: Vector3<f64>, ends: [(f64, f64); 2]) -> Ledger {
    let energy = |(x, y): (f64, f64)| 0.5 * ((x + model.pull) * (x + model.pull) + y * y);
    let [belt, damper, guide] = works.into();
    let works = [("belt", belt), ("damper", -damper), ("guide", -guide)];
    let work = |(source, amount)| Work { source, amount, acts: amount != 0.0 };
    let works = works.into_iter().map(work).collect();
    Ledger::new(ends.map(energy).into(), works).scaled(model.stiffness)
}
