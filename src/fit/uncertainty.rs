//! The covariance of the unknowns, also for correlated noise, and intervals by the profile of the loss, where that is not
//! quadratic.
//!
//! The 95 % interval ends where the loss, minimized over all other unknowns, has risen by as much as noise alone
//! explains. If the loss is quadratic, the ends lie at a multiple of the standard error from the minimum, which is
//! checked by one motion on each side. Otherwise the ends are found by refitting all other unknowns.

use nalgebra::DVector;

use super::{
    IMPOSSIBLE, Optimum, R, Task, UNKNOWNS, Unknowns, UnknownsMatrix, correlated,
    deviation_of_95_percent, mean_square,
};
use crate::numerics::{powi, real};

/// The covariance of the free unknowns about a minimum.
#[derive(Clone, Debug)]
pub struct Covariance {
    /// Which unknowns are free.
    free: [bool; UNKNOWNS],
    /// Their covariance for the noise of the record.
    pub matrix: UnknownsMatrix,
    /// Their covariance for white noise of the same size: the inverse curvature of the loss.
    pub white: UnknownsMatrix,
    /// Standard deviation of the noise.
    pub deviation: f64,
    /// Its variance as it acts on the unknowns: a unit of chi-squared.
    pub variance: f64,
    /// Degrees of freedom: the number of residuals minus the noise absorbed by the unknowns.
    pub freedom: f64,
    /// The noise absorbed by the unknowns, in residuals.
    absorbed: f64,
    /// For each unknown, the degrees of freedom of its variance if all residuals are independent.
    freedoms: Unknowns,
}

impl Covariance {
    /// The covariance at a minimum, for noise with these autocorrelations (none: white).
    ///
    /// With correlated noise `cov(J'e) = s^2 sum_l rho_l J_t' J_(t+l)`, which is multiplied by the inverse of
    /// `J'J` from both sides. `None` if an unknown has no influence at all.
    pub fn at(task: &Task, optimum: &Optimum, autocorrelation: &[f64]) -> Option<Self> {
        let upper = task.factor(&optimum.seen).upper;
        let free = UnknownsMatrix::identity() - task.held();
        let inverse = upper.solve_upper_triangular(&free)?;
        let bread = inverse * inverse.transpose();
        let directions = || task.directions(&optimum.seen);
        // Each unknown absorbs the noise along its gradient, which for white noise is that of one residual.
        let (spread, absorbed) = if autocorrelation.is_empty() {
            (bread, free.trace())
        } else {
            let along = correlated(&directions(), autocorrelation);
            (inverse * along * inverse.transpose(), along.trace())
        };
        let values = task.values(&optimum.seen);
        let freedom = real(values.len()) - absorbed;
        if freedom < 1.0 || !spread.iter().all(|value| value.is_finite()) {
            return None;
        }
        // For a robust loss the influence of a residual is its weight times its value.
        let weighted = values.iter().map(|&value| (task.loss.weight(value), value));
        let (sum, influence) = weighted.fold((0.0, 0.0), |(sum, influence), (weight, value)| {
            (sum + weight * value * value, influence + powi(weight * value, 2))
        });
        let variance = influence / freedom * powi(widening(task, optimum, influence / freedom), 2);
        let data = task.data;
        let freedoms = if data.residuals() > data.x.len() {
            of_two_kinds(&directions(), data.x.len(), &inverse)
        } else {
            Unknowns::repeat(freedom)
        };
        Some(Covariance {
            free: task.free,
            matrix: spread * variance,
            white: bread * variance,
            deviation: (sum / freedom).sqrt(),
            variance,
            freedom,
            absorbed,
            freedoms,
        })
    }

    /// Whether noise can have the autocorrelations: then all variances are positive, and the unknowns absorb
    /// some of the noise.
    pub fn is_possible(&self) -> bool {
        let is_known = |(free, variance): (&bool, &f64)| !free || *variance > 0.0;
        self.absorbed > 0.0 && self.free.iter().zip(&self.matrix.diagonal()).all(is_known)
    }

    /// Covariance of two unknowns; 0 if one is held.
    pub fn of(&self, one: usize, other: usize) -> f64 {
        self.matrix[(one, other)]
    }

    /// Standard error of an unknown; 0 if it is held.
    pub fn error(&self, unknown: usize) -> f64 {
        self.error_of(&[(unknown, 1.0)])
    }

    /// Standard error of a weighted sum of unknowns.
    pub fn error_of(&self, terms: &[(usize, f64)]) -> f64 {
        let pairs = terms.iter().flat_map(|one| terms.iter().map(move |other| (one, other)));
        let variance: f64 =
            pairs.map(|(one, other)| one.1 * other.1 * self.of(one.0, other.0)).sum();
        variance.max(0.0).sqrt()
    }

