//! A motion in time: its legs, the curve that it draws, and its ledger.

use serde::Serialize;

use super::arc::{Flow, LostMotion, SeriesStep, Watch};
use super::curve::{CurvePiece, MachineCurve};
use super::ledger::{MachineLedger, StepWorks};
use super::turn::ContactState;
use crate::flow::Fate;
use crate::model::{Model, Phase};

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
    /// Its legs in their order.
    pub legs: Vec<Leg>,
    /// All of it as a curve, whose pieces follow one another in time.
    pub curve: MachineCurve,
    /// Where it ends, or how far it was followed.
    pub end: MachineState,
    /// How it ends.
    pub outcome: Fate<LostMotion>,
    /// Smallest and largest displacement, in m.
    pub x: (f64, f64),
    /// Smallest and largest velocity, in m/s.
    pub v: (f64, f64),
    /// Where the energy comes from and goes.
    pub ledger: MachineLedger,
    model: Model,
}

/// Collects a motion until its time is up.
struct Recorder {
    curve: MachineCurve,
    works: StepWorks,
    left: f64,
    state: (f64, f64),
    x: (f64, f64),
    y: (f64, f64),
}

impl Recorder {
    fn reaches(&mut self, x: f64, y: f64) {
        self.x = (self.x.0.min(x), self.x.1.max(x));
        self.y = (self.y.0.min(y), self.y.1.max(y));
    }
}

impl Watch for Recorder {
    fn follows(&self) -> bool {
        true
    }

    fn is_done(&self) -> bool {
        self.left <= 0.0
    }

    fn step(&mut self, model: &Model, step: &SeriesStep) {
        if self.left <= 0.0 {
            return;
        }
        let duration = step.duration.min(self.left);
        self.left -= step.duration;
        self.works.slip(model, step, duration);
        self.curve.step(
            model,
            &SeriesStep { duration, peak: step.peak.filter(|t| *t < duration), ..*step },
        );
        if let Some(CurvePiece::Slip(slip)) = self.curve.pieces.last() {
            let ends = [slip.peak.map(|peak| slip.at(peak)), Some(slip.at(duration))];
            for (x, y) in ends.into_iter().flatten() {
                self.state = (x, y);
                self.reaches(x, y);
            }
        }
    }

    fn stick(&mut self, model: &Model, from: f64, to: f64) {
        if self.left <= 0.0 {
            return;
        }
        let duration = (to - from) / model.speed;
        let to = if duration > self.left { from + self.left * model.speed } else { to };
        self.left -= duration;
        self.works.ride(model, from, to);
        self.curve.stick(model, from, to);
        self.state = (to, model.speed);
        self.reaches(to, model.speed);
    }
}

/// Maximum number of pieces that are kept of a motion.
const MOST_PIECES: usize = 200_000;

impl MachineMotion {
    /// Follows a motion from displacement `x` (m) and velocity `v` (m/s) for `until` seconds.
    #[must_use]
    pub fn new(model: &Model, x: f64, v: f64, until: f64) -> Self {
        let omega_0 = model.omega_0;
        let start = (x, model.scaled_velocity(v));
        let (mut x, mut y) = start;
        let whole = until * omega_0;
        let mut recorder = Recorder {
            curve: MachineCurve::default(),
            works: StepWorks::default(),
            left: whole,
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
            if recorder.curve.pieces.len() > MOST_PIECES {
                break Fate::Unknown(LostMotion::Steps);
            }
            legs.push(Leg { place, t: (whole - recorder.left) / omega_0, x });
            match flow.leg(place, (x, y), &mut recorder) {
                Ok(Some(next)) => (place, x, y) = next,
                _ if recorder.left <= 0.0 => break Fate::Moving,
                Ok(None) => break Fate::Rest,
                Err(stop) => break stop.into(),
            }
        };
        let Recorder { curve, works, left, state: (x, y), .. } = recorder;
        let t = (whole - left.max(0.0)) / omega_0;
        let scaled = |(low, high): (f64, f64)| (low * omega_0, high * omega_0);
        MachineMotion {
            legs,
            end: MachineState { t, x, v: y * omega_0 },
            outcome,
            x: recorder.x,
            v: scaled(recorder.y),
            ledger: works.ledger(model, start, (x, y)),
            curve,
            model: model.clone(),
        }
    }

    /// The states at the ends of its steps and at this many places evenly between them.
    #[must_use]
    pub fn samples(&self, between: u32) -> Vec<MachineState> {
        let Model { omega_0, speed, .. } = self.model;
        let parts = f64::from(between + 1);
        let mut begin = 0.0;
        let mut found = Vec::new();
        for piece in &self.curve.pieces {
            let duration = match piece {
                CurvePiece::Slip(slip) => slip.duration,
                CurvePiece::Line { from, to } => (to - from) / speed,
            };
            let first = u32::from(!found.is_empty());
            for part in first..=between + 1 {
                let t = duration * f64::from(part) / parts;
                let (x, y) = match piece {
                    CurvePiece::Slip(slip) => slip.at(t),
                    CurvePiece::Line { from, .. } => (from + t * speed, speed),
                };
                found.push(MachineState { t: (begin + t) / omega_0, x, v: y * omega_0 });
            }
            begin += duration;
        }
        found
    }
}

impl Flow<'_> {
    /// Follows one leg; returns where the next begins, `None` at rest.
    fn leg(
        &mut self,
        place: ContactState,
        (x, y): (f64, f64),
        watch: &mut impl Watch,
    ) -> Result<Option<(ContactState, f64, f64)>, LostMotion> {
        let phase = match place {
            ContactState::Rests => return Ok(None),
            ContactState::Sticks => {
                let release = self.model.lines.map_or(x, |lines| lines.release);
                watch.stick(self.model, x, release);
                return Ok(Some((ContactState::Slips(Phase::Between), release, y)));
            }
            ContactState::Slips(phase) => phase,
        };
        let end = self.arc(phase, (x, y), false, watch)?;
        let (place, x) = self.after(phase, &end);
        Ok(Some((place, x, if end.on_belt { self.model.speed } else { 0.0 })))
    }

    /// Where a motion from `(x, y)` that comes to rest does so, in m.
    ///
    /// # Errors
    /// [`LostMotion`] where it does not.
    pub fn rest_of(&mut self, mut x: f64, mut y: f64) -> Result<f64, LostMotion> {
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
                Err(LostMotion::Settled) if place == ContactState::Slips(Phase::Below) => {
                    return Ok(self.model.guide);
                }
                Err(LostMotion::Settled) => return Ok(-self.model.guide),
                Err(stop) => return Err(stop),
            }
        }
        Err(LostMotion::Steps)
    }
}
