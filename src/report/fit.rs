//! The result of fitting a recorded motion.

use std::collections::BTreeMap;

use super::{Answer, Columns, Document, Table};
use crate::fit::{
    Combination, Condition, DropReason, FitResult, LAST, MarginSpread, Margins, NAMES, NameSpec,
    OMEGA0, Omission, ProfileInterval, Q0, Record, StartKind, combination, left_out, rows,
};
use crate::portrait::Kicks;
use crate::words::fit::{Statement, left_out as counts, sentences, signed, undetermined};
use crate::words::{in_unit, joined, resolved, significant, with_error};

/// The whole answer of a fit: in rows one for each estimated number, then the margins.
pub fn fit(fitted: &FitResult) -> Answer {
    let statement = signed(fitted);
    let broken = statement.broken();
    let (with, plain) = fitted.motions();
    let motions = Document::of("with_derivatives", with).with("without", plain);
    let counted = format!("{with} motions with derivatives, {plain} without");
    let name = Columns::default().file("name", |row: &EstimateRow| row.name.clone());
    let numbers = || fitted.estimate.wanted().map(|row| EstimateRow::of_number(fitted, row));
    let physical = rows(fitted)
        .into_iter()
        .map(|it| EstimateRow::known(it.name, it.value, it.standard_error, it.unit.to_owned()));
    let tested = Columns::default()
        .text("condition", |it: &Condition| it.name)
        .text("result", Condition::verdict)
        .text("what was found", |it| it.detail.clone());
    let table = |rows: Vec<EstimateRow>| estimate_columns().table(rows).lean();
    Answer::new(&fitted.name, subject(fitted))
        .and(&document(fitted, &statement))
        .csv(&name.and(estimate_columns()), numbers().chain(kick_rows(fitted)))
        .lines(broken.clone())
        .statement(statement.text.clone(), broken.is_none())
        .table(tested.table(&statement.conditions).captioned("what the sentence rests on"))
        .heading("Numbers")
        .table(table(numbers().collect()).captioned("standard errors; 95 % lie from .. to"))
        .table(table(physical.collect()).captioned("in SI units, with standard errors"))
        .lines([start(fitted)])
        .lines(undetermined(fitted))
        .heading("Margin")
        .table(margins(fitted).captioned(draws(fitted)))
        .heading("Correlations")
        .table(correlations(fitted))
        .heading("Left out")
        .lines(counts(fitted))
        .lines([places(fitted)])
        .costing(&counted, motions, fitted.seconds)
}

/// All that was found, as fields of a document.
fn document(fitted: &FitResult, statement: &Statement) -> Document {
    let FitResult { record, estimate, margins, .. } = fitted;
    let number = |row: &NameSpec| estimate_columns().object(&EstimateRow::of_number(fitted, row));
    let parameters = estimate.wanted().map(|row| (row.name, number(row)));
    let held = NAMES.iter().filter(|row| !estimate.free[row.place]);
    let held = held.filter_map(|row| Some((row.name, estimate.choice.held(row)?)));
    let separable = |it: &Combination| {
        let terms = it.terms.iter().map(|(row, weight)| (row.name, *weight));
        Document::of("combination", terms.collect::<BTreeMap<_, _>>())
            .with("value", it.value)
            .with("standard_error", it.standard_error)
    };
    Document::of("file", &fitted.name)
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
        .with("separable", combination(estimate).iter().map(separable).collect::<Vec<_>>())
        .with("valleys", &estimate.rivals)
        .with("outliers", estimate.count(DropReason::Outlier))
        .with("saturated", estimate.count(DropReason::Saturated))
        .with("excited_again", estimate.count(DropReason::After))
        .with("missing", record.missing)
        .with("repeated", record.repeated)
        .with("left_out", left_out(record, estimate))
        .with("residuals", &estimate.whiteness)
        .with("margin", margins)
        .with_any("physical", physical(fitted))
        .with("statement", statement)
        .with("conditions", &statement.conditions)
        .with("draws", Document::of("effective", margins.effective))
        .with("sentences", sentences(fitted))
}

fn start_document(fitted: &FitResult) -> Document {
    let estimate = &fitted.estimate;
    let value = |place: usize| {
        Document::of("standard_error", estimate.covariance.error(place))
            .with("value", estimate.p[place])
    };
    let (kind, last) = match estimate.start {
        StartKind::Release => ("release", "t0"),
        StartKind::Moving => ("moving", "v0"),
    };
    let struck_after = Some(estimate.count(DropReason::Before)).filter(|before| *before > 0);
    Document::of("kind", kind)
        .with("q0", value(Q0))
        .with_any("struck_after", struck_after)
        .with_any(last, estimate.free[LAST].then(|| value(LAST)))
}

