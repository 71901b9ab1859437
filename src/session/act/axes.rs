//! Commands that change the axes of diagrams and charts.

use crate::model::Knob;
use crate::scene::ordinate::usual_values;
use crate::scene::{Axes, ORDINATES, PlotSetup, Span, Unit, View, Window};
use crate::session::act::notice::inform;
use crate::session::effect::Done;
use crate::session::state::{Plot, Session};

/// Factor for room beside the present value if it lies outside of the first range.
const ROOM: f64 = 1.25;

/// The parameter that many places later in the table, cycling.
fn after(parameter: Knob, places: usize) -> Knob {
    Knob::PARAMETERS[(parameter.place() + places) % Knob::PARAMETERS.len()]
}

/// Draws the diagram in focus over the next parameter, cycling; this needs another branch.
pub fn next_abscissa(session: &mut Session) {
    let Some(plot) = session.focused() else { return };
    let axes = plot.axes;
    let symbol = after(axes.abscissa, 1);
    set(session, Axes { abscissa: symbol, ..axes });
    inform(session, format!("over {}: {}", symbol.spec().name, symbol.spec().meaning));
}

/// Draws the chart in focus over the next parameter to the right or upwards; both axes always differ.
pub fn next_of_chart(session: &mut Session, upwards: bool) {
    let Some(plot) = session.focused_mut() else { return };
    let Axes { abscissa, against, .. } = plot.axes;
    let (present, other) = if upwards { (against, abscissa) } else { (abscissa, against) };
    let next = after(present, 1);
    let symbol = if next == other { after(present, 2) } else { next };
    let axis = if upwards { &mut plot.axes.against } else { &mut plot.axes.abscissa };
    *axis = symbol;
    // No scene sets a window for these axes: starts from the usual one, which is then fitted to include the
    // present point.
    plot.fit_from(
        PlotSetup { view: plot.view, axes: plot.axes, window: None, family: plot.family }.opening(),
    );
    inform(session, format!("over {}: {}", symbol.spec().name, symbol.spec().meaning));
}

/// Gives the diagram in focus these axes.
pub fn set(session: &mut Session, axes: Axes) {
    let Some(plot) = session.focused() else { return };
    let symbol = axes.abscissa;
    if symbol == plot.axes.abscissa {
        let x = plot.window.x;
        reframe(session, axes, x);
        return;
    }
    let usual = usual_values(symbol);
    let reach = ROOM * session.value(symbol);
    let around = Span::covering([usual.from(), usual.to(), reach]).unwrap_or(usual);
    let of_scene = of_scene(session).filter(|plot_setup| plot_setup.axes.abscissa == symbol);
    let x = of_scene.map_or(around, |plot_setup| plot_setup.opening().x);
    reframe(session, axes, x);
}

/// Shows the next property of the cycles, cycling; the branch stays.
pub fn next_ordinate(session: &mut Session) {
    let Some(plot) = session.focused() else { return };
    let row = &ORDINATES[(plot.axes.ordinate as usize + 1) % ORDINATES.len()];
    let axes = Axes { ordinate: row.ordinate, ..plot.axes };
    set(session, axes);
    inform(session, format!("{}: {}", axes.label(), row.meaning));
}

/// Switches lengths of the cycles between units of r and those of the equation; the branch stays.
pub fn next_unit(session: &mut Session) -> Done {
    let plot = &session.plots[session.plot];
    let (spec, unit) = (plot.axes.ordinate.spec(), plot.axes.unit);
    if spec.ratio.is_none() {
        return Err(format!("{} is not a length and has no unit", spec.label));
    }
    let unit = if unit == Unit::One { Unit::Friction } else { Unit::One };
    let axes = Axes { unit, ..plot.axes };
    set(session, axes);
    let units = if unit == Unit::One { "" } else { ", in units of r" };
    inform(session, format!("{}: {}{units}", axes.label(), spec.meaning));
    Ok(())
}

/// The scene's setup for the diagram in focus.
fn of_scene(session: &Session) -> Option<PlotSetup> {
    session.plot_of_scene(session.plot, View::Diagram)
}

/// Applies the scene's window if the axes are the scene's, otherwise fits the window to the branch.
fn reframe(session: &mut Session, axes: Axes, x: Span) {
    let of_scene = of_scene(session).filter(|plot_setup| plot_setup.axes == axes);
    let Some(plot) = session.focused_mut() else { return };
    if let Some(plot_setup) = of_scene.filter(|plot_setup| plot_setup.opening().x == x) {
        *plot = Plot::opened(&plot_setup);
    } else {
        plot.axes = axes;
        plot.fit_from(Window { x, y: plot.window.y });
    }
}
