//! The scan that a form or a line describes, and the request of a running one.

use crate::model::Group;
use crate::portrait::basin;
use crate::scan::grid::Scan;
use crate::scan::measure::Measure;
use crate::scan::sweep::Sweep;
use crate::scene::{Request, Span, View};
use crate::session::state::{Pane, ScanForm, Session};

/// The scan of the motion on show that the form describes. Fails with one line that says what is wrong and what
/// is allowed.
pub fn typed(form: &ScanForm, session: &Session) -> Result<Scan, String> {
    let texts = form.inputs.each_ref().map(|input| input.text().trim().replace('\u{2212}', "-"));
    let [name, from, to, count, second, from2, to2, count2, measures] = &texts;
    let sweep = |name: &str, from: &str, to: &str, count: &str| {
        for (what, text) in [("from", from), ("to", to), ("count", count)] {
            if text.is_empty() {
                return Err(format!("{what} of {name} is empty"));
            }
        }
        Sweep::read(&format!("{name}={from}:{to}:{count}"), &[Group::Motion])
    };
    let mut over = vec![sweep(name, from, to, count)?];
    if !second.is_empty() {
        over.push(sweep(second, from2, to2, count2)?);
    }
    scan_of(session, over, measures)
}

/// A scan of the motion on show; the window for `stability` is that of a phase plane on show. Fails with one
/// line that says what is wrong and what is allowed.
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
    /// The request of the scan while it is running.
    pub fn scan_request(&self) -> Option<Request> {
        self.scanned.as_ref()?.request()
    }

    /// Whether a plot with a scan has the focus.
    pub fn focuses_scan(&self) -> bool {
        match self.focus {
            Pane::Parameters => false,
            Pane::Plot(index) => self.plots.get(index).is_some_and(|plot| plot.view == View::Scan),
        }
    }
}
