//! The table of measures, the computations that they need, and the cells that they fill.

use std::sync::LazyLock;

use serde::Deserialize;

use crate::model::basin::UNKNOWN;
use crate::model::{Knob, Model};
use crate::numerics::{cells, named, real};
use crate::portrait::{Kick, RandomKick, StartWindow};

/// One row of [`MEASURES`].
#[derive(Clone, Debug)]
pub struct MeasureSpec {
    /// Which measure.
    pub measure: Measure,
    /// Its name on the command line and on the screen.
    pub name: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// The columns that it fills.
    pub columns: Vec<&'static str>,
}

/// Cycles that have columns of their own; no parameters with more are known, and `cycles` counts all.
pub(crate) const CYCLES: usize = 2;

/// Measures of the oscillator of the paper alone: of its damping D, and of its proofs. All others are measured of machines,
/// too.
pub const OF_THE_PAPER: [Measure; 3] = [Measure::Fold, Measure::Escape, Measure::Proved];

/// A property of the oscillator, or of one motion of it, at given parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// How the motion ends.
    Outcome,
    /// Where and when the motion comes to rest.
    Rest,
    /// Amplitudes of the limit cycles.
    Cycles,
    /// Periods and Floquet multipliers of the limit cycles.
    Multipliers,
    /// The kicks that the sticking set survives.
    Margin,
    /// The kicks that are survived wherever the mass rests.
    FromRest,
    /// The fraction of a window that is captured.
    Stability,
    /// The area of the basin.
    Area,
    /// The fold of limit cycles in D.
    Fold,
    /// The escape point in D.
    Escape,
    /// The kicks that are survived for certain.
    Guaranteed,
    /// The fraction of random kicks that is lost.
    Lost,
    /// How round the basin is.
    Integrity,
    /// How long the starts of a window take to come to rest.
    Settling,
    /// The fraction of a window that is at rest in time.
    FiniteTime,
    /// How many kicks in a row are survived.
    Repeated,
    /// Whether the number of cycles is proved, and bounds of their amplitudes.
    Proved,
    /// What borders the basin.
    Border,
    /// The friction that a margin needs.
    Design,
}

/// The measures as the lines of `assets/measures.txt` describe them, in the same order.
pub static MEASURES: LazyLock<Vec<MeasureSpec>> = LazyLock::new(|| {
    let described = include_str!("../../../assets/measures.txt").lines().filter_map(cells);
    described.filter_map(MeasureSpec::read).collect()
});

impl MeasureSpec {
    /// A line of the table; `None` if there is no measure of its name.
    fn read([name, columns, meaning]: [&'static str; 3]) -> Option<Self> {
        let (measure, columns) = (named(name)?, columns.split(' ').collect());
        Some(MeasureSpec { measure, name, meaning, columns })
    }

    /// Its cells where nothing was measured: of a margin it is not known how to read it.
    pub fn unfilled(&self) -> impl Iterator<Item = Value> {
        let unknown = |name: &&str| is_regime(name).then_some(Value::Word(UNKNOWN));
        self.columns.iter().map(move |name| unknown(name).unwrap_or(Value::Nothing))
    }
}

/// Whether a column says how to read a margin.
pub fn is_regime(column: &str) -> bool {
    column.ends_with("regime")
}

/// Whether a column of a scan holds words, also where none of its rows has one; all others hold numbers.
pub fn holds_words(column: &str) -> bool {
    is_regime(column) || ["border", "outcome", "proved", "reason"].contains(&column)
}

impl Measure {
    /// The row of [`MEASURES`] that describes this measure.
    pub fn spec(self) -> &'static MeasureSpec {
        &MEASURES[self as usize]
    }

    /// The measure with which it is computed; itself where that is for its own sake.
    pub fn with(self) -> Self {
        match self {
            Measure::Rest => Measure::Outcome,
            Measure::Multipliers => Measure::Cycles,
            Measure::FiniteTime => Measure::Settling,
            Measure::FromRest
            | Measure::Stability
            | Measure::Area
            | Measure::Lost
            | Measure::Integrity
            | Measure::Border => Measure::Margin,
            measure => measure,
        }
    }

