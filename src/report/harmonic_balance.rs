//! Harmonic balance compared with the true cycles: the result for each number of harmonics, and its error.
//!
//! One row for each first-order answer and each number of harmonics, in every form of output. If the branch
//! was lost before that number of harmonics was reached, the row has no numbers and says why. A row without
//! errors has no true cycle to be compared with.

use super::columns::{Columns, Quantity};
use super::json::Document;
use crate::accuracy::harmonic_error::{BalanceResult, HarmonicBalance};
use crate::closed_form::harmonics::HarmonicCycle;
use crate::words::number::significant;
use crate::words::stability;

/// The result for one number of harmonics on the branch of one first-order answer.
type BalanceRow<'a> = (usize, &'a BalanceResult);

fn columns<'a>() -> Columns<'a, BalanceRow<'a>> {
    /// Digits shown of a cycle, which is an approximation here.
    const NUMBER: Quantity = Quantity::pure(6);
    fn of((_, balanced): &BalanceRow, number: fn(&HarmonicCycle) -> f64) -> Option<f64> {
        balanced.cycle.as_ref().ok().map(number)
    }
    let percent = |value: Option<f64>| {
        value.map_or("-".into(), |value| format!("{} %", significant(100.0 * value, 3)))
    };
    Columns::default()
        .text("balance", |(_, balanced): &BalanceRow| stability(balanced.first.stable).to_owned())
        .word("harmonics", |(harmonics, _)| *harmonics)
        .file("stable", |(_, balanced)| balanced.first.stable)
        .file("amplitude", |row| of(row, HarmonicCycle::amplitude))
        .file("mean", |row| of(row, |cycle| cycle.mean))
        .number("q_min", NUMBER, |row| of(row, |cycle| cycle.q_min))
        .number("q_max", NUMBER, |row| of(row, |cycle| cycle.q_max))
        .file("v_min", |row| of(row, |cycle| cycle.v_min))
        .number("v_max", NUMBER, |row| of(row, |cycle| cycle.v_max))
        .number("period", NUMBER, |row| of(row, |cycle| cycle.period))
        .file("crossings", crossings)
        .file("residual", |row| of(row, |cycle| cycle.residual))
        .file("amplitude_error", |(_, balanced)| balanced.error.map(|error| error.amplitude))
        .text("error of amplitude", move |(_, balanced)| {
            percent(balanced.error.map(|error| error.amplitude))
        })
        .file("frequency_error", |(_, balanced)| balanced.error.map(|error| error.frequency))
        .text("of frequency", move |(_, balanced)| {
            percent(balanced.error.map(|error| error.frequency))
        })
        .file("lost", lost)
}

/// How often a turn has v = 0.
fn crossings((_, balanced): &BalanceRow) -> Option<usize> {
    balanced.cycle.as_ref().ok().map(|cycle| cycle.crossings)
}

/// Why there is no cycle.
fn lost((_, balanced): &BalanceRow) -> Option<String> {
    balanced.cycle.as_ref().err().map(ToString::to_string)
}

/// All rows, branch by branch.
fn rows(rungs: &[HarmonicBalance]) -> Vec<BalanceRow<'_>> {
    let branches = rungs.first().map_or(0, |rung| rung.balanced.len());
    (0..branches)
        .flat_map(|branch| rungs.iter().map(move |rung| (rung, branch)))
        .filter_map(|(rung, branch)| Some((rung.harmonics, rung.balanced.get(branch)?)))
        .collect()
}

/// As objects of a document.
pub fn documents(rungs: &[HarmonicBalance]) -> Vec<Document> {
    columns().objects(rows(rungs))
}

/// As a table, with notes on its rows below it.
pub fn table(rungs: &[HarmonicBalance]) -> String {
    let rows = rows(rungs);
    if rows.is_empty() {
        return "\nby harmonic balance: none\n".to_owned();
    }
    let most = rungs.last().map(|rung| rung.harmonics);
    let last = rows.iter().filter(|(harmonics, _)| most == Some(*harmonics));
    let mut notes: Vec<String> = last
        .filter_map(|row| Some(format!("{}: {}\n", stability(row.1.first.stable), note(row)?)))
        .collect();
    if rows.iter().any(|(_, balanced)| balanced.cycle.is_ok() && balanced.error.is_none()) {
        notes.push("without an error: there is no such cycle to compare with\n".to_owned());
    }
    format!("\n{}{}", columns().table(rows), notes.concat())
}

/// A note on a row, if it needs one.
fn note(row: &BalanceRow) -> Option<String> {
    let more = crossings(row).filter(|crossings| *crossings != 2).map(|crossings| {
        let harmonics = row.0;
        format!("{harmonics} harmonics have v = 0 at {crossings} instants of a turn, a cycle at 2")
    });
    lost(row).or(more)
}

pub fn csv(rungs: &[HarmonicBalance]) -> String {
    columns().csv(rows(rungs))
}
