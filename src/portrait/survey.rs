//! What a machine does: its portrait and one motion of it; and beside it what the oscillator of the paper says, which
//! knows friction by its cubic expansion alone.

use std::fmt;

use crate::flow::{Detail, Fate, Flow, Limits, LostMotion, MachineMotion, Method, Reason};
use crate::model::belt::{BeltError, ReducedBelt};
use crate::model::{Belt, Model, NoModel, Source};
use crate::portrait::Portrait;
use crate::portrait::basin::cycle::{Cycles, cycles};

/// A mass on a belt by the cubic expansion of its friction.
#[derive(Clone, Debug)]
pub struct CubicExpansion {
    /// The machine.
    pub belt: Belt,
    /// Its dimensionless form.
    pub reduced: ReducedBelt,
    /// Its cycles, or why the search gave up.
    pub cycles: Result<Cycles, Reason>,
}

impl CubicExpansion {
    /// Finds the cycles. Fails with [`BeltError`] where the machine has no dimensionless form.
    pub fn new(belt: &Belt, limits: &Limits) -> Result<Self, BeltError> {
        let reduced = belt.reduce()?;
        let cycles = cycles(&reduced.parameters, true, limits);
        Ok(CubicExpansion { belt: belt.clone(), reduced, cycles })
    }
}

/// What a machine does, and one motion of it.
#[derive(Clone, Debug)]
pub struct Course {
    /// All motions.
    pub portrait: Portrait,
    /// The one that was asked for.
    pub motion: MachineMotion,
    /// What it ends as.
    pub fate: Fate<LostMotion>,
    /// Where it comes to rest, in m.
    pub rest: Option<f64>,
    /// The same motion by another method, if asked for.
    pub second: Option<MachineMotion>,
}

impl Course {
    /// What a model does, and the motion from `start` (m and m/s), followed for `until` seconds. Fails with
    /// [`Trouble`] where motions leave the law before the border of rest is known, or cannot be followed.
    pub fn new(model: &Model, start: (f64, f64), until: f64) -> Result<Self, Trouble> {
        let portrait = Portrait::of(model)?;
        let (x, v) = start;
        let fate = match portrait.fate(x, v) {
            Err(stop @ LostMotion::OutsideLaw { .. }) => Fate::Unknown(stop),
            fate => fate?,
        };
        let rest =
            (fate == Fate::Rest).then(|| Flow::new(model).rest_of(x, model.scaled_velocity(v)));
        let motion = MachineMotion::new(model, x, v, until);
        Ok(Course { motion, fate, rest: rest.transpose()?, portrait, second: None })
    }
}

impl Course {
    /// Follows the motion once more by another method.
    pub fn follow_by(&mut self, method: Method, tolerance: f64, start: (f64, f64), until: f64) {
        let (model, asked) = (&self.portrait.model, (method, tolerance));
        self.second = Some(MachineMotion::by(model, asked, start, until, Detail::default()));
    }
}

/// Why a machine has no answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trouble {
    /// It has no dimensionless form.
    Belt(BeltError),
    /// It has no whole model.
    Unfit(NoModel),
    /// Its motions cannot be followed.
    Stop(LostMotion),
}

impl Trouble {
    /// Whether the machine itself is at fault, and not what it takes to compute it.
    pub fn is_of_the_machine(&self) -> bool {
        !matches!(
            self,
            Trouble::Stop(LostMotion::Steps | LostMotion::Settled | LostMotion::Escaped)
        )
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

impl From<NoModel> for Trouble {
    fn from(unfit: NoModel) -> Self {
        Trouble::Unfit(unfit)
    }
}

impl From<LostMotion> for Trouble {
    fn from(stop: LostMotion) -> Self {
        Trouble::Stop(stop)
    }
}

/// The portrait of a machine whose friction law reaches as far as its motions do. Fails with [`Trouble`] where it
/// has no model, or where motions leave the law before the border of rest is known.
pub fn portrait(belt: &Belt) -> Result<Portrait, Trouble> {
    Ok(Portrait::of(&Model::new(belt)?)?)
}

impl Source {
    /// What it does.
    ///
    /// # Errors
    /// [`Trouble`] where it has no model, or where motions leave the law before the border of rest is known.
    pub fn portrait(&self) -> Result<Portrait, Trouble> {
        Ok(Portrait::of(&self.model()?)?)
    }
}
