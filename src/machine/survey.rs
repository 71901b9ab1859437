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
    pub portrait: Portrait,
    /// The motion that was asked for.
    pub motion: Motion,
    /// What it ends as.
    pub fate: Fate,
    /// Where it comes to rest, in m.
    pub rest: Option<f64>,
    /// The same by the cubic expansion of friction, or why that gave up.
    pub expansion: Result<Cycles, Reason>,
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
    let portrait = Portrait::new(&Model::new(belt)?)?;
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
    let portrait = portrait(belt)?;
    let (x, v) = start;
    let fate = portrait.fate(x, v)?;
    if let Fate::Unknown(stop) = fate {
        return Err(stop.into());
    }
    let model = &portrait.model;
    let rest = (fate == Fate::Rest).then(|| Flow::new(model).rest_of(x, model.scaled_velocity(v)));
    Ok(Survey {
        belt: belt.clone(),
        reduced,
        motion: Motion::new(model, x, v, until),
        fate,
        rest: rest.transpose()?,
        expansion: cycles(&reduced.parameters, true, limits),
        portrait,
    })
}