fn correlations_by_names(fitted: &FitResult) -> BTreeMap<String, f64> {
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

fn physical(fitted: &FitResult) -> Option<Document> {
    let scales = fitted.kicks(fitted.estimate.p[OMEGA0])?;
    let scaled = |spreads: &Kicks<MarginSpread>| {
        spreads.each(|it| it.scaled(scales.0), |it| it.scaled(scales.1))
    };
    let numbers: BTreeMap<_, _> =
        rows(fitted).into_iter().map(|number| (number.name, number)).collect();
    let guaranteed = fitted.margins.guaranteed.as_ref().map(scaled);
    let document = Document::of("numbers", numbers);
    Some(document.and(&scaled(&fitted.margins.kicks)).with_any("guaranteed", guaranteed))
}

/// An estimated number or a margin.
#[derive(Default)]
struct EstimateRow {
    name: String,
    value: Option<f64>,
    standard_error: Option<f64>,
    lower: Option<f64>,
    upper: Option<f64>,
    /// Whether the interval follows from the curvature at the best fit alone.
    quadratic: bool,
    /// The share of the draws without it; `None` for a number.
    none: Option<f64>,
    /// The factor and the unit with which text shows it.
    unit: (f64, String),
}

impl EstimateRow {
    fn of_number(fitted: &FitResult, row: &NameSpec) -> Self {
        let estimate = &fitted.estimate;
        let ProfileInterval { lower, upper, quadratic } = estimate.intervals[row.place];
        let (value, error) = (estimate.p[row.place], estimate.covariance.error(row.place));
        let known = EstimateRow::known(row.name, value, error, fitted.unit_of(row));
        EstimateRow { lower, upper, quadratic, ..known }
    }

    /// A number with its standard error.
    fn known(name: &str, value: f64, error: f64, unit: String) -> Self {
        let (name, unit) = (name.to_owned(), (1.0, unit));
        let (value, standard_error) = (Some(value), Some(error));
        EstimateRow { name, value, standard_error, unit, ..EstimateRow::default() }
    }

    /// What follows from the numbers, from its draws.
    fn of_draws(name: &str, spread: MarginSpread, unit: (f64, &str)) -> Self {
        let MarginSpread { median: value, lower, upper, none } = spread;
        let (name, none, unit) = (name.to_owned(), Some(none), (unit.0, unit.1.to_owned()));
        EstimateRow { name, value, lower, upper, none, unit, ..EstimateRow::default() }
    }

    /// The smallest kicks, from any rest position and from the middle.
    fn of_kicks(fitted: &FitResult, lead: &str, kicks: &Kicks<MarginSpread>) -> [Self; 4] {
        let Kicks { displacement, impulse, from_rest } = *kicks;
        let length = (1.0, fitted.unit());
        let momentum =
            fitted.kicks(fitted.estimate.p[OMEGA0]).map_or(length, |(_, scale)| (scale, "N s"));
        let row =
            |name, spread, unit| EstimateRow::of_draws(&format!("{lead} {name}"), spread, unit);
        [
            row("displacement from rest", from_rest.displacement, length),
            row("impulse from rest", from_rest.impulse, momentum),
            row("displacement", displacement, length),
            row("impulse", impulse, momentum),
        ]
    }

    /// A value of it for reading, to the digits that count.
    fn text(&self, value: Option<f64>) -> String {
        match (value, self.standard_error) {
            (Some(value), Some(error)) => {
                let least = 1e-6 * self.value.unwrap_or(value).abs();
                resolved(value, 0.05 * error.max(least))
            }
            (Some(value), None) => significant(value * self.unit.0, 4),
            (None, _) if self.none.is_some() => "none".to_owned(),
            (None, _) => "-".to_owned(),
        }
    }
}

/// The columns of an estimate.
fn estimate_columns<'a>() -> Columns<'a, EstimateRow> {
    let percent = |share: f64| format!("{} %", significant(100.0 * share, 2));
    Columns::default()
        .text("number", |row: &EstimateRow| row.name.clone())
        .file("value", |row| row.value)
        .text("value", |row| row.text(row.value))
        .file("standard_error", |row| row.standard_error)
        .text("error", |row| Some(significant(row.standard_error?, 2)))
        .file("lower", |row| row.lower)
        .text("from", |row| row.text(row.lower))
        .file("upper", |row| row.upper)
        .text("to", |row| row.text(row.upper))
        .field("quadratic", |row| row.quadratic)
        .text("none", move |row| row.none.map(percent))
        .text("unit", |row| row.unit.1.clone())
}

/// The margins, and those that are guaranteed.
fn kick_rows(fitted: &FitResult) -> Vec<EstimateRow> {
    let Margins { kicks, guaranteed, .. } = &fitted.margins;
    let kicks = EstimateRow::of_kicks(fitted, "margin", kicks);
    let guaranteed = guaranteed.iter();
    let guaranteed =
        guaranteed.flat_map(|kicks| EstimateRow::of_kicks(fitted, "guaranteed", kicks));
    kicks.into_iter().chain(guaranteed).collect()
}

/// The margins and what else follows from the numbers.
fn margins(fitted: &FitResult) -> Table {
    let Margins { cycle, fold, .. } = fitted.margins;
    let others = [
        EstimateRow::of_draws("stable cycle, right turning point", cycle, (1.0, fitted.unit())),
        EstimateRow::of_draws("D of the fold, above which all is survived", fold, (1.0, "")),
    ];
    estimate_columns().table(kick_rows(fitted).into_iter().chain(others)).lean()
}

/// What was measured, and how the motion goes.
fn subject(fitted: &FitResult) -> String {
    let estimate = &fitted.estimate;
    let Record { t, x, .. } = &estimate.data;
    let what = if estimate.data.has_peaks() {
        let times = if t.is_empty() { "without" } else { "with" };
        format!("{} peaks {times} times", x.len())
    } else {
        let span = estimate.data.duration();
        let begin = match estimate.start {
            StartKind::Release => "released within it",
            StartKind::Moving if estimate.count(DropReason::Before) > 0 => {
                "since the mass was struck"
            }
            StartKind::Moving => "in motion from its beginning",
        };
        let signal = fitted.record.signal;
        let of = if signal.is_displacement() {
            String::new()
        } else {
            format!(" of a {signal}")
        };
        format!("{} samples{of} over {} s, {begin}", t.len(), significant(span, 4))
    };
    let end = if estimate.rests { ", at rest at its end" } else { "" };
    format!("{what}, {} half swings{end}", estimate.half_swings)
}

/// Where the motion starts, and the noise.
fn start(fitted: &FitResult) -> String {
    let estimate = &fitted.estimate;
    let number = |name: &str, place: usize, unit: &str| {
        let error = estimate.covariance.error(place);
        format!("{name} = {}", with_error(estimate.p[place], error, unit))
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
    let noise = in_unit(&noise, &fitted.record.signal_unit());
    format!("start: {}; noise {noise}", parts.join(", "))
}

/// The correlations between the estimated numbers; empty for a single one.
fn correlations(fitted: &FitResult) -> Table {
    let estimate = &fitted.estimate;
    let wanted: Vec<&NameSpec> = estimate.wanted().collect();
    if wanted.len() < 2 {
        return Table::default();
    }
    let correlations = Columns::default().text("correlation", |row: &&NameSpec| row.name);
    let correlations = wanted.iter().fold(correlations, |columns, other| {
        let of = |row: &NameSpec| estimate.covariance.correlation(row.place, other.place);
        columns.text(other.name, move |row| format!("{:.3}", of(row)))
    });
    correlations.table(wanted.iter().copied())
}

/// Where the samples lie that do not count.
fn places(fitted: &FitResult) -> String {
    let time = |t| significant(t, 6);
    let place = |it: &Omission| match it.samples {
        1 => format!("{} s", time(it.from)),
        several => format!("{} .. {} s ({several} samples)", time(it.from), time(it.to)),
    };
    let places = left_out(&fitted.record, &fitted.estimate);
    let places = joined(places.iter().map(place), "; ");
    if places.is_empty() {
        return "every sample of the record that was read counts".to_owned();
    }
    format!("samples at these times do not count: {places}")
}

/// What the table of the margins shows.
fn draws(fitted: &FitResult) -> String {
    let impulse = if fitted.inertia().is_none() {
        ", impulses as velocity/omega0"
    } else {
        ""
    };
    format!(
        "margins, the smallest kicks not survived, from the worst rest position and from q = 0{impulse};\n\
         95 % lie from .. to, by {} effective draws; none: the share of the draws without",
        significant(fitted.margins.effective, 3)
    )
}
