//! The motion on show, with points for drawing and its energy ledger.

use super::kind::{Question, of_motion};
use super::resources::Resources;
use crate::flow::quality::DRAFT;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Method, Problem, Reason, Trajectory};

/// The question is the motion itself.
pub use crate::flow::Problem as Inputs;

impl Question for Problem {
    type Found = Trajectory;

    fn answer(&self, means: &Resources) -> Result<Trajectory, Reason> {
        // Without friction, nothing happens at v = 0, so crossings are not located.
        let crossings = self.parameters.r > 0.0;
        let samples_per_step = means.fineness.samples_per_step;
        let detail = Detail { crossings, samples_per_step, energy: true };
        Ok(trajectory(self, detail, means.limits))
    }

    fn draft(&self) -> Option<Self> {
        let (rough, linear) = (self.at(&DRAFT), self.parameters.is_piecewise_linear());
        let closed =
            matches!(self.method, Method::Exact) || (self.method == Method::Auto && linear);
        let finer = self.setting() < rough.setting();
        (finer && !closed).then_some(rough)
    }

    fn numbers(&self) -> [f64; 8] {
        of_motion(self)
    }
}
