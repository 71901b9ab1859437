//! Commands of the plots: cursor, zoom, pan, axes, and using the point under the cursor; and the mouse, for those who
//! want it.

use crate::flow::Problem;
use crate::model::State;
use crate::numerics::{StepSize, shortest};
use crate::scene::{Axes, ORDINATES, PlotSetup, Point, Span, Unit, View, Window};
use crate::session::act::general::flip;
use crate::session::act::motions::{drop_head, start};
use crate::session::act::parameters::{change, put};
use crate::session::act::screen_setup::focus_on;
use crate::session::act::{compare, history, lists, scan};
use crate::session::{
    Done, Effect, Framing, Gesture, MouseAction, Pane, Plot, PointerTarget, Session,
};

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
    let State { q, v } = session.problem.initial;
    let center = plot.window.center();
    let (x, y) = match plot.view {
        View::Phase => (q, v),
        View::Belt => (q, center.y),
        View::Diagram | View::BeltDiagram => (session.value(plot.axes.right(plot.view)), center.y),
        View::TimeSeries => (0.0, q),
        View::EnergyLedger => (0.0, 0.0),
        View::EnergyRate => (v, 0.0),
        View::ReturnMap => (q, q),
        View::Regimes => (session.value(plot.axes.abscissa), session.value(plot.axes.against)),
        _ => (center.x, center.y),
    };
    plot.window.clamp(Point { x, y })
}

/// Moves the cursor of the plot in focus; the first move shows it.
pub fn move_cursor(session: &mut Session, [right, up]: [i32; 2]) {
    let plot = &session.plots[session.plot];
    let Point { x, y } = plot.cursor.unwrap_or_else(|| cursor_origin(session, plot));
    let Window { x: across, y: along } = plot.window;
    let cursor = Point { x: moved(across, x, right), y: moved(along, y, up) };
    session.plots[session.plot].cursor = Some(cursor);
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
    session.plots[session.plot].cursor = Some(point);
    if session.view_in_use() == View::Phase {
        start_here(session)
    } else {
        Ok(())
    }
}

/// Stops what is under way; otherwise removes the cursor of the plot in focus; without one, takes the head of the motion away,
/// or lets go of the pinned point.
pub fn drop_cursor(session: &mut Session) {
    if session.writing.is_some() {
        session.effects.push(Effect::StopWriting);
    } else if session.is_fitting() {
        history::stop_fitting(session);
    } else if session.focuses_scan() {
        scan::stop(session);
    } else if session.focused().is_some_and(|plot| plot.cursor.is_some()) {
        session.plots[session.plot].cursor = None;
    } else if session.playback.at.is_some() {
        drop_head(session);
    } else {
        compare::let_go(session);
    }
}

/// Zooms the plot in focus about its cursor, or about its center.
pub fn zoom(session: &mut Session, closer: bool) {
    zoom_about(session, None, closer);
}

/// Zooms the plot in focus about a point, unless about its cursor or its center.
pub fn zoom_about(session: &mut Session, point: Option<Point>, closer: bool) {
    let factor = if closer { 1.0 / ZOOM } else { ZOOM };
    frame(session, |plot| {
        let Window { x, y } = plot.window;
        let about = point.or(plot.cursor).unwrap_or(plot.window.center());
        Window { x: x.scaled(about.x, factor), y: y.scaled(about.y, factor) }
    });
}

/// Moves the window of the plot in focus.
pub fn pan(session: &mut Session, [right, up]: [i32; 2]) {
    frame(session, |plot| {
        let Window { x, y } = plot.window;
        Window { x: x.shifted(PAN * f64::from(right)), y: y.shifted(PAN * f64::from(up)) }
    });
}

/// Gives the plot in focus a window chosen by the user.
fn frame(session: &mut Session, window: impl FnOnce(&Plot) -> Window) {
    let plot = &mut session.plots[session.plot];
    let after = window(plot);
    plot.framing = Framing::User;
    if std::mem::replace(&mut plot.window, after) == after {
        session.refuse("the window ends here: numbers closer or farther cannot be told apart");
    }
}

