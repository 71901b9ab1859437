//! The cubic with given values and slopes at both ends of an interval.

/// A cubic on `0 ..= 1`.
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
