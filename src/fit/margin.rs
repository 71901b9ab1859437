//! The uncertainty of the margin that follows from that of the parameters.
//!
//! D, D2, D3 and r are drawn from their joint distribution, and the smallest kick that is not survived is computed
//! exactly for each draw. Linear error propagation would fail near a fold, where the derivative of the margin
//! diverges or the margin is infinite on one side; quantiles remain valid. Draws are spread evenly (an additive
//! recurrence) rather than at random, so few of them suffice. If the loss is not quadratic they come from the
//! likelihood itself ([`super::posterior`]). What a disturbance and tolerances leave of the margin is computed for each
//! draw, too, so that what is correlated stays correlated.

use rayon::prelude::*;
use serde::{Serialize, Serializer};

use super::{
    D2, D3, Draws, Estimate, Inertia, NAMES, OMEGA0, Unknowns, drawn, following, parameters,
};
use crate::branch::fold;
use crate::flow::{Limits, Result};
use crate::model::{Knob, ParameterBox, Parameters};
use crate::numerics::{real, truncated};
use crate::portrait::{Kicks, Margin, Portrait, guaranteed};

/// What is asked of the margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarginQuestion {
    /// Least number of draws; a high confidence takes more.
    pub draws: usize,
    /// Probability that a kick below the guaranteed margin is survived.
    pub confidence: f64,
    /// Largest force of a disturbance: in N with `inertia`, else over the stiffness, a length in the unit of the record.
    pub disturbance: f64,
    /// Half widths of D, D2, D3 and r, by which they may change after the record was made.
    pub half_widths: [f64; 4],
    /// Mass or stiffness, if known, and the unit of the displacements in m.
    pub inertia: Option<(Inertia, f64)>,
}

impl Default for MarginQuestion {
    fn default() -> Self {
        let (confidence, disturbance, half_widths, inertia) = (0.95, 0.0, [0.0; 4], None);
        MarginQuestion { draws: DRAWS, confidence, disturbance, half_widths, inertia }
    }
}

impl MarginQuestion {
    /// The number of effective draws that the quantile takes: ten of them lie beyond it.
    #[must_use]
    pub fn needed(&self) -> usize {
        truncated((10.0 / (1.0 - self.confidence)).round())
    }

    /// Whether anything beside the uncertainty of the fit is to be survived.
    #[must_use]
    pub fn is_disturbed(&self) -> bool {
        self.disturbance > 0.0 || self.half_widths.iter().any(|it| *it > 0.0)
    }

    /// The margin that holds whatever the disturbance and the tolerances do.
    fn guaranteed(&self, p: &Unknowns, plain: &Margin, limits: &Limits) -> Result<Margin> {
        if !self.is_disturbed() {
            return Ok(*plain);
        }
        let scale = self.inertia.map_or(1.0, |(it, metres)| metres * it.times(p[OMEGA0], 2));
        let half_widths = Knob::PARAMETERS.into_iter().zip(self.half_widths);
        let known = ParameterBox::around(&parameters(p), half_widths);
        let found = guaranteed(&known, self.disturbance / scale, 0.0, limits)?;
        Ok(found.map_or(Margin::ZERO, |(_, margin)| margin))
    }
}

/// Quantiles of a quantity that may not exist, such as the margin if every kick is survived.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct MarginSpread {
    /// The median; `None` if the quantity does not exist in at least half of the draws.
    pub median: Option<f64>,
    /// The 2.5 % quantile.
    pub lower: Option<f64>,
    /// The 97.5 % quantile.
    pub upper: Option<f64>,
    /// The fraction of draws in which the quantity does not exist.
    pub none: f64,
}

impl MarginSpread {
    fn of(values: impl Iterator<Item = Option<f64>>) -> Self {
        let sorted = sorted(values);
        let at = |part: f64| quantile(&sorted, part);
        let none = sorted.iter().filter(|it| it.is_infinite()).count();
        let share = real(none) / real(sorted.len().max(1));
        MarginSpread { median: at(0.5), lower: at(0.025), upper: at(0.975), none: share }
    }

    /// The same in another unit.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        let [median, lower, upper] =
            [self.median, self.lower, self.upper].map(|it| it.map(|value| value * by));
        MarginSpread { median, lower, upper, none: self.none }
    }
}

/// A displacement that is not survived with D2 or D3 at an end of its interval and all other numbers following.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AllowedLoss {
    /// `D2` or `D3`.
    pub name: &'static str,
    /// Its value at that end.
    pub value: f64,
    /// The smallest displacement that is not survived there.
    pub displacement: f64,
}

/// The distribution of the margins.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Margins {
    /// The smallest kicks that are not survived.
    #[serde(flatten)]
    pub kicks: Kicks<MarginSpread>,
    /// All of these whatever a disturbance and tolerances do, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub guaranteed: Option<Kicks<MarginSpread>>,
    /// `omega0` and the guaranteed margin of each draw; a margin that could not be computed counts as none.
    #[serde(skip)]
    pub each: Vec<(f64, Margin)>,
    /// What was asked.
    #[serde(skip)]
    pub question: MarginQuestion,
    /// The right turning point of the smallest stable cycle; `none` is the fraction of draws without one.
    pub cycle: MarginSpread,
    /// The damping `D_F` of the fold, above which every motion is captured; `none` is the fraction of draws
    /// without a fold.
    pub fold: MarginSpread,
    /// Whether the median displacement lies outside the amplitudes measured.
    pub extrapolated: bool,
    /// What the record does not exclude and is not survived, with the smallest displacement.
    #[serde(skip)]
    pub allowed: Option<AllowedLoss>,
    /// The smallest change of position from the worst rest position that is not captured, for every draw, in ascending
    /// order; infinite if all are survived.
    #[serde(skip)]
    pub shifts: Vec<f64>,
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

