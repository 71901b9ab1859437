//! The cycles found by harmonic balance with N harmonics, beside the true ones.

use super::kind::{Question, numbers};
use super::means::Means;
use crate::flow::Reason;
use crate::oscillator::Parameters;
use crate::study::harmonic_error::{HarmonicBalance, harmonic_balance};

#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    pub parameters: Parameters,
    /// Number N of harmonics.
    pub harmonics: usize,
}

impl Question for Asked {
    type Found = HarmonicBalance;

    fn answer(&self, means: &Means) -> Result<HarmonicBalance, Reason> {
        let Asked { parameters, harmonics } = self;
        harmonic_balance(parameters, *harmonics, means.fineness.harmonic, means.limits)
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [0.0; 4])
    }
}
