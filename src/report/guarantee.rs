//! Guaranteed margins as text.

use serde::Serialize;

use super::csv;
use super::json::{CountedCost, text};
use super::table::Table;
use crate::oscillator::{Interval, Knob, ParameterBox};
use crate::portrait::Margin;
use crate::study::guarantee::{Guarantee, Guaranteed};
use crate::words::number::{duration, significant};

#[derive(Serialize)]
struct GuaranteeDocument<'a> {
    nominal: Margin,
    guaranteed: Guaranteed,
    disturbance: f64,
    parameters: &'a ParameterBox,
    cost: CountedCost,
}

/// One of the two margins.
#[derive(Serialize)]
struct GuaranteeRow {
    margin: &'static str,
    #[serde(flatten)]
    found: Margin,
    reason: Option<String>,
}

pub fn json(found: &Guarantee, seconds: f64) -> String {
    text(&GuaranteeDocument {
        nominal: found.nominal,
        guaranteed: found.guaranteed,
        disturbance: found.disturbance,
        parameters: &found.known,
        cost: CountedCost { counted: found.cost, seconds },
    })
}

/// One row for the nominal and one for the guaranteed margin.
pub fn csv(found: &Guarantee) -> String {
    let nominal = GuaranteeRow { margin: "nominal", found: found.nominal, reason: None };
    let Guaranteed { margin, reason } = found.guaranteed;
    let reason = reason.map(|reason| reason.to_string());
    csv::sheet(&nominal, [&nominal, &GuaranteeRow { margin: "guaranteed", found: margin, reason }])
}

/// Factor that keeps a number written with 12 digits from being rounded up.
const BELOW: f64 = 1.0 - 5e-12;

/// As a table; guaranteed numbers are not rounded up.
pub fn table(found: &Guarantee, seconds: f64) -> String {
    let ParameterBox { d, d2, d3, r } = found.known;
    let names = Knob::PARAMETERS.map(|symbol| symbol.spec().name);
    let parameters = names.iter().zip([d, d2, d3, r]).map(|(name, value)| interval(name, value));
    let parameters = parameters.collect::<Vec<_>>().join(", ");
    let mut table = Table::new(&["smallest kick that is not survived", "displacement", "impulse"]);
    let mut rows = |name: &str, Margin { displacement, impulse, from_rest }: Margin| {
        let size = |value: Option<f64>| value.map_or("none".to_owned(), |it| significant(it, 12));
        let mut row = |from: &str, [displacement, impulse]: [Option<f64>; 2]| {
            table.row(vec![format!("{name}, from {from}"), size(displacement), size(impulse)]);
        };
        row("any rest position", [from_rest.displacement, from_rest.impulse]);
        row("q = 0", [displacement, impulse]);
    };
    rows("nominal", found.nominal);
    let below = |size: f64| BELOW * size;
    let nothing = found.guaranteed.reason;
    let nothing = nothing.map(|reason| format!("nothing is guaranteed: {reason}\n"));
    if nothing.is_none() {
        rows("guaranteed", found.guaranteed.margin.map(below, below));
    }
    let nothing = nothing.unwrap_or_default();
    format!(
        "{parameters}; disturbance {}\n\n{table}{nothing}\n{} evaluations, {}\n",
        significant(found.disturbance, 12),
        found.cost.evaluations,
        duration(seconds)
    )
}

fn interval(name: &str, interval: Interval) -> String {
    if interval.is_point() {
        format!("{name} = {}", significant(interval.lower(), 12))
    } else {
        format!(
            "{name} in {} .. {}",
            significant(interval.lower(), 12),
            significant(interval.upper(), 12)
        )
    }
}
