//! One certified step: a Taylor polynomial in plain doubles, and a bound of how far the motion is from it.
//!
//! The coefficients are computed in ordinary rounded arithmetic and then taken as they are: they define
//! an exact polynomial `(p, w)(t)` for `(x, v)`. It misses the equation by a defect
//!
//! `p' - w` and `w' + p + a w + b w^2 + c w^3`,
//!
//! which is bounded from sums of magnitudes (rounding, lemma 2; truncation, lemma 3), and the distance
//! `e` between motion and polynomial obeys a linear equation with this defect as its force. In the norm
//! `abs(e)^2 = e_x^2 + s e_x e_v + e_v^2`, `abs(s) < 2`, it grows no faster than a logarithmic norm allows
//! (lemma 4). With s near 2 D the norm follows the linear spiral exactly, so that the ball keeps its
//! relative size through many turns of growth or decay.
//!
//! `docs/proofs.md` has the lemmas and the count of every rounding.

use std::ops::{Add, Mul, Neg, Sub};

use super::field::Field;
use crate::numerics::Interval;

/// Degree of the polynomials.
pub const ORDER: usize = 28;

/// Length of the arrays: `ORDER + 1` coefficients, filled with zeros to a multiple of [`LANES`].
const LENGTH: usize = 32;

/// Sums run in this many lanes; the count of roundings does not depend on the order of a sum.
const LANES: usize = 4;

/// The unit roundoff of doubles, `2^-53`.
pub const UNIT: f64 = f64::EPSILON / 2.0;

/// Inflates a bound that is a sum of non-negative terms.
///
/// Covers the roundings of that sum itself and all products of two or more roundings in the counts below:
/// with fewer than 1,000 operations and counts below 200, both are parts below `2e-13` of it.
pub const INFLATE: f64 = 1.0 + 1e-12;

/// Added to every defect, times `1 + a + b + c`: what underflows loses less than `2^-1074` at a time, and in
/// the units of a step, in which the start is near 1, fewer than `1e6` of these meet no factor above `1e20`.
const UNDERFLOW: f64 = 1e-290;

/// `1 / k`, rounded to the nearest double.
const INVERSE: [f64; LENGTH + 1] = {
    let mut table = [0.0; LENGTH + 1];
    let mut k = 1;
    while k <= LENGTH {
        #[expect(clippy::cast_precision_loss, reason = "k is at most 32")]
        {
            table[k] = 1.0 / k as f64;
        }
        k += 1;
    }
    table
};

/// A field prepared for stepping: middles and radii of its coefficients, and the skew of the norm.
#[derive(Clone, Copy, Debug)]
pub struct Prepared {
    a: f64,
    b: f64,
    c: f64,
    /// Radii of a, b, c.
    spread: [f64; 3],
    /// Upper bounds of the magnitudes of a, b, c.
    most: [f64; 3],
    /// All values of a, b, c.
    field: Field,
}

/// The norm `sqrt(e_x^2 + s e_x e_v + e_v^2)` in which errors are measured.
///
/// It is at most `abs(e_x) + abs(e_v)`, because `abs(s) < 2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Norm {
    /// `s`.
    skew: f64,
    /// Upper bound of `2/sqrt(4 - s^2)`: no component is larger than this many times the norm.
    pub stretch: f64,
}

impl Norm {
    /// The norm with a skew, brought within the range in which it is of use.
    #[must_use]
    pub fn new(skew: f64) -> Self {
        /// Beyond this it is too flat.
        const FLATTEST: f64 = 1.999;
        let skew = if skew.is_nan() { 0.0 } else { skew.clamp(-FLATTEST, FLATTEST) };
        // 4 - s^2 is at least 0.0039; its absolute error of 4.5e-16 is a part 1.2e-13 of it.
        Norm { skew, stretch: 2.0 / (4.0 - skew * skew).sqrt() * INFLATE }
    }

