//! Guaranteed margins as text.

use super::columns::{Columns, Quantity};
use super::json::Document;
use super::table::cost;
use crate::model::{Interval, Knob, ParameterBox};
use crate::portrait::guarantee::oscillator::{Guarantee, Guaranteed, Uncertain};
use crate::portrait::{Margin, RestMargin};
use crate::words::number::significant;

pub fn json(found: &Guarantee, seconds: f64) -> String {
    Document::default()
        .with("nominal", found.nominal)
        .with("guaranteed", found.guaranteed)
        .with("disturbance", found.disturbance)
        .with("parameters", found.known)
        .cost(&found.cost, seconds)
        .text()
}

/// One row for the nominal and one for the guaranteed margin.
pub fn csv(found: &Guarantee) -> String {
    let Guaranteed { margin, reason } = found.guaranteed;
    let columns = Columns::default()
        .file("margin", |(name, ..): &(&str, Margin, Option<_>)| (*name).to_owned())
        .and(margin_columns(|(_, margin, _)| *margin))
        .file("reason", |(_, _, reason)| reason.map(|it: Uncertain| it.to_string()));
    columns.csv([("nominal", found.nominal, None), ("guaranteed", margin, reason)])
}

/// The columns of margins.
pub(super) fn margin_columns<'a, R: 'a>(
    margin: impl Fn(&R) -> Margin + Copy + 'a,
) -> Columns<'a, R> {
    Columns::default()
        .file("displacement", move |row| margin(row).displacement)
        .file("impulse", move |row| margin(row).impulse)
        .file("from_rest_displacement", move |row| margin(row).from_rest.displacement)
        .file("from_rest_impulse", move |row| margin(row).from_rest.impulse)
}

/// Factor that keeps a number written with 12 digits from being rounded up.
const BELOW: f64 = 1.0 - 5e-12;

/// As a table; guaranteed numbers are not rounded up.
pub fn table(found: &Guarantee, seconds: f64) -> String {
    let ParameterBox { d, d2, d3, r } = found.known;
    let names = Knob::PARAMETERS.map(|symbol| symbol.spec().name);
    let parameters = names.iter().zip([d, d2, d3, r]).map(|(name, value)| interval(name, value));
    let parameters = parameters.collect::<Vec<_>>().join(", ");
    let nothing = found.guaranteed.reason;
    let nothing = nothing.map(|reason| format!("nothing is guaranteed: {reason}\n"));
    let below = |size: f64| BELOW * size;
    let guaranteed = found.guaranteed.margin.map(below, below);
    let guaranteed = nothing.is_none().then_some(("guaranteed", guaranteed));
    let rows = |(name, margin): (&str, Margin)| {
        let Margin { displacement, impulse, from_rest } = margin;
        [
            (format!("{name}, from any rest position"), from_rest),
            (format!("{name}, from q = 0"), RestMargin { displacement, impulse }),
        ]
    };
    let size = Quantity::pure(12).or("none");
    let table = Columns::default()
        .text("smallest kick that is not survived", |(name, _): &(String, RestMargin)| name.clone())
        .text("displacement", move |(_, kicks)| size.text(kicks.displacement))
        .text("impulse", move |(_, kicks)| size.text(kicks.impulse))
        .table(std::iter::once(("nominal", found.nominal)).chain(guaranteed).flat_map(rows));
    format!(
        "{parameters}; disturbance {}\n\n{table}{}\n{}",
        significant(found.disturbance, 12),
        nothing.unwrap_or_default(),
        cost(found.cost, seconds)
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
