//! An arc by an explicit Runge-Kutta method in place of Taylor series: a second opinion that shares with the first
//! the model, what happens at its lines and how they are found, but not the steps.

use super::arc::{ArcEnd, StepInside, Watch, crossing};
use crate::flow::Method;
use crate::flow::explicit::{Dop853, Dopri5};
use crate::flow::step::{Field, Step, StepPoint, Stepper};
use crate::flow::tableau::{dop853, dopri5};
use crate::model::{Model, Phase, Reason};
use crate::numerics::root::{Bracket, PlaceTolerance, newton};

/// The methods that can follow a machine.
pub const ALLOWED: &str = "auto, taylor, dop853 and dopri5";

/// The field of one phase about its balance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PhaseField<'a> {
    pub model: &'a Model,
    pub phase: Phase,
}

impl Field for PhaseField<'_> {
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

/// A stepper of a machine's phases.
pub(crate) type PhaseStepper<'a> = Box<dyn Stepper<PhaseField<'a>> + 'a>;

/// The stepper of a method; `None` for Taylor series, which have their own.
pub(crate) fn stepper(model: &Model, method: Method) -> Option<PhaseStepper<'_>> {
    let field = PhaseField { model, phase: Phase::Between };
    match method {
        Method::Dop853 => Some(Box::new(Dop853::new(&dop853::SCHEME, field, model.tolerance))),
        Method::Dopri5 => Some(Box::new(Dopri5::new(&dopri5::SCHEME, field, model.tolerance))),
        _ => None,
    }
}

/// Longest step, in `1/omega_0`: a small fraction of a swing, in which the velocity turns once at most.
const LONGEST: f64 = 0.125;

/// Maximum number of steps of a motion.
pub(crate) const STEPS: u64 = 2_000_000;

/// The last step of a stepper. Its ends are known, the rest takes evaluations.
struct LastStep<'s, 'a> {
    stepper: &'s PhaseStepper<'a>,
    field: PhaseField<'a>,
    from: StepPoint,
    step: Step,
}

impl StepInside for LastStep<'_, '_> {
    fn velocity(&mut self, t: f64) -> (f64, f64) {
        let StepPoint { x, v } = if t == 0.0 {
            self.from
        } else if t == self.step.duration {
            self.step.end
        } else {
            self.stepper.at(t)
        };
        (v, self.field.acceleration(x, v))
    }

    fn turning(&mut self, end: f64) -> f64 {
        let bracket = Bracket { low: 0.0, high: end, rising: self.velocity(0.0).1 < 0.0 };
        // Where the velocity is flat, an error e in time costs only e^2 in it.
        newton(bracket, 0.5 * end, PlaceTolerance::Absolute(1e-9 * end), |t| {
            let (velocity, slope) = self.velocity(t);
            (slope, self.field.divergence(velocity) * slope - velocity)
        })
        .at
    }
}

/// Follows a motion to the end of its phase, or until no time is left. Fails with [`Reason`] where it leaves the
/// law, escapes, or needs too many steps.
pub(crate) fn stepped<'a>(
    stepper: &mut PhaseStepper<'a>,
    field: PhaseField<'a>,
    (x, y): (f64, f64),
    watch: &mut impl Watch,
) -> Result<ArcEnd, Reason> {
    let PhaseField { model, phase } = field;
    let offset = model.offset(phase);
    let (least, most) = model.range(phase);
    let pieces = &model.side(phase).pieces;
    let low = pieces.first().map_or(f64::INFINITY, |piece| piece.low).max(least);
    let high = pieces.last().map_or(f64::NEG_INFINITY, |piece| piece.high).min(most);
    let mut from = StepPoint { x: x + offset, v: y };
    let entered = field.acceleration(from.x, from.v);
    // What has just been released is not faster than the belt, whatever rounding says.
    let mut outer = if phase == Phase::Between && y == most { f64::INFINITY } else { high };
    stepper.begin(&field);
    for _ in 0..STEPS {
        let longest = LONGEST.min(watch.left());
        let mut step = stepper.advance(from, longest, false).map_err(|_| Reason::Escapes)?;
        let inside = LastStep { stepper, field, from, step };
        let mut reached = None;
        if let Some((time, level)) = crossing(inside, phase, step.duration, (low, outer)).hit {
            step = stepper.advance(from, time, false).map_err(|_| Reason::Escapes)?;
            // Where the shorter step was refused, it ends before the line.
            reached = (step.duration >= time).then_some(level);
        }
        outer = high;
        let y = reached.unwrap_or(step.end.v.clamp(least, most));
        from = StepPoint { x: step.end.x, v: y };
        let x = from.x - offset;
        watch.passes(step.duration, (x, y));
        if reached.is_some() && (y == least || y == most) {
            let accelerations = (entered, field.acceleration(from.x, y));
            return Ok(ArcEnd { x, on_belt: y != 0.0, accelerations });
        }
        if reached.is_some() {
            return Err(Reason::BeyondLaw { slip: (model.speed - y).abs() * model.omega_0 });
        }
        if watch.left() <= 0.0 {
            return Err(Reason::Settles);
        }
    }
    Err(Reason::Steps)
}
