//! A fit as readable text.

use crate::fit::{
    Condition, Data, Dropped, EstimatedNumber, Fitted, KickSpreads, LAST, NAMES, NameSpec, Q0,
    Spread, StartKind, kicks, rows,
};
use crate::report::columns::Columns;
use crate::report::table::Table;
use crate::words::fit::{broken, sentences};
use crate::words::number::{duration, resolved, significant};
use crate::words::statement::signed;

/// The whole answer of a fit.
pub fn table(fitted: &Fitted) -> String {
    let broken = broken(fitted);
    let first = broken.as_ref().map(|line| format!("{line}\n")).unwrap_or_default();
    let mut out = format!("{first}{}: {}\n\n", fitted.name, subject(fitted));
    out += &format!("{}{NUMBERS}\n\n", numbers(fitted));
    out += &format!("{}\n\n", start(fitted));
    out += &spaced(&correlations(fitted));
    out += &spaced(&forces(fitted));
    out += &format!("{}{}\n\n", margins(fitted), draws(fitted));
    for sentence in sentences(fitted).into_iter().filter(|it| Some(it) != broken.as_ref()) {
        out += &format!("{sentence}\n");
    }
    out += &format!("\n{}\n", states(&signed(fitted).conditions));
    let (with, plain) = fitted.motions();
    out + &format!(
        "{with} motions with derivatives, {plain} without, {}\n",
        duration(fitted.seconds)
    )
}

/// A table with an empty line below it; nothing if it is empty.
fn spaced(table: &Table) -> String {
    if table.is_empty() { String::new() } else { format!("{table}\n") }
}

/// What the table of the numbers shows.
pub(super) const NUMBERS: &str = "standard errors; 95 % lie from .. to";

/// The estimated numbers.
pub(super) fn numbers(fitted: &Fitted) -> Table {
    let estimate = &fitted.estimate;
    let error = |row: &NameSpec| estimate.covariance.error(row.place);
    let known = move |value, row: &NameSpec| resolved(value, 0.05 * error(row));
    let end =
        move |end: Option<f64>, row: &NameSpec| end.map_or("-".to_owned(), |end| known(end, row));
    let wanted =
        NAMES.iter().filter(|row| estimate.free[row.place] && estimate.choice.is_wanted(row));
    Columns::default()
        .text("number", |row: &&NameSpec| row.name.to_owned())
        .text("value", move |row| known(estimate.p[row.place], row))
        .text("error", move |row| significant(error(row), 2))
        .text("from", move |row| end(estimate.intervals[row.place].lower, row))
        .text("to", move |row| end(estimate.intervals[row.place].upper, row))
        .text("unit", |row| fitted.unit_of(row))
        .table(wanted)
}

/// What was measured, and how the motion goes.
pub(super) fn subject(fitted: &Fitted) -> String {
    let estimate = &fitted.estimate;
    let what = match &estimate.data {
        Data::Samples { t, .. } => {
            let span = t.last().zip(t.first()).map_or(0.0, |(last, first)| last - first);
            let begin = match estimate.start {
                StartKind::Release => "released within it",
                StartKind::Moving if estimate.count(Dropped::Before) > 0 => {
                    "since the mass was struck"
                }
                StartKind::Moving => "in motion from its beginning",
            };
            let signal = fitted.record.signal;
            let of =
                if signal.is_displacement() { String::new() } else { format!(" of a {signal}") };
            format!("{} samples{of} over {} s, {begin}", t.len(), significant(span, 4))
        }
        Data::Peaks { t, x, .. } => {
            let times = if t.is_some() { "with" } else { "without" };
            format!("{} peaks {times} times", x.len())
        }
    };
    let end = if estimate.rests { ", at rest at its end" } else { "" };
    format!("{what}, {} half swings{end}", estimate.half_swings)
}

/// Where the motion starts, and the noise.
pub(super) fn start(fitted: &Fitted) -> String {
    let estimate = &fitted.estimate;
    let number = |name: &str, place: usize, unit: &str| {
        let error = estimate.covariance.error(place);
        let value = resolved(estimate.p[place], 0.05 * error);
        format!("{name} = {value} +- {} {unit}", significant(error, 2)).trim_end().to_owned()
    };
    let unit = fitted.unit();
    let mut parts = vec![number("q0", Q0, unit)];
    if estimate.free[LAST] {
        parts.push(match estimate.start {
            StartKind::Release => number("t0", LAST, "s"),
            StartKind::Moving => number("v0/omega0", LAST, unit),
        });
    }
    let noise = significant(estimate.covariance.deviation, 3);
    let line = format!("start: {}; noise {noise} {}", parts.join(", "), fitted.signal_unit());
    line.trim_end().to_owned()
}

