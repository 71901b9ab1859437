//! A scan in the explorer: its definition, the rows so far, and the selected point.
//!
//! Once started, it continues until it is done or stopped, whatever else is shown.

use std::sync::Arc;

use crate::numerics::{log10, real};
use crate::scan::{Scan, ScanRow, Spacing, Sweep, Value};
use crate::scene::{Point, Request, Span, View, Window};

/// The words that a measure can have as its value; they are plotted at their indices.
pub const WORDS: [&str; 4] = ["captured", "moving", "escaped", "gave-up"];

/// Said on the screen while a scan is running.
pub const SCANNING: &str = "scanning";

/// Progress of a scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ScanProgress {
    /// Rows are being computed.
    Running {
        /// First row of this run.
        from: usize,
    },
    Stopped,
    /// All rows are there.
    Done,
}

/// A scan and its results.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanOnShow {
    pub scan: Arc<Scan>,
    /// The rows so far, in order, beginning with the first point.
    pub rows: Vec<ScanRow>,
    pub progress: ScanProgress,
    /// Duration of this run so far, in s.
    pub seconds: f64,
    /// The measured column that is plotted.
    pub column: usize,
    /// Whether the rows are listed instead of plotted.
    pub table: bool,
    /// The selected point.
    pub at: usize,
}

impl ScanOnShow {
    /// A scan that is beginning.
    pub fn begun(scan: Scan) -> Self {
        ScanOnShow {
            scan: Arc::new(scan),
            rows: Vec::new(),
            progress: ScanProgress::Running { from: 0 },
            seconds: 0.0,
            column: 0,
            table: false,
            at: 0,
        }
    }

    /// Its request while it is running.
    pub fn request(&self) -> Option<Request> {
        let ScanProgress::Running { from } = self.progress else { return None };
        Some(Request::Scan { scan: Arc::clone(&self.scan), from })
    }

    /// Whether it has two sweeps, so that its points form a grid.
    pub fn is_grid(&self) -> bool {
        self.scan.over().len() > 1
    }

    /// What was measured at a point, of the column that is plotted; `None` while it is not known.
    pub fn value(&self, index: usize) -> Option<Value> {
        self.rows.get(index)?.values.get(self.column).copied()
    }

    /// The height of a point: its value as a number; a word becomes its index in [`WORDS`].
    pub fn height(&self, index: usize) -> Option<f64> {
        match self.value(index)? {
            Value::Word(word) => WORDS.iter().position(|known| *known == word).map(real),
            value => value.number(),
        }
    }

    pub fn plots_words(&self) -> bool {
        (0..self.rows.len()).any(|index| matches!(self.value(index), Some(Value::Word(_))))
    }

    fn heights(&self) -> impl Iterator<Item = f64> {
        (0..self.rows.len()).filter_map(|index| self.height(index))
    }

    /// The smallest and the largest value that is plotted.
    pub fn range(&self) -> Option<(f64, f64)> {
        let ends = self.heights().map(|height| (height, height));
        ends.reduce(|(low, high), (height, _)| (low.min(height), high.max(height)))
    }

    /// Coordinate of a value of a sweep on its axis, which is logarithmic if the sweep is.
    pub fn coordinate(sweep: &Sweep, value: f64) -> f64 {
        match sweep.spacing {
            Spacing::Even => value,
            Spacing::Logarithmic => log10(value.abs()),
        }
    }

    /// The window that shows all points of a line, or all of a grid with a margin of half a step.
    pub fn window(&self) -> Window {
        /// Factor on the height of a curve, for a margin above and below.
        const ROOM: f64 = 1.1;
        let usual = View::Scan.spec().window;
        let over = self.scan.over();
        let along = |sweep: &Sweep, room: f64| {
            let last = sweep.count - 1;
            let span =
                Span::covering([0, last].map(|index| Self::coordinate(sweep, sweep.value(index))));
            span.map(|span| span.widened(1.0 + room / real(last)))
        };
        if self.is_grid() {
            let spans = along(&over[0], 1.0).zip(along(&over[1], 1.0));
            return spans.map_or(usual, |(x, y)| Window { x, y });
        }
        let y = Span::covering(self.heights()).map_or(usual.y, |span| span.widened(ROOM));
        along(&over[0], 0.0).map_or(usual, |x| Window { x, y })
    }

    /// The position of a point in the plot; `None` where the height of its curve is not known.
    pub fn place(&self, index: usize) -> Option<Point> {
        let over = self.scan.over();
        let place = self.scan.place(index);
        let coordinate = |which: usize| {
            let sweep = &over[which];
            Self::coordinate(sweep, sweep.value(place[which]))
        };
        let y = if self.is_grid() {
            coordinate(1)
        } else {
            self.height(index)?
        };
        Some(Point { x: coordinate(0), y })
    }
}
