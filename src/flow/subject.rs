//! What a question is about: the oscillator of the paper, a mass on a belt or a vibration mode, how exactly its numbers
//! are known, and one motion of it.

use super::trajectory::trajectory;
use super::{Detail, Limits, Method, Motion, MotionUnits, Problem, Result, follow};
use crate::model::{Body, Group, Knob, Model, Source, State, Tolerances};

/// What a question is about; of the paper's oscillator without units, of all else in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    /// What moves.
    pub source: Source,
    /// How exactly its numbers are known, and what disturbs it.
    pub tolerances: Tolerances,
    /// One motion of it, whose parameters do not count; a machine is followed by Taylor series, to the accuracy of its
    /// source.
    pub motion: Problem,
}

impl From<Problem> for Subject {
    fn from(motion: Problem) -> Self {
        let source = Body::Paper(motion.parameters).into();
        Subject { source, tolerances: Tolerances::default(), motion }
    }
}

impl Subject {
    /// What can be set of a machine or a mode and its motion.
    pub const GROUPS: &[Group] = &[Group::Machine, Group::Law, Group::Mode, Group::Course];

    /// A machine or a mode that moves from displacement (m) and velocity (m/s), for some seconds.
    #[must_use]
    pub fn moving(source: Source, tolerances: Tolerances, (q, v): (f64, f64), until: f64) -> Self {
        let motion = Problem { initial: State { q, v }, until, ..Problem::default() };
        Subject { source, tolerances, motion }
    }

    /// Displacement (m) and velocity (m/s) at the start.
    #[must_use]
    pub fn start(&self) -> (f64, f64) {
        (self.motion.initial.q, self.motion.initial.v)
    }

    /// The motion of the oscillator of the paper; `None` of a machine or a mode.
    #[must_use]
    pub fn paper(&self) -> Option<Problem> {
        let Body::Paper(parameters) = self.source.body else { return None };
        Some(Problem { parameters, ..self.motion })
    }

    /// Gives a number a value, in SI units unless it is one of the paper.
    ///
    /// # Errors
    /// One line, if there is no such number.
    pub fn set(&mut self, knob: Knob, value: f64) -> Result<(), String> {
        *match knob {
            Knob::Q0 | Knob::X => &mut self.motion.initial.q,
            Knob::V0 | Knob::V => &mut self.motion.initial.v,
            Knob::Until | Knob::Duration => &mut self.motion.until,
            Knob::Disturbance | Knob::DisturbingForce => &mut self.tolerances.disturbance,
            _ => return self.source.set(knob, value),
        } = value;
        Ok(())
    }

    /// The motion as a problem, and the model that moves, unless that is the oscillator of the paper.
    ///
    /// # Errors
    /// [`Reason`](crate::model::Reason) where a machine has no model.
    pub fn problem(&self) -> Result<(Problem, Option<Model>)> {
        if let Some(problem) = self.paper() {
            return Ok((problem, None));
        }
        let model = self.source.model()?;
        let (method, tolerance) = (Method::Taylor, model.tolerance);
        Ok((Problem { method, tolerance, ..self.motion }, Some(model)))
    }
}

impl Problem {
    /// The motion of the oscillator of the paper, or of a machine in SI units, which is never interrupted.
    pub fn followed(&self, model: Option<&Model>, detail: Detail, limits: &Limits) -> Motion {
        match model {
            Some(model) => follow(model, self, MotionUnits::physical(model), detail),
            None => trajectory(self, detail, limits),
        }
    }
}
