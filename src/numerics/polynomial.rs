//! Polynomials and power series, lowest power first.

use super::count::real;
use super::scalar::Scalar;

/// The coefficients of the derivative, with a zero at the end.
pub fn derivative<const N: usize>(coefficients: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|k| match coefficients.get(k + 1) {
        Some(next) => real(k + 1) * next,
        None => 0.0,
    })
}

/// The value, by Horner's rule.
#[inline]
pub fn value(coefficients: &[f64], t: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * t + coefficient)
}

/// The value and the derivative, by Horner's rule.
#[inline]
pub fn value_and_slope(coefficients: &[f64], t: f64) -> (f64, f64) {
    coefficients.iter().rev().fold((0.0, 0.0), |(value, slope), coefficient| {
        (value * t + coefficient, slope * t + value)
    })
}

/// A function and its first three derivatives at one point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Derivatives {
    pub value: f64,
    /// First derivative.
    pub first: f64,
    /// Second derivative.
    pub second: f64,
    /// Third derivative.
    pub third: f64,
}

impl Derivatives {
    /// The cubic Taylor polynomial with these derivatives, at distance `step` from its centre.
    pub fn cubic(&self, step: f64) -> f64 {
        self.value + step * (self.first + step * (self.second / 2.0 + step * self.third / 6.0))
    }

    /// Whether all four are finite.
    pub fn is_finite(&self) -> bool {
        [self.value, self.first, self.second, self.third].iter().all(|number| number.is_finite())
    }
}

/// The value by Horner's rule, and three derivatives by differentiating that rule.
pub fn derivatives(coefficients: &[f64], t: f64) -> Derivatives {
    let mut sum = Derivatives::default();
    for coefficient in coefficients.iter().rev() {
        sum.third = sum.third * t + 3.0 * sum.second;
        sum.second = sum.second * t + 2.0 * sum.first;
        sum.first = sum.first * t + sum.value;
        sum.value = sum.value * t + coefficient;
    }
    sum
}

/// The value by Horner's rule in even and odd powers: two independent chains of half the length.
#[inline]
pub fn value_in_two<N: Scalar>(coefficients: &[N], t: N) -> N {
    let square = t * t;
    let (mut even, mut odd) = (N::default(), N::default());
    let pairs = coefficients.chunks_exact(2);
    if let [last] = pairs.remainder() {
        even = *last;
    }
    for pair in pairs.rev() {
        even = even * square + pair[0];
        odd = odd * square + pair[1];
    }
    even + t * odd
}

/// The value and the derivative by Horner's rule in even and odd powers.
#[inline]
pub fn value_and_slope_in_two<N: Scalar>(coefficients: &[N], t: N) -> (N, N) {
    let square = t * t;
    let (mut value, mut slope) = ([N::default(); 2], [N::default(); 2]);
    let rows = coefficients.chunks_exact(2);
    if let [last] = rows.remainder() {
        value[0] = *last;
    }
    for row in rows.rev() {
        for part in 0..2 {
            slope[part] = slope[part] * square + value[part];
            value[part] = value[part] * square + row[part];
        }
    }
    // With p(t) = e(t^2) + t o(t^2): p' = o + 2 t (e' + t o').
    let twice = N::of(2.0) * t;
    (value[0] + t * value[1], value[1] + twice * (slope[0] + t * slope[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::count::reciprocals;
    use crate::numerics::elementary::exp;

    #[test]
    fn all_rules_agree_on_the_series_of_the_exponential() {
        let mut series = [1.0; 20];
        let inverse = reciprocals::<20>();
        for k in 1..20 {
            series[k] = series[k - 1] * inverse[k];
        }
        for terms in [20, 19] {
            let series = &series[..terms];
            for t in [0.0, 0.3, -0.7, 1.0] {
                let expected = exp(t);
                let slopes = [value_and_slope(series, t), value_and_slope_in_two(series, t)];
                let values = [value(series, t), value_in_two(series, t)];
                for found in slopes.into_iter().flat_map(|(a, b)| [a, b]).chain(values) {
                    assert!((found - expected).abs() < 2e-15, "{terms} terms at {t}: {found}");
                }
            }
        }
        let slopes = derivative(&series);
        assert!((value(&slopes, 0.5) - exp(0.5)).abs() < 2e-15 && slopes[19] == 0.0);
    }
}
