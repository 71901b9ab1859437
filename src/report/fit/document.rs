//! A fit as one JSON document, and as rows of comma-separated values.

use std::collections::BTreeMap;

use crate::fit::{
    Combination, Dropped, Fitted, KickSpreads, LAST, NAMES, NameSpec, Q0, Spread, StartKind,
    combinations, kicks, left_out, rows,
};
use crate::report::columns::Columns;
use crate::report::json::Document;
use crate::words::fit::sentences;
use crate::words::statement::{SignedStatement, signed};

pub fn json(fitted: &Fitted) -> String {
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
        .with("start", start(fitted))
        .with_any("drift", estimate.drift())
        .with("correlations", correlations(fitted))
        .with("noise", estimate.covariance.deviation)
        .with("samples", estimate.data.values().len())
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

fn start(fitted: &Fitted) -> Document {
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

fn correlations(fitted: &Fitted) -> BTreeMap<String, f64> {
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

    fn of_spread(name: String, spread: Spread) -> Self {
        let Spread { median: value, lower, upper, .. } = spread;
        EstimateRow { name, value, standard_error: None, lower, upper, quadratic: false }
    }

    /// The margins.
    fn of_kicks(what: &str, kicks: &KickSpreads) -> [Self; 4] {
        let KickSpreads { displacement, impulse, from_rest } = *kicks;
        [
            ("displacement from rest", from_rest.displacement),
            ("impulse from rest", from_rest.impulse),
            ("displacement", displacement),
            ("impulse", impulse),
        ]
        .map(|(kick, spread)| EstimateRow::of_spread(format!("{what} {kick}"), spread))
    }
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

/// One row for each estimated number, then the margins.
pub fn csv(fitted: &Fitted) -> String {
    let numbers = fitted.estimate.wanted().map(|row| EstimateRow::of_number(fitted, row));
    let margins = EstimateRow::of_kicks("margin", &fitted.margins.kicks);
    let guaranteed = fitted.margins.guaranteed.as_ref();
    let guaranteed = guaranteed.map(|kicks| EstimateRow::of_kicks("guaranteed", kicks));
    let rows = numbers.chain(margins).chain(guaranteed.into_iter().flatten());
    value_columns(Columns::default().file("name", |row: &EstimateRow| row.name.clone())).csv(rows)
}
