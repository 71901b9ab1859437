//! What a part of a picture stands for, and how it is told apart without colour: roles, dashes, marks.

use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

use crate::flow::Outcome;

/// What a part of the screen stands for, as far as its style goes.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Role {
    Text,
    /// Text of second rank: labels, units, explanations.
    Quiet,
    Title,
    /// Heading of the pane that the keys go to.
    Focus,
    Selected,
    /// A value that the last key changed.
    Changed,
    /// Keys in footer and help.
    Key,
    /// What needs attention: stale, busy, a limit reached.
    Warning,
    Failure,
    /// Axes, ticks and their labels.
    Axis,
    Field,
    /// Shading of the basin of attraction.
    Basin,
    /// Borders of the bands of capture.
    Bands,
    /// Motion of the point that is compared with.
    Ghost,
    /// Its stable and its unstable cycles.
    GhostStable,
    GhostUnstable,
    /// Circle of the Lyapunov estimate.
    Lyapunov,
    /// The segment of equilibria.
    Sticking,
    /// The belt, its speed and what has to do with it.
    Belt,
    /// The motion on show; of several the newest.
    Trajectory,
    /// Motions beside the one on show.
    Beside,
    Velocity,
    Energy,
    Map,
    Stable,
    /// Unstable cycles, and the separatrix.
    Unstable,
    /// What a map shades, the stronger the more dangerous.
    Danger,
    /// Its other end: what is least dangerous.
    Calm,
    /// What is survived for certain.
    Safe,
    /// Work that feeds the motion, and work that brakes it.
    Gain,
    Loss,
    Harmonic,
    Asymptote,
    /// Special points and their names.
    Special,
    /// The current parameter value in the diagram.
    Current,
    /// The cursor and its read-out.
    Cursor,
}

impl Role {
    /// The name in theme files and figures.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The role of the same at other values than the present ones.
    pub fn paler(self) -> Self {
        match self {
            Role::Stable | Role::GhostStable => Role::GhostStable,
            Role::Unstable | Role::GhostUnstable => Role::GhostUnstable,
            _ => Role::Ghost,
        }
    }

    /// Whether it says more than the axes, the belt and the present values.
    pub fn tells(self) -> bool {
        !matches!(self, Role::Axis | Role::Belt | Role::Current | Role::Quiet)
    }
}

/// How a stroke is interrupted; told apart without colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Dash {
    Solid,
    /// Two dots wide.
    Thick,
    Dashed,
    /// Dashes with a dot between them.
    DashDot,
    Dotted,
    Sparse,
}

/// What a mark says about its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Mark {
    /// A motion starts here.
    Start,
    /// A motion came to rest here.
    Rest,
    /// A motion is here at its end time.
    Head,
    #[strum(serialize = "turning point")]
    Turn,
    Stable,
    Unstable,
    /// A sample that cannot belong to the motion.
    Outlier,
    /// A sample that was flattened at full scale.
    Saturated,
    /// A sample that belongs to another part of the record.
    #[strum(serialize = "left out")]
    Aside,
}

impl Mark {
    /// The name in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// What it looks like on paper.
    pub fn shape(self) -> &'static str {
        match self {
            Mark::Rest => "square",
            Mark::Head | Mark::Stable => "filled circle",
            Mark::Start | Mark::Turn | Mark::Unstable => "open circle",
            Mark::Outlier => "cross",
            Mark::Saturated => "diamond",
            Mark::Aside => "dot",
        }
    }
}

/// How the end of a motion is marked, where it has one.
pub fn end_mark(outcome: &Outcome) -> Option<Mark> {
    match outcome {
        Outcome::Captured { .. } => Some(Mark::Rest),
        Outcome::Moving { .. } | Outcome::Escaped { .. } => Some(Mark::Head),
        Outcome::GaveUp { .. } => None,
    }
}

/// What stable and unstable cycles are called in every plot.
pub fn cycle_name(stable: bool) -> &'static str {
    if stable { "stable cycle" } else { "unstable cycle" }
}

/// How a stable or an unstable cycle is marked.
pub fn cycle_mark(stable: bool) -> Mark {
    if stable { Mark::Stable } else { Mark::Unstable }
}

/// What stands for a stable or an unstable cycle, as far as its colour goes.
pub fn cycle_role(stable: bool) -> Role {
    if stable { Role::Stable } else { Role::Unstable }
}
