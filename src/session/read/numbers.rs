//! The rows of the parameter pane as text.

use crate::model::Group;
use crate::numerics::decimal::shortest;
use crate::session::state::{Row, Session, Setup};

/// The value of a row in a form that can be typed, with its unit and its half width; `None` for a number of a
/// machine that is as in its file.
pub(in crate::session) fn typed(setup: &Setup, row: Row) -> Option<String> {
    if row == Row::Method {
        return Some(setup.problem.method.to_string());
    }
    let knob = row.knob_in(&setup.problem);
    let value = knob.print(setup.get(knob)?);
    let half_width = setup.doubt.half_width(knob);
    Some(if half_width > 0.0 { format!("{value}+-{}", shortest(half_width)) } else { value })
}

/// The present value of a row in a single word: a number in SI units without its unit.
pub(in crate::session) fn plain_value(session: &Session, row: Row) -> String {
    match row {
        Row::Method => session.problem.method.to_string(),
        row => shortest(session.value(row.knob_in(&session.problem))),
    }
}

/// The differences of `new` from `old`, as `name = value`. If a number of the machine differs, only that: the
/// parameters follow from it.
pub(in crate::session) fn difference(old: &Setup, new: &Setup) -> String {
    let belt = new.setting.is_some() && old.setting != new.setting;
    let follows = |row: &Row| row.knob_in(&new.problem).spec().group == Group::Motion;
    let rows = Row::all().filter(|row| !(belt && follows(row)));
    let changed = rows.filter(|row| typed(old, *row) != typed(new, *row));
    let said = changed.map(|row| {
        let value = typed(new, row).unwrap_or_else(|| "as in its file".to_owned());
        format!("{} = {value}", row.name_in(&new.problem))
    });
    let count = |setup: &Setup| setup.others.all().len() + 1;
    let motions = (count(old) != count(new)).then(|| match count(new) {
        1 => "1 motion".to_owned(),
        count => format!("{count} motions"),
    });
    said.chain(motions).collect::<Vec<_>>().join(", ")
}
