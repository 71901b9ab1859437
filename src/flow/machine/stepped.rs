//! An arc by an explicit Runge-Kutta method in place of Taylor series: a second opinion that shares with the first
//! the model, what happens at its lines and how they are found, but not the steps.

use super::MachineStep;
use super::levels::{PhaseStep, crossing};
use crate::flow::{DOP853, DOPRI5, ExplicitStepper, Method, StepPoint, Stepper};
use crate::model::{ContactState, Field, Model, Phase, Reason, Result};

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
}

/// A stepper of a machine's phases.
pub(crate) type PhaseStepper<'a> = Box<dyn Stepper<PhaseField<'a>> + 'a>;

/// The stepper of a method; `None` for Taylor series, which have their own.
pub(crate) fn stepper(model: &Model, method: Method) -> Option<PhaseStepper<'_>> {
    let field = PhaseField { model, phase: Phase::Between };
    match method {
        Method::Dop853 => Some(Box::new(ExplicitStepper::new(&DOP853, field, model.tolerance))),
        Method::Dopri5 => Some(Box::new(ExplicitStepper::new(&DOPRI5, field, model.tolerance))),
        _ => None,
    }
}

/// Longest step, in `1/omega_0`: a small fraction of a swing, in which the velocity turns once at most.
const LONGEST: f64 = 0.125;

/// Maximum number of steps of a motion.
pub(crate) const STEPS: u64 = 2_000_000;

/// A step of a stepper from this point, for the time `left` at most; a mass that has `just` entered the phase may have been
/// released by the belt.
pub(super) fn pair_step(
    stepper: &mut PhaseStepper,
    field: PhaseField,
    from: StepPoint,
    (left, just): (f64, bool),
) -> Result<PhaseStep> {
    let PhaseField { model, phase } = field;
    let (least, most) = model.range(phase);
    let pieces = &model.side(phase).pieces;
    let low = pieces.first().map_or(f64::INFINITY, |piece| piece.low).max(least);
    let high = pieces.last().map_or(f64::NEG_INFINITY, |piece| piece.high).min(most);
    // What has just been released is not faster than the belt, whatever rounding says.
    let released = just && phase == Phase::Between && from.v == most;
    let outer = if released { f64::INFINITY } else { high };
    let mut step = stepper.advance(from, LONGEST.min(left), false).map_err(|_| Reason::Escapes)?;
    // The ends of the step are known, the rest takes evaluations.
    let velocity = |t: f64| {
        let point = if t == 0.0 {
            from
        } else if t == step.duration {
            step.end
        } else {
            stepper.at(t)
        };
        (point.v, field.acceleration(point.x, point.v))
    };
    let turning = |t: f64| {
        let (velocity, slope) = velocity(t);
        (slope, field.divergence(velocity) * slope - velocity)
    };
    let (_, hit) = crossing(phase, step.duration, (low, outer), &velocity, &turning);
    let mut level = None;
    if let Some((time, reached)) = hit {
        step = stepper.advance(from, time, false).map_err(|_| Reason::Escapes)?;
        // Where the shorter step was refused, it ends before the line.
        level = (step.duration >= time).then_some(reached);
    }
    let end = StepPoint { v: level.unwrap_or(step.end.v.clamp(least, most)), ..step.end };
    // Its end stands for the step: it has no series.
    let place = [end.x - model.offset(phase), 0.0];
    Ok(PhaseStep {
        step: MachineStep::even(ContactState::Slips(phase), step.duration, place, end.v),
        end,
        slopes: (field.acceleration(from.x, from.v), field.acceleration(end.x, end.v)),
        level: level.map(|level| (level, true)),
    })
}
