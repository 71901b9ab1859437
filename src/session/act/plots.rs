//! Commands of the plots: cursor, zoom, pan, and using the point under the cursor.

use crate::flow::Problem;
use crate::model::Knob;
use crate::model::State;
use crate::numerics::decimal::shortest;
use crate::scene::{PlotSetup, Point, Span, View, Window};
use crate::session::act::notice::{inform, refuse, with_keys};
use crate::session::act::parameters::{change, put};
use crate::session::act::starts::start;
use crate::session::effect::{Done, Effect};
use crate::session::state::{Framing, Plot, Session, StepSize};

/// Number of cursor steps in a far move.
pub const FAR: i32 = 8;

/// Number of cursor steps across a window, about the columns of a plot at 80 columns.
///
/// Relative to the window and not to the screen, so that a keystroke file has the same effect on every screen.
const STEPS_ACROSS: f64 = 64.0;

/// Factor by which a zoom changes the width.
const ZOOM: f64 = 1.5;

/// Fraction of the width by which a pan moves.
const PAN: f64 = 0.125;

/// The position where the cursor of a plot first appears: the start of the motion, or the present value.
fn cursor_origin(session: &Session, plot: &Plot) -> Point {
    let window = plot.window;
    window.clamp(match plot.view {
        View::Phase => Point { x: session.problem.initial.q, y: session.problem.initial.v },
        View::Belt => Point { x: session.problem.initial.q, y: window.center().y },
        View::Diagram => Point { x: session.value(plot.axes.abscissa), y: window.center().y },
        View::TimeSeries => Point { x: 0.0, y: session.problem.initial.q },
        View::EnergyLedger => Point { x: 0.0, y: 0.0 },
        View::EnergyRate => Point { x: session.problem.initial.v, y: 0.0 },
        View::Speeds => Point {
            x: session.setting.map_or(window.center().x, |it| it.speed),
            y: window.center().y,
        },
        View::ReturnMap => Point { x: session.problem.initial.q, y: session.problem.initial.q },
        View::Regimes => {
            Point { x: session.value(plot.axes.abscissa), y: session.value(plot.axes.against) }
        }
        _ => window.center(),
    })
}

/// Moves the cursor of the plot in focus; the first move shows it.
pub fn move_cursor(session: &mut Session, right: i32, up: i32) {
    let origin = session.focused().map(|plot| cursor_origin(session, plot));
    if let Some((plot, origin)) = session.focused_mut().zip(origin) {
        let Point { x, y } = plot.cursor.unwrap_or(origin);
        let Window { x: across, y: along } = plot.window;
        plot.cursor = Some(Point { x: moved(across, x, right), y: moved(along, y, up) });
    }
}

/// A coordinate moved by some steps to a round number, within the window.
fn moved(span: Span, value: f64, count: i32) -> f64 {
    let step = StepSize::near(span.width() / STEPS_ACROSS);
    // The present start or value may not be round: a move by zero keeps it.
    if count == 0 {
        return value;
    }
    let goal = step.multiple_from(value, count);
    if span.contains(goal) {
        return goal;
    }
    // The last round number inside is one step before the first one outside.
    let edge = if count > 0 { span.to() } else { span.from() };
    let inside = step.multiple_from(step.multiple_from(edge, count.signum()), -count.signum());
    if span.contains(inside) { inside } else { value }
}

/// Handles a click on a point of the plot in focus: in the phase plane it starts a motion there, elsewhere it
/// moves the cursor there.
pub fn point_at(session: &mut Session, point: Point) -> Done {
    let Some(plot) = session.focused_mut() else { return Ok(()) };
    plot.cursor = Some(point);
    if plot.view == View::Phase { start_here(session) } else { Ok(()) }
}

/// Removes the cursor of the plot in focus.
pub fn drop_cursor(session: &mut Session) {
    if session.writing.is_some() {
        session.effects.push(Effect::StopWriting);
    } else if session.is_fitting() {
        super::history::stop_fitting(session);
    } else if session.focuses_scan() {
        super::scan::stop(session);
    } else if let Some(plot) = session.focused_mut() {
        plot.cursor = None;
    }
}

/// Zooms the plot in focus about its cursor, or about its center.
pub fn zoom(session: &mut Session, closer: bool) {
    zoom_about(session, |plot| plot.cursor.unwrap_or(plot.window.center()), closer);
}

/// Zooms the plot in focus about a point.
pub fn zoom_about(session: &mut Session, about: impl FnOnce(&Plot) -> Point, closer: bool) {
    let factor = if closer { 1.0 / ZOOM } else { ZOOM };
    frame(session, |plot| {
        let (Window { x, y }, about) = (plot.window, about(plot));
        Window { x: x.scaled(about.x, factor), y: y.scaled(about.y, factor) }
    });
}

