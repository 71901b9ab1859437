//! The turning points of a noisy record, its dominant frequency from its periodogram, and the damping over amplitude from
//! the decrements of successive turning points.
//!
//! Averaging the energy over a half swing of amplitude A gives the relative loss of amplitude per unit of time
//!
//! `delta(A) = D + 2 r/(pi A) + (3/8) D3 A^2`,
//!
//! so half peak-to-peak values `P` fall by `P_k - P_{k+1} = pi A delta(A)`, which is linear in r, D and D3 and
//! independent of the offset. D2 shifts the midpoints of the swings:
//! `(x_k + 2 x_{k+1} + x_{k+2})/4 = offset - (2/3) D2 A^2`.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use nalgebra::{Complex, DMatrix, DVector};

use super::{D, D2, D3, OFFSET, R, Unknowns, least_squares, median, robust_deviation};
use crate::model::Parameters;
use crate::numerics::{atan2, by_number, hypot, powi, real, sin_cos};

/// A turning point read from a record.
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    /// Time in s.
    pub t: f64,
    /// Displacement.
    pub x: f64,
}

/// The record averaged over a window of time, which allows gaps and uneven sampling.
pub fn smoothed(t: &[f64], x: &[f64], window: f64) -> Vec<f64> {
    let mut sums = vec![0.0];
    sums.extend(x.iter().scan(0.0, |sum, x| {
        *sum += x;
        Some(*sum)
    }));
    let mean = |time: &f64| {
        let Range { start, end } = within(t, *time, 0.5 * window);
        (sums[end] - sums[start]) / real(end - start)
    };
    t.iter().map(mean).collect()
}

/// The index of the first sample from a time on.
pub fn index_at(t: &[f64], time: f64) -> usize {
    t.partition_point(|t| *t < time)
}

/// The samples within `reach` of a time.
fn within(t: &[f64], time: f64, reach: f64) -> Range<usize> {
    index_at(t, time - reach)..t.partition_point(|t| *t <= time + reach)
}

/// The record without isolated jumps, by medians of five samples.
pub fn without_jumps(x: &[f64]) -> Vec<f64> {
    let around = |index: usize| x[index.saturating_sub(2)..(index + 3).min(x.len())].to_vec();
    (0..x.len()).map(|index| median(around(index))).collect()
}

/// The turning points of a record with this period. They are the corners of a zigzag through the smoothed
/// record that turns only after the record has come back by `hysteresis`. Each corner is refined by a parabola
/// through the samples around it. The first corner is left out.
pub fn turning_points(t: &[f64], x: &[f64], period: f64, hysteresis: f64) -> Vec<Extreme> {
    let smooth = smoothed(t, x, period / 12.0);
    let refined = |corner: usize| {
        let vertex = parabola(t, x, corner, period / 9.0);
        let turn = vertex.or_else(|| swing(t, x, corner, period));
        turn.unwrap_or(Extreme { t: t[corner], x: smooth[corner] })
    };
    without_bursts(zigzag(&smooth, hysteresis).map(refined).collect(), 0.3 * period)
}

/// Removes pairs of turning points that are closer than `least`: jumps back and forth are not swings.
fn without_bursts(mut found: Vec<Extreme>, least: f64) -> Vec<Extreme> {
    let mut index = 0;
    while index + 1 < found.len() {
        if found[index + 1].t - found[index].t < least && found.len() > 3 {
            found.drain(index..index + 2);
            index = index.saturating_sub(1);
        } else {
            index += 1;
        }
    }
    found
}

/// Indices of the corners, except for the first, before which the mass may be held.
fn zigzag(x: &[f64], hysteresis: f64) -> impl Iterator<Item = usize> {
    let mut corners = Vec::new();
    let (mut lowest, mut highest) = (0, 0);
    // +1 while rising, -1 while falling, 0 before the first clear movement.
    let mut way = 0;
    for index in 1..x.len() {
        if x[index] > x[highest] {
            highest = index;
        }
        if x[index] < x[lowest] {
            lowest = index;
        }
        if way >= 0 && x[index] < x[highest] - hysteresis {
            corners.push(highest);
            (way, lowest) = (-1, index);
        } else if way <= 0 && x[index] > x[lowest] + hysteresis {
            corners.push(lowest);
            (way, highest) = (1, index);
        }
    }
    corners.into_iter().skip(1)
}

