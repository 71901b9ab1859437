//! Properties of a record's noise that need no model: scatter, steps of the converter, impossible jumps, and samples
//! flattened at full scale.

use std::f64::consts::PI;

use nalgebra::{SMatrix, SVector};

pub(crate) use crate::numerics::range;
use crate::numerics::{exp, powi, real};

/// Number of standard deviations beyond which a residual does not belong to the motion. Chance exceeds it 7 times
/// in a million.
pub const IMPOSSIBLE: f64 = 4.5;

/// The median; 0 for an empty list.
pub fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Average number of samples in a unit of time.
pub fn rate(t: &[f64]) -> f64 {
    real(t.len()) / (t[t.len() - 1] - t[0])
}

/// The coefficients of a linear combination of functions, of which each row has the values, that comes closest to the
/// values measured.
pub fn least_squares<const N: usize>(
    rows: impl Iterator<Item = ([f64; N], f64)>,
) -> Option<[f64; N]> {
    let mut normal = SMatrix::<f64, N, N>::zeros();
    let mut right = SVector::<f64, N>::zeros();
    for (row, value) in rows {
        let row = SVector::from(row);
        normal += row * row.transpose();
        right += row * value;
    }
    Some(normal.cholesky()?.solve(&right).into())
}

/// A robust standard deviation: the median magnitude over 0.6745, which is that of a standard normal variable.
pub fn robust_deviation(values: impl Iterator<Item = f64>) -> f64 {
    median(values.map(f64::abs).collect()) / 0.6745
}

/// The mean of the squares of values.
pub fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|it| it * it).sum::<f64>() / real(values.len())
}

/// Noise of a record, from its second differences or, with few samples per period, from the errors of the best
/// linear prediction of each sample by the two before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Standard deviation, for thresholds only: that of filtered noise comes out up to three times too small.
    pub deviation: f64,
    /// Whether some samples make impossible jumps.
    pub has_outliers: bool,
    /// The smallest nonzero step from one sample to the next, that of the converter or of the last digit
    /// written; 0 if there is none.
    pub step: f64,
    /// Whether neighbouring samples differ not only by the motion but by noise larger than a step.
    pub is_audible: bool,
}

impl Noise {
    /// The noise of successive samples, with `samples_per_period` of them in each period.
    pub fn of(x: &[f64], samples_per_period: f64) -> Self {
        /// With fewer samples per period the motion itself has large second differences.
        const FEW: f64 = 12.0;
        /// Fraction of impossible second differences above which a record has outliers.
        const SHARE: f64 = 0.003;
        // The constant and the weights of the two preceding samples in the best prediction of a sample.
        let told = || least_squares(x.windows(3).map(|it| ([1.0, it[1], it[0]], it[2])));
        let few = samples_per_period < FEW;
        let [level, one, two] = few.then(told).flatten().unwrap_or([0.0, 2.0, -1.0]);
        let off = |it: &[f64]| (it[2] - one * it[1] - two * it[0] - level).abs();
        let mut second: Vec<f64> = x.windows(3).map(off).collect();
        let steps = x.windows(2).map(|two| (two[1] - two[0]).abs()).filter(|step| *step > 0.0);
        let step = steps.min_by(f64::total_cmp).unwrap_or(0.0);
        let quantised = step / 12.0_f64.sqrt();
        second.sort_by(f64::total_cmp);
        let at = |tenths: usize| second.get(second.len() * tenths / 10).copied().unwrap_or(0.0);
        let deviation = at(5) / 0.6745 / (1.0 + one * one + two * two).sqrt();
        // If one sample in twelve is spoiled, a quarter of the second differences are.
        let impossible = (8.0 * at(5)).max(4.0 * at(7));
        let jumps = second.iter().filter(|value| **value > impossible).count();
        let has_outliers = impossible > 0.0 && real(jumps) > SHARE * real(second.len());
        // If most differences vanish, the rounding error of the converter or of the decimals remains.
        let deviation = deviation.max(quantised);
        let is_audible = deviation > step && alternates(x);
        Noise { deviation, has_outliers, step, is_audible }
    }

