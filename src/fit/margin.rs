//! From the uncertainty of the parameters to that of the margin.
//!
//! D, D2, D3 and r are drawn from their joint distribution, and the smallest kick that is not survived is computed
//! exactly for each draw. The derivative would explode where the margin ends in a fold, or is infinite on one
//! side of it; quantiles do not. Draws are spread evenly (an additive recurrence) rather than at random, so few of them do.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::estimate::Estimate;
use super::observation::{D, D2, D3, R, Unknowns, parameters};
use crate::flow::{Limits, Reason};
use crate::oscillator::Parameters;
use crate::study::basin::Basin;
use crate::study::closing::Equation;
use crate::study::closings::all_closings;
use crate::study::fold::fold;
use crate::study::margin::Margin;

/// Quantiles of what may not exist, such as a margin where every kick is survived.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

/// The distribution of the margins.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Margins {
    /// At the best parameters.
    pub best: Option<Margin>,
    /// The smallest displacement that is not captured.
    pub displacement: Spread,
    /// The smallest impulse from the middle of the sticking set that is not captured, as `velocity/omega0`.
    pub impulse: Spread,
    /// The right turning point of the smallest stable cycle; none: the share without one.
    pub cycle: Spread,
    /// The damping `D_F` of the fold, above which every motion is captured; none: the share without a fold.
    pub fold: Spread,
    /// Every draw's smallest displacement in ascending order; infinite where all are survived.
    pub displacements: Vec<f64>,
    /// The parameters drawn.
    pub draws: Vec<Parameters>,
    /// Whether the median displacement lies outside the amplitudes measured.
    pub extrapolated: bool,
    /// Draws whose margin could not be computed.
    pub failed: usize,
}

/// How many draws.
pub const DRAWS: usize = 400;

/// The damping and friction numbers.
const PLACES: [usize; 4] = [D, D2, D3, R];

/// The distribution of the margins that the estimate leaves.
///
/// # Errors
/// [`Reason::Interrupted`].
pub fn margins(estimate: &Estimate, draws: usize, limits: &Limits) -> Result<Margins, Reason> {
    let (smallest, largest) = estimate.amplitudes();
    let ask = |parameters: &Parameters| answer(parameters, largest, limits);
    let drawn = drawn(estimate, draws);
    let computed: Vec<Result<Answer, Reason>> = drawn.par_iter().map(ask).collect();
    if (limits.interrupted)() {
        return Err(Reason::Interrupted);
    }
    let known: Vec<Answer> = computed.into_iter().filter_map(Result::ok).collect();
    let sorted = |pick: fn(&Answer) -> Option<f64>| {
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
    })
}

/// What follows from one set of parameters.
struct Answer {
    margin: Margin,
    /// Right turning point of the smallest stable cycle.
    cycle: Option<f64>,
    /// The damping `D_F` above which every motion is captured.
    fold: Option<f64>,
}

fn answer(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<Answer, Reason> {
    let mut equation = Equation::new(parameters, f64::EPSILON);
    let found = all_closings(&mut equation, limits)?;
    let stable = found.iter().find(|closing| closing.log_multiplier(parameters) < 0.0);
    Ok(Answer {
        margin: Basin::around(parameters, &found, reach, limits)?.margin(),
        cycle: stable.map(|closing| closing.describe(parameters, equation.side).q_max),
        fold: fold(parameters, limits)?.0.map(|fold| fold.d),
    })
}

fn spread(sorted: &[f64]) -> Spread {
    let at = |part: f64| -> Option<f64> {
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "an index"
        )]
        let index = (part * sorted.len() as f64) as usize;
        sorted.get(index.min(sorted.len().saturating_sub(1))).copied().filter(|it| it.is_finite())
    };
    let none = sorted.iter().filter(|it| it.is_infinite()).count();
    #[expect(clippy::cast_precision_loss, reason = "a count of draws")]
    let share = none as f64 / sorted.len().max(1) as f64;
    Spread { median: at(0.5), lower: at(0.025), upper: at(0.975), none: share }
}