    /// The skew in which errors grow least where the damping slope is m: the norm of the eigenvectors.
    #[must_use]
    pub fn fitting(m: f64) -> Self {
        Norm::new(if m.abs() > 2.0 { 4.0 / m } else { m })
    }

    /// At most how many times larger a vector is in another norm.
    ///
    /// The ratio of the squares on the unit circle is `(2 + s' y)/(2 + s y)` with `y = sin 2 phi`, monotone in y. Its
    /// terms are at least 0.001, and their absolute error of 2.3e-16 is a part 2.3e-13 of them.
    #[must_use]
    pub fn into(self, other: Norm) -> f64 {
        if self.skew == other.skew {
            return 1.0;
        }
        let ends = [(2.0 + other.skew) / (2.0 + self.skew), (2.0 - other.skew) / (2.0 - self.skew)];
        ends[0].max(ends[1]).sqrt() * INFLATE
    }

    /// Largest rate of growth for damping slopes from `low` to `high`, up to rounding.
    fn rate(self, low: f64, high: f64) -> f64 {
        let (k, s) = (self.stretch, self.skew);
        0.5 * (((s - low) * (1.0 + k)).max((high - s) * (k - 1.0)).max(0.0) - s)
    }
}

impl Prepared {
    /// Prepares a field.
    #[must_use]
    pub fn new(field: &Field) -> Self {
        let Field { a, b, c } = *field;
        let spread = [a, b, c].map(Interval::radius);
        let most = [a, b, c].map(Interval::magnitude);
        let [a, b, c] = [a, b, c].map(Interval::middle);
        Prepared { a, b, c, spread, most, field: *field }
    }

    /// The middles of a, b, c, with which coefficients are computed.
    #[must_use]
    pub fn middles(&self) -> [f64; 3] {
        [self.a, self.b, self.c]
    }

    /// The field.
    #[must_use]
    pub fn field(&self) -> &Field {
        &self.field
    }

    /// The norm in which errors grow least over the next step, between these two velocities, and a while beyond, the
    /// change of norm included.
    ///
    /// Any answer is right; this one keeps balls small.
    #[must_use]
    pub fn norm(&self, before: Norm, [now, next]: [f64; 2], h: f64) -> Norm {
        /// How far the present step is taken to go on, in time.
        const WHILE: f64 = 0.6;
        /// A change that gains less than this, in the logarithm of the ball, is left alone.
        const WORTH: f64 = 0.25;
        let slope = |v: f64| self.a + v * (2.0 * self.b + v * 3.0 * self.c);
        let (start, end) = (slope(now), slope(next));
        let (low, high) = (start.min(end), start.max(end));
        let time = h.max(WHILE);
        // No norm grows less than the eigenvalues do.
        let least = 0.5 * ((low * low - 4.0).max(0.0).sqrt() - low);
        if (before.rate(low, high) - least) * time < WORTH {
            return before;
        }
        let cost = |norm: Norm| before.into(norm).ln() + norm.rate(low, high) * time;
        let candidates = [
            before,
            Norm::fitting(self.a),
            Norm::new(0.0),
            Norm::fitting(0.5 * (low + high)),
            Norm::fitting(low),
        ];
        let best = candidates
            .into_iter()
            .fold(before, |one, other| if cost(other) < cost(one) { other } else { one });
        if cost(best) < cost(before) - WORTH { best } else { before }
    }
}

/// The Taylor polynomials at a point.
#[derive(Clone, Debug)]
pub struct Series<T = f64> {
    /// Coefficients of x.
    pub x: [T; LENGTH],
    /// Coefficients of v.
    pub v: [T; LENGTH],
    /// Coefficients of `v^2`, below degree [`ORDER`].
    square: [T; LENGTH],
}

/// What coefficients are computed in: doubles, and in the tests numbers that count their roundings.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// `1 / k`, rounded.
    fn inverse(k: usize) -> Self;
    /// A finished coefficient, from now on taken as it is.
    #[must_use]
    fn taken(self) -> Self;
}

