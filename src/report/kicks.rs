//! The answer about random kicks.

use super::belt::Head;
use super::columns::Columns;
use super::json::Document;
use super::machine::MachineReport;
use super::table::{cost as told, parameters as named};
use crate::model::{Parameters, Subject};
use crate::portrait::kicks::RandomKick;
use crate::portrait::kicks::repeated::Repeated;
use crate::words::number::significant;

/// What becomes of the kicks; `mean` is null if no kick is ever lost.
fn answer(kicks: &RandomKick, found: &Repeated) -> Document {
    let repeated = Document::default()
        .with("lost", found.later)
        .with("mean", found.mean)
        .with("error", found.error)
        .with("density", &found.density);
    Document::default()
        .with("kicks", kicks.to_string())
        .with("lost", found.first)
        .with("repeated", repeated)
}

/// One document.
pub fn json(parameters: &Parameters, kicks: &RandomKick, found: &Repeated, seconds: f64) -> String {
    Document::default()
        .with("parameters", parameters)
        .and(&answer(kicks, found))
        .cost(&found.cost, seconds)
        .text()
}

/// The same about a machine, `held` being the farthest place of rest on either side.
pub fn of_machine<'a>(
    head: &'a Head,
    subject: &'a Subject,
    (kicks, found, held): (&RandomKick, &Repeated, f64),
    seconds: f64,
) -> MachineReport<'a, (f64, f64)> {
    MachineReport {
        head,
        subject,
        document: answer(kicks, found),
        columns: density(),
        rows: found.places(held).collect(),
        varied: Vec::new(),
        notes: vec![format!("kicks {kicks}"), lines(found)],
        steps: found.cost.steps,
        seconds,
    }
}

/// The density of the places of rest, one row for each cell of the sticking set.
pub fn csv(parameters: &Parameters, found: &Repeated) -> String {
    density().csv(found.places(parameters.r))
}

/// A place of rest, and the density there.
fn density<'a>() -> Columns<'a, (f64, f64)> {
    Columns::default().file("q", |(q, _): &(f64, f64)| *q).file("density", |(_, density)| *density)
}

pub fn table(
    parameters: &Parameters,
    kicks: &RandomKick,
    found: &Repeated,
    seconds: f64,
) -> String {
    format!(
        "{}; kicks {kicks}\n\n{}\n\n{}",
        named(parameters, None),
        lines(found),
        told(found.cost, seconds)
    )
}

/// What is lost, and the mean number of kicks until one is.
fn lines(Repeated { first, later, mean, error, .. }: &Repeated) -> String {
    let number = |value: f64| significant(value, 6);
    let mean = if mean.is_finite() { number(*mean) } else { "none is ever lost".to_owned() };
    format!(
        "lost, of kicks from the middle of the rest  {} +- {}\n\
         lost, of kicks after many                   {}\n\
         mean number until one is lost               {mean}\n\
         relative error of the last two              {}",
        number(first.part),
        significant(first.error, 2),
        number(*later),
        significant(*error, 2),
    )
}
