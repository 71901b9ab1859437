//! Intervals by the profile of the loss, where it is not quadratic.
//!
//! The 95 % interval ends where the loss, minimized over all other unknowns, has risen by as much as noise alone
//! explains. If the loss is quadratic, the ends lie at a multiple of the standard error from the minimum, which is
//! checked by one motion on each side. Otherwise the ends are found by refitting all other unknowns.

use super::{Covariance, Optimum, R, Task, deviation_of_95_percent};

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
const REFITS: usize = 16;

/// Distance beyond which no bound is sought, in half widths of the interval by the standard error.
const FARTHEST: f64 = 60.0;

/// The profile of one unknown in the region of a minimum.
pub struct Profile<'a> {
    /// The fit, confined to the region.
    pub task: &'a Task<'a>,
    /// The minimum.
    pub optimum: &'a Optimum,
    /// Its covariance.
    pub covariance: &'a Covariance,
    /// The loss of the lowest minimum of all regions.
    pub least: f64,
    /// A unit of chi-squared there.
    pub variance: f64,
    /// A refit that came to a lower loss than the minimum, which was none.
    pub lower: Option<Optimum>,
}

/// The best point for a value of the unknown.
struct ProfilePoint {
    /// Distance from the minimum.
    step: f64,
    /// Rise of the loss above the least, as a fraction of that at the end of the interval.
    risen: f64,
    optimum: Optimum,
}

impl Profile<'_> {
    /// The interval of an unknown, open where a lower minimum was found; `None` if the loss is too high everywhere in this
    /// region.
    pub fn interval(&mut self, unknown: usize) -> Option<ProfileInterval> {
        let z = self.deviations(unknown);
        let white = self.covariance.inflation(unknown);
        let rise = z * z * white * self.variance;
        let left = 1.0 - (self.optimum.cost - self.least) / rise;
        if left <= 0.0 || self.task.runs.has_ended() {
            return None;
        }
        // The error in this region if the noise is that of the lowest minimum.
        let part = (self.variance / self.covariance.variance).sqrt();
        let error = part * self.covariance.error(unknown);
        let reach = left.sqrt() * z * error;
        let mut ends = [None; 2];
        let mut quadratic = true;
        for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
            if self.rises_by(unknown, sign * reach, left * rise) {
                *end = Some(self.optimum.p[unknown] + sign * reach);
                continue;
            }
            quadratic = false;
            *end = self.sought(unknown, sign, reach, rise);
            if self.lower.is_some() {
                return Some(ProfileInterval::default());
            }
        }
        Some(ProfileInterval { lower: ends[0], upper: ends[1], quadratic })
    }

    /// Half the width of a 95 % interval in standard errors.
    fn deviations(&self, unknown: usize) -> f64 {
        deviation_of_95_percent(self.covariance.independent(unknown))
    }

    /// The interval by the standard error alone, without a profile.
    pub fn straight(&self, unknown: usize) -> ProfileInterval {
        let center = self.optimum.p[unknown];
        let reach = self.deviations(unknown) * self.covariance.error(unknown);
        let least = if unknown == R { 0.0 } else { f64::NEG_INFINITY };
        let lower = Some((center - reach).max(least));
        ProfileInterval { lower, upper: Some(center + reach), quadratic: true }
    }

    /// Whether the loss rises as a quadratic one would, if the unknown is moved and all others follow freely.
    fn rises_by(&self, unknown: usize, by: f64, rise: f64) -> bool {
        let along = self.covariance.following(&[(unknown, 1.0)]);
        let p = self.optimum.p + by * along;
        // Friction cannot be negative: r ends at 0, and unknowns that depend on r have a kink there.
        if p[R] < 0.0 && self.task.free[R] {
            return false;
        }
        let seen = self.task.evaluated(&p, false);
        seen.is_some_and(|seen| {
            let risen = self.task.cost(&seen) - self.optimum.cost;
            let same = seen.region == self.optimum.seen.region;
            same && (risen / rise - 1.0).abs() <= QUADRATIC
        })
    }

    /// The end on one side, by refits that start from each other: further out until the loss has risen enough,
    /// then between the two closest points. `None` if the end is not found.
    fn sought(&mut self, unknown: usize, sign: f64, reach: f64, rise: f64) -> Option<f64> {
        /// Accuracy of the rise at an end, and the smallest at which an end may be taken.
        const EXACT: f64 = 0.03;
        const NEARLY: f64 = 0.8;
        let center = self.optimum.p[unknown];
        let is_least = unknown == R && sign < 0.0;
        let farthest = if is_least { center } else { FARTHEST * reach };
        if farthest <= 0.0 {
            return Some(center);
        }
        let risen = (self.optimum.cost - self.least) / rise;
        let mut inside = ProfilePoint { step: 0.0, risen, optimum: self.optimum.clone() };
        let mut outside: Option<(f64, f64)> = None;
        let mut step = reach.min(farthest);
        for _ in 0..REFITS {
            let found = self.refitted(unknown, center + sign * step, &inside, rise);
            if self.lower.is_some() || self.task.runs.has_ended() {
                return None;
            }
            let risen = found.as_ref().map_or(f64::INFINITY, |found| found.risen);
            if (risen - 1.0).abs() <= EXACT {
                return Some(center + sign * step);
            }
            match found.filter(|found| found.risen < 1.0) {
                Some(_) if step >= farthest => return is_least.then_some(0.0),
                Some(found) => inside = ProfilePoint { step, ..found },
                None => outside = Some((step, risen)),
            }
            let root = |risen: f64| risen.sqrt();
            step = match outside {
                None => (step * (1.1 / root(inside.risen).max(0.2))).max(1.2 * step).min(farthest),
                Some((far, high)) if high.is_finite() => {
                    let part = (1.0 - root(inside.risen)) / (root(high) - root(inside.risen));
                    inside.step + part.clamp(0.1, 0.9) * (far - inside.step)
                }
                Some((far, _)) => 0.5 * (inside.step + far),
            };
        }
        // Friction is at least zero in any case.
        let open = is_least.then_some(0.0);
        let near = outside.filter(|(_, high)| high.is_finite() && inside.risen > NEARLY);
        near.map_or(open, |(far, _)| Some(center + sign * far))
    }

    /// The best point with the unknown at a value; `None` if no descent from a known point leads there.
    fn refitted(
        &mut self,
        unknown: usize,
        value: f64,
        from: &ProfilePoint,
        rise: f64,
    ) -> Option<ProfilePoint> {
        /// Fall of the loss, as a fraction of the rise at the end, that shows that the minimum was none.
        const LOWER: f64 = 0.02;
        let by = value - from.optimum.p[unknown];
        let guess = self.task.followed(&from.optimum, unknown, by)?;
        let optimum = self.task.holding(unknown).solve_roughly(guess)?;
        if optimum.cost < self.optimum.cost - LOWER * rise {
            self.lower = Some(optimum);
            return None;
        }
        let risen = (optimum.cost - self.least).max(0.0) / rise;
        Some(ProfilePoint { step: 0.0, risen, optimum })
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
