//! The dominant frequency of a record, from its periodogram.

use std::f64::consts::TAU;

use crate::numerics::count::real;
use crate::numerics::elementary::{powi, sin_cos};

/// Maximum number of evenly spaced points that are transformed.
const MOST: usize = 1 << 14;

/// The frequency in 1/s at which the power times the squared frequency is largest. Without that factor a long
/// hold or rest, or a drift, would dominate. `None` for fewer than eight samples or no duration.
pub fn dominant_frequency(t: &[f64], x: &[f64]) -> Option<f64> {
    let count = t.len().next_power_of_two().clamp(64, MOST);
    let (first, last) = (*t.first()?, *t.last()?);
    let span = last - first;
    if t.len() < 8 || span <= 0.0 {
        return None;
    }
    let even = resampled(t, x, count);
    let mean = even.iter().sum::<f64>() / real(count);
    let mut values: Vec<(f64, f64)> = even.iter().map(|x| (x - mean, 0.0)).collect();
    transform(&mut values);
    let power = |k: usize| powi(real(k), 2) * (powi(values[k].0, 2) + powi(values[k].1, 2));
    // Zero padding would locate the peak more accurately, but the extremes do so later anyway.
    let best = (1..count / 2).max_by(|&one, &other| power(one).total_cmp(&power(other)))?;
    let around = (best.saturating_sub(1).max(1)..=best + 1).map(|k| (real(k), power(k)));
    let (weighted, weight) =
        around.fold((0.0, 0.0), |sum, (k, power)| (sum.0 + k * power, sum.1 + power));
    Some(weighted / weight / span)
}

/// The record at evenly spaced times, by linear interpolation.
fn resampled(t: &[f64], x: &[f64], count: usize) -> Vec<f64> {
    let (first, last) = (t[0], t[t.len() - 1]);
    let mut after = 1;
    let at = |index: usize| {
        let time = first + (last - first) * real(index) / real(count);
        while after + 1 < t.len() && t[after] < time {
            after += 1;
        }
        let step = t[after] - t[after - 1];
        let part = if step > 0.0 { (time - t[after - 1]) / step } else { 0.0 };
        x[after - 1] + part * (x[after] - x[after - 1])
    };
    (0..count).map(at).collect()
}

/// The discrete Fourier transform in place, by the radix-2 algorithm of Cooley and Tukey.
fn transform(values: &mut [(f64, f64)]) {
    let count = values.len();
    let bits = count.trailing_zeros();
    for index in 0..count {
        let other = index.reverse_bits() >> (usize::BITS - bits);
        if index < other {
            values.swap(index, other);
        }
    }
    let mut half = 1;
    while half < count {
        let turns: Vec<(f64, f64)> =
            (0..half).map(|k| sin_cos(TAU * real(k) / real(2 * half))).collect();
        for block in values.chunks_exact_mut(2 * half) {
            let (even, odd) = block.split_at_mut(half);
            for ((even, odd), (sine, cosine)) in even.iter_mut().zip(odd).zip(&turns) {
                let turned = (odd.0 * cosine + odd.1 * sine, odd.1 * cosine - odd.0 * sine);
                *odd = (even.0 - turned.0, even.1 - turned.1);
                *even = (even.0 + turned.0, even.1 + turned.1);
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::{cos, sin};

    #[test]
    fn a_decay_between_a_hold_and_a_rest_is_found_though_most_of_the_record_is_flat() {
        let t: Vec<f64> = (0..3000).map(|index| 0.01 * f64::from(index)).collect();
        let swing = |t: &f64| match t - 8.0 {
            late if late > 5.0 => 0.0,
            late if late > 0.0 => 3.0 * (1.0 - 0.2 * late) * cos(TAU * 1.7 * late),
            _ => 3.0,
        };
        let x: Vec<f64> = t.iter().map(swing).collect();
        let found = dominant_frequency(&t, &x).unwrap();
        assert!((found / 1.7 - 1.0).abs() < 0.05, "{found}");
    }

    #[test]
    fn a_tone_at_a_line_of_the_transform_is_that_line() {
        let t: Vec<f64> = (0..256).map(f64::from).collect();
        let x: Vec<f64> = t.iter().map(|t| sin(TAU * 16.0 * t / 255.0)).collect();
        assert!((dominant_frequency(&t, &x).unwrap() - 16.0 / 255.0).abs() < 2e-3);
        assert_eq!(dominant_frequency(&t[..5], &x[..5]), None);
    }
}
