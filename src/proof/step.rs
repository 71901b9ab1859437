//! One certified step: a Taylor polynomial in plain doubles, and a bound on the distance of the motion from it.
//!
//! The coefficients are computed in ordinary rounded arithmetic and then taken as exact: they define an exact
//! polynomial `(p, w)(t)` for `(x, v)`. It satisfies the equation up to a defect
//!
//! `p' - w` and `w' + p + a w + b w^2 + c w^3`,
//!
//! which is bounded by sums of magnitudes (rounding, lemma 2; truncation, lemma 3). The distance `e` between
//! motion and polynomial obeys a linear equation with this defect as its force. In the norm
//! `abs(e)^2 = e_x^2 + s e_x e_v + e_v^2`, `abs(s) < 2`, it grows no faster than a logarithmic norm allows
//! (lemma 4). With s near 2 D the norm follows the linear spiral exactly, so the ball keeps its relative size
//! through many turns of growth or decay.
//!
//! `docs/proofs.md` has the lemmas and the count of every rounding.

use super::series::{INVERSE, LANES, LENGTH};
use super::{FieldBox, MotionSeries, ORDER};
use crate::numerics::{Interval, ln, real};

/// The unit roundoff of doubles, `2^-53`.
pub const UNIT: f64 = f64::EPSILON / 2.0;

/// Inflates a bound that is a sum of non-negative terms.
///
/// It covers the rounding of that sum and all products of two or more rounding errors in the counts below: with
/// fewer than 1,000 operations and counts below 200, both are less than `2e-13` of it.
pub const INFLATE: f64 = 1.0 + 1e-12;

/// Added to every defect, times `1 + a + b + c`. Each underflow loses less than `2^-1074`. In the units of a
/// step, in which the start is near 1, there are fewer than `1e6` underflows, none multiplied by a factor above
/// `1e20`.
pub const UNDERFLOW: f64 = 1e-290;

/// The norm `sqrt(e_x^2 + s e_x e_v + e_v^2)` in which errors are measured.
///
/// It is at most `abs(e_x) + abs(e_v)`, because `abs(s) < 2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Norm {
    /// `s`.
    pub(super) skew: f64,
    /// Upper bound of `2/sqrt(4 - s^2)`: no component exceeds this multiple of the norm.
    pub stretch: f64,
}

impl Norm {
    /// The norm with a skew, clamped to the useful range.
    pub fn new(skew: f64) -> Self {
        /// Beyond this skew the norm is too flat.
        const FLATTEST: f64 = 1.999;
        let skew = if skew.is_nan() {
            0.0
        } else {
            skew.clamp(-FLATTEST, FLATTEST)
        };
        // 4 - s^2 is at least 0.0039; its absolute error of 4.5e-16 is a relative 1.2e-13.
        Norm { skew, stretch: 2.0 / (4.0 - skew * skew).sqrt() * INFLATE }
    }

    /// The skew for which errors grow least where the damping slope is m: the norm of the eigenvectors.
    pub fn fitting(m: f64) -> Self {
        Norm::new(if m.abs() > 2.0 { 4.0 / m } else { m })
    }

    /// Upper bound of the factor by which a vector is larger in another norm.
    ///
    /// The ratio of the squares on the unit circle is `(2 + s' y)/(2 + s y)` with `y = sin 2 phi`, monotone in
    /// y. Its terms are at least 0.001, and their absolute error of 2.3e-16 is a relative 2.3e-13.
    pub fn into(self, other: Norm) -> f64 {
        if self.skew == other.skew {
            return 1.0;
        }
        let ends = [(2.0 + other.skew) / (2.0 + self.skew), (2.0 - other.skew) / (2.0 - self.skew)];
        ends[0].max(ends[1]).sqrt() * INFLATE
    }

    /// Largest rate of growth for damping slopes from `low` to `high`, up to rounding.
    pub(super) fn rate(self, low: f64, high: f64) -> f64 {
        0.5 * (self.excess(low, high) - self.skew)
    }