    /// Whether it is measured over a window of starts.
    pub fn is_over_window(self) -> bool {
        matches!(self, Measure::Stability | Measure::Settling | Measure::FiniteTime)
    }

    /// Whether it is measured of random kicks.
    pub fn is_of_kicks(self) -> bool {
        matches!(self, Measure::Lost | Measure::Repeated)
    }

    /// Whether its computation depends on a number.
    pub fn depends_on(self, knob: Knob) -> bool {
        let with = self.with();
        match knob {
            Knob::Q0 | Knob::V0 | Knob::X | Knob::V => with == Measure::Outcome,
            Knob::Duration => matches!(with, Measure::Outcome | Measure::Settling),
            Knob::DisturbingForce => matches!(with, Measure::Guaranteed | Measure::Design),
            Knob::D => !matches!(with, Measure::Fold | Measure::Escape),
            Knob::R | Knob::Friction => with != Measure::Design,
            _ => true,
        }
    }

    /// The measure with this name.
    ///
    /// # Errors
    /// One line that says which there are.
    pub fn named(name: &str) -> Result<Self, String> {
        MEASURES.iter().find(|row| row.name == name).map(|row| row.measure).ok_or_else(|| {
            let names: Vec<_> = MEASURES.iter().map(|row| row.name).collect();
            format!("there is no measure {name:?}; there are {}", names.join(", "))
        })
    }
}

/// A cell of a row: never a number that does not exist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// There is none here.
    Nothing,
    /// A finite number.
    Number(f64),
    /// How many.
    Count(usize),
    /// A word of a small vocabulary.
    Word(&'static str),
}

impl From<f64> for Value {
    fn from(value: f64) -> Self {
        if value.is_finite() {
            Value::Number(value)
        } else {
            Value::Nothing
        }
    }
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Value::Nothing, Into::into)
    }
}

impl Value {
    /// The value as a number to be plotted; words and nothing have none.
    pub fn number(self) -> Option<f64> {
        match self {
            Value::Number(value) => Some(value),
            Value::Count(count) => Some(real(count)),
            Value::Nothing | Value::Word(_) => None,
        }
    }
}

// What some measures depend on beside the subject.

/// From where the displacements of a window count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Origin {
    /// From the steady position.
    #[default]
    Steady,
    /// From the relaxed spring of a machine.
    Relaxed,
}

/// The window of starts, the kicks, and the margin that is wanted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conditions {
    /// Starts whose part or times are measured.
    pub window: StartWindow,
    /// Kicks of which a fraction is lost.
    pub kicks: RandomKick,
    /// From where the window of a machine counts displacements.
    pub origin: Origin,
    /// The margin for which the friction is sought.
    pub wanted: Option<(Kick, f64)>,
}

impl From<StartWindow> for Conditions {
    fn from(window: StartWindow) -> Self {
        Conditions { window, ..Conditions::default() }
    }
}

impl Conditions {
    /// The window of a machine, from its steady position.
    pub fn about(&self, model: &Model) -> StartWindow {
        let steady = match self.origin {
            Origin::Steady => 0.0,
            Origin::Relaxed => model.pull,
        };
        let StartWindow { q: (from, to), v } = self.window;
        StartWindow { q: (from - steady, to - steady), v }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_measure_stands_at_its_own_row_and_no_two_columns_share_a_name() {
        let mut columns = BTreeSet::new();
        let lines = include_str!("../../../assets/measures.txt").lines();
        assert_eq!(MEASURES.len(), lines.filter(|line| line.contains(" | ")).count());
        for row in MEASURES.iter() {
            assert_eq!(row.measure.spec().name, row.name);
            assert_eq!(Measure::named(row.name), Ok(row.measure));
            for column in &row.columns {
                assert!(columns.insert(column), "{column} twice");
            }
        }
    }

    #[test]
    fn numbers_that_do_not_exist_are_nothing() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(Value::from(value), Value::Nothing);
            assert_eq!(Value::from(Some(value)), Value::Nothing);
        }
        assert_eq!(Value::from(-0.5), Value::Number(-0.5));
    }
}
