//! Radau IIA collocation with 3, 5 and 7 stages: orders 5, 9 and 13, L-stable.
//!
//! Butcher and Ehle; Hairer and Wanner, *Solving Ordinary Differential Equations II*, 2nd edition
//! (1996), section IV.8, and *Stiff differential equations solved by Radau methods*, Journal of
//! Computational and Applied Mathematics 111 (1999). The coefficients were computed from the collocation
//! conditions with 60 digits.

use crate::numerics::count::real;
/// A collocation scheme.
#[derive(Debug)]
pub struct Collocation {
    /// Positions of the stages as fractions of the step; the last one is at its end.
    pub nodes: &'static [f64],
    /// Integrals of the Lagrange polynomials from 0 to each node; the last row gives the quadrature weights.
    pub integrals: &'static [&'static [f64]],
    /// Difference from the embedded solution of order S, without the term with the weight below.
    pub error: &'static [f64],
    /// Weight of the slope at the start in that difference: the real eigenvalue of `integrals`.
    pub start: f64,
    /// Length of a step, in damping times, at which the order is half reduced in the sense of
    /// [`Collocation::reduced_order`].
    pub stiff: f64,
}

impl Collocation {
    /// The error of the solution as a fraction of that of the embedded solution, given the order reduction.
    ///
    /// Derived from `v' = -k (v - t^(S+1)) + (S + 1) t^S`, where the solution of order `2 S - 1` would be exact
    /// without damping (the problem of Prothero and Robinson; Hairer and Wanner, section IV.15). With k h
    /// damping times in a step this fraction grows as `(k h)^(S-1)` towards S. The formula is accurate to a fifth.
    pub fn reduced_order(&self, damping_times: f64) -> f64 {
        let growth = damping_times / (damping_times + self.stiff);
        let stages = real(self.nodes.len());
        self.nodes[1..].iter().fold(stages, |part, _| part * growth)
    }
}

/// Three stages, order 5.
#[rustfmt::skip]
pub static THREE: Collocation = Collocation {
    nodes: &[
        0.155_051_025_721_682_2, 0.644_948_974_278_317_8, 1.0,
    ],
    integrals: &[
        &[
            0.196_815_477_223_660_4, -0.065_535_425_850_198_39, 0.023_770_974_348_220_15,
        ],
        &[
            0.394_424_314_739_087_3, 0.292_073_411_665_228_5, -0.041_548_752_125_997_93,
        ],
        &[
            0.376_403_062_700_467_25, 0.512_485_826_188_421_6, 0.111_111_111_111_111_1,
        ],
    ],
    error: &[
        -0.428_298_294_115_368_13, 0.245_039_074_384_916_54, -0.091_629_609_865_225_8,
    ],
    start: 0.274_888_829_595_677_34,
    stiff: 8.2,
};

/// Five stages, order 9.
#[rustfmt::skip]
pub static FIVE: Collocation = Collocation {
    nodes: &[
        0.057_104_196_114_517_68, 0.276_843_013_638_123_8, 0.583_590_432_368_916_8,
        0.860_240_135_656_219_5, 1.0,
    ],
    integrals: &[
        &[
            0.072_998_864_317_903_33, -0.026_735_331_107_945_57, 0.018_676_929_763_984_353,
            -0.012_879_106_093_306_44, 0.005_042_839_233_882_015,
        ],
        &[
            0.153_775_231_479_182_46, 0.146_214_867_847_493_52, -0.036_444_568_905_128_09,
            0.021_233_063_119_304_72, -0.007_935_579_902_728_777,
        ],
        &[
            0.140_063_045_684_809_87, 0.298_967_129_491_283_46, 0.167_585_070_135_248_95,
            -0.033_969_101_686_617_74, 0.010_944_288_744_192_253,
        ],
        &[
            0.144_894_308_109_534_77, 0.276_500_068_760_159_2, 0.325_797_922_910_421_03,
            0.128_756_753_254_909_76, -0.015_708_917_378_805_327,
        ],
        &[
            0.143_713_560_791_225_94, 0.281_356_015_149_462_07, 0.311_826_522_975_741_26,
            0.223_103_901_083_570_75, 0.04,
        ],
    ],
    error: &[
        -0.252_343_312_249_546_4, 0.160_357_122_102_969_96, -0.116_273_134_340_962_81,
        0.081_006_648_945_564_02, -0.031_813_168_885_493_83,
    ],
    start: 0.159_065_844_427_469_13,
    stiff: 11.0,
};

