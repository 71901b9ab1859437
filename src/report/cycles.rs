//! The limit cycles: of the oscillator of the paper with what is proved about them and the answers of harmonic balance,
//! of a machine in SI units.

use super::answer::PLACES;
use super::cycle_numbers::{CycleNumber, NUMBERS, cycle_fields, number_columns};
use super::proof::{self, CycleBounds, certain, cycle_columns, enclosure};
use super::{About, Answer, Columns, Document, Quantity};
use crate::accuracy::harmonic_error::{BalanceResult, HarmonicBalance};
use crate::closed_form::harmonic::Harmonic;
use crate::closed_form::harmonics::HarmonicCycle;
use crate::flow::Cost;
use crate::portrait::{Border, Cycle, Cycles, Portrait};
use crate::proof::{Enclosure, Proof};
use crate::words::{significant, stability, with_unit};

/// The columns of cycles of a machine: those of every oscillator, and what machines add.
pub(super) fn machine_cycles<'a, R: 'a>(
    cycle: impl Fn(&R) -> Option<Cycle> + Copy + 'a,
) -> Columns<'a, R> {
    let described = |cycle: Cycle| {
        let over = if cycle.overtakes { ", overtaking" } else { "" };
        format!("{} {}{over}", stability(cycle.stable), cycle.kind())
    };
    let columns = Columns::default()
        .file("kind", move |row| cycle(row).map(|it| it.kind()))
        .file("overtakes", move |row| cycle(row).map(|it| it.overtakes))
        .and(cycle_fields(cycle))
        .file("stick_duration", move |row| cycle(row).map(|it| it.stick_duration()))
        .text("cycle", move |row| cycle(row).map_or_else(|| "-".to_owned(), described));
    let shown = NUMBERS.iter().filter(|number| !number.title.is_empty());
    shown.fold(columns, |columns, CycleNumber { title, unit, value, .. }| {
        let text = |cycle: Cycle| Quantity::of(unit, PLACES).text(value(&cycle));
        columns.text(title, move |row| cycle(row).map(text).unwrap_or_default())
    })
}

/// A cycle with what is proved about it, or an interval of clearances that is open.
type CycleRow<'a> = (Option<&'a Cycle>, CycleBounds<'a>);

/// Every cycle with what is proved about it, to the digits that are proved in text; the border of the basin; the harmonic
/// balance if asked for. One row for each cycle and one for each interval of clearances that is open.
pub fn cycles<'a>(
    about: &'a About,
    found: &'a Cycles,
    proof: &'a Proof,
    rungs: Option<&'a [HarmonicBalance]>,
    seconds: f64,
) -> Answer<'a> {
    let document = move || {
        Document::default()
            .with("cycles", proof::documents(&found.cycles, proof))
            .with("count", proof::count(proof))
            .with("harmonic", &found.harmonic)
            .with_any("balance", rungs.map(|rungs| balance_columns().objects(balances(rungs))))
            .with("basin", Document::default().with("edge", found.border))
    };
    let csv = move || {
        if let Some(rungs) = rungs {
            return balance_columns().csv(balances(rungs));
        }
        let columns = Columns::default()
            .and(cycle_fields(|(cycle, _): &CycleRow| cycle.copied()))
            .part("certified", cycle_columns(), |(_, bounds)| Some(*bounds));
        let proved = |cycle| (Some(cycle), CycleBounds::Cycle(enclosure(proof, cycle)));
        let open = proof.open.iter().map(|open| (None, CycleBounds::Open(open)));
        columns.csv(found.cycles.iter().map(proved).chain(open))
    };
    let text = move || {
        let harmonic = |it: &Harmonic| {
            let [amplitude, mean] = [it.amplitude, it.mean].map(|value| significant(value, 6));
            format!("{} amplitude {amplitude}, mean {mean}", stability(it.stable))
        };
        let harmonic: Vec<String> = found.harmonic.iter().map(harmonic).collect();
        let harmonic = if harmonic.is_empty() { "none".to_owned() } else { harmonic.join("; ") };
        format!(
            "{}\n\n{}{}\nby one harmonic, for comparison: {harmonic}\n{}\n",
            about.heading(&[]),
            cycle_table(found, proof),
            proof::sentence(found.cycles.len(), proof),
            border(found.border)
        )
    };
    let balance = move || rungs.map(balance_table).unwrap_or_default();
    about.answer(found.cost, seconds, document, csv, text).below(balance)
}

/// The cycles as text, with the digits that are certain.
fn cycle_table(found: &Cycles, proof: &Proof) -> String {
    type CycleRow<'a> = (&'a Cycle, Option<Enclosure>);
    /// Digits shown; cycles are computed to rounding error.
    const DIGITS: usize = 12;
    if found.cycles.is_empty() {
        return String::new();
    }
    let kind = |(cycle, bounds): &CycleRow| {
        let not_proved = if bounds.is_some() { "" } else { ", not proved" };
        format!("{}{not_proved}", stability(cycle.stable))
    };
    let cell = |(cycle, bounds): &CycleRow, number: &CycleNumber| match (bounds, number.bounds) {
        (Some(bounds), Some(of)) => certain(of(bounds), DIGITS),
        _ => number.text(cycle, DIGITS - 2),
    };
    let rows = found.cycles.iter().map(|cycle| (cycle, enclosure(proof, cycle)));
    let table = number_columns(Columns::default().text("cycle", kind), cell).table(rows);
    let table = table.to_string();
    format!("{table}\n{}", proof::uncertain(&table))
}

