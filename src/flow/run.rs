//! A motion in progress: half swings joined end to end, and what is kept of them.

use std::ops::ControlFlow;

use super::limits::Limits;
use super::method::Method;
use super::motion::{Cost, Crossing, Detail, Outcome, Problem, Sample, Trajectory};
use super::step::{Field, PlaneField, Powers, Step, StepPoint, Stepper};
use super::stop::ComingToRest;
use super::swing::{Swing, swing};
use crate::model::parameters::energy;
use crate::model::parameters::rests;
use crate::model::{HalfPlane, Ledger, Reason, Side, State};
use crate::numerics::{Scalar, Sum, real, times_power};

/// Half swings of a motion whose ends are kept: what is written of these takes some hundred megabytes.
const MOST_CROSSINGS: usize = 2_000_000;

/// A motion in progress.
pub struct MotionRun<N = f64> {
    detail: Detail,
    /// The results so far.
    found: Trajectory<N>,
    time: Sum<N>,
    /// Work of the linear, the quadratic and the cubic damping.
    works: [f64; 3],
    /// Length of the path.
    path: f64,
}

impl<N: Scalar> MotionRun<N> {
    /// A run at its start.
    pub fn new(problem: &Problem, method: Method, detail: Detail) -> Self {
        let State { q, v } = problem.initial;
        let mut found = Trajectory::begun(problem, method);
        if detail.samples_per_step > 0 {
            found.samples.push(Sample { tau: 0.0, q, v });
        }
        MotionRun { detail, found, time: Sum::default(), works: [0.0; 3], path: 0.0 }
    }

    /// Ends the run without an answer.
    pub fn give_up(mut self, reason: Reason) -> Trajectory<N> {
        self.found.outcome = self.gives_up(reason);
        self.found
    }

    /// Follows the motion until it ends.
    pub fn go<S: Stepper<HalfPlane, N>>(
        mut self,
        stepper: &mut S,
        limits: &Limits,
    ) -> Trajectory<N> {
        let Problem { parameters, initial, .. } = self.found.problem;
        let outcome = match Side::entered_from(initial, parameters.r) {
            None => self.rests(),
            Some(_) if parameters.r == 0.0 && !self.detail.crossings => {
                let field = HalfPlane::new(&parameters, Side::Upper);
                self.glide(stepper, &field, limits, |_, _, _, _| None)
            }
            Some(side) => self.half_swings(side, stepper, limits),
        };
        self.close(outcome, stepper.cost())
    }

    /// The motion with its outcome, cost and energy ledger.
    fn close(mut self, outcome: Outcome<N>, cost: Cost) -> Trajectory<N> {
        let Problem { parameters, initial, .. } = self.found.problem;
        self.found.outcome = outcome;
        self.found.cost += cost;
        if self.detail.energy
            && let Some((q, v)) = outcome.state()
        {
            let end = State { q: q.value(), v: v.value() };
            let [linear, quadratic, cubic] = self.works;
            let works = [linear, quadratic, cubic, -parameters.r * self.path];
            let energies = (energy(initial), energy(end));
            let ledger = Ledger::of_terms(&parameters, energies, works);
            // Energies may overflow where states do not.
            self.found.ledger = ledger.residual.is_finite().then_some(ledger);
        }
        self.found
    }

    /// The outcome of a motion that rests at its start.
    fn rests(&self) -> Outcome<N> {
        Outcome::Captured { tau: N::of(0.0), q: N::of(self.found.problem.initial.q) }
    }

    /// The outcome of a motion that escapes, or is given up.
    fn gives_up(&self, reason: Reason) -> Outcome<N> {
        Outcome::without_end(self.time.value(), reason)
    }

