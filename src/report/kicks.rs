//! The answer about random kicks.

use super::columns::Columns;
use super::json::Document;
use super::table::{cost as told, parameters as named};
use crate::oscillator::Parameters;
use crate::study::kicks::RandomKick;
use crate::study::repeated::Repeated;
use crate::words::number::significant;

/// One document; `mean` is null if no kick is ever lost.
pub fn json(parameters: &Parameters, kicks: &RandomKick, found: &Repeated, seconds: f64) -> String {
    let repeated = Document::default()
        .with("lost", found.later)
        .with("mean", found.mean)
        .with("error", found.error)
        .with("density", &found.density);
    Document::default()
        .with("parameters", parameters)
        .with("kicks", kicks.to_string())
        .with("lost", found.first)
        .with("repeated", repeated)
        .cost(&found.cost, seconds)
        .text()
}

/// The density of the places of rest, one row for each cell of the sticking set.
pub fn csv(parameters: &Parameters, found: &Repeated) -> String {
    let columns = Columns::default()
        .file("q", |(q, _): &(f64, f64)| *q)
        .file("density", |(_, density)| *density);
    columns.csv(found.places(parameters.r))
}

pub fn table(
    parameters: &Parameters,
    kicks: &RandomKick,
    found: &Repeated,
    seconds: f64,
) -> String {
    let Repeated { first, later, mean, error, cost, .. } = found;
    let number = |value: f64| significant(value, 6);
    let mean = if mean.is_finite() { number(*mean) } else { "none is ever lost".to_owned() };
    format!(
        "{}; kicks {kicks}\n\n\
         lost, of kicks from the middle of the rest  {} +- {}\n\
         lost, of kicks after many                   {}\n\
         mean number until one is lost               {mean}\n\
         relative error of the last two              {}\n\n{}",
        named(parameters, None),
        number(first.part),
        significant(first.error, 2),
        number(*later),
        significant(*error, 2),
        told(*cost, seconds)
    )
}
