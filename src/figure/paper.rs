//! The measures of a page: where its panels are, how large what stands on it is, and how their world becomes paper.
//!
//! A page of a journal is laid out for its width: letters keep their size, and the plots take what is left.

use super::elements::{PLOT, PageUnit, Spot};
use super::symbols::runs;
use super::{Figure, Panel, letters};
use crate::numerics::{real, truncated};
use crate::picture::{Tick, Ticks};
use crate::scene::{JournalStyle, PanelLetters, Point, Window};

/// Size of letters at axes, in plots, in titles, and in the legend, and the height of a line in a plot; like all lengths
/// that are told in pixels, a page has them [`PageLayout::scale`] times as large.
pub const LETTERS: f64 = 12.0;
pub const NAMES: f64 = 10.5;
pub const TITLES: [f64; 2] = [14.0, 12.5];
pub const LEGEND: f64 = 11.0;
pub const LINE: f64 = 12.0;

/// Room between the numbers at an axis and the plot, and between its name and the edge of its panel.
pub const BESIDE: [f64; 2] = [8.0, 13.0];

/// Room around a plot.
#[derive(Clone, Copy, Debug)]
pub struct Margin {
    pub left: f64,
    pub right: f64,
    pub above: f64,
    pub below: f64,
}

/// The measures of a page.
#[derive(Clone, Copy, Debug)]
pub struct PageLayout {
    pub unit: PageUnit,
    pub style: JournalStyle,
    pub grey: bool,
    /// What a pixel of `plain` is here: letters of 12 are 8 pt in journals.
    pub scale: f64,
    /// Panels beside each other.
    pub columns: usize,
    /// Size of the plot of a panel.
    pub plot: Spot,
    /// Room around it.
    pub margin: Margin,
}

impl PageLayout {
    /// The page of a figure.
    pub fn of(figure: &Figure) -> PageLayout {
        /// Width below which a panel has no other beside it, in points.
        const NARROW: f64 = 150.0;
        let (sheet, panels) = (&figure.sheet, figure.panels.len());
        let (style, grey) = (sheet.style(), sheet.grey);
        let margin = Margin { left: 64.0, right: 16.0, above: 30.0, below: 44.0 };
        let columns = if panels == 4 { 2 } else { panels.clamp(1, 3) };
        let (unit, scale) = (PageUnit::Pixel, 1.0);
        let mut paper = PageLayout { unit, style, grey, scale, columns, plot: PLOT, margin };
        let lettered = sheet.letters(panels);
        if lettered == PanelLetters::Below {
            paper.margin.below += 16.0;
        }
        let Some(width) = sheet.points() else { return paper };
        (paper.unit, paper.scale) = (PageUnit::Point, 2.0 / 3.0);
        // Four panels above each other are higher than a page of a journal.
        let least = if panels > 3 { 2 } else { 1 };
        paper.columns = columns.min(truncated(width / NARROW)).max(least);
        let room = width / real(paper.columns);
        paper.margin.below *= paper.scale;
        // How wide the numbers at axes are depends on how many there are, and that on the room beside them.
        for _ in 0..3 {
            paper = paper.fitted(figure, room);
        }
        let lines = |panel: &Panel| paper.titled(panel).len();
        paper.margin.above = paper.scale
            * match (style, lettered) {
                (JournalStyle::Plain, _) => {
                    15.0 + 15.0 * real(figure.panels.iter().map(lines).max().unwrap_or(1))
                }
                (_, PanelLetters::Above) => 18.0,
                _ => 8.0,
            };
        paper
    }

    /// The lines of the title of a panel, which are centred above its plot.
    pub fn titled(&self, panel: &Panel) -> Vec<String> {
        let Margin { left, right, .. } = self.margin;
        self.wrapped(&panel.title, TITLES[1], self.plot.0 + 2.0 * left.min(right))
    }

