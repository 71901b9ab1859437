//! What is known about a fold of limit cycles.

use serde::Serialize;

use super::extended::FoldCycle;
use crate::portrait::Cycle;

/// The fold at given D2, D3 and r.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FoldPoint {
    /// `D_F`: above it every motion is captured.
    #[serde(rename = "D")]
    pub d: f64,
    /// Right turning point of the cycle that is born there.
    pub q_max: f64,
    pub period: f64,
    /// Whether the stable cycle grazes the sticking set there, instead of meeting an unstable one.
    ///
    /// Below `D = -1` motions leave the end of the set along one curve. An unstable cycle exists only between
    /// the damping at which that curve leads to the other end of the set and the fold, and these two approach
    /// each other quickly: for `D2 = 0`, `r = 1` they are 0.027 apart at `D3 = 1`, 3e-7 at 2, 1e-14 at 10.
    #[serde(skip)]
    pub grazes: bool,
}

impl From<&FoldCycle> for FoldPoint {
    fn from(fold: &FoldCycle) -> Self {
        let Cycle { q_max, period, .. } = fold.closing.describe(&fold.parameters, fold.side);
        FoldPoint { d: fold.parameters.d, q_max, period, grazes: false }
    }
}
