//! A recorded motion on show: the record, and what a fit makes of it.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::means::Means;
use crate::fit::observation::{D, D2, D3, Data, LAST, OFFSET, OMEGA0, Observation, Q0, R, Start};
use crate::fit::{Estimate, Margins, Question, Record, Unfit, estimate, margins, parameters};
use crate::flow::{Limits, Problem, Reason};
use crate::oscillator::{State, Symbol};

/// Draws for the distribution of the margin: fewer than on the command line, to be there soon.
const DRAWN: usize = 100;

/// A record that was opened, with the name of its file. Copies share it, and are equal at once.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "(String, Record)", into = "(String, Record)")]
pub struct Recording(Arc<(String, Record)>);

impl From<(String, Record)> for Recording {
    fn from(named: (String, Record)) -> Self {
        Recording(Arc::new(named))
    }
}

impl From<Recording> for (String, Record) {
    fn from(Recording(named): Recording) -> Self {
        (*named).clone()
    }
}

impl PartialEq for Recording {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl Recording {
    /// The name of the file.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.0.0
    }

    /// What was read.
    #[must_use]
    pub fn record(&self) -> &Record {
        &self.0.1
    }
}

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The record.
    pub recording: Recording,
}

impl super::kind::Question for Asked {
    type Found = Fit;

    fn answer(&self, means: &Means) -> Result<Fit, Reason> {
        Fit::of(&self.recording, means.limits)
    }

    fn numbers(&self) -> [f64; 8] {
        [0.0; 8]
    }
}

/// A point of the record in the units of the oscillator: time in `1/omega0`, lengths in the record's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// When, from the release, or from the first sample.
    pub tau: f64,
    /// Displacement from the offset, as measured.
    pub q: f64,
    /// Velocity over omega0, by the fit.
    pub v: f64,
}

/// A fitted record.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// What was estimated.
    pub estimate: Estimate,
    /// The distribution of the margin.
    pub margins: Margins,
    /// What was measured; lists of peaks have no velocities but zero.
    pub points: Vec<Measured>,
}

/// A fitted record, or why it could not be fitted; the same fit is equal at once.
#[derive(Clone, Debug)]
pub struct Fit(Arc<Result<Fitted, Unfit>>);

impl PartialEq for Fit {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Fit {
    /// Fits a record.
    ///
    /// # Errors
    /// [`Reason::Interrupted`].
    pub fn of(recording: &Recording, limits: &Limits) -> Result<Self, Reason> {
        let interrupted = || (limits.interrupted)();
        let peaks = recording.record().t.is_none();
        let question = Question { peaks, ..Question::default() };
        let found = match estimate(recording.record(), &question, &interrupted) {
            Ok(estimate) => Ok(Fitted {
                margins: margins(&estimate, DRAWN, limits)?,
                points: points(&estimate),
                estimate,
            }),
            Err(Unfit::Interrupted) => return Err(Reason::Interrupted),
            Err(unfit) => Err(unfit),
        };
        Ok(Fit(Arc::new(found)))
    }

    /// What was found, or why there is nothing.
    ///
    /// # Errors
    /// The [`Unfit`] of the record.
    pub fn found(&self) -> Result<&Fitted, &Unfit> {
        self.0.as_ref().as_ref()
    }
}

/// The record around the fitted motion.
fn points(estimate: &Estimate) -> Vec<Measured> {
    let p = &estimate.p;
    let (t, x) = match &estimate.data {
        Data::Samples { t, x } => (t.clone(), x),
        Data::Peaks { t, x, .. } => (t.clone().unwrap_or_default(), x),
    };
    let origin = match estimate.start {
        Start::Release => p[LAST],
        Start::Moving => t.first().copied().unwrap_or(0.0),
    };
    let observation = Observation {
        data: estimate.data.clone(),
        start: estimate.start,
        linear: false,
        reach: estimate.reach,
    };
    // By omega0 a displacement changes with its velocity times the time that has passed.
    let seen = match &estimate.data {
        Data::Samples { .. } => observation.compare(p, true).unwrap_or_default().residuals,
        Data::Peaks { .. } => Vec::new(),
    };
    let velocity = |index: usize, passed: f64| {
        let by = seen.get(index).map_or(0.0, |residual| residual.by[OMEGA0]);
        if passed > 0.0 { by / passed } else { 0.0 }
    };
    let point = |(index, (t, x)): (usize, (&f64, &f64))| Measured {
        tau: p[OMEGA0] * (t - origin),
        q: x - p[OFFSET],
        v: velocity(index, t - origin),
    };
    t.iter().zip(x).enumerate().map(point).collect()
}

/// The unknown that a parameter of the oscillator is.
fn place(symbol: Symbol) -> Option<usize> {
    Some(match symbol {
        Symbol::D => D,
        Symbol::D2 => D2,
        Symbol::D3 => D3,
        Symbol::R => R,
        Symbol::Q0 => Q0,
        Symbol::V0 => return None,
    })
}

impl Fitted {
    /// The fitted motion.
    #[must_use]
    pub fn problem(&self, before: Problem) -> Problem {
        let p = &self.estimate.p;
        let v = if self.estimate.start == Start::Moving { p[LAST] } else { 0.0 };
        let last = self.points.last().map_or(before.until, |point| point.tau);
        Problem {
            parameters: parameters(p),
            initial: State { q: p[Q0], v },
            until: if last > 0.0 { last } else { before.until },
            ..before
        }
    }

    /// The standard error of a number; `None` where it was not estimated.
    #[must_use]
    pub fn error(&self, symbol: Symbol) -> Option<f64> {
        let place = if symbol == Symbol::V0 && self.estimate.start == Start::Moving {
            LAST
        } else {
            place(symbol)?
        };
        self.estimate.free[place].then(|| self.estimate.covariance.error(place))
    }
}
