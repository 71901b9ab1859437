//! Refits of an estimate with some numbers held at new values.

use nalgebra::{DMatrix, DVector};

use super::estimate::{Estimate, Rival};
use super::levenberg_marquardt::{NoFit, Optimum, Runs, Task};
use super::loss::Loss;
use super::observation::{D2, D3, Observation, R, UNKNOWNS, Unknowns};
use super::profile::ProfileInterval;
use super::question::Unfit;
use super::uncertainty::Covariance;

/// An estimate with some unknowns held. The loss is that of the samples that count.
pub struct Refit<'a> {
    /// The original estimate.
    pub estimate: &'a Estimate,
    observation: Observation,
    free: [bool; UNKNOWNS],
}

impl<'a> Refit<'a> {
    /// The estimate with these unknowns held, at values to be given later.
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

    /// The least-squares task.
    pub fn task(&self) -> Task<'_> {
        Task {
            observation: &self.observation,
            free: self.free,
            loss: Loss::Linear,
            used: &self.estimate.used,
            horizon: usize::MAX,
            within: None,
        }
    }

    /// The best motion near a guess, with the held unknowns as in the guess.
    ///
    /// # Errors
    /// [`NoFit`] if the motion of the guess escapes, or when interrupted.
    pub fn at(&self, mut guess: Unknowns, runs: &mut Runs) -> Result<Optimum, NoFit> {
        guess[R] = guess[R].max(0.0);
        self.task().solve_roughly(guess, runs)
    }

    /// The loss at a point.
    ///
    /// # Errors
    /// [`NoFit`] if the motion escapes, or when interrupted.
    pub fn cost(&self, p: &Unknowns, runs: &mut Runs) -> Result<f64, NoFit> {
        let task = self.task();
        Ok(task.cost(&task.evaluated(p, false, runs)?))
    }

    /// The loss that corresponds to one unit of chi-squared. It is larger for correlated noise, with which larger
    /// differences occur by chance.
    ///
    /// # Errors
    /// [`NoFit`] when interrupted.
    pub fn unit(&self, runs: &mut Runs) -> Result<f64, NoFit> {
        let covariance = &self.estimate.covariance;
        Ok(self.cost(&self.estimate.p, runs)? / covariance.freedom * covariance.inflation(R))
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
    let refit = Refit::without(estimate, &places);
    let optimum = refit.at(following(estimate, numbers), runs)?;
    let task = refit.task();
    let autocorrelation = &estimate.whiteness.autocorrelation;
    let covariance = Covariance::at(&task, &optimum, autocorrelation).ok_or(Unfit::Blind)?;
    let half_swings = optimum.seen.turns.len();
    Ok(Estimate {
        p: optimum.p,
        free: refit.free,
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

/// All unknowns as predicted by the linear model, after some have been set to new values.
pub fn following(estimate: &Estimate, numbers: &[(usize, f64)]) -> Unknowns {
    let Covariance { columns, white, .. } = &estimate.covariance;
    let at = |place: usize| columns.iter().position(|column| *column == place);
    let white = |one, other| at(one).zip(at(other)).map_or(0.0, |place| white[place]);
    let moved: Vec<&(usize, f64)> =
        numbers.iter().filter(|(place, _)| estimate.free[*place]).collect();
    let among = DMatrix::from_fn(moved.len(), moved.len(), |row, column| {
        white(moved[row].0, moved[column].0)
    });
    let steps = DVector::from_fn(moved.len(), |row, _| moved[row].1 - estimate.p[moved[row].0]);
    let weights = among.lu().solve(&steps).unwrap_or_else(|| DVector::zeros(moved.len()));
    let mut guess: Unknowns = std::array::from_fn(|place| {
        let follows = moved.iter().zip(weights.iter());
        let step: f64 = follows.map(|(held, weight)| white(place, held.0) * weight).sum();
        estimate.p[place] + step
    });
    for (place, value) in numbers {
        guess[*place] = *value;
    }
    guess
}

/// The best motion with one of the unknowns held at a value.
///
/// # Errors
/// [`NoFit`] if the motion with that value escapes, or when interrupted.
pub fn refitted(
    estimate: &Estimate,
    place: usize,
    value: f64,
    runs: &mut Runs,
) -> Result<Optimum, NoFit> {
    // The descent starts from the prediction of the linear model.
    let guess = following(estimate, &[(place, value)]);
    Refit::without(estimate, &[place]).at(guess, runs)
}
