//! Tests of the residuals: whether they are noise, and of which kind; and the quantiles of the distributions against which
//! they are tested: the normal one, that of chi-squared, and Student's.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use super::{Unknowns, UnknownsMatrix, mean_square};
use crate::numerics::{bisect, cos, integrate, ln, pow, powi, real, sin, truncated};

/// Correlation of the residuals.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Whiteness {
    /// Correlation of neighbouring residuals.
    pub correlation: f64,
    /// Autocorrelation of the noise model at lags 1, 2, ..; empty if the residuals are white.
    #[serde(skip)]
    pub autocorrelation: Vec<f64>,
    /// Whether they cannot be distinguished from independent noise.
    pub white: bool,
    /// Whether they oscillate with the motion, which means that the model leaves something out.
    pub systematic: bool,
}

/// Deviation that a normal variable exceeds by chance once in a thousand times.
const RARE: f64 = 3.09;

/// Highest order of the autoregressive noise model.
const ORDERS: usize = 10;

/// The longest correlation time of filtered noise, in periods of the motion.
const LONG: f64 = 0.25;

/// Tests residuals that are in the order of time.
pub fn whiteness(residuals: &[f64], samples_per_period: f64) -> Whiteness {
    /// Fewest residuals that can be tested.
    const FEWEST: usize = 24;
    let n = residuals.len();
    if n < FEWEST {
        let correlation = if n > 2 {
            autocorrelations(residuals, &[1])[0]
        } else {
            0.0
        };
        return Whiteness { correlation, white: true, ..Whiteness::default() };
    }
    let rho = autocorrelations(residuals, &short_lags(n));
    let squares: f64 = rho.iter().map(|rho| rho * rho).sum();
    let limit = chi_squared(real(rho.len()), RARE);
    let white = real(n) * squares <= limit && rho[0].abs() * real(n).sqrt() <= RARE + 0.3;
    let white = white && !is_patchy(residuals, samples_per_period);
    let autocorrelation = if white { Vec::new() } else { autoregressive(&rho, n) };
    let found = Whiteness { correlation: rho[0], white, ..Whiteness::default() };
    found.with_memory(autocorrelation, residuals, samples_per_period)
}

impl Whiteness {
    /// Sets the noise model, and tests whether it leaves systematic residuals.
    fn with_memory(self, noise: Vec<f64>, residuals: &[f64], samples_per_period: f64) -> Self {
        // Correlation over a good fraction of a period does not come from a filter, but from a drift or from
        // something that the model leaves out.
        let memory: f64 = noise.iter().sum();
        let systematic =
            memory > LONG * samples_per_period || swings(residuals, &noise, samples_per_period);
        Whiteness { autocorrelation: noise, systematic, ..self }
    }

    /// The same for the noise before the fit absorbed a part of it. This is the noise whose residuals after a
    /// fit, with the rows of its `directions`, have the observed autocorrelations.
    pub fn restored(
        self,
        residuals: &[f64],
        samples_per_period: f64,
        directions: &[Unknowns],
    ) -> Self {
        /// Each round leaves only a part of the error of the preceding round.
        const ROUNDS: usize = 6;
        if self.autocorrelation.is_empty() {
            return self;
        }
        let seen = autocorrelations(residuals, &short_lags(residuals.len()));
        let mut noise = self.autocorrelation.clone();
        for _ in 0..ROUNDS {
            let expected = left_over(directions, &noise, seen.len());
            let at = |lag: usize| noise.get(lag).copied().unwrap_or(0.0);
            let rho = seen.iter().zip(expected).enumerate();
            let rho: Vec<f64> = rho
                .map(|(lag, (seen, expected))| (seen + at(lag) - expected).clamp(-0.999, 0.999))
                .collect();
            noise = autoregressive(&rho, residuals.len());
        }
        self.with_memory(noise, residuals, samples_per_period)
    }
}

/// The lags at which autocorrelations of this many residuals are examined.
fn short_lags(n: usize) -> Vec<usize> {
    (1..=ORDERS.min(n / 5)).collect()
}

/// Whether some half swing is fitted worse than chance allows. A wrong last half swing would not show in an
/// average.
fn is_patchy(residuals: &[f64], samples_per_period: f64) -> bool {
    /// Number of standard deviations that chance does not reach in thousands of half swings.
    const FAR: f64 = 5.0;
    let width = truncated((0.5 * samples_per_period).min(real(residuals.len()))).max(8);
    let variance = mean_square(residuals);
    residuals.chunks_exact(width).any(|part| {
        let mean = part.iter().sum::<f64>() / (real(width) * variance).sqrt();
        let power = part.iter().map(|e| e * e).sum::<f64>() / variance - real(width);
        mean.abs() > FAR || power > FAR * (2.0 * real(width)).sqrt()
    })
}

