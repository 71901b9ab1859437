//! Whether what a scene says beyond its syntax makes sense: numbers within their ranges, axes, families, scans, files.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Component, Path};

use toml::de::{DeTable, DeValue};

use super::plot_setup::{Axes, MOST_PLOTS, PlotSetup, Unit};
use super::scene::{Scene, SceneScan};
use super::views::{Needs, View};
use crate::flow::Subject;
use crate::model::{Group, Knob};
use crate::scan::{Measure, Sweep};

/// The numbers of a motion, by where they stand in its table.
const NUMBERS: [(&str, Knob); 10] = [
    ("parameters.D", Knob::D),
    ("parameters.D2", Knob::D2),
    ("parameters.D3", Knob::D3),
    ("parameters.r", Knob::R),
    ("initial.q", Knob::Q0),
    ("initial.v", Knob::V0),
    ("until", Knob::Until),
    ("tolerance", Knob::Tolerance),
    ("step", Knob::Step),
    ("epsilon", Knob::Epsilon),
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

/// Where a complaint belongs, and what it says.
type Placeless = (String, String);

fn at<T>(path: impl Into<String>, checked: Result<T, impl ToString>) -> Result<(), Placeless> {
    checked.map(drop).map_err(|why| (path.into(), why.to_string()))
}

fn unless(wrong: bool, path: impl Into<String>, why: &str) -> Result<(), Placeless> {
    at(path, if wrong { Err(why) } else { Ok(()) })
}

/// Checks a scene. Fails with the path of the first value that is wrong, for [`place`], and what is allowed there.
pub fn examine(scene: &Scene) -> Result<(), Placeless> {
    for (path, knob) in NUMBERS {
        at(format!("problem.{path}"), knob.check(scene.problem.get(knob)))?;
    }
    for (knob, step) in &scene.steps {
        let wrong = !(*step > 0.0 && step.is_finite());
        unless(wrong, format!("steps.{knob}"), "a step is a number above 0")?;
    }
    for (index, start) in scene.beside.iter().enumerate() {
        at(format!("beside.{index}.q"), Knob::Q0.check(start.q))?;
        at(format!("beside.{index}.v"), Knob::V0.check(start.v))?;
    }
    for (index, family) in scene.families.iter().enumerate() {
        unless(family.is_empty(), format!("families.{index}"), "a family without a variant")?;
        for (variant, held) in family.iter().map(|variant| &variant.held).enumerate() {
            for (knob, value) in held {
                let path = format!("families.{index}.{variant}.held.{knob}");
                at(path, knob.check(*value))?;
            }
        }
    }
    let count = scene.plots.len();
    let wrong = !(1..=MOST_PLOTS).contains(&count);
    unless(wrong, "plots", &format!("{count} plots; there can be 1 to {MOST_PLOTS}"))?;
    for (index, plot) in scene.plots.iter().enumerate() {
        let placed = |(path, why)| (format!("plots.{index}.{path}"), why);
        plot_of(scene, plot).map_err(placed)?;
    }
    for (index, scan) in scene.scans.iter().enumerate() {
        let placed = |(path, why)| (format!("scans.{index}.{path}"), why);
        scan_of(scene, scan).map_err(placed)?;
    }
    files(scene)
}

fn plot_of(scene: &Scene, plot: &PlotSetup) -> Result<(), Placeless> {
    let needs = plot.view.spec().needs;
    let lacks = match needs {
        Needs::Oscillator => None,
        Needs::Machine => scene.machine.is_none().then_some("machine = \"clutch\" or a file"),
        Needs::Record => scene.recording.is_none().then_some("record = \"run.csv\""),
        Needs::Scan => scene.scans.is_empty().then_some("[[scans]]"),
    };
    if let Some(lacks) = lacks {
        return Err(("view".to_owned(), format!("this view needs {lacks}")));
    }
    let families = scene.families.len();
    let wrong = plot.family.is_some_and(|family| family >= families);
    unless(wrong, "family", &format!("there are {families} families, counted from 0"))?;
    let Axes { abscissa, against, ordinate, unit, .. } = plot.axes;
    let parameter = "an axis is D, D2, D3 or r";
    unless(!abscissa.is_parameter(), "axes.abscissa", parameter)?;
    unless(!against.is_parameter(), "axes.against", parameter)?;
    let twice = plot.view == View::Regimes && abscissa == against;
    unless(twice, "axes.against", "both axes are the same number")?;
    let wrong = unit == Unit::Friction && ordinate.spec().ratio.is_none();
    unless(wrong, "axes.unit", "only lengths are measured in r")
}

fn scan_of(scene: &Scene, scan: &SceneScan) -> Result<(), Placeless> {
    let groups: &[Group] = match scene.machine {
        Some(_) => Subject::GROUPS,
        None => &[Group::Motion],
    };
    unless(scan.over.is_empty(), "over", "a scan goes over one number or more")?;
    unless(scan.measure.is_empty(), "measure", "a scan measures something")?;
    for (index, text) in scan.over.iter().enumerate() {
        at(format!("over.{index}"), Sweep::read(text, groups))?;
    }
    for (index, name) in scan.measure.iter().enumerate() {
        at(format!("measure.{index}"), Measure::named(name))?;
    }
    Ok(())
}

/// The files that are made of a scene: each once, and within its folder.
fn files(scene: &Scene) -> Result<(), Placeless> {
    let own = (0..).zip(&scene.outputs).map(|(index, name)| (format!("outputs.{index}"), name));
    let scans = (0..).zip(&scene.scans);
    let scans =
        scans.filter_map(|(i, it)| Some((format!("scans.{i}.output"), it.output.as_ref()?)));
    let mut known = BTreeSet::new();
    for (path, name) in own.chain(scans) {
        let outside = !Path::new(name).components().all(|it| matches!(it, Component::Normal(_)));
        unless(
            outside || name.is_empty(),
            path.clone(),
            "a file is named from this folder, without ..",
        )?;
        unless(!known.insert(name), path, "this file is named twice")?;
    }
    Ok(())
}
