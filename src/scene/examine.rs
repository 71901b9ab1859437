//! Whether what a scene says beyond its syntax makes sense: numbers within their ranges, plots that can be drawn.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::plot_setup::{Axes, MOST_PLOTS, PlotSetup, Unit};
use super::scene::Scene;
use super::views::{Needs, View};
use crate::model::Knob;

/// The numbers of a motion, by the table in which they stand.
const NUMBERS: [(&str, &[Knob]); 3] = [
    ("problem.parameters", &Knob::PARAMETERS),
    ("problem.initial", &[Knob::Q0, Knob::V0]),
    ("problem", &[Knob::Until, Knob::Tolerance, Knob::Step, Knob::Epsilon]),
];

/// The place of what stands under names that points separate, as far as a table has them.
pub fn place(table: &DeTable, path: &str) -> Range<usize> {
    let mut at = 0..0;
    let mut names = path.split('.');
    let mut found = names.next().and_then(|name| table.get(name));
    while let Some(value) = found {
        at = value.span();
        found = names.next().and_then(|name| match value.get_ref() {
            DeValue::Table(table) => table.get(name),
            DeValue::Array(all) => all.get(name.parse::<usize>().ok()?),
            _ => None,
        });
    }
    at
}

/// Checks a scene. Fails with the path of the first value that is wrong, for [`place`], and what is allowed there.
pub fn examine(scene: &Scene) -> Result<(), (String, String)> {
    let number = |path: String, knob: Knob, value: f64| {
        knob.check(value).map(drop).map_err(|why| (path, why.to_string()))
    };
    for (table, knob) in
        NUMBERS.iter().flat_map(|(table, all)| all.iter().map(move |it| (table, *it)))
    {
        let name = knob.spec().name.trim_end_matches('0');
        number(format!("{table}.{name}"), knob, scene.problem.get(knob))?;
    }
    for (index, family) in scene.families.iter().enumerate() {
        for (variant, held) in family.iter().map(|variant| &variant.held).enumerate() {
            for (knob, value) in held {
                number(format!("families.{index}.{variant}.held.{knob}"), *knob, *value)?;
            }
        }
    }
    if let Some((knob, _)) = scene.steps.iter().find(|(_, step)| step.is_nan() || **step <= 0.0) {
        return Err((format!("steps.{knob}"), "a step is a number above 0".to_owned()));
    }
    let count = scene.plots.len();
    if !(1..=MOST_PLOTS).contains(&count) {
        return Err(("plots".into(), format!("{count} plots; there can be 1 to {MOST_PLOTS}")));
    }
    for (index, plot) in scene.plots.iter().enumerate() {
        if let Some((part, why)) = wrong(scene, plot) {
            return Err((format!("plots.{index}.{part}"), why.to_owned()));
        }
    }
    scene.sheet.plots(count, 0..count).map(drop).map_err(|why| ("sheet.panels".into(), why))
}

/// What is wrong with a plot, and where.
fn wrong(scene: &Scene, plot: &PlotSetup) -> Option<(&'static str, &'static str)> {
    const AXIS: &str = "an axis is D, D2, D3 or r";
    let Axes { abscissa, against, ordinate, unit, .. } = plot.axes;
    let is_there = match plot.view.spec().needs {
        Needs::Oscillator => true,
        Needs::Machine => scene.machine.is_some(),
        Needs::Record => scene.recording.is_some(),
        Needs::Scan => false,
    };
    let is_known = plot.family.is_none_or(|family| family < scene.families.len());
    let is_twice = plot.view == View::Regimes && abscissa == against;
    let is_length = unit == Unit::One || ordinate.spec().ratio.is_some();
    let rules = [
        (is_there, "view", "this view needs a machine or a record; scans are not drawn of a file"),
        (is_known, "family", "there is no such family; the first is 0"),
        (abscissa.is_parameter(), "axes.abscissa", AXIS),
        (against.is_parameter(), "axes.against", AXIS),
        (!is_twice, "axes.against", "both axes are the same"),
        (is_length, "axes.unit", "only lengths are measured in r"),
    ];
    rules.into_iter().find(|(holds, ..)| !holds).map(|(_, part, why)| (part, why))
}
