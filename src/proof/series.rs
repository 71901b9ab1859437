//! Taylor polynomials of a motion, with a fixed order of operations for their coefficients.
//!
//! The order matters: lemma 2 counts the rounding errors that each term passes through, so every change here
//! changes the numbers there. A test computes with numbers that count their rounding errors.

use std::ops::{Add, Mul, Neg, Sub};

use crate::numerics::{reciprocals, rough_exp2, rough_log2, value_and_slope_in_two};

/// Degree of the polynomials.
pub const ORDER: usize = 28;

/// Length of the arrays: `ORDER + 1` coefficients, filled with zeros to a multiple of [`LANES`].
pub(super) const LENGTH: usize = 32;

/// Sums run in this many independent lanes; the rounding count does not depend on the order within a sum.
pub(super) const LANES: usize = 4;

/// `1 / k`, rounded to the nearest double.
pub(super) const INVERSE: [f64; LENGTH + 1] = reciprocals();

/// The Taylor polynomials at a point.
#[derive(Clone, Debug)]
pub struct MotionSeries<T = f64> {
    /// Coefficients of x.
    pub x: [T; LENGTH],
    /// Coefficients of v.
    pub v: [T; LENGTH],
    /// Coefficients of `v^2`, below degree [`ORDER`].
    pub(super) square: [T; LENGTH],
}

/// The type of the coefficients: doubles, or in the tests numbers that count their rounding errors.
pub trait SeriesScalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// `1 / k`, rounded.
    fn inverse(k: usize) -> Self;
    /// A finished coefficient, taken as exact from now on.
    fn taken(self) -> Self;
}

impl SeriesScalar for f64 {
    const ZERO: f64 = 0.0;

    fn inverse(k: usize) -> f64 {
        INVERSE[k]
    }

    fn taken(self) -> f64 {
        self
    }
}

/// Sums of `one[i] by[k - i]` for `2 <= i <= k - 2`, in lanes, for two arrays. `by` holds its factor in
/// reverse, from index `ORDER` down. It holds zeros for degrees 0 and 1, so the last lanes add zeros.
///
/// Each of these `k - 3` products passes at most `k/4 + 2` roundings: one as a product, two where the lanes are
/// combined, the others along its lane. Adding zeros is exact. Nothing is read that was written in the last two
/// iterations, because waiting for memory would take longer than the sum.
fn inner<T: SeriesScalar>(both: [&[T; LENGTH]; 2], by: &[T; 2 * LENGTH], k: usize) -> [T; 2] {
    let mut lanes = [[T::ZERO; LANES]; 2];
    if k < 4 {
        return [T::ZERO; 2];
    }
    let length = (k - 3).div_ceil(LANES) * LANES;
    let (one, _) = both[0][2..2 + length].as_chunks::<LANES>();
    let (two, _) = both[1][2..2 + length].as_chunks::<LANES>();
    let (by, _) = by[ORDER - k + 2..ORDER - k + 2 + length].as_chunks::<LANES>();
    for (chunk, by) in by.iter().enumerate() {
        for lane in 0..LANES {
            lanes[0][lane] = lanes[0][lane] + one[chunk][lane] * by[lane];
            lanes[1][lane] = lanes[1][lane] + two[chunk][lane] * by[lane];
        }
    }
    let total = |lanes: [T; LANES]| (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
    [total(lanes[0]), total(lanes[1])]
}

impl<T: SeriesScalar> MotionSeries<T> {
    /// An empty series to be filled.
    pub const EMPTY: MotionSeries<T> =
        MotionSeries { x: [T::ZERO; LENGTH], v: [T::ZERO; LENGTH], square: [T::ZERO; LENGTH] };

    /// Fills the coefficients at `(x, v)` of the field `a, b, c`.
    ///
    /// With `f = b v + c v^2` the damping is `a v + f v`. The newest coefficient enters `v^2`, f and the
    /// damping linearly: with `rest` for the contribution of the others to `v^2`, `f_k = slope v_k + c rest_k`,
    /// and the damping is `damping v_k` plus a contribution of earlier coefficients only.
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
            // Both sums omit the two outermost products on either side.
            let [among, product] = inner([&self.v, &force], &backward, k);
            let (rest, pair) = match k {
                1 => (T::ZERO, T::ZERO),
                2 => (v1 * v1, force1 * v1),
                _ => (twice * before + among, force1 * before + force_before * v1),
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

    /// Position and velocity of the polynomial at a time, by Horner's rule in even and odd powers, two
    /// independent chains. A coefficient of degree k passes at most `2 + 3 k/2` roundings: its own sum, three
    /// for each square of the time, one for an odd power of it, and the last sum.
    pub fn at(&self, time: T) -> (T, T) {
        let square = time * time;
        let value = |terms: &[T; LENGTH]| {
            let (mut even, mut odd) = (terms[ORDER], terms[ORDER - 1]);
            for k in (2..ORDER).step_by(2).rev() {
                even = even * square + terms[k];
                odd = odd * square + terms[k - 1];
            }
            even * square + terms[0] + time * odd
        };
        (value(&self.x), value(&self.v))
    }
}

impl MotionSeries {
    /// A step length for which the last two terms are about `tolerance` of the state.
    pub fn step(&self, tolerance: f64) -> f64 {
        /// Longer steps gain nothing: a half turn takes 3.14.
        const LONGEST: f64 = 1.6;
        let size = tolerance * self.x[0].abs().max(self.v[0].abs());
        let root = |k: usize| {
            let last = self.x[k].abs().max(self.v[k].abs());
            rough_log2(size / last) * INVERSE[k]
        };
        let step = rough_exp2(root(ORDER).min(root(ORDER - 1)));
        if step < LONGEST { step } else { LONGEST }
    }

    /// Velocity and acceleration of the polynomial at a time, without bounds.
    pub fn velocity(&self, time: f64) -> (f64, f64) {
        value_and_slope_in_two(&self.v[..=ORDER], time)
    }
}
