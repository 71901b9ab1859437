//! The harmonic balance beside the true cycles: what each number of harmonics gives, and how wrong it is.
//!
//! One row for each first-order answer and each number of harmonics, in every form of output. A row
//! whose branch was lost on the way to that many harmonics has no numbers and says why; one without
//! errors has no true cycle to be compared with.

use serde::Serialize;

use super::csv::{exact_or_empty, line};
use super::table::Table;
use crate::closed_form::harmonics::HarmonicCycle;
use crate::study::harmonic_error::{Balanced, HarmonicBalance};
use crate::view::number::significant;

/// One number of harmonics on the branch of one first-order answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
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

impl Row {
    fn new(harmonics: usize, balanced: &Balanced) -> Self {
        let cycle = balanced.cycle.as_ref();
        let of = |number: fn(&HarmonicCycle) -> f64| cycle.ok().map(number);
        Row {
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
#[must_use]
pub fn rows(rungs: &[HarmonicBalance]) -> Vec<Row> {
    let branches = rungs.first().map_or(0, |rung| rung.balanced.len());
    let row = |branch: usize, rung: &HarmonicBalance| {
        rung.balanced.get(branch).map(|balanced| Row::new(rung.harmonics, balanced))
    };
    (0..branches)
        .flat_map(|branch| rungs.iter().filter_map(move |rung| row(branch, rung)))
        .collect()
}

/// As a table, with what is to be said about its rows below it.
#[must_use]
pub fn table(rungs: &[HarmonicBalance]) -> String {
    /// Digits of a cycle that is an approximation.
    const PLACES: usize = 6;
    let rows = rows(rungs);
    if rows.is_empty() {
        return "\nby harmonic balance: none\n".to_owned();
    }
    let mut table = Table::new(&[
        "balance",
        "harmonics",
        "q_min",
        "q_max",
        "v_max",
        "period",
        "error of amplitude",
        "of frequency",
    ]);
    let number = |value: Option<f64>| value.map_or("-".into(), |value| significant(value, PLACES));
    let percent = |value: Option<f64>| {
        value.map_or("-".into(), |value| format!("{} %", significant(100.0 * value, 3)))
    };
    let mut notes = Vec::new();
    for row in &rows {
        let stability = if row.stable { "stable" } else { "unstable" };
        table.row(vec![
            stability.to_owned(),
            row.harmonics.to_string(),
            number(row.q_min),
            number(row.q_max),
            number(row.v_max),
            number(row.period),
            percent(row.amplitude_error),
            percent(row.frequency_error),
        ]);
        let most = rungs.last().map(|rung| rung.harmonics);
        if most == Some(row.harmonics) {
            notes.extend(note(row).map(|note| format!("{stability}: {note}\n")));
        }
    }
    if rows.iter().any(|row| row.lost.is_none() && row.amplitude_error.is_none()) {
        notes.push("without an error: there is no such cycle to compare with\n".to_owned());
    }
    format!("\n{table}{}", notes.concat())
}

/// What is to be said about a row.
fn note(row: &Row) -> Option<String> {
    let crossings = row.crossings.filter(|crossings| *crossings != 2);
    let more = crossings.map(|crossings| {
        let harmonics = row.harmonics;
        format!("{harmonics} harmonics have v = 0 at {crossings} instants of a turn, a cycle at 2")
    });
    row.lost.clone().or(more)
}

/// As comma-separated values.
#[must_use]
pub fn csv(rungs: &[HarmonicBalance]) -> String {
    let head = "harmonics,stable,amplitude,mean,q_min,q_max,v_min,v_max,period,crossings,residual,\
                amplitude_error,frequency_error,lost\n";
    let row = |row: &Row| {
        let numbers =
            [row.amplitude, row.mean, row.q_min, row.q_max, row.v_min, row.v_max, row.period];
        let mut cells = vec![row.harmonics.to_string(), row.stable.to_string()];
        cells.extend(numbers.map(exact_or_empty));
        cells.push(row.crossings.map_or_else(String::new, |crossings| crossings.to_string()));
        cells.extend([row.residual, row.amplitude_error, row.frequency_error].map(exact_or_empty));
        cells.push(row.lost.clone().unwrap_or_default());
        line(&cells)
    };
    std::iter::once(head.to_owned()).chain(rows(rungs).iter().map(row)).collect()
}