/// Seven stages, order 13.
#[rustfmt::skip]
pub static SEVEN: Collocation = Collocation {
    nodes: &[
        0.029_316_427_159_784_893, 0.148_078_599_668_484_3, 0.336_984_690_281_154_3,
        0.558_671_518_771_550_1, 0.769_233_862_030_054_5, 0.926_945_671_319_741_1, 1.0,
    ],
    integrals: &[
        &[
            0.037_546_264_993_921_33, -0.014_039_334_556_460_4, 0.010_352_789_600_742_3,
            -0.008_158_322_540_275_011, 0.006_388_413_879_534_685, -0.004_602_326_779_148_656,
            0.001_828_942_561_470_643_7,
        ],
        &[
            0.080_147_596_515_618_97, 0.081_062_063_985_891_54, -0.021_237_992_120_711_036,
            0.014_000_291_238_817_119, -0.010_234_185_730_090_163, 0.007_153_465_151_364_590_5,
            -0.002_812_639_372_406_723_5,
        ],
        &[
            0.072_063_846_941_881_9, 0.171_068_354_983_886_62, 0.109_614_564_040_072_11,
            -0.024_619_871_728_984_055, 0.014_760_377_043_950_817, -0.009_575_259_396_791_401,
            0.003_672_678_397_138_305_7,
        ],
        &[
            0.075_705_125_819_824_41, 0.154_090_155_142_171_14, 0.227_107_736_673_202_4,
            0.117_478_187_037_024_78, -0.023_810_827_153_044_174, 0.012_709_985_533_661_206,
            -0.004_608_844_281_289_633,
        ],
        &[
            0.073_912_342_163_191_84, 0.161_355_607_615_942_42, 0.206_867_241_552_104_2,
            0.237_007_115_342_694_22, 0.103_086_793_533_813_45, -0.018_854_139_152_580_447,
            0.005_858_900_974_888_791_4,
        ],
        &[
            0.074_705_562_059_796_23, 0.158_307_223_872_468_7, 0.214_153_423_267_200_02,
            0.219_877_847_031_860_03, 0.198_752_121_680_635_27, 0.069_265_501_605_509_14,
            -0.008_116_008_197_728_29,
        ],
        &[
            0.074_494_235_556_010_31, 0.159_102_115_733_650_74, 0.212_351_889_502_977_81,
            0.223_554_914_507_283_24, 0.190_474_936_822_115_58, 0.119_613_744_612_656_2,
            0.020_408_163_265_306_12,
        ],
    ],
    error: &[
        -0.178_370_151_518_243_15, 0.115_986_700_964_274_19, -0.088_825_844_937_001_52,
        0.070_783_203_314_562_42, -0.055_680_879_947_603_93, 0.040_195_716_152_553_35,
        -0.015_985_209_328_576_44,
    ],
    start: 0.111_896_465_300_035_08,
    stiff: 14.1,
};

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::numerics::elementary::powi;

    fn collocates(scheme: &Collocation) {
        let nodes = scheme.nodes;
        let stages = nodes.len();
        let error = scheme.start + scheme.error.iter().sum::<f64>();
        assert!(error.abs() < 1e-15, "{stages} stages: {error:e}");
        for (node, row) in nodes.iter().zip(scheme.integrals) {
            for degree in 0..i32::try_from(stages).unwrap() {
                let sum: f64 =
                    nodes.iter().zip(*row).map(|(node, a)| a * powi(*node, degree)).sum();
                let integral = powi(*node, degree + 1) / f64::from(degree + 1);
                assert!((sum - integral).abs() < 1e-15, "{stages} stages, degree {degree}");
            }
        }
    }

    fn order(scheme: &Collocation) -> i32 {
        let integral = |degree: i32| -> f64 {
            let row = scheme.integrals[scheme.nodes.len() - 1];
            scheme.nodes.iter().zip(row).map(|(node, weight)| weight * powi(*node, degree)).sum()
        };
        let wrong = |degree: &i32| (integral(*degree) * f64::from(degree + 1) - 1.0).abs() > 1e-12;
        (0..20).find(wrong).unwrap()
    }

    /// Errors of the solution and of the embedded one over a step of length 1, from their definitions.
    fn errors(scheme: &Collocation, damping: f64) -> (f64, f64) {
        let stages = scheme.nodes.len();
        let degree = i32::try_from(stages).unwrap() + 1;
        let integrals = DMatrix::from_fn(stages, stages, |i, k| scheme.integrals[i][k]);
        let drive = DVector::from_fn(stages, |i, _| {
            let node = scheme.nodes[i];
            damping * powi(node, degree) + f64::from(degree) * powi(node, degree - 1)
        });
        let system = DMatrix::identity(stages, stages) + damping * &integrals;
        let slopes = system.lu().solve(&drive).unwrap();
        let end = (&integrals * &slopes)[stages - 1];
        let difference: f64 = scheme.error.iter().zip(&slopes).map(|(e, slope)| e * slope).sum();
        ((end - 1.0).abs(), (difference / (1.0 + scheme.start * damping)).abs())
    }

    #[test]
    fn stiff_damping_reduces_the_order() {
        for scheme in [&THREE, &FIVE, &SEVEN] {
            for damping in [10.0, 30.0, 100.0, 300.0, 1e3, 1e4] {
                let (solution, embedded) = errors(scheme, damping);
                let part = scheme.reduced_order(damping) * embedded / solution;
                assert!((part - 1.0).abs() < 0.2, "{scheme:?}, {damping}: {part}");
            }
        }
    }

    #[test]
    fn stages_collocate_and_ends_superconverge() {
        collocates(&THREE);
        collocates(&FIVE);
        collocates(&SEVEN);
        assert_eq!((order(&THREE), order(&FIVE), order(&SEVEN)), (5, 9, 13));
    }
}
