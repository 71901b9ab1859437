//! Reference values, computed to about 14 digits by another program.

use hopfscope::model::Parameters;
use serde::Deserialize;

/// A cycle of `cycles.json`.
#[derive(Deserialize)]
pub struct Reference {
    #[serde(flatten)]
    pub parameters: Parameters,
    pub q_max: f64,
    pub q_min: f64,
    pub v_max: f64,
    pub v_min: f64,
    pub period: f64,
    pub multiplier: f64,
}

/// All reference cycles.
pub fn references() -> Vec<Reference> {
    serde_json::from_str(include_str!("cycles.json")).unwrap()
}
