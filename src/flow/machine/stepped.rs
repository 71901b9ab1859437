//! A motion by an explicit Runge-Kutta method in place of Taylor series: a second opinion that shares with the
//! first the model and what happens at its lines, but neither the steps nor the search for the lines.

use super::arc::LostMotion;
use super::motion::{Leg, MachineState};
use super::turn::ContactState;
use crate::flow::explicit::{Dop853, Dopri5};
use crate::flow::step::{Field, Step, StepPoint, Stepper};
use crate::flow::{Fate, Method};
use crate::model::{Model, Phase};
use crate::numerics::root::bisect;

/// The methods that can follow a machine beside Taylor series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SteppedMethod {
    /// Dormand and Prince's pair of order 8.
    Dop853,
    /// Dormand and Prince's pair of order 5.
    Dopri5,
}

/// The methods that can follow a machine.
pub const ALLOWED: &str = "auto, taylor, dop853 and dopri5";

/// A method that knows one switching line only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OneLine;

impl SteppedMethod {
    /// The way of a method; `None` for Taylor series. Fails with [`OneLine`] for a method that cannot follow a
    /// machine; [`ALLOWED`] tells which can.
    pub fn of(method: Method) -> Result<Option<SteppedMethod>, OneLine> {
        match method {
            Method::Auto | Method::Taylor => Ok(None),
            Method::Dop853 => Ok(Some(SteppedMethod::Dop853)),
            Method::Dopri5 => Ok(Some(SteppedMethod::Dopri5)),
            _ => Err(OneLine),
        }
    }

    /// The method itself.
    pub fn method(self) -> Method {
        match self {
            SteppedMethod::Dop853 => Method::Dop853,
            SteppedMethod::Dopri5 => Method::Dopri5,
        }
    }

    pub fn name(self) -> &'static str {
        self.method().spec().name
    }
}

/// The end of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteppedEnd {
    /// Where it ends, or how far it was followed.
    pub end: MachineState,
    /// How it ends.
    pub outcome: Fate<LostMotion>,
    /// Evaluations of the force.
    pub evaluations: u64,
}

/// The field of one phase about its balance.
#[derive(Clone, Copy)]
struct Slope<'a> {
    model: &'a Model,
    phase: Phase,
}

impl Field for Slope<'_> {
    fn acceleration(&self, x: f64, v: f64) -> f64 {
        self.model.force(self.phase, v).0 - x
    }

    fn divergence(&self, v: f64) -> f64 {
        self.model.force(self.phase, v).1
    }

    fn magnitude(&self, x: f64, v: f64) -> f64 {
        x.abs() + self.model.force(self.phase, v).0.abs()
    }
}

/// Longest step, in `1/omega_0`: a small fraction of a swing, in which the velocity turns once at most.
const LONGEST: f64 = 0.125;

/// Halvings that narrow an event to rounding.
const HALVINGS: u32 = 60;

/// Maximum number of steps of a motion.
const STEPS: u64 = 2_000_000;

/// A motion as its steps.
#[derive(Clone, Debug)]
pub struct SteppedMotion {
    /// Its legs in their order.
    pub legs: Vec<Leg>,
    /// The states between its steps.
    pub samples: Vec<MachineState>,
    /// How it ends.
    pub outcome: Fate<LostMotion>,
    /// Evaluations of the force.
    pub evaluations: u64,
    /// Steps taken.
    pub steps: u64,
}

/// Follows a motion from displacement `x` (m) and velocity `v` (m/s) for `until` seconds; each step has an
/// estimated relative error below `tolerance`. Fails with [`LostMotion`] where it leaves the law, escapes, or needs
/// too many steps.
pub fn stepped(
    model: &Model,
    way: SteppedMethod,
    tolerance: f64,
    start: (f64, f64),
    until: f64,
) -> Result<SteppedEnd, LostMotion> {
    let SteppedMotion { samples, outcome, evaluations, .. } =
        traced(model, way, tolerance, start, until);
    match (outcome, samples.last()) {
        (Fate::Unknown(stop), _) => Err(stop),
        (Fate::Escapes, _) => Err(LostMotion::Escaped),
        (_, Some(end)) => Ok(SteppedEnd { end: *end, outcome, evaluations }),
        (_, None) => Err(LostMotion::Steps),
    }
}

/// The same with all of its steps, as far as it can be followed.
pub fn traced(
    model: &Model,
    way: SteppedMethod,
    tolerance: f64,
    (x, v): (f64, f64),
    until: f64,
) -> SteppedMotion {
    let start = (x, model.scaled_velocity(v));
    let field = Slope { model, phase: Phase::Between };
    match way {
        SteppedMethod::Dop853 => follow(Dop853::dop853(field, tolerance), model, start, until),
        SteppedMethod::Dopri5 => follow(Dopri5::dopri5(field, tolerance), model, start, until),
    }
}

/// Collects a motion until its time is up.
struct Trace<'a> {
    model: &'a Model,
    whole: f64,
    left: f64,
    steps: u64,
    samples: Vec<MachineState>,
}

impl Trace<'_> {
    fn t(&self) -> f64 {
        (self.whole - self.left.max(0.0)) / self.model.omega_0
    }

    fn comes(&mut self, x: f64, y: f64) {
        let state = MachineState { t: self.t(), x, v: y * self.model.omega_0 };
        self.samples.push(state);
    }
}

