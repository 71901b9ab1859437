//! The cycles found by harmonic balance with N harmonics, beside the true ones.

use super::kind::{Question, numbers};
use super::resources::Resources;
use crate::accuracy::harmonic_error::{HarmonicBalance, harmonic_balance};
use crate::flow::Reason;
use crate::model::Parameters;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    pub parameters: Parameters,
    /// Number N of harmonics.
    pub harmonics: usize,
}

impl Question for Inputs {
    type Found = HarmonicBalance;

    fn answer(&self, means: &Resources) -> Result<HarmonicBalance, Reason> {
        let Inputs { parameters, harmonics } = self;
        harmonic_balance(parameters, *harmonics, means.fineness.harmonic, means.limits)
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [0.0; 4])
    }
}
