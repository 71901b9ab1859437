//! What a part of a picture stands for, and how it is told apart without colour: roles, dashes, marks.

use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// Makes [`Role`] and [`ROLES`] from one list: each role with its name in theme files, and its glyph in a plot
/// without dots.
macro_rules! roles {
    ($($(#[$doc:meta])* $role:ident = $name:literal, $glyph:literal,)*) => {
        /// What a part of the screen stands for, as far as its style goes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum Role {
            $($(#[$doc])* $role,)*
        }

        /// Name in theme files, and glyph in a plot without dots, of every role in order.
        pub const ROLES: [(Role, &str, char); [$($name),*].len()] =
            [$((Role::$role, $name, $glyph)),*];
    };
}

roles! {
    Text = "text", '*',
    /// Text of second rank: labels, units, explanations.
    Quiet = "quiet", '.',
    Title = "title", '*',
    /// Heading of the pane that the keys go to.
    Focus = "focus", '*',
    Selected = "selected", '*',
    /// A value that the last key changed.
    Changed = "changed", '*',
    /// Keys in footer and help.
    Key = "key", '*',
    /// What needs attention: stale, busy, a limit reached.
    Warning = "warning", '!',
    Failure = "failure", '!',
    /// Axes, ticks and their labels.
    Axis = "axis", '.',
    Field = "field", '.',
    /// Shading of the basin of attraction.
    Basin = "basin", '.',
    /// Borders of the bands of capture.
    Bands = "bands", '-',
    /// Motion of the point that is compared with.
    Ghost = "ghost", ',',
    /// Its stable and its unstable cycles.
    GhostStable = "ghost-stable", ',',
    GhostUnstable = "ghost-unstable", ',',
    /// Circle of the Lyapunov estimate.
    Lyapunov = "lyapunov", ':',
    /// The segment of equilibria.
    Sticking = "sticking", '=',
    /// The motion on show; of several the newest.
    Trajectory = "trajectory", '*',
    /// Motions beside the one on show.
    Beside = "beside", 'x',
    Velocity = "velocity", 'v',
    Energy = "energy", 'e',
    Map = "map", '#',
    Stable = "stable", '#',
    /// Unstable cycles, and the separatrix.
    Unstable = "unstable", 'o',
    /// What a map shades, the stronger the more dangerous.
    Danger = "danger", '#',
    /// Its other end: what is least dangerous.
    Calm = "calm", '.',
    /// What is survived for certain.
    Safe = "safe", '.',
    /// Work that feeds the motion, and work that brakes it.
    Gain = "gain", '#',
    Loss = "loss", '=',
    Harmonic = "harmonic", '~',
    Asymptote = "asymptote", '\'',
    /// Special points and their names.
    Special = "special", '*',
    /// The current parameter value in the diagram.
    Current = "current", '|',
    /// The cursor and its read-out.
    Cursor = "cursor", '+',
}

impl Role {
    /// The name in theme files and figures.
    pub fn name(self) -> &'static str {
        ROLES[self as usize].1
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
