//! Integrals: the 10-point Gauss rule, and an adaptive Gauss-Kronrod rule with an error estimate.

/// Nodes and weights of the Gauss-Legendre rule with 10 points on `[0, 1]`, exact to degree 19.
pub const GAUSS: [(f64, f64); 10] = [
    (0.013_046_735_741_414_14, 0.033_335_672_154_344_07),
    (0.067_468_316_655_507_75, 0.074_725_674_575_290_3),
    (0.160_295_215_850_487_8, 0.109_543_181_257_991_02),
    (0.283_302_302_935_376_4, 0.134_633_359_654_998_17),
    (0.425_562_830_509_184_4, 0.147_762_112_357_376_44),
    (0.574_437_169_490_815_6, 0.147_762_112_357_376_44),
    (0.716_697_697_064_623_6, 0.134_633_359_654_998_17),
    (0.839_704_784_149_512_2, 0.109_543_181_257_991_02),
    (0.932_531_683_344_492_2, 0.074_725_674_575_290_3),
    (0.986_953_264_258_585_9, 0.033_335_672_154_344_07),
];

/// The integral over `[0, 1]` by the Gauss rule.
pub fn gauss(function: impl Fn(f64) -> f64) -> f64 {
    GAUSS.iter().map(|&(node, weight)| weight * function(node)).sum()
}

/// An integral, with an estimate of its absolute error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integral {
    pub value: f64,
    /// The estimated error.
    pub error: f64,
}

/// Integrates over a range, halving intervals until the Gauss and Kronrod rules agree on each to `tolerance`.
///
/// Assumption: the function is smooth except for kinks. The error is the sum of the differences between the two
/// rules, a large overestimate where the function is smooth.
///
/// Hard-wired: an interval is halved at most 30 times, which locates a kink to 1e-9 of the range.
pub fn integrate(function: &impl Fn(f64) -> f64, range: (f64, f64), tolerance: f64) -> Integral {
    const DEPTH: u32 = 30;
    let mut total = Integral { value: 0.0, error: 0.0 };
    let mut waiting = vec![(range, DEPTH)];
    while let Some(((from, to), depth)) = waiting.pop() {
        let part = gauss_kronrod(function, from, to);
        if part.error <= tolerance || depth == 0 {
            total.value += part.value;
            total.error += part.error;
        } else {
            let middle = 0.5 * (from + to);
            waiting.extend([((from, middle), depth - 1), ((middle, to), depth - 1)]);
        }
    }
    total
}

/// The 15-point Kronrod rule and its difference from the embedded 7-point Gauss rule.
///
/// Nodes and weights: Piessens et al., QUADPACK (1983), rounded to doubles.
fn gauss_kronrod(function: &impl Fn(f64) -> f64, from: f64, to: f64) -> Integral {
    /// Node, Kronrod weight, Gauss weight (0 where the node is not a Gauss node).
    const NODES: [(f64, f64, f64); 8] = [
        (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
        (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
        (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
        (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64),
        (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
        (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
        (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
        (0.0, 0.209_482_141_084_727_83, 0.417_959_183_673_469_4),
    ];
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut kronrod, mut gauss) = (0.0, 0.0);
    for (node, of_kronrod, of_gauss) in NODES {
        let value = if node == 0.0 {
            function(middle)
        } else {
            function(middle - half * node) + function(middle + half * node)
        };
        kronrod += of_kronrod * value;
        gauss += of_gauss * value;
    }
    Integral { value: half * kronrod, error: (half * (kronrod - gauss)).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::{exp, pow, powi};

    #[test]
    fn the_rule_of_gauss_is_exact_to_degree_19() {
        for degree in 0..20 {
            let sum = gauss(|node| powi(node, degree));
            assert!((sum * f64::from(degree + 1) - 1.0).abs() < 1e-14, "{degree}");
        }
    }

    #[test]
    fn kinks_are_integrated_to_the_tolerance_and_the_error_is_no_less_than_the_true_one() {
        let kink = |x: f64| (x - 0.3).abs().sqrt();
        let exact = (pow(0.7, 1.5) + pow(0.3, 1.5)) / 1.5;
        let found = integrate(&kink, (0.0, 1.0), 1e-10);
        assert!((found.value - exact).abs() <= found.error && found.error < 1e-8, "{found:?}");
        let smooth = integrate(&exp, (-1.0, 2.0), 1e-10);
        assert!((smooth.value - (exp(2.0) - exp(-1.0))).abs() < 1e-14, "{smooth:?}");
    }
}
