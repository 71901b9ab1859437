//! The cycles along a parameter.

use super::kind::{Question, numbers};
use super::resources::Resources;
use crate::branch::Branch;
use crate::branch::along::{Points, branch};
use crate::flow::Reason;
use crate::flow::quality::DRAFT;
use crate::model::{Knob, Parameters};

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The parameters; the one that varies is set to 0, so that stepping it leaves the request unchanged.
    pub parameters: Parameters,
    /// The parameter that varies.
    pub parameter: Knob,
    /// Ends of the range of that parameter.
    pub range: (f64, f64),
    /// Requested relative error.
    pub tolerance: f64,
}

impl Question for Inputs {
    type Found = Branch;

    fn answer(&self, means: &Resources) -> Result<Branch, Reason> {
        let Inputs { parameters, parameter, range, tolerance } = self;
        let rough = *tolerance >= DRAFT.tolerance;
        let points = if rough { Points::Followed } else { Points::Even(means.fineness.branch) };
        branch(parameters, *parameter, *range, points, *tolerance, means.limits)
    }

    fn draft(&self) -> Option<Self> {
        let finer = self.tolerance < DRAFT.tolerance;
        finer.then(|| Inputs { tolerance: DRAFT.tolerance, ..self.clone() })
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [self.range.0, self.range.1, 0.0, 0.0])
    }

    fn compares(&self, wanted: &Self) -> bool {
        self.parameter == wanted.parameter
    }
}