/// Fits the window of the plot in focus as soon as its content is computed.
pub fn fit(session: &mut Session) {
    session.plots[session.plot].framing = Framing::Fitting;
}

/// Resets the plot in focus to the scene's window and axes.
pub fn home(session: &mut Session) {
    let Plot { view, axes, cursor, .. } = session.plots[session.plot];
    let of_scene = session.plot_of_scene(session.plot, view);
    let opened = Plot::opened(&of_scene.unwrap_or(PlotSetup::fitting(view, axes)));
    session.plots[session.plot] = Plot { cursor, ..opened };
}

/// The cursor of the plot in focus. Fails with a line on how to get one.
fn cursor(session: &Session) -> Done<Point> {
    let text = "no cursor yet: {cursor-left}, {cursor-up} and so on show it";
    let cursor = session.focused().and_then(|plot| plot.cursor);
    cursor.ok_or_else(|| session.with_keys(text))
}

/// Selects the method and the accuracy of the row nearest to the cursor.
pub fn use_method(session: &mut Session) -> Done {
    cursor(session)?;
    let row = session.row_under_cursor(session.plot).ok_or("no method is compared here yet")?;
    let taken = Problem { method: row.problem.method, ..session.problem };
    let taken = taken.with_setting(row.problem.setting());
    session.measuring = true;
    change(session, taken);
    Ok(())
}

/// Starts a motion at the cursor, in the phase plane beside the present ones: at the state under the cursor, at
/// the state of the motion at that time, at rest at that displacement, or on that cycle.
pub fn start_here(session: &mut Session) -> Done {
    let Point { x, y } = cursor(session)?;
    let view = session.view_in_use();
    let initial = match view {
        View::TimeSeries => session.state_at(x),
        View::EnergyLedger => session.start_of_line(y),
        View::ReturnMap | View::Belt => Some(State { q: x, v: 0.0 }),
        View::EnergyRate => Some(State { v: x, ..session.problem.initial }),
        View::Phase => Some(State { q: x, v: y }),
        _ => return Ok(()),
    };
    let initial @ State { q, v } = initial.ok_or("there is no motion to start from here")?;
    // The phase plane shows motions beside each other; from another view, the other motions may be out of
    // sight.
    if view == View::Phase {
        start(session, initial);
    } else if change(session, Problem { initial, ..session.problem }) {
        session.inform(format!("q0 = {}, v0 = {}", shortest(q), shortest(v)));
    }
    Ok(())
}

/// Sets the number of a diagram, or both parameters of a chart, to the values under the cursor.
pub fn jump_here(session: &mut Session) -> Done {
    let Point { x, y } = cursor(session)?;
    let Plot { view, axes, .. } = session.plots[session.plot];
    let upwards = (view == View::Regimes).then_some((axes.against, y));
    let mut setup = session.setup();
    for (knob, value) in std::iter::once((axes.right(view), x)).chain(upwards) {
        setup = session.with(&setup, knob, value)?;
    }
    put(session, setup);
    Ok(())
}

/// Draws the diagram or the chart in focus over the next number to the right or upwards, cycling; both axes of a chart
/// always differ.
pub fn next_abscissa(session: &mut Session, upwards: bool) {
    let Plot { view, axes, .. } = session.plots[session.plot];
    let (right, against) = (axes.right(view), axes.against);
    let (present, other) = if upwards { (against, right) } else { (right, against) };
    let chart = view == View::Regimes;
    let all = session.abscissae(view);
    let place = all.iter().position(|knob| *knob == present).unwrap_or(0);
    let mut later = all.iter().copied().cycle().skip(place + 1);
    let Some(knob) = later.find(|knob| !(chart && *knob == other)) else { return };
    let axes = if upwards {
        Axes { against: knob, ..axes }
    } else {
        axes.with_right(view, knob)
    };
    if chart {
        // No scene sets a window for these axes: starts from the usual one, which is then fitted to include the
        // present point.
        let plot = &mut session.plots[session.plot];
        plot.axes = axes;
        plot.fit_from(PlotSetup::fitting(view, axes).opening());
    } else {
        set_axes(session, axes);
    }
    session.inform(format!("over {}: {}", knob.spec().name, knob.spec().meaning));
}