/// The turning point of an undamped oscillation through the samples within half a period of a corner, for records
/// with few samples per period, which hardly ever contain the turning points themselves.
fn swing(t: &[f64], x: &[f64], corner: usize, period: f64) -> Option<Extreme> {
    /// Slightly more than half a period, so that with four samples per period five samples are within reach.
    const REACH: f64 = 0.55;
    let turn = |s: f64| {
        let (sine, cosine) = sin_cos(TAU * REACH * s);
        [1.0, cosine, sine]
    };
    let [middle, cosine, sine] = fitted(t, x, t[corner], REACH * period, turn)?;
    let up = if x[corner] > middle { 1.0 } else { -1.0 };
    let phase = atan2(up * sine, up * cosine) / TAU;
    let found = Extreme { t: t[corner] + phase * period, x: middle + up * hypot(cosine, sine) };
    (phase.abs() <= 0.25).then_some(found)
}

/// The vertex of the parabola through the samples within `reach` of a corner.
fn parabola(t: &[f64], x: &[f64], corner: usize, reach: f64) -> Option<Extreme> {
    let [level, slope, bend] = fitted(t, x, t[corner], reach, |s| [1.0, s, s * s])?;
    let s = -slope / (2.0 * bend);
    (s.abs() <= 1.0).then(|| Extreme { t: t[corner] + s * reach, x: level + 0.5 * s * slope })
}

/// The coefficients of the linear combination of three functions of `s = (t - middle)/reach` that fits the samples
/// within reach best; `None` for fewer than five samples.
fn fitted(
    t: &[f64],
    x: &[f64],
    middle: f64,
    reach: f64,
    functions: impl Fn(f64) -> [f64; 3],
) -> Option<[f64; 3]> {
    let range = within(t, middle, reach);
    if range.len() < 5 {
        return None;
    }
    let samples = t[range.clone()].iter().zip(&x[range]);
    least_squares(samples.map(|(t, x)| (functions((t - middle) / reach), *x)))
}

/// Maximum number of evenly spaced points that are transformed.
const MOST: usize = 1 << 14;

/// The frequency in 1/s at which the power times the squared frequency is largest. Without that factor a long
/// hold or rest, or a drift, would dominate. `None` for fewer than eight samples or no duration.
pub fn dominant_frequency(t: &[f64], x: &[f64]) -> Option<f64> {
    let count = t.len().next_power_of_two().clamp(64, MOST);
    let span = t.last()? - t.first()?;
    if t.len() < 8 || span <= 0.0 {
        return None;
    }
    let even = resampled(t, x, count);
    let mean = even.iter().sum::<f64>() / real(count);
    let values: Vec<Complex<f64>> = even.iter().map(|x| Complex::from(x - mean)).collect();
    let root = |k: usize| {
        let (sine, cosine) = sin_cos(TAU * real(k) / real(count));
        Complex::new(cosine, -sine)
    };
    let spectrum = transform(&values, &(0..count / 2).map(root).collect::<Vec<_>>());
    let power = |k: usize| powi(real(k), 2) * spectrum[k].norm_sqr();
    // Zero padding would locate the peak more accurately, but the extremes do so later anyway.
    let best = (1..count / 2).max_by(by_number(|k: &usize| power(*k)))?;
    let around = (best.saturating_sub(1).max(1)..=best + 1).map(|k| (real(k), power(k)));
    let (weighted, weight) =
        around.fold((0.0, 0.0), |sum, (k, power)| (sum.0 + k * power, sum.1 + power));
    Some(weighted / weight / span)
}

/// The record at evenly spaced times, by linear interpolation.
fn resampled(t: &[f64], x: &[f64], count: usize) -> Vec<f64> {
    let (first, last) = (t[0], t[t.len() - 1]);
    let at = |index: usize| {
        let time = first + (last - first) * real(index) / real(count);
        let after = index_at(t, time).clamp(1, t.len() - 1);
        let step = t[after] - t[after - 1];
        let part = if step > 0.0 {
            (time - t[after - 1]) / step
        } else {
            0.0
        };
        x[after - 1] + part * (x[after] - x[after - 1])
    };
    (0..count).map(at).collect()
}