    /// What these slopes add to twice that rate.
    fn excess(self, low: f64, high: f64) -> f64 {
        // A negative excess times 1 - k, which is not positive, and a positive one times 1 + k.
        let (k, s) = (self.stretch, self.skew);
        ((s - low).max(0.0) * (1.0 + k)).max((high - s).max(0.0) * (k - 1.0))
    }
}

/// A field prepared for stepping: middles, radii and largest magnitudes of its coefficients.
#[derive(Clone, Copy, Debug)]
pub struct StepField {
    /// The middles of a, b, c, used to compute the coefficients.
    pub middles: [f64; 3],
    /// Radii of a, b, c.
    spread: [f64; 3],
    /// Upper bounds of the magnitudes of a, b, c.
    most: [f64; 3],
    /// All values of a, b, c.
    pub field: FieldBox,
}

/// The result of a step.
#[derive(Clone, Copy, Debug)]
pub struct StepEnd {
    /// Position of the polynomial at the end of the step, rounded.
    pub x: f64,
    /// Velocity of the polynomial there.
    pub v: f64,
    /// Norm of the distance between `(x, v)` and the motion.
    pub radius: f64,
    /// Integral of `v^2` of the polynomial over the step.
    pub square: f64,
    /// Largest difference from the integral along the motion.
    pub square_error: f64,
}

/// The numbers of lemma 2: the roundings in `k + 1` times a coefficient of degree `k + 1`, for terms in v, in
/// x, in a, in b and in c, those of b and c with a part for each degree.
///
/// - 2: `x_(k+1)` is `v_k` times a rounded inverse.
/// - 4: x passes a sum and a difference, then the inverse and its product.
/// - 6: a passes two sums in `damping`, its product, a difference, and two for the inverse.
/// - 11 + k/4: `b v_i` passes 3 on the way into f, `k/4 + 2` in the sum of products, two sums into `earlier`, a
///   sum, a difference and two for the inverse. Half of a quarter of the degree goes to each of the two factors.
/// - 13 + (i + k)/4: so does `c v^2`, which passes `i/4 + 5` on the way into f. Of the degrees of three factors two
///   add up to i, and all to k: five twelfths of each, three times.
const ROUNDINGS: [f64; 7] = [2.0, 4.0, 6.0, 11.0, 0.5, 13.0, 1.25];

/// Roundings of Horner's rule in even and odd powers: two for each term, and this many for each degree.
const HORNER: [f64; 2] = [2.0, 1.5];

/// Roundings of a coefficient of `v^2` of degree 27 at most: `k/4 + 2` in the sum of products, and two sums
/// (lemma 3).
const SQUARE: f64 = 11.0;

/// Upper bound on the roundings of each term of the integral of `v^2`, apart from those of its coefficients and
/// after division by `k + 1`: 10 for the first term, which passes 9 sums and the time. Other terms, which pass
/// `k + 12`, have fewer (end of lemma 4).
const INTEGRAL: f64 = 12.0;

/// The bound of all roundings of the defect over a step, in units of roundoff.
fn roundings(numbers: &[f64; 7], [a, b, c]: [f64; 3], [x, v, _, degree]: [f64; 4]) -> f64 {
    let [of_v, of_x, of_a, b0, b1, c0, c1] = *numbers;
    of_v * v
        + of_x * x
        + of_a * a * v
        + b * v * (b0 * v + b1 * degree)
        + c * v * v * (c0 * v + c1 * degree)
}

/// Sums of magnitudes over a step, from which all bounds are built.
struct Sums {
    x: f64,
    v: f64,
    /// Weighted by the degree.
    x_degree: f64,
    v_degree: f64,
    /// Sum for v, weighted by the degree times the previous degree.
    bend: f64,
    /// Sums for v, from the first degree on, and from [`THIRD`] on.
    after_first: f64,
    after_third: f64,
    /// Sum for `v^2`, and its products with the tails of v that have degrees of at least [`ORDER`]; likewise
    /// for v.
    squares: f64,
    high_squares: f64,
    high_cubes: f64,
    last_x: f64,
    last_v: f64,
    integral: f64,
}

