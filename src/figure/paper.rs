//! How a figure stands on white paper: where its panels are, how their world becomes paper, and how roles and dashes
//! look.

use crate::picture::{Dash, Role};
use crate::scene::{Point, Window};

/// Size of the plot of a panel, in pixels of 1/96 inch.
pub(super) const PLOT: (f64, f64) = (380.0, 300.0);

/// Room around it: left, right, above, below.
pub(super) const MARGIN: (f64, f64, f64, f64) = (64.0, 16.0, 30.0, 44.0);

/// Room for the title of the figure.
pub(super) const HEAD: f64 = 34.0;

/// Height of a line of the legend, and width of one of its columns.
pub(super) const ENTRY: (f64, f64) = (214.0, 18.0);

/// A place on paper, in pixels.
pub(super) type Spot = (f64, f64);

/// The plot of a panel on paper.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub left: f64,
    pub top: f64,
    pub window: Window,
}

impl Frame {
    /// The plot of the panel with this number, from 0, among `count`.
    pub fn of(number: u32, panels: u32, window: Window) -> Self {
        let across = columns(panels);
        let (column, row) = (f64::from(number % across), f64::from(number / across));
        let (width, height) = panel();
        Frame { left: column * width + MARGIN.0, top: HEAD + row * height + MARGIN.2, window }
    }

    /// Where a point stands.
    pub fn spot(&self, point: Point) -> Spot {
        let Window { x, y } = self.window;
        let (right, up) = (x.fraction(point.x), y.fraction(point.y));
        (self.left + right * PLOT.0, self.top + (1.0 - up) * PLOT.1)
    }
}

pub(super) fn panel() -> (f64, f64) {
    (MARGIN.0 + PLOT.0 + MARGIN.1, MARGIN.2 + PLOT.1 + MARGIN.3)
}

/// Panels beside each other.
pub(super) fn columns(panels: u32) -> u32 {
    if panels == 4 { 2 } else { panels.clamp(1, 3) }
}

pub(super) fn rows(panels: u32) -> u32 {
    panels.div_ceil(columns(panels))
}

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

/// The attributes of a line of a role.
pub(super) fn stroke(role: Role, dash: Dash) -> String {
    let (width, color) = ink(role);
    let width = if dash == Dash::Thick { 3.0 } else { width };
    let dashes = match dash {
        Dash::Solid | Dash::Thick => "",
        Dash::Dashed => " stroke-dasharray=\"7 4\"",
        Dash::DashDot => " stroke-dasharray=\"7 3 1.6 3\"",
        Dash::Dotted => " stroke-dasharray=\"1.6 2.6\"",
        Dash::Sparse => " stroke-dasharray=\"1.6 5\"",
    };
    format!("stroke=\"{color}\" stroke-width=\"{width}\"{dashes}")
}

/// The attributes of a shaded area: its colour and opacity.
pub(super) fn shading(role: Role) -> String {
    let (color, opacity) = match role {
        Role::Danger | Role::Safe | Role::Field => (ink(role).1, 0.12),
        Role::Sticking | Role::Failure => (ink(role).1, 0.18),
        _ => ("#dbe7f3", 0.75),
    };
    format!("fill=\"{color}\" fill-opacity=\"{opacity}\"")
}
