//! The answer about random kicks.

use serde::Serialize;

use super::csv;
use super::json::{CountedCost, text};
use super::table::parameters as named;
use crate::oscillator::Parameters;
use crate::study::kicks::RandomKick;
use crate::study::repeated::Repeated;
use crate::study::stability::Share;
use crate::words::number::{duration, significant};

#[derive(Serialize)]
struct KicksDocument<'a> {
    parameters: &'a Parameters,
    kicks: String,
    lost: Share,
    repeated: Again<'a>,
    cost: CountedCost,
}

#[derive(Serialize)]
struct Again<'a> {
    lost: f64,
    mean: Option<f64>,
    error: f64,
    density: &'a [f64],
}

/// The density of the places of rest at `q`.
#[derive(Default, Serialize)]
struct KicksRow {
    q: f64,
    density: f64,
}

/// One document; `mean` is null if no kick is ever lost.
pub fn json(parameters: &Parameters, kicks: &RandomKick, found: &Repeated, seconds: f64) -> String {
    text(&KicksDocument {
        parameters,
        kicks: kicks.to_string(),
        lost: found.first,
        repeated: Again {
            lost: found.later,
            mean: found.mean.is_finite().then_some(found.mean),
            error: found.error,
            density: &found.density,
        },
        cost: CountedCost { counted: found.cost, seconds },
    })
}

/// The density of the places of rest, one row for each cell of the sticking set.
pub fn csv(parameters: &Parameters, found: &Repeated) -> String {
    let row = |(q, density)| KicksRow { q, density };
    csv::sheet(&KicksRow::default(), found.places(parameters.r).map(row))
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
         relative error of the last two              {}\n\n{} evaluations, {}\n",
        named(parameters, None),
        number(first.part),
        significant(first.error, 2),
        number(*later),
        significant(*error, 2),
        cost.evaluations,
        duration(seconds)
    )
}
