//! A machine at a series of values of one of its quantities.

use serde::Serialize;

use super::document::{DesignDocument, MachineCost, PortraitDocument};
use super::{DesignAnswer, Head, PLACES, RestShare};
use crate::machine::Portrait;
use crate::oscillator::Knob;
use crate::portrait::{Border, Cycle, Margin, RestMargin};
use crate::report::csv::CsvSheet;
use crate::report::json::text;
use crate::report::table::Table;
use crate::words::number::duration;
use crate::words::quantity::with_unit;

pub struct SweepPoint {
    /// Value of the quantity, in SI units.
    pub value: f64,
    /// What the machine does there, or why it does not exist.
    pub found: Result<Portrait, String>,
    pub rest_share: RestShare,
    /// The friction needed for a margin, if asked for.
    pub design: Option<DesignAnswer>,
}

/// A sweep over one number of a machine.
pub struct MachineSweep<'a> {
    /// The machine.
    pub head: &'a Head<'a>,
    /// The number that varies.
    pub varied: Knob,
    pub points: Vec<SweepPoint>,
    pub seconds: f64,
}

#[derive(Serialize)]
struct BeltSweepDocument<'a> {
    machine: &'a str,
    model: &'static str,
    quantity: &'static str,
    unit: &'static str,
    points: Vec<SweptPoint<'a>>,
    cost: MachineCost,
}

#[derive(Serialize)]
struct SweptPoint<'a> {
    value: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a String>,
    #[serde(flatten)]
    whole: Option<PortraitDocument>,
    #[serde(skip_serializing_if = "RestShare::is_not_asked")]
    rest_share: RestShare,
    #[serde(skip_serializing_if = "Option::is_none")]
    design: Option<DesignDocument>,
}

fn steps(sweep: &MachineSweep) -> u64 {
    sweep.points.iter().filter_map(|point| point.found.as_ref().ok()).map(|found| found.steps).sum()
}

/// The sweep as a document.
pub fn json(sweep: &MachineSweep) -> String {
    let points = sweep.points.iter().map(|point| SweptPoint {
        value: point.value,
        reason: point.found.as_ref().err(),
        whole: point.found.as_ref().ok().map(PortraitDocument::new),
        rest_share: point.rest_share,
        design: point.design.as_ref().map(DesignDocument::new),
    });
    text(&BeltSweepDocument {
        machine: sweep.head.name,
        model: "whole",
        quantity: sweep.varied.spec().name,
        unit: sweep.varied.spec().unit,
        points: points.collect(),
        cost: MachineCost { steps: steps(sweep), seconds: sweep.seconds },
    })
}

/// Where motions end, in a few words.
fn regime(found: &Portrait) -> String {
    let rest = match found.border {
        Border::NoBasin => "no basin",
        _ if found.neutral => "periodic",
        Border::Unknown(_) => "all that are known come to rest",
        Border::None => "all come to rest",
        Border::Separatrix => "basin up to escape",
        Border::Cycle => "basin within a cycle",
        Border::Grazing => "basin up to the belt",
        Border::Capture => "basin up to what the guide holds",
    };
    let stable = found.cycles.iter().filter(|cycle| cycle.stable);
    let kinds = stable.map(|cycle| match (cycle.sticks(), cycle.overtakes) {
        (false, false) => "slip",
        (true, false) => "stick-slip",
        (false, true) => "overtaking slip",
        (true, true) => "overtaking stick-slip",
    });
    let kinds: Vec<&str> = kinds.collect();
    if kinds.is_empty() { rest.to_owned() } else { format!("{rest}, {}", kinds.join(", ")) }
}

/// The sweep as a table.
pub fn table(sweep: &MachineSweep) -> String {
    let (name, unit) = (sweep.varied.spec().name, sweep.varied.spec().unit);
    let designs = sweep.points.iter().any(|point| point.design.is_some());
    let mut titles =
        vec![name, "shift from rest", "impulse from rest", "cycles up to", "on the belt", "regime"];
    let shares = sweep.points.iter().any(|point| !point.rest_share.is_not_asked());
    if shares {
        titles.push("rest share");
    }
    if designs {
        titles.push("R needed");
    }
    let mut table = Table::new(&titles);
    let or_all = |value: Option<f64>, unit| {
        value.map_or_else(|| "all".to_owned(), |value| with_unit(value, PLACES, unit))
    };
    for point in &sweep.points {
        let mut cells = vec![with_unit(point.value, PLACES, unit)];
        match &point.found {
            Ok(found) => {
                let RestMargin { displacement, impulse } = found.margin.from_rest;
                let sizes = found.cycles.iter().map(|cycle| with_unit(cycle.q_max, PLACES, "m"));
                let rides = found.cycles.iter().find(|cycle| cycle.sticks());
                let ride = rides.map(|cycle| with_unit(cycle.stick_duration(), PLACES, "s"));
                cells.extend([or_all(displacement, "m"), or_all(impulse, "N s")]);
                cells.push(sizes.collect::<Vec<_>>().join(", "));
                cells.push(ride.unwrap_or_default());
                cells.push(regime(found));
                cells.extend(point.rest_share.cell());
                if let Some(designed) = &point.design {
                    let force = designed.force().map(|force| with_unit(force, PLACES, "N"));
                    cells.push(force.unwrap_or_else(|| "any".to_owned()));
                }
            }
            Err(reason) => {
                cells.extend(std::iter::repeat_n("-".to_owned(), 4));
                cells.push(reason.clone());
            }
        }
        table.row(cells);
    }
    let head = sweep.head;
    format!(
        "{}: {}\n{}\n\n{}\n{} steps, {}\n",
        head.name,
        head.title,
        head.numbers_without(name),
        table.aligned_left(),
        steps(sweep),
        duration(sweep.seconds)
    )
}

/// The machine at one value.
#[derive(Default, Serialize)]
struct BeltSweepRow {
    value: f64,
    cycles: Option<usize>,
    x_max_inner: Option<f64>,
    x_max_outer: Option<f64>,
    stick_duration: Option<f64>,
    border: Option<Border>,
    neutral: Option<bool>,
    x_margin: Option<f64>,
    impulse_margin: Option<f64>,
    from_rest: RestMargin,
    rest_share: Option<f64>,
    #[serde(rename = "R_needed")]
    needed: Option<f64>,
}

/// One row for each point, in SI units.
pub fn csv(sweep: &MachineSweep) -> String {
    let mut sheet =
        CsvSheet::like(&BeltSweepRow::default(), &[("value", sweep.varied.spec().name)]);
    for point in &sweep.points {
        let value = point.value;
        let Ok(found) = &point.found else {
            sheet.row(&BeltSweepRow { value, ..BeltSweepRow::default() });
            continue;
        };
        let all = &found.cycles;
        let Margin { displacement: x_margin, impulse: impulse_margin, from_rest } = found.margin;
        sheet.row(&BeltSweepRow {
            value,
            cycles: Some(all.len()),
            x_max_inner: all.first().map(|cycle| cycle.q_max),
            x_max_outer: all.last().map(|cycle| cycle.q_max),
            stick_duration: all.iter().find(|it| it.sticks()).map(Cycle::stick_duration),
            border: Some(found.border),
            neutral: Some(found.neutral),
            x_margin,
            impulse_margin,
            from_rest,
            rest_share: point.rest_share.known(),
            needed: point.design.as_ref().and_then(DesignAnswer::force),
        });
    }
    sheet.into_text()
}
