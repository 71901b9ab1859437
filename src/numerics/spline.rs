//! The smoothest curve near measured points: a smoothing spline of degree five.
//!
//! A table of `mu(v)` has no derivatives, but the oscillator needs three. They follow from an assumption: of
//! all curves whose root mean square distance from the points is `scatter`, take the one with the least
//! integral of `mu'''^2`. It is a polynomial of degree five between neighbouring points, has four continuous
//! derivatives, and satisfies `mu''' = 0` at the first and the last point. With a scatter of 0 it passes
//! through every point; every error of a point is then an error of the law, amplified in the third derivative
//! by the cube of the inverse spacing.
//!
//! Method (analogous to Reinsch's for degree three): `mu'''` is a sum of the quadratic B-splines `M_i` over
//! four neighbouring points, each of integral 1. Its coefficients `c` are related to the values `g` at the
//! points by `6 [x_i .. x_i+3] mu = integral of M_i mu'''`, that is, `G c = 6 Q g` with the Gram matrix `G` and
//! the third divided differences `Q`. The minimum of `|y - g|^2 + lambda c G c` has `g = y - 6 lambda Q' c` and
//! `(G + 36 lambda Q Q') c = 6 Q y`, a system with seven diagonals.

use serde::{Deserialize, Serialize};

use super::{Derivatives, bisect, by_number, derivatives, exp, gauss, ln, powi, real, value};

/// Smallest number of points with a third derivative.
pub const FEWEST: usize = 4;

/// The data of a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct ScatteredPoints {
    points: Vec<(f64, f64)>,
    scatter: f64,
}

/// Coefficients of a polynomial of degree five.
type Quintic = [f64; 6];

/// A smooth curve near given points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "ScatteredPoints")]
pub struct SmoothingSpline {
    /// The data of the curve: all that is written of it.
    #[serde(flatten)]
    given: ScatteredPoints,
    /// The curve on each interval, in powers of the distance from its left end.
    #[serde(skip)]
    pieces: Vec<Quintic>,
    /// Root mean square distance from the points.
    #[serde(skip)]
    pub missed: f64,
}

impl TryFrom<ScatteredPoints> for SmoothingSpline {
    type Error = String;

    fn try_from(given: ScatteredPoints) -> Result<Self, String> {
        SmoothingSpline::new(&given.points, given.scatter)
    }
}

impl SmoothingSpline {
    /// The smoothest curve whose root mean square distance from `points` is (at most) `scatter`. Fails with one line
    /// for fewer than four points, for numbers that are not finite, and for abscissae that do not increase or are so
    /// uneven that numbers overflow.
    pub fn new(points: &[(f64, f64)], scatter: f64) -> Result<Self, String> {
        if points.len() < FEWEST {
            return Err(format!("a table needs {FEWEST} points or more, not {}", points.len()));
        }
        let wrong = |index: &usize| {
            let (x, y) = points[*index];
            !(x.is_finite() && y.is_finite()) || (*index > 0 && x <= points[index - 1].0)
        };
        if let Some(index) = (0..points.len()).find(wrong) {
            let number = index + 1;
            return Err(format!(
                "point {number}: numbers must be finite, velocities must increase"
            ));
        }
        let (x, y): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        let system = SplineSystem::new(&x, &y);
        let smoothing = system.smoothing(scatter);
        let (c, g) = system.solve(smoothing);
        let missed = quadratic_mean(&y, &g);
        let pieces = pieces(&x, &g, &bends(&x, &c));
        if !pieces.iter().flatten().chain(&g).all(|number| number.is_finite()) {
            let gap = |one: &usize| x[*one] - x[one - 1];
            let one = (1..x.len()).min_by(by_number(gap)).unwrap_or(1);
            return Err(format!(
                "points {one} and {} are too close together beside the others for a smooth curve",
                one + 1
            ));
        }
        let given = ScatteredPoints { points: points.to_vec(), scatter };
        Ok(SmoothingSpline { given, pieces, missed })
    }

    /// First and last abscissa.
    pub fn range(&self) -> (f64, f64) {
        (self.given.points[0].0, self.given.points[self.pieces.len()].0)
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.given.points.len()
    }

