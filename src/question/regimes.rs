//! The fate of kicks over two parameters.

use super::kind::{Question, numbers};
use super::resources::Resources;
use crate::branch::chart::{Chart, Plane, Resolution, chart};
use crate::flow::Reason;
use crate::model::Parameters;

/// Evenly spaced lines of a chart of regimes; boundaries are interpolated between them.
const CHART_LINES: usize = 40;

/// Lines of a draft.
const DRAFT_LINES: usize = 4;

/// Relative error of clearances at the boundaries of a chart.
const BOUNDARY_TOLERANCE: f64 = 1e-13;

/// Relative error of those clearances in a draft.
const DRAFT_BOUNDARY_TOLERANCE: f64 = 1e-3;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The parameters; the two that vary are set to 0, so that stepping them leaves the request unchanged.
    pub parameters: Parameters,
    /// The two varied parameters and their ranges.
    pub plane: Plane,
    /// Whether a draft of few lines is enough.
    pub rough: bool,
}

impl Question for Inputs {
    type Found = Chart;

    fn answer(&self, means: &Resources) -> Result<Chart, Reason> {
        let (lines, chord, tolerance) = if self.rough {
            (DRAFT_LINES, f64::INFINITY, DRAFT_BOUNDARY_TOLERANCE)
        } else {
            (CHART_LINES, means.fineness.chord, BOUNDARY_TOLERANCE)
        };
        let resolution = Resolution { lines, chord, tolerance };
        chart(&self.parameters, self.plane, resolution, means.limits)
    }

    fn draft(&self) -> Option<Self> {
        (!self.rough).then(|| Inputs { rough: true, ..self.clone() })
    }

    fn numbers(&self) -> [f64; 8] {
        let ((left, right), (low, high)) = (self.plane.right_range, self.plane.up_range);
        numbers(&self.parameters, [left, right, low, high])
    }

    fn compares(&self, wanted: &Self) -> bool {
        (self.plane.right, self.plane.up) == (wanted.plane.right, wanted.plane.up)
    }
}
