//! How roles and dashes look on white paper.

use crate::picture::role::Role;

/// Width and colour of the lines of a role, on white paper.
pub(super) fn ink(role: Role) -> (f64, &'static str) {
    match role {
        Role::Stable => (1.6, "#0b6e3a"),
        Role::Unstable => (1.6, "#b3261e"),
        Role::Trajectory => (1.1, "#1f4e9c"),
        Role::Beside => (1.1, "#6f8fb8"),
        Role::Sticking => (1.4, "#111111"),
        Role::Harmonic | Role::Energy => (1.2, "#7a3fa0"),
        Role::Asymptote => (0.9, "#8a6d1f"),
        Role::Lyapunov => (1.2, "#a05a00"),
        Role::Bands => (0.8, "#5f7f9f"),
        Role::Map => (1.6, "#14628c"),
        Role::Velocity | Role::Safe | Role::Loss => (1.2, "#00838f"),
        Role::Danger | Role::Gain => (1.2, "#b26a00"),
        Role::Current => (0.9, "#444444"),
        Role::GhostStable => (0.8, "#9cc4ab"),
        Role::GhostUnstable => (0.8, "#dda8a4"),
        Role::Axis | Role::Field | Role::Ghost => (0.8, "#8a8a8a"),
        _ => (1.0, "#222222"),
    }
}

/// Dashes of a style, in pixels.
pub(super) fn dashes(style: &str) -> &'static str {
    match style {
        "dashed" => " stroke-dasharray=\"7 4\"",
        "dash-dot" => " stroke-dasharray=\"7 3 1.6 3\"",
        "dotted" => " stroke-dasharray=\"1.6 2.6\"",
        "sparse" => " stroke-dasharray=\"1.6 5\"",
        _ => "",
    }
}

/// Colour and opacity of shaded areas.
pub(super) fn shading(role: Role) -> (&'static str, f64) {
    match role {
        Role::Danger | Role::Safe | Role::Field => (ink(role).1, 0.12),
        Role::Sticking | Role::Failure => (ink(role).1, 0.18),
        _ => ("#dbe7f3", 0.75),
    }
}