/// The discrete Fourier transform by the radix-2 algorithm of Cooley and Tukey; `roots` are the roots of unity of a
/// transform at least as long, in the lower half plane.
fn transform(values: &[Complex<f64>], roots: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let half = values.len() / 2;
    if half == 0 {
        return values.to_vec();
    }
    let [even, odd] = [0, 1].map(|first| {
        let part: Vec<_> = values.iter().skip(first).step_by(2).copied().collect();
        transform(&part, roots)
    });
    let roots = roots.iter().step_by(roots.len() / half);
    let turned: Vec<_> = odd.iter().zip(roots).map(|(odd, root)| odd * root).collect();
    let sum = even.iter().zip(&turned).map(|(even, odd)| even + odd);
    let difference = even.iter().zip(&turned).map(|(even, odd)| even - odd);
    sum.chain(difference).collect()
}

/// The relative loss of amplitude per unit of time by averaging.
pub fn averaged(parameters: &Parameters, amplitude: f64) -> f64 {
    let Parameters { d, d3, r, .. } = *parameters;
    d + 2.0 * r / (PI * amplitude) + 0.375 * d3 * amplitude * amplitude
}

/// Sets of terms that are fitted to the decrements, as indices into r, D, D3. A fit of few terms cannot go far
/// wrong if the motion hardly decays.
const TERMS: [&[usize]; 4] = [&[0, 1, 2], &[0, 1], &[1, 2], &[1]];

/// Half the peak-to-peak values of successive turning points.
pub fn amplitudes(extremes: &[Extreme]) -> Vec<f64> {
    extremes.windows(2).map(|two| 0.5 * (two[1].x - two[0].x).abs()).collect()
}

/// The middle between a turning point and those before and after it.
pub fn middle_of(three: &[Extreme]) -> f64 {
    0.25 * (three[0].x + 2.0 * three[1].x + three[2].x)
}

/// The unknowns with damping, friction and offset from the turning points, one result for each of `TERMS` that can be
/// fitted; of a single swing one for each of several intensities of friction. Empty for fewer than two turning points.
pub fn regressions(extremes: &[Extreme]) -> Vec<Unknowns> {
    let largest = amplitudes(extremes).into_iter().fold(0.0, f64::max);
    if largest <= 0.0 {
        return Vec::new();
    }
    if let [one, other] = extremes {
        return of_one_swing(one.x, other.x);
    }
    // In units of the largest amplitude, so that the columns have similar norms.
    let unit: Vec<Extreme> =
        extremes.iter().map(|it| Extreme { x: (it.x - extremes[0].x) / largest, ..*it }).collect();
    let mut found = Vec::new();
    for terms in TERMS {
        let Some([r, d, d3]) = damping(&unit, terms) else { continue };
        let Some([offset, d2]) = middle(&unit, d) else { continue };
        let mut p = Unknowns::zeros();
        (p[D], p[D2], p[D3]) = (d, d2 / largest, d3 / (largest * largest));
        (p[R], p[OFFSET]) = (r * largest, extremes[0].x + offset * largest);
        found.push(p);
    }
    found
}

/// A single swing tells offset and friction only together: `x_0 + x_1 = 2 (offset + r)` if it begins on the right.
fn of_one_swing(begin: f64, end: f64) -> Vec<Unknowns> {
    /// Intensities of friction as parts of the amplitude.
    const PARTS: [f64; 6] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3];
    /// Moderate damping.
    const DAMPING: f64 = 0.02;
    let of = |part: f64| {
        let right = 0.5 * part * (begin - end);
        let mut p = Unknowns::zeros();
        (p[D], p[R], p[OFFSET]) = (DAMPING, right.abs(), 0.5 * (begin + end) - right);
        p
    };
    PARTS.map(of).to_vec()
}

/// r, D and D3 from the decrements; `None` for fewer decrements than terms, or if the friction is negative.
fn damping(extremes: &[Extreme], terms: &[usize]) -> Option<[f64; 3]> {
    let row = |a: f64| [2.0, PI * a, 0.375 * PI * a * a * a];
    let rows: Vec<([f64; 3], f64)> = amplitudes(extremes)
        .windows(2)
        .map(|two| (row(0.5 * (two[0] + two[1])), two[0] - two[1]))
        .collect();
    let found = (rows.len() >= terms.len()).then(|| robust(&rows, terms)).flatten();
    found.filter(|found| found[0] >= 0.0)
}

