//! The rows of the parameter pane as numbers of a motion.

use crate::flow::Problem;
use crate::numerics::decimal::shortest;
use crate::session::state::rows::Row;
use crate::session::state::setup::Setup;

/// The value of a row that is a number; 0 for a number of the machine that is not set.
pub(in crate::session) fn number(setup: &Setup, row: Row) -> f64 {
    let Setup { problem, setting, doubt, .. } = setup;
    match row {
        Row::Quantity(knob) => setting.and_then(|it| it.get(knob)).unwrap_or(0.0),
        Row::Disturbance => doubt.disturbance,
        row => problem.get(row.knob_in(problem)),
    }
}

/// The motion with another value of a row that is a number of the motion.
pub(in crate::session) fn with_number(mut problem: Problem, row: Row, value: f64) -> Problem {
    if row != Row::Method {
        problem.set(row.knob_in(&problem), value);
    }
    problem
}

/// The value of a row that is a number of the oscillator, with its half width, in a form that can be typed.
pub(in crate::session) fn typed(setup: &Setup, row: Row) -> String {
    let value = shortest(number(setup, row));
    match row {
        Row::Parameter(symbol) if setup.doubt.half_width(symbol) > 0.0 => {
            format!("{value}+-{}", shortest(setup.doubt.half_width(symbol)))
        }
        _ => value,
    }
}

/// The differences of `new` from `old`, as `name = value`. If a number of the machine differs, only that: the
/// parameters follow from it.
pub(in crate::session) fn difference(old: &Setup, new: &Setup) -> String {
    let value = |setup: &Setup, row: Row| match row {
        Row::Method => setup.problem.method.to_string(),
        Row::Quantity(knob) => {
            let value = setup.setting.and_then(|it| it.get(knob));
            value.map_or_else(|| "as in its file".to_owned(), |value| knob.print(value))
        }
        row => typed(setup, row),
    };
    let belt = new.setting.is_some() && old.setting != new.setting;
    let follows = |row: &Row| belt && matches!(row, Row::Parameter(_));
    let rows = Row::all().filter(|row| !follows(row));
    let changed = rows.filter(|row| value(old, *row) != value(new, *row));
    let said = changed.map(|row| format!("{} = {}", row.name_in(&new.problem), value(new, row)));
    let count = |setup: &Setup| setup.others.all().len() + 1;
    let motions = (count(old) != count(new)).then(|| match count(new) {
        1 => "1 motion".to_owned(),
        count => format!("{count} motions"),
    });
    said.chain(motions).collect::<Vec<_>>().join(", ")
}
