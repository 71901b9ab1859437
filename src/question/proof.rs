//! The proof of the number of cycles. Nothing waits for it; the screen shows it once it is there.

use super::kind::{Question, numbers};
use super::resources::Resources;
use crate::flow::Reason;
use crate::model::Parameters;
use crate::proof::{ParameterBox, Proof, prove};

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    pub parameters: Parameters,
}

impl Question for Inputs {
    type Found = Proof;

    fn answer(&self, _means: &Resources) -> Result<Proof, Reason> {
        Ok(prove(&ParameterBox::from(&self.parameters), &[]))
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [0.0; 4])
    }

    /// A proof at other parameters proves nothing at these.
    fn compares(&self, _wanted: &Self) -> bool {
        false
    }
}