impl Scalar for f64 {
    const ZERO: f64 = 0.0;

    fn inverse(k: usize) -> f64 {
        INVERSE[k]
    }

    fn taken(self) -> f64 {
        self
    }
}

/// Sum of `one[i] other[k - i]` for `2 <= i <= k - 2`, in lanes; `other` holds its factor in reverse, from
/// place `ORDER` down.
///
/// `other` holds nothing for degrees 0 and 1, so that the last lanes add zeros.
///
/// Of these `k - 3` products each passes at most `k/4 + 2` roundings: one as a product, the others on the way down its
/// lane, two where the lanes meet. Adding zeros is exact. Nothing is read that was written in the last two
/// rounds, because waiting for memory would take longer than the sum.
fn inner<T: Scalar>(one: &[T; LENGTH], other: &[T; 2 * LENGTH], k: usize) -> T {
    let mut lanes = [T::ZERO; LANES];
    if k < 4 {
        return T::ZERO;
    }
    let length = (k - 3).div_ceil(LANES) * LANES;
    let first = &one[2..2 + length];
    let second = &other[ORDER - k + 2..ORDER - k + 2 + length];
    for (first, second) in first.chunks_exact(LANES).zip(second.chunks_exact(LANES)) {
        for (lane, sum) in lanes.iter_mut().enumerate() {
            *sum = *sum + first[lane] * second[lane];
        }
    }
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
}

impl<T: Scalar> Series<T> {
    /// An empty series to be filled.
    pub const EMPTY: Series<T> =
        Series { x: [T::ZERO; LENGTH], v: [T::ZERO; LENGTH], square: [T::ZERO; LENGTH] };

    /// Fills the coefficients at `(x, v)` of the field `a, b, c`.
    ///
    /// With `f = b v + c v^2` the damping is `a v + f v`. The newest coefficient enters `v^2`, f and the damping
    /// linearly: with `rest` for what the others contribute to `v^2`,
    /// `f_k = slope v_k + c rest_k`, and the damping is `damping v_k` plus what only earlier ones contribute.
    pub fn expand(&mut self, [a, b, c]: [T; 3], x: T, v: T) {
        let mut force = [T::ZERO; LENGTH];
        let mut backward = [T::ZERO; 2 * LENGTH];
        self.v = [T::ZERO; LENGTH];
        (self.x[0], self.v[0]) = (x, v);
        let force0 = v * (b + c * v);
        let slope = b + (c + c) * v;
        let damping = (a + force0) + v * slope;
        let cubic = c * v;
        self.square[0] = v * v;
        self.x[1] = v.taken();
        self.v[1] = (-x - (a + force0) * v).taken();
        let (v1, twice) = (self.v[1], self.v[1] + self.v[1]);
        let (mut before, mut newest, mut force_before) = (v, v1, force0);
        let mut force1 = T::ZERO;
        for k in 1..ORDER {
            // Both sums leave out the two outermost products on either side.
            let (among, product) = (inner(&self.v, &backward, k), inner(&force, &backward, k));
            let rest = match k {
                1 => T::ZERO,
                2 => v1 * v1,
                _ => twice * before + among,
            };
            let pair = match k {
                1 => T::ZERO,
                2 => force1 * v1,
                _ => force1 * before + force_before * v1,
            };
            let earlier = cubic * rest + (pair + product);
            let acceleration = -(self.x[k] + earlier) - damping * newest;
            self.square[k] = (v + v) * newest + rest;
            let force_now = slope * newest + c * rest;
            if k == 1 {
                force1 = force_now;
            }
            force[k] = force_now;
            if k > 1 {
                backward[ORDER - k] = newest;
            }
            self.x[k + 1] = (newest * T::inverse(k + 1)).taken();
            self.v[k + 1] = (acceleration * T::inverse(k + 1)).taken();
            (before, newest, force_before) = (newest, self.v[k + 1], force_now);
        }
    }

