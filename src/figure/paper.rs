//! How a figure stands on white paper: where its panels are, how their world becomes paper, and how roles and dashes
//! look.

use std::sync::LazyLock;

use crate::numerics::{cells, named};
use crate::picture::{Dash, Role};
use crate::scene::{Point, Window};

/// Size of the plot of a panel, in pixels of 1/96 inch.
pub const PLOT: (f64, f64) = (380.0, 300.0);

/// Room around it: left, right, above, below.
pub const MARGIN: (f64, f64, f64, f64) = (64.0, 16.0, 30.0, 44.0);

/// Size of a panel with the room around its plot.
pub const PANEL: (f64, f64) = (MARGIN.0 + PLOT.0 + MARGIN.1, MARGIN.2 + PLOT.1 + MARGIN.3);

/// Room for the title of the figure.
pub const HEAD: f64 = 34.0;

/// Height of a line of the legend, and width of one of its columns.
pub const ENTRY: (f64, f64) = (214.0, 18.0);

/// A place on paper, in pixels.
pub type Spot = (f64, f64);

/// The plot of a panel on paper.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub left: f64,
    pub top: f64,
    pub window: Window,
}

impl Frame {
    /// The plot of the panel with this number, from 0, among `count`.
    pub fn of(number: u32, panels: u32, window: Window) -> Self {
        let across = columns(panels);
        let (column, row) = (f64::from(number % across), f64::from(number / across));
        let (left, top) = (column * PANEL.0 + MARGIN.0, HEAD + row * PANEL.1 + MARGIN.2);
        Frame { left, top, window }
    }

    /// Where a point stands.
    pub fn spot(&self, point: Point) -> Spot {
        let Window { x, y } = self.window;
        let (right, up) = (x.fraction(point.x), y.fraction(point.y));
        (self.left + right * PLOT.0, self.top + (1.0 - up) * PLOT.1)
    }

    /// Whether a spot lies in the plot, at least this far from its edges.
    pub fn holds(&self, (x, y): Spot, apart: f64) -> bool {
        let (across, down) = (x - self.left, y - self.top);
        (apart..=PLOT.0 - apart).contains(&across) && (apart..=PLOT.1 - apart).contains(&down)
    }
}

/// Panels beside each other.
pub fn columns(panels: u32) -> u32 {
    if panels == 4 { 2 } else { panels.clamp(1, 3) }
}

/// Width and colour of the lines of roles, on white paper: the lines of `assets/paper.txt`.
static INKS: LazyLock<Vec<(Role, f64, &str)>> = LazyLock::new(|| {
    include_str!("../../assets/paper.txt").lines().filter_map(described).collect()
});

fn described(line: &'static str) -> Option<(Role, f64, &'static str)> {
    let [role, width, color] = cells(line)?;
    Some((named(role)?, width.parse().ok()?, color))
}

/// Width and colour of the lines of a role.
pub fn ink(role: Role) -> (f64, &'static str) {
    let row = INKS.iter().find(|(known, ..)| *known == role);
    row.map_or((1.0, "#222222"), |(_, width, color)| (*width, *color))
}

/// The attributes of a line of a role.
pub fn stroke(role: Role, dash: Dash) -> String {
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
pub fn shading(role: Role) -> String {
    let (color, opacity) = match role {
        Role::Danger | Role::Safe | Role::Field => (ink(role).1, 0.12),
        Role::Sticking | Role::Failure => (ink(role).1, 0.18),
        _ => ("#dbe7f3", 0.75),
    };
    format!("fill=\"{color}\" fill-opacity=\"{opacity}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_file_is_read() {
        let lines = include_str!("../../assets/paper.txt").lines();
        assert_eq!(INKS.len(), lines.filter(|line| line.contains(" | ")).count());
    }
}
