//! A recorded motion on show: the record and its fit.

use std::cell::Cell;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::fit::{
    D, D2, D3, Estimate, FitResult, Inertia, MarginQuestion, Margins, NoEstimate, Question, R,
    Record, Runs, estimate, held, length_in_metres, margins,
};
use crate::flow::{Limits, Reason, Result};

/// Draws for the distribution of the margin: fewer than on the command line, so that it appears quickly.
const DRAWN: usize = 200;

/// A record as it was opened, with the choices for its fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OpenedRecord {
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
#[serde(transparent)]
pub struct Recording(Arc<OpenedRecord>);

impl From<OpenedRecord> for Recording {
    fn from(opened: OpenedRecord) -> Self {
        Recording(Arc::new(opened))
    }
}

impl PartialEq for Recording {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl std::ops::Deref for Recording {
    type Target = OpenedRecord;

    fn deref(&self) -> &OpenedRecord {
        &self.0
    }
}

/// A fitted record, or why it could not be fitted. Copies of one fit compare equal without looking at their
/// contents.
#[derive(Clone, Debug)]
pub struct Fit(Arc<Result<FitResult, NoEstimate>>);

impl PartialEq for Fit {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl From<NoEstimate> for Fit {
    fn from(unfit: NoEstimate) -> Self {
        Fit(Arc::new(Err(unfit)))
    }
}

impl OpenedRecord {
    /// Mass or stiffness, and the record's unit of length in metres.
    pub fn metric(&self) -> Option<(Inertia, f64)> {
        self.inertia.zip(length_in_metres(self.record.unit.as_deref()?))
    }

    /// Fits the record and asks about its margin; reports the number of motions computed so far.
    ///
    /// # Errors
    /// [`NoEstimate`] says why there is no estimate.
    pub fn estimated(
        &self,
        asked: &MarginQuestion,
        limits: &Limits,
        report: &dyn Fn(u64),
    ) -> Result<(Estimate, Margins), NoEstimate> {
        let motions = Cell::new(0);
        let interrupted = || {
            motions.set(motions.get() + 1);
            report(motions.get());
            (limits.interrupted)()
        };
        let mut question = self.question.clone();
        question.peaks |= self.record.t.is_empty();
        let estimate = estimate(&self.record, &question, &interrupted)?;
        let margins = margins(&estimate, asked, limits).map_err(|_| NoEstimate::Interrupted)?;
        Ok((estimate, margins))
    }
}

impl Fit {
    /// Fits a record, and reports the number of motions computed so far. Fails with [`Reason::Interrupted`].
    pub fn of(recording: &Recording, limits: &Limits, report: &dyn Fn(u64)) -> Result<Self> {
        let inertia = recording.metric();
        let asked = MarginQuestion { draws: DRAWN, inertia, ..MarginQuestion::default() };
        let (name, record) = (recording.name.clone(), recording.record.clone());
        let found = recording.estimated(&asked, limits, report);
        Fit::answered(
            found.map(|(estimate, margins)| FitResult::new(name, record, estimate, margins)),
        )
    }

    /// The answer, unless it was interrupted.
    fn answered(found: Result<FitResult, NoEstimate>) -> Result<Self> {
        match found {
            Err(NoEstimate::Interrupted) => Err(Reason::Interrupted),
            found => Ok(Fit(Arc::new(found))),
        }
    }

    /// The fit with those of D, D2, D3 and r held that have a value. Unless its distribution is asked for, that of the
    /// margin remains the one of this fit. Fails with [`Reason::Interrupted`].
    pub fn held(
        &self,
        values: [Option<f64>; 4],
        asked: Option<MarginQuestion>,
        limits: &Limits,
    ) -> Result<Self> {
        let Ok(fit) = self.found() else { return Ok(self.clone()) };
        let named = [D, D2, D3, R].into_iter().zip(values);
        let numbers: Vec<_> = named.filter_map(|(place, value)| Some((place, value?))).collect();
        // With all numbers free it is known.
        let estimate = match numbers[..] {
            [] => Ok(fit.estimate.clone()),
            _ => held(&fit.estimate, &numbers, &Runs::new(limits.interrupted)),
        };
        let estimate = match estimate {
            Ok(estimate) => estimate,
            Err(unfit) => return Fit::answered(Err(unfit)),
        };
        let cost = |of: &Estimate| of.kept_residuals().map(|it| it * it).sum::<f64>();
        let deviation = fit.estimate.covariance.deviation;
        let rise = (cost(&estimate) - cost(&fit.estimate)) / (deviation * deviation);
        let margins = match asked {
            Some(asked) => margins(&estimate, &asked, limits)?,
            None => fit.margins.clone(),
        };
        let found = FitResult::new(fit.name.clone(), fit.record.clone(), estimate, margins);
        Fit::answered(Ok(FitResult { rise, drawn: asked.is_some(), ..found }))
    }

    /// The fit. Fails with the [`NoEstimate`] of the record.
    pub fn found(&self) -> Result<&FitResult, &NoEstimate> {
        self.0.as_ref().as_ref()
    }
}
