//! The conditions on which the answer of a fit rests, each tested by the record itself.

use serde::Serialize;

use super::{
    DropReason, Estimate, FEWEST, FittedDrift, HIDDEN, IMPOSSIBLE, Margins, NameSpec, NoEstimate,
    Question, R, RUN, Record, Rival, Runs, Unknowns, longest_run, of_kind,
};
use crate::numerics::{Random, in_unit, real, significant, with_error};

/// A condition on which an answer rests.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Condition {
    /// What is tested.
    pub name: &'static str,
    /// Whether it holds.
    pub holds: bool,
    /// Whether the answer rests on it; otherwise it is for caution.
    pub essential: bool,
    /// What was found.
    pub detail: String,
}

impl Condition {
    /// `pass`, `fail`, or `caution` if the answer does not rest on it.
    pub fn verdict(&self) -> &'static str {
        match (self.holds, self.essential) {
            (true, _) => "pass",
            (false, true) => "fail",
            (false, false) => "caution",
        }
    }
}

/// Fewest degrees of freedom: with one of them, one number in fifty is off by more than 2.3 times half its interval.
const FREEDOM: f64 = 1.5;

/// All conditions of an answer.
pub fn conditions(estimate: &Estimate, margins: &Margins) -> Vec<Condition> {
    let state = |name, holds, detail| Condition { name, holds, essential: true, detail };
    let whiteness = &estimate.whiteness;
    let kind = match (whiteness.systematic, whiteness.white) {
        (true, _) => {
            "they swing with the motion: the model leaves something out, which the errors do not cover"
        }
        (_, true) => "white",
        _ => "correlated as filtered noise is, which the errors allow for",
    };
    let kind = format!("{kind}; correlation {}", significant(whiteness.correlation, 2));
    let ratio = estimate.covariance.deviation / estimate.noise.deviation;
    let run = longest_run(estimate.left_out.iter().map(|why| *why == Some(DropReason::Outlier)));
    let freedom = estimate
        .wanted()
        .map(|row| estimate.covariance.independent(row.place))
        .fold(f64::INFINITY, f64::min);
    let other = alternative(estimate);
    let others = other.map_or("no other motion fits as well".to_owned(), |rival| {
        format!(
            "a motion with r = {:.3e} has a chi-squared that is higher by only {:.1}",
            rival.p[R], rival.delta_chi2
        )
    });
    let enough = FEWEST.min(real(margins.draws.len())).max(real(margins.question.needed()));
    let noise = format!("{ratio:.2} times the noise of neighbouring differences");
    let out = format!("{} left out, at most {run} in a row", estimate.count(DropReason::Outlier));
    let draws = format!("{:.0} effective draws", margins.effective);
    let repetition = |off: f64| {
        let detail = if off.is_finite() {
            format!("a motion simulated from the answer is fitted within {off:.1} standard errors")
        } else {
            "a motion simulated from the answer cannot be fitted".to_owned()
        };
        state("repetition", off <= IMPOSSIBLE, detail)
    };
    let all = [
        Some(state("residuals", !whiteness.systematic, kind)),
        (estimate.noise.deviation > 0.0).then(|| state("noise", ratio <= HIDDEN, noise)),
        Some(state("outliers", run < RUN, out)),
        Some(state("rivals", other.is_none(), others)),
        Some(state("freedom", freedom >= FREEDOM, format!("{freedom:.1} degrees of freedom"))),
        Some(state("draws", margins.effective >= enough, draws)),
        Some(zero(estimate)),
        estimate.repeated.map(repetition),
    ];
    all.into_iter().flatten().collect()
}

/// Whether the zero stays, or drifts as is fitted. A drift too small to be seen is for caution.
fn zero(estimate: &Estimate) -> Condition {
    let left = estimate.left_drift;
    let unit = estimate.data.signal_unit();
    let size = |value: f64| in_unit(&significant(value, 3), &unit);
    let (holds, essential, detail) = match estimate.drift() {
        _ if left.is_seen() => {
            (false, true, format!("it drifts by {} over the record", size(left.change)))
        }
        Some(FittedDrift { change, standard_error, bend, bend_standard_error }) => {
            let along = match bend_standard_error {
                0.0 => "along a line".to_owned(),
                error => format!("its ends {} above its middle", with_error(bend, error, &unit)),
            };
            let change = with_error(change, standard_error, &unit);
            let detail =
                format!("it drifts by {change}, {along}, which is fitted: the offset is its mean");
            (!estimate.whiteness.systematic, true, detail)
        }
        None if left.moved > IMPOSSIBLE => {
            let detail = format!(
                "a drift by {}, too small to be seen, would move a number by {:.1} standard errors",
                size(left.change),
                left.moved
            );
            (false, false, detail)
        }
        None => (true, true, "no drift is seen".to_owned()),
    };
    Condition { name: "zero", holds, essential, detail }
}

/// How far a fit of a record simulated from an estimate comes off it, in standard errors by the intervals of the
/// estimate; infinite if there is no such fit.
///
/// The noise is that of the estimate: drawn anew if it is white, else the residuals half a record away.
///
/// # Errors
/// [`NoEstimate::Interrupted`].
pub fn repeated(estimate: &Estimate, question: &Question, runs: &Runs) -> Result<f64, NoEstimate> {
    let record = simulated(estimate);
    let again = of_kind(&record, question, runs).ok();
    let off = again.map_or(f64::INFINITY, |again| furthest(estimate, &again.p));
    runs.ended().map_or(Ok(off), Err)
}

/// The largest distance of another point from an estimate, in standard errors by the intervals.
fn furthest(estimate: &Estimate, to: &Unknowns) -> f64 {
    let off = |row: &NameSpec| {
        let (from, to) = (estimate.p[row.place], to[row.place]);
        let interval = estimate.intervals[row.place];
        let end = if to < from { interval.lower } else { interval.upper };
        // Half an interval of 95 % is 1.96 standard errors.
        end.map_or(0.0, |end| 1.96 * (to - from).abs() / (end - from).abs())
    };
    estimate.wanted().map(off).filter(|off| off.is_finite()).fold(0.0, f64::max)
}

/// A motion in another region that the intervals leave out, although the record does not rule it out for certain.
fn alternative(estimate: &Estimate) -> Option<&Rival> {
    /// Rise of chi-squared that noise makes of the right motion once in a thousand times or less.
    const RARE: f64 = 12.0;
    let mut others = estimate.rivals.iter().skip(1).filter(|rival| rival.delta_chi2 < RARE);
    others.find(|rival| furthest(estimate, &rival.p) > IMPOSSIBLE)
}

/// A record of the fitted motion with other noise of the same kind.
fn simulated(estimate: &Estimate) -> Record {
    let mut chance = Random::new(1);
    let residuals = &estimate.residuals;
    let half = residuals.len() / 2;
    let deviation = estimate.covariance.deviation;
    let change = |(index, residual): (usize, &f64)| {
        let noise = if estimate.whiteness.white {
            deviation * chance.normal()
        } else {
            -residuals[(index + half) % residuals.len()]
        };
        noise - residual
    };
    let changes: Vec<f64> = residuals.iter().enumerate().map(change).collect();
    let Record { t, x, peaks, .. } = &estimate.data;
    let (of_x, of_t) = changes.split_at(x.len());
    let changed = |measured: &[f64], changes: &[f64], scale: f64| -> Vec<f64> {
        measured.iter().zip(changes).map(|(value, change)| value + scale * change).collect()
    };
    let times = peaks.map_or(t.clone(), |ratio| changed(t, of_t, ratio));
    Record { t: times, x: changed(x, of_x, 1.0), ..estimate.data.clone() }
}
