//! What a record shows of its own noise before any model: scatter, steps of the converter, impossible jumps,
//! and samples flattened at full scale.

/// The median; 0 of nothing.
#[must_use]
pub fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    let (_, found, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    *found
}

/// The robust standard deviation: the median magnitude of a normal deviate is 0.6745.
#[must_use]
pub fn robust_deviation(values: impl Iterator<Item = f64>) -> f64 {
    median(values.map(f64::abs).collect()) / 0.6745
}

/// Noise of a record, seen in its second differences.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Standard deviation. Filtered noise looks up to three times smaller here: for thresholds only.
    pub deviation: f64,
    /// Whether some samples jump impossibly.
    pub has_outliers: bool,
}

impl Noise {
    /// The noise of successive samples.
    #[must_use]
    pub fn of(x: &[f64]) -> Self {
        /// This share of impossible second differences makes a record one with outliers.
        const SHARE: f64 = 0.003;
        let second: Vec<f64> =
            x.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]).abs()).collect();
        let steps = x.windows(2).map(|two| (two[1] - two[0]).abs()).filter(|step| *step > 0.0);
        let least = steps.fold(f64::INFINITY, f64::min);
        let quantised = if least.is_finite() { least / 12.0_f64.sqrt() } else { 0.0 };
        let deviation = median(second.clone()) / 0.6745 / 6.0_f64.sqrt();
        let mut sorted = second.clone();
        sorted.sort_by(f64::total_cmp);
        // With one sample in twelve spoiled, a quarter of the second differences are.
        let high = sorted.get(sorted.len() * 7 / 10).copied().unwrap_or(0.0);
        let impossible = (8.0 * median(second)).max(4.0 * high);
        let jumps = sorted.iter().filter(|value| **value > impossible).count();
        #[expect(clippy::cast_precision_loss, reason = "counts of samples")]
        let has_outliers = impossible > 0.0 && jumps as f64 > SHARE * sorted.len() as f64;
        Noise { deviation: if deviation > 0.0 { deviation } else { quantised }, has_outliers }
    }
}

/// Which samples lie within full scale: a converter that saturates repeats its largest or smallest value far
/// more often than the values next to it.
///
/// What the record begins or ends with does not count: a mass may be held, or rest, at its extreme. Next to flattened
/// samples noise has chosen which ones are left, so those are left out until the motion is clear of the limit.
#[must_use]
pub fn within_scale(x: &[f64], noise: f64) -> Vec<bool> {
    /// Deviations of the noise that are clear of the limit.
    const CLEAR: f64 = 6.0;
    let (low, high) = x
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)));
    let mut within = vec![true; x.len()];
    for limit in [low, high] {
        if is_saturated(x, limit, high - low) {
            let near: Vec<bool> = x.iter().map(|x| (x - limit).abs() <= CLEAR * noise).collect();
            let order: Vec<usize> = (0..x.len()).collect();
            for pass in [order.clone(), order.into_iter().rev().collect()] {
                let mut beside = false;
                for index in pass {
                    beside = x[index] == limit || (beside && near[index]);
                    within[index] &= !beside;
                }
            }
        }
    }
    within
}

fn is_saturated(x: &[f64], limit: f64, range: f64) -> bool {
    /// The neighbouring values that are counted for comparison, as a part of the range.
    const BAND: f64 = 0.01;
    /// Fewest repetitions, and how much more frequent they must be.
    const FEWEST: usize = 8;
    const TIMES: usize = 4;
    let from = x.iter().position(|x| *x != limit).unwrap_or(0);
    let to = x.iter().rposition(|x| *x != limit).map_or(0, |last| last + 1);
    if to <= from {
        return false;
    }
    let inner = &x[from..to];
    let at = inner.iter().filter(|x| **x == limit).count();
    let steps = inner.iter().map(|x| (x - limit).abs()).filter(|step| *step > 0.0);
    let step = steps.fold(f64::INFINITY, f64::min);
    let band = (BAND * range).max(1.5 * step);
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
        let clean = Noise::of(&x);
        assert!((clean.deviation / 0.02 - 1.0).abs() < 0.1 && !clean.has_outliers, "{clean:?}");
        x.iter_mut().step_by(97).for_each(|x| *x += 1.0);
        let spoiled = Noise::of(&x);
        assert!(
            (spoiled.deviation / 0.02 - 1.0).abs() < 0.2 && spoiled.has_outliers,
            "{spoiled:?}"
        );
    }

    #[test]
    fn full_scale_is_seen_and_a_hold_or_a_coarse_converter_is_not_taken_for_it() {
        let left_out = |x: &[f64]| within_scale(x, 0.01).iter().filter(|within| !**within).count();
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
        assert_eq!([coarse, held, rests].map(|x| left_out(&x)), [0; 3]);
    }
}