/// The autocorrelations of residuals at these lags; 0 if all residuals are 0.
pub fn autocorrelations(residuals: &[f64], lags: &[usize]) -> Vec<f64> {
    let power: f64 = residuals.iter().map(|e| e * e).sum();
    let at = |lag: usize| -> f64 {
        let shifted = residuals.iter().skip(lag);
        residuals.iter().zip(shifted).map(|(one, other)| one * other).sum::<f64>()
    };
    lags.iter().map(|&lag| if power > 0.0 { at(lag) / power } else { 0.0 }).collect()
}

/// The autocorrelation of the autoregressive noise that fits best, by the Levinson-Durbin recursion with the order
/// chosen by the Bayesian information criterion. Direct estimates at long lags would be mostly noise; those of the
/// model decay.
fn autoregressive(rho: &[f64], n: usize) -> Vec<f64> {
    /// Correlations below this count as zero.
    const NOTHING: f64 = 0.01;
    let mut best = (f64::INFINITY, Vec::new());
    let (mut coefficients, mut power): (Vec<f64>, f64) = (Vec::new(), 1.0);
    for order in 1..=rho.len() {
        let told: f64 = coefficients.iter().enumerate().map(|(i, a)| a * rho[order - 2 - i]).sum();
        let reflection = ((rho[order - 1] - told) / power).clamp(-0.999, 0.999);
        let mut next = coefficients.clone();
        for (i, a) in next.iter_mut().enumerate() {
            *a -= reflection * coefficients[order - 2 - i];
        }
        next.push(reflection);
        coefficients = next;
        power *= 1.0 - reflection * reflection;
        let criterion = real(n) * ln(power) + real(order) * ln(real(n));
        if criterion < best.0 {
            best = (criterion, coefficients.clone());
        }
    }
    let coefficients = best.1;
    let mut all = rho[..coefficients.len()].to_vec();
    while all.len() < n / 4
        && all.iter().rev().take(coefficients.len()).any(|rho| rho.abs() > NOTHING)
    {
        let recent = all.iter().rev().zip(&coefficients);
        all.push(recent.map(|(rho, a)| rho * a).sum());
    }
    all
}

/// Whether there is correlation at lags from a sixth of a period to two periods, where that of filtered noise has
/// decayed.
fn swings(residuals: &[f64], short: &[f64], samples_per_period: f64) -> bool {
    /// Maximum number of lags examined, spread over the range.
    const LAGS: usize = 150;
    /// Number of standard deviations beyond chance.
    const FAR: f64 = 5.0;
    let lag =
        |periods: f64| truncated((periods * samples_per_period).min(real(residuals.len()))).max(1);
    let (from, to) = (lag(1.0 / 6.0).max(ORDERS), lag(2.0).min(residuals.len() / 3));
    if to <= from + 4 {
        return false;
    }
    let step = (to - from).div_ceil(LAGS);
    let lags: Vec<usize> = (from..to).step_by(step).collect();
    let rho = autocorrelations(residuals, &lags);
    // Bartlett: beyond the range of the correlation, the variance of its estimates is larger by this factor.
    let spread = 1.0 + 2.0 * short.iter().map(|rho| rho * rho).sum::<f64>();
    let sum: f64 = rho.iter().map(|rho| real(residuals.len()) * rho * rho).sum();
    let independent = (real(lags.len()) * real(step) / spread).clamp(1.0, real(lags.len()));
    (sum / (spread * real(lags.len())) - 1.0) * (independent / 2.0).sqrt() > FAR
}

/// The sum of the outer products of all pairs of rows, weighted by their correlation.
pub fn correlated(rows: &[Unknowns], autocorrelation: &[f64]) -> UnknownsMatrix {
    let pairs = rows.iter().zip(blurred(rows, autocorrelation));
    let meat: UnknownsMatrix = pairs.map(|(row, ahead)| row * ahead.transpose()).sum();
    meat + meat.transpose()
}

/// For each row, half of it plus all later rows, weighted by their correlation with it.
fn blurred(
    rows: &[Unknowns],
    autocorrelation: &[f64],
) -> impl DoubleEndedIterator<Item = Unknowns> {
    (0..rows.len()).map(|index| {
        let mut ahead = 0.5 * rows[index];
        for (rho, later) in autocorrelation.iter().zip(&rows[index + 1..]) {
            ahead.axpy(*rho, later, 1.0);
        }
        ahead
    })
}