    /// The number of readings of a mass at rest that carry as much information as all of them, if residuals
    /// have this variance. The converter rounds all of them to the same step; this error averages out only if
    /// the noise is a good fraction of a step.
    ///
    /// With normal noise of `s` steps the mean reading is off by `sum_k (-1)^k sin(2 pi k x)/(pi k)
    /// exp(-2 pi^2 k^2 s^2)` steps, the Fourier series of the rounding error. Its mean square over all places x is
    /// computed here.
    pub fn readings_at_rest(&self, variance: f64) -> f64 {
        const TERMS: u32 = 12;
        let square = powi(self.step, 2);
        let dither = (variance / square - 1.0 / 12.0).max(0.0);
        let term = |k: u32| {
            let k = f64::from(k);
            exp(-4.0 * powi(PI * k, 2) * dither) / (2.0 * powi(PI * k, 2))
        };
        let bias = square * (1..=TERMS).map(term).sum::<f64>();
        if bias > 0.0 { variance / bias } else { f64::INFINITY }
    }
}

/// Whether fourth differences change sign from sample to sample more often than not. Those of a smooth motion
/// hardly ever do; those of white noise do in four cases of five.
fn alternates(x: &[f64]) -> bool {
    let fourth =
        x.windows(5).map(|five| five[0] + five[4] - 4.0 * (five[1] + five[3]) + 6.0 * five[2]);
    let fourth: Vec<f64> = fourth.filter(|value| *value != 0.0).collect();
    let changes = fourth.windows(2).filter(|two| two[0] * two[1] < 0.0).count();
    2 * changes > fourth.len()
}

/// Which samples lie within full scale. A converter that saturates repeats its largest or smallest value far more
/// often than the values next to it.
///
/// If the noise is smaller than a step of the converter, repetitions at the beginning and the end of the record do
/// not count, since a mass may be held, or rest, at its extreme; larger noise would show there. Next to flattened
/// samples the noise decides which samples remain, so these are also left out until the motion is clear of the
/// limit.
pub fn within_scale(x: &[f64], noise: &Noise) -> Vec<bool> {
    /// Distance that is clear of the limit, in standard deviations of the noise.
    const CLEAR: f64 = 6.0;
    /// Distance of the mean of so many samples on each side within which chance may reach the limit.
    const CLOSE: f64 = 3.0;
    const AROUND: usize = 2;
    let (low, high) = range(x);
    let mut within = vec![true; x.len()];
    for limit in [low, high] {
        if is_saturated(x, limit, noise) {
            // Where the motion turns just before the limit, chance decides whether a sample reaches it.
            for (within, around) in within[AROUND..].iter_mut().zip(x.windows(2 * AROUND + 1)) {
                let mean = around.iter().sum::<f64>() / real(around.len());
                *within &= (mean - limit).abs() > CLOSE * noise.deviation;
            }
            let near = |x: &f64| (x - limit).abs() <= CLEAR * noise.deviation;
            let mut from = 0;
            for stretch in x.chunk_by(|one, next| near(one) && near(next)) {
                let to = from + stretch.len();
                if stretch.contains(&limit) {
                    within[from..to].fill(false);
                }
                from = to;
            }
        }
    }
    within
}

