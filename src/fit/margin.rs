//! The uncertainty of the margin that follows from that of the parameters.
//!
//! D, D2, D3 and r are drawn from their joint distribution, and the smallest kick that is not survived is computed
//! exactly for each draw. Linear error propagation would fail near a fold, where the derivative of the margin
//! diverges or the margin is infinite on one side; quantiles remain valid. Draws are spread evenly (an additive
//! recurrence) rather than at random, so few of them suffice. If the loss is not quadratic they come from the
//! likelihood itself ([`super::posterior`]).

use rayon::prelude::*;
use serde::{Serialize, Serializer};

use super::estimate::Estimate;
use super::names::NAMES;
use super::observation::{D2, D3, R, parameters};
use super::posterior::{Drawn, drawn};
use super::refit::following;
use crate::flow::{Limits, Reason};
use crate::numerics::count::{real, whole};
use crate::oscillator::Parameters;
use crate::study::basin::Basin;
use crate::study::closing::Equation;
use crate::study::closings::all_closings;
use crate::study::fold::fold;
use crate::study::margin::Margin;

/// Quantiles of a quantity that may not exist, such as the margin if every kick is survived.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// The median; `None` if the quantity does not exist in at least half of the draws.
    pub median: Option<f64>,
    /// The 2.5 % quantile.
    pub lower: Option<f64>,
    /// The 97.5 % quantile.
    pub upper: Option<f64>,
    /// The fraction of draws in which the quantity does not exist.
    pub none: f64,
}

impl Spread {
    /// The same in another unit.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        let [median, lower, upper] =
            [self.median, self.lower, self.upper].map(|it| it.map(|value| value * by));
        Spread { median, lower, upper, none: self.none }
    }
}

/// The distribution of the margins.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Margins {
    /// At the best parameters.
    #[serde(skip)]
    pub best: Option<Margin>,
    /// The smallest displacement that is not captured.
    pub displacement: Spread,
    /// The smallest impulse from the middle of the sticking set that is not captured, as `velocity/omega0`.
    pub impulse: Spread,
    /// The right turning point of the smallest stable cycle; `none` is the fraction of draws without one.
    pub cycle: Spread,
    /// The damping `D_F` of the fold, above which every motion is captured; `none` is the fraction of draws
    /// without a fold.
    pub fold: Spread,
    /// Whether the median displacement lies outside the amplitudes measured.
    pub extrapolated: bool,
    /// The smallest displacement not survived with D2 or D3 at an end of its interval and all other numbers following:
    /// the name, its value, and the displacement.
    #[serde(skip)]
    pub allowed: Option<(&'static str, f64, f64)>,
    /// The smallest displacement not captured for every draw, in ascending order; infinite if all are survived.
    #[serde(skip)]
    pub displacements: Vec<f64>,
    /// The parameters drawn.
    #[serde(serialize_with = "number")]
    pub draws: Vec<Parameters>,
    /// The number of independent draws that would carry as much information.
    #[serde(skip)]
    pub effective: f64,
    /// Number of motions computed for the weights.
    #[serde(skip)]
    pub motions: u64,
    /// Number of draws whose margin could not be computed.
    pub failed: usize,
}

fn number<S: Serializer>(draws: &[Parameters], out: S) -> Result<S::Ok, S::Error> {
    draws.len().serialize(out)
}

/// Default number of draws.
pub const DRAWS: usize = 400;

/// The distribution of the margins that follows from an estimate.
///
/// # Errors
/// [`Reason::Interrupted`].
pub fn margins(estimate: &Estimate, draws: usize, limits: &Limits) -> Result<Margins, Reason> {
    let (smallest, largest) = estimate.amplitudes();
    let ask = |parameters: &Parameters| answer(parameters, largest, limits);
    let Drawn { draws: drawn, effective, motions } = drawn(estimate, draws, limits)?;
    let computed: Vec<Result<MarginOfDraw, Reason>> = drawn.par_iter().map(ask).collect();
    if (limits.interrupted)() {
        return Err(Reason::Interrupted);
    }
    let known: Vec<MarginOfDraw> = computed.into_iter().filter_map(Result::ok).collect();
    let sorted = |pick: fn(&MarginOfDraw) -> Option<f64>| {
        let mut values: Vec<f64> =
            known.iter().map(|it| pick(it).unwrap_or(f64::INFINITY)).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let displacements = sorted(|answer| answer.margin.displacement);
    let displacement = spread(&displacements);
    Ok(Margins {
        best: ask(&parameters(&estimate.p)).ok().map(|answer| answer.margin),
        displacement,
        impulse: spread(&sorted(|answer| answer.margin.impulse)),
        cycle: spread(&sorted(|answer| answer.cycle)),
        fold: spread(&sorted(|answer| answer.fold)),
        extrapolated: displacement.median.is_none_or(|at| at > largest || at < smallest),
        allowed: allowed(estimate, ask),
        failed: draws - known.len(),
        displacements,
        draws: drawn,
        effective,
        motions,
    })
}

/// What D2 and D3 that the record does not exclude would allow.
fn allowed(
    estimate: &Estimate,
    ask: impl Fn(&Parameters) -> Result<MarginOfDraw, Reason>,
) -> Option<(&'static str, f64, f64)> {
    let rows = NAMES.iter().filter(|row| [D2, D3].contains(&row.place));
    let ends = rows.flat_map(|row| {
        let interval = estimate.intervals[row.place];
        [interval.lower, interval.upper].into_iter().flatten().map(move |end| (row, end))
    });
    let lost = ends.filter_map(|(row, end)| {
        let mut p = following(estimate, &[(row.place, end)]);
        p[R] = p[R].max(0.0);
        Some((row.name, end, ask(&parameters(&p)).ok()?.margin.displacement?))
    });
    lost.min_by(|one, other| one.2.total_cmp(&other.2))
}

/// The margin, the smallest stable cycle and the fold for one set of parameters.
struct MarginOfDraw {
    margin: Margin,
    /// Right turning point of the smallest stable cycle.
    cycle: Option<f64>,
    /// The damping `D_F` above which every motion is captured.
    fold: Option<f64>,
}

fn answer(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<MarginOfDraw, Reason> {
    let mut equation = Equation::new(parameters, f64::EPSILON);
    let found = all_closings(&mut equation, limits)?;
    let stable = found.iter().find(|closing| closing.log_multiplier(parameters) < 0.0);
    Ok(MarginOfDraw {
        margin: Basin::around(parameters, &found, reach, limits)?.margin(),
        cycle: stable.map(|closing| closing.describe(parameters, equation.side).q_max),
        fold: fold(parameters, limits)?.0.map(|fold| fold.d),
    })
}

fn spread(sorted: &[f64]) -> Spread {
    let at = |part: f64| -> Option<f64> {
        let index = whole(part * real(sorted.len()));
        sorted.get(index.min(sorted.len().saturating_sub(1))).copied().filter(|it| it.is_finite())
    };
    let none = sorted.iter().filter(|it| it.is_infinite()).count();
    let share = real(none) / real(sorted.len().max(1));
    Spread { median: at(0.5), lower: at(0.025), upper: at(0.975), none: share }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_margins_that_may_be_infinite() {
        let sorted: Vec<f64> = (1..=60).map(f64::from).chain([f64::INFINITY; 40]).collect();
        let found = spread(&sorted);
        assert_eq!((found.lower, found.median, found.upper), (Some(3.0), Some(51.0), None));
        assert_eq!(found.none, 0.4);
    }
}
