//! Lines that set values: parameters, scenes, views, layers, marks and appearance.

use std::sync::Arc;

use crate::model::{Knob, unknown};
use crate::numerics::named;
use crate::portrait::RandomKick;
use crate::scan::LevelTarget;
use crate::scan::MEASURES;
use crate::scene::{
    Axes, LAYERS, Layer, ORDINATES, ScaledMachine, Span, VIEWS, View, Window, find, machine,
};
use crate::session::act::{general, history, parameters, plots, screen_setup};
use crate::session::read::completion::{difference, properties, rows};
use crate::session::{Done, Framing, MOST_HARMONICS, Pane, Plot, Row, Session};
use crate::words::{joined, one_of};

/// The row of the parameter pane with this name.
fn row_named(session: &Session, name: &str) -> Done<Row> {
    // The command that sets only this row has that name.
    let name = if name == "tol" { Row::Tolerance.name() } else { name };
    let found = rows(session).find(|row| row.name() == name);
    found.ok_or_else(|| unknown(name, &rows(session).map(Row::name).collect::<Vec<_>>()))
}

/// Sets the numbers of a text that was copied, as one change; what it says of results is left out.
pub fn paste(session: &mut Session, text: &str) -> Done {
    let results = MEASURES.iter().flat_map(|row| row.columns.iter().copied());
    let results =
        results.chain(VIEWS.iter().flat_map(|row| [row.coordinates.0, row.coordinates.1]));
    let results = results.chain(ORDINATES.iter().map(|row| row.name)).chain(["v_min"]);
    let results: Vec<&str> = results.filter(|name| row_named(session, name).is_err()).collect();
    let (text, mut taken) = (spaced(text), true);
    let words = text.split_whitespace().filter(|word| {
        taken = word.split_once('=').map_or(taken, |(name, _)| !results.contains(&name));
        taken
    });
    let before = session.setup();
    set(session, &joined(words, " ")).map_err(|why| format!("pasted: {why}"))?;
    if session.notice.is_none() {
        let changed = difference(&before, &session.setup());
        let said = [&*changed, "nothing differs"].into_iter().find(|text| !text.is_empty());
        session.inform(format!("pasted: {}", said.unwrap_or_default()));
    }
    Ok(())
}

/// Assignments with nothing around their signs, and no commas between them.
fn spaced(text: &str) -> String {
    let text = text.replace('=', " = ");
    let words = text.split_whitespace().map(|word| word.trim_end_matches([',', ';']));
    joined(words, " ").replace(" = ", "=")
}

/// Runs `NAME=VALUE ..` as one change. A word without `=` is the unit of the value before it.
pub fn set(session: &mut Session, rest: &str) -> Done {
    let rest = &spaced(rest);
    let mut given: Vec<(&str, String)> = Vec::new();
    let takes_unit = |row: Row| row.is_of_machine() || row == Row::Number(Knob::Disturbance);
    for word in rest.split_whitespace() {
        match (word.split_once('='), given.last_mut()) {
            (Some((name, value)), _) => given.push((name, value.to_owned())),
            (None, Some((name, value))) if row_named(session, name).is_ok_and(takes_unit) => {
                *value = format!("{value} {word}");
            }
            (None, _) => return Err(format!("{word:?} is not NAME=VALUE, such as D=-0.3")),
        }
    }
    assign(session, given)
}

/// Sets the value of one row.
pub fn set_row(session: &mut Session, row: &str, value: &str) -> Done {
    assign(session, vec![(row, value.to_owned())])
}

fn assign(session: &mut Session, given: Vec<(&str, String)>) -> Done {
    let mut setup = session.setup();
    for (name, value) in given {
        setup = parameters::read(session, &setup, row_named(session, name)?, &value)?;
    }
    parameters::put(session, setup);
    session.warn_of_units();
    Ok(())
}

/// Opens a scene.
pub fn scene(session: &mut Session, name: &str) -> Done {
    history::open_scene(session, find(name)?);
    Ok(())
}

/// Opens a built-in machine.
pub fn belt(session: &mut Session, name: &str) -> Done {
    let machine = machine::library::find(name)?.clone();
    let scaled = ScaledMachine::try_from(machine).map_err(|error| format!("{name}: {error}"))?;
    history::open_scene(session, Arc::new(scaled.scene()));
    Ok(())
}

/// Shows a view in the plot in use.
pub fn view(session: &mut Session, name: &str) -> Done {
    let view = one_of("view", name, VIEWS.iter().map(|row| (row.name, row.view)))?;
    screen_setup::show(session, view);
    Ok(())
}