    /// Position and velocity of the polynomial at a time, by Horner's rule: a coefficient of degree k passes
    /// `2 k + 1` roundings.
    #[must_use]
    pub fn at(&self, time: T) -> (T, T) {
        let mut at = (self.x[ORDER], self.v[ORDER]);
        for k in (0..ORDER).rev() {
            at = (at.0 * time + self.x[k], at.1 * time + self.v[k]);
        }
        at
    }
}

impl Series {
    /// A step over which the last two terms are about `tolerance` of the state.
    #[must_use]
    pub fn step(&self, tolerance: f64) -> f64 {
        /// Nothing is gained beyond: a half turn takes 3.14.
        const LONGEST: f64 = 1.6;
        let size = tolerance * self.x[0].abs().max(self.v[0].abs());
        let root = |k: usize| {
            let last = self.x[k].abs().max(self.v[k].abs());
            (size / last).powf(INVERSE[k])
        };
        let step = root(ORDER).min(root(ORDER - 1));
        if step < LONGEST { step } else { LONGEST }
    }

    /// Velocity and acceleration of the polynomial at a time, without bounds.
    #[must_use]
    pub fn velocity(&self, time: f64) -> (f64, f64) {
        let (mut value, mut slope) = (self.v[ORDER], 0.0);
        for k in (0..ORDER).rev() {
            slope = slope * time + value;
            value = value * time + self.v[k];
        }
        (value, slope)
    }
}

/// What a step ends with.
#[derive(Clone, Copy, Debug)]
pub struct Reached {
    /// The polynomial at the end of the step, rounded.
    pub x: f64,
    /// Its velocity.
    pub v: f64,
    /// Norm of the distance between `(x, v)` and the motion.
    pub radius: f64,
    /// Integral of `v^2` over the step, of the polynomial.
    pub square: f64,
    /// How far that is from the integral along the motion.
    pub square_error: f64,
}

/// The numbers of lemma 2, counted on the way to `k + 1` times a coefficient of degree `k + 1`: in terms of v
/// and of x, of a, of b and of c, those of b and c with a part for each degree.
///
/// - 2: `x_(k+1)` is `v_k` times a rounded inverse.
/// - 4: x passes a sum and a difference, then the inverse and its product.
/// - 6: a passes two sums in `damping`, its product, a difference, and two for the inverse.
/// - 11 + k/4: `b v_i` passes 3 on the way into f, `k/4 + 2` in the sum of products, two sums into `earlier`, a sum, a
///   difference and two for the inverse. Half of a quarter of the degree goes to each of the two factors.
/// - 13 + (i + k)/4: so does `c v^2`, which passes `i/4 + 5` on the way into f. Of the degrees of three factors two
///   add up to i, and all to k: five twelfths of each, three times.
const ROUNDINGS: [f64; 7] = [2.0, 4.0, 6.0, 11.0, 0.5, 13.0, 1.25];

/// The bound of all roundings of the defect over a step, in units of roundoff.
fn roundings(numbers: &[f64; 7], [a, b, c]: [f64; 3], [x, v, _, degree]: [f64; 4]) -> f64 {
    let [of_v, of_x, of_a, b0, b1, c0, c1] = *numbers;
    of_v * v
        + of_x * x
        + of_a * a * v
        + b * v * (b0 * v + b1 * degree)
        + c * v * v * (c0 * v + c1 * degree)
}

/// Sums of magnitudes over a step: everything the bounds are made of.
struct Sums {
    x: f64,
    v: f64,
    /// Weighted by the degree.
    x_degree: f64,
    v_degree: f64,
    /// Of v, weighted by the degree times the degree before.
    bend: f64,
    /// From each degree on, of v.
    tails: [f64; ORDER + 2],
    /// Of the terms of v, and of `v^2`.
    terms: [f64; ORDER + 1],
    squares: [f64; ORDER],
    last_x: f64,
    integral: f64,
}

