//! Joint confidence regions of two unknowns: the contour in their plane along which the loss, with all other
//! unknowns refitted, has risen by a given amount.

use nalgebra::{Matrix2, Vector2};

use super::estimate::Estimate;
use super::levenberg_marquardt::{NoFit, Runs};
use super::observation::{R, UNKNOWNS, Unknowns};
use super::refit::Refit;
use crate::numerics::elementary::{cos, sin};

/// Rises of chi-squared whose contours contain two unknowns with a probability of 68 and 95 %.
pub const RISES: [f64; 2] = [2.3, 6.0];

/// Number of directions in which the contour is located.
const DIRECTIONS: u32 = 24;

/// The contour around the estimate along which chi-squared has risen by `rise`, in the plane of two free unknowns.
/// It is cut off at r = 0. Fails with [`NoFit::Interrupted`].
pub fn contour(
    estimate: &Estimate,
    places: [usize; 2],
    rise: f64,
    runs: &mut Runs,
) -> Result<Vec<[f64; 2]>, NoFit> {
    let of = |one: usize, other: usize| estimate.covariance.of(one, other);
    let [one, other] = places;
    let plane = Matrix2::new(of(one, one), of(one, other), of(other, one), of(other, other));
    let (Some(root), Some(inverse)) = (plane.cholesky(), plane.try_inverse()) else {
        return Ok(Vec::new());
    };
    let refit = Refit::without(estimate, &places);
    let (cost, unit) = (refit.cost(&estimate.p, runs)?, refit.unit(runs)?);
    let mut points = Vec::new();
    for index in 0..DIRECTIONS {
        let angle = std::f64::consts::TAU * f64::from(index) / f64::from(DIRECTIONS);
        let step = rise.sqrt() * root.l() * Vector2::new(cos(angle), sin(angle));
        // The linear model predicts the other unknowns.
        let weights = inverse * step;
        let along: Unknowns = std::array::from_fn(|place| {
            if place == one {
                step[0]
            } else if place == other {
                step[1]
            } else {
                of(place, one) * weights[0] + of(place, other) * weights[1]
            }
        });
        if let Some(at) = refit.risen(along, (cost, rise * unit), runs)? {
            points.push([estimate.p[one] + at * step[0], estimate.p[other] + at * step[1]]);
        }
    }
    points.extend(points.first().copied());
    Ok(points)
}

impl Refit<'_> {
    /// The distance along a direction at which the loss, `cost` at the estimate, has risen by `rise`; `None` if
    /// the motion escapes before.
    fn risen(
        &self,
        along: [f64; UNKNOWNS],
        (cost, rise): (f64, f64),
        runs: &mut Runs,
    ) -> Result<Option<f64>, NoFit> {
        /// Number of refits. Each corrects the distance by the rise found before, as for a quadratic loss; if
        /// the loss is quadratic, the first distance is right.
        const ROUNDS: usize = 3;
        let p = &self.estimate.p;
        let farthest = if along[R] < 0.0 { -p[R] / along[R] } else { f64::INFINITY };
        let mut at = f64::min(1.0, farthest);
        for _ in 0..ROUNDS {
            let guess = std::array::from_fn(|place| p[place] + at * along[place]);
            let found = match self.at(guess, runs) {
                Ok(found) => found,
                Err(NoFit::Lost) => return Ok(None),
                Err(NoFit::Interrupted) => return Err(NoFit::Interrupted),
            };
            let part = ((found.cost - cost).max(0.0) / rise).sqrt();
            if (part - 1.0).abs() < 0.03 || part < 1.0 && at >= farthest {
                break;
            }
            at = (at / part.clamp(0.4, 2.5)).min(farthest);
        }
        Ok(Some(at))
    }
}
