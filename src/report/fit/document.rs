//! A fit as one JSON document, and as rows of comma-separated values.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::fit::Fitted;
use crate::fit::margin::Spread;
use crate::fit::names::NAMES;
use crate::fit::observation::{LAST, Q0, StartKind};
use crate::fit::physical::{self, kicks, rows};
use crate::fit::separable::combinations;
use crate::report::csv;
use crate::report::json;
use crate::words::fit::sentences;

#[derive(Serialize)]
struct Number {
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
struct Valley {
    half_swings: usize,
    delta_chi2: f64,
}

#[derive(Serialize)]
struct Residuals {
    correlation: f64,
    white: bool,
    systematic: bool,
}

#[derive(Serialize)]
struct Quantiles {
    median: Option<f64>,
    lower: Option<f64>,
    upper: Option<f64>,
    none: f64,
}

impl Quantiles {
    fn new(spread: &Spread, scale: f64) -> Self {
        let scaled = |value: Option<f64>| value.map(|value| value * scale);
        Quantiles {
            median: scaled(spread.median),
            lower: scaled(spread.lower),
            upper: scaled(spread.upper),
            none: spread.none,
        }
    }
}

#[derive(Serialize)]
struct Margin {
    displacement: Quantiles,
    impulse: Quantiles,
    /// Right turning point of the smallest stable cycle.
    cycle: Quantiles,
    /// The damping of the fold.
    fold: Quantiles,
    extrapolated: bool,
    draws: usize,
    /// Draws of equal weight that would tell as much, where they were weighted by their likelihood.
    #[serde(skip_serializing_if = "Option::is_none")]
    effective: Option<f64>,
    failed: usize,
}

#[derive(Serialize)]
struct PhysicalNumber {
    value: f64,
    standard_error: f64,
    unit: &'static str,
}

#[derive(Serialize)]
struct Physical {
    numbers: BTreeMap<&'static str, PhysicalNumber>,
    displacement: Quantiles,
    impulse: Quantiles,
}

#[derive(Serialize)]
struct Cost {
    with_derivatives: u64,
    without: u64,
    seconds: f64,
}

#[derive(Serialize)]
struct Document<'a> {
    file: &'a str,
    unit: Option<&'a str>,
    parameters: BTreeMap<&'static str, Number>,
    held: BTreeMap<&'static str, f64>,
    start: BTreeMap<&'static str, serde_json::Value>,
    correlations: BTreeMap<String, f64>,
    noise: f64,
    samples: usize,
    half_swings: usize,
    rests: bool,
    separable: Vec<Combined>,
    valleys: Vec<Valley>,
    outliers: usize,
    saturated: usize,
    excited_again: usize,
    missing: usize,
    repeated: usize,
    residuals: Residuals,
    margin: Margin,
    #[serde(skip_serializing_if = "Option::is_none")]
    physical: Option<Physical>,
    sentences: Vec<String>,
    cost: Cost,
}

pub fn json(fitted: &Fitted) -> String {
    let Fitted { record, estimate, margins, .. } = fitted;
    let parameters = estimate.wanted().map(|row| (row.name, number(fitted, row.place))).collect();
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
    let valleys = estimate
        .rivals
        .iter()
        .map(|it| Valley { half_swings: it.half_swings, delta_chi2: it.delta_chi2 })
        .collect();
    let (with_derivatives, without) = fitted.motions();
    json::text(&Document {
        file: &fitted.name,
        unit: record.unit.as_deref(),
        parameters,
        held,
        start: start(fitted),
        correlations: correlations(fitted),
        noise: estimate.covariance.deviation,
        samples: estimate.data.displacements().len(),
        half_swings: estimate.half_swings,
        rests: estimate.rests,
        separable,
        valleys,
        outliers: estimate.outliers(),
        saturated: estimate.saturated,
        excited_again: estimate.after,
        missing: record.missing,
        repeated: record.repeated,
        residuals: Residuals {
            correlation: estimate.whiteness.correlation,
            white: estimate.whiteness.white,
            systematic: estimate.whiteness.systematic,
        },
        margin: Margin {
            displacement: Quantiles::new(&margins.displacement, 1.0),
            impulse: Quantiles::new(&margins.impulse, 1.0),
            cycle: Quantiles::new(&margins.cycle, 1.0),
            fold: Quantiles::new(&margins.fold, 1.0),
            extrapolated: margins.extrapolated,
            draws: margins.draws.len(),
            effective: margins.effective,
            failed: margins.failed,
        },
        physical: physical(fitted),
        sentences: sentences(fitted),
        cost: Cost { with_derivatives, without, seconds: fitted.seconds },
    })
}

fn number(fitted: &Fitted, place: usize) -> Number {
    let estimate = &fitted.estimate;
    let interval = estimate.intervals[place];
    Number {
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
            let both = covariance.error(one.place) * covariance.error(other.place);
            let name = format!("{},{}", one.name, other.name);
            all.insert(name, covariance.of(one.place, other.place) / both);
        }
    }
    all
}

fn physical(fitted: &Fitted) -> Option<Physical> {
    let (metres, impulse) = kicks(fitted)?;
    let number = |row: physical::EstimatedNumber| {
        let physical::EstimatedNumber { name, value, standard_error, unit } = row;
        (name, PhysicalNumber { value, standard_error, unit })
    };
    Some(Physical {
        numbers: rows(fitted).into_iter().map(number).collect(),
        displacement: Quantiles::new(&fitted.margins.displacement, metres),
        impulse: Quantiles::new(&fitted.margins.impulse, impulse),
    })
}

/// One row for each estimated number, then the margins.
pub fn csv(fitted: &Fitted) -> String {
    let numbers = fitted.estimate.wanted().map(|row| {
        let Number { value, standard_error, lower, upper, .. } = number(fitted, row.place);
        Row {
            name: row.name,
            value: Some(value),
            standard_error: Some(standard_error),
            lower,
            upper,
        }
    });
    let margins = [
        ("margin displacement", &fitted.margins.displacement),
        ("margin impulse", &fitted.margins.impulse),
    ];
    let margins = margins.map(|(name, spread)| Row {
        name,
        value: spread.median,
        standard_error: None,
        lower: spread.lower,
        upper: spread.upper,
    });
    csv::sheet(&Row::default(), numbers.chain(margins))
}

/// An estimated number or a margin.
#[derive(Default, Serialize)]
struct Row {
    name: &'static str,
    value: Option<f64>,
    standard_error: Option<f64>,
    lower: Option<f64>,
    upper: Option<f64>,
}