/// The mean autocorrelations at lags 1, 2, .. of the residuals of a fit to noise with these autocorrelations.
/// The unknowns absorb the projection `H = Q Q'` of the noise, so the residuals have the covariance
/// `(1 - H) S (1 - H)`.
fn left_over(q: &[Unknowns], noise: &[f64], lags: usize) -> Vec<f64> {
    let reversed: Vec<Unknowns> = q.iter().rev().copied().collect();
    // S Q and Q' S Q.
    let both = blurred(q, noise).zip(blurred(&reversed, noise).rev());
    let sq: Vec<Unknowns> = both.map(|(ahead, behind)| ahead + behind).collect();
    let qsq: UnknownsMatrix = q.iter().zip(&sq).map(|(one, other)| one * other.transpose()).sum();
    let twice: Vec<Unknowns> = q.iter().map(|row| qsq.tr_mul(row)).collect();
    let at = |lag: usize| -> f64 {
        let rho = if lag == 0 {
            1.0
        } else {
            noise.get(lag - 1).copied().unwrap_or(0.0)
        };
        let mut sum = rho * real(q.len() - lag);
        for (t, later) in q.iter().skip(lag).enumerate() {
            sum += twice[t].dot(later) - sq[t].dot(later) - q[t].dot(&sq[t + lag]);
        }
        sum
    };
    let power = at(0);
    (1..=lags).map(|lag| at(lag) / power).collect()
}

/// The value that a chi-squared variable exceeds with the same probability as a normal one exceeds `z` (Wilson and
/// Hilferty).
pub fn chi_squared(freedom: f64, z: f64) -> f64 {
    let part = 2.0 / (9.0 * freedom);
    freedom * powi(1.0 - part + z * part.sqrt(), 3)
}

/// The deviation within which a variable with Student's distribution lies with a probability of 95 %: for few degrees
/// of freedom `n` by the integral of `cos^(n-1)` over the angle whose tangent is the deviation over `sqrt(n)`, else by
/// the expansion about the normal distribution in `1/n` (error below 1e-5).
pub fn deviation_of_95_percent(freedom: f64) -> f64 {
    const FEW: f64 = 12.0;
    let n = freedom.max(1.0);
    if n < FEW {
        let density = |angle: f64| pow(cos(angle), n - 1.0);
        let within = |angle: f64| integrate(&density, (0.0, angle), 1e-9).value;
        let wanted = 0.95 * within(FRAC_PI_2);
        let (_, angle) = bisect(0.0, FRAC_PI_2, 40, |angle| within(angle) >= wanted);
        return n.sqrt() * sin(angle) / cos(angle);
    }
    let z: f64 = 1.959_963_984_540_054;
    let [z3, z5, z7, z9] = [3, 5, 7, 9].map(|power| powi(z, power));
    z + (z3 + z) / (4.0 * n)
        + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n)
        + (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * powi(n, 3))
        + (79.0 * z9 + 776.0 * z7 + 1482.0 * z5 - 1920.0 * z3 - 945.0 * z) / (92_160.0 * powi(n, 4))
}

/// The quantile of the standard normal distribution, to 4.5e-4 (Abramowitz and Stegun, 26.2.23).
pub fn normal_at(probability: f64) -> f64 {
    let tail = probability.min(1.0 - probability).max(f64::MIN_POSITIVE);
    let t = (-2.0 * ln(tail)).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let value = t - above / below;
    if probability < 0.5 { -value } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::Random;

    fn noise(n: usize, rho: f64) -> Vec<f64> {
        let mut chance = Random::new(7);
        let mut last = 0.0;
        let next = |_| {
            last = rho * last + (1.0 - rho * rho).sqrt() * chance.normal();
            last
        };
        (0..n).map(next).collect()
    }

    #[test]
    fn independent_noise_is_white_and_filtered_noise_is_known_by_its_memory() {
        let found = whiteness(&noise(4000, 0.0), 80.0);
        assert!(found.white && !found.systematic, "{found:?}");
        let found = whiteness(&noise(4000, 0.9), 80.0);
        assert!(!found.white && !found.systematic, "{found:?}");
        for (lag, rho) in [(1, 0.9_f64), (2, 0.81), (10, 0.349)] {
            assert!((found.autocorrelation[lag - 1] - rho).abs() < 0.05, "{found:?}");
        }
    }

    #[test]
    fn a_swing_that_is_left_over_is_found_below_the_noise() {
        let mut residuals = noise(4000, 0.0);
        for (index, e) in residuals.iter_mut().enumerate() {
            *e += 0.5 * sin(real(index) * std::f64::consts::TAU / 80.0);
        }
        let found = whiteness(&residuals, 80.0);
        assert!(!found.white && found.systematic, "{found:?}");
    }

    #[test]
    fn students_quantiles_are_those_of_tables() {
        for (freedom, value) in [
            (1.0, 12.706_204_7),
            (2.0, 4.302_652_7),
            (3.0, 3.182_446_3),
            (5.0, 2.570_581_8),
            (10.0, 2.228_138_9),
            (11.0, 2.200_985_2),
            (12.0, 2.178_812_8),
            (30.0, 2.042_272_5),
            (1e9, 1.959_964_0),
        ] {
            let found = deviation_of_95_percent(freedom);
            assert!((found / value - 1.0).abs() < 1e-5, "{freedom}: {found}");
        }
    }
}
