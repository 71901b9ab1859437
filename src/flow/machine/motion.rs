//! A motion of a machine in time, by any of the methods that can follow one.

use super::arc::{Flow, SeriesStep, Watch};
use super::ledger::StepWorks;
use super::series::ORDER;
use super::stepped::{self, PhaseStepper};
use crate::flow::motion::Leg;
use crate::flow::{Cost, Crossing, Detail, Limits, Method, Outcome, Problem, Sample, Trajectory};
use crate::model::{ContactState, Model, Phase, Reason, State};
use crate::numerics::polynomial::value;

/// The units in which a motion of a machine is told. The model itself computes in m and `1/omega_0`.
#[derive(Clone, Copy, Debug)]
pub struct MotionUnits {
    /// The unit of length, in m.
    length: f64,
    /// The natural frequency in these units.
    omega_0: f64,
    /// The unit of energy, in J.
    energy: f64,
}

impl MotionUnits {
    /// SI units.
    #[must_use]
    pub fn physical(model: &Model) -> Self {
        MotionUnits { length: 1.0, omega_0: model.omega_0, energy: 1.0 }
    }

    /// Those of the paper's oscillator on a belt.
    #[must_use]
    pub fn of_paper(model: &Model) -> Self {
        let energy = model.stiffness * model.pull * model.pull;
        MotionUnits { length: model.pull, omega_0: 1.0, energy }
    }
}

/// Follows a motion of a machine, given and told in these units, by a method that
/// [follows machines](Method::follows_machines).
#[must_use]
pub fn follow(model: &Model, problem: &Problem, units: MotionUnits, detail: Detail) -> Trajectory {
    let mut model = model.clone();
    model.tolerance = problem.tolerance;
    let model = &model;
    let Problem { initial: State { q, v }, until, method, .. } = *problem;
    let MotionUnits { length, omega_0, energy } = units;
    let start = (q * length, v * length / omega_0);
    let whole = until * omega_0;
    let mut stepper = stepped::stepper(model, method);
    let detail = Detail { energy: detail.energy && stepper.is_none(), ..detail };
    let mut recorder = MotionRecorder {
        units,
        detail,
        works: StepWorks::default(),
        legs: Vec::new(),
        crossings: Vec::new(),
        samples: vec![Sample { tau: 0.0, q, v }],
        whole,
        left: whole,
        steps: 0,
        state: start,
        x: (start.0, start.0),
        y: (start.1, start.1),
    };
    let ended = recorder.run(&mut Flow::new(model), stepper.as_mut());
    let end = recorder.sample(0.0, recorder.state);
    if detail.samples_per_step == 0 {
        recorder.samples.push(end);
    }
    let Sample { tau, q, v } = end;
    let MotionRecorder { works, legs, crossings, samples, steps, state, x, y, .. } = recorder;
    let scaled = |(low, high): (f64, f64), one: f64| (low * one, high * one);
    let evaluations =
        stepper.as_ref().map_or(steps * ORDER as u64, |stepper| stepper.cost().evaluations);
    let works = detail.energy.then(|| works.ledger(model, start, state));
    Trajectory {
        problem: *problem,
        method: if stepper.is_some() { method } else { Method::Taylor },
        implicit_steps: 0,
        outcome: match ended {
            None => Outcome::Moving { tau, q, v },
            Some(Reason::Settles) => Outcome::Captured { tau, q },
            Some(Reason::Escapes) => Outcome::Escaped { tau },
            Some(reason) => Outcome::GaveUp { tau, reason },
        },
        crossings,
        legs,
        extremes: Some([scaled(x, 1.0 / length), scaled(y, omega_0 / length)]),
        ledger: works.map(|works| works.scaled(1.0 / energy)),
        samples,
        cost: Cost { evaluations, steps, ..Cost::default() },
    }
}

/// Follows a motion from displacement and velocity (m, m/s) for `until` seconds by Taylor series, with its ledger.
#[must_use]
pub fn follow_by_series(model: &Model, (q, v): (f64, f64), until: f64) -> Trajectory {
    let (method, tolerance) = (Method::Taylor, model.tolerance);
    let initial = State { q, v };
    let problem = Problem { initial, until, method, tolerance, ..Problem::default() };
    let detail = Detail { energy: true, ..Detail::default() };
    follow(model, &problem, MotionUnits::physical(model), detail)
}

/// Maximum number of steps that are followed of a motion by Taylor series.
const MOST_STEPS: u64 = 200_000;

/// Collects a motion until its time is up.
struct MotionRecorder {
    units: MotionUnits,
    detail: Detail,
    works: StepWorks,
    legs: Vec<Leg>,
    crossings: Vec<Crossing>,
    samples: Vec<Sample>,
    whole: f64,
    left: f64,
    steps: u64,
    state: (f64, f64),
    x: (f64, f64),
    y: (f64, f64),
}

impl MotionRecorder {
    /// Follows the motion leg by leg, by Taylor series where there is no other stepper. Returns why it ends; `None` where
    /// its time is up.
    fn run<'a>(
        &mut self,
        flow: &mut Flow<'a>,
        mut stepper: Option<&mut PhaseStepper<'a>>,
    ) -> Option<Reason> {
        let most = if stepper.is_some() { stepped::STEPS } else { MOST_STEPS };
        let (mut x, mut y) = self.state;
        let mut place = flow.model.place(x, y);
        loop {
            if self.left <= 0.0 {
                return None;
            }
            if self.steps > most {
                return Some(Reason::Steps);
            }
            let start = self.sample(0.0, (x, y));
            if !self.legs.is_empty() && y == 0.0 {
                self.crossings.push(Crossing { tau: start.tau, q: start.q });
            }
            self.legs.push(Leg { place, start });
            match flow.leg(stepper.as_deref_mut(), place, (x, y), self) {
                Ok(Some(leg)) => (place, x, y) = (leg.place, leg.x, leg.y),
                _ if self.left <= 0.0 => return None,
                Ok(None) => return Some(Reason::Settles),
                Err(stop) => return Some(stop),
            }
        }
    }

    fn reaches(&mut self, (x, y): (f64, f64)) {
        self.x = (self.x.0.min(x), self.x.1.max(x));
        self.y = (self.y.0.min(y), self.y.1.max(y));
    }

    /// A state `later` than the last one.
    fn sample(&self, later: f64, (x, y): (f64, f64)) -> Sample {
        let MotionUnits { length, omega_0, .. } = self.units;
        let tau = (self.whole - (self.left - later).max(0.0)) / omega_0;
        Sample { tau, q: x / length, v: y * omega_0 / length }
    }

    /// Keeps points of a step, evenly spaced, including its end but not its start.
    fn keep(&mut self, duration: f64, at: impl Fn(f64) -> (f64, f64)) {
        let count = u32::try_from(self.detail.samples_per_step).unwrap_or(u32::MAX);
        for part in 1..=count {
            let t = duration * f64::from(part) / f64::from(count);
            self.samples.push(self.sample(t, at(t)));
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

impl Watch for MotionRecorder {
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
            self.samples.push(self.sample(duration, end));
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
    pub fn rest_of(&mut self, mut x: f64, mut y: f64, limits: &Limits) -> Result<f64, Reason> {
        /// Turns that a motion may take.
        const TURNS: usize = 200_000;
        if self.model.guide_static == 0.0 {
            return Ok(0.0);
        }
        for _ in 0..TURNS {
            if (limits.interrupted)() {
                return Err(Reason::Interrupted);
            }
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
