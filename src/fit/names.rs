//! The numbers that a fit estimates, by their names.

use super::observation::{self, UNKNOWNS};

/// One row of [`NAMES`].
#[derive(Clone, Copy, Debug)]
pub struct NameSpec {
    /// The name on the command line and in documents.
    pub name: &'static str,
    /// Its place among the unknowns.
    pub place: usize,
    /// Power of a length in its unit.
    pub length: i32,
    /// Power of a second in its unit.
    pub time: i32,
}

/// The numbers that are estimated from a record, but for those of its start.
pub const NAMES: [NameSpec; 6] = [
    NameSpec { name: "omega0", place: observation::OMEGA0, length: 0, time: -1 },
    NameSpec { name: "offset", place: observation::OFFSET, length: 1, time: 0 },
    NameSpec { name: "D", place: observation::D, length: 0, time: 0 },
    NameSpec { name: "D2", place: observation::D2, length: -1, time: 0 },
    NameSpec { name: "D3", place: observation::D3, length: -2, time: 0 },
    NameSpec { name: "r", place: observation::R, length: 1, time: 0 },
];

/// The row with this name.
#[must_use]
pub fn named(name: &str) -> Option<&'static NameSpec> {
    NAMES.iter().find(|row| row.name == name)
}

/// What a fit estimates, and what it holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Choice {
    /// Names to estimate; none: all that are not held.
    pub free: Option<Vec<&'static NameSpec>>,
    /// Values to hold.
    pub held: Vec<(&'static NameSpec, f64)>,
}

impl PartialEq for NameSpec {
    fn eq(&self, other: &Self) -> bool {
        self.place == other.place
    }
}

impl Choice {
    /// The value at which a number is held; damping and friction that are neither free nor set are zero, and
    /// `omega0` and the offset are estimated unless they are set: no record comes without them.
    #[must_use]
    pub fn held(&self, row: &NameSpec) -> Option<f64> {
        if let Some((_, value)) = self.held.iter().find(|(held, _)| *held == row) {
            return Some(*value);
        }
        let needed = row.place < observation::D;
        (!needed && !self.is_wanted(row)).then_some(0.0)
    }

    /// Whether an estimate of this number is asked for.
    #[must_use]
    pub fn is_wanted(&self, row: &NameSpec) -> bool {
        let held = self.held.iter().any(|(held, _)| *held == row);
        !held && self.free.as_ref().is_none_or(|free| free.contains(&row))
    }

    /// Which unknowns are free, and the values of the others.
    #[must_use]
    pub fn unknowns(&self) -> [Option<f64>; UNKNOWNS] {
        let mut held = [None; UNKNOWNS];
        for row in &NAMES {
            held[row.place] = self.held(row);
        }
        held
    }
}
