//! Scans: the form, starting and stopping, moving over the points, and using one of them.

use crate::model::{Group, Knob};
use crate::numerics::decimal::shortest;
use crate::portrait::basin;
use crate::scan::grid::Scan;
use crate::scan::measure::Measure;
use crate::scan::sweep::Sweep;
use crate::scene::{Request, Span, View};
use crate::session::act::parameters::change;
use crate::session::act::screen_setup::{add, focus_on, show};
use crate::session::act::{inform, inform_of_keys};
use crate::session::scan::SCANNING;
use crate::session::{
    Done, Effect, Input, Overlay, Pane, Plot, ScanForm, ScanOnShow, ScanProgress, Session,
};

/// The file in which a key saves the rows; the command line takes any name.
pub const FILE: &str = "scan.csv";

/// Number of rows that the page keys move by.
pub const PAGE: isize = 10;

/// Opens the form as it was last filled in, or a new one.
pub fn open(session: &mut Session) {
    let form = session.scan_form.clone().unwrap_or_else(|| fresh(session));
    session.overlay = Some(Overlay::Scan(ScanForm { refused: None, ..form }));
}

/// A new form, over the parameter of a diagram on show, otherwise over the selected parameter around its value.
fn fresh(session: &Session) -> ScanForm {
    if let Some(diagram) = session.plots.iter().find(|plot| plot.view == View::Diagram) {
        let symbol = diagram.axes.abscissa;
        let (spec, x) = (symbol.spec(), diagram.window.x);
        if let Some(span) = x.within(spec.min, spec.max) {
            return ScanForm::new(symbol, (span.from(), span.to()));
        }
    }
    let symbol = session.selected.knob_in(&session.problem);
    if !Knob::MOTION.contains(&symbol) {
        return ScanForm::new(Knob::D, (-0.9, 0.0));
    }
    let (spec, value) = (symbol.spec(), session.value(symbol));
    let reach = 10.0 * spec.step;
    ScanForm::new(symbol, ((value - reach).max(spec.min), (value + reach).min(spec.max)))
}

fn form(session: &mut Session) -> Option<&mut ScanForm> {
    match &mut session.overlay {
        Some(Overlay::Scan(form)) => Some(form),
        _ => None,
    }
}

/// Goes to another field, cycling.
pub fn go_to_field(session: &mut Session, by: isize) {
    if let Some(form) = form(session) {
        let count = form.inputs.len();
        form.at = form.at.checked_add_signed(by).unwrap_or(count - 1) % count;
    }
}

/// Selects the next choice of a field that has choices; otherwise moves the caret.
pub fn sideways(session: &mut Session, by: isize) {
    let Some(form) = form(session) else { return };
    let mut choices = ScanForm::choices(form.at);
    // Both sweeps need different parameters.
    let other = form.inputs[if form.at == 0 { ScanForm::SECOND } else { 0 }].text();
    choices.retain(|choice| choice.is_empty() || *choice != other.trim());
    if choices.is_empty() {
        form.input_mut().move_caret(by);
        return;
    }
    form.refused = None;
    let now = choices.iter().position(|choice| *choice == form.input_mut().text());
    let next = match now {
        Some(now) => now.checked_add_signed(by).unwrap_or(choices.len() - 1) % choices.len(),
        None => 0,
    };
    *form.input_mut() = Input::new(choices[next]);
}

/// Starts the scan described by the form, or says in the form why it cannot.
pub fn accept(session: &mut Session) {
    let Some(Overlay::Scan(filled)) = session.overlay.clone() else { return };
    match typed(&filled, session) {
        Ok(scan) => {
            session.overlay = None;
            session.scan_form = Some(filled);
            start(session, scan);
        }
        Err(why) => {
            if let Some(form) = form(session) {
                form.refused = Some(why);
            }
        }
    }
}

/// Starts a scan and shows it in a plot that already shows scans, otherwise beside the phase plane.
pub fn start(session: &mut Session, scan: Scan) {
    session.scanned = Some(ScanOnShow::begun(scan));
    let mut shown = session.on_show().filter(|index| session.plots[*index].view == View::Scan);
    match shown.next() {
        Some(index) => focus_on(session, Pane::Plot(index)),
        None => beside(session),
    }
    refit(session);
    inform(session, SCANNING);
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
    let Some(scanned) = &mut session.scanned else { return };
    if scanned.request().is_some() {
        scanned.progress = ScanProgress::Stopped;
        let (rows, points) = (scanned.rows.len(), scanned.scan.points());
        let text = format!("stopped: {rows} of {points} rows; {{scan-pause}} continues");
        inform_of_keys(session, &text);
    }
}