fn is_saturated(x: &[f64], limit: f64, noise: &Noise) -> bool {
    /// Width of the band of neighbouring values counted for comparison, as a fraction of the range.
    const BAND: f64 = 0.01;
    /// Fewest repetitions, and how much more frequent they must be.
    const FEWEST: usize = 8;
    const TIMES: usize = 4;
    let from = x.iter().position(|x| *x != limit).unwrap_or(0);
    let to = x.iter().rposition(|x| *x != limit).map_or(0, |last| last + 1);
    let inner = if noise.is_audible { x } else { &x[from..to] };
    // A converter much finer than the noise hardly ever reads the same twice in a row, except at full scale.
    let is_flat = inner.windows(2).any(|two| two[0] == two[1] && two[0] == limit);
    let (lowest, highest) = range(inner);
    let (low, high) = (lowest.min(limit), highest.max(limit));
    let is_inner = |x: f64| x != low && x != high;
    let is_fine = !inner.windows(2).any(|two| two[0] == two[1] && is_inner(two[0]));
    if is_fine && is_flat {
        return true;
    }
    let at = inner.iter().filter(|x| **x == limit).count();
    let steps = inner.iter().map(|x| (x - limit).abs()).filter(|step| *step > 0.0);
    let step = steps.fold(f64::INFINITY, f64::min);
    let (lowest, highest) = range(x);
    let band = (BAND * (highest - lowest)).max(1.5 * step);
    let near = inner.iter().filter(|x| **x != limit && (*x - limit).abs() <= band).count();
    at >= FEWEST && at > TIMES * near
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::{cos, exp};
    use crate::numerics::random::Random;

    fn swing(count: u32) -> Vec<f64> {
        (0..count)
            .map(|index| 5.0 * exp(-0.002 * f64::from(index)) * cos(0.1 * f64::from(index)))
            .collect()
    }

    #[test]
    fn noise_is_told_from_the_motion_and_outliers_from_noise() {
        let mut chance = Random::new(3);
        let mut x: Vec<f64> = swing(2000).iter().map(|x| x + 0.02 * chance.normal()).collect();
        let clean = Noise::of(&x, 63.0);
        assert!((clean.deviation / 0.02 - 1.0).abs() < 0.1 && !clean.has_outliers, "{clean:?}");
        x.iter_mut().step_by(97).for_each(|x| *x += 1.0);
        let spoiled = Noise::of(&x, 63.0);
        assert!(
            (spoiled.deviation / 0.02 - 1.0).abs() < 0.2 && spoiled.has_outliers,
            "{spoiled:?}"
        );
    }

    #[test]
    fn a_few_samples_a_period_do_not_make_the_motion_look_like_noise() {
        let mut chance = Random::new(4);
        let few: Vec<f64> =
            swing(4000).iter().step_by(16).map(|x| x + 0.02 * chance.normal()).collect();
        let found = Noise::of(&few, 3.9);
        assert!((found.deviation / 0.02 - 1.0).abs() < 0.2 && !found.has_outliers, "{found:?}");
    }

    #[test]
    fn steps_wider_than_the_noise_are_noise_of_their_own() {
        let coarse: Vec<f64> = swing(3000).iter().map(|x| (x / 0.1).round() * 0.1).collect();
        let found = Noise::of(&coarse, 63.0);
        assert!((found.deviation / (0.1 / 12.0_f64.sqrt()) - 1.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn readings_at_rest_share_the_error_of_their_step_unless_noise_averages_it_out() {
        let noise = Noise { step: 0.5, ..Noise::default() };
        let alike = |dither: f64| noise.readings_at_rest(0.25 * (1.0 / 12.0 + dither * dither));
        // Without noise one reading carries all information, up to the truncated terms; with half a step of
        // noise each reading adds some.
        assert!((alike(0.0) - 1.0).abs() < 0.06, "{}", alike(0.0));
        assert!((8.0..16.0).contains(&alike(0.2)), "{}", alike(0.2));
        assert!(alike(0.5) > 1e4);
        assert_eq!(Noise::default().readings_at_rest(1.0), f64::INFINITY);
    }

    #[test]
    fn full_scale_is_seen_and_a_hold_or_a_coarse_converter_is_not_taken_for_it() {
        let left_out = |x: &[f64]| {
            let noise = Noise { deviation: 0.01, ..Noise::of(x, 63.0) };
            within_scale(x, &noise).iter().filter(|within| !**within).count()
        };
        let clipped: Vec<f64> = swing(600).iter().map(|x| x.min(3.0)).collect();
        let flat = clipped.iter().filter(|x| **x == 3.0).count();
        assert!(
            flat > 20 && (flat..flat + 12).contains(&left_out(&clipped)),
            "{}",
            left_out(&clipped)
        );
        let coarse: Vec<f64> = swing(600).iter().map(|x| (x / 0.25).round() * 0.25).collect();
        let held: Vec<f64> = vec![5.0; 200].into_iter().chain(swing(400)).collect();
        let rests: Vec<f64> = swing(400).into_iter().chain(vec![-5.0; 200]).collect();
        assert_eq!([coarse, held.clone(), rests].map(|x| left_out(&x)), [0; 3]);
        // A hold beyond full scale is silent, although there is noise.
        let mut chance = Random::new(5);
        let noisy: Vec<f64> = held.iter().map(|x| x + 0.01 * chance.normal()).collect();
        let beyond: Vec<f64> = noisy.iter().map(|x| x.min(3.0)).collect();
        assert_eq!(left_out(&noisy), 0);
        // Two flat samples are enough where noise never reads the same twice.
        let mut free: Vec<f64> = swing(60).iter().map(|x| x + 0.01 * chance.normal()).collect();
        assert_eq!(left_out(&free), 0);
        let limit = free.iter().copied().fold(f64::NEG_INFINITY, f64::max) - 0.1;
        for x in &mut free {
            *x = x.min(limit);
        }
        assert!(free.iter().filter(|x| **x == limit).count() < 8);
        assert!(left_out(&free) >= 2, "{}", left_out(&free));
        assert!(left_out(&beyond) >= 200, "{}", left_out(&beyond));
    }
}
