//! A recorded motion on show: the record and its fit.

use std::cell::Cell;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::fit::{
    self, D, D2, D3, Dropped, Estimate, Inertia, LAST, MarginQuestion, Margins, NAMES, OMEGA0, Q0,
    Question, R, Record, Runs, Signal, StartKind, Unfit, estimate, length_in_metres, margins,
    parameters,
};
use crate::flow::{Limits, Problem, Reason};
use crate::model::{Knob, State};

/// Draws for the distribution of the margin: fewer than on the command line, so that it appears quickly.
const DRAWN: usize = 200;

/// What is to be survived beside the uncertainty of the fit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Unsure {
    /// Bound on a disturbance, in the unit of r.
    pub disturbance: f64,
    /// Half widths of D, D2, D3 and r.
    pub half_widths: [f64; 4],
}

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

/// A point of the record in the units of the oscillator: time in `1/omega0`, lengths in the record's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordPoint {
    /// Time since the release, or since the first sample.
    pub tau: f64,
    /// Displacement from the offset, as measured; of a velocity from the fit, of an acceleration NaN.
    pub q: f64,
    /// Velocity divided by omega0, from the fit, and 0 if the fit does not know it; as measured if it was, of an
    /// acceleration NaN.
    pub v: f64,
    /// Why it does not count in the fit; `None` if it does.
    pub dropped: Option<Dropped>,
}

impl RecordPoint {
    /// What was measured, if a time series can show it.
    pub fn shown(&self, signal: Signal) -> Option<f64> {
        match signal {
            Signal::Displacement => Some(self.q),
            Signal::Velocity => Some(self.v),
            Signal::Acceleration => None,
        }
    }
}

/// A fitted record.
#[derive(Clone, Debug)]
pub struct ShownFit {
    /// What was estimated, the distribution of the margin, and the curves of the pictures.
    pub fit: fit::Fitted,
    /// All points of the record; their velocities are zero in a list of peaks.
    pub points: Vec<RecordPoint>,
    /// Increase of chi-squared caused by the held numbers.
    pub rise: f64,
    /// Whether the distribution of the margin takes the held numbers into account.
    pub drawn: bool,
}

/// A fitted record, or why it could not be fitted. Copies of one fit compare equal without looking at their
/// contents.
#[derive(Clone, Debug)]
pub struct Fit(Arc<Result<ShownFit, Unfit>>);

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
        question.peaks |= recording.record.t.is_none();
        let estimate = match estimate(&recording.record, &question, &interrupted) {
            Ok(estimate) => estimate,
            Err(Unfit::Interrupted) => return Err(Reason::Interrupted),
            Err(unfit) => return Ok(unfit.into()),
        };
        let inertia = metric(recording);
        let asked = MarginQuestion { draws: DRAWN, inertia, ..MarginQuestion::default() };
        let margins = margins(&estimate, &asked, limits)?;
        let (name, record) = (recording.name.clone(), &recording.record);
        Ok(Fit::with(name, record, estimate, margins, (0.0, true)))
    }

    /// The fit with those of D, D2, D3 and r held that have a value. Unless `drawn`, the distribution of the
    /// margin remains that of this fit. Fails with [`Reason::Interrupted`].
    pub fn held(
        &self,
        values: [Option<f64>; 4],
        drawn: Option<Unsure>,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let Ok(ShownFit { fit, .. }) = self.found() else { return Ok(self.clone()) };
        let named = [D, D2, D3, R].into_iter().zip(values);
        let numbers: Vec<_> = named.filter_map(|(place, value)| Some((place, value?))).collect();
        let interrupted = || (limits.interrupted)();
        let mut runs = Runs::new(&interrupted);
        // With all numbers free it is known.
        let estimate = if numbers.is_empty() {
            Ok(fit.estimate.clone())
        } else {
            fit::held(&fit.estimate, &numbers, &mut runs)
        };
        let estimate = match estimate {
            Ok(estimate) => estimate,
            Err(Unfit::Interrupted) => return Err(Reason::Interrupted),
            Err(unfit) => return Ok(unfit.into()),
        };
        let cost = |of: &Estimate| of.kept_residuals().map(|it| it * it).sum::<f64>();
        let deviation = fit.estimate.covariance.deviation;
        let rise = (cost(&estimate) - cost(&fit.estimate)) / (deviation * deviation);
        let margins = match drawn {
            Some(Unsure { disturbance, half_widths }) => {
                // In N where there is a mass.
                let force = fit.units().map(|units| units.force).filter(|force| force.is_finite());
                let disturbance = disturbance * force.unwrap_or(1.0);
                let question = fit.margins.question;
                let question = MarginQuestion { disturbance, half_widths, ..question };
                margins(&estimate, &question, limits)?
            }
            None => fit.margins.clone(),
        };
        Ok(Fit::with(fit.name.clone(), &fit.record, estimate, margins, (rise, drawn.is_some())))
    }

    fn with(
        name: String,
        record: &Record,
        estimate: Estimate,
        margins: Margins,
        (rise, drawn): (f64, bool),
    ) -> Self {
        let points = points(record, &estimate);
        let fit = fit::Fitted::new(name, record.clone(), estimate, margins);
        Fit(Arc::new(Ok(ShownFit { fit, points, rise, drawn })))
    }

    /// The fit. Fails with the [`Unfit`] of the record.
    pub fn found(&self) -> Result<&ShownFit, &Unfit> {
        self.0.as_ref().as_ref()
    }
}

