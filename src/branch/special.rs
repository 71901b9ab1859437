//! The special points of a branch of limit cycles, and what motions do there.

use serde::Serialize;

use crate::model::Parameters;
use crate::portrait::{Cycle, CycleErrors, SwingPair, first_side};

/// What makes a point of a branch special.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpecialKind {
    /// Two cycles meet and vanish. Well below `D = -1` the unstable one exists only so close to the sticking
    /// set that numbers do not tell it from the set: the stable cycle grazes it.
    Fold,
    /// The cycle goes to infinity.
    Escape,
    /// The steady state changes its stability, which no friction holds.
    Hopf,
    /// The branch crosses the value zero of its parameter.
    ZeroCrossing,
    /// On a belt: a cycle that slips touches the belt's line, and sticks beyond.
    Grazing,
    /// The stick-slip cycle and the border of rest meet as both touch the belt's line.
    Annihilation,
    /// The stick-slip cycle comes to overtake the belt.
    Overtaking,
    /// The cycle comes to overtake the belt without sticking to it.
    Unsticking,
}

/// A special point of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Special {
    /// What it is.
    pub kind: SpecialKind,
    /// Value of the parameter there; of a machine in SI units.
    pub value: f64,
    /// Right turning point of the cycle there; `None` where it is infinite, and where a machine rests.
    pub q_max: Option<f64>,
    /// The cycle there, shrunk to a point at the Hopf point; `None` where it is infinite, and of machines.
    #[serde(skip)]
    pub cycle: Option<Cycle>,
    /// The stable states of a machine that end there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jumps: Option<Jumps>,
}

impl SpecialKind {
    /// Whether the branch ends in a stable `cycle` that grazes the sticking set, instead of meeting an unstable
    /// one.
    #[must_use]
    pub fn grazes(self, cycle: Option<&Cycle>) -> bool {
        self == SpecialKind::Fold && cycle.is_some_and(Cycle::is_stable_beyond_doubt)
    }

    /// What such a point is called, `cycle` being the one that lives there.
    #[must_use]
    pub fn name(self, cycle: Option<&Cycle>) -> &'static str {
        self.told(cycle)[0]
    }

    /// Its letter in a picture.
    #[must_use]
    pub fn letter(self, cycle: Option<&Cycle>) -> &'static str {
        self.told(cycle)[1]
    }

    /// What happens there, in a few words.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        self.told(None)[2]
    }

    /// Name, letter and meaning; those of a grazing where a fold is one.
    fn told(self, cycle: Option<&Cycle>) -> [&'static str; 3] {
        let kind = if self.grazes(cycle) {
            SpecialKind::Grazing
        } else {
            self
        };
        TOLD[kind as usize]
    }
}

/// Name, letter and meaning of each [`SpecialKind`].
const TOLD: [[&str; 3]; 8] = [
    ["fold", "F", "fold: two cycles meet"],
    ["escape", "Dc", "escape"],
    ["Hopf point", "H", "Hopf: rest changes its stability"],
    ["zero crossing", "Z", "zero crossing"],
    ["grazing", "G", "grazing: a slip cycle touches the belt's line"],
    ["annihilation", "A", "annihilation: the stick-slip cycle meets the border of rest"],
    ["overtaking", "O", "the stick-slip cycle comes to overtake the belt"],
    ["unsticking", "U", "the cycle overtakes the belt without sticking"],
];

impl Special {
    /// A special point at which this cycle lives; `None` where it is infinite.
    #[must_use]
    pub fn new(kind: SpecialKind, value: f64, cycle: Option<Cycle>) -> Self {
        Special { kind, value, q_max: cycle.map(|cycle| cycle.q_max), cycle, jumps: None }
    }
}

/// The end of a stable state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Jump {
    /// Largest displacement of the cycle that ends, in m; 0 for rest.
    pub from: f64,
    /// What its motions become.
    pub to: JumpEnd,
}

/// What the motions of a stable state become where it ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum JumpEnd {
    /// They come to rest.
    Rest,
    /// They tend to a cycle.
    Cycle {
        /// Its largest displacement, in m.
        q_max: f64,
    },
    /// They grow beyond all bounds.
    Escaped,
    /// They could not be followed farther: as a rule they leave the friction law.
    Unknown,
}

impl Jump {
    /// The displacement up to which the motions go on to swing, in m; infinite where they grow beyond all bounds, or where that
    /// is not known.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match self.to {
            JumpEnd::Rest => 0.0,
            JumpEnd::Cycle { q_max } => q_max,
            JumpEnd::Escaped | JumpEnd::Unknown => f64::INFINITY,
        }
    }

    /// How far it goes, in m.
    pub(super) fn size(&self) -> f64 {
        (self.reach() - self.from).abs()
    }
}

/// The jumps at a place, on the way up and on the way down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Jumps {
    /// While the number grows.
    pub up: Option<Jump>,
    /// While it falls.
    pub down: Option<Jump>,
}

/// The cycle at the Hopf point: the steady state, about to swing at the undamped frequency.
pub(crate) fn vanishing() -> Cycle {
    Cycle {
        period: std::f64::consts::TAU,
        multiplier: Some(1.0),
        log_clearance: f64::NEG_INFINITY,
        error: Some(0.0),
        errors: Some(CycleErrors::default()),
        ..Cycle::default()
    }
}

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

impl FoldPoint {
    /// The cycle of the largest D.
    pub(super) fn of(closing: &SwingPair, parameters: &Parameters) -> Self {
        let (d, cycle) = (parameters.d, closing.describe(parameters, first_side(parameters)));
        let grazes = d < -1.0 && cycle.is_stable_beyond_doubt();
        FoldPoint { d, q_max: cycle.q_max, period: cycle.period, grazes }
    }
}