/// Every cycle of a machine, and what borders the basin.
pub fn of_machine<'a>(about: &'a About, found: &'a Portrait, seconds: f64) -> Answer<'a> {
    let columns = || machine_cycles(|cycle: &Cycle| Some(*cycle));
    let document = move || {
        // The number of cycles is not proved; where the search did not settle is known.
        let count = Document::default().with("proved", false).with("open", &found.unresolved);
        Document::default()
            .with("cycles", columns().objects(found.cycles.clone()))
            .with("count", count)
            .with("neutral", found.neutral)
            .with("basin", Document::default().with("edge", found.border))
    };
    let csv = move || columns().csv(found.cycles.clone());
    about.answer(steps(found), seconds, document, csv, move || {
        let cycles = columns().table(found.cycles.clone());
        let cycles = if cycles.is_empty() { NO_CYCLE.to_owned() } else { cycles.aligned_left() };
        let known: String = known(found).into_iter().map(|line| line + "\n").collect();
        format!("{}\n\n{cycles}\n{known}", about.heading(&[]))
    })
}

/// What stands in place of an empty table of cycles.
pub(super) const NO_CYCLE: &str = "no cycle\n";

/// A line on the border of the basin of the sticking set of the oscillator of the paper.
pub(super) fn border(border: Border) -> String {
    let border = match border {
        Border::Cycle => "the smallest cycle",
        Border::Separatrix => "a separatrix",
        _ => "none",
    };
    format!("border of the basin of the sticking set: {border}")
}

/// The border of the basin of rest of a machine, and what is not known about its motions, a line each.
pub(super) fn known(portrait: &Portrait) -> Vec<String> {
    std::iter::once(machine_border(portrait).to_owned()).chain(gaps(portrait)).collect()
}

/// The border of the basin of rest of a machine, in a sentence.
pub(super) fn machine_border(portrait: &Portrait) -> &'static str {
    match portrait.border {
        Border::Unknown(_) => "every kick within the margin is survived; larger ones are not known",
        Border::None => "every kick is survived: whatever happens, the mass comes to rest",
        Border::NoBasin => "no kick is survived, however small: rest repels",
        Border::Separatrix => "beyond the margin motions grow without bound",
        Border::Cycle => "beyond the margin an unstable cycle is crossed",
        Border::Grazing | Border::Capture if portrait.neutral => {
            "within the margin every motion is periodic; beyond it the mass sticks to the belt"
        }
        Border::Grazing => "beyond the margin the mass comes to stick to the belt",
        Border::Capture => {
            "beyond the margin the guide catches the mass no more, and it is carried off"
        }
    }
}

/// What is not known about the motions of a machine, a line each.
pub(super) fn gaps(portrait: &Portrait) -> Vec<String> {
    let length = |x| with_unit(x, PLACES, "m");
    let limit = portrait.stop.map(|stop| {
        format!("motions that turn beyond x = {} are not known: {stop}", length(portrait.known))
    });
    let unresolved = portrait.unresolved.iter().map(|(from, to)| {
        let (from, to) = (length(*from), length(*to));
        format!("between x = {from} and {to} the search for cycles did not settle")
    });
    limit.into_iter().chain(unresolved).collect()
}

/// What a portrait of a machine cost.
pub(super) fn steps(portrait: &Portrait) -> Cost {
    Cost { steps: portrait.steps, ..Cost::default() }
}

/// The harmonic balance for one number of harmonics on the branch of one first-order answer. If the branch was lost
/// before, the row has no numbers and says why. A row without errors has no true cycle to be compared with.
type BalanceRow<'a> = (usize, &'a BalanceResult);

fn balance_columns<'a>() -> Columns<'a, BalanceRow<'a>> {
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
fn balances(rungs: &[HarmonicBalance]) -> Vec<BalanceRow<'_>> {
    let branches = rungs.first().map_or(0, |rung| rung.balanced.len());
    (0..branches)
        .flat_map(|branch| rungs.iter().map(move |rung| (rung, branch)))
        .filter_map(|(rung, branch)| Some((rung.harmonics, rung.balanced.get(branch)?)))
        .collect()
}

/// The harmonic balance as a table, with notes on its rows below it.
fn balance_table(rungs: &[HarmonicBalance]) -> String {
    let rows = balances(rungs);
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
    format!("\n{}{}", balance_columns().table(rows), notes.concat())
}

/// A note on a row, if it needs one.
fn note(row: &BalanceRow) -> Option<String> {
    let more = crossings(row).filter(|crossings| *crossings != 2).map(|crossings| {
        let harmonics = row.0;
        format!("{harmonics} harmonics have v = 0 at {crossings} instants of a turn, a cycle at 2")
    });
    lost(row).or(more)
}
