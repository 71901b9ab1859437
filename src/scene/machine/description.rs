//! The description of a machine, as its file gives it.

use serde::{Deserialize, Serialize};

use crate::model::belt::{BeltError, ReducedBelt};
use crate::model::{Belt, Tolerances};

/// A machine: a mass on a belt, and the start of the motion on show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// The name by which it is opened.
    pub name: String,
    pub title: String,
    /// What it is, and what to look at, in a sentence or two.
    #[serde(rename = "look")]
    pub watch: String,
    pub belt: Belt,
    /// How exactly its numbers are known, and what disturbs it.
    #[serde(default, skip_serializing_if = "Tolerances::is_none")]
    pub tolerances: Tolerances,
    /// Displacement from the static one at which the motion starts, in m.
    pub displacement: f64,
    /// Velocity at which it starts, in m/s.
    pub velocity: f64,
    /// How long the motion is followed, in s.
    pub until: f64,
}

impl Machine {
    /// The dimensionless oscillator and its units. Fails with [`BeltError`] where the machine has no dimensionless
    /// form.
    pub fn reduce(&self) -> Result<ReducedBelt, BeltError> {
        self.belt.reduce()
    }
}