/// The correlations between the estimated numbers; empty for a single one.
pub(super) fn correlations(fitted: &Fitted) -> Table {
    let estimate = &fitted.estimate;
    let wanted: Vec<&NameSpec> = estimate.wanted().collect();
    if wanted.len() < 2 {
        return Table::default();
    }
    let correlations =
        Columns::default().text("correlation", |row: &&NameSpec| row.name.to_owned());
    let correlations = wanted.iter().fold(correlations, |columns, other| {
        let of = |row: &NameSpec| estimate.covariance.correlation(row.place, other.place);
        columns.text(other.name, move |row| format!("{:.3}", of(row)))
    });
    correlations.table(wanted.iter().copied())
}

/// The numbers in SI units; empty if neither mass nor stiffness is known.
pub(super) fn forces(fitted: &Fitted) -> Table {
    let value = |row: &EstimatedNumber| {
        resolved(row.value, 0.05 * row.standard_error.max(1e-6 * row.value.abs()))
    };
    Columns::default()
        .text("physical", |row: &EstimatedNumber| row.name.to_owned())
        .text("value", value)
        .text("error", |row| significant(row.standard_error, 2))
        .text("unit", |row| row.unit.to_owned())
        .table(rows(fitted))
}

fn states(conditions: &[Condition]) -> String {
    let line = |it: &Condition| format!("  {:7}  {:12}  {}\n", it.verdict(), it.name, it.detail);
    format!("conditions:\n{}", conditions.iter().map(line).collect::<String>())
}

/// The margins and what else follows from the numbers.
pub(super) fn margins(fitted: &Fitted) -> Table {
    struct SpreadRow<'a> {
        what: String,
        spread: Spread,
        scale: f64,
        unit: &'a str,
    }
    let margins = &fitted.margins;
    let length = fitted.unit();
    let (kick, scale, unit) = match kicks(fitted) {
        Some((_, scale)) => ("impulse", scale, "N s"),
        None => ("velocity/omega0", 1.0, length),
    };
    let row =
        |what: &str, spread, scale, unit| SpreadRow { what: what.to_owned(), spread, scale, unit };
    let kicks = |what: &str, KickSpreads { displacement, impulse, from_rest }: &KickSpreads| {
        [
            ("displacement", "any rest position", from_rest.displacement, 1.0, length),
            (kick, "any rest position", from_rest.impulse, scale, unit),
            ("displacement", "q = 0", *displacement, 1.0, length),
            (kick, "q = 0", *impulse, scale, unit),
        ]
        .map(|(kick, from, spread, scale, unit)| {
            row(&format!("{what} {kick} not survived, from {from}"), spread, scale, unit)
        })
    };
    let shown = |value: Option<f64>, row: &SpreadRow| {
        value.map_or("none".to_owned(), |value| significant(value * row.scale, 4))
    };
    let mut all = Vec::from(kicks("smallest", &margins.kicks));
    all.extend(margins.guaranteed.iter().flat_map(|it| kicks("guaranteed, smallest", it)));
    all.push(row("stable cycle, right turning point", margins.cycle, 1.0, length));
    all.push(row("D of the fold, above which all is survived", margins.fold, 1.0, ""));
    Columns::default()
        .text("what follows", |row: &SpreadRow| row.what.clone())
        .text("median", move |row| shown(row.spread.median, row))
        .text("from", move |row| shown(row.spread.lower, row))
        .text("to", move |row| shown(row.spread.upper, row))
        .text("none", |row| format!("{} %", significant(100.0 * row.spread.none, 2)))
        .text("unit", |row| row.unit.to_owned())
        .table(all)
}

/// What the table of the margins shows.
pub(super) fn draws(fitted: &Fitted) -> String {
    format!(
        "95 % lie from .. to, by {} effective draws; none: the share of the draws without",
        significant(fitted.margins.effective, 3)
    )
}
