//! How errors are measured: the size of roundings, and the norm for distances between a motion and its polynomial.

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
        let skew = if skew.is_nan() { 0.0 } else { skew.clamp(-FLATTEST, FLATTEST) };
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
        let (k, s) = (self.stretch, self.skew);
        0.5 * (((s - low) * (1.0 + k)).max((high - s) * (k - 1.0)).max(0.0) - s)
    }
}
