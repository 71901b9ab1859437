//! What a part of a picture stands for, and how it is told apart without colour: roles, dashes, marks.

/// What a piece of the screen is, as far as its style goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// Name in theme files, and glyph in a plot without dots, of every role in order.
pub const ROLES: [(Role, &str, char); 35] = [
    (Role::Text, "text", '*'),
    (Role::Quiet, "quiet", '.'),
    (Role::Title, "title", '*'),
    (Role::Focus, "focus", '*'),
    (Role::Selected, "selected", '*'),
    (Role::Changed, "changed", '*'),
    (Role::Key, "key", '*'),
    (Role::Warning, "warning", '!'),
    (Role::Failure, "failure", '!'),
    (Role::Axis, "axis", '.'),
    (Role::Field, "field", '.'),
    (Role::Basin, "basin", '.'),
    (Role::Bands, "bands", '-'),
    (Role::Ghost, "ghost", ','),
    (Role::GhostStable, "ghost-stable", ','),
    (Role::GhostUnstable, "ghost-unstable", ','),
    (Role::Lyapunov, "lyapunov", ':'),
    (Role::Sticking, "sticking", '='),
    (Role::Trajectory, "trajectory", '*'),
    (Role::Beside, "beside", 'x'),
    (Role::Velocity, "velocity", 'v'),
    (Role::Energy, "energy", 'e'),
    (Role::Map, "map", '#'),
    (Role::Stable, "stable", '#'),
    (Role::Unstable, "unstable", 'o'),
    (Role::Danger, "danger", '#'),
    (Role::Calm, "calm", '.'),
    (Role::Safe, "safe", '.'),
    (Role::Gain, "gain", '#'),
    (Role::Loss, "loss", '='),
    (Role::Harmonic, "harmonic", '~'),
    (Role::Asymptote, "asymptote", '\''),
    (Role::Special, "special", '*'),
    (Role::Current, "current", '|'),
    (Role::Cursor, "cursor", '+'),
];

impl Role {
    /// The name in theme files and figures.
    pub fn name(self) -> &'static str {
        ROLES[self as usize].1
    }
}

/// How a stroke is interrupted; told apart without colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

impl Dash {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Dash::Solid => "solid",
            Dash::Thick => "thick",
            Dash::Dashed => "dashed",
            Dash::DashDot => "dash-dot",
            Dash::Dotted => "dotted",
            Dash::Sparse => "sparse",
        }
    }
}

/// What a mark says about its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A motion starts here.
    Start,
    /// A motion came to rest here.
    Rest,
    /// A motion is here at its end time.
    Head,
    Turn,
    Stable,
    Unstable,
}

impl Mark {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Mark::Start => "start",
            Mark::Rest => "rest",
            Mark::Head => "head",
            Mark::Turn => "turning point",
            Mark::Stable => "stable",
            Mark::Unstable => "unstable",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_role_stands_at_its_own_row() {
        for (index, (role, ..)) in ROLES.iter().enumerate() {
            assert_eq!(*role as usize, index);
        }
    }
}
