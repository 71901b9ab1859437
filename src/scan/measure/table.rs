//! The table of measures, the computations that they need, and the cells that they fill.

use std::collections::BTreeSet;

use crate::flow::Problem;
use crate::model::{Group, Knob, MachineProblem, Model, ParameterBox, Parameters};
use crate::numerics::count::real;
use crate::portrait::basin::StartWindow;
use crate::portrait::design::Kick;
use crate::portrait::kicks::RandomKick;

/// One row of [`MEASURES`].
#[derive(Clone, Copy, Debug)]
pub struct MeasureSpec {
    /// Which measure.
    pub measure: Measure,
    /// Its name on the command line and on the screen.
    pub name: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// The columns that it fills.
    pub columns: &'static [&'static str],
    /// The measure with which it is computed; itself where that is for its own sake.
    pub with: Measure,
}

/// Cycles that have columns of their own; no parameters with more are known, and `cycles` counts all.
pub(crate) const CYCLES: usize = 2;

/// Measures of the oscillator of the paper alone: of its damping D, and of its proofs. All others are measured of machines,
/// too.
pub const OF_THE_PAPER: [Measure; 3] = [Measure::Fold, Measure::Escape, Measure::Proved];

/// Makes [`Measure`] and [`MEASURES`] from one list, in the order in which measures are listed: name, the measure with
/// which it is computed (itself where that is for its own sake), columns, meaning.
macro_rules! measures {
    ($($(#[$doc:meta])* $measure:ident: $name:literal, $with:ident, [$($column:literal),*], $meaning:literal;)*) => {
        /// A property of the oscillator, or of one motion of it, at given parameters.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Measure {
            $($(#[$doc])* $measure,)*
        }

        /// Every measure, in the order in which they are listed.
        pub const MEASURES: [MeasureSpec; [$($name),*].len()] = [$(MeasureSpec {
            measure: Measure::$measure,
            name: $name,
            meaning: $meaning,
            columns: &[$($column),*],
            with: Measure::$with,
        }),*];
    };
}

measures! {
    /// How the motion ends.
    Outcome: "outcome", Outcome, ["outcome", "outcome_tau", "half_swings"],
        "how the motion from (q0, v0) ends, when, after how many half swings";
    /// Where and when the motion comes to rest.
    Rest: "rest", Outcome, ["rest_q", "rest_tau"],
        "where and when the motion from (q0, v0) comes to rest";
    /// Amplitudes of the limit cycles.
    Cycles: "cycles", Cycles,
        ["cycles", "q_min_1", "q_max_1", "v_min_1", "v_max_1", "q_min_2", "q_max_2", "v_min_2",
        "v_max_2"],
        "how many limit cycles there are, and their extremes, smallest cycle first";
    /// Periods and Floquet multipliers of the limit cycles.
    Multipliers: "multipliers", Cycles,
        ["period_1", "multiplier_1", "log_multiplier_1", "period_2", "multiplier_2",
        "log_multiplier_2"],
        "period, Floquet multiplier and its logarithm of each limit cycle";
    /// The kicks that the sticking set survives.
    Margin: "margin", Margin, ["displacement", "impulse"],
        "smallest displacement at rest, and smallest impulse at q = 0, not captured";
    /// The kicks that are survived wherever the mass rests.
    FromRest: "from-rest", Margin, ["from_rest_displacement", "from_rest_impulse"],
        "smallest change of position, and smallest impulse, not captured, from the worst rest position";
    /// The fraction of a window that is captured.
    Stability: "stability", Margin, ["captured_part", "captured_error"],
        "basin stability: the fraction of the window that is captured, and its error";
    /// The area of the basin.
    Area: "area", Margin, ["area"],
        "area of the basin, where it is finite";
    /// The fold of limit cycles in D.
    Fold: "fold", Fold, ["D_F", "D_F_q_max"],
        "the fold D_F (or grazing, below D = -1), above which no cycle is left, and the amplitude there";
    /// The escape point in D.
    Escape: "escape", Escape, ["D_c"],
        "the escape point D_c, where the cycle goes to infinity";
    /// The kicks that are survived for certain.
    Guaranteed: "guaranteed", Guaranteed, ["guaranteed_displacement", "guaranteed_impulse"],
        "margin that holds for every disturbance and all parameters within their half widths";
    /// The fraction of random kicks that is lost.
    Lost: "lost", Margin, ["lost_part", "lost_error"],
        "the fraction of random kicks that is not captured, and its error";
    /// How round the basin is.
    Integrity: "integrity", Margin, ["circle_radius", "integrity"],
        "radius of the largest circle about the origin within the basin, and the part of the basin that it fills \
         (integrity factor)";
    /// How long the starts of a window take to come to rest.
    Settling: "settling", Settling, ["settling_max", "settling_mean"],
        "largest and mean time to rest of 32 x 32 starts of the window, if all are at rest in the end";
    /// The fraction of a window that is at rest in time.
    FiniteTime: "finite-time", Settling, ["rested_part", "rested_error"],
        "finite-time basin stability: the fraction of 32 x 32 starts of the window at rest in the end, and its \
         error as a fraction of the window";
    /// How many kicks in a row are survived.
    Repeated: "repeated", Repeated, ["kicks_mean", "kicks_lost", "kicks_error"],
        "mean number of random kicks, each from where the last one came to rest, until one is lost; the part that \
         is lost after many; the relative error of both";
    /// Whether the number of cycles is proved, and bounds of their amplitudes.
    Proved: "proved", Proved,
        ["proved", "q_max_1_lower", "q_max_1_upper", "q_max_2_lower", "q_max_2_upper"],
        "whether it is proved that there are these cycles and no others, and bounds of their amplitudes";
    /// What borders the basin.
    Border: "border", Margin, ["border"],
        "what borders the basin: cycle, separatrix or none; of a machine also grazing or no-basin";
    /// The friction that a margin needs.
    Design: "design", Design, ["friction_needed"],
        "the least friction, r or R, that keeps the margin of --design; 0 if any does";
}

impl Measure {
    /// The row of [`MEASURES`] that describes this measure.
    pub fn spec(self) -> &'static MeasureSpec {
        &MEASURES[self as usize]
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
        let with = self.spec().with;
        match knob {
            Knob::Q0 | Knob::V0 | Knob::X | Knob::V => with == Measure::Outcome,
            Knob::Duration => matches!(with, Measure::Outcome | Measure::Settling),
            Knob::DisturbingForce => matches!(with, Measure::Guaranteed | Measure::Design),
            Knob::D => !matches!(with, Measure::Fold | Measure::Escape),
            Knob::R | Knob::Friction => with != Measure::Design,
            _ => true,
        }
    }

    /// The measure with this name. Fails with one line that says which there are.
    pub fn named(name: &str) -> Result<Self, String> {
        MEASURES.iter().find(|row| row.name == name).map(|row| row.measure).ok_or_else(|| {
            let names = MEASURES.map(|row| row.name).join(", ");
            format!("there is no measure {name:?}; there are {names}")
        })
    }
}

/// What is computed for these measures: those with which each of them is.
pub fn computed(measures: &[Measure]) -> BTreeSet<Measure> {
    measures.iter().map(|measure| measure.spec().with).collect()
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
        if value.is_finite() { Value::Number(value) } else { Value::Nothing }
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
    pub(in crate::scan) fn set(&mut self, knob: Knob, value: f64) -> Result<(), String> {
        match self {
            ScanSource::Oscillator(Problem { parameters, initial, .. }) => {
                knob.set(parameters, initial, value);
                Ok(())
            }
            ScanSource::Machine(problem) => problem.set(knob, value),
        }
    }
}

// What some measures depend on beside the parameters and the start.

/// The window of starts, the tolerances, the disturbance and the kicks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conditions {
    /// Starts whose part or times are measured.
    pub window: StartWindow,
    /// Half widths of parameters, each given once.
    pub half_widths: Vec<(Knob, f64)>,
    /// Bound on the disturbance.
    pub disturbance: f64,
    /// Kicks of which a fraction is lost.
    pub kicks: RandomKick,
    /// Whether the window of a machine counts displacements from the relaxed spring.
    pub elongation: bool,
    /// The margin for which the friction is sought.
    pub wanted: Option<(Kick, f64)>,
}

impl From<StartWindow> for Conditions {
    fn from(window: StartWindow) -> Self {
        Conditions { window, ..Conditions::default() }
    }
}

impl Conditions {
    /// The box of parameters around these; friction is never negative.
    pub fn around(&self, parameters: &Parameters) -> ParameterBox {
        ParameterBox::around(parameters, self.half_widths.iter().copied())
    }

    /// The window of a machine, from its steady position.
    pub fn about(&self, model: &Model) -> StartWindow {
        let steady = if self.elongation { model.pull } else { 0.0 };
        let StartWindow { q: (from, to), v } = self.window;
        StartWindow { q: (from - steady, to - steady), v }
    }

    /// How far the edge of the basin matters.
    pub fn reach(&self) -> f64 {
        self.window.reach()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_measure_stands_at_its_own_row_and_no_two_columns_share_a_name() {
        let mut columns = BTreeSet::new();
        for row in &MEASURES {
            assert_eq!(row.measure.spec().name, row.name);
            assert_eq!(Measure::named(row.name), Ok(row.measure));
            for column in row.columns {
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
