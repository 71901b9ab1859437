//! The limit cycles, with what is proved about them.

use super::columns::Columns;
use super::cycle_numbers::{CycleNumber, cycle_fields, number_columns};
use super::json::Document;
use super::proof::{self, CycleBounds, certain, cycle_columns, enclosure};
use super::table::{cost, parameters};
use super::{basin, harmonic_balance};
use crate::accuracy::harmonic_error::HarmonicBalance;
use crate::closed_form::harmonic::Harmonic;
use crate::portrait::{Cycle, Cycles};
use crate::proof::{Enclosure, Proof};
use crate::words::number::significant;
use crate::words::stability;

/// Every cycle with what is proved about it, and the harmonic balance if asked for.
pub fn json(
    found: &Cycles,
    proof: &Proof,
    rungs: Option<&[HarmonicBalance]>,
    seconds: f64,
) -> String {
    Document::default()
        .with("parameters", found.parameters)
        .with("cycles", proof::documents(&found.cycles, proof))
        .with("count", proof::count(proof))
        .with("harmonic", &found.harmonic)
        .with_any("balance", rungs.map(harmonic_balance::documents))
        .with("basin", Document::default().with("edge", found.border))
        .cost(&found.cost, seconds)
        .text()
}

/// One row for each cycle and one for each interval of clearances that is open.
pub fn csv(found: &Cycles, proof: &Proof) -> String {
    type CycleRow<'a> = (Option<&'a Cycle>, CycleBounds<'a>);
    let columns = Columns::default()
        .and(cycle_fields(|(cycle, _): &CycleRow| cycle.copied()))
        .part("certified", cycle_columns(), |(_, bounds)| Some(*bounds));
    let proved = |cycle| (Some(cycle), CycleBounds::Cycle(enclosure(proof, cycle)));
    let open = proof.open.iter().map(|open| (None, CycleBounds::Open(open)));
    columns.csv(found.cycles.iter().map(proved).chain(open))
}

/// The cycles as text, with the digits that are certain.
fn cycle_table(found: &Cycles, proof: &Proof) -> String {
    type CycleRow<'a> = (&'a Cycle, Option<Enclosure>);
    /// Digits shown; cycles are computed to rounding error.
    const PLACES: usize = 12;
    if found.cycles.is_empty() {
        return String::new();
    }
    let kind = |(cycle, bounds): &CycleRow| {
        let not_proved = if bounds.is_some() { "" } else { ", not proved" };
        format!("{}{not_proved}", stability(cycle.stable))
    };
    let cell = |(cycle, bounds): &CycleRow, number: &CycleNumber| match bounds {
        Some(bounds) => certain((number.bounds)(bounds), PLACES),
        None => number.text(cycle, PLACES - 2),
    };
    let rows = found.cycles.iter().map(|cycle| (cycle, enclosure(proof, cycle)));
    let table = number_columns(Columns::default().text("cycle", kind), cell).table(rows);
    let table = table.to_string();
    format!("{table}\n{}", proof::uncertain(&table))
}

/// Every cycle to the digits that are proved, the answer of harmonic balance, and the border of the basin.
pub fn table(found: &Cycles, proof: &Proof, seconds: f64) -> String {
    let mut out = format!("{}\n\n", parameters(&found.parameters, None));
    out += &cycle_table(found, proof);
    out += &proof::sentence(found.cycles.len(), proof);
    let harmonic = |it: &Harmonic| {
        let [amplitude, mean] = [it.amplitude, it.mean].map(|value| significant(value, 6));
        format!("{} amplitude {amplitude}, mean {mean}", stability(it.stable))
    };
    let harmonic: Vec<String> = found.harmonic.iter().map(harmonic).collect();
    let harmonic = if harmonic.is_empty() { "none".to_owned() } else { harmonic.join("; ") };
    out += &format!("\nby one harmonic, for comparison: {harmonic}\n");
    out += basin::border(found.border);
    out + &cost(found.cost, seconds)
}
