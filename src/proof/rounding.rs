//! The size of rounding errors, and factors that cover what the counts of them omit.

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
pub(super) const UNDERFLOW: f64 = 1e-290;
