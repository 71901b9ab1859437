//! A sweep of a machine's quantity: a path through the dimensionless parameters, point by point.

use serde::Serialize;

use super::document::DesignOf;
use super::{Designed, PLACES, quantities};
use crate::export::csv::{exact_or_empty, line};
use crate::export::json::{Price, text};
use crate::export::table::Table;
use crate::flow::Cost;
use crate::oscillator::belt::Quantity;
use crate::oscillator::{Belt, Parameters};
use crate::scene::Machine;
use crate::study::belt::{PhysicalMargin, SweepFound, SweepPoint};
use crate::study::{Cycle, Edge, Margin};
use crate::view::number::{duration, significant};
use crate::view::quantity::with_unit;

/// A sweep with what is asked about it.
pub struct Sweep<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// The quantity that varies.
    pub quantity: Quantity,
    /// The points, and the friction for a margin at each if asked for.
    pub points: Vec<(SweepPoint, Option<Designed>)>,
    /// What it cost.
    pub cost: Cost,
    /// What it took.
    pub seconds: f64,
}

#[derive(Serialize)]
struct Document<'a> {
    machine: &'a str,
    quantity: Quantity,
    unit: &'static str,
    points: Vec<Point<'a>>,
    cost: Price,
}

#[derive(Serialize)]
struct Point<'a> {
    value: f64,
    parameters: Option<&'a Parameters>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    cycles: &'a [Cycle],
    edge: Option<Edge>,
    #[serde(rename = "D_F")]
    fold: Option<f64>,
    #[serde(rename = "D_c")]
    escape: Option<f64>,
    margin: Option<Margins>,
    sticking_velocity: Option<f64>,
    reaches_belt: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    design: Option<DesignOf>,
}

#[derive(Serialize)]
struct Margins {
    #[serde(flatten)]
    physical: PhysicalMargin,
    dimensionless: Margin,
}

fn margin(found: &SweepFound) -> Margin {
    let none = Margin { displacement: None, impulse: None };
    found.cycles.picture.as_ref().map_or(none, |picture| picture.margin)
}

/// The belt at a point of the sweep.
fn belt_at(sweep: &Sweep, value: f64) -> Belt {
    let mut belt = sweep.machine.belt.clone();
    belt.set(sweep.quantity, value);
    belt
}

/// A point of the sweep as a document.
fn document_of<'a>(
    (point, designed): &'a (SweepPoint, Option<Designed>),
    sweep: &Sweep,
) -> Point<'a> {
    let found = point.found.as_ref().ok();
    let design = designed.as_ref().zip(found).map(|(designed, found)| {
        DesignOf::new(designed, &belt_at(sweep, point.value), &found.reduced.units)
    });
    Point {
        value: point.value,
        parameters: found.map(|found| &found.reduced.parameters),
        reason: point.found.as_ref().err().map(ToString::to_string),
        cycles: found.map_or(&[], |found| &found.cycles.cycles),
        edge: found.map(|found| found.cycles.edge),
        fold: found.and_then(|found| found.fold).map(|fold| fold.d),
        escape: found.and_then(|found| found.escape),
        margin: found.map(|found| Margins {
            physical: PhysicalMargin::new(&margin(found), &found.reduced.units),
            dimensionless: margin(found),
        }),
        sticking_velocity: found.map(|found| found.reduced.sticking_velocity),
        reaches_belt: found.map(|found| found.sticks),
        design,
    }
}

/// The sweep as a document.
#[must_use]
pub fn json(sweep: &Sweep) -> String {
    text(&Document {
        machine: &sweep.machine.name,
        quantity: sweep.quantity,
        unit: sweep.quantity.spec().unit,
        points: sweep.points.iter().map(|point| document_of(point, sweep)).collect(),
        cost: Price { counted: sweep.cost, seconds: sweep.seconds },
    })
}