    /// Correlation of two free unknowns.
    pub fn correlation(&self, one: usize, other: usize) -> f64 {
        self.of(one, other) / (self.error(one) * self.error(other))
    }

    /// The ratio of the variance of an unknown to that with white noise of the same size.
    pub fn inflation(&self, unknown: usize) -> f64 {
        let at = (unknown, unknown);
        if self.free[unknown] {
            self.matrix[at] / self.white[at]
        } else {
            1.0
        }
    }

    /// The number of independent residuals that would determine the variance of an unknown as well
    /// (Satterthwaite).
    ///
    /// For correlated noise the correlation is estimated, too. A first-order autoregression inflates the
    /// variance of unknowns with slowly varying gradients by `I = (1 + rho)/(1 - rho)`; the relative variance
    /// of this variance is `2 (1 + 2 I)/n`.
    pub fn independent(&self, unknown: usize) -> f64 {
        let inflation = self.inflation(unknown);
        let repeated = if inflation == 1.0 {
            1.0
        } else {
            1.0 + 2.0 * inflation.max(1.0)
        };
        let freedom = if self.free[unknown] {
            self.freedoms[unknown]
        } else {
            self.freedom
        };
        freedom / repeated
    }

    /// The changes of all unknowns after changes of some of them, with the loss kept as small as possible.
    pub fn following(&self, changes: &[(usize, f64)]) -> Unknowns {
        let free = changes.iter().filter(|(place, _)| self.free[*place]).copied();
        let (places, by): (Vec<usize>, Vec<f64>) = free.unzip();
        let mut all = Unknowns::zeros();
        // Held numbers move no others.
        if !places.is_empty() {
            let leading = self.white.select_columns(&places);
            let weights = leading.select_rows(&places).lu().solve(&DVector::from_vec(by));
            all = weights.map_or(all, |weights| leading * weights);
        }
        for (place, by) in changes {
            all[*place] = *by;
        }
        all
    }
}

/// The factor of all errors that is due to samples left out because they do not belong to the motion. If the noise reaches
/// beyond the limit, a small change of the motion puts some samples out and others in, so that those that count see only
/// a part of it. That part follows from the density of residuals at the limit, here from their number up to twice the
/// limit: with Student's distribution of three degrees of freedom it falls with the fourth power.
fn widening(task: &Task, optimum: &Optimum, variance: f64) -> f64 {
    /// The density of magnitudes at the limit times the limit, by their share between the limit and its double.
    const AT_LIMIT: f64 = 3.0 / (1.0 - 0.125);
    /// Largest share of the residuals that may be lost in this way.
    const MOST: f64 = 0.3;
    let limit = IMPOSSIBLE * variance.sqrt();
    let out = optimum.seen.residuals.iter().zip(task.dropped).filter(|(_, why)| why.is_some());
    let near = out.filter(|(it, _)| (limit..2.0 * limit).contains(&it.value.abs())).count();
    let share = real(near) / real(optimum.seen.residuals.len());
    1.0 / (1.0 - (AT_LIMIT * share).min(MOST))
}

/// The degrees of freedom of each unknown's variance if the first `count` residuals and the others are of two kinds,
/// displacements and times of peaks, the errors of which are estimated separately (Welch and Satterthwaite).
fn of_two_kinds(directions: &[Unknowns], count: usize, inverse: &UnknownsMatrix) -> Unknowns {
    // For each kind: its degrees of freedom, and the variance of each unknown that is due to it.
    let kinds = [&directions[..count], &directions[count..]].map(|kind| {
        let freedom = kind.iter().map(|row| 1.0 - row.norm_squared()).sum::<f64>();
        let influences = kind.iter().map(|row| inverse * row);
        let variances: Unknowns = influences.map(|it| it.component_mul(&it)).sum();
        (freedom.max(f64::MIN_POSITIVE), variances)
    });
    Unknowns::from_fn(|unknown, _| {
        let parts = kinds.iter().map(|(freedom, variances)| (freedom, variances[unknown]));
        let (sum, spread) = parts.fold((0.0, 0.0), |(sum, spread), (freedom, variance)| {
            (sum + variance, spread + variance * variance / freedom)
        });
        sum * sum / spread
    })
}