/// Of three degrees that sum to [`ORDER`] or more, at least one is larger than this.
const THIRD: usize = ORDER / 3;

/// The degrees, and each of them times the previous one.
const DEGREES: [[f64; LENGTH]; 2] = {
    let (mut table, mut k) = ([[0.0; LENGTH]; 2], 0);
    while k < LENGTH {
        (table[0][k], table[1][k]) = (real(k), real(k) * (real(k) - 1.0));
        k += 1;
    }
    table
};

/// The sum of products.
fn dot(one: &[f64], other: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (one, other) = (one.as_chunks::<LANES>().0, other.as_chunks::<LANES>().0);
    for (index, one) in one.iter().enumerate() {
        for (lane, sum) in lanes.iter_mut().enumerate() {
            *sum += one[lane] * other[index][lane];
        }
    }
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
}

/// The powers of a number; the one of degree k is rounded at most k times.
fn powers(h: f64) -> [f64; LENGTH] {
    let (square, mut table) = (h * h, [1.0; LENGTH]);
    (table[1], table[2], table[3]) = (h, square, square * h);
    let fourth = square * square;
    for k in LANES..LENGTH {
        table[k] = table[k - LANES] * fourth;
    }
    table
}

impl Sums {
    fn of(series: &MotionSeries, h: f64) -> Self {
        let powers = powers(h);
        let terms: [f64; LENGTH] = std::array::from_fn(|k| series.v[k].abs() * powers[k]);
        let squares: [f64; LENGTH] = std::array::from_fn(|k| series.square[k] * powers[k]);
        let sizes = squares.map(f64::abs);
        // Element i holds the sum of the terms from degree `ORDER - i` on.
        let mut tails = [0.0; LENGTH];
        let mut tail = 0.0;
        for (place, term) in tails.iter_mut().zip(terms[..=ORDER].iter().rev()) {
            tail += term;
            *place = tail;
        }
        let v = tail;
        // `x_(k+1)` is `v_k/(k + 1)` except for two roundings.
        let x_degree = h * v * INFLATE;
        Sums {
            x: series.x[0].abs() + x_degree,
            v,
            x_degree,
            v_degree: dot(&terms, &DEGREES[0]),
            bend: dot(&terms, &DEGREES[1]),
            after_first: tails[ORDER - 1],
            after_third: tails[ORDER - THIRD],
            squares: sizes.iter().sum(),
            high_squares: dot(&terms, &tails),
            high_cubes: dot(&sizes, &tails),
            last_x: h * terms[ORDER - 1] * INVERSE[ORDER] * INFLATE,
            last_v: terms[ORDER],
            // Divided by `k + 1`.
            integral: dot(&squares, &INVERSE[1..]),
        }
    }

    /// Lemma 3: terms of the defect of degree [`ORDER`] and more, times h to their degree.
    fn truncation(&self, [a, b, c]: [f64; 3]) -> f64 {
        let Sums { v, last_x, last_v, high_squares, .. } = *self;
        let cube_tail =
            self.high_cubes + 3.0 * SQUARE * UNIT * v * v * self.after_third + high_squares * v;
        last_v + (last_x + a * last_v) + b * high_squares + c * cube_tail
    }

    /// The roundings of the integral of `v^2`, divided by h. A coefficient passes at most `k + 1`, by which it
    /// is divided.
    fn area_roundings(&self) -> f64 {
        UNIT * (self.v * self.v + INTEGRAL * self.squares)
    }
}

