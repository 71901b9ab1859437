//! The result of fitting a recorded motion.

mod page;

use std::collections::BTreeMap;

pub use page::page;

use super::{Answer, Columns, Document, Table};
use crate::fit::{
    Combination, Condition, Data, Dropped, EstimatedNumber, Fitted, KickSpreads, LAST,
    MarginSpread, NAMES, NameSpec, Q0, StartKind, combinations, kicks, left_out, rows,
};
use crate::words::fit::{broken, sentences};
use crate::words::number::resolved;
use crate::words::statement::{SignedStatement, signed};
use crate::words::{duration, significant};

/// The whole answer of a fit: in rows one for each estimated number, then the margins.
pub fn fit(fitted: &Fitted) -> Answer<'_> {
    Answer::new(|| json(fitted), || csv(fitted), || text(fitted))
}

fn json(fitted: &Fitted) -> String {
    let Fitted { record, estimate, margins, .. } = fitted;
    let number = |row: &NameSpec| number_columns().object(&EstimateRow::of_number(fitted, row));
    let parameters = estimate.wanted().map(|row| (row.name, number(row)));
    let held = NAMES.iter().filter(|row| !estimate.free[row.place]);
    let held = held.filter_map(|row| Some((row.name, estimate.choice.held(row)?)));
    let separable = |it: &Combination| {
        let terms = it.terms.iter().map(|(row, weight)| (row.name, *weight));
        Document::default()
            .with("combination", terms.collect::<BTreeMap<_, _>>())
            .with("value", it.value)
            .with("standard_error", it.standard_error)
    };
    let (with_derivatives, without) = fitted.motions();
    let motions =
        Document::default().with("with_derivatives", with_derivatives).with("without", without);
    let SignedStatement { statement, conditions } = signed(fitted);
    Document::default()
        .with("file", &fitted.name)
        .with("unit", &record.unit)
        .with("signal", record.signal)
        .with("parameters", parameters.collect::<BTreeMap<_, _>>())
        .with("held", held.collect::<BTreeMap<_, _>>())
        .with("start", start_document(fitted))
        .with_any("drift", estimate.drift())
        .with("correlations", correlations_by_names(fitted))
        .with("noise", estimate.covariance.deviation)
        .with("samples", estimate.data.x.len())
        .with("half_swings", estimate.half_swings)
        .with("rests", estimate.rests)
        .with("separable", combinations(estimate).iter().map(separable).collect::<Vec<_>>())
        .with("valleys", &estimate.rivals)
        .with("outliers", estimate.count(Dropped::Outlier))
        .with("saturated", estimate.count(Dropped::Saturated))
        .with("excited_again", estimate.count(Dropped::After))
        .with("missing", record.missing)
        .with("repeated", record.repeated)
        .with("left_out", left_out(record, estimate))
        .with("residuals", &estimate.whiteness)
        .with("margin", margins)
        .with_any("physical", physical(fitted))
        .with("statement", statement)
        .with("conditions", conditions)
        .with("draws", Document::default().with("effective", margins.effective))
        .with("sentences", sentences(fitted))
        .cost(&motions, fitted.seconds)
        .text()
}

fn start_document(fitted: &Fitted) -> Document {
    let estimate = &fitted.estimate;
    let value = |place: usize| {
        Document::default()
            .with("standard_error", estimate.covariance.error(place))
            .with("value", estimate.p[place])
    };
    let (kind, last) = match estimate.start {
        StartKind::Release => ("release", "t0"),
        StartKind::Moving => ("moving", "v0"),
    };
    let struck_after = Some(estimate.count(Dropped::Before)).filter(|before| *before > 0);
    Document::default()
        .with("kind", kind)
        .with("q0", value(Q0))
        .with_any("struck_after", struck_after)
        .with_any(last, estimate.free[LAST].then(|| value(LAST)))
}

fn correlations_by_names(fitted: &Fitted) -> BTreeMap<String, f64> {
    let covariance = &fitted.estimate.covariance;
    let wanted: Vec<_> = fitted.estimate.wanted().collect();
    let mut all = BTreeMap::new();
    for (index, one) in wanted.iter().enumerate() {
        for other in &wanted[index + 1..] {
            let name = format!("{},{}", one.name, other.name);
            all.insert(name, covariance.correlation(one.place, other.place));
        }
    }
    all
}

fn physical(fitted: &Fitted) -> Option<Document> {
    let scales = kicks(fitted)?;
    let scaled = |spreads: &KickSpreads| spreads.scaled(scales.0, scales.1);
    let numbers: BTreeMap<_, _> =
        rows(fitted).into_iter().map(|number| (number.name, number)).collect();
    let guaranteed = fitted.margins.guaranteed.as_ref().map(scaled);
    let document = Document::default().with("numbers", numbers);
    Some(document.and(&scaled(&fitted.margins.kicks)).with_any("guaranteed", guaranteed))
}

/// An estimated number or a margin.
struct EstimateRow {
    name: String,
    value: Option<f64>,
    standard_error: Option<f64>,
    lower: Option<f64>,
    upper: Option<f64>,
    /// Whether the interval follows from the curvature at the best fit alone.
    quadratic: bool,
}