impl Margins {
    /// The lower one-sided quantile, at the confidence asked for, of what `of` makes of `omega0` and the guaranteed
    /// margin; `None` if it does not exist there.
    #[must_use]
    pub fn certain(&self, of: impl Fn(f64, &Margin) -> Option<f64>) -> Option<f64> {
        let values = sorted(self.each.iter().map(|(omega0, margin)| of(*omega0, margin)));
        quantile(&values, 1.0 - self.question.confidence)
    }
}

/// The distribution of the margins that follows from an estimate.
///
/// # Errors
/// [`Reason::Interrupted`](crate::model::Reason::Interrupted).
pub fn margins(estimate: &Estimate, question: &MarginQuestion, limits: &Limits) -> Result<Margins> {
    let (smallest, largest) = estimate.amplitudes();
    let ask = |p: &Unknowns| answer(&parameters(p), largest, limits);
    let draws = question.draws.max(question.needed());
    let Draws { sample: drawn, effective, motions } = drawn(estimate, draws, limits)?;
    let compute = |p: &Unknowns| {
        let found = ask(p).ok()?;
        let sure = question.guaranteed(p, &found.margin, limits).ok()?;
        Some((found, sure))
    };
    let computed: Vec<_> = drawn.par_iter().map(compute).collect();
    limits.go_on()?;
    let sure = computed.iter().map(|it| it.as_ref().map_or(Margin::ZERO, |(_, sure)| *sure));
    let each: Vec<(f64, Margin)> = drawn.iter().map(|p| p[OMEGA0]).zip(sure).collect();
    let known: Vec<MarginOfDraw> = computed.into_iter().flatten().map(|(found, _)| found).collect();
    let kicks = Kicks::of(|pick| MarginSpread::of(known.iter().map(|it| pick(&it.margin))));
    let guaranteed = || Kicks::of(|pick| MarginSpread::of(each.iter().map(|it| pick(&it.1))));
    Ok(Margins {
        kicks,
        guaranteed: question.is_disturbed().then(guaranteed),
        question: *question,
        cycle: MarginSpread::of(known.iter().map(|it| it.cycle)),
        fold: MarginSpread::of(known.iter().map(|it| it.fold)),
        extrapolated: kicks.displacement.median.is_none_or(|at| at > largest || at < smallest),
        allowed: allowed(estimate, ask),
        failed: draws - known.len(),
        shifts: sorted(known.iter().map(|it| it.margin.from_rest.displacement)),
        draws: drawn.iter().map(parameters).collect(),
        each,
        effective,
        motions,
    })
}

/// What D2 and D3 that the record does not exclude would allow.
fn allowed(
    estimate: &Estimate,
    ask: impl Fn(&Unknowns) -> Result<MarginOfDraw>,
) -> Option<AllowedLoss> {
    let rows = NAMES.iter().filter(|row| [D2, D3].contains(&row.place));
    let ends = rows.flat_map(|row| {
        let interval = estimate.intervals[row.place];
        [interval.lower, interval.upper].into_iter().flatten().map(move |end| (row, end))
    });
    let lost = ends.filter_map(|(row, end)| {
        let p = following(estimate, &[(row.place, end)]);
        let displacement = ask(&p).ok()?.margin.displacement?;
        Some(AllowedLoss { name: row.name, value: end, displacement })
    });
    lost.min_by(|one, other| one.displacement.total_cmp(&other.displacement))
}

/// The margin, the smallest stable cycle and the fold for one set of parameters.
struct MarginOfDraw {
    margin: Margin,
    /// Right turning point of the smallest stable cycle.
    cycle: Option<f64>,
    /// The damping `D_F` above which every motion is captured.
    fold: Option<f64>,
}

fn answer(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<MarginOfDraw> {
    let Portrait { margin, cycles, .. } = Portrait::of_oscillator(parameters, reach, limits)?;
    let cycle = cycles.iter().find(|cycle| cycle.stable).map(|cycle| cycle.q_max);
    let fold = fold(parameters, limits)?.0.map(|fold| fold.d);
    Ok(MarginOfDraw { margin, cycle, fold })
}

/// In ascending order, infinite where there is none.
pub fn sorted(values: impl Iterator<Item = Option<f64>>) -> Vec<f64> {
    let mut values: Vec<f64> = values.map(|it| it.unwrap_or(f64::INFINITY)).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The value below which at most this part of the sorted ones lies.
pub fn quantile(sorted: &[f64], part: f64) -> Option<f64> {
    let index = truncated(part * real(sorted.len()));
    sorted.get(index.min(sorted.len().saturating_sub(1))).copied().filter(|it| it.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_margins_that_may_be_infinite() {
        let found = MarginSpread::of((1..=60).map(|it| Some(f64::from(it))).chain([None; 40]));
        assert_eq!((found.lower, found.median, found.upper), (Some(3.0), Some(51.0), None));
        assert_eq!(found.none, 0.4);
    }
}
