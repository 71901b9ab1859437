//! Polynomials and power series, lowest power first, and the cubic with given values and slopes at both ends of
//! an interval.

use super::{Scalar, real};

/// The coefficients of the derivative.
pub fn derivative(coefficients: &[f64]) -> Vec<f64> {
    coefficients.iter().enumerate().skip(1).map(|(k, c)| real(k) * c).collect()
}

/// The value, by Horner's rule.
#[inline]
pub fn value(coefficients: &[f64], t: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * t + coefficient)
}

/// The integral from 0 to `t`, by Horner's rule.
pub fn integral(coefficients: &[f64], t: f64) -> f64 {
    let terms = coefficients.iter().enumerate().rev();
    t * terms.fold(0.0, |sum, (k, coefficient)| sum * t + coefficient / real(k + 1))
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
        [self.value, self.first, self.second, self.third].iter().all(|it| it.is_finite())
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
    let twice = N::from(2.0) * t;
    (value[0] + t * value[1], value[1] + twice * (slope[0] + t * slope[1]))
}

/// The cubic on `0 ..= 1` with given values and slopes at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hermite {
    pub values: (f64, f64),
    pub slopes: (f64, f64),
}

impl Hermite {
    /// Coefficients of `t`, `t^2`, `t^3`.
    fn coefficients(&self) -> [f64; 3] {
        let rise = self.values.1 - self.values.0;
        let (a, b) = self.slopes;
        [a, 3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise]
    }

    /// The value; exact at both ends.
    pub fn at(&self, t: f64) -> f64 {
        let s = 1.0 - t;
        let ends =
            s * s * (1.0 + 2.0 * t) * self.values.0 + t * t * (1.0 + 2.0 * s) * self.values.1;
        ends + s * t * (s * self.slopes.0 - t * self.slopes.1)
    }

    /// The derivative.
    pub fn slope(&self, t: f64) -> f64 {
        let [a, b, c] = self.coefficients();
        a + t * (2.0 * b + t * 3.0 * c)
    }

    /// Points between 0 and 1 where the slope vanishes, in increasing order.
    pub fn extrema(&self) -> [Option<f64>; 2] {
        let [a, b, c] = self.coefficients();
        let root = (b * b - 3.0 * a * c).sqrt();
        // One root from the quotient without cancellation, the other from the product of the roots.
        let sum = -(b + root.copysign(b));
        let (one, other) = (sum / (3.0 * c), a / sum);
        let inside = |t: f64| (t > 0.0 && t < 1.0).then_some(t);
        [inside(one.min(other)), inside(one.max(other))]
    }
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
        assert!((value(&slopes, 0.5) - exp(0.5)).abs() < 2e-15 && slopes.len() == 19);
    }

    #[test]
    fn it_repeats_a_cubic_and_its_extrema() {
        // (t - 1/4)(t - 1/2)(t - 3/4), symmetric about 1/2.
        let cubic = |t: f64| (t - 0.25) * (t - 0.5) * (t - 0.75);
        let slope = |t: f64| 3.0 * (t - 0.5) * (t - 0.5) - 0.0625;
        let curve = Hermite { values: (cubic(0.0), cubic(1.0)), slopes: (slope(0.0), slope(1.0)) };
        for t in [0.0, 0.1, 0.25, 0.5, 0.9, 1.0] {
            assert!((curve.at(t) - cubic(t)).abs() < 1e-16, "{t}");
            assert!((curve.slope(t) - slope(t)).abs() < 1e-15, "{t}");
        }
        let [low, high] = curve.extrema().map(Option::unwrap);
        let away = 0.0625_f64.sqrt() / 3_f64.sqrt();
        assert!((low - 0.5 + away).abs() < 1e-15 && (high - 0.5 - away).abs() < 1e-15);
    }

    #[test]
    fn lines_and_monotone_cubics_have_no_extrema() {
        for slopes in [(1.0, 1.0), (2.5, 2.5), (0.5, 0.0)] {
            assert_eq!(Hermite { values: (0.0, 1.0), slopes }.extrema(), [None, None]);
        }
        let parabola = Hermite { values: (0.0, 0.0), slopes: (1.0, -1.0) };
        assert_eq!(parabola.extrema().into_iter().flatten().collect::<Vec<_>>(), [0.5]);
    }
}