impl StepField {
    /// Prepares a field.
    pub fn new(field: &FieldBox) -> Self {
        let FieldBox { a, b, c } = *field;
        let spread = [a, b, c].map(Interval::radius);
        let most = [a, b, c].map(Interval::magnitude);
        StepField { middles: [a, b, c].map(Interval::middle), spread, most, field: *field }
    }

    /// The norm in which errors grow least over the next step, between these two velocities, and for a while
    /// beyond, including the cost of changing the norm.
    ///
    /// Any norm is valid; this one keeps balls small.
    pub fn norm(&self, before: Norm, [now, next]: [f64; 2], h: f64) -> Norm {
        /// Time for which the present conditions are assumed to last, if the step is shorter.
        const WHILE: f64 = 0.6;
        /// A change with a smaller gain, in the logarithm of the radius, is not made.
        const WORTH: f64 = 0.25;
        let [a, b, c] = self.middles;
        let slope = |v: f64| a + v * (2.0 * b + v * 3.0 * c);
        let (start, end) = (slope(now), slope(next));
        let (low, high) = (start.min(end), start.max(end));
        let time = h.max(WHILE);
        // In no norm do errors grow more slowly than the eigenvalues.
        let least = 0.5 * ((low * low - 4.0).max(0.0).sqrt() - low);
        if (before.rate(low, high) - least) * time < WORTH {
            return before;
        }
        let cost = |norm: Norm| ln(before.into(norm)) + norm.rate(low, high) * time;
        let candidates = [
            before,
            Norm::fitting(a),
            Norm::new(0.0),
            Norm::fitting(0.5 * (low + high)),
            Norm::fitting(low),
        ];
        let best = candidates
            .into_iter()
            .fold(before, |one, other| if cost(other) < cost(one) { other } else { one });
        if cost(best) < cost(before) - WORTH {
            best
        } else {
            before
        }
    }

    /// Carries a ball around the start of a series over a step of length h to its `end` by [`MotionSeries::at`];
    /// `None` where nothing can be stated, because the ball grows too much or the motion might cross `v = 0`
    /// and return unseen.
    pub fn carry(
        &self,
        norm: Norm,
        series: &MotionSeries,
        (h, end): (f64, (f64, f64)),
        radius: f64,
    ) -> Option<StepEnd> {
        let sums = Sums::of(series, h);
        let [a, b, c] = self.most;
        let Sums { x, v, x_degree, v_degree, .. } = sums;
        let (square_tail, truncation) = (sums.high_squares, sums.truncation(self.most));
        let magnitudes = [x, v, x_degree, v_degree];
        let rounding = UNIT * roundings(&ROUNDINGS, self.most, magnitudes);
        let [spread_a, spread_b, spread_c] = self.spread;
        let spread = v * (spread_a + v * (spread_b + v * spread_c));
        let underflow = UNDERFLOW * (1.0 + a + b + c);
        let defect = (truncation + rounding + spread + underflow) * INFLATE;
        // Lemma 4. A first guess of the tube, verified below.
        let pushed = (radius + h * defect) * INFLATE;
        let tube = 3.0 * pushed;
        let off = norm.stretch * tube * INFLATE;
        let speeds = velocities(&sums, series.v[0], end.1, off);
        let growth = self.growth(norm, speeds);
        let factor = exponential(growth * h * if growth > 0.0 { INFLATE } else { 1.0 / INFLATE })?;
        // The maximum over all parts of the step bounds the growth of a force that acts for a moment.
        let inside = factor.max(1.0);
        let carried = (inside * pushed) * INFLATE;
        // Lemma 5: v stays positive, or less than half a turn is made, so it cannot have become negative and
        // positive again.
        let speed = (v + norm.stretch * tube) * INFLATE;
        let turning = h * (1.0 + 0.5 * (a + speed * (b + speed * c))) * INFLATE;
        if !(carried < tube && (speeds > 0.0 || turning < std::f64::consts::PI)) {
            return None;
        }
        let [once, each] = HORNER;
        let evaluation = UNIT * (once * (x + v) + each * (x_degree + v_degree)) + UNDERFLOW;
        let at_end = factor * radius + inside * (h * defect);
        let off = norm.stretch * carried;
        // v^2 along the motion minus v^2 of the polynomial, the tail, and the roundings of coefficients and sum.
        let square_error =
            h * (off * (2.0 * v + off) + square_tail + sums.area_roundings() + UNDERFLOW);
        Some(StepEnd {
            x: end.0,
            v: end.1,
            radius: (at_end + evaluation) * INFLATE,
            square: sums.integral * h,
            square_error: square_error * INFLATE,
        })
    }