    /// A number that the same data always have, and other data hardly ever (FNV-1a).
    pub fn fingerprint(&self) -> u32 {
        let points = self.given.points.iter().flat_map(|(x, y)| [*x, *y]);
        let bytes = points.chain([self.given.scatter]).flat_map(f64::to_le_bytes);
        bytes.fold(0x811c_9dc5, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
    }

    /// The pieces in order: their two ends, and the coefficients in powers of the distance from the left end.
    pub fn polynomials(&self) -> impl Iterator<Item = (f64, f64, Quintic)> + '_ {
        let ends = self.given.points.windows(2);
        ends.zip(&self.pieces).map(|(ends, piece)| (ends[0].0, ends[1].0, *piece))
    }

    /// The curve and its derivatives at `x`; beyond the ends the end pieces are continued.
    pub fn at(&self, x: f64) -> Derivatives {
        let after = self.given.points.partition_point(|knot| knot.0 <= x);
        let index = after.clamp(1, self.pieces.len()) - 1;
        derivatives(&self.pieces[index], x - self.given.points[index].0)
    }
}

fn quadratic_mean(one: &[f64], other: &[f64]) -> f64 {
    let squares: f64 = one.iter().zip(other).map(|(one, other)| powi(one - other, 2)).sum();
    (squares / real(one.len())).sqrt()
}

/// The seven diagonals of a symmetric matrix: `row[k]` is the element `k` columns to the right.
type Band = Vec<[f64; 4]>;

/// The linear system for given points.
struct SplineSystem<'a> {
    y: &'a [f64],
    /// Third divided differences: row i acts on points i to i + 3.
    q: Vec<[f64; 4]>,
    gram: Band,
    penalty: Band,
}

impl<'a> SplineSystem<'a> {
    fn new(x: &[f64], y: &'a [f64]) -> Self {
        let rows = x.len() - 3;
        let q: Vec<[f64; 4]> = (0..rows).map(|row| divided_difference(&x[row..row + 4])).collect();
        let mut gram = vec![[0.0; 4]; rows];
        let mut penalty = gram.clone();
        for row in 0..rows {
            for right in 0..4.min(rows - row) {
                gram[row][right] = overlap(x, row, row + right);
                let shared = q[row][right..].iter().zip(&q[row + right]);
                penalty[row][right] = 36.0 * shared.map(|(a, b)| a * b).sum::<f64>();
            }
        }
        SplineSystem { y, q, gram, penalty }
    }

    /// Coefficients of the third derivative and values at the points.
    fn solve(&self, smoothing: f64) -> (Vec<f64>, Vec<f64>) {
        let matrix = self.gram.iter().zip(&self.penalty).map(|(gram, penalty)| {
            std::array::from_fn(|right| gram[right] + smoothing * penalty[right])
        });
        let differences = self.q.iter().zip(self.y.windows(4));
        let right_side = differences
            .map(|(q, y)| 6.0 * q.iter().zip(y).map(|(q, y)| q * y).sum::<f64>())
            .collect();
        let c = solve(matrix.collect(), right_side);
        let mut g = self.y.to_vec();
        for (row, (c, q)) in c.iter().zip(&self.q).enumerate() {
            for (column, q) in q.iter().enumerate() {
                g[row + column] -= 6.0 * smoothing * c * q;
            }
        }
        (c, g)
    }

    /// The smoothing for which the curve has the root mean square distance `scatter` from the points.
    fn smoothing(&self, scatter: f64) -> f64 {
        /// Half the search range of the logarithm, around the value where both matrices have equal weight.
        const REACH: f64 = 50.0;
        /// Number of halvings, enough to reach rounding.
        const HALVINGS: u32 = 60;
        if scatter <= 0.0 {
            return 0.0;
        }
        let weight = |band: &Band| band.iter().map(|row| row[0]).sum::<f64>();
        let middle = ln(weight(&self.gram) / weight(&self.penalty));
        let missed = |log: f64| quadratic_mean(self.y, &self.solve(exp(log)).1);
        let (low, high) = (middle - REACH, middle + REACH);
        if missed(high) <= scatter {
            return exp(high);
        }
        exp(bisect(low, high, HALVINGS, |log| missed(log) >= scatter).0)
    }
}

/// Weights of the divided difference over these points.
fn divided_difference(x: &[f64]) -> [f64; 4] {
    std::array::from_fn(|own| {
        let others = x.iter().enumerate().filter(|(other, _)| *other != own);
        1.0 / others.map(|(_, other)| x[own] - other).product::<f64>()
    })
}

