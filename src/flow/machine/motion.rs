//! A motion of a machine in time, by any of the methods that can follow one.

use nalgebra::Vector3;

use super::curve::ledger;
use super::{Flow, MachineStep, ORDER, PhaseSeries, stepped};
use crate::flow::motion::due;
use crate::flow::{Crossing, Detail, Leg, Limits, Method, Motion, Outcome, Problem, Sample};
use crate::model::{ContactState, Model, Phase, Reason, Result, State};

/// The units in which a motion of a machine is told. The model itself computes in m and `1/omega_0`.
#[derive(Clone, Copy, Debug)]
#[must_use]
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
    pub fn physical(model: &Model) -> Self {
        MotionUnits { length: 1.0, omega_0: model.omega_0, energy: 1.0 }
    }

    /// Those of the paper's oscillator on a belt.
    pub fn of_paper(model: &Model) -> Self {
        let energy = model.stiffness * model.pull * model.pull;
        MotionUnits { length: model.pull, omega_0: 1.0, energy }
    }
}

/// Follows a motion of a machine, given and told in these units, by a method that
/// [follows machines](Method::follows_machines).
pub fn follow(model: &Model, problem: &Problem, units: MotionUnits, detail: Detail) -> Motion {
    follow_at(model, problem, units, (detail, &[]))
}

/// The same with points at these times, in ascending order, if it is followed by Taylor series.
pub(crate) fn follow_at(
    model: &Model,
    problem: &Problem,
    units: MotionUnits,
    (detail, times): (Detail, &[f64]),
) -> Motion {
    let mut model = model.clone();
    model.tolerance = problem.tolerance;
    let model = &model;
    let Problem { initial: State { q, v }, until, method, .. } = *problem;
    let mut flow = Flow { stepper: stepped::stepper(model, method), ..Flow::new(model) };
    (flow.series.left, flow.follows) = (until * units.omega_0, true);
    let by_series = flow.stepper.is_none();
    // A step without series is known at its end alone.
    let samples_per_step = detail.samples_per_step.min(if by_series { usize::MAX } else { 1 });
    let energy = detail.energy && by_series;
    let start = (q * units.length, v * units.length / units.omega_0);
    let mut recorder = MotionRecorder {
        units,
        detail: Detail { samples_per_step, energy, ..detail },
        times: if by_series { times } else { &[] },
        whole: flow.series.left,
        works: Vector3::zeros(),
        state: start,
        found: Motion::begun(problem, if by_series { Method::Taylor } else { method }),
    };
    recorder.found.samples = vec![Sample { tau: 0.0, q, v }];
    recorder.found.extremes = Some([(q, q), (v, v)]);
    let ended = recorder.run(&mut flow);
    let end = recorder.sample(flow.series.left, recorder.state);
    let Sample { tau, q, v } = end;
    let MotionRecorder { works, state, mut found, .. } = recorder;
    if samples_per_step == 0 {
        found.samples.push(end);
    }
    found.outcome = match ended {
        None => Outcome::Moving { tau, q, v },
        Some(Reason::Settles) => Outcome::Captured { tau, q },
        Some(reason) => Outcome::without_end(tau, reason),
    };
    let by_terms = found.cost.steps * ORDER as u64;
    found.cost.evaluations = flow.stepper.map_or(by_terms, |it| it.cost().evaluations);
    let works = energy.then(|| ledger(model, works, [start, state]));
    found.ledger = works.map(|works| works.scaled(1.0 / units.energy));
    found
}

/// Maximum number of steps that are followed of a motion by Taylor series.
const MOST_STEPS: u64 = 200_000;

/// Collects a motion until its time is up.
struct MotionRecorder<'a> {
    units: MotionUnits,
    detail: Detail,
    /// The times at which it is still to be evaluated.
    times: &'a [f64],
    /// How long the motion is followed.
    whole: f64,
    /// Works of belt, damper and guide.
    works: Vector3<f64>,
    /// Displacement and velocity at the end of the last step.
    state: (f64, f64),
    found: Motion,
}

impl MotionRecorder<'_> {
    /// Follows the motion leg by leg. Returns why it ends; `None` where its time is up.
    fn run(&mut self, flow: &mut Flow) -> Option<Reason> {
        let most = if flow.stepper.is_some() {
            stepped::STEPS
        } else {
            MOST_STEPS
        };
        let model = flow.model;
        let (mut x, mut y) = self.state;
        let mut place = model.place(x, y);
        loop {
            let left = flow.series.left;
            if left <= 0.0 {
                return None;
            }
            if self.found.cost.steps > most {
                return Some(Reason::Steps);
            }
            let start = self.sample(left, (x, y));
            if !self.found.legs.is_empty() && y == 0.0 {
                self.found.crossings.push(Crossing { tau: start.tau, q: start.q });
            }
            self.found.legs.push(Leg { place, start });
            let mut keep = |series: &PhaseSeries| self.keep(model, &series.step, series.left);
            match flow.leg(place, (x, y), &mut keep) {
                Ok(Some((next, end))) => (place, x, y) = (next, end.x, end.y),
                _ if flow.series.left <= 0.0 => return None,
                Ok(None) => return Some(Reason::Settles),
                Err(stop) => return Some(stop),
            }
        }
    }

    /// A state with this much time left.
    fn sample(&self, left: f64, (x, y): (f64, f64)) -> Sample {
        let MotionUnits { length, omega_0, .. } = self.units;
        let tau = (self.whole - left.max(0.0)) / omega_0;
        Sample { tau, q: x / length, v: y * omega_0 / length }
    }

    /// Keeps what is asked for of a step at whose start this much time is left: points, evenly spaced, including its end
    /// but not its start.
    fn keep(&mut self, model: &Model, step: &MachineStep, left: f64) {
        let count = u32::try_from(self.detail.samples_per_step).unwrap_or(u32::MAX);
        for part in 1..=count {
            let t = step.duration * f64::from(part) / f64::from(count);
            self.found.samples.push(self.sample(left - t, step.at(t)));
        }
        let (begun, rate) = (self.whole - left, self.units.omega_0);
        for tau in due(&mut self.times, (begun + step.duration) / rate) {
            let t = (tau * rate - begun).clamp(0.0, step.duration);
            self.found.samples.push(Sample { tau: *tau, ..self.sample(left - t, step.at(t)) });
        }
        if self.detail.energy {
            self.works += step.works(model, step.duration);
        }
        self.found.cost.steps += 1;
        self.state = step.at(step.duration);
        for state in step.peak.map(|peak| step.at(peak)).into_iter().chain([self.state]) {
            let Sample { q, v, .. } = self.sample(left, state);
            for ((low, high), value) in self.found.extremes.iter_mut().flatten().zip([q, v]) {
                (*low, *high) = (low.min(value), high.max(value));
            }
        }
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
    pub fn rest_of(&mut self, mut x: f64, mut y: f64, limits: &Limits) -> Result<f64> {
        /// Turns that a motion may take.
        const TURNS: usize = 200_000;
        if self.model.guide_static == 0.0 {
            return Ok(0.0);
        }
        for _ in 0..TURNS {
            limits.go_on()?;
            let place = self.model.place(x, y);
            match self.turn(place, (x, y), &mut |_| {}) {
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
