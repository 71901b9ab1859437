//! A recorded motion on show: the record, and what a fit makes of it.

use std::cell::Cell;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::means::Means;
use crate::fit::curves::Curves;
use crate::fit::levenberg_marquardt::Runs;
use crate::fit::names::Choice;
use crate::fit::observation::{
    D, D2, D3, Data, LAST, OFFSET, OMEGA0, Observation, Q0, R, StartKind,
};
use crate::fit::{self, refit};
use crate::fit::{
    Estimate, Inertia, LossName, Margins, Question, Record, Unfit, estimate, length_in_metres,
    margins, parameters,
};
use crate::flow::{Limits, Problem, Reason};
use crate::oscillator::{State, Symbol};

/// Draws for the distribution of the margin: fewer than on the command line, to be there soon.
const DRAWN: usize = 100;

/// What was opened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Opened {
    /// The name of the file.
    pub name: String,
    /// What was read.
    pub record: Record,
    /// Mass or stiffness, if it is known; the record names its unit of length then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<Inertia>,
    /// Whether the rows are successive turning points.
    #[serde(default)]
    pub peaks: bool,
    /// What is estimated and what is held.
    #[serde(default)]
    pub choice: Choice,
    /// How residuals count.
    #[serde(default)]
    pub loss: LossName,
}

/// A record that was opened. Copies share it, and are equal at once.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "Opened", into = "Opened")]
pub struct Recording(Arc<Opened>);

impl From<Opened> for Recording {
    fn from(opened: Opened) -> Self {
        Recording(Arc::new(opened))
    }
}

impl From<Recording> for Opened {
    fn from(Recording(opened): Recording) -> Self {
        (*opened).clone()
    }
}

impl PartialEq for Recording {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl std::ops::Deref for Recording {
    type Target = Opened;

    fn deref(&self) -> &Opened {
        &self.0
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    pub recording: Recording,
}

impl super::kind::Question for Asked {
    type Found = Fit;

    fn answer(&self, means: &Means) -> Result<Fit, Reason> {
        Fit::of(&self.recording, means.limits, &|_| ())
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
    /// What was estimated, the distribution of the margin, and the curves of the pictures.
    pub fit: fit::Fitted,
    /// What was measured; lists of peaks have no velocities but zero.
    pub points: Vec<Measured>,
    /// By how much chi-squared is larger than without what is held.
    pub rise: f64,
    /// Whether the distribution of the margin is that with what is held.
    pub drawn: bool,
}

/// A fitted record, or why it could not be fitted; the same fit is equal at once.
#[derive(Clone, Debug)]
pub struct Fit(Arc<Result<Fitted, Unfit>>);

impl PartialEq for Fit {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl From<Unfit> for Fit {
    fn from(unfit: Unfit) -> Self {
        Fit(Arc::new(Err(unfit)))
    }
}

impl Fit {
    /// Fits a record, and tells how many motions it has computed so far. Fails with [`Reason::Interrupted`].
    pub fn of(
        recording: &Recording,
        limits: &Limits,
        report: &dyn Fn(u64),
    ) -> Result<Self, Reason> {
        let motions = Cell::new(0);
        let interrupted = || {
            motions.set(motions.get() + 1);
            report(motions.get());
            (limits.interrupted)()
        };
        let peaks = recording.peaks || recording.record.t.is_none();
        let question = Question { peaks, choice: recording.choice.clone(), loss: recording.loss };
        let estimate = match estimate(&recording.record, &question, &interrupted) {
            Ok(estimate) => estimate,
            Err(Unfit::Interrupted) => return Err(Reason::Interrupted),
            Err(unfit) => return Ok(unfit.into()),
        };
        let margins = margins(&estimate, DRAWN, limits)?;
        let named = (recording.name.clone(), &recording.record);
        Ok(Fit::with(named, estimate, (margins, true), metric(recording), 0.0))
    }

