//! A motion in progress: half swings joined end to end, and what is kept of them.

use std::ops::ControlFlow;

use super::limits::{Limits, Reason};
use super::method::Method;
use super::motion::{Cost, Crossing, Detail, Outcome, Problem, Sample, Trajectory};
use super::step::{Field, Powers, Step, StepPoint, Stepper};
use super::stop::ComingToRest;
use super::swing::{Failed, Swing, SwingEnd, glide, swing};
use crate::model::parameters::energy;
use crate::model::{HalfPlane, Ledger, Side, State};
use crate::numerics::count::real;
use crate::numerics::scaling::times_power;
use crate::numerics::sum::Sum;

/// Half swings of a motion whose ends are kept: what is written of these takes some hundred megabytes.
const MOST_CROSSINGS: usize = 2_000_000;

/// A motion in progress.
pub struct MotionRun {
    pub(super) detail: Detail,
    /// The results so far.
    pub(super) found: Trajectory,
    pub(super) time: Sum,
    pub(super) works: Works,
}

/// Work of the damping terms and path length, in the units of the problem.
#[derive(Default)]
pub(super) struct Works {
    linear: f64,
    quadratic: f64,
    cubic: f64,
    pub(super) path: f64,
}

impl MotionRun {
    /// A run at its start.
    pub fn new(problem: &Problem, method: Method, detail: Detail) -> Self {
        let moving = Outcome::Moving { tau: 0.0, q: problem.initial.q, v: problem.initial.v };
        let mut samples = Vec::new();
        if detail.samples_per_step > 0 {
            samples.push(Sample { tau: 0.0, q: problem.initial.q, v: problem.initial.v });
        }
        MotionRun {
            detail,
            found: Trajectory {
                problem: *problem,
                method,
                implicit_steps: 0,
                outcome: moving,
                crossings: Vec::new(),
                ledger: None,
                samples,
                cost: Cost::default(),
            },
            time: Sum::default(),
            works: Works::default(),
        }
    }

    /// Ends the run without an answer.
    pub fn give_up(mut self, reason: Reason) -> Trajectory {
        self.found.outcome = Outcome::GaveUp { tau: self.time.value(), reason };
        self.found
    }

    /// Follows the motion until it ends.
    pub fn go<S: Stepper>(mut self, stepper: &mut S, limits: &Limits) -> Trajectory {
        let Problem { parameters, initial, .. } = self.found.problem;
        let outcome = match Side::entered_from(initial, parameters.r) {
            None => Outcome::Captured { tau: 0.0, q: initial.q },
            Some(_) if parameters.r == 0.0 && !self.detail.crossings => self.glide(stepper, limits),
            Some(side) => self.half_swings(side, stepper, limits),
        };
        self.close(outcome, stepper.evaluations(), stepper.rejected())
    }

    /// The motion with its outcome, cost and energy ledger.
    pub(super) fn close(mut self, outcome: Outcome, evaluations: u64, rejected: u64) -> Trajectory {
        let Problem { parameters, initial, .. } = self.found.problem;
        self.found.outcome = outcome;
        self.found.cost.evaluations = evaluations;
        self.found.cost.rejected = rejected;
        let end = match outcome {
            Outcome::Captured { q, .. } => Some(State { q, v: 0.0 }),
            Outcome::Moving { q, v, .. } => Some(State { q, v }),
            Outcome::Escaped { .. } | Outcome::GaveUp { .. } => None,
        };
        if self.detail.energy
            && let Some(end) = end
        {
            let ledger = self.works.balance(initial, end, parameters.r);
            // Energies may overflow where states do not.
            self.found.ledger = ledger.residual.is_finite().then_some(ledger);
        }
        self.found
    }

    /// The outcome of a motion of which no more can be kept.
    pub(super) fn full(&self) -> Option<Outcome> {
        let (tau, reason) = (self.time.value(), Reason::HalfSwings { most: MOST_CROSSINGS });
        (self.found.crossings.len() >= MOST_CROSSINGS).then_some(Outcome::GaveUp { tau, reason })
    }

    /// Without friction: one smooth motion on both sides of `v = 0`.
    fn glide<S: Stepper>(&mut self, stepper: &mut S, limits: &Limits) -> Outcome {
        let Problem { parameters, initial, until, .. } = self.found.problem;
        if until <= 0.0 {
            return Outcome::Moving { tau: until, q: initial.q, v: initial.v };
        }
        let field = HalfPlane::new(&parameters, Side::Upper);
        let point = StepPoint { x: initial.q, v: initial.v };
        let watch = self.watcher(Side::Upper, field);
        let result = glide(stepper, &field, point, until, limits, watch);
        match self.book(result) {
            Err(failed) => failed,
            Ok(SwingEnd::Stopped { point }) => self.stopped(State { q: point.x, v: point.v }),
            Ok(_) => Outcome::Escaped { tau: self.time.value() },
        }
    }

