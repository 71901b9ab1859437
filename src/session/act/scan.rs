//! Scans: starting and stopping, moving over the points, and using one of them.

use crate::flow::{Problem, Subject};
use crate::model::{Knob, KnobSpec, State};
use crate::numerics::cycled;
use crate::scan::{Measure, Scan, Sweep, is_regime};
use crate::scene::{Request, View};
use crate::session::act::parameters::put;
use crate::session::act::screen_setup::{add, focus_on, show};
use crate::session::{
    Content, Done, Effect, Overlay, Pane, Plot, Prompt, SCANNING, ScanOnShow, ScanProgress, Session,
};
use crate::words::{joined, resolved};

/// The file in which a key saves the rows; the command line takes any name.
pub const FILE: &str = "scan.csv";

/// Opens the command line with the last scan; before the first one, with one over the parameter of a diagram on show,
/// otherwise over the selected parameter around its value.
pub fn open(session: &mut Session) {
    let groups = session.scanned_groups();
    let has = |scan: &Scan| scan.over().iter().all(|it| groups.contains(&it.symbol.spec().group));
    let last = session.scanned.as_ref().filter(|it| has(&it.scan));
    let last = last.map_or_else(|| usual(session), |scanned| typed(&scanned.scan));
    session.overlay = Some(Overlay::Prompt(Prompt::new(format!("scan {last}"))));
}

/// A scan as it is typed.
fn typed(scan: &Scan) -> String {
    let over = scan.over().iter().map(ToString::to_string);
    let measures = scan.measures().iter().map(|measure| measure.spec().name);
    joined(over.chain([joined(measures, ",")]), " ")
}

fn usual(session: &Session) -> String {
    /// Part of a range to which its ends are rounded, so that they are short to read and to change.
    const ROUND: f64 = 1e-3;
    let over = |knob: Knob, ends: [f64; 2]| {
        let [from, to] = ends.map(|end| resolved(end, ROUND * (ends[1] - ends[0])));
        format!("{knob}={from}:{to}:100 from-rest")
    };
    let whole = session.draws_whole();
    let view = if whole { View::BeltDiagram } else { View::Diagram };
    if let Some(diagram) = session.plots.iter().find(|plot| plot.view == view) {
        let symbol = diagram.axes.right(view);
        if let Some(span) = diagram.window.x.allowed(symbol) {
            return over(symbol, span.ends());
        }
    }
    let symbol = session.selected.knob_in(&session.problem);
    if whole {
        let knob = if symbol.is_of_machine() {
            symbol
        } else {
            Knob::BeltSpeed
        };
        return over(knob, session.values_around(knob).ends());
    }
    if !Knob::MOTION.contains(&symbol) {
        return over(Knob::D, [-0.9, 0.0]);
    }
    let KnobSpec { min, max, step, .. } = *symbol.spec();
    let (value, reach) = (session.value(symbol), 10.0 * step);
    over(symbol, [(value - reach).max(min), (value + reach).min(max)])
}

/// Starts a scan and shows it in a plot that already shows scans, otherwise beside the phase plane.
pub fn start(session: &mut Session, scan: Scan) {
    session.scanned = Some(ScanOnShow::begun(scan));
    match session.on_show().find(|index| session.plots[*index].view == View::Scan) {
        Some(index) => focus_on(session, Pane::Plot(index)),
        None => beside(session),
    }
    refit(session);
    session.inform(SCANNING);
}

/// Shows the scan beside the phase plane to which its points are applied: in the plot in use, in another one,
/// or in a new one.
fn beside(session: &mut Session) {
    let is_plane = |plot: &Plot| plot.view == View::Phase;
    session.enlarged = false;
    let planes = session.plots.iter().filter(|plot| is_plane(plot)).count();
    if is_plane(&session.plots[session.plot]) && planes == 1 {
        match session.plots.iter().position(|plot| !is_plane(plot)) {
            Some(index) => focus_on(session, Pane::Plot(index)),
            None => drop(add(session)),
        }
    }
    show(session, View::Scan);
}

/// Stops the scan, and keeps the rows so far.
pub fn stop(session: &mut Session) {
    if let Some(scanned) = session.scanned.as_mut().filter(|it| it.request().is_some()) {
        scanned.progress = ScanProgress::Stopped;
        let (rows, points) = (scanned.rows.len(), scanned.scan.points());
        let text = format!("stopped: {rows} of {points} rows; {{scan-pause}} continues");
        session.inform_of_keys(&text);
    }
}

/// The scan on show. Fails with one line if there is none.
fn scanned(session: &mut Session) -> Done<&mut ScanOnShow> {
    session.scanned.as_mut().ok_or_else(|| "there is no scan".to_owned())
}

/// Stops a running scan, or continues a stopped one.
pub fn pause(session: &mut Session) -> Done {
    let scanned = scanned(session)?;
    match scanned.progress {
        ScanProgress::Running { .. } => stop(session),
        ScanProgress::Stopped => {
            scanned.progress = ScanProgress::Running { from: scanned.rows.len() };
            session.inform(SCANNING);
        }
        ScanProgress::Done => session.inform("the scan is done"),
    }
    Ok(())
}