fn follow<'a>(
    mut stepper: impl Stepper<Slope<'a>>,
    model: &'a Model,
    (mut x, mut y): (f64, f64),
    until: f64,
) -> SteppedMotion {
    let whole = until * model.omega_0;
    let mut trace = Trace { model, whole, left: whole, steps: 0, samples: Vec::new() };
    trace.comes(x, y);
    let mut legs = Vec::new();
    let mut place = model.place(x, y);
    let outcome = loop {
        if trace.left <= 0.0 {
            break Fate::Moving;
        }
        legs.push(Leg { place, t: trace.t(), x });
        let phase = match place {
            ContactState::Rests => break Fate::Rest,
            ContactState::Slips(phase) => phase,
            ContactState::Sticks => {
                let release = model.lines.map_or(x, |lines| lines.release);
                let ride = (release - x) / model.speed;
                let rides = ride <= trace.left;
                x = if rides { release } else { x + trace.left * model.speed };
                trace.left -= ride;
                trace.comes(x, y);
                place = ContactState::Slips(Phase::Between);
                continue;
            }
        };
        match arc(&mut stepper, Slope { model, phase }, (x, y), &mut trace) {
            Ok(end) => (x, y) = end,
            Err(stop) => break stop.into(),
        }
        place = model.place(x, y);
    };
    let Trace { samples, steps, .. } = trace;
    SteppedMotion { legs, samples, outcome, evaluations: stepper.evaluations(), steps }
}

/// Follows a motion to the end of its phase, or until no time is left.
fn arc<'a>(
    stepper: &mut impl Stepper<Slope<'a>>,
    field: Slope<'a>,
    (x, y): (f64, f64),
    trace: &mut Trace,
) -> Result<(f64, f64), LostMotion> {
    let Slope { model, phase } = field;
    let offset = model.offset(phase);
    let mut from = StepPoint { x: x + offset, v: y };
    let (least, most) = model.range(phase);
    let pieces = &model.side(phase).pieces;
    let low = pieces.first().map_or(f64::INFINITY, |piece| piece.low);
    let high = pieces.last().map_or(f64::NEG_INFINITY, |piece| piece.high);
    // What has just been released is not faster than the belt, whatever rounding says.
    let mut leaves = phase == Phase::Between && from.v == most;
    stepper.begin(&field);
    while trace.left > 0.0 {
        trace.steps += 1;
        if trace.steps > STEPS {
            return Err(LostMotion::Steps);
        }
        let step = stepper.pass(from, LONGEST.min(trace.left)).map_err(|_| LostMotion::Escaped)?;
        let outer = if leaves { f64::INFINITY } else { most };
        let hit = hit(stepper, field, (from, &step), (least, outer));
        leaves = false;
        if let Some((time, level)) = hit {
            let last = stepper.pass(from, time).map_err(|_| LostMotion::Escaped)?;
            trace.left -= last.duration;
            if last.duration >= time {
                let end = (last.end.x - offset, level);
                trace.comes(end.0, end.1);
                return Ok(end);
            }
            // The shorter step was refused: it ends before the line.
            from = StepPoint { x: last.end.x, v: last.end.v.clamp(least, most) };
            trace.comes(from.x - offset, from.v);
            continue;
        }
        trace.left -= step.duration;
        from = StepPoint { x: step.end.x, v: step.end.v.clamp(least, most) };
        trace.comes(from.x - offset, from.v);
        if !(low..=high).contains(&from.v) {
            let end = if from.v < low { low } else { high };
            return Err(LostMotion::OutsideLaw { slip: (model.speed - end).abs() * model.omega_0 });
        }
    }
    Ok((from.x - offset, from.v))
}

/// When a step first reaches one of the two levels that bound its phase, and which.
fn hit<'a>(
    stepper: &mut impl Stepper<Slope<'a>>,
    field: Slope<'a>,
    (from, step): (StepPoint, &Step),
    (least, most): (f64, f64),
) -> Option<(f64, f64)> {
    let sign = field.phase.sign();
    let (outer, inner) = if sign > 0.0 { (most, least) } else { (least, most) };
    let grows = |at: StepPoint| sign * field.acceleration(at.x, at.v) > 0.0;
    let beyond = |at: StepPoint, level: f64| sign * (at.v - level) >= 0.0;
    let turns = grows(from) && !grows(step.end);
    let falls = !beyond(step.end, inner) || step.end.v == inner;
    if !turns && !falls && !beyond(step.end, outer) {
        return None;
    }
    stepper.prepare_dense();
    let end = step.duration;
    let first = |from: f64, to: f64, holds: &dyn Fn(StepPoint) -> bool| {
        bisect(from, to, HALVINGS, |time| holds(stepper.at(time))).1
    };
    let peak = if turns { first(0.0, end, &|at| !grows(at)) } else { end };
    if beyond(stepper.at(peak), outer) {
        return Some((first(0.0, peak, &|at| beyond(at, outer)), outer));
    }
    let start = if turns { peak } else { 0.0 };
    falls.then(|| (first(start, end, &|at| !beyond(at, inner)), inner))
}
