//! What yields a model: the equation of the paper, a mass on a belt or a vibration mode, whose numbers are set and varied
//! alike; and how exactly these are known.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Belt, Group, Interval, KNOBS, Knob, Mode, Model, ParameterBox, Parameters, Result};

/// The oscillator of the paper, a mass on a belt, or a vibration mode.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// The oscillator of the paper, with a mass and a stiffness of one.
    Paper(Parameters),
    /// A mass on a belt.
    Belt(Box<Belt>),
    /// A vibration mode.
    Mode(Mode),
}

/// What yields a model, and how exactly it is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// What it is.
    pub body: Body,
    /// Size of the last terms of each Taylor step, relative to the state; `None`: below rounding.
    pub tolerance: Option<f64>,
}

impl From<Body> for Source {
    fn from(body: Body) -> Self {
        Source { body, tolerance: None }
    }
}

impl From<&Belt> for Source {
    fn from(belt: &Belt) -> Self {
        Body::Belt(Box::new(belt.clone())).into()
    }
}

impl Source {
    /// Gives a number a value, in SI units unless it is one of the paper.
    ///
    /// # Errors
    /// One line, if it has no such number.
    pub fn set(&mut self, knob: Knob, value: f64) -> Result<(), String> {
        match &mut self.body {
            Body::Paper(parameters) if knob.is_parameter() => {
                *parameters = parameters.with(knob, value);
                Ok(())
            }
            Body::Paper(_) => Err(format!("no {knob} here; there are D, D2, D3, r")),
            Body::Belt(belt) => knob.set_in_belt(belt, value),
            Body::Mode(mode) => knob.write(mode, |row| row.mode, value),
        }
    }

    /// One of its numbers, in SI units; `None` if it has none such.
    #[must_use]
    pub fn get(&self, knob: Knob) -> Option<f64> {
        match &self.body {
            Body::Paper(parameters) => knob.is_parameter().then(|| parameters.value(knob)),
            Body::Belt(belt) => knob.of_belt(belt),
            Body::Mode(mode) => (knob.spec().mode?.get)(mode),
        }
    }

    /// Its numbers, with their values in SI units.
    pub fn numbers(&self) -> impl Iterator<Item = (Knob, f64)> + '_ {
        KNOBS.iter().filter_map(|row| Some((row.knob, self.get(row.knob)?)))
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
        // The oscillator of the paper has no other friction at rest.
        let (mut other, mut none) = (self.clone(), None);
        let (moving, at_rest) = match &mut other.body {
            Body::Paper(parameters) => (&mut parameters.r, &mut none),
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
        if let Body::Belt(belt) = &self.body {
            Some(belt)
        } else {
            None
        }
    }

    /// Its whole model.
    ///
    /// # Errors
    /// [`Reason`](crate::model::Reason) where it has none.
    pub fn model(&self) -> Result<Model> {
        let mut model = match &self.body {
            Body::Paper(parameters) => Model::of_paper(parameters)?,
            Body::Belt(belt) => Model::new(belt)?,
            Body::Mode(mode) => mode.model()?,
        };
        model.tolerance = self.tolerance.unwrap_or(model.tolerance);
        Ok(model)
    }
}

// Numbers that are known to tolerances only, on a floor that shakes.

/// By how much numbers may differ from their values, and the force that disturbs the mass.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tolerances {
    /// Half widths in the units of the numbers, by name.
    pub half_widths: BTreeMap<String, f64>,
    /// Bound on a force that varies in any way, in N or in the units of r.
    pub disturbance: f64,
}

impl Tolerances {
    /// Whether everything is known exactly and nothing disturbs.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.disturbance == 0.0 && self.half_widths.values().all(|half| *half == 0.0)
    }

    /// Where a number lies; `None` where the machine has no such number.
    #[must_use]
    pub fn interval(&self, varied: Knob, belt: &Belt) -> Option<Interval> {
        let half = *self.half_widths.get(varied.spec().name).unwrap_or(&0.0);
        Some(Interval::around(varied.of_belt(belt)?, half))
    }

    /// The numbers that are not known exactly, with their ends.
    #[must_use]
    pub fn intervals(&self, belt: &Belt) -> Vec<(Knob, Interval)> {
        let known = |varied: Knob| Some((varied, self.interval(varied, belt)?));
        let all = KNOBS.iter().filter_map(|row| known(row.knob));
        all.filter(|(_, interval)| !interval.is_point()).collect()
    }

    /// The machine with the largest friction and damping; `None` where other numbers are uncertain, of which
    /// no end is the best at every velocity.
    #[must_use]
    pub fn best(&self, belt: &Belt) -> Option<Belt> {
        let mut best = belt.clone();
        for (varied, interval) in self.intervals(belt) {
            if !MONOTONE.contains(&varied) {
                return None;
            }
            set(&mut best, varied, interval.upper());
        }
        if self.disturbance > 0.0 {
            let stronger = |force: f64| (force + self.disturbance).next_up();
            best.static_guide = best.static_guide.map(stronger);
            best.friction = stronger(best.friction);
        }
        best.static_guide = best.static_guide.map(|at_rest| at_rest.max(best.friction));
        Some(best)
    }

    /// The box of parameters of the oscillator of the paper around these; friction is never negative.
    pub fn around(&self, parameters: &Parameters) -> ParameterBox {
        let half = |knob: Knob| Some((knob, *self.half_widths.get(knob.spec().name)?));
        ParameterBox::around(parameters, Knob::PARAMETERS.into_iter().filter_map(half))
    }

    /// Checks that every number has its tolerance within its range.
    ///
    /// # Errors
    /// One line that says what is allowed.
    pub fn check(&self, belt: &Belt) -> Result<(), String> {
        for (name, half) in &self.half_widths {
            let knob = Knob::named(name, Group::SOURCE)?;
            let ends = knob.of_belt(belt).map(|value| [value - half, value + half]);
            for end in ends.into_iter().flatten() {
                knob.check(end)?;
            }
        }
        Ok(())
    }
}

/// Numbers of which the smallest value is the worst at every velocity: friction and damping.
pub const MONOTONE: [Knob; 4] =
    [Knob::Friction, Knob::Damping, Knob::CubicDamping, Knob::StaticGuide];

/// Gives a machine the value of a number that it has.
pub fn set(belt: &mut Belt, varied: Knob, value: f64) {
    let set = varied.set_in_belt(belt, value);
    debug_assert!(set.is_ok(), "only numbers of the machine have intervals: {set:?}");
}
