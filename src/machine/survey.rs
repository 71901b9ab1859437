//! Everything that is said about a machine: its portrait, one motion of it, and beside it what the oscillator
//! of the paper says, which knows friction by its cubic expansion alone.

use std::fmt;

use super::arc::{Flow, Stop};
use super::model::{Model, Unfit};
use super::motion::Motion;
use super::portrait::{Fate, Portrait};
use crate::flow::{Limits, Reason};
use crate::oscillator::Belt;
use crate::oscillator::belt::{BeltError, Reduced};
use crate::study::cycle::{Cycles, cycles};

/// Everything about a machine.
#[derive(Clone, Debug)]
pub struct Survey {
    /// The machine.
    pub belt: Belt,
    /// Its dimensionless form.
    pub reduced: Reduced,
    /// What it does.
    pub course: Course,
    /// The same by the cubic expansion of friction, or why that gave up.
    pub expansion: Result<Cycles, Reason>,
}

/// What a machine does, and one motion of it.
#[derive(Clone, Debug)]
pub struct Course {
    /// All motions.
    pub portrait: Portrait,
    /// The one that was asked for.
    pub motion: Motion,
    /// What it ends as.
    pub fate: Fate,
    /// Where it comes to rest, in m.
    pub rest: Option<f64>,
}

impl Course {
    /// What a model does, and the motion from `start` (m and m/s), followed for `until` seconds.
    ///
    /// # Errors
    /// [`Trouble`] where its motions leave the friction law or cannot be followed.
    pub fn new(model: &Model, start: (f64, f64), until: f64) -> Result<Self, Trouble> {
        let portrait = known(model)?;
        let (x, v) = start;
        let fate = portrait.fate(x, v)?;
        if let Fate::Unknown(stop) = fate {
            return Err(stop.into());
        }
        let rest =
            (fate == Fate::Rest).then(|| Flow::new(model).rest_of(x, model.scaled_velocity(v)));
        let motion = Motion::new(model, x, v, until);
        Ok(Course { motion, fate, rest: rest.transpose()?, portrait })
    }
}

/// Why a machine has no answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trouble {
    /// It has no dimensionless form.
    Belt(BeltError),
    /// It has no whole model.
    Unfit(Unfit),
    /// Its motions cannot be followed.
    Stop(Stop),
}

impl Trouble {
    /// Whether the machine itself is at fault, and not what it takes to compute it.
    #[must_use]
    pub fn is_of_the_machine(&self) -> bool {
        !matches!(self, Trouble::Stop(Stop::Steps | Stop::Settled | Stop::Escaped))
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trouble::Belt(error) => error.fmt(out),
            Trouble::Unfit(unfit) => unfit.fmt(out),
            Trouble::Stop(stop) => stop.fmt(out),
        }
    }
}

impl std::error::Error for Trouble {}

impl From<BeltError> for Trouble {
    fn from(error: BeltError) -> Self {
        Trouble::Belt(error)
    }
}

impl From<Unfit> for Trouble {
    fn from(unfit: Unfit) -> Self {
        Trouble::Unfit(unfit)
    }
}

impl From<Stop> for Trouble {
    fn from(stop: Stop) -> Self {
        Trouble::Stop(stop)
    }
}

/// The portrait of a machine whose friction law reaches as far as its motions do.
///
/// # Errors
/// [`Trouble`] where it has no model, or where motions just outside the basin of rest leave the law.
pub fn portrait(belt: &Belt) -> Result<Portrait, Trouble> {
    known(&Model::new(belt)?)
}

fn known(model: &Model) -> Result<Portrait, Trouble> {
    let portrait = Portrait::new(model)?;
    match (portrait.outermost(), portrait.stop) {
        (Fate::Unknown(_), Some(stop)) => Err(stop.into()),
        _ => Ok(portrait),
    }
}

/// Everything about a machine and its motion from `start` (m and m/s), followed for `until` seconds.
///
/// # Errors
/// [`Trouble`] where it has no model, or where its motions leave the friction law.
pub fn survey(
    belt: &Belt,
    start: (f64, f64),
    until: f64,
    limits: &Limits,
) -> Result<Survey, Trouble> {
    let reduced = belt.reduce()?;
    Ok(Survey {
        belt: belt.clone(),
        reduced,
        course: Course::new(&Model::new(belt)?, start, until)?,
        expansion: cycles(&reduced.parameters, true, limits),
    })
}
