//! How the lines and areas of roles look on paper, in colour and in shades of grey.

use std::sync::LazyLock;

use super::elements::{BLACK, Color, PageUnit, PlotPen, Tint};
use super::paper::PageLayout;
use crate::numerics::{cells, named};
use crate::picture::{Dash, Role};
use crate::scene::JournalStyle;

/// Frames, ticks, and lines of roles that have no line in the file.
pub const DARK: Color = [0x22; 3];

/// How the lines of a role look: a line of `assets/paper.txt`.
#[derive(Clone, Copy, Debug)]
struct Ink {
    role: Role,
    /// Width in pixels and in points.
    widths: [f64; 2],
    color: Color,
    /// What the colour is called.
    word: &'static str,
    grey: Color,
}

static INKS: LazyLock<Vec<Ink>> = LazyLock::new(|| {
    include_str!("../../assets/paper.txt").lines().filter_map(described).collect()
});

fn described(line: &'static str) -> Option<Ink> {
    let [role, pixels, color, word, points, grey] = cells(line)?;
    let widths = [pixels.parse().ok()?, points.parse().ok()?];
    Some(Ink { role: named(role)?, widths, color: read(color)?, word, grey: read(grey)? })
}

fn read(color: &str) -> Option<Color> {
    let [_, red, green, blue] =
        u32::from_str_radix(color.strip_prefix('#')?, 16).ok()?.to_be_bytes();
    Some([red, green, blue])
}

fn ink(role: Role) -> Ink {
    let known = INKS.iter().find(|ink| ink.role == role).copied();
    known.unwrap_or(Ink { role, widths: [1.0, 0.5], color: DARK, word: "black", grey: BLACK })
}

/// Lengths of dashes and gaps, in pixels and in points.
fn dashes(dash: Dash) -> [&'static [f64]; 2] {
    match dash {
        Dash::Solid | Dash::Thick => [&[]; 2],
        Dash::Dashed => [&[7.0, 4.0], &[4.5, 2.5]],
        Dash::DashDot => [&[7.0, 3.0, 1.6, 3.0], &[4.5, 2.0, 1.0, 2.0]],
        Dash::Dotted => [&[1.6, 2.6], &[1.0, 1.6]],
        Dash::Sparse => [&[1.6, 5.0], &[1.0, 3.5]],
    }
}

impl PageLayout {
    /// The colour of a role.
    pub fn color(&self, role: Role) -> Color {
        let ink = ink(role);
        if self.grey { ink.grey } else { ink.color }
    }

    /// What that colour is called.
    pub fn word(&self, role: Role) -> &'static str {
        const GREYS: [&str; 5] = ["black", "dark grey", "grey", "light grey", "white"];
        let [shade, ..] = self.color(role);
        if self.grey {
            GREYS[usize::from(shade) / 0x34]
        } else {
            ink(role).word
        }
    }

    /// How a line of a role is drawn.
    pub fn pen(&self, role: Role, dash: Dash) -> PlotPen {
        let widths = if dash == Dash::Thick {
            [3.0, 1.2]
        } else {
            ink(role).widths
        };
        let unit = self.unit as usize;
        let (width, color) = (self.printed(widths[unit]), self.color(role));
        PlotPen { width, color, dash: dashes(dash)[unit] }
    }

    /// A line that has no role, of this width in `plain`.
    pub fn line(&self, width: f64, color: Color) -> PlotPen {
        let width = match width {
            width if self.unit == PageUnit::Pixel => width,
            ..0.8 => self.printed(0.25),
            ..1.2 => 0.5,
            _ => 0.8,
        };
        PlotPen::solid(width, color)
    }

    /// A width that the journal prints: Springer asks for 0.3 pt at least.
    fn printed(&self, width: f64) -> f64 {
        if self.style == JournalStyle::Springer {
            width.max(0.5)
        } else {
            width
        }
    }

    /// How an area of a role is shaded.
    pub fn shading(&self, role: Role) -> Tint {
        let (color, opacity) = match role {
            Role::Danger if self.grey => (BLACK, 0.26),
            Role::Field if self.grey => (BLACK, 0.2),
            Role::Danger | Role::Safe | Role::Field => (self.color(role), 0.12),
            Role::Sticking | Role::Failure => (self.color(role), 0.18),
            _ if self.grey => ([0xdd; 3], 0.75),
            _ => ([0xdb, 0xe7, 0xf3], 0.75),
        };
        Tint { color, opacity }
    }
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