/// The scan on show. Fails with one line if there is none.
fn scanned(session: &mut Session) -> Result<&mut ScanOnShow, String> {
    session.scanned.as_mut().ok_or_else(|| "there is no scan".to_owned())
}

/// Stops a running scan, or continues a stopped one.
pub fn pause(session: &mut Session) -> Done {
    let scanned = scanned(session)?;
    match scanned.progress {
        ScanProgress::Running { .. } => stop(session),
        ScanProgress::Stopped => {
            scanned.progress = ScanProgress::Running { from: scanned.rows.len() };
            inform(session, SCANNING);
        }
        ScanProgress::Done => inform(session, "the scan is done"),
    }
    Ok(())
}

/// Plots the next measured column.
pub fn next_column(session: &mut Session, by: isize) -> Done {
    let scanned = scanned(session)?;
    let count = scanned.scan.measured().len();
    scanned.column = scanned.column.checked_add_signed(by).unwrap_or(count - 1) % count;
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
pub(crate) fn refit(session: &mut Session) {
    let Some(scanned) = &session.scanned else { return };
    let window = scanned.window();
    for plot in session.plots.iter_mut().filter(|plot| plot.view == View::Scan) {
        plot.window = window;
    }
}

/// Moves over the points, computed or not: `right` along the axis to the right, `up` along the other axis of a
/// grid. In a table and along a line, both move along the rows.
pub fn go(session: &mut Session, right: isize, up: isize) -> Done {
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

/// Sets the motion on show to the parameters of the selected point.
pub fn take(session: &mut Session) -> Done {
    let mut problem = session.problem;
    let scanned = scanned(session)?;
    let taken = scanned.scan.problem(scanned.at).unwrap_or(problem);
    let mut said = Vec::new();
    for Sweep { symbol, .. } in scanned.scan.over() {
        let value = taken.get(*symbol);
        problem.set(*symbol, value);
        said.push(format!("{symbol} = {}", shortest(value)));
    }
    change(session, problem);
    inform(session, said.join(", "));
    Ok(())
}

/// Writes the rows so far to a file, in the form of the command `scan`. Fails with one line if there is no scan.
pub fn save(session: &mut Session, path: &str) -> Done {
    let ScanOnShow { scan, rows, .. } = scanned(session)?.clone();
    session.effects.push(Effect::SaveScan { path: path.into(), scan, rows });
    Ok(())
}

/// Starts the scan `NAME=FROM:TO:COUNT .. MEASURE,..`. Fails with one line that says what is wrong and what is
/// allowed.
pub fn scan(session: &mut Session, rest: &str) -> Done {
    let (sweeps, measures): (Vec<&str>, Vec<&str>) =
        rest.split_whitespace().partition(|word| word.contains('='));
    let over = sweeps.into_iter().map(|text| Sweep::read(text, &[Group::Motion]));
    let over = over.collect::<Result<Vec<_>, _>>()?;
    let measures = if measures.is_empty() { "from-rest".to_owned() } else { measures.join(",") };
    let scan = scan_of(session, over, &measures)?;
    start(session, scan);
    Ok(())
}

/// The scan of the motion on show that the form describes. Fails with one line that says what is wrong and what
/// is allowed.
fn typed(form: &ScanForm, session: &Session) -> Result<Scan, String> {
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
fn scan_of(session: &Session, over: Vec<Sweep>, measures: &str) -> Result<Scan, String> {
    let measures = measures.split(',').map(|name| Measure::named(name.trim()));
    let measures = measures.collect::<Result<Vec<_>, _>>()?;
    let plane = session.plots.iter().find(|plot| plot.view == View::Phase);
    let window = plane.map_or(View::Phase.spec().window, |plot| plot.window);
    let ends = |span: Span| (span.from(), span.to());
    let window = basin::StartWindow { q: ends(window.x), v: ends(window.y) };
    Scan::new(session.problem, over, measures, window)
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
