//! A motion in time, by any of the methods that can follow a machine: its legs, points of it, and its ledger.

use serde::Serialize;

use super::arc::{Flow, SeriesStep, Watch};
use super::ledger::{MachineLedger, StepWorks};
use super::series::ORDER;
use super::stepped;
use super::turn::ContactState;
use crate::flow::{Cost, Detail, Fate, Method};
use crate::model::{Model, Phase, Reason};
use crate::numerics::polynomial::value;

/// A stretch of a motion in one phase, on the belt, or at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// What the mass does.
    pub place: ContactState,
    /// When it begins, in s.
    pub t: f64,
    /// Displacement there, in m.
    pub x: f64,
}

/// The legs that begin where the mass comes to a standstill, after the start.
pub fn turns(legs: &[Leg]) -> impl Iterator<Item = &Leg> {
    let below = |leg: &Leg| leg.place == ContactState::Slips(Phase::Below);
    let turns = move |pair: &&[Leg]| {
        pair[1].place == ContactState::Rests || below(&pair[0]) != below(&pair[1])
    };
    legs.windows(2).filter(turns).map(|pair| &pair[1])
}

/// A state in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MachineState {
    /// Time, in s.
    pub t: f64,
    /// Displacement, in m.
    pub x: f64,
    /// Velocity, in m/s.
    pub v: f64,
}

/// A motion from a start, in SI units.
#[derive(Clone, Debug)]
pub struct MachineMotion {
    /// The method that computed it; never `Auto`.
    pub method: Method,
    /// The error of a step, relative to the state.
    pub tolerance: f64,
    /// Its legs in their order.
    pub legs: Vec<Leg>,
    /// Points of it, if asked for; the first is the start.
    pub samples: Vec<MachineState>,
    /// Where it ends, or how far it was followed.
    pub end: MachineState,
    /// How it ends.
    pub outcome: Fate,
    /// Smallest and largest displacement, in m.
    pub x: (f64, f64),
    /// Smallest and largest velocity, in m/s.
    pub v: (f64, f64),
    /// Where the energy comes from and goes, if asked for; only Taylor series count it.
    pub ledger: Option<MachineLedger>,
    pub cost: Cost,
}

/// Collects a motion until its time is up.
struct MotionRecorder<'a> {
    model: &'a Model,
    detail: Detail,
    works: StepWorks,
    samples: Vec<MachineState>,
    whole: f64,
    left: f64,
    steps: u64,
    state: (f64, f64),
    x: (f64, f64),
    y: (f64, f64),
}

impl MotionRecorder<'_> {
    fn reaches(&mut self, (x, y): (f64, f64)) {
        self.x = (self.x.0.min(x), self.x.1.max(x));
        self.y = (self.y.0.min(y), self.y.1.max(y));
    }

    /// A state in SI units, `later` than the last one.
    fn state_at(&self, later: f64, (x, y): (f64, f64)) -> MachineState {
        let omega_0 = self.model.omega_0;
        let t = (self.whole - (self.left - later).max(0.0)) / omega_0;
        MachineState { t, x, v: y * omega_0 }
    }

    /// Keeps points of a step, evenly spaced, including its end but not its start.
    fn keep(&mut self, duration: f64, at: impl Fn(f64) -> (f64, f64)) {
        let count = u32::try_from(self.detail.samples_per_step).unwrap_or(u32::MAX);
        for part in 1..=count {
            let t = duration * f64::from(part) / f64::from(count);
            self.samples.push(self.state_at(t, at(t)));
        }
    }

    /// Takes note of the end of a step, which may lie beyond the time.
    fn ends(&mut self, duration: f64, state: (f64, f64)) {
        self.left -= duration;
        self.steps += 1;
        self.state = state;
        self.reaches(state);
    }
}

impl Watch for MotionRecorder<'_> {
    fn follows(&self) -> bool {
        true
    }

    fn left(&self) -> f64 {
        self.left
    }

    fn step(&mut self, model: &Model, step: &SeriesStep) {
        if self.left <= 0.0 {
            return;
        }
        let duration = step.duration.min(self.left);
        if self.detail.energy {
            self.works.slip(model, step, duration);
        }
        let offset = model.offset(step.phase);
        let at = |t: f64| (value(&step.series.x, t) - offset, value(&step.series.y, t));
        if let Some(peak) = step.peak.filter(|peak| *peak < duration) {
            self.reaches(at(peak));
        }
        self.keep(duration, at);
        self.ends(step.duration, at(duration));
    }

    fn passes(&mut self, duration: f64, end: (f64, f64)) {
        if self.detail.samples_per_step > 0 {
            self.samples.push(self.state_at(duration, end));
        }
        self.ends(duration, end);
    }

    fn stick(&mut self, model: &Model, from: f64, to: f64) {
        if self.left <= 0.0 {
            return;
        }
        let duration = (to - from) / model.speed;
        let ride = duration.min(self.left);
        let to = if duration > self.left { from + self.left * model.speed } else { to };
        if self.detail.energy {
            self.works.ride(model, from, to);
        }
        self.keep(ride, |t| (from + t * model.speed, model.speed));
        self.ends(duration, (to, model.speed));
    }
}