    /// Largest rate at which the norm of an error grows while both velocities are in `v`.
    ///
    /// The error obeys `e_x' = e_v`, `e_v' = -e_x - m e_v` with `m = a + b (v + w) + c (v^2 + v w + w^2)` for
    /// the velocities v and w of motion and polynomial. The rate is at most
    /// `(-s + max((s - m)(1 + k), (s - m)(1 - k)))/2` with `k = 2/sqrt(4 - s^2)`.
    fn growth(&self, norm: Norm, v: Interval) -> f64 {
        /// Relative upper bound on the roundings of the sums below.
        const ROUNDED: f64 = 1e-15;
        let [a, b, c] = self.middles;
        let speed = v.magnitude();
        let linear = [v.lower(), v.upper()].map(|v| 2.0 * b * v);
        // v^2 + v w + w^2 for v and w in one interval: between 0 (or 3/4 of the larger square) and 3 times that
        // square.
        let least = if v.contains(0.0) {
            0.0
        } else {
            v.lower().abs().min(v.upper().abs())
        };
        let cubic = [least, speed].map(|v| 3.0 * c * (v * v));
        let slope = |[a, b, c]: [f64; 3]| a + speed * (2.0 * b + 3.0 * c * speed);
        let blur = slope(self.spread) + ROUNDED * slope(self.most);
        let low = a + linear[0].min(linear[1]) + cubic[0].min(cubic[1]) - blur;
        let high = a + linear[0].max(linear[1]) + cubic[0].max(cubic[1]) + blur;
        // NaN has no minimum or maximum.
        if !(low <= high && blur < f64::INFINITY) {
            return f64::INFINITY;
        }
        let excess = norm.excess(low, high);
        0.5 * (excess - norm.skew) + ROUNDED * (excess + norm.skew.abs())
    }
}

/// All velocities of the polynomial over a step from `v0` to `v1`, and all within `off` of them.
///
/// They differ from `v0` by at most the sum of the other terms, and from the chord of `v0` and `v1` by at most
/// `h^2/8` times the largest second derivative. `v1` itself is rounded.
fn velocities(sums: &Sums, v0: f64, v1: f64, off: f64) -> Interval {
    let away = Interval::around(v0, (sums.after_first + off) * INFLATE);
    let rounded = UNIT * (HORNER[0] * sums.v + HORNER[1] * sums.v_degree);
    let bend = (sums.bend / 8.0 + rounded + off) * INFLATE;
    let chord = Interval::new(v0.min(v1), v0.max(v1)).widened(bend);
    away.intersection(chord).unwrap_or(away)
}

/// Upper bound of `exp(z)`; `None` for z above 0.9 or NaN.
fn exponential(z: f64) -> Option<f64> {
    const LARGEST: f64 = 0.9;
    if !(z <= LARGEST) {
        return None;
    }
    // Below zero the sum up to z^4/24 is an upper bound because the series alternates. Above zero the remainder
    // is at most z^5 (1/120 + 0.9/720 + ..) < 0.01 z^5.
    let z = z.max(-LARGEST);
    let rest = if z > 0.0 { 0.01 * z } else { 0.0 };
    let sum = 1.0 + z * (1.0 + z * (0.5 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + rest))));
    Some(sum * INFLATE)
}

#[cfg(test)]
mod tests;