    /// The same with room for the numbers at the axes of all panels, each of which is as wide as `room`.
    fn fitted(mut self, figure: &Figure, room: f64) -> PageLayout {
        let (mut widest, mut beyond) = (0.0_f64, 0.0_f64);
        for [rightward, upward] in figure.panels.iter().map(|panel| self.ticks(panel)) {
            let widths = upward.ticks.iter().map(|tick| self.width(&tick.label, LETTERS));
            widest = widths.fold(widest, f64::max);
            let ends = rightward.ticks.iter().map(|tick| {
                0.5 * self.width(&tick.label, LETTERS) - (1.0 - tick.fraction) * self.plot.0
            });
            beyond = ends.fold(beyond, f64::max);
        }
        self.margin.left = widest + self.scale * (BESIDE[0] + BESIDE[1] + 6.0);
        self.margin.right = beyond.max(3.0 * self.scale) + 3.0 * self.scale;
        let across = room - self.margin.left - self.margin.right;
        self.plot = (across, across * PLOT.1 / PLOT.0);
        self
    }

    /// The numbers along both axes of a panel, apart by their widths and heights.
    pub fn ticks(&self, panel: &Panel) -> [Ticks; 2] {
        /// The most numbers at an axis, and the room between two of them, beside and above each other.
        const MOST: usize = 7;
        const APART: Spot = (10.0, 20.0);
        let ((width, height), scale) = (self.plot, self.scale);
        let beside = |pair: &[Tick]| {
            let [one, other] = [0, 1].map(|index| self.width(&pair[index].label, LETTERS));
            let distance = width * (pair[1].fraction - pair[0].fraction);
            distance >= f64::midpoint(one, other) + APART.0 * scale
        };
        let above =
            |pair: &[Tick]| height * (pair[1].fraction - pair[0].fraction) >= APART.1 * scale;
        let rightward = Ticks::on(panel.scales[0], panel.window.x, |ticks| {
            ticks.len() <= MOST && ticks.windows(2).all(beside)
        });
        let mut upward = Ticks::on(panel.scales[1], panel.window.y, |ticks| {
            ticks.len() <= MOST && ticks.windows(2).all(above)
        });
        if panel.y.name.is_empty() {
            // What has no name is not a quantity: a place on paper, the number of a line.
            upward.ticks.clear();
        }
        [rightward, upward]
    }

    /// Size of a panel with the room around its plot.
    pub fn panel(&self) -> Spot {
        let Margin { left, right, above, below } = self.margin;
        (left + self.plot.0 + right, above + self.plot.1 + below)
    }

    /// Width of a text with letters of this size in `plain`.
    pub fn width(&self, text: &str, size: f64) -> f64 {
        letters::width(&runs(text), self.scale * size)
    }

    /// A text of such letters in lines that are no wider than this, if no word is.
    pub fn wrapped(&self, text: &str, size: f64, width: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split(' ') {
            let longer = lines.last().map(|line| format!("{line} {word}"));
            match longer.filter(|longer| self.width(longer, size) <= width) {
                Some(longer) => *lines.last_mut().expect("it was made longer") = longer,
                None => lines.push(word.to_owned()),
            }
        }
        lines
    }
}

/// The plot of a panel on paper.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub left: f64,
    pub top: f64,
    pub window: Window,
    pub paper: PageLayout,
}

impl Frame {
    /// The plot of the panel with this number, from 0, below a `head` of this height.
    pub fn of(number: usize, head: f64, window: Window, paper: PageLayout) -> Self {
        let (column, row) = (real(number % paper.columns), real(number / paper.columns));
        let (width, height) = paper.panel();
        let (left, top) =
            (column * width + paper.margin.left, head + row * height + paper.margin.above);
        Frame { left, top, window, paper }
    }

    /// The same in pixels of `plain`.
    pub fn in_pixels(self) -> Self {
        let (scale, (width, height)) = (self.paper.scale, self.paper.plot);
        let paper = PageLayout { scale: 1.0, plot: (width / scale, height / scale), ..self.paper };
        Frame { left: self.left / scale, top: self.top / scale, paper, ..self }
    }

    /// Where a point stands.
    pub fn spot(&self, point: Point) -> Spot {
        let (Window { x, y }, (width, height)) = (self.window, self.paper.plot);
        let (right, up) = (x.fraction(point.x), y.fraction(point.y));
        (self.left + right * width, self.top + (1.0 - up) * height)
    }

    /// Whether a spot lies in the plot, at least this far from its edges.
    pub fn holds(&self, (x, y): Spot, apart: f64) -> bool {
        let (across, down) = (x - self.left, y - self.top);
        let (width, height) = self.paper.plot;
        (apart..=width - apart).contains(&across) && (apart..=height - apart).contains(&down)
    }
}
