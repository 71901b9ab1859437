//! A fit after one number has been moved: all others follow, from where they were.

use super::estimate::Estimate;
use super::levenberg_marquardt::{Effort, NoFit, Optimum, Task};
use super::loss::Loss;
use super::observation::{D2, D3, Observation, R};

/// The best motion with one of the unknowns held at a value; the loss is that of the samples that count.
///
/// # Errors
/// [`NoFit`] where the motion with that value escapes, or somebody interrupts.
pub fn refitted(
    estimate: &Estimate,
    place: usize,
    value: f64,
    effort: &mut Effort,
) -> Result<Optimum, NoFit> {
    let mut free = estimate.free;
    free[place] = false;
    let observation = Observation {
        data: estimate.data.clone(),
        start: estimate.start,
        linear: !free[D2] && !free[D3],
        reach: estimate.reach,
    };
    let used = &estimate.used;
    let task =
        Task { observation: &observation, free, loss: Loss::Linear, used, horizon: usize::MAX };
    // The others follow by the linear model first; the descent has the rest to do.
    let along = estimate.covariance.along(place);
    let step = value - estimate.p[place];
    let mut guess = std::array::from_fn(|other| estimate.p[other] + step * along[other]);
    guess[place] = value;
    guess[R] = f64::max(guess[R], 0.0);
    task.solve_roughly(guess, effort)
}
