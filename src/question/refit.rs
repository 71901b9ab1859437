//! A fitted record with some numbers held.

use super::fit::{Fit, Unsure};
use super::kind::Question;
use super::resources::Resources;
use crate::flow::Reason;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The fit with all numbers free.
    pub fit: Fit,
    /// Values at which D, D2, D3 and r are held.
    pub held: [Option<f64>; 4],
    /// What is to be survived if the distribution of the margin is drawn as well, which takes longer than a frame.
    pub drawn: Option<Unsure>,
}

impl Question for Inputs {
    type Found = Fit;

    fn answer(&self, means: &Resources) -> Result<Fit, Reason> {
        self.fit.held(self.held, self.drawn, means.limits)
    }

    fn numbers(&self) -> [f64; 8] {
        let [d, d2, d3, r] = self.held.map(Option::unwrap_or_default);
        [d, d2, d3, r, 0.0, 0.0, 0.0, 0.0]
    }

    fn compares(&self, wanted: &Self) -> bool {
        self.fit == wanted.fit
    }
}