/// Maximum number of steps that are followed of a motion by Taylor series.
const MOST_STEPS: u64 = 200_000;

impl MachineMotion {
    /// Follows a motion from displacement `x` (m) and velocity `v` (m/s) for `until` seconds by Taylor series, with
    /// its ledger.
    #[must_use]
    pub fn new(model: &Model, x: f64, v: f64, until: f64) -> Self {
        let detail = Detail { energy: true, ..Detail::default() };
        Self::by(model, (Method::Taylor, model.tolerance), (x, v), until, detail)
    }

    /// The same by any method that [follows machines](Method::follows_machines), at a tolerance of its own.
    #[must_use]
    pub fn by(
        model: &Model,
        (method, tolerance): (Method, f64),
        (x, v): (f64, f64),
        until: f64,
        detail: Detail,
    ) -> Self {
        let mut model = model.clone();
        model.tolerance = tolerance;
        let model = &model;
        let omega_0 = model.omega_0;
        let start = (x, model.scaled_velocity(v));
        let (mut x, mut y) = start;
        let whole = until * omega_0;
        let mut stepper = stepped::stepper(model, method);
        let detail = Detail { energy: detail.energy && stepper.is_none(), ..detail };
        let most = if stepper.is_some() { stepped::STEPS } else { MOST_STEPS };
        let first = MachineState { t: 0.0, x, v: y * omega_0 };
        let mut recorder = MotionRecorder {
            model,
            detail,
            works: StepWorks::default(),
            samples: if detail.samples_per_step > 0 { vec![first] } else { Vec::new() },
            whole,
            left: whole,
            steps: 0,
            state: start,
            x: (x, x),
            y: (y, y),
        };
        let mut flow = Flow::new(model);
        let mut legs = Vec::new();
        let mut place = model.place(x, y);
        let outcome = loop {
            if recorder.left <= 0.0 {
                break Fate::Moving;
            }
            if recorder.steps > most {
                break Fate::Unknown(Reason::Steps);
            }
            legs.push(Leg { place, t: (whole - recorder.left) / omega_0, x });
            match flow.leg(stepper.as_mut(), place, (x, y), &mut recorder) {
                Ok(Some(leg)) => (place, x, y) = (leg.place, leg.x, leg.y),
                _ if recorder.left <= 0.0 => break Fate::Moving,
                Ok(None) => break Fate::Rest,
                Err(stop) => break stop.into(),
            }
        };
        let end = recorder.state_at(0.0, recorder.state);
        let MotionRecorder { works, samples, steps, state, .. } = recorder;
        let scaled = |(low, high): (f64, f64)| (low * omega_0, high * omega_0);
        let evaluations =
            stepper.as_ref().map_or(steps * ORDER as u64, |stepper| stepper.cost().evaluations);
        MachineMotion {
            method: if stepper.is_some() { method } else { Method::Taylor },
            tolerance: model.tolerance,
            legs,
            samples,
            end,
            outcome,
            x: recorder.x,
            v: scaled(recorder.y),
            ledger: detail.energy.then(|| works.ledger(model, start, state)),
            cost: Cost { evaluations, steps, ..Cost::default() },
        }
    }

    /// Where it ends. Fails with [`Reason`] where it leaves the law, escapes, or needs too many steps.
    pub fn known_end(&self) -> Result<MachineState, Reason> {
        match self.outcome {
            Fate::Unknown(stop) => Err(stop),
            Fate::Escapes => Err(Reason::Escapes),
            _ => Ok(self.end),
        }
    }

    /// The displacements of its standstills and of its end.
    pub fn places(&self) -> impl Iterator<Item = f64> + '_ {
        turns(&self.legs).map(|leg| leg.x).chain([self.end.x])
    }
}

impl Method {
    /// Whether it knows both switching lines of a machine.
    #[must_use]
    pub fn follows_machines(self) -> bool {
        matches!(self, Method::Auto | Method::Taylor | Method::Dop853 | Method::Dopri5)
    }
}

impl Flow<'_> {
    /// Where a motion from `(x, y)` that comes to rest does so, in m.
    ///
    /// # Errors
    /// [`Reason`] where it does not.
    pub fn rest_of(&mut self, mut x: f64, mut y: f64) -> Result<f64, Reason> {
        /// Turns that a motion may take.
        const TURNS: usize = 200_000;
        if self.model.guide_static == 0.0 {
            return Ok(0.0);
        }
        for _ in 0..TURNS {
            let place = self.model.place(x, y);
            match self.turn(place, (x, y), &mut ()) {
                Ok(turn) if turn.rests => return Ok(turn.x),
                Ok(turn) => (x, y) = (turn.x, 0.0),
                Err(Reason::Settles) if place == ContactState::Slips(Phase::Below) => {
                    return Ok(self.model.guide);
                }
                Err(Reason::Settles) => return Ok(-self.model.guide),
                Err(stop) => return Err(stop),
            }
        }
        Err(Reason::Steps)
    }
}