/// Plots the next measured column; how a margin is to be read is told where it has no size, and not plotted by itself.
pub fn next_column(session: &mut Session, by: isize) -> Done {
    let scanned = scanned(session)?;
    let columns = scanned.scan.measured();
    let plotted: Vec<usize> = (0..columns.len()).filter(|at| !is_regime(columns[*at])).collect();
    let place = plotted.iter().position(|at| *at == scanned.column).unwrap_or(0);
    scanned.column = plotted[cycled(place, by, plotted.len())];
    refit(session);
    Ok(())
}

/// Switches between the table of the rows and their plot.
pub fn table(session: &mut Session) -> Done {
    let scanned = scanned(session)?;
    scanned.table = !scanned.table;
    Ok(())
}

/// Shows all points so far.
pub fn refit(session: &mut Session) {
    let Some(scanned) = &session.scanned else { return };
    let window = scanned.window();
    for plot in session.plots.iter_mut().filter(|plot| plot.view == View::Scan) {
        plot.window = window;
    }
}

/// Moves over the points, computed or not: `right` along the axis to the right, `up` along the other axis of a
/// grid. In a table and along a line, both move along the rows.
pub fn go(session: &mut Session, [right, up]: [isize; 2]) -> Done {
    let scanned = scanned(session)?;
    let last = scanned.scan.points().saturating_sub(1);
    let over = scanned.scan.over();
    if scanned.table || !scanned.is_grid() {
        scanned.at = scanned.at.saturating_add_signed(right.saturating_sub(up)).min(last);
        return Ok(());
    }
    let columns: usize = over[1..].iter().map(|sweep| sweep.count).product();
    let step: usize = over[2..].iter().map(|sweep| sweep.count).product();
    let (column, row) = (scanned.at / columns, scanned.at % columns);
    let column = column.saturating_add_signed(right).min(over[0].count - 1);
    let row = row.saturating_add_signed(up.saturating_mul(step.cast_signed())).min(columns - 1);
    scanned.at = (column * columns + row).min(last);
    Ok(())
}

/// Sets the numbers on show to those of the selected point.
pub fn take(session: &mut Session) -> Done {
    let scanned = scanned(session)?;
    let sweeps = scanned.scan.over().iter().zip(scanned.scan.place(scanned.at));
    let taken: Vec<_> = sweeps.map(|(sweep, it)| (sweep.symbol, sweep.value(it))).collect();
    take_values(session, &taken)
}

/// Sets these numbers, as one change.
pub fn take_values(session: &mut Session, taken: &[(Knob, f64)]) -> Done {
    let mut setup = session.setup();
    // A number of the machine leads back onto its path: what was changed by hand is set there before.
    for (knob, value) in session.changed_by_hand().iter().chain(taken) {
        setup = session.with(&setup, *knob, *value)?;
    }
    put(session, setup);
    let said = taken.iter().map(|(knob, value)| format!("{knob} = {}", knob.print(*value)));
    session.inform(joined(said, ", "));
    Ok(())
}

/// Writes the rows so far to a file, in the form of the command `scan`. Fails with one line if there is no scan.
pub fn save(session: &mut Session, path: &str) -> Done {
    let ScanOnShow { scan, rows, .. } = scanned(session)?.clone();
    let content = Content::Scan(scan, rows);
    session.effect(Effect::Write { path: path.into(), content, replace: false })
}

/// Starts the scan `NAME=FROM:TO:COUNT .. MEASURE,..`. Fails with one line that says what is wrong and what is
/// allowed.
pub fn scan(session: &mut Session, rest: &str) -> Done {
    let (sweeps, measures): (Vec<&str>, Vec<&str>) =
        rest.split_whitespace().partition(|word| word.contains('='));
    let groups = session.scanned_groups();
    let over = sweeps.into_iter().map(|text| Sweep::read(text, groups));
    let over = over.collect::<Result<Vec<_>, _>>()?;
    let measures = if measures.is_empty() {
        "from-rest".to_owned()
    } else {
        measures.join(",")
    };
    let measures = measures.split(',').map(|name| Measure::named(name.trim()));
    let measures = measures.collect::<Result<Vec<_>, _>>()?;
    // Of a machine by the model that is drawn.
    let (source, units) = session.source(&session.problem.parameters);
    let conditions = session.conditions(units.displacement, units.velocity);
    let (Some(belt), Some(running)) = (source.of_belt(), session.running()) else {
        start(session, Scan::new(session.problem, over, measures, conditions)?);
        return Ok(());
    };
    let asks = measures.iter().any(|it| matches!(it, Measure::Guaranteed | Measure::Design));
    let tolerances = asks.then(|| session.doubt.on_machine(running, belt)).transpose()?;
    let tolerances = tolerances.unwrap_or_default();
    let Problem { initial: State { q, v }, until, .. } = session.problem;
    let from = (q * units.displacement, v * units.velocity);
    let subject = Subject::moving(source, tolerances, from, until * units.time);
    start(session, Scan::new(subject, over, measures, conditions)?);
    Ok(())
}

impl Session {
    /// The request of the scan while it is running.
    pub fn scan_request(&self) -> Option<Request> {
        self.scanned.as_ref()?.request()
    }

    /// Whether a plot with a scan has the focus.
    pub fn focuses_scan(&self) -> bool {
        self.focused().is_some_and(|plot| plot.view == View::Scan)
    }
}
