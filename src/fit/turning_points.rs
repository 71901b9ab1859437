//! The turning points of a noisy record.

use super::noise::median;

/// A turning point read off a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// When, in s.
    pub t: f64,
    /// Where.
    pub x: f64,
}

/// The record averaged over a window of time: gaps and uneven sampling do no harm.
#[must_use]
pub fn smoothed(t: &[f64], x: &[f64], window: f64) -> Vec<f64> {
    let (mut from, mut to, mut sum) = (0, 0, 0.0);
    let mut out = Vec::with_capacity(x.len());
    for &time in t {
        while to < t.len() && t[to] <= time + 0.5 * window {
            sum += x[to];
            to += 1;
        }
        while t[from] < time - 0.5 * window {
            sum -= x[from];
            from += 1;
        }
        #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
        out.push(sum / (to - from) as f64);
    }
    out
}

/// The record without single jumps: medians of five.
#[must_use]
pub fn without_jumps(x: &[f64]) -> Vec<f64> {
    let around = |index: usize| x[index.saturating_sub(2)..(index + 3).min(x.len())].to_vec();
    (0..x.len()).map(|index| median(around(index))).collect()
}

/// The turning points of a record with this period: a zigzag through the smoothed record that turns only after
/// it has come back by `hysteresis`, each corner refined by a parabola through the samples around it. The
/// first sample is none.
#[must_use]
pub fn turning_points(t: &[f64], x: &[f64], period: f64, hysteresis: f64) -> Vec<Extreme> {
    let smooth = smoothed(t, x, period / 12.0);
    let corners = zigzag(&smooth, hysteresis);
    let mut found: Vec<Extreme> = Vec::new();
    for corner in corners {
        let extreme = refined(t, x, corner, period / 9.0)
            .unwrap_or(Extreme { t: t[corner], x: smooth[corner] });
        found.push(extreme);
    }
    without_bursts(found, 0.3 * period)
}

/// Removes pairs of corners closer than `least`: what jumps forth and back is no swing.
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

/// Indices of the corners, but for the first: where the first movement begins the record may be held.
fn zigzag(x: &[f64], hysteresis: f64) -> Vec<usize> {
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
    corners.drain(..corners.len().min(1));
    corners
}

/// The vertex of the parabola through the samples within `reach` of a corner.
fn refined(t: &[f64], x: &[f64], corner: usize, reach: f64) -> Option<Extreme> {
    let middle = t[corner];
    let from = t.partition_point(|&t| t < middle - reach);
    let to = t.partition_point(|&t| t <= middle + reach);
    if to - from < 5 {
        return None;
    }
    let mut normal = nalgebra::Matrix3::zeros();
    let mut right = nalgebra::Vector3::zeros();
    for (t, x) in t[from..to].iter().zip(&x[from..to]) {
        let s = (t - middle) / reach;
        let row = nalgebra::Vector3::new(1.0, s, s * s);
        normal += row * row.transpose();
        right += row * *x;
    }
    let fitted = normal.cholesky()?.solve(&right);
    let s = -fitted[1] / (2.0 * fitted[2]);
    (s.abs() <= 1.0).then(|| Extreme { t: middle + s * reach, x: fitted[0] + 0.5 * s * fitted[1] })
}
