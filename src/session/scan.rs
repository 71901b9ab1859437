//! A scan in the explorer: what was asked for, the rows so far, and the point that is looked at.
//!
//! Once started it goes on until it is done or stopped, whatever is on show meanwhile.

use std::sync::Arc;

use super::input::Input;
use super::plot::Pane;
use super::state::Session;
use crate::flow::Reason;
use crate::oscillator::{PARAMETERS, Symbol};
use crate::scene::answer::{Failure, Rows};
use crate::scene::{Answer, Answered, Point, Request, Span, View, Window};
use crate::study::basin;
use crate::study::measure::{MEASURES, Measure, Value};
use crate::study::scan::{Row, Scan, Spacing, Sweep};

/// Words of measures, each with the number at which it is plotted.
pub const WORDS: [&str; 4] = ["captured", "moving", "escaped", "gave-up"];

/// How a scan goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Rows are being computed, from this one on.
    Running {
        /// The first row of this run.
        from: usize,
    },
    /// It was stopped.
    Stopped,
    /// All rows are there.
    Done,
}

/// A scan and what it has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Scanned {
    /// The scan.
    pub scan: Arc<Scan>,
    /// The rows so far, in order from the first point on.
    pub rows: Vec<Row>,
    /// How it goes.
    pub progress: Progress,
    /// Seconds that this run has taken.
    pub seconds: f64,
    /// The measured column that is plotted.
    pub column: usize,
    /// Whether the rows are listed instead.
    pub table: bool,
    /// The point that is looked at.
    pub at: usize,
}

impl Scanned {
    /// A scan that begins.
    #[must_use]
    pub fn begun(scan: Scan) -> Self {
        Scanned {
            scan: Arc::new(scan),
            rows: Vec::new(),
            progress: Progress::Running { from: 0 },
            seconds: 0.0,
            column: 0,
            table: false,
            at: 0,
        }
    }

    /// What it asks for, while it runs.
    #[must_use]
    pub fn request(&self) -> Option<Request> {
        match self.progress {
            Progress::Running { from } => {
                Some(Request::Scan { scan: Arc::clone(&self.scan), from })
            }
            Progress::Stopped | Progress::Done => None,
        }
    }

    /// Whether its points make a plane.
    #[must_use]
    pub fn is_grid(&self) -> bool {
        self.scan.over().len() > 1
    }

    /// The value that is plotted at a point, if it is known and a number.
    #[must_use]
    pub fn height(&self, index: usize) -> Option<f64> {
        number(self.rows.get(index)?, self.column)
    }

    /// Whether words are plotted.
    #[must_use]
    pub fn plots_words(&self) -> bool {
        let mut values = self.rows.iter().filter_map(|row| row.values.get(self.column));
        values.any(|value| matches!(value, Value::Word(_)))
    }

    /// The smallest and the largest value that is plotted.
    #[must_use]
    pub fn range(&self) -> Option<(f64, f64)> {
        let heights = (0..self.rows.len()).filter_map(|index| self.height(index));
        heights.fold(None, |range: Option<(f64, f64)>, height| {
            let (low, high) = range.unwrap_or((height, height));
            Some((low.min(height), high.max(height)))
        })
    }

    /// Where a value of a sweep stands on its axis, which is logarithmic where the sweep is.
    #[must_use]
    pub fn coordinate(sweep: &Sweep, index: usize) -> f64 {
        let value = sweep.value(index);
        match sweep.spacing {
            Spacing::Even => value,
            Spacing::Logarithmic => value.abs().log10(),
        }
    }

    /// The part of the world in which all points of a line stand, or all of a grid with half a step
    /// around them.
    #[must_use]
    pub fn window(&self) -> Window {
        /// Room above and below a curve, as a factor of its height.
        const ROOM: f64 = 1.1;
        let usual = View::Scan.spec().window;
        let [across, rest @ ..] = self.scan.over() else { return usual };
        let along = |sweep: &Sweep, room: f64| {
            let ends = [0, sweep.count - 1].map(|index| Self::coordinate(sweep, index));
            let span = Span::covering(ends);
            #[expect(clippy::cast_precision_loss, reason = "at most a million")]
            let wider = 1.0 + room / (sweep.count - 1) as f64;
            span.map(|span| span.scaled(span.center(), wider))
        };
        if let [upward, ..] = rest {
            let spans = along(across, 1.0).zip(along(upward, 1.0));
            return spans.map_or(usual, |(x, y)| Window { x, y });
        }
        let heights = self.range().and_then(|(low, high)| Span::covering([low, high]));
        let y = heights.map_or(usual.y, |span| span.scaled(span.center(), ROOM));
        along(across, 0.0).map_or(usual, |x| Window { x, y })
    }

    /// Where a point stands in the plot; its height only where that is known.
    #[must_use]
    pub fn place(&self, index: usize) -> Option<Point> {
        let over = self.scan.over();
        let place = self.scan.place(index);
        let coordinate =
            |which: usize| Some(Self::coordinate(over.get(which)?, *place.get(which)?));
        let y = if self.is_grid() { coordinate(1)? } else { self.height(index)? };
        Some(Point { x: coordinate(0)?, y })
    }
}

/// A cell as a number, a word by its place among [`WORDS`].
fn number(row: &Row, column: usize) -> Option<f64> {
    match *row.values.get(column)? {
        Value::Word(word) => {
            let place = WORDS.iter().position(|known| *known == word)?;
            u32::try_from(place).ok().map(f64::from)
        }
        value => value.number(),
    }
}

/// The fields of the form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// The name of a parameter.
    Parameter,
    /// The first value.
    From,
    /// The last value.
    To,
    /// How many values.
    Count,
    /// What is measured.
    Measure,
}