    /// One smooth motion on both sides of `v = 0`: there is no friction, or it is part of the field.
    ///
    /// `see` is called after each step, with the stepper, the time at which it began, the exponent of its unit and
    /// the step; it may end the motion there.
    fn glide<F: PlaneField, S: Stepper<F, N>>(
        &mut self,
        stepper: &mut S,
        field: &F,
        limits: &Limits,
        mut see: impl FnMut(&mut S, f64, i32, &Step<N>) -> Option<Outcome<N>>,
    ) -> Outcome<N> {
        let Problem { initial: State { q, v }, until, .. } = self.found.problem;
        let (point, until) = (StepPoint { x: N::of(q), v: N::of(v) }, N::of(until));
        if until <= N::of(0.0) {
            return Outcome::Moving { tau: until, q: point.x, v: point.v };
        }
        let mut ended = None;
        let result = {
            let mut keep = self.keeper::<F, S>(Side::Upper, 0.0, field.frictionless());
            let watch = |stepper: &mut S, at: f64, unit: i32, step: &Step<N>| {
                keep(stepper, at, unit, step);
                ended = see(stepper, at, unit, step);
                if ended.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            swing(stepper, field, (point, 0), (until, false), limits, watch)
        };
        match self.book(result) {
            Ok(point) => ended.unwrap_or_else(|| self.stopped(point)),
            Err(reason) => self.gives_up(reason),
        }
    }

    /// Joins half swings, the first on `side`, until the motion ends.
    fn half_swings<S: Stepper<HalfPlane, N>>(
        &mut self,
        mut side: Side,
        stepper: &mut S,
        limits: &Limits,
    ) -> Outcome<N> {
        let Problem { parameters, initial, until, .. } = self.found.problem;
        let (r, until, rest) = (parameters.r, N::of(until), N::of(0.0));
        let mut last = StepPoint { x: N::of(initial.q), v: N::of(initial.v) };
        let mut point = StepPoint { x: side.position(last.x, r), v: N::of(initial.v.abs()) };
        let mut unit = 0;
        loop {
            let remaining = self.time.until(until);
            if remaining <= rest {
                return Outcome::Moving { tau: until, q: last.x, v: last.v };
            }
            if self.found.crossings.len() >= MOST_CROSSINGS {
                return self.gives_up(Reason::HalfSwings { most: MOST_CROSSINGS });
            }
            let field = HalfPlane::new(&parameters, side);
            let stop = ComingToRest::of(&field, point.rounded(), N::NEGLIGIBLE);
            let stop = stop.filter(|stop| N::of(stop.duration) < remaining);
            let result = if let Some(ComingToRest { duration, .. }) = stop {
                Swing { end: Ok(point), crossed: true, duration: N::of(duration), steps: 0 }
            } else {
                let mut keep = self.keeper::<HalfPlane, S>(side, r, field);
                let watch = |stepper: &mut S, at: f64, unit: i32, step: &Step<N>| {
                    keep(stepper, at, unit, step);
                    ControlFlow::Continue(())
                };
                swing(stepper, &field, (point, unit), (remaining, true), limits, watch)
            };
            let crossed = result.crossed;
            let end = self.book(result);
            let tau = self.time.value();
            match end {
                Err(reason) => return self.gives_up(reason),
                Ok(end) if !crossed => {
                    self.path += (end.x - point.x).value();
                    let v = N::of(side.sign()) * end.v;
                    return self.stopped(StepPoint { x: side.displacement(end.x, r), v });
                }
                Ok(StepPoint { x, .. }) => {
                    let (way, q) = match stop {
                        Some(stop) => (stop.way(), last.x + N::of(side.sign() * stop.way())),
                        None => ((x - point.x).value(), side.displacement(x, r)),
                    };
                    if !q.value().is_finite() {
                        return self.gives_up(Reason::OutOfRange);
                    }
                    self.found.crossings.push(Crossing { tau, q });
                    self.path += way;
                    // The next half swing starts from its clearance, which is known more accurately than q - r.
                    let (clearance, of) = match stop {
                        Some(stop) => {
                            let passed = N::of(side.sign()) * last.x - N::of(r);
                            let (beyond, of) = stop.beyond(passed.value());
                            (N::of(beyond), of)
                        }
                        None => (x - N::of(2.0 * r), 0),
                    };
                    last = StepPoint { x: q, v: rest };
                    if clearance <= rest {
                        return Outcome::Captured { tau, q };
                    }
                    side = side.opposite();
                    (point, unit) = (StepPoint { x: -clearance, v: rest }, of);
                }
            }
        }
    }

    /// What is to be done for each step on a side whose centre is displaced by `shift`: keeps points for drawing and
    /// adds up the work.
    fn keeper<F: Field, S: Stepper<F, N>>(
        &mut self,
        side: Side,
        shift: f64,
        field: HalfPlane,
    ) -> impl FnMut(&mut S, f64, i32, &Step<N>) {
        let (detail, time) = (self.detail, self.time);
        let (samples, works) = (&mut self.found.samples, &mut self.works);
        move |stepper, at, unit, step| {
            if detail.samples_per_step > 0 {
                sample(stepper, step, detail.samples_per_step, |offset, point| {
                    samples.push(Sample {
                        tau: time.plus(N::of(at + offset)).value(),
                        q: side.displacement(times_power(point.x, unit), shift),
                        v: side.sign() * times_power(point.v, unit),
                    });
                });
            }
            if detail.energy {
                add_works(works, &stepper.powers(), &field, unit);
            }
        }
    }

    /// Records steps and time; returns how the piece ended.
    fn book(&mut self, piece: Swing<N>) -> Result<StepPoint<N>, Reason> {
        self.found.cost.steps += piece.steps;
        self.time.add(piece.duration);
        piece.end
    }

    /// The motion at its end time.
    fn stopped(&self, StepPoint { x: q, v }: StepPoint<N>) -> Outcome<N> {
        if q.value().is_finite() && v.value().is_finite() {
            Outcome::Moving { tau: N::of(self.found.problem.until), q, v }
        } else {
            self.gives_up(Reason::OutOfRange)
        }
    }
}

impl MotionRun {
    /// Takes steps that ignore `v = 0`, as the methods do that are included for comparison, and counts sign changes
    /// of the velocity as crossings.
    ///
    /// `sticks` says whether a motion that this method brings to `v = 0` inside the sticking set stays there.
    /// Positions at crossings assume a velocity that is linear within the step.
    pub fn walk<F: PlaneField, S: Stepper<F>>(
        mut self,
        stepper: &mut S,
        field: &F,
        sticks: bool,
        limits: &Limits,
    ) -> Trajectory {
        let Problem { parameters, initial, .. } = self.found.problem;
        let mut crossings = Vec::new();
        let mut path = 0.0;
        let mut from = StepPoint { x: initial.q, v: initial.v };
        let see = |_: &mut S, at: f64, unit: i32, step: &Step| {
            let end = step.end.times_power(unit);
            let (tau, start) = (at + step.duration, std::mem::replace(&mut from, end));
            let mut turn = None;
            if start.v != 0.0 && start.v.signum() * end.v <= 0.0 {
                let part = start.v / (start.v - end.v);
                let q = start.x + 0.5 * part * step.duration * start.v;
                crossings.push(Crossing { tau: at + part * step.duration, q });
                turn = Some(q);
            }
            // The path within the step, out and back where the velocity changes sign.
            let turn = turn.unwrap_or(start.x);
            path += (turn - start.x).abs() + (end.x - turn).abs();
            if tau == at {
                let reason = Reason::StepTooSmall { step: step.duration };
                return Some(Outcome::GaveUp { tau, reason });
            }
            if crossings.len() >= MOST_CROSSINGS {
                let reason = Reason::HalfSwings { most: MOST_CROSSINGS };
                return Some(Outcome::GaveUp { tau, reason });
            }
            let stays = sticks && rests(State { q: end.x, v: end.v }, parameters.r);
            stays.then_some(Outcome::Captured { tau, q: end.x })
        };
        let outcome = if sticks && rests(initial, parameters.r) {
            self.rests()
        } else {
            self.glide(stepper, field, limits, see)
        };
        self.found.crossings = crossings;
        self.path = path;
        self.close(outcome, stepper.cost())
    }
}

/// Adds the work of the damping terms over one step measured in units of `2^unit`.
fn add_works(works: &mut [f64; 3], powers: &Powers, field: &HalfPlane, unit: i32) {
    let HalfPlane { d, d2, d3 } = field.in_units(unit);
    let rates = [-2.0 * d * powers.second, -d2 * powers.third, -d3 * powers.fourth];
    for (work, rate) in works.iter_mut().zip(rates) {
        *work += times_power(times_power(rate, unit), unit);
    }
}

/// Passes evenly spaced points of a step to `keep`, including its end but not its start.
///
/// Near the largest numbers, a position measured from the centre of its spiral may overflow, and so may the
/// polynomial of a step between two finite points. Points that are not finite are left out.
fn sample<N: Scalar, F: Field, S: Stepper<F, N>>(
    stepper: &mut S,
    step: &Step<N>,
    count: usize,
    mut keep: impl FnMut(f64, StepPoint),
) {
    let duration = step.duration.value();
    let mut keep_number = |offset, point: StepPoint| {
        if point.x.is_finite() && point.v.is_finite() {
            keep(offset, point);
        }
    };
    let count = count * stepper.pieces();
    for index in 1..count {
        let offset = duration * (real(index) / real(count));
        keep_number(offset, stepper.at(offset));
    }
    keep_number(duration, step.end.rounded());
}

#[cfg(test)]
mod tests;
