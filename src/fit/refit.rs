//! Refits of an estimate with some numbers held at new values, and the contours along which the loss has then risen.

use nalgebra::{Matrix2, Vector2};

use super::{
    Covariance, Estimate, ProfileInterval, R, Rival, Runs, Task, UNKNOWNS, Unfit, Unknowns,
    interrupted, moved,
};
use crate::numerics::elementary::{cos, sin};

impl Estimate {
    /// What was estimated, with these unknowns held. The loss is that of the samples that count.
    pub fn task(&self, held: &[usize]) -> Task<'_> {
        let task = Task::new(&self.data, self.start, self.free, self.reach);
        held.iter()
            .fold(Task { dropped: &self.left_out, ..task }, |task, place| task.holding(*place))
    }

    /// The loss that corresponds to one unit of chi-squared. It is larger for correlated noise, with which larger
    /// differences occur by chance.
    ///
    /// # Errors
    /// [`Unfit`] when interrupted.
    pub fn unit(&self, runs: &mut Runs) -> Result<f64, Unfit> {
        let task = self.task(&[]);
        let cost = task.cost(&task.evaluated(&self.p, false, runs)?);
        Ok(cost / self.covariance.freedom * self.covariance.inflation(R))
    }
}

/// The estimate with some numbers held: everything that follows from the new minimum, except intervals and rivals.
///
/// # Errors
/// [`Unfit::NoMotion`] if the motion with these numbers escapes; [`Unfit::Blind`]; [`Unfit::Interrupted`].
pub fn held(
    estimate: &Estimate,
    numbers: &[(usize, f64)],
    runs: &mut Runs,
) -> Result<Estimate, Unfit> {
    let places: Vec<usize> = numbers.iter().map(|(place, _)| *place).collect();
    let task = estimate.task(&places);
    let optimum = task.solve_roughly(following(estimate, numbers), runs)?;
    let autocorrelation = &estimate.whiteness.autocorrelation;
    let covariance = Covariance::at(&task, &optimum, autocorrelation).ok_or(Unfit::Blind)?;
    let half_swings = optimum.seen.turns.len();
    Ok(Estimate {
        p: optimum.p,
        free: task.free,
        covariance,
        // The ends are not computed; it is assumed that the likelihood is quadratic where it was before.
        intervals: estimate.intervals.map(|it| ProfileInterval { lower: None, upper: None, ..it }),
        residuals: optimum.seen.residuals.iter().map(|residual| residual.value).collect(),
        half_swings,
        rests: optimum.seen.rests,
        rivals: vec![Rival { half_swings, delta_chi2: 0.0, p: optimum.p }],
        ..estimate.clone()
    })
}

/// All unknowns as predicted by the linear model, after some have been set to new values; friction is not negative.
pub fn following(estimate: &Estimate, numbers: &[(usize, f64)]) -> Unknowns {
    let change = |(place, value): &(usize, f64)| (*place, value - estimate.p[*place]);
    let changes: Vec<(usize, f64)> = numbers.iter().map(change).collect();
    let mut guess = moved(&estimate.p, 1.0, &estimate.covariance.following(&changes));
    for (place, value) in numbers {
        guess[*place] = *value;
    }
    guess[R] = guess[R].max(0.0);
    guess
}

/// Rises of chi-squared whose contours contain two unknowns with a probability of 68 and 95 %.
pub const RISES: [f64; 2] = [2.3, 6.0];

/// The contour around the estimate along which chi-squared has risen by `rise`, in the plane of two free unknowns.
/// It is cut off at r = 0. Fails with [`Unfit::Interrupted`].
pub fn contour(
    estimate: &Estimate,
    places: [usize; 2],
    rise: f64,
    runs: &mut Runs,
) -> Result<Vec<[f64; 2]>, Unfit> {
    /// Number of directions in which the contour is located.
    const DIRECTIONS: u32 = 24;
    let of = |one: usize, other: usize| estimate.covariance.of(one, other);
    let [one, other] = places;
    let plane = Matrix2::new(of(one, one), of(one, other), of(other, one), of(other, other));
    let Some(root) = plane.cholesky() else { return Ok(Vec::new()) };
    let task = estimate.task(&places);
    let cost = task.cost(&task.evaluated(&estimate.p, false, runs)?);
    let unit = estimate.unit(runs)?;
    let mut points = Vec::new();
    for index in 0..DIRECTIONS {
        let angle = std::f64::consts::TAU * f64::from(index) / f64::from(DIRECTIONS);
        let step = rise.sqrt() * root.l() * Vector2::new(cos(angle), sin(angle));
        // The linear model predicts the other unknowns.
        let along = estimate.covariance.following(&[(one, step[0]), (other, step[1])]);
        if let Some(at) = risen(&task, &estimate.p, along, (cost, rise * unit), runs)? {
            points.push([estimate.p[one] + at * step[0], estimate.p[other] + at * step[1]]);
        }
    }
    points.extend(points.first().copied());
    Ok(points)
}

/// The distance from a point along a direction at which the loss, `cost` at the point, has risen by `rise`; `None` if
/// the motion escapes before.
fn risen(
    task: &Task,
    p: &Unknowns,
    along: [f64; UNKNOWNS],
    (cost, rise): (f64, f64),
    runs: &mut Runs,
) -> Result<Option<f64>, Unfit> {
    /// Number of refits. Each corrects the distance by the rise found before, as for a quadratic loss; if
    /// the loss is quadratic, the first distance is right.
    const ROUNDS: usize = 3;
    let farthest = if along[R] < 0.0 { -p[R] / along[R] } else { f64::INFINITY };
    let mut at = f64::min(1.0, farthest);
    for _ in 0..ROUNDS {
        let mut guess = moved(p, at, &along);
        guess[R] = guess[R].max(0.0);
        let found = interrupted(task.solve_roughly(guess, runs))?;
        let Some(found) = found else { return Ok(None) };
        let part = ((found.cost - cost).max(0.0) / rise).sqrt();
        if (part - 1.0).abs() < 0.03 || part < 1.0 && at >= farthest {
            break;
        }
        at = (at / part.clamp(0.4, 2.5)).min(farthest);
    }
    Ok(Some(at))
}