impl EstimateRow {
    fn of_number(fitted: &Fitted, row: &NameSpec) -> Self {
        let estimate = &fitted.estimate;
        let interval = estimate.intervals[row.place];
        EstimateRow {
            name: row.name.to_owned(),
            value: Some(estimate.p[row.place]),
            standard_error: Some(estimate.covariance.error(row.place)),
            lower: interval.lower,
            upper: interval.upper,
            quadratic: interval.quadratic,
        }
    }

    /// A margin from its draws.
    fn of_kick(lead: &str, kick: &KickRow) -> Self {
        let MarginSpread { median: value, lower, upper, .. } = kick.spread;
        let name = format!("{lead} {}", kick.name);
        EstimateRow { name, value, standard_error: None, lower, upper, quadratic: false }
    }
}

/// A kick that is not survived: its name in files, its kind and from where it comes in text, and its size with the factor
/// and the unit in which text shows it.
struct KickRow<'a> {
    name: &'static str,
    kind: &'static str,
    from: &'static str,
    spread: MarginSpread,
    scale: f64,
    unit: &'a str,
}

/// The smallest kicks, from any rest position and from the middle.
fn kick_rows<'a>(fitted: &'a Fitted, kicks: &KickSpreads) -> [KickRow<'a>; 4] {
    let KickSpreads { displacement, impulse, from_rest } = *kicks;
    let length = fitted.unit();
    let (kick, momentum) = match self::kicks(fitted) {
        Some((_, scale)) => ("impulse", (scale, "N s")),
        None => ("velocity/omega0", (1.0, length)),
    };
    let row =
        |name, kind, from, spread, (scale, unit)| KickRow { name, kind, from, spread, scale, unit };
    let (rest, length) = ("any rest position", (1.0, length));
    [
        row("displacement from rest", "displacement", rest, from_rest.displacement, length),
        row("impulse from rest", kick, rest, from_rest.impulse, momentum),
        row("displacement", "displacement", "q = 0", displacement, length),
        row("impulse", kick, "q = 0", impulse, momentum),
    ]
}

fn value_columns(columns: Columns<'_, EstimateRow>) -> Columns<'_, EstimateRow> {
    columns
        .file("value", |row| row.value)
        .file("standard_error", |row| row.standard_error)
        .file("lower", |row| row.lower)
        .file("upper", |row| row.upper)
}

/// The columns of an estimated number.
fn number_columns<'a>() -> Columns<'a, EstimateRow> {
    value_columns(Columns::default()).field("quadratic", |row| row.quadratic)
}

fn csv(fitted: &Fitted) -> String {
    let numbers = fitted.estimate.wanted().map(|row| EstimateRow::of_number(fitted, row));
    let kicks = |lead: &'static str, kicks: &KickSpreads| {
        kick_rows(fitted, kicks).map(|kick| EstimateRow::of_kick(lead, &kick))
    };
    let guaranteed = fitted.margins.guaranteed.iter();
    let guaranteed = guaranteed.flat_map(|it| kicks("guaranteed", it));
    let rows = numbers.chain(kicks("margin", &fitted.margins.kicks)).chain(guaranteed);
    value_columns(Columns::default().file("name", |row: &EstimateRow| row.name.clone())).csv(rows)
}

fn text(fitted: &Fitted) -> String {
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
const NUMBERS: &str = "standard errors; 95 % lie from .. to";

/// The estimated numbers.
fn numbers(fitted: &Fitted) -> Table {
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
fn subject(fitted: &Fitted) -> String {
    let estimate = &fitted.estimate;
    let Data { t, x, .. } = &estimate.data;
    let what = if estimate.data.has_peaks() {
        let times = if t.is_empty() { "without" } else { "with" };
        format!("{} peaks {times} times", x.len())
    } else {
        let span = t.last().zip(t.first()).map_or(0.0, |(last, first)| last - first);
        let begin = match estimate.start {
            StartKind::Release => "released within it",
            StartKind::Moving if estimate.count(Dropped::Before) > 0 => "since the mass was struck",
            StartKind::Moving => "in motion from its beginning",
        };
        let signal = fitted.record.signal;
        let of = if signal.is_displacement() { String::new() } else { format!(" of a {signal}") };
        format!("{} samples{of} over {} s, {begin}", t.len(), significant(span, 4))
    };
    let end = if estimate.rests { ", at rest at its end" } else { "" };
    format!("{what}, {} half swings{end}", estimate.half_swings)
}

/// Where the motion starts, and the noise.
fn start(fitted: &Fitted) -> String {
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
fn correlations(fitted: &Fitted) -> Table {
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
fn forces(fitted: &Fitted) -> Table {
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
fn margins(fitted: &Fitted) -> Table {
    struct SpreadRow<'a> {
        what: String,
        spread: MarginSpread,
        scale: f64,
        unit: &'a str,
    }
    let margins = &fitted.margins;
    let length = fitted.unit();
    let row =
        |what: &str, spread, scale, unit| SpreadRow { what: what.to_owned(), spread, scale, unit };
    let kicks = |what: &str, kicks: &KickSpreads| {
        kick_rows(fitted, kicks).map(|KickRow { kind, from, spread, scale, unit, .. }| {
            row(&format!("{what} {kind} not survived, from {from}"), spread, scale, unit)
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
fn draws(fitted: &Fitted) -> String {
    format!(
        "95 % lie from .. to, by {} effective draws; none: the share of the draws without",
        significant(fitted.margins.effective, 3)
    )
}
