//! A recorded motion on show: the record and its fit.

use std::cell::Cell;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::fit::{
    D, D2, D3, Estimate, Fitted, Inertia, MarginQuestion, Question, R, Record, Runs, Unfit,
    estimate, held, length_in_metres, margins,
};
use crate::flow::{Limits, Reason};

/// Draws for the distribution of the margin: fewer than on the command line, so that it appears quickly.
const DRAWN: usize = 200;

/// A record as it was opened, with the choices for its fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Opened {
    /// The name of the file.
    pub name: String,
    /// The measurements.
    pub record: Record,
    /// Mass or stiffness, if known; the record then names its unit of length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<Inertia>,
    /// What is asked about it.
    #[serde(flatten)]
    pub question: Question,
}

/// An opened record. Copies share their data, so that comparing them is immediate.
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

/// A fitted record, or why it could not be fitted. Copies of one fit compare equal without looking at their
/// contents.
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

impl From<Fitted> for Fit {
    fn from(fitted: Fitted) -> Self {
        Fit(Arc::new(Ok(fitted)))
    }
}

impl Fit {
    /// Fits a record, and reports the number of motions computed so far. Fails with [`Reason::Interrupted`].
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
        let mut question = recording.question.clone();
        question.peaks |= recording.record.t.is_empty();
        let estimate = match estimate(&recording.record, &question, &interrupted) {
            Ok(estimate) => estimate,
            Err(Unfit::Interrupted) => return Err(Reason::Interrupted),
            Err(unfit) => return Ok(unfit.into()),
        };
        let inertia = metric(recording);
        let asked = MarginQuestion { draws: DRAWN, inertia, ..MarginQuestion::default() };
        let margins = margins(&estimate, &asked, limits)?;
        let (name, record) = (recording.name.clone(), recording.record.clone());
        Ok(Fitted::new(name, record, estimate, margins).into())
    }

    /// The fit with those of D, D2, D3 and r held that have a value. Unless its distribution is asked for, that of the
    /// margin remains the one of this fit. Fails with [`Reason::Interrupted`].
    pub fn held(
        &self,
        values: [Option<f64>; 4],
        asked: Option<MarginQuestion>,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let Ok(fit) = self.found() else { return Ok(self.clone()) };
        let named = [D, D2, D3, R].into_iter().zip(values);
        let numbers: Vec<_> = named.filter_map(|(place, value)| Some((place, value?))).collect();
        let interrupted = || (limits.interrupted)();
        let runs = Runs::new(&interrupted);
        // With all numbers free it is known.
        let estimate = if numbers.is_empty() {
            Ok(fit.estimate.clone())
        } else {
            held(&fit.estimate, &numbers, &runs)
        };
        let estimate = match estimate {
            Ok(estimate) => estimate,
            Err(Unfit::Interrupted) => return Err(Reason::Interrupted),
            Err(unfit) => return Ok(unfit.into()),
        };
        let cost = |of: &Estimate| of.kept_residuals().map(|it| it * it).sum::<f64>();
        let deviation = fit.estimate.covariance.deviation;
        let rise = (cost(&estimate) - cost(&fit.estimate)) / (deviation * deviation);
        let margins = match asked {
            Some(asked) => margins(&estimate, &asked, limits)?,
            None => fit.margins.clone(),
        };
        let found = Fitted::new(fit.name.clone(), fit.record.clone(), estimate, margins);
        Ok(Fitted { rise, drawn: asked.is_some(), ..found }.into())
    }

    /// The fit. Fails with the [`Unfit`] of the record.
    pub fn found(&self) -> Result<&Fitted, &Unfit> {
        self.0.as_ref().as_ref()
    }
}

/// Mass or stiffness, and the record's unit of length in metres.
fn metric(recording: &Recording) -> Option<(Inertia, f64)> {
    recording.inertia.zip(length_in_metres(recording.record.unit.as_deref()?))
}