    /// The same with D, D2, D3 and r held where they have values; unless it is to be `drawn`, too, the distribution of
    /// the margin stays that without. Fails with [`Reason::Interrupted`].
    pub fn held(
        &self,
        values: [Option<f64>; 4],
        drawn: bool,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let Ok(Fitted { fit, .. }) = self.found() else { return Ok(self.clone()) };
        let named = [D, D2, D3, R].into_iter().zip(values);
        let numbers: Vec<_> = named.filter_map(|(place, value)| Some((place, value?))).collect();
        let interrupted = || (limits.interrupted)();
        let mut runs = Runs::new(&interrupted);
        match refit::held(&fit.estimate, &numbers, &mut runs) {
            Ok(estimate) => {
                let cost = |of: &Estimate| of.kept_residuals().map(|it| it * it).sum::<f64>();
                let deviation = fit.estimate.covariance.deviation;
                let unit = deviation * deviation;
                let rise = (cost(&estimate) - cost(&fit.estimate)) / unit;
                let margins =
                    if drawn { margins(&estimate, DRAWN, limits)? } else { fit.margins.clone() };
                let named = (fit.name.clone(), &fit.record);
                Ok(Fit::with(named, estimate, (margins, drawn), fit.inertia, rise))
            }
            Err(Unfit::Interrupted) => Err(Reason::Interrupted),
            Err(unfit) => Ok(unfit.into()),
        }
    }

    fn with(
        (name, record): (String, &Record),
        estimate: Estimate,
        (margins, drawn): (Margins, bool),
        inertia: Option<(Inertia, f64)>,
        rise: f64,
    ) -> Self {
        let (points, curves) = (points(&estimate), Curves::of(&estimate, &margins));
        let (record, contours, seconds) = (record.clone(), Vec::new(), 0.0);
        let fit =
            fit::Fitted { name, record, estimate, margins, curves, contours, inertia, seconds };
        Fit(Arc::new(Ok(Fitted { fit, points, rise, drawn })))
    }

    /// What was found, or why there is nothing. Fails with the [`Unfit`] of the record.
    pub fn found(&self) -> Result<&Fitted, &Unfit> {
        self.0.as_ref().as_ref()
    }
}

/// Mass or stiffness with the metres in the record's unit of length.
fn metric(recording: &Recording) -> Option<(Inertia, f64)> {
    recording.inertia.zip(length_in_metres(recording.record.unit.as_deref()?))
}

/// The record around the fitted motion.
fn points(estimate: &Estimate) -> Vec<Measured> {
    let p = &estimate.p;
    let (t, x) = match &estimate.data {
        Data::Samples { t, x } => (t.clone(), x),
        Data::Peaks { t, x, .. } => (t.clone().unwrap_or_default(), x),
    };
    let origin = match estimate.start {
        StartKind::Release => p[LAST],
        StartKind::Moving => t.first().copied().unwrap_or(0.0),
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
    pub fn problem(&self, before: Problem) -> Problem {
        let p = &self.fit.estimate.p;
        let v = if self.fit.estimate.start == StartKind::Moving { p[LAST] } else { 0.0 };
        let last = self.points.last().map_or(before.until, |point| point.tau);
        Problem {
            parameters: parameters(p),
            initial: State { q: p[Q0], v },
            until: if last > 0.0 { last } else { before.until },
            ..before
        }
    }

    /// Whether a number is held, by hand or since the record was opened.
    pub fn holds(&self, symbol: Symbol) -> bool {
        place(symbol).is_some_and(|place| !self.fit.estimate.free[place])
    }

    /// The unknown that a number is, with its standard error; `None` where it was not estimated.
    pub fn error(&self, symbol: Symbol) -> Option<f64> {
        let place = if symbol == Symbol::V0 && self.fit.estimate.start == StartKind::Moving {
            LAST
        } else {
            place(symbol)?
        };
        self.fit.estimate.free[place].then(|| self.fit.estimate.covariance.error(place))
    }
}