/// Draws from the normal distribution of the estimate; with several minima each takes its part. Negative
/// friction, which the data may allow and the world does not, is none.
fn drawn(estimate: &Estimate, draws: usize) -> Vec<Parameters> {
    let covariance = DMatrix::from_fn(4, 4, |i, j| estimate.covariance.of(PLACES[i], PLACES[j]));
    // Held numbers have no variance, so the root is that of eigenvalues, not Cholesky's; scaled, since units differ.
    let scale: Vec<f64> = PLACES
        .iter()
        .map(|&place| estimate.covariance.error(place))
        .map(|error| if error > 0.0 { error } else { 1.0 })
        .collect();
    let scaled = DMatrix::from_fn(4, 4, |i, j| covariance[(i, j)] / (scale[i] * scale[j]));
    let eigen = scaled.symmetric_eigen();
    let centers: Vec<(f64, &Unknowns)> =
        estimate.contenders().map(|rival| ((-0.5 * rival.delta_chi2).exp(), &rival.p)).collect();
    let whole: f64 = centers.iter().map(|(weight, _)| weight).sum();
    let draw = |index: usize| {
        let even = evenly(index);
        let normal =
            DVector::from_fn(4, |i, _| eigen.eigenvalues[i].max(0.0).sqrt() * normal_at(even[i]));
        let step = &eigen.eigenvectors * normal;
        let mut left = even[4] * whole;
        let chosen = centers.iter().find(|(weight, _)| {
            left -= weight;
            left < 0.0
        });
        let mut p = chosen.map_or(estimate.p, |(_, p)| **p);
        for (i, &place) in PLACES.iter().enumerate() {
            p[place] += scale[i] * step[i];
        }
        p[R] = p[R].max(0.0);
        parameters(&p)
    };
    (0..draws).map(draw).collect()
}

/// Point `index` of an evenly spread sequence in five dimensions: multiples of powers of the inverse of the
/// root of `x^6 = x + 1`, modulo 1 (Roberts, 2018).
fn evenly(index: usize) -> [f64; 5] {
    const ROOT: f64 = 1.134_724_138_401_519_5;
    #[expect(clippy::cast_precision_loss, reason = "a count of draws")]
    let number = index as f64 + 1.0;
    let mut power = 1.0;
    std::array::from_fn(|_| {
        power /= ROOT;
        (0.5 + number * power).fract()
    })
}

/// The value below which a normal variable lies with this probability, to 4.5e-4 (Abramowitz and Stegun,
/// 26.2.23).
fn normal_at(probability: f64) -> f64 {
    let tail = probability.min(1.0 - probability).max(f64::MIN_POSITIVE);
    let t = (-2.0 * tail.ln()).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let value = t - above / below;
    if probability < 0.5 { -value } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_normal_and_independent() {
        const COUNT: u32 = 400;
        let drawn: Vec<[f64; 5]> = (0..COUNT as usize).map(evenly).collect();
        let mean = |value: &dyn Fn(&[f64; 5]) -> f64| {
            drawn.iter().map(value).sum::<f64>() / f64::from(COUNT)
        };
        for i in 0..4 {
            assert!(mean(&|it| normal_at(it[i])).abs() < 0.03);
            assert!((mean(&|it| normal_at(it[i]).powi(2)) - 1.0).abs() < 0.04);
            for j in 0..i {
                assert!(mean(&|it| normal_at(it[i]) * normal_at(it[j])).abs() < 0.07, "{i} {j}");
            }
        }
        for (probability, value) in [(0.5, 0.0), (0.975, 1.959_964), (0.05, -1.644_854)] {
            assert!((normal_at(probability) - value).abs() < 5e-4);
        }
    }

    #[test]
    fn quantiles_of_margins_that_may_be_infinite() {
        let sorted: Vec<f64> = (1..=60).map(f64::from).chain([f64::INFINITY; 40]).collect();
        let found = spread(&sorted);
        assert_eq!((found.lower, found.median, found.upper), (Some(3.0), Some(51.0), None));
        assert_eq!(found.none, 0.4);
    }
}