/// Moves the window of the plot in focus.
pub fn pan(session: &mut Session, right: i32, up: i32) {
    frame(session, |plot| {
        let Window { x, y } = plot.window;
        Window { x: x.shifted(PAN * f64::from(right)), y: y.shifted(PAN * f64::from(up)) }
    });
}

/// Gives the plot in focus a window chosen by the user.
fn frame(session: &mut Session, window: impl FnOnce(&Plot) -> Window) {
    let framed = session.focused_mut().map(|plot| {
        let (before, after) = (plot.window, window(plot));
        (plot.window, plot.framing) = (after, Framing::User);
        before != after
    });
    if framed == Some(false) {
        refuse(session, "the window ends here: numbers closer or farther cannot be told apart");
    }
}

/// Fits the window of the plot in focus as soon as its content is computed.
pub fn fit(session: &mut Session) {
    if let Some(plot) = session.focused_mut() {
        plot.framing = Framing::Fitting;
    }
}

/// Resets the plot in focus to the scene's window and axes.
pub fn home(session: &mut Session) {
    let index = session.plot;
    let Some(plot) = session.focused() else { return };
    let usual = PlotSetup { view: plot.view, axes: plot.axes, window: None, family: None };
    let plot_setup = session.plot_of_scene(index, plot.view).unwrap_or(usual);
    if let Some(plot) = session.focused_mut() {
        let cursor = plot.cursor;
        *plot = Plot::opened(&plot_setup);
        plot.cursor = cursor;
    }
}

/// The cursor of the plot in focus. Fails with a line on how to get one.
fn cursor(session: &Session) -> Result<Point, String> {
    let text = "no cursor yet: {cursor-left}, {cursor-up} and so on show it";
    let cursor = session.focused().and_then(|plot| plot.cursor);
    cursor.ok_or_else(|| with_keys(session, text))
}

/// Selects the method and the accuracy of the row nearest to the cursor.
pub fn use_method(session: &mut Session) -> Done {
    cursor(session)?;
    let row = session.row_under_cursor(session.plot).ok_or("no method is compared here yet")?;
    let row = row.problem;
    let taken = Problem { method: row.method, ..session.problem };
    session.measuring = true;
    change(session, taken.with_setting(row.setting()));
    Ok(())
}

/// Sets the belt to the speed under the cursor.
pub fn take_speed(session: &mut Session) -> Done {
    let Point { x, .. } = cursor(session)?;
    let setup = session.with(&session.setup(), Knob::BeltSpeed, x)?;
    put(session, &setup);
    Ok(())
}

/// Starts a motion at the cursor, in the phase plane beside the present ones: at the state under the cursor, at
/// the state of the motion at that time, at rest at that displacement, or on that cycle.
pub fn start_here(session: &mut Session) -> Done {
    let Point { x, y } = cursor(session)?;
    let initial = match session.focused().map(|plot| plot.view) {
        Some(View::TimeSeries) => session.state_at(x),
        Some(View::EnergyLedger) => session.start_of_line(y),
        Some(View::ReturnMap | View::Belt) => Some(State { q: x, v: 0.0 }),
        Some(View::EnergyRate) => Some(State { v: x, ..session.problem.initial }),
        Some(View::Phase) => Some(State { q: x, v: y }),
        _ => return Ok(()),
    };
    let initial = initial.ok_or("there is no motion to start from here")?;
    let State { q, v } = initial;
    // The phase plane shows motions beside each other; from another view, the other motions may be out of
    // sight.
    if session.focused().is_some_and(|plot| plot.view == View::Phase) {
        start(session, initial);
    } else if change(session, Problem { initial, ..session.problem }) {
        inform(session, format!("q0 = {}, v0 = {}", shortest(q), shortest(v)));
    }
    Ok(())
}

/// Sets the parameter of a diagram, or both of a chart, to the values under the cursor.
pub fn jump_here(session: &mut Session) -> Done {
    let cursor = cursor(session)?;
    let Plot { view, axes, .. } = session.plots[session.plot];
    let upwards = (view == View::Regimes).then_some((axes.against, cursor.y));
    let mut problem = session.problem;
    for (symbol, value) in [(axes.abscissa, cursor.x)].into_iter().chain(upwards) {
        symbol.set(&mut problem.parameters, &mut problem.initial, symbol.check(value)?);
    }
    change(session, problem);
    Ok(())
}
