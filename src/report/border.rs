//! The fold and the escape point along a second parameter.

use serde::Serialize;

use super::certified::{BorderProof, IntervalDocument};
use super::csv::CsvSheet;
use super::json::{self, CountedCost};
use super::table::{Table, parameters, rounded};
use crate::numerics::Interval;
use crate::oscillator::{Knob, Parameters};
use crate::study::fold::{Boundary, BoundaryPoint};
use crate::words::number::{duration, significant};

#[derive(Serialize)]
struct BorderDocument<'a> {
    parameters: &'a Parameters,
    parameter: Knob,
    points: &'a [BoundaryPoint],
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<&'a [BorderProof]>,
    cost: CountedCost,
}

/// The fold and the escape point at one value of the second parameter.
#[derive(Default, Serialize)]
struct BorderRow<'a> {
    value: f64,
    #[serde(rename = "D_F")]
    fold: Option<f64>,
    q_max: Option<f64>,
    period: Option<f64>,
    #[serde(rename = "D_F_harmonic")]
    harmonic_fold: Option<f64>,
    #[serde(rename = "D_c")]
    escape: Option<f64>,
    reason: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<BorderBounds>,
}

/// The enclosures of both, with a column for each bound.
#[derive(Serialize)]
struct BorderBounds {
    #[serde(rename = "D_F")]
    fold: Option<IntervalDocument>,
    #[serde(rename = "D_c")]
    escape: Option<IntervalDocument>,
    proved: bool,
    open: String,
}

pub fn json(found: &Boundary, certified: Option<&[BorderProof]>, seconds: f64) -> String {
    json::text(&BorderDocument {
        parameters: &found.parameters,
        parameter: found.second,
        points: &found.points,
        certified,
        cost: CountedCost { counted: found.cost, seconds },
    })
}

/// One row for each value of the second parameter.
pub fn csv(found: &Boundary, certified: Option<&[BorderProof]>) -> String {
    let all = || Some(Interval::ALL.into());
    let like = BorderRow {
        certified: certified.map(|_| BorderBounds {
            fold: all(),
            escape: all(),
            proved: false,
            open: String::new(),
        }),
        ..BorderRow::default()
    };
    let mut sheet = CsvSheet::like(&like, &[("value", found.second.spec().name)]);
    for (index, point) in found.points.iter().enumerate() {
        let certified = certified.and_then(|all| all.get(index)).map(|it| BorderBounds {
            fold: it.fold,
            escape: it.escape,
            proved: it.proved,
            open: it.open.join(", "),
        });
        sheet.row(&BorderRow {
            value: point.value,
            fold: point.fold.map(|fold| fold.d),
            q_max: point.fold.map(|fold| fold.q_max),
            period: point.fold.map(|fold| fold.period),
            harmonic_fold: point.harmonic_fold,
            escape: point.escape,
            reason: point.reason.as_deref(),
            certified,
        });
    }
    sheet.into_text()
}

/// A table with one row for each value of the second parameter.
pub fn table(found: &Boundary, seconds: f64) -> String {
    const PLACES: usize = 12;
    let kind = |grazes: bool| if grazes { "grazing" } else { "fold" };
    let table = Table::of(
        &found.points,
        &[
            (found.second.spec().name, &|point| significant(point.value, 10)),
            ("D_F", &|point| rounded(point.fold.map(|fold| fold.d), PLACES)),
            ("is a", &|point| point.fold.map_or("-", |fold| kind(fold.grazes)).to_owned()),
            ("q_max there", &|point| rounded(point.fold.map(|fold| fold.q_max), 8)),
            ("D_F of (48)", &|point| rounded(point.harmonic_fold, 8)),
            ("D_c", &|point| rounded(point.escape, PLACES)),
        ],
    );
    let given_up = found.points.iter().filter_map(|point| {
        let reason = point.reason.as_ref()?;
        Some(format!("\n{} = {}: {reason}", found.second, significant(point.value, 10)))
    });
    let given_up: String = given_up.collect();
    let fixed = parameters(&found.parameters, Some(found.second));
    let cost = format!("{} evaluations, {}", found.cost.evaluations, duration(seconds));
    format!("{fixed}\n\n{table}{given_up}\n{cost}\n")
}