impl Sums {
    fn of(series: &Series, h: f64) -> Self {
        let mut sums = Sums {
            x: 0.0,
            v: 0.0,
            x_degree: 0.0,
            v_degree: 0.0,
            bend: 0.0,
            tails: [0.0; ORDER + 2],
            terms: [0.0; ORDER + 1],
            squares: [0.0; ORDER],
            last_x: 0.0,
            integral: 0.0,
        };
        let (mut power, mut degree) = (1.0, 0.0);
        for k in 0..=ORDER {
            let v = series.v[k].abs() * power;
            sums.terms[k] = v;
            sums.v_degree += degree * v;
            sums.bend += degree * (degree - 1.0) * v;
            if k < ORDER {
                let square = series.square[k] * power;
                sums.squares[k] = square.abs();
                sums.integral += square * INVERSE[k + 1];
            }
            power *= h;
            degree += 1.0;
        }
        for k in (0..=ORDER).rev() {
            sums.tails[k] = sums.tails[k + 1] + sums.terms[k];
        }
        sums.v = sums.tails[0];
        // `x_(k+1)` is `v_k/(k + 1)` but for two roundings.
        sums.x_degree = h * sums.v * INFLATE;
        sums.x = series.x[0].abs() + sums.x_degree;
        sums.last_x = h * sums.terms[ORDER - 1] * INVERSE[ORDER] * INFLATE;
        sums
    }
}

impl Prepared {
    /// Carries a ball around the start of a series over a step; `None` where nothing can be said, because
    /// the ball grows too much or the motion might turn around `v = 0` unseen.
    #[must_use]
    pub fn carry(&self, norm: Norm, series: &Series, h: f64, radius: f64) -> Option<Reached> {
        let sums = Sums::of(series, h);
        let [a, b, c] = self.most;
        let Sums { x, v, x_degree, v_degree, ref tails, ref terms, .. } = sums;
        let n = ORDER;
        // Lemma 3: terms of degree ORDER and more of w^2 and w^3, times h to their degree.
        let square_tail: f64 = (0..=n).map(|i| terms[i] * tails[n - i]).sum();
        let low_squares: f64 = (0..n).map(|i| sums.squares[i] * tails[n - i]).sum();
        let cube_tail = low_squares + 90.0 * UNIT * v * v * tails[n / 3] + square_tail * v;
        let truncation = terms[n] + (sums.last_x + a * terms[n]) + b * square_tail + c * cube_tail;
        let magnitudes = [x, v, x_degree, v_degree];
        let rounding = UNIT * roundings(&ROUNDINGS, self.most, magnitudes);
        let [spread_a, spread_b, spread_c] = self.spread;
        let spread = v * (spread_a + v * (spread_b + v * spread_c));
        let underflow = UNDERFLOW * (1.0 + a + b + c);
        let defect = (truncation + rounding + spread + underflow) * INFLATE;
        // Lemma 4. A first guess of the tube, checked below.
        let pushed = (radius + h * defect) * INFLATE;
        let tube = 3.0 * pushed;
        let off = norm.stretch * tube * INFLATE;
        let end = series.at(h);
        let growth = self.growth(norm, velocities(&sums, series.v[0], end.1, off));
        let factor = exponential(growth * h * if growth > 0.0 { INFLATE } else { 1.0 / INFLATE })?;
        let carried = (factor.max_inside * pushed) * INFLATE;
        // Lemma 5: less than half a turn, so that v cannot have left and come back.
        let speed = (v + norm.stretch * tube) * INFLATE;
        let turning = h * (1.0 + 0.5 * (a + speed * (b + speed * c))) * INFLATE;
        if !(carried < tube && turning < std::f64::consts::PI) {
            return None;
        }
        let evaluation = UNIT * (x + 2.0 * x_degree + v + 2.0 * v_degree) + UNDERFLOW;
        let at_end = factor.at_end * radius + factor.max_inside * (h * defect);
        let off = norm.stretch * carried;
        // v^2 along the motion against the polynomial, its tail, and the roundings of its coefficients and sum.
        let square_error = h
            * (off * (2.0 * v + off)
                + square_tail
                + UNIT * (v * v + 36.0 * sums.squares.iter().sum::<f64>())
                + UNDERFLOW);
        Some(Reached {
            x: end.0,
            v: end.1,
            radius: (at_end + evaluation) * INFLATE,
            square: sums.integral * h,
            square_error: square_error * INFLATE,
        })
    }