/// The B-spline of integral 1 over `x[0..4]` at `at`: `3 [x0 .. x3] max(x - at, 0)^2`.
fn bump(x: &[f64], at: f64) -> f64 {
    // By the Cox-de Boor recurrence, whose terms are all positive.
    let hat = |i: usize| {
        let (a, b, c) = (x[i], x[i + 1], x[i + 2]);
        let inside = if at < b {
            (at - a) / (b - a)
        } else {
            (c - at) / (c - b)
        };
        inside.max(0.0)
    };
    let smooth = (at - x[0]) / (x[2] - x[0]) * hat(0) + (x[3] - at) / (x[3] - x[1]) * hat(1);
    3.0 * smooth / (x[3] - x[0])
}

/// Integral of the product of two B-splines, by a rule exact for these polynomials.
fn overlap(x: &[f64], one: usize, other: usize) -> f64 {
    let integral = |interval: usize| {
        let (left, length) = (x[interval], x[interval + 1] - x[interval]);
        let product = |at: f64| bump(&x[one..one + 4], at) * bump(&x[other..other + 4], at);
        length * gauss(|part| product(left + part * length))
    };
    (other..one + 3).map(integral).sum()
}

/// Solves a positive definite system with seven diagonals by `L D L'`.
fn solve(mut band: Band, mut b: Vec<f64>) -> Vec<f64> {
    let rows = band.len();
    for row in 0..rows {
        let pivot = band[row];
        for below in 1..4.min(rows - row) {
            let factor = pivot[below] / pivot[0];
            for right in below..4 {
                band[row + below][right - below] -= factor * pivot[right];
            }
            b[row + below] -= factor * b[row];
        }
    }
    for row in (0..rows).rev() {
        let known: f64 =
            (1..4.min(rows - row)).map(|right| band[row][right] * b[row + right]).sum();
        b[row] = (b[row] - known) / band[row][0];
    }
    b
}

/// What the third derivative contributes on each interval, from its B-spline coefficients: the polynomial that begins with
/// value, slope and curvature zero.
fn bends(x: &[f64], c: &[f64]) -> Vec<Quintic> {
    let third = |interval: usize, at: f64| -> f64 {
        let first = interval.saturating_sub(2);
        let last = interval.min(c.len() - 1);
        (first..=last).map(|i| c[i] * bump(&x[i..i + 4], at)).sum()
    };
    let bend = |(interval, ends): (usize, &[f64])| {
        let (left, h) = (ends[0], ends[1] - ends[0]);
        // The quadratic through three points of the interval, integrated three times.
        let [a, m, b] = [0.0, 0.5, 1.0].map(|part| third(interval, left + part * h));
        let (slope, curvature) = ((4.0 * m - 3.0 * a - b) / h, 2.0 * (a - 2.0 * m + b) / (h * h));
        [0.0, 0.0, 0.0, a / 6.0, slope / 24.0, curvature / 60.0]
    };
    x.windows(2).enumerate().map(bend).collect()
}

/// The curve on each interval, such that it takes the given values at both ends and at the neighbouring point.
fn pieces(x: &[f64], g: &[f64], bends: &[Quintic]) -> Vec<Quintic> {
    let piece = |(interval, bend): (usize, &Quintic)| {
        let (left, near) = (x[interval], x[interval + 1] - x[interval]);
        // Position of the neighbouring point relative to the left end, and its value without the third derivative.
        let (far, rise) = if interval > 0 {
            let far = x[interval - 1] - left;
            (far, g[interval - 1] - g[interval] + continued(&bends[interval - 1], -far, far))
        } else {
            let far = x[2] - left;
            let ahead = continued(bend, near, far - near) + value(&bends[1], far - near);
            (far, g[2] - g[0] - ahead)
        };
        let reach = g[interval + 1] - g[interval] - value(bend, near);
        let second = 2.0 * (reach / near - rise / far) / (near - far);
        let [.., a, b, c] = *bend;
        [g[interval], reach / near - second * near / 2.0, second / 2.0, a, b, c]
    };
    bends.iter().enumerate().map(piece).collect()
}

/// A polynomial continued beyond a place as the parabola that touches it there, by a distance.
fn continued(bend: &Quintic, place: f64, by: f64) -> f64 {
    Derivatives { third: 0.0, ..derivatives(bend, place) }.cubic(by)
}

#[cfg(test)]
mod tests {
    //! Smoothing against exact curves.

    use super::*;
    use crate::numerics::elementary::{exp, pow};

    fn sampled(mu: impl Fn(f64) -> f64, count: u32) -> Vec<(f64, f64)> {
        // Unevenly spaced, closer near 0, as measurements are.
        let at = |index: u32| pow(f64::from(index) / f64::from(count - 1), 1.3);
        (0..count).map(|index| (at(index), mu(at(index)))).collect()
    }

