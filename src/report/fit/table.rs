//! A fit as readable text.

use crate::fit::Fitted;
use crate::fit::conditions::Condition;
use crate::fit::margin::{KickSpreads, Spread};
use crate::fit::names::{NAMES, NameSpec};
use crate::fit::observation::{Data, LAST, Q0, StartKind};
use crate::fit::physical::{kicks, rows};
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
    let mut numbers = Table::new(&["number", "value", "error", "from", "to", "unit"]);
    for row in &NAMES {
        if !estimate.free[row.place] || !estimate.choice.is_wanted(row) {
            continue;
        }
        let (value, error) = (estimate.p[row.place], estimate.covariance.error(row.place));
        let interval = estimate.intervals[row.place];
        let end = |end: Option<f64>| end.map_or("-".to_owned(), |end| resolved(end, 0.05 * error));
        numbers.row(vec![
            row.name.to_owned(),
            resolved(value, 0.05 * error),
            significant(error, 2),
            end(interval.lower),
            end(interval.upper),
            fitted.unit_of(row),
        ]);
    }
    numbers
}

/// What was measured, and how the motion goes.
pub(super) fn subject(fitted: &Fitted) -> String {
    let estimate = &fitted.estimate;
    let what = match &estimate.data {
        Data::Samples { t, .. } => {
            let span = t.last().zip(t.first()).map_or(0.0, |(last, first)| last - first);
            let begin = match estimate.start {
                StartKind::Release => "released within it",
                StartKind::Moving if estimate.before > 0 => "since the mass was struck",
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
    let mut titles = vec!["correlation"];
    titles.extend(wanted.iter().map(|row| row.name));
    let mut table = Table::new(&titles);
    for one in &wanted {
        let mut cells = vec![one.name.to_owned()];
        for other in &wanted {
            cells.push(format!("{:.3}", estimate.covariance.correlation(one.place, other.place)));
        }
        table.row(cells);
    }
    table
}

/// The numbers in SI units; empty if neither mass nor stiffness is known.
pub(super) fn forces(fitted: &Fitted) -> Table {
    let mut table = Table::new(&["physical", "value", "error", "unit"]);
    for row in rows(fitted) {
        table.row(vec![
            row.name.to_owned(),
            resolved(row.value, 0.05 * row.standard_error.max(1e-6 * row.value.abs())),
            significant(row.standard_error, 2),
            row.unit.to_owned(),
        ]);
    }
    table
}

fn states(conditions: &[Condition]) -> String {
    let line = |it: &Condition| format!("  {:7}  {:12}  {}\n", it.verdict(), it.name, it.detail);
    format!("conditions:\n{}", conditions.iter().map(line).collect::<String>())
}

/// The margins and what else follows from the numbers.
pub(super) fn margins(fitted: &Fitted) -> Table {
    let margins = &fitted.margins;
    let mut table = Table::new(&["what follows", "median", "from", "to", "none", "unit"]);
    let shown = |value: Option<f64>, scale: f64| {
        value.map_or("none".to_owned(), |value| significant(value * scale, 4))
    };
    let mut row = |what: &str, spread: &Spread, scale: f64, unit: &str| {
        table.row(vec![
            what.to_owned(),
            shown(spread.median, scale),
            shown(spread.lower, scale),
            shown(spread.upper, scale),
            format!("{} %", significant(100.0 * spread.none, 2)),
            unit.to_owned(),
        ]);
    };
    let (kick, scale, unit) = match kicks(fitted) {
        Some((_, scale)) => ("impulse", scale, "N s"),
        None => ("velocity/omega0", 1.0, fitted.unit()),
    };
    let mut kicks = |what: &str, KickSpreads { displacement, impulse, from_rest }: &KickSpreads| {
        let name = |kick: &str, from: &str| format!("{what} {kick} not survived, from {from}");
        let (rest, middle) = ("any rest position", "q = 0");
        row(&name("displacement", rest), &from_rest.displacement, 1.0, fitted.unit());
        row(&name(kick, rest), &from_rest.impulse, scale, unit);
        row(&name("displacement", middle), displacement, 1.0, fitted.unit());
        row(&name(kick, middle), impulse, scale, unit);
    };
    kicks("smallest", &margins.kicks());
    if let Some(guaranteed) = &margins.guaranteed {
        kicks("guaranteed, smallest", guaranteed);
    }
    row("stable cycle, right turning point", &margins.cycle, 1.0, fitted.unit());
    row("D of the fold, above which all is survived", &margins.fold, 1.0, "");
    table
}

/// What the table of the margins shows.
pub(super) fn draws(fitted: &Fitted) -> String {
    format!(
        "95 % lie from .. to, by {} effective draws; none: the share of the draws without",
        significant(fitted.margins.effective, 3)
    )
}