    /// Largest rate at which the norm of an error grows while both velocities are in `v`.
    ///
    /// The error obeys `e_x' = e_v`, `e_v' = -e_x - m e_v` with `m = a + b (v + w) + c (v^2 + v w + w^2)` for the
    /// velocities v and w of motion and polynomial, and the rate is at most
    /// `(-s + max((s - m)(1 + k), (s - m)(1 - k)))/2` with `k = 2/sqrt(4 - s^2)`.
    fn growth(&self, norm: Norm, v: Interval) -> f64 {
        let Field { a, b, c } = self.field;
        // v^2 + v w + w^2 for v and w in one interval: between 0 (3/4 of the larger square) and 3 of it.
        let square = v.square();
        let least = if v.contains(0.0) { 0.0 } else { 3.0 * square.lower() * (1.0 - 1e-15) };
        let cubic = Interval::new(least, 3.0 * square.upper() * (1.0 + 1e-15));
        let m = a + b * v.twice() + c * cubic;
        let (s, k) = (Interval::point(norm.skew), norm.stretch);
        let excess = s - m;
        // A negative excess times 1 - k, which is not positive, and a positive one times 1 + k.
        let part =
            (excess.upper().max(0.0) * (1.0 + k)).max((-excess.lower()).max(0.0) * (k - 1.0));
        0.5 * (Interval::point(part * (1.0 + 1e-15)) - s).upper()
    }
}

/// All velocities of the polynomial over a step from `v0` to `v1`, and what is within `off` of them.
///
/// They are within the sum of the terms of `v0`, and within `h^2/8` times the largest second derivative of the
/// interval from `v0` to `v1`: a function is that close to its chord. `v1` itself is rounded.
fn velocities(sums: &Sums, v0: f64, v1: f64, off: f64) -> Interval {
    let away = Interval::around(v0, (sums.tails[1] + off) * INFLATE);
    let bend = (sums.bend / 8.0 + UNIT * (sums.v + 2.0 * sums.v_degree) + off) * INFLATE;
    let chord = Interval::new(v0.min(v1), v0.max(v1)) + Interval::new(-bend, bend);
    away.intersection(chord).unwrap_or(away)
}

/// Bounds of `exp(rate h)` over a step.
struct Growth {
    /// At its end.
    at_end: f64,
    /// The largest over all parts of it: what the force of a moment grows to at most.
    max_inside: f64,
}

/// Upper bounds of `exp(z)`; `None` for z above 0.9 or not a number.
fn exponential(z: f64) -> Option<Growth> {
    const LARGEST: f64 = 0.9;
    if !(z <= LARGEST) {
        return None;
    }
    // Below zero the sum up to z^4/24 is an upper bound because the series alternates; above, the rest is
    // at most z^5 (1/120 + 0.9/720 + ..) < 0.01 z^5.
    let z = z.max(-LARGEST);
    let rest = if z > 0.0 { 0.01 * z } else { 0.0 };
    let sum = 1.0 + z * (1.0 + z * (0.5 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + rest))));
    let at_end = sum * INFLATE;
    Some(Growth { at_end, max_inside: at_end.max(1.0) })
}

#[cfg(test)]
mod tests;