/// Offset and D2 from the midpoints. Strong damping itself shifts the midpoints; D2 is then 0.
fn middle(extremes: &[Extreme], d: f64) -> Option<[f64; 2]> {
    let rows: Vec<([f64; 2], f64)> = extremes
        .windows(3)
        .map(|three| {
            let amplitude = 0.25 * (2.0 * three[1].x - three[0].x - three[2].x).abs();
            ([1.0, -2.0 / 3.0 * amplitude * amplitude], middle_of(three))
        })
        .collect();
    let both = rows.len() >= 4 && d.abs() < 0.1;
    robust(&rows, if both { &[0, 1] } else { &[0] })
}

/// Linear regression on some of the columns, with zero for the others, by iterated Cauchy weights, since one wrong extreme
/// spoils three decrements.
pub fn robust<const N: usize>(rows: &[([f64; N], f64)], columns: &[usize]) -> Option<[f64; N]> {
    const ROUNDS: usize = 12;
    let mut weights = vec![1.0; rows.len()];
    let mut all = [0.0; N];
    for _ in 0..ROUNDS {
        let cell = |i: usize, j: usize| weights[i] * rows[i].0[columns[j]];
        let matrix = DMatrix::from_fn(rows.len(), columns.len(), cell);
        let right = DVector::from_fn(rows.len(), |i, _| weights[i] * rows[i].1);
        let found = matrix.svd(true, true).solve(&right, 1e-12).ok()?;
        for (column, value) in columns.iter().zip(found.iter()) {
            all[*column] = *value;
        }
        let told = |row: &[f64; N]| row.iter().zip(&all).map(|(a, b)| a * b).sum::<f64>();
        let left: Vec<f64> = rows.iter().map(|(row, value)| value - told(row)).collect();
        let scale = 2.385 * robust_deviation(left.iter().copied());
        if scale <= 0.0 {
            break;
        }
        for (weight, left) in weights.iter_mut().zip(left) {
            *weight = (1.0 / (1.0 + powi(left / scale, 2))).sqrt();
        }
    }
    Some(all)
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

    /// The turning points of an undamped mass with dry friction: each half swing loses exactly 2 r.
    fn coulomb(r: f64, offset: f64) -> Vec<Extreme> {
        let turn = |k: u32| {
            let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            Extreme { t: PI * f64::from(k), x: offset + sign * (5.0 - 2.0 * r * f64::from(k)) }
        };
        (0..12).map(turn).collect()
    }

    #[test]
    fn dry_friction_alone_is_read_off_exactly_in_any_unit() {
        for unit in [1e-6, 1.0, 1e6] {
            let mut extremes = coulomb(0.125, 0.5);
            for extreme in &mut extremes {
                extreme.x *= unit;
            }
            let found = regressions(&extremes)[0];
            assert!((found[R] / (0.125 * unit) - 1.0).abs() < 1e-9, "{found:?}");
            assert!(found[D].abs() < 1e-9 && (found[D3] * unit * unit).abs() < 1e-9, "{found:?}");
            assert!((found[OFFSET] / (0.5 * unit) - 1.0).abs() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn one_wrong_turning_point_does_not_spoil_the_rest() {
        let mut extremes = coulomb(0.125, 0.5);
        extremes[5].x += 2.0;
        let found = regressions(&extremes)[0];
        assert!((found[R] - 0.125).abs() < 0.01, "{found:?}");
    }

    #[test]
    fn a_single_swing_tells_friction_and_offset_only_together() {
        for two in coulomb(0.125, 0.5).windows(2) {
            let found = regressions(two);
            let side = (two[0].x - two[1].x).signum();
            assert!(found.len() > 2);
            assert!(
                found
                    .iter()
                    .all(|it| (it[OFFSET] + side * it[R] - 0.5 - side * 0.125).abs() < 1e-12)
            );
        }
        assert!(regressions(&coulomb(0.1, 0.0)[..1]).is_empty());
        assert!(regressions(&[Extreme { t: 0.0, x: 1.0 }; 5]).is_empty());
    }
}
