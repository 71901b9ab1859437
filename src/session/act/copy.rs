//! Copies: a number or a point, alone or with everything that belongs to it, and the pane in focus as a shell
//! command.

use std::collections::BTreeSet;

use crate::flow::Problem;
use crate::model::{KNOBS, Knob, State};
use crate::numerics::shortest;
use crate::scan::Value;
use crate::scene::machine::library;
use crate::scene::{Axes, Span, View};
use crate::session::read::completion::plain_value;
use crate::session::{Done, Effect, Plot, Session};
use crate::words::joined;

/// Number of points of a copied branch: as many as a wide plot has columns.
const BRANCH_POINTS: usize = 200;

/// Copies the number or the point under consideration.
pub fn number(session: &mut Session) -> Done {
    let words = point(session).into_iter().map(|(_, value)| value);
    copied(session, joined(words, " "))
}

/// Copies the number or the point with everything that belongs to it, in the syntax of `set`.
pub fn row(session: &mut Session) -> Done {
    let mut named = point(session);
    if !named.is_empty() {
        named.extend(belonging(session));
    }
    let mut known = BTreeSet::new();
    named.retain(|(name, _)| known.insert(name.clone()));
    let words = named.into_iter().map(|(name, value)| format!("{name}={value}"));
    copied(session, joined(words, " "))
}

fn copied(session: &mut Session, text: String) -> Done {
    if text.is_empty() {
        return Err("nothing is pointed at: arrows show a cursor".to_owned());
    }
    session.effect(Effect::Copy(text))
}

/// A number, with its name.
type NamedNumber = (String, String);

fn named(name: &str, value: f64) -> NamedNumber {
    (name.to_owned(), shortest(value))
}

fn measured(value: &Value) -> String {
    match value {
        Value::Nothing => "-".to_owned(),
        Value::Number(value) => shortest(*value),
        Value::Count(count) => count.to_string(),
        Value::Word(word) => (*word).to_owned(),
    }
}

/// The number or the point under consideration: the selected value, the held point of a branch, the point of a
/// scan, or the cursor.
fn point(session: &Session) -> Vec<NamedNumber> {
    let Some(plot) = session.focused() else {
        let row = session.selected;
        return vec![(row.name().to_owned(), plain_value(session, row))];
    };
    let Axes { abscissa, against, ordinate, machine, .. } = plot.axes;
    if let Some(held) = session.held {
        let numbers = session.numbers_over(session.plot).into_iter();
        let values = std::iter::once(held.value).chain(held.up);
        let values = numbers.zip(values).map(|(knob, value)| named(knob.spec().name, value));
        return values.chain(held.cycle.map(|cycle| named("q_max", cycle.q_max))).collect();
    }
    if let (View::Scan, Some(scanned)) = (plot.view, &session.scanned) {
        let column = scanned.scan.measured().get(scanned.column).copied();
        let known = column.zip(scanned.value(scanned.at)).into_iter();
        return known.map(|(name, value)| (name.to_owned(), measured(&value))).collect();
    }
    let Some(at) = plot.cursor else { return Vec::new() };
    let (x, y) = match plot.view {
        View::Diagram => (abscissa.spec().name, ordinate.spec().name),
        View::Regimes => (abscissa.spec().name, against.spec().name),
        // As it is set: its name alone is that of the initial velocity.
        View::BeltDiagram => (machine.spec().symbol, "x_max"),
        view => view.spec().coordinates,
    };
    vec![named(x, at.x), named(y, at.y)]
}