    fn stribeck(v: f64) -> f64 {
        0.2 + 0.3 * exp(-v / 0.3)
    }

    #[test]
    fn it_passes_through_every_point_and_repeats_parabolas() {
        let points = sampled(stribeck, 12);
        let spline = SmoothingSpline::new(&points, 0.0).unwrap();
        assert!(points.iter().all(|&(x, y)| (spline.at(x).value - y).abs() < 1e-14));
        let parabola = |v: f64| 0.5 - 0.3 * v + 0.1 * v * v;
        let spline = SmoothingSpline::new(&sampled(parabola, 9), 0.0).unwrap();
        for v in [0.0, 0.123, 0.5, 1.0] {
            let found = spline.at(v);
            assert!((found.value - parabola(v)).abs() < 1e-14);
            assert!((found.first - (0.2 * v - 0.3)).abs() < 1e-12);
            assert!((found.second - 0.2).abs() < 1e-10 && found.third.abs() < 1e-8);
        }
    }

    #[test]
    fn four_derivatives_are_continuous() {
        let points = sampled(stribeck, 9);
        let spline = SmoothingSpline::new(&points, 0.0).unwrap();
        for &(x, _) in &points[1..8] {
            let (before, after) = (spline.at(x - 1e-9), spline.at(x + 1e-9));
            assert!((before.first - after.first).abs() < 1e-7);
            assert!((before.second - after.second).abs() < 1e-6);
            assert!((before.third - after.third).abs() < 1e-4);
        }
    }

    #[test]
    fn derivatives_away_from_the_ends_converge_to_those_of_the_law() {
        let exact = Derivatives {
            value: stribeck(0.5),
            first: (stribeck(0.5) - 0.2) / -0.3,
            second: (stribeck(0.5) - 0.2) / 0.09,
            third: (stribeck(0.5) - 0.2) / -0.027,
        };
        let error = |count| {
            let found = SmoothingSpline::new(&sampled(stribeck, count), 0.0).unwrap().at(0.5);
            (found.third / exact.third - 1.0).abs().max((found.first / exact.first - 1.0).abs())
        };
        assert!(error(12) < 0.05, "{}", error(12));
        assert!(error(48) < 2e-3 && error(192) < 1e-4, "{} {}", error(48), error(192));
    }

    #[test]
    fn scatter_is_taken_out_by_as_much_as_was_said() {
        // Uniform deviations of root mean square 0.01, from a congruential generator.
        let mut points = sampled(stribeck, 60);
        let mut seed = 1_u32;
        for point in &mut points {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let even = f64::from(seed) / f64::from(u32::MAX) - 0.5;
            point.1 += 0.01 * 12.0_f64.sqrt() * even;
        }
        let spline = SmoothingSpline::new(&points, 0.01).unwrap();
        assert!((spline.missed - 0.01).abs() < 1e-6, "{}", spline.missed);
        let rough = SmoothingSpline::new(&points, 0.0).unwrap();
        let slope = (stribeck(0.5) - 0.2) / -0.3;
        let (smooth, rough) = (spline.at(0.5).first, rough.at(0.5).first);
        assert!((smooth / slope - 1.0).abs() < 0.1, "{smooth} for {slope}");
        assert!((rough / slope - 1.0).abs() > 0.2, "{rough} for {slope}");
        // If all deviation is allowed as scatter, the least squares parabola remains.
        let parabola = SmoothingSpline::new(&points, 1.0).unwrap();
        assert!(parabola.at(0.5).third.abs() < 1e-6);
    }

    #[test]
    fn what_is_no_table_is_refused() {
        let refused = |points: &[(f64, f64)]| SmoothingSpline::new(points, 0.0).unwrap_err();
        assert_eq!(refused(&[(0.0, 1.0); 3]), "a table needs 4 points or more, not 3");
        let point = |number: usize| {
            format!("point {number}: numbers must be finite, velocities must increase")
        };
        let twice = [(0.0, 1.0), (1.0, 1.0), (1.0, 2.0), (2.0, 1.0)];
        assert_eq!(refused(&twice), point(3));
        let uneven = [(0.0, 0.4), (1.0, 0.3), (1.0 + 1e-15, 0.25), (1e300, 0.2)];
        assert!(refused(&uneven).starts_with("points 2 and 3 are too close together"));
        let missing = [(0.0, 1.0), (1.0, f64::NAN), (2.0, 2.0), (3.0, 1.0)];
        assert_eq!(refused(&missing), point(2));
    }
}
