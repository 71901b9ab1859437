//! Where the panels of a figure stand, and how their world becomes paper.

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
