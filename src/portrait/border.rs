//! What borders the basin of rest.

use serde::{Serialize, Serializer};

use crate::flow::Reason;
use crate::model::Parameters;

/// What borders the basin of rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Border {
    /// Nothing: everything comes to rest.
    None,
    /// An unstable limit cycle.
    Cycle,
    /// A motion that separates rest from escape.
    Separatrix,
    /// An orbit that touches the belt's line, with a piece of that line.
    Grazing,
    /// The motion that just reaches the end of what the guide holds.
    Capture,
    /// Nothing, because rest itself repels.
    NoBasin,
    /// Not known: what could be followed comes to rest.
    Unknown(Reason),
}

impl Serialize for Border {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(self.name())
    }
}

impl Border {
    /// One word, the same for all that a guide or a belt holds, and one where no border was met.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Border::None | Border::Unknown(_) => "none",
            Border::Cycle => "cycle",
            Border::Separatrix => "separatrix",
            Border::Grazing | Border::Capture => "grazing",
            Border::NoBasin => "no-basin",
        }
    }

    /// Whether an orbit that is no cycle borders the basin.
    #[must_use]
    pub fn parts_without_cycle(self) -> bool {
        matches!(self, Border::Separatrix | Border::Grazing | Border::Capture)
    }

    /// What borders the basin: the innermost cycle, else a separatrix where motions can escape.
    pub fn around(parameters: &Parameters, stable: &[bool]) -> Self {
        let self_excited_node = parameters.d <= -1.0 && parameters.r > 0.0;
        // Without friction a rest that repels has no basin, and nothing borders it.
        let repels = parameters.r == 0.0 && parameters.d < 0.0;
        let escapes = parameters.d3 == 0.0 && parameters.d2 != 0.0 && !repels;
        // Positive cubic damping bounds every motion: where no cycle is left for it, it comes to rest.
        let bounded = parameters.d3 > 0.0;
        match stable.first() {
            Some(false) => Border::Cycle,
            Some(true) if !self_excited_node => Border::None,
            None if bounded || !(escapes || self_excited_node) => Border::None,
            _ => Border::Separatrix,
        }
    }
}
