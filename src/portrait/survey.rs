//! What a machine does: its portrait and one motion of it; and beside it what the oscillator of the paper says, which
//! knows friction by its cubic expansion alone.

use crate::flow::{
    Detail, Fate, Flow, Limits, Method, MotionUnits, Problem, Reason, Trajectory, follow,
    follow_by_series,
};
use crate::model::belt::ReducedBelt;
use crate::model::{Belt, Model, Source};
use crate::portrait::Portrait;
use crate::portrait::basin::cycle::picture_reach;

/// A mass on a belt by the cubic expansion of its friction.
#[derive(Clone, Debug)]
pub struct CubicExpansion {
    /// The machine.
    pub belt: Belt,
    /// Its dimensionless form.
    pub reduced: ReducedBelt,
    /// What it does, or why the search gave up.
    pub portrait: Result<Portrait, Reason>,
}

impl CubicExpansion {
    /// Finds its cycles and its basin. Fails with [`Reason`] where the machine has no dimensionless form.
    pub fn new(belt: &Belt, limits: &Limits) -> Result<Self, Reason> {
        let reduced = belt.reduce()?;
        let reach = picture_reach(reduced.parameters.d2);
        let portrait = Portrait::of_oscillator(&reduced.parameters, reach, limits);
        Ok(CubicExpansion { belt: belt.clone(), reduced, portrait })
    }
}

/// What a machine does, and one motion of it.
#[derive(Clone, Debug)]
pub struct Course {
    /// All motions.
    pub portrait: Portrait,
    /// The one that was asked for.
    pub motion: Trajectory,
    /// What it ends as.
    pub fate: Fate,
    /// Where it comes to rest, in m.
    pub rest: Option<f64>,
    /// The same motion by another method, if asked for.
    pub second: Option<Trajectory>,
}

impl Course {
    /// What a model does, and the motion from `start` (m and m/s), followed for `until` seconds. Fails with
    /// [`Reason`] where motions leave the law before the border of rest is known, or cannot be followed.
    pub fn new(model: &Model, start: (f64, f64), until: f64) -> Result<Self, Reason> {
        let portrait = Portrait::of(model)?;
        let (x, v) = start;
        let fate = portrait.told_fate(x, v)?;
        let rest = (fate == Fate::Rest)
            .then(|| Flow::new(model).rest_of(x, model.scaled_velocity(v), &Limits::PATIENT));
        let motion = follow_by_series(model, start, until);
        Ok(Course { motion, fate, rest: rest.transpose()?, portrait, second: None })
    }

    /// Follows the motion once more by another method.
    pub fn follow_by(&mut self, method: Method, tolerance: f64) {
        let model = &self.portrait.model;
        let problem = Problem { method, tolerance, ..self.motion.problem };
        let units = MotionUnits::physical(model);
        self.second = Some(follow(model, &problem, units, Detail::default()));
    }
}

/// The portrait of a machine whose friction law reaches as far as its motions do. Fails with [`Reason`] where it
/// has no model, or where motions leave the law before the border of rest is known.
pub fn portrait(belt: &Belt) -> Result<Portrait, Reason> {
    Portrait::of(&Model::new(belt)?)
}

impl Source {
    /// What it does.
    ///
    /// # Errors
    /// [`Reason`] where it has no model, or where motions leave the law before the border of rest is known.
    pub fn portrait(&self) -> Result<Portrait, Reason> {
        Portrait::of(&self.model()?)
    }
}