/// The numbers that belong to it: the others of a cycle or of a row of a scan, and the parameters.
fn belonging(session: &Session) -> Vec<NamedNumber> {
    let mut all = Vec::new();
    // The parameters on show are those of another number of the machine.
    if session.focused().is_some_and(|plot| plot.view == View::BeltDiagram) {
        return all;
    }
    if let Some(cycle) = session.held.and_then(|held| held.cycle) {
        all.extend([
            named("q_min", cycle.q_min),
            named("v_min", cycle.v_min),
            named("v_max", cycle.v_max),
            named("period", cycle.period),
        ]);
    }
    let mut problem = session.problem;
    if let Some(scanned) = session.scanned.as_ref().filter(|_| session.focuses_scan()) {
        problem = scanned.scan.problem(scanned.at).unwrap_or(problem);
        let values = scanned.rows.get(scanned.at).into_iter().flat_map(|row| &row.values);
        let columns = scanned.scan.measured();
        let columns = columns.into_iter().map(str::to_owned);
        all.extend(columns.zip(values.map(measured)));
        if scanned.scan.problem(scanned.at).is_none() {
            let inputs = scanned.scan.inputs(scanned.at).into_iter();
            all.extend(inputs.map(|(name, value)| (name, measured(&value))));
            return all;
        }
    }
    all.extend(Knob::MOTION.map(|knob| named(knob.spec().name, problem.get(knob))));
    all
}

/// The shell command that prints the numbers of the pane in focus. Of the oscillator it gives every number, so that
/// its meaning does not depend on any scene.
pub fn command_line(session: &Session) -> String {
    let Problem { until, method, tolerance, .. } = session.problem;
    let diagram = session.focused().filter(|plot| plot.view == View::Diagram);
    if let (None, Some(line)) = (diagram, of_machine(session)) {
        return line;
    }
    let mut line = format!("hopfscope {}", if diagram.is_some() { "branch" } else { "trajectory" });
    let is_used = |plot: &Plot, knob: Knob| knob.is_parameter() && knob != plot.axes.abscissa;
    for knob in Knob::MOTION {
        if diagram.is_none_or(|plot| is_used(plot, knob)) {
            line += &set(knob, session.value(knob));
        }
    }
    if let Some(plot) = diagram {
        line += &over(plot.axes.abscissa, plot.window.x);
    } else {
        line += &format!(" --until {} --method {method}", shortest(until));
    }
    line + &match method.dial() {
        dial @ (Knob::Step | Knob::Epsilon) if diagram.is_none() => {
            format!(" --{dial} {}", shortest(session.value(dial)))
        }
        _ => format!(" --tol {}", shortest(tolerance)),
    }
}

/// The command for the machine that is drawn, by its name and the numbers that are not those of the name; `None` without a
/// machine of the program: only these have a name that says all.
fn of_machine(session: &Session) -> Option<String> {
    // Last, as these follow from the others where nothing is said.
    const STATIC: [Knob; 2] = [Knob::StaticCoefficient, Knob::StaticGuide];
    let Problem { initial: State { q, v }, until, parameters, method, tolerance, .. } =
        session.problem;
    let (source, units) = session.source(&parameters);
    let (belt, machine) = (source.of_belt()?, &session.running()?.machine);
    let mut told = library::find(&machine.name).ok()?.belt.clone();
    let diagram = session.focused().filter(|plot| plot.view == View::BeltDiagram);
    let varied = diagram.map(|plot| plot.axes.machine);
    let command = if diagram.is_some() { "branch" } else { "trajectory" };
    let mut line = format!("hopfscope {command} --machine {}", machine.name);
    let others = KNOBS.iter().map(|row| row.knob).filter(|knob| !STATIC.contains(knob));
    for knob in others.chain(STATIC) {
        let value = knob.of_belt(belt);
        if let Some(value) = value.filter(|_| value != knob.of_belt(&told)) {
            knob.set_in_belt(&mut told, value).ok()?;
            if Some(knob) != varied {
                line += &set(knob, value);
            }
        }
    }
    line += &if let Some(plot) = diagram {
        over(plot.axes.machine, plot.window.x)
    } else {
        let start = set(Knob::X, q * units.displacement) + &set(Knob::V, v * units.velocity);
        let [until, tolerance] = [until * units.time, tolerance].map(shortest);
        format!("{start} --until {until} --method {method} --tol {tolerance}")
    };
    (told == *belt).then_some(line)
}

fn set(knob: Knob, value: f64) -> String {
    format!(" --set {knob}={}", shortest(value))
}

/// The part of a window within the range of a number.
fn over(knob: Knob, window: Span) -> String {
    let [from, to] = window.allowed(knob).unwrap_or(window).ends().map(shortest);
    format!(" --over {knob}={from}:{to}:{BRANCH_POINTS}")
}
