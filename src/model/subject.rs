//! The subject of a question: a mass on a belt or a vibration mode, whose numbers are set and varied alike.

use super::model::{Model, NoModel};
use crate::model::{Belt, KNOBS, Knob, Modal};

/// A mass on a belt, or a vibration mode.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A mass on a belt.
    Belt(Box<Belt>),
    /// A vibration mode.
    Mode(Modal),
}

/// The subject of a question, and how exactly it is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    /// What it is.
    pub body: Body,
    /// Size of the last terms of each Taylor step, relative to the state; `None`: below rounding.
    pub tolerance: Option<f64>,
}

impl From<Body> for Subject {
    fn from(body: Body) -> Self {
        Subject { body, tolerance: None }
    }
}

impl From<&Belt> for Subject {
    fn from(belt: &Belt) -> Self {
        Body::Belt(Box::new(belt.clone())).into()
    }
}

impl Subject {
    /// Gives a number a value in SI units.
    ///
    /// # Errors
    /// One line, if it has no such number.
    pub fn set(&mut self, knob: Knob, value: f64) -> Result<(), String> {
        match &mut self.body {
            Body::Belt(belt) => knob.set_in_belt(belt, value),
            Body::Mode(mode) => knob.set_in_mode(mode, value),
        }
    }

    /// Its numbers, with their values in SI units.
    pub fn numbers(&self) -> impl Iterator<Item = (Knob, f64)> + '_ {
        let value = |knob: Knob| match &self.body {
            Body::Belt(belt) => knob.of_belt(belt),
            Body::Mode(mode) => knob.of_mode(mode),
        };
        KNOBS.iter().filter_map(move |row| Some((row.knob, value(row.knob)?)))
    }

    /// The same with a number at another value.
    ///
    /// # Errors
    /// One line, if it has no such number.
    pub fn with(&self, knob: Knob, value: f64) -> Result<Self, String> {
        let mut other = self.clone();
        other.set(knob, value)?;
        Ok(other)
    }

    /// The same with other friction of the guide, in N, which at rest is at least that.
    #[must_use]
    pub fn with_friction(&self, friction: f64) -> Self {
        let mut other = self.clone();
        let (moving, at_rest) = match &mut other.body {
            Body::Belt(belt) => (&mut belt.friction, &mut belt.static_guide),
            Body::Mode(mode) => (&mut mode.friction, &mut mode.static_guide),
        };
        *moving = friction;
        *at_rest = at_rest.map(|at_rest| at_rest.max(friction));
        other
    }

    /// The mass on a belt, if it is one.
    #[must_use]
    pub fn of_belt(&self) -> Option<&Belt> {
        match &self.body {
            Body::Belt(belt) => Some(belt),
            Body::Mode(_) => None,
        }
    }

    /// The friction of its guide, in N.
    #[must_use]
    pub fn friction(&self) -> f64 {
        match &self.body {
            Body::Belt(belt) => belt.friction,
            Body::Mode(mode) => mode.friction,
        }
    }

    /// Its whole model.
    ///
    /// # Errors
    /// [`NoModel`] where it has none.
    pub fn model(&self) -> Result<Model, NoModel> {
        let mut model = match &self.body {
            Body::Belt(belt) => Model::new(belt)?,
            Body::Mode(mode) => mode.model()?,
        };
        model.tolerance = self.tolerance.unwrap_or(model.tolerance);
        Ok(model)
    }
}
