//! Quantiles of distributions: the normal one, that of chi-squared, and Student's.

use crate::numerics::elementary::{cos, ln, pow, powi, sin};

/// The value that a chi-squared variable exceeds with the same probability as a normal one exceeds `z` (Wilson and
/// Hilferty).
pub fn chi_squared(freedom: f64, z: f64) -> f64 {
    let part = 2.0 / (9.0 * freedom);
    freedom * powi(1.0 - part + z * part.sqrt(), 3)
}

/// The deviation within which a variable with Student's distribution lies with a probability of 95 %: for few degrees
/// of freedom `n` by the integral of `cos^(n-1)` over the angle whose tangent is the deviation over `sqrt(n)`, else by
/// the expansion about the normal distribution in `1/n` (error below 1e-5).
pub fn deviation_of_95_percent(freedom: f64) -> f64 {
    const FEW: f64 = 12.0;
    const PANELS: u32 = 4000;
    let n = freedom.max(1.0);
    if n < FEW {
        let width = std::f64::consts::FRAC_PI_2 / f64::from(PANELS);
        let angle = |panel: u32| width * (f64::from(panel) + 0.5);
        let density: Vec<f64> = (0..PANELS).map(|panel| pow(cos(angle(panel)), n - 1.0)).collect();
        let mut left = 0.95 * density.iter().sum::<f64>();
        let mut reached = 0.0;
        for part in density {
            reached += width * (left / part).min(1.0);
            left -= part;
            if left <= 0.0 {
                break;
            }
        }
        return n.sqrt() * sin(reached) / cos(reached);
    }
    let z: f64 = 1.959_963_984_540_054;
    let (z3, z5, z7) = (powi(z, 3), powi(z, 5), powi(z, 7));
    z + (z3 + z) / (4.0 * n)
        + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n)
        + (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * n * n * n)
}

/// The quantile of the standard normal distribution, to 4.5e-4 (Abramowitz and Stegun, 26.2.23).
pub fn normal_at(probability: f64) -> f64 {
    let tail = probability.min(1.0 - probability).max(f64::MIN_POSITIVE);
    let t = (-2.0 * ln(tail)).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let value = t - above / below;
    if probability < 0.5 { -value } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn students_quantiles_are_those_of_tables() {
        for (freedom, value) in [
            (1.0, 12.706),
            (2.0, 4.303),
            (3.0, 3.182),
            (5.0, 2.571),
            (10.0, 2.228),
            (11.9, 2.181),
            (12.0, 2.179),
            (30.0, 2.042),
            (1e9, 1.960),
        ] {
            let found = deviation_of_95_percent(freedom);
            assert!((found / value - 1.0).abs() < 1e-3, "{freedom}: {found}");
        }
    }
}