/// Switches a layer on or off, or toggles it.
pub fn layer(session: &mut Session, rest: &str) -> Done {
    let (name, state) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
    let rows = LAYERS.iter().map(|row| (row.name, row.layer));
    let layer = named(name).map_or_else(|| one_of("layer", name, rows), Ok)?;
    let state = state.trim();
    if state.is_empty() || is_on(name, state)? != session.layers.contains(&layer) {
        general::toggle(session, layer);
    }
    Ok(())
}

/// Sets the window of the plot in use.
pub fn window(session: &mut Session, rest: &str) -> Done {
    let form = || format!("{rest:?} is not X0:X1,Y0:Y1, such as -2:2,-1:1");
    let (x, y) = rest.split_once(',').ok_or_else(form)?;
    let span = |text: &str| {
        let (from, to) = text.split_once(':').ok_or_else(form)?;
        let number = |text: &str| text.trim().parse::<f64>().map_err(|_| form());
        Span::new(number(from)?, number(to)?)
    };
    let window = Window { x: span(x)?, y: span(y)? };
    let plot = &mut session.plots[session.plot];
    (plot.window, plot.framing) = (window, Framing::User);
    Ok(())
}

/// Sets the axes of the diagram in use: a number, and, unless it is one of a machine, optionally a property of the cycles.
pub fn axes(session: &mut Session, rest: &str) -> Done {
    let (over, property) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
    let index = session.diagram().ok_or("no plot shows a diagram; view diagram makes one")?;
    let Plot { view, axes, .. } = session.plots[index];
    let rows = session.abscissae(view).into_iter().map(|knob| (knob.spec().name, knob));
    let right = one_of("diagram over", over, rows)?;
    if view == View::BeltDiagram && !property.trim().is_empty() {
        return Err(format!("a machine's diagram shows x_max; allowed: {over} alone"));
    }
    let (ordinate, unit) = match property.trim() {
        "" => (axes.ordinate, axes.unit),
        name => {
            let rows: Vec<_> = properties().collect();
            one_of("property", name, rows.iter().map(|(name, row)| (name.as_str(), *row)))?
        }
    };
    screen_setup::focus_on(session, Pane::Plot(index));
    plots::set_axes(session, Axes { ordinate, unit, ..axes.with_right(view, right) });
    Ok(())
}

/// Shows the cycles by N harmonics.
pub fn harmonics(session: &mut Session, rest: &str) -> Done {
    let count = rest.parse().ok().filter(|count| (1..=MOST_HARMONICS).contains(count));
    let refused = || format!("{rest:?} is not a number of harmonics from 1 to {MOST_HARMONICS}");
    general::balance(session, count.ok_or_else(refused)?);
    Ok(())
}

/// Shows random kicks over the basin; of a machine, in metres and metres per second.
pub fn kicks(session: &mut Session, rest: &str) -> Done {
    let units = session.running().map(|running| running.reduced.units);
    let kicks = RandomKick::read(rest, if units.is_some() { ["m", "m/s"] } else { ["", ""] })?;
    session.kicks = match units {
        Some(units) => kicks.in_units(units.displacement, units.velocity).checked()?,
        None => kicks,
    };
    session.layers.insert(Layer::Kicks);
    let of = if units.is_some() {
        "in m and m/s"
    } else {
        "in q and v"
    };
    session.inform(format!("{} kicks {kicks}, {of}", kicks.law.name()));
    Ok(())
}

/// Draws the level curves of a column, or removes them.
pub fn level(session: &mut Session, rest: &str) -> Done {
    let target = LevelTarget::read(rest)?;
    let before = session.levels.len();
    session.levels.retain(|known| *known != target);
    if session.levels.len() < before {
        session.inform(format!("no level curve {target}"));
        return Ok(());
    }
    let draws = |plot: &usize| [View::Regimes, View::Scan].contains(&session.plots[*plot].view);
    let plot = session.on_show().find(draws).unwrap_or(session.plot);
    session.level_request(target, plot)?;
    session.levels.push(target);
    session.inform(format!("level curve {target}; the same line removes it"));
    Ok(())
}

/// The letter of a mark.
pub fn letter(text: &str) -> Done<char> {
    let letter = text.parse().ok().filter(char::is_ascii_lowercase);
    letter.ok_or_else(|| format!("{text:?} is not a letter from a to z"))
}

/// Whether a setting is to be on. Fails with one line if that is not said.
pub fn is_on(what: &str, state: &str) -> Done<bool> {
    match state {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(format!("{what} can be on or off, not {state:?}")),
    }
}
