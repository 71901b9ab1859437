//! What is scanned.

use crate::flow::Problem;
use crate::model::{Group, Knob, MachineProblem};

/// What is scanned: a motion of the oscillator of the paper, or of a machine by its whole model.
#[derive(Clone, Debug, PartialEq)]
pub enum ScanSource {
    /// A dimensionless motion.
    Oscillator(Problem),
    /// A motion in SI units.
    Machine(Box<MachineProblem>),
}

impl From<Problem> for ScanSource {
    fn from(problem: Problem) -> Self {
        ScanSource::Oscillator(problem)
    }
}

impl ScanSource {
    /// What can be scanned over.
    pub fn groups(&self) -> &'static [Group] {
        match self {
            ScanSource::Oscillator(_) => &[Group::Motion],
            ScanSource::Machine(_) => MachineProblem::GROUPS,
        }
    }

    /// Gives a number a value. Fails with one line if there is no such number.
    pub(super) fn set(&mut self, knob: Knob, value: f64) -> Result<(), String> {
        match self {
            ScanSource::Oscillator(Problem { parameters, initial, .. }) => {
                knob.set(parameters, initial, value);
                Ok(())
            }
            ScanSource::Machine(problem) => problem.set(knob, value),
        }
    }
}