/// What becomes of motions, in a few words.
fn regime(found: &SweepFound) -> &'static str {
    let outside = found.cycles.cycles.last().is_some_and(|cycle| cycle.stable);
    match (found.cycles.edge, outside) {
        (Edge::None, false) => "all come to rest",
        (Edge::None, true) => "all end on a cycle",
        (Edge::Cycle | Edge::Separatrix, true) => "basin, cycle outside",
        (Edge::Cycle | Edge::Separatrix, false) => "basin, escape outside",
    }
}

/// The sweep, to read.
#[must_use]
pub fn table(sweep: &Sweep) -> String {
    let row = sweep.quantity.spec();
    let designs = sweep.points.iter().any(|(_, designed)| designed.is_some());
    let mut titles =
        vec![row.name, "D", "D2", "D3", "r", "D_F", "margin", "impulse", "regime", "belt"];
    if designs {
        titles.push("R needed");
    }
    let mut table = Table::new(&titles);
    let number = |value| significant(value, PLACES);
    let or_none = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), number);
    let unit = |value: Option<f64>, unit| {
        value.map_or_else(|| "all".to_owned(), |value| with_unit(value, PLACES, unit))
    };
    for (point, designed) in &sweep.points {
        let mut cells = vec![with_unit(point.value, PLACES, row.unit)];
        match &point.found {
            Ok(found) => {
                let Parameters { d, d2, d3, r } = found.reduced.parameters;
                let physical = PhysicalMargin::new(&margin(found), &found.reduced.units);
                cells.extend([d, d2, d3, r].map(number));
                cells.push(or_none(found.fold.map(|fold| fold.d)));
                cells.push(unit(physical.displacement, "m"));
                cells.push(unit(physical.impulse, "N s"));
                cells.push(regime(found).to_owned());
                cells.push(if found.sticks { "reached" } else { "" }.to_owned());
                if let Some(designed) = designed {
                    let force = designed.force(&found.reduced.units);
                    let force = force.map(|force| with_unit(force, PLACES, "N"));
                    cells.push(force.unwrap_or_else(|| "any".to_owned()));
                }
            }
            Err(error) => {
                cells.extend(std::iter::repeat_n("-".to_owned(), 7));
                cells.push(error.to_string());
            }
        }
        table.row(cells);
    }
    let machine = sweep.machine;
    format!(
        "{}: {}\n{}\n\n{table}\n{} evaluations, {}\n",
        machine.name,
        machine.title,
        quantities(&machine.belt, Some(row.name)),
        sweep.cost.evaluations,
        duration(sweep.seconds)
    )
}

/// One row for each point, in SI units.
#[must_use]
pub fn csv(sweep: &Sweep) -> String {
    let mut out = format!(
        "{},D,D2,D3,r,D_F,D_c,cycles,q_max_inner,q_max_outer,margin_displacement,margin_impulse,\
         x_margin,impulse_margin,sticking_velocity,reaches_belt,R_needed\n",
        sweep.quantity.spec().name
    );
    for (point, designed) in &sweep.points {
        let mut cells = vec![exact_or_empty(Some(point.value))];
        if let Ok(found) = &point.found {
            let Parameters { d, d2, d3, r } = found.reduced.parameters;
            let margin = margin(found);
            let physical = PhysicalMargin::new(&margin, &found.reduced.units);
            let all = &found.cycles.cycles;
            cells.extend([d, d2, d3, r].map(|value| exact_or_empty(Some(value))));
            cells.push(exact_or_empty(found.fold.map(|fold| fold.d)));
            cells.push(exact_or_empty(found.escape));
            cells.push(all.len().to_string());
            cells.push(exact_or_empty(all.first().map(|cycle| cycle.q_max)));
            cells.push(exact_or_empty(all.last().map(|cycle| cycle.q_max)));
            let margins =
                [margin.displacement, margin.impulse, physical.displacement, physical.impulse];
            cells.extend(margins.map(exact_or_empty));
            cells.push(exact_or_empty(Some(found.reduced.sticking_velocity)));
            cells.push(found.sticks.to_string());
            let force = designed.as_ref().and_then(|one| one.force(&found.reduced.units));
            cells.push(exact_or_empty(force));
        } else {
            cells.extend(std::iter::repeat_n(String::new(), 16));
        }
        out += &line(&cells);
    }
    out
}
