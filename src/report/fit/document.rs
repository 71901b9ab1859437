//! A fit as one JSON document, and as rows of comma-separated values.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::fit::conditions::Condition;
use crate::fit::drift::FittedDrift;
use crate::fit::estimate::Rival;
use crate::fit::left_out::{LeftOut, left_out};
use crate::fit::margin::{KickSpreads, Margins, Spread};
use crate::fit::names::NAMES;
use crate::fit::observation::{LAST, Q0, StartKind};
use crate::fit::physical::{EstimatedNumber, kicks, rows};
use crate::fit::residuals::Whiteness;
use crate::fit::separable::combinations;
use crate::fit::{Fitted, Signal};
use crate::report::csv;
use crate::report::json;
use crate::words::fit::sentences;
use crate::words::statement::{SignedStatement, Statement, signed};

#[derive(Serialize)]
struct EstimateDocument {
    value: f64,
    standard_error: f64,
    lower: Option<f64>,
    upper: Option<f64>,
    quadratic: bool,
}

#[derive(Serialize)]
struct Combined {
    combination: BTreeMap<&'static str, f64>,
    value: f64,
    standard_error: f64,
}

#[derive(Serialize)]
struct Physical {
    numbers: BTreeMap<&'static str, EstimatedNumber>,
    #[serde(flatten)]
    kicks: KickSpreads,
    #[serde(skip_serializing_if = "Option::is_none")]
    guaranteed: Option<KickSpreads>,
}

#[derive(Serialize)]
struct FitCost {
    with_derivatives: u64,
    without: u64,
    seconds: f64,
}

/// The draws on which the margin rests.
#[derive(Serialize)]
struct Draws {
    effective: f64,
}

#[derive(Serialize)]
struct FitDocument<'a> {
    file: &'a str,
    unit: Option<&'a str>,
    signal: Signal,
    parameters: BTreeMap<&'static str, EstimateDocument>,
    held: BTreeMap<&'static str, f64>,
    start: BTreeMap<&'static str, serde_json::Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drift: Option<FittedDrift>,
    correlations: BTreeMap<String, f64>,
    noise: f64,
    samples: usize,
    half_swings: usize,
    rests: bool,
    separable: Vec<Combined>,
    valleys: &'a [Rival],
    outliers: usize,
    saturated: usize,
    excited_again: usize,
    missing: usize,
    repeated: usize,
    left_out: Vec<LeftOut>,
    residuals: &'a Whiteness,
    margin: &'a Margins,
    #[serde(skip_serializing_if = "Option::is_none")]
    physical: Option<Physical>,
    statement: Statement,
    conditions: Vec<Condition>,
    draws: Draws,
    sentences: Vec<String>,
    cost: FitCost,
}

pub fn json(fitted: &Fitted) -> String {
    let Fitted { record, estimate, margins, .. } = fitted;
    let parameters =
        estimate.wanted().map(|row| (row.name, estimated(fitted, row.place))).collect();
    let held = NAMES
        .iter()
        .filter(|row| !estimate.free[row.place])
        .filter_map(|row| Some((row.name, estimate.choice.held(row)?)))
        .collect();
    let separable = combinations(estimate)
        .into_iter()
        .map(|it| Combined {
            combination: it.terms.iter().map(|(row, weight)| (row.name, *weight)).collect(),
            value: it.value,
            standard_error: it.standard_error,
        })
        .collect();
    let (with_derivatives, without) = fitted.motions();
    let SignedStatement { statement, conditions } = signed(fitted);
    json::text(&FitDocument {
        file: &fitted.name,
        unit: record.unit.as_deref(),
        signal: record.signal,
        parameters,
        held,
        start: start(fitted),
        drift: estimate.drift(),
        correlations: correlations(fitted),
        noise: estimate.covariance.deviation,
        samples: estimate.data.values().len(),
        half_swings: estimate.half_swings,
        rests: estimate.rests,
        separable,
        valleys: &estimate.rivals,
        outliers: estimate.outliers(),
        saturated: estimate.saturated,
        excited_again: estimate.after,
        missing: record.missing,
        repeated: record.repeated,
        left_out: left_out(record, estimate),
        residuals: &estimate.whiteness,
        margin: margins,
        physical: physical(fitted),
        statement,
        conditions,
        draws: Draws { effective: margins.effective },
        sentences: sentences(fitted),
        cost: FitCost { with_derivatives, without, seconds: fitted.seconds },
    })
}

fn estimated(fitted: &Fitted, place: usize) -> EstimateDocument {
    let estimate = &fitted.estimate;
    let interval = estimate.intervals[place];
    EstimateDocument {
        value: estimate.p[place],
        standard_error: estimate.covariance.error(place),
        lower: interval.lower,
        upper: interval.upper,
        quadratic: interval.quadratic,
    }
}

fn start(fitted: &Fitted) -> BTreeMap<&'static str, serde_json::Value> {
    let estimate = &fitted.estimate;
    let value = |place: usize| {
        serde_json::json!({
            "standard_error": estimate.covariance.error(place),
            "value": estimate.p[place],
        })
    };
    let (kind, last) = match estimate.start {
        StartKind::Release => ("release", "t0"),
        StartKind::Moving => ("moving", "v0"),
    };
    let mut start = BTreeMap::from([("kind", kind.into()), ("q0", value(Q0))]);
    if estimate.free[LAST] {
        start.insert(last, value(LAST));
    }
    if estimate.before > 0 {
        start.insert("struck_after", estimate.before.into());
    }
    start
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

fn physical(fitted: &Fitted) -> Option<Physical> {
    let scales = kicks(fitted)?;
    let scaled = |spreads: &KickSpreads| spreads.scaled(scales.0, scales.1);
    Some(Physical {
        numbers: rows(fitted).into_iter().map(|number| (number.name, number)).collect(),
        kicks: scaled(&fitted.margins.kicks()),
        guaranteed: fitted.margins.guaranteed.as_ref().map(scaled),
    })
}

/// One row for each estimated number, then the margins.
pub fn csv(fitted: &Fitted) -> String {
    let numbers = fitted.estimate.wanted().map(|row| {
        let EstimateDocument { value, standard_error, lower, upper, .. } =
            estimated(fitted, row.place);
        EstimateRow {
            name: row.name.to_owned(),
            value: Some(value),
            standard_error: Some(standard_error),
            lower,
            upper,
        }
    });
    let spreads = |what: &str, kicks: KickSpreads| {
        let KickSpreads { displacement, impulse, from_rest } = kicks;
        let row = |kick: &str, spread: Spread| EstimateRow {
            name: format!("{what} {kick}"),
            value: spread.median,
            standard_error: None,
            lower: spread.lower,
            upper: spread.upper,
        };
        [
            row("displacement from rest", from_rest.displacement),
            row("impulse from rest", from_rest.impulse),
            row("displacement", displacement),
            row("impulse", impulse),
        ]
    };
    let margins = spreads("margin", fitted.margins.kicks());
    let guaranteed = fitted.margins.guaranteed.map(|kicks| spreads("guaranteed", kicks));
    csv::sheet(
        &EstimateRow::default(),
        numbers.chain(margins).chain(guaranteed.into_iter().flatten()),
    )
}

/// An estimated number or a margin.
#[derive(Default, Serialize)]
struct EstimateRow {
    name: String,
    value: Option<f64>,
    standard_error: Option<f64>,
    lower: Option<f64>,
    upper: Option<f64>,
}