/// The ratio of the errors of the second kind of residuals, those from `count` on, to those of the first kind. Each is
/// estimated from its residuals and their degrees of freedom, with one minus its leverage for each residual.
pub fn ratio_of_kinds(task: &Task, optimum: &Optimum, count: usize) -> f64 {
    let directions = task.directions(&optimum.seen);
    let values = task.values(&optimum.seen);
    let [x, t] = [0..count, count..values.len()].map(|kind| {
        let freedom: f64 =
            directions[kind.clone()].iter().map(|row| 1.0 - row.norm_squared()).sum();
        mean_square(&values[kind.clone()]) * real(kind.len()) / freedom.max(0.5)
    });
    (t / x).sqrt()
}

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
        ProfileInterval {
            lower: self.lower.zip(other.lower).map(|(one, two)| one.min(two)),
            upper: self.upper.zip(other.upper).map(|(one, two)| one.max(two)),
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
    /// The place of the unknown.
    pub unknown: usize,
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
    /// The interval, open where a lower minimum was found; `None` if the loss is too high everywhere in this region.
    pub fn interval(&mut self) -> Option<ProfileInterval> {
        let z = self.deviations();
        let white = self.covariance.inflation(self.unknown);
        let rise = z * z * white * self.variance;
        let left = 1.0 - (self.optimum.cost - self.least) / rise;
        if left <= 0.0 || self.task.runs.has_ended() {
            return None;
        }
        // The error in this region if the noise is that of the lowest minimum.
        let part = (self.variance / self.covariance.variance).sqrt();
        let error = part * self.covariance.error(self.unknown);
        let reach = left.sqrt() * z * error;
        let mut ends = [None; 2];
        let mut quadratic = true;
        for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
            if self.rises_by(sign * reach, left * rise) {
                *end = Some(self.optimum.p[self.unknown] + sign * reach);
                continue;
            }
            quadratic = false;
            *end = self.sought(sign, reach, rise);
            if self.lower.is_some() {
                return Some(ProfileInterval::default());
            }
        }
        Some(ProfileInterval { lower: ends[0], upper: ends[1], quadratic })
    }

    /// Half the width of a 95 % interval in standard errors.
    fn deviations(&self) -> f64 {
        deviation_of_95_percent(self.covariance.independent(self.unknown))
    }

    /// The interval by the standard error alone, without a profile.
    pub fn straight(&self) -> ProfileInterval {
        let center = self.optimum.p[self.unknown];
        let reach = self.deviations() * self.covariance.error(self.unknown);
        let least = if self.unknown == R { 0.0 } else { f64::NEG_INFINITY };
        let lower = Some((center - reach).max(least));
        ProfileInterval { lower, upper: Some(center + reach), quadratic: true }
    }

    /// Whether the loss rises as a quadratic one would, if the unknown is moved and all others follow freely.
    fn rises_by(&self, by: f64, rise: f64) -> bool {
        let along = self.covariance.following(&[(self.unknown, 1.0)]);
        let p = self.optimum.p + by * along;
        // Friction cannot be negative: r ends at 0, and unknowns that depend on r have a kink there.
        if p[R] < 0.0 {
            return false;
        }
        let Some(seen) = self.task.evaluated(&p, false) else { return false };
        let risen = self.task.cost(&seen) - self.optimum.cost;
        let same = seen.region == self.optimum.seen.region;
        same && (risen / rise - 1.0).abs() <= QUADRATIC
    }

    /// The end on one side, by refits that start from each other: further out until the loss has risen enough,
    /// then between the two closest points. `None` if the end is not found.
    fn sought(&mut self, sign: f64, reach: f64, rise: f64) -> Option<f64> {
        /// Accuracy of the rise at an end, and the smallest at which an end may be taken.
        const EXACT: f64 = 0.03;
        const NEARLY: f64 = 0.8;
        let center = self.optimum.p[self.unknown];
        let is_least = self.unknown == R && sign < 0.0;
        let farthest = if is_least { center } else { FARTHEST * reach };
        if farthest <= 0.0 {
            return Some(center);
        }
        let risen = (self.optimum.cost - self.least) / rise;
        let mut inside = ProfilePoint { step: 0.0, risen, optimum: self.optimum.clone() };
        let mut outside: Option<(f64, f64)> = None;
        let mut step = reach.min(farthest);
        for _ in 0..REFITS {
            let found = self.refitted(center + sign * step, &inside, rise);
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
            let root = inside.risen.sqrt();
            step = match outside {
                None => (step * (1.1 / root.max(0.2))).max(1.2 * step).min(farthest),
                Some((far, high)) if high.is_finite() => {
                    let part = (1.0 - root) / (high.sqrt() - root);
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
    fn refitted(&mut self, value: f64, from: &ProfilePoint, rise: f64) -> Option<ProfilePoint> {
        /// Fall of the loss, as a fraction of the rise at the end, that shows that the minimum was none.
        const LOWER: f64 = 0.02;
        let by = value - from.optimum.p[self.unknown];
        let guess = self.task.followed(&from.optimum, self.unknown, by)?;
        let optimum = self.task.holding(self.unknown).solve_roughly(guess)?;
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