/// Gives the diagram in focus these axes: in the scene's window if they are the scene's, otherwise in one that is
/// fitted to the branch.
pub fn set_axes(session: &mut Session, axes: Axes) {
    let Plot { view, window, axes: present, .. } = session.plots[session.plot];
    let knob = axes.right(view);
    let of_scene = session.plot_of_scene(session.plot, view);
    let x = match of_scene {
        _ if knob == present.right(view) => window.x,
        Some(of) if of.axes.right(view) == knob => of.opening().x,
        _ => session.values_around(knob),
    };
    let plot = &mut session.plots[session.plot];
    if let Some(same) = of_scene.filter(|it| it.axes == axes && it.opening().x == x) {
        *plot = Plot::opened(&same);
    } else {
        plot.axes = axes;
        plot.fit_from(Window { x, y: plot.window.y });
    }
}

/// Shows the next property of the cycles, cycling; the branch stays.
pub fn next_ordinate(session: &mut Session) {
    let Plot { axes, .. } = session.plots[session.plot];
    let row = &ORDINATES[(axes.ordinate as usize + 1) % ORDINATES.len()];
    let axes = Axes { ordinate: row.ordinate, ..axes };
    set_axes(session, axes);
    session.inform(format!("{}: {}", axes.label(), row.meaning));
}

/// Switches lengths of the cycles between units of r and those of the equation; the branch stays.
pub fn next_unit(session: &mut Session) -> Done {
    let Plot { axes, .. } = session.plots[session.plot];
    let spec = axes.ordinate.spec();
    if spec.ratio.is_none() {
        return Err(format!("{} is not a length and has no unit", spec.label));
    }
    let (unit, units) = match axes.unit {
        Unit::One => (Unit::Friction, ", in units of r"),
        Unit::Friction => (Unit::One, ""),
    };
    let axes = Axes { unit, ..axes };
    set_axes(session, axes);
    session.inform(format!("{}: {}{units}", axes.label(), spec.meaning));
    Ok(())
}

/// Number of rows by which a notch of the wheel moves a list.
const NOTCH: isize = 3;

/// Turns the mouse on or off.
pub fn toggle_mouse(session: &mut Session) {
    let on = "mouse on: click to start or point, turn the wheel to zoom, hold shift to select text";
    flip(session, |it| &mut it.mouse, [on, "mouse off: the terminal selects text"]);
    session.effects.push(Effect::Mouse(session.display.mouse));
}

/// Handles an action of the mouse. Over an overlay, the wheel moves its list and clicks are ignored.
pub fn pointed(session: &mut Session, MouseAction { gesture, place }: MouseAction) -> Done {
    let covered = session.overlay.is_some();
    match (place, gesture) {
        (_, Gesture::Click) if covered => {}
        (_, Gesture::Nearer) if covered => lists::move_by(session, -NOTCH),
        (_, Gesture::Farther) if covered => lists::move_by(session, NOTCH),
        (PointerTarget::Row(index), Gesture::Click) => {
            if let Some(row) = session.rows().get(index) {
                session.selected = *row;
                session.focus = Pane::Parameters;
            }
        }
        (PointerTarget::Plot(index, point), _) if session.on_show().contains(&index) => {
            focus_on(session, Pane::Plot(index));
            match gesture {
                Gesture::Click => return point_at(session, point),
                Gesture::Nearer => zoom_about(session, Some(point), true),
                Gesture::Farther => zoom_about(session, Some(point), false),
            }
        }
        _ => {}
    }
    Ok(())
}
