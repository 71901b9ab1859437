//! Intervals by the profile of the loss, where it is not quadratic.
//!
//! The 95 % interval ends where the loss, minimized over all other unknowns, has risen by as much as noise alone
//! explains. If the loss is quadratic, the ends lie at a multiple of the standard error from the minimum, which is
//! checked by one motion on each side. Otherwise the ends are found by refitting all other unknowns.

use super::levenberg_marquardt::{NoFit, Optimum, Runs, Task};
use super::observation::{R, Unknowns};
use super::uncertainty::{Covariance, deviation_of_95_percent};

/// A 95 % interval.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProfileInterval {
    /// Its lower end; `None` if the data set no bound.
    pub lower: Option<f64>,
    /// Its upper end; `None` if the data set no bound.
    pub upper: Option<f64>,
    /// Whether the loss is quadratic within it.
    pub quadratic: bool,
}

impl ProfileInterval {
    /// The smallest interval that contains both.
    pub fn joined(self, other: ProfileInterval) -> Self {
        let both = |one: Option<f64>, two: Option<f64>, pick: fn(f64, f64) -> f64| {
            one.zip(two).map(|(one, two)| pick(one, two))
        };
        ProfileInterval {
            lower: both(self.lower, other.lower, f64::min),
            upper: both(self.upper, other.upper, f64::max),
            quadratic: false,
        }
    }
}

/// Largest deviation of the rise of the loss from that of a quadratic one, relative to the latter.
const QUADRATIC: f64 = 0.2;

/// Maximum number of refits for one end.
const REFITS: usize = 8;

/// Distance beyond which no bound is sought, in half widths of the interval by the standard error.
const FARTHEST: f64 = 60.0;

/// The profile of one unknown about a minimum.
pub struct Profile<'a> {
    /// The fit.
    pub task: &'a Task<'a>,
    /// The minimum.
    pub optimum: &'a Optimum,
    /// Its covariance.
    pub covariance: &'a Covariance,
}

impl Profile<'_> {
    /// The interval of an unknown. Fails with [`NoFit::Interrupted`].
    pub fn interval(&self, unknown: usize, runs: &mut Runs) -> Result<ProfileInterval, NoFit> {
        let z = deviation_of_95_percent(self.covariance.independent(unknown));
        let reach = z * self.covariance.error(unknown);
        let white = self.covariance.inflation(unknown);
        let variance = self.task.variance(&self.optimum.seen, self.covariance.freedom);
        let rise = z * z * white * variance;
        let mut ends = [None; 2];
        let mut quadratic = true;
        for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
            let straight = self.shifted(&self.optimum.p, unknown, sign * reach);
            // Friction cannot be negative: r ends at 0, and unknowns that depend on r have a kink there.
            let crosses = straight[R] < 0.0 && self.task.free[R];
            if !crosses && self.rises_by(&straight, rise, runs)? {
                *end = Some(straight[unknown]);
                continue;
            }
            quadratic = false;
            *end = self.sought(unknown, sign, reach, rise, runs)?;
        }
        Ok(ProfileInterval { lower: ends[0], upper: ends[1], quadratic })
    }

    /// The interval by the standard error alone, without a profile.
    pub fn straight(&self, unknown: usize) -> ProfileInterval {
        let z = deviation_of_95_percent(self.covariance.independent(unknown));
        let (center, reach) = (self.optimum.p[unknown], z * self.covariance.error(unknown));
        let least = if unknown == R { 0.0 } else { f64::NEG_INFINITY };
        let lower = Some((center - reach).max(least));
        ProfileInterval { lower, upper: Some(center + reach), quadratic: true }
    }

    fn shifted(&self, from: &Unknowns, unknown: usize, by: f64) -> Unknowns {
        let along = self.covariance.along(unknown);
        std::array::from_fn(|place| from[place] + by * along[place])
    }

    /// Whether the loss at `p` has risen as a quadratic one would have.
    fn rises_by(&self, p: &Unknowns, rise: f64, runs: &mut Runs) -> Result<bool, NoFit> {
        match self.task.look(p, false, runs) {
            Ok(seen) => {
                let risen = self.task.cost(&seen) - self.optimum.cost;
                Ok((risen / rise - 1.0).abs() <= QUADRATIC)
            }
            Err(NoFit::Interrupted) => Err(NoFit::Interrupted),
            Err(NoFit::Lost) => Ok(false),
        }
    }

    /// The end on one side, by refits: a secant method on the square root of the rise, which is linear for a
    /// quadratic loss.
    fn sought(
        &self,
        unknown: usize,
        sign: f64,
        reach: f64,
        rise: f64,
        runs: &mut Runs,
    ) -> Result<Option<f64>, NoFit> {
        let center = self.optimum.p[unknown];
        let farthest = if unknown == R && sign < 0.0 { center } else { FARTHEST * reach };
        if farthest <= 0.0 {
            return Ok(Some(center));
        }
        let mut task = *self.task;
        task.free[unknown] = false;
        let (mut inside, mut outside): ((f64, f64), Option<(f64, f64)>) = ((0.0, 0.0), None);
        let mut warm = self.optimum.p;
        let mut step = reach.min(farthest);
        for _ in 0..REFITS {
            let mut guess = self.shifted(&warm, unknown, center + sign * step - warm[unknown]);
            guess[unknown] = center + sign * step;
            guess[R] = guess[R].max(0.0);
            let risen = match task.solve_roughly(guess, runs) {
                Ok(found) => {
                    warm = found.p;
                    ((found.cost - self.optimum.cost).max(0.0) / rise).sqrt()
                }
                Err(NoFit::Interrupted) => return Err(NoFit::Interrupted),
                Err(NoFit::Lost) => f64::INFINITY,
            };
            if (risen - 1.0).abs() <= 0.02 {
                return Ok(Some(center + sign * step));
            }
            if risen < 1.0 {
                if step >= farthest {
                    return Ok((unknown == R && sign < 0.0).then_some(0.0));
                }
                inside = (step, risen);
            } else {
                outside = Some((step, risen));
            }
            step = match outside {
                None => (step * (1.1 / risen.max(0.2))).max(1.2 * step).min(farthest),
                Some((far, high)) if high.is_finite() => {
                    let part = (1.0 - inside.1) / (high - inside.1);
                    inside.0 + part.clamp(0.1, 0.9) * (far - inside.0)
                }
                Some((far, _)) => 0.5 * (inside.0 + far),
            };
        }
        Ok(outside.map(|_| center + sign * step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_intervals_hold_both_and_stay_open_where_one_is() {
        let one = ProfileInterval { lower: Some(1.0), upper: Some(2.0), quadratic: true };
        let other = ProfileInterval { lower: Some(0.5), upper: None, quadratic: true };
        let both = one.joined(other);
        assert_eq!(both, ProfileInterval { lower: Some(0.5), upper: None, quadratic: false });
    }
}
