//! An arc by an explicit Runge-Kutta method in place of Taylor series: a second opinion that shares with the first
//! the model, what happens at its lines and how they are found, but not the steps.

use super::arc::{ArcEnd, Flow, crossing};
use super::curve::MachineStep;
use super::series::PhaseSeries;
use crate::flow::Method;
use crate::flow::explicit::{Dop853, Dopri5};
use crate::flow::step::{Field, StepPoint, Stepper};
use crate::flow::tableau::{dop853, dopri5};
use crate::model::{ContactState, Model, Phase, Reason};
use crate::numerics::elementary::ln;

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

impl<'a> Flow<'a> {
    /// Follows a motion to the end of its phase, or until no time is left. Fails with [`Reason`] where it leaves the
    /// law, escapes, or needs too many steps.
    pub(super) fn stepped(
        &mut self,
        stepper: &mut PhaseStepper<'a>,
        phase: Phase,
        (x, y): (f64, f64),
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<ArcEnd, Reason> {
        let model = self.model;
        let (field, offset) = (PhaseField { model, phase }, model.offset(phase));
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
            let longest = LONGEST.min(self.series.left);
            let mut step = stepper.advance(from, longest, false).map_err(|_| Reason::Escapes)?;
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
            let mut reached = None;
            if let Some((time, level)) = hit {
                step = stepper.advance(from, time, false).map_err(|_| Reason::Escapes)?;
                // Where the shorter step was refused, it ends before the line.
                reached = (step.duration >= time).then_some(level);
            }
            outer = high;
            let y = reached.unwrap_or(step.end.v.clamp(least, most));
            from = StepPoint { x: step.end.x, v: y };
            let x = from.x - offset;
            // Its end stands for the step: it has no series.
            let end = MachineStep::even(ContactState::Slips(phase), [x, 0.0], y);
            self.passes(MachineStep { duration: step.duration, ..end }, watch);
            if reached.is_some() && (y == least || y == most) {
                let log_ratio = ln((entered / field.acceleration(from.x, y)).abs());
                return Ok(ArcEnd { x, y, log_ratio });
            }
            if reached.is_some() {
                return Err(self.outside(y));
            }
            if self.series.left <= 0.0 {
                return Err(Reason::Settles);
            }
        }
        Err(Reason::Steps)
    }
}