/// Mass or stiffness, and the record's unit of length in metres.
fn metric(recording: &Recording) -> Option<(Inertia, f64)> {
    recording.inertia.zip(length_in_metres(recording.record.unit.as_deref()?))
}

/// The measured points, relative to the fitted motion.
fn points(record: &Record, estimate: &Estimate) -> Vec<RecordPoint> {
    let p = &estimate.p;
    let (origin, _) = estimate.start.beginning(p, &estimate.data.t);
    let mut states = estimate.data.states(estimate.start, p, estimate.reach).into_iter();
    let all = record.t.iter().flatten().zip(&record.x).zip(&estimate.dropped);
    all.map(|((&t, &x), &dropped)| {
        let is_outside = dropped.is_some_and(Dropped::is_outside);
        let fitted = if is_outside { None } else { states.next() };
        let unseen = State { q: f64::NAN, v: f64::NAN };
        let fitted = fitted.unwrap_or(State { q: 0.0, v: 0.0 });
        let State { q, v } = estimate.measured(t, x, fitted).unwrap_or(unseen);
        RecordPoint { tau: p[OMEGA0] * (t - origin), q, v, dropped }
    })
    .collect()
}

/// Index of a parameter of the oscillator among the unknowns of the fit.
fn place(symbol: Knob) -> Option<usize> {
    let named = NAMES.iter().find(|row| row.knob == symbol).map(|row| row.place);
    named.or((symbol == Knob::Q0).then_some(Q0))
}

impl ShownFit {
    /// The fitted motion; the method and whatever else the fit does not determine are those of `before`.
    pub fn problem(&self, before: Problem) -> Problem {
        let p = &self.fit.estimate.p;
        let last = self.points.iter().rfind(|point| point.dropped.is_none());
        let last = last.map_or(before.until, |point| point.tau);
        Problem {
            parameters: parameters(p),
            initial: self.fit.estimate.start.beginning(p, &[]).1,
            until: if last > 0.0 { last } else { before.until },
            ..before
        }
    }

    /// Whether a number is held, by hand or by the choice with which the record was opened.
    pub fn holds(&self, symbol: Knob) -> bool {
        place(symbol).is_some_and(|place| !self.fit.estimate.free[place])
    }

    /// Standard error of a number; `None` where it was not estimated.
    pub fn error(&self, symbol: Knob) -> Option<f64> {
        let place = if symbol == Knob::V0 && self.fit.estimate.start == StartKind::Moving {
            LAST
        } else {
            place(symbol)?
        };
        self.fit.estimate.free[place].then(|| self.fit.estimate.covariance.error(place))
    }
}
