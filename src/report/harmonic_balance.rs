//! Harmonic balance compared with the true cycles: the result for each number of harmonics, and its error.
//!
//! One row for each first-order answer and each number of harmonics, in every form of output. If the branch
//! was lost before that number of harmonics was reached, the row has no numbers and says why. A row without
//! errors has no true cycle to be compared with.

use serde::Serialize;

use super::csv;
use super::table::{Table, rounded};
use crate::closed_form::harmonics::HarmonicCycle;
use crate::study::harmonic_error::{BalanceResult, HarmonicBalance};
use crate::words::number::significant;
use crate::words::stability;

/// The result for one number of harmonics on the branch of one first-order answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BalanceRow {
    harmonics: usize,
    stable: bool,
    amplitude: Option<f64>,
    mean: Option<f64>,
    q_min: Option<f64>,
    q_max: Option<f64>,
    v_min: Option<f64>,
    v_max: Option<f64>,
    period: Option<f64>,
    crossings: Option<usize>,
    residual: Option<f64>,
    amplitude_error: Option<f64>,
    frequency_error: Option<f64>,
    lost: Option<String>,
}

impl BalanceRow {
    fn new(harmonics: usize, balanced: &BalanceResult) -> Self {
        let cycle = balanced.cycle.as_ref();
        let of = |number: fn(&HarmonicCycle) -> f64| cycle.ok().map(number);
        BalanceRow {
            harmonics,
            stable: balanced.first.stable,
            amplitude: of(HarmonicCycle::amplitude),
            mean: of(|cycle| cycle.mean),
            q_min: of(|cycle| cycle.q_min),
            q_max: of(|cycle| cycle.q_max),
            v_min: of(|cycle| cycle.v_min),
            v_max: of(|cycle| cycle.v_max),
            period: of(|cycle| cycle.period),
            crossings: cycle.ok().map(|cycle| cycle.crossings),
            residual: of(|cycle| cycle.residual),
            amplitude_error: balanced.error.map(|error| error.amplitude),
            frequency_error: balanced.error.map(|error| error.frequency),
            lost: cycle.err().map(ToString::to_string),
        }
    }
}

/// All rows, branch by branch.
pub fn rows(rungs: &[HarmonicBalance]) -> Vec<BalanceRow> {
    let branches = rungs.first().map_or(0, |rung| rung.balanced.len());
    let row = |branch: usize, rung: &HarmonicBalance| {
        rung.balanced.get(branch).map(|balanced| BalanceRow::new(rung.harmonics, balanced))
    };
    (0..branches)
        .flat_map(|branch| rungs.iter().filter_map(move |rung| row(branch, rung)))
        .collect()
}

/// As a table, with notes on its rows below it.
pub fn table(rungs: &[HarmonicBalance]) -> String {
    /// Digits shown of a cycle, which is an approximation here.
    const PLACES: usize = 6;
    let rows = rows(rungs);
    if rows.is_empty() {
        return "\nby harmonic balance: none\n".to_owned();
    }
    let number = |value| rounded(value, PLACES);
    let percent = |value: Option<f64>| {
        value.map_or("-".into(), |value| format!("{} %", significant(100.0 * value, 3)))
    };
    let table = Table::of(
        &rows,
        &[
            ("balance", &|row| stability(row.stable).to_owned()),
            ("harmonics", &|row| row.harmonics.to_string()),
            ("q_min", &|row| number(row.q_min)),
            ("q_max", &|row| number(row.q_max)),
            ("v_max", &|row| number(row.v_max)),
            ("period", &|row| number(row.period)),
            ("error of amplitude", &|row| percent(row.amplitude_error)),
            ("of frequency", &|row| percent(row.frequency_error)),
        ],
    );
    let most = rungs.last().map(|rung| rung.harmonics);
    let last = rows.iter().filter(|row| most == Some(row.harmonics));
    let mut notes: Vec<String> = last
        .filter_map(|row| Some(format!("{}: {}\n", stability(row.stable), note(row)?)))
        .collect();
    if rows.iter().any(|row| row.lost.is_none() && row.amplitude_error.is_none()) {
        notes.push("without an error: there is no such cycle to compare with\n".to_owned());
    }
    format!("\n{table}{}", notes.concat())
}

/// A note on a row, if it needs one.
fn note(row: &BalanceRow) -> Option<String> {
    let crossings = row.crossings.filter(|crossings| *crossings != 2);
    let more = crossings.map(|crossings| {
        let harmonics = row.harmonics;
        format!("{harmonics} harmonics have v = 0 at {crossings} instants of a turn, a cycle at 2")
    });
    row.lost.clone().or(more)
}

pub fn csv(rungs: &[HarmonicBalance]) -> String {
    csv::sheet(&BalanceRow::default(), rows(rungs))
}