/// One row of [`FIELDS`].
#[derive(Clone, Copy, Debug)]
pub struct FieldSpec {
    /// What is typed.
    pub field: Field,
    /// Its name on the screen.
    pub name: &'static str,
    /// What may be typed.
    pub help: &'static str,
}

const FROM: FieldSpec = FieldSpec {
    field: Field::From,
    name: "from",
    help: "first value; log: before it for equal ratios",
};
const TO: FieldSpec = FieldSpec { field: Field::To, name: "to", help: "last value" };
const COUNT: FieldSpec = FieldSpec { field: Field::Count, name: "count", help: "how many values" };

/// Every field of the form, in the order in which they stand.
pub const FIELDS: [FieldSpec; 9] = [
    FieldSpec { field: Field::Parameter, name: "over", help: "D, D2, D3, r, q0 or v0" },
    FROM,
    TO,
    COUNT,
    FieldSpec { field: Field::Parameter, name: "and over", help: "a second parameter, or nothing" },
    FROM,
    TO,
    COUNT,
    FieldSpec { field: Field::Measure, name: "measure", help: "one or more, with commas between" },
];

/// A scan being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Form {
    /// What is typed, one line for each of [`FIELDS`].
    pub inputs: [Input; 9],
    /// The field that is typed in.
    pub at: usize,
    /// Why it was refused, until it changes.
    pub refused: Option<String>,
}

impl Form {
    /// The form as it opens the first time: over a parameter and its values.
    #[must_use]
    pub fn new(symbol: Symbol, (from, to): (f64, f64)) -> Self {
        let text = |value: f64| format!("{value:?}");
        let name = symbol.spec().name.to_owned();
        let over = [name, text(from), text(to), "100".to_owned()];
        let second = ["", "", "", "20"].map(str::to_owned);
        let mut texts = over.into_iter().chain(second).chain(["margin".to_owned()]);
        Form {
            inputs: std::array::from_fn(|_| Input::new(texts.next().unwrap_or_default())),
            at: 0,
            refused: None,
        }
    }

    /// The line that is typed in.
    pub fn input_mut(&mut self) -> &mut Input {
        &mut self.inputs[self.at]
    }

    /// What a field offers to choose from.
    #[must_use]
    pub fn choices(at: usize) -> Vec<&'static str> {
        match FIELDS[at].field {
            Field::Parameter => {
                let none = (at > 0).then_some("");
                none.into_iter().chain(PARAMETERS.map(|row| row.name)).collect()
            }
            Field::Measure => MEASURES.map(|row| row.name).to_vec(),
            Field::From | Field::To | Field::Count => Vec::new(),
        }
    }

    /// The scan that is typed, of the motion on show.
    ///
    /// # Errors
    /// One line that says what is wrong and what is allowed.
    pub fn read(&self, session: &Session) -> Result<Scan, String> {
        let texts =
            self.inputs.each_ref().map(|input| input.text().trim().replace('\u{2212}', "-"));
        let [name, from, to, count, second, from2, to2, count2, measures] = &texts;
        let sweep = |name: &str, from: &str, to: &str, count: &str| {
            for (what, text) in [("from", from), ("to", to), ("count", count)] {
                if text.is_empty() {
                    return Err(format!("{what} of {name} is empty"));
                }
            }
            format!("{name}={from}:{to}:{count}").parse::<Sweep>()
        };
        let mut over = vec![sweep(name, from, to, count)?];
        if !second.is_empty() {
            over.push(sweep(second, from2, to2, count2)?);
        }
        scan_of(session, over, measures)
    }
}

/// A scan of the motion on show; the window of `stability` is that of a phase plane on show.
///
/// # Errors
/// One line that says what is wrong and what is allowed.
pub fn scan_of(session: &Session, over: Vec<Sweep>, measures: &str) -> Result<Scan, String> {
    let measures = measures.split(',').map(|name| Measure::named(name.trim()));
    let measures = measures.collect::<Result<Vec<_>, _>>()?;
    let planes = session.plots.iter().filter(|plot| plot.view == View::Phase);
    let window = planes.map(|plot| plot.window).next().unwrap_or(View::Phase.spec().window);
    let ends = |span: Span| (span.from(), span.to());
    let window = basin::Window { q: ends(window.x), v: ends(window.y) };
    Scan::new(session.problem, over, measures, window)
}

impl Session {
    /// What the scan asks for, while it runs.
    #[must_use]
    pub fn scan_request(&self) -> Option<Request> {
        self.scanned.as_ref()?.request()
    }

    /// Takes rows of the scan in; returns whether they were asked for.
    pub(super) fn take_rows(&mut self, answered: &Answered) -> bool {
        if self.scan_request().as_ref() != Some(&answered.request) {
            return false;
        }
        let Some(scanned) = &mut self.scanned else { return false };
        scanned.seconds = answered.seconds;
        match &answered.result {
            Ok(Answer::Rows(Rows { first, rows })) if *first == scanned.rows.len() => {
                scanned.rows.extend_from_slice(rows);
            }
            Ok(_) => return false,
            // What was stopped has been marked so before.
            Err(Failure::Reason(Reason::Interrupted)) => return true,
            Err(_) => scanned.progress = Progress::Stopped,
        }
        if scanned.rows.len() == scanned.scan.points() {
            scanned.progress = Progress::Done;
        }
        for plot in self.plots.iter_mut().filter(|plot| plot.view == View::Scan) {
            plot.window = scanned.window();
        }
        true
    }

    /// Whether the keys go to a scan.
    #[must_use]
    pub fn focuses_scan(&self) -> bool {
        match self.focus {
            Pane::Parameters => false,
            Pane::Plot(index) => self.plots.get(index).is_some_and(|plot| plot.view == View::Scan),
        }
    }
}
