//! How a figure stands on white paper: where its panels are, how their world becomes paper, and how roles and dashes
//! look.

use std::sync::LazyLock;

use super::elements::{Color, Pen, Spot, Tint};
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

/// Frames, ticks, and lines of roles that have no line in the file.
pub const DARK: Color = [0x22; 3];

/// The plot of a panel on paper.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub left: f64,
    pub top: f64,
    pub window: Window,
}

impl Frame {
    /// The plot of the panel with this number, from 0, in rows of as many `columns` below a `head` of this height.
    pub fn of(number: u32, columns: u32, head: f64, window: Window) -> Self {
        let (column, row) = (f64::from(number % columns), f64::from(number / columns));
        let (left, top) = (column * PANEL.0 + MARGIN.0, head + row * PANEL.1 + MARGIN.2);
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
static INKS: LazyLock<Vec<(Role, f64, Color)>> = LazyLock::new(|| {
    include_str!("../../assets/paper.txt").lines().filter_map(described).collect()
});

fn described(line: &'static str) -> Option<(Role, f64, Color)> {
    let [role, width, color] = cells(line)?;
    let [_, red, green, blue] =
        u32::from_str_radix(color.strip_prefix('#')?, 16).ok()?.to_be_bytes();
    Some((named(role)?, width.parse().ok()?, [red, green, blue]))
}

/// Width and colour of the lines of a role.
pub fn ink(role: Role) -> (f64, Color) {
    let row = INKS.iter().find(|(known, ..)| *known == role);
    row.map_or((1.0, DARK), |(_, width, color)| (*width, *color))
}

/// How a line of a role is drawn.
pub fn pen(role: Role, dash: Dash) -> Pen {
    let (width, color) = ink(role);
    let width = if dash == Dash::Thick { 3.0 } else { width };
    let dash: &[f64] = match dash {
        Dash::Solid | Dash::Thick => &[],
        Dash::Dashed => &[7.0, 4.0],
        Dash::DashDot => &[7.0, 3.0, 1.6, 3.0],
        Dash::Dotted => &[1.6, 2.6],
        Dash::Sparse => &[1.6, 5.0],
    };
    Pen { width, color, dash }
}

/// How an area of a role is shaded.
pub fn shading(role: Role) -> Tint {
    let (color, opacity) = match role {
        Role::Danger | Role::Safe | Role::Field => (ink(role).1, 0.12),
        Role::Sticking | Role::Failure => (ink(role).1, 0.18),
        _ => ([0xdb, 0xe7, 0xf3], 0.75),
    };
    Tint { color, opacity }
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
