//! A fit after some of its numbers have been moved: all others follow, from where they were.

use super::estimate::Estimate;
use super::levenberg_marquardt::{NoFit, Optimum, Runs, Task};
use super::loss::Loss;
use super::observation::{D2, D3, Observation, R, UNKNOWNS, Unknowns};

/// An estimate of which some unknowns are held; the loss is that of the samples that count.
pub struct Refit<'a> {
    /// What was estimated.
    pub estimate: &'a Estimate,
    observation: Observation,
    free: [bool; UNKNOWNS],
}

impl<'a> Refit<'a> {
    /// The estimate with these unknowns held, wherever that will be.
    #[must_use]
    pub fn without(estimate: &'a Estimate, places: &[usize]) -> Self {
        let mut free = estimate.free;
        for place in places {
            free[*place] = false;
        }
        let observation = Observation {
            data: estimate.data.clone(),
            start: estimate.start,
            linear: !free[D2] && !free[D3],
            reach: estimate.reach,
        };
        Refit { estimate, observation, free }
    }

    fn task(&self) -> Task<'_> {
        Task {
            observation: &self.observation,
            free: self.free,
            loss: Loss::Linear,
            used: &self.estimate.used,
            horizon: usize::MAX,
        }
    }

    /// The best motion near a guess, with the held unknowns as they are there.
    ///
    /// # Errors
    /// [`NoFit`] where that motion escapes, or when interrupted.
    pub fn at(&self, mut guess: Unknowns, runs: &mut Runs) -> Result<Optimum, NoFit> {
        guess[R] = guess[R].max(0.0);
        self.task().solve_roughly(guess, runs)
    }

    /// The loss at a point.
    ///
    /// # Errors
    /// [`NoFit`] where the motion escapes, or when interrupted.
    pub fn cost(&self, p: &Unknowns, runs: &mut Runs) -> Result<f64, NoFit> {
        let task = self.task();
        Ok(task.cost(&task.look(p, false, runs)?))
    }

    /// The loss that one unit of chi-squared is worth; correlated noise makes larger differences by chance.
    ///
    /// # Errors
    /// [`NoFit`] when interrupted.
    pub fn unit(&self, runs: &mut Runs) -> Result<f64, NoFit> {
        let covariance = &self.estimate.covariance;
        Ok(self.cost(&self.estimate.p, runs)? / covariance.freedom * covariance.inflation(R))
    }
}

/// The best motion with one of the unknowns held at a value.
///
/// # Errors
/// [`NoFit`] where the motion with that value escapes, or when interrupted.
pub fn refitted(
    estimate: &Estimate,
    place: usize,
    value: f64,
    runs: &mut Runs,
) -> Result<Optimum, NoFit> {
    // The others follow by the linear model first; the descent has the rest to do.
    let along = estimate.covariance.along(place);
    let step = value - estimate.p[place];
    let mut guess: Unknowns = std::array::from_fn(|other| estimate.p[other] + step * along[other]);
    guess[place] = value;
    Refit::without(estimate, &[place]).at(guess, runs)
}
