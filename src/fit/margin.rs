//! From the uncertainty of the parameters to that of the margin.
//!
//! D, D2, D3 and r are drawn from their joint distribution, and the smallest kick that is not survived is computed
//! exactly for each draw. The derivative would explode where the margin ends in a fold, or is infinite on one
//! side of it; quantiles do not. Draws are spread evenly (an additive recurrence) rather than at random, so few of
//! them suffice. Where the loss is not quadratic they come from the likelihood itself ([`super::posterior`]).

use rayon::prelude::*;
use serde::{Serialize, Serializer};

use super::estimate::Estimate;
use super::observation::parameters;
use super::posterior::{Drawn, drawn};
use crate::flow::{Limits, Reason};
use crate::numerics::count::{real, whole};
use crate::oscillator::Parameters;
use crate::study::basin::Basin;
use crate::study::closing::Equation;
use crate::study::closings::all_closings;
use crate::study::fold::fold;
use crate::study::margin::Margin;

/// Quantiles of what may not exist, such as a margin where every kick is survived.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// The median; `None` where most draws have none.
    pub median: Option<f64>,
    /// 2.5 % lie below.
    pub lower: Option<f64>,
    /// 2.5 % lie above.
    pub upper: Option<f64>,
    /// The share of draws in which there is none.
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
    /// The right turning point of the smallest stable cycle; none: the share without one.
    pub cycle: Spread,
    /// The damping `D_F` of the fold, above which every motion is captured; none: the share without a fold.
    pub fold: Spread,
    /// Whether the median displacement lies outside the amplitudes measured.
    pub extrapolated: bool,
    /// Every draw's smallest displacement in ascending order; infinite where all are survived.
    #[serde(skip)]
    pub displacements: Vec<f64>,
    /// The parameters drawn.
    #[serde(serialize_with = "number")]
    pub draws: Vec<Parameters>,
    /// Where draws were weighted by their likelihood: as many of equal weight would tell as much.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effective: Option<f64>,
    /// Motions computed to weigh them.
    #[serde(skip)]
    pub motions: u64,
    /// Draws whose margin could not be computed.
    pub failed: usize,
}

fn number<S: Serializer>(draws: &[Parameters], out: S) -> Result<S::Ok, S::Error> {
    draws.len().serialize(out)
}

/// How many draws.
pub const DRAWS: usize = 400;

/// The distribution of the margins that the estimate leaves.
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
        failed: draws - known.len(),
        displacements,
        draws: drawn,
        effective,
        motions,
    })
}

/// What follows from one set of parameters.
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