    /// Joins half swings, the first on `side`, until the motion ends.
    fn half_swings<S: Stepper>(
        &mut self,
        mut side: Side,
        stepper: &mut S,
        limits: &Limits,
    ) -> Outcome {
        let Problem { parameters, initial, until, .. } = self.found.problem;
        let r = parameters.r;
        let mut point = StepPoint { x: side.position(initial.q, r), v: initial.v.abs() };
        let mut unit = 0;
        let mut last = initial;
        loop {
            let remaining = self.time.until(until);
            if remaining <= 0.0 {
                return Outcome::Moving { tau: until, q: last.q, v: last.v };
            }
            if let Some(full) = self.full() {
                return full;
            }
            let field = HalfPlane::new(&parameters, side);
            let stop = ComingToRest::of(&field, point).filter(|stop| stop.duration < remaining);
            let result = if let Some(ComingToRest { duration, .. }) = stop {
                Ok(Swing { end: SwingEnd::Crossing { x: point.x }, duration, steps: 0 })
            } else {
                let watch = self.watcher(side, field);
                swing(stepper, &field, (point, unit), remaining, limits, watch)
            };
            let end = match self.book(result) {
                Err(failed) => return failed,
                Ok(end) => end,
            };
            let tau = self.time.value();
            match end {
                SwingEnd::Escape => return Outcome::Escaped { tau },
                SwingEnd::Stopped { point: end } => {
                    self.works.path += end.x - point.x;
                    let (q, v) = (side.displacement(end.x, r), side.sign() * end.v);
                    return self.stopped(State { q, v });
                }
                SwingEnd::Crossing { x } => {
                    let (way, q) = match stop {
                        Some(stop) => (stop.way(), last.q + side.sign() * stop.way()),
                        None => (x - point.x, side.displacement(x, r)),
                    };
                    if !q.is_finite() {
                        return Outcome::GaveUp { tau, reason: Reason::OutOfRange };
                    }
                    self.found.crossings.push(Crossing { tau, q });
                    self.works.path += way;
                    // The next half swing starts from its clearance, which is known more accurately than q - r.
                    let (clearance, of) = match stop {
                        Some(stop) => stop.beyond(side.sign() * last.q - r),
                        None => (x - 2.0 * r, 0),
                    };
                    last = State { q, v: 0.0 };
                    if clearance <= 0.0 {
                        return Outcome::Captured { tau, q };
                    }
                    side = side.opposite();
                    (point, unit) = (StepPoint { x: -clearance, v: 0.0 }, of);
                }
            }
        }
    }

    /// The callback for each step on this side: keeps points for drawing and adds up the work.
    fn watcher<S: Stepper>(
        &mut self,
        side: Side,
        field: HalfPlane,
    ) -> impl FnMut(&mut S, f64, i32, &Step) -> ControlFlow<()> {
        let (detail, time, r) = (self.detail, self.time, self.found.problem.parameters.r);
        let (samples, works) = (&mut self.found.samples, &mut self.works);
        move |stepper, at, unit, step| {
            if detail.samples_per_step > 0 {
                sample(stepper, step, detail.samples_per_step, |offset, point| {
                    samples.push(Sample {
                        tau: time.plus(at + offset),
                        q: side.displacement(times_power(point.x, unit), r),
                        v: side.sign() * times_power(point.v, unit),
                    });
                });
            }
            if detail.energy {
                works.add(&stepper.powers(), &field, unit);
            }
            ControlFlow::Continue(())
        }
    }

    /// Records steps and time; returns how the piece ended, or the outcome where it failed.
    fn book(&mut self, result: Result<Swing, Failed>) -> Result<SwingEnd, Outcome> {
        let (duration, steps) = match &result {
            Ok(swing) => (swing.duration, swing.steps),
            Err(failed) => (failed.duration, failed.steps),
        };
        self.found.cost.steps += steps;
        self.time.add(duration);
        let tau = self.time.value();
        match result {
            Ok(swing) => Ok(swing.end),
            Err(failed) => Err(Outcome::GaveUp { tau, reason: failed.reason }),
        }
    }

    /// The motion at its end time.
    fn stopped(&self, State { q, v }: State) -> Outcome {
        if q.is_finite() && v.is_finite() {
            Outcome::Moving { tau: self.found.problem.until, q, v }
        } else {
            Outcome::GaveUp { tau: self.time.value(), reason: Reason::OutOfRange }
        }
    }
}

impl Works {
    /// Adds the work of the damping terms over one step measured in units of `2^unit`.
    pub(super) fn add(&mut self, powers: &Powers, field: &HalfPlane, unit: i32) {
        let field = field.in_units(unit);
        let energy = |work: f64| times_power(times_power(work, unit), unit);
        self.linear += energy(-2.0 * field.d * powers.second);
        self.quadratic += energy(-field.d2 * powers.third);
        self.cubic += energy(-field.d3 * powers.fourth);
    }

    fn balance(&self, start: State, end: State, r: f64) -> Ledger {
        let (start, end) = (energy(start), energy(end));
        let friction = -r * self.path;
        let works = self.linear + self.quadratic + self.cubic + friction;
        Ledger {
            start,
            end,
            linear: self.linear,
            quadratic: self.quadratic,
            cubic: self.cubic,
            friction,
            residual: (end - start) - works,
        }
    }
}

/// Passes evenly spaced points of a step to `keep`, including its end but not its start.
///
/// Near the largest numbers, a position measured from the centre of its spiral may overflow, and so may the
/// polynomial of a step between two finite points. Points that are not finite are left out.
pub(super) fn sample<F: Field, S: Stepper<F>>(
    stepper: &mut S,
    step: &Step,
    count: usize,
    mut keep: impl FnMut(f64, StepPoint),
) {
    let mut keep_number = |offset, point: StepPoint| {
        if point.x.is_finite() && point.v.is_finite() {
            keep(offset, point);
        }
    };
    let count = count * stepper.pieces();
    stepper.prepare_dense();
    for index in 1..count {
        let offset = step.duration * (real(index) / real(count));
        keep_number(offset, stepper.at(offset));
    }
    keep_number(step.duration, step.end);
}
