//! Scene files: reads TOML into a [`Scene`].
//!
//! Only the program itself has such files, so that what they say beyond their syntax is examined by tests.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;

use super::machine::{self, ScaledMachine};
use super::misread::{self, Complaint, Misread};
use super::ordinate::{Ordinate, Unit};
use super::plot_setup::{Arrangement, Axes, PlotSetup};
use super::scene::{Scene, Variant};
use super::views::{Layer, View};
use super::window::{Span, Window};
use crate::flow::Problem;
use crate::model::Knob;

/// The file as it is written: a scene has either terms or a machine.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    title: String,
    also: Option<String>,
    look: String,
    press: String,
    #[serde(default)]
    terms: BTreeSet<Knob>,
    machine: Option<String>,
    /// Speed of the machine's belt in m/s, where it differs from the machine's own.
    belt: Option<f64>,
    #[serde(default)]
    values: BTreeMap<Knob, f64>,
    #[serde(default)]
    steps: BTreeMap<Knob, f64>,
    until: Option<f64>,
    layers: BTreeSet<Layer>,
    #[serde(default)]
    arrange: Arrangement,
    plot: Vec<PlotTable>,
}

/// A plot: its view, its axes, and the part to show.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlotTable {
    view: View,
    over: Option<Knob>,
    ordinate: Option<Ordinate>,
    #[serde(default)]
    unit: Unit,
    against: Option<Knob>,
    #[serde(default)]
    with: Vec<BTreeMap<Knob, f64>>,
    x: Option<Span>,
    y: Option<Span>,
}

/// Reads a scene; `name` is the name by which it is opened, `file` the one in error messages. Fails with
/// [`Misread`], which names the place and what is allowed there.
pub fn parse(name: &str, file: &str, text: &str) -> Result<Scene, Misread> {
    let read: SceneFile = misread::toml(file, text)?;
    let whole_file = |message| Complaint { at: 0..0, message }.in_file(file, text);
    scene(name, read).map_err(whole_file)
}

/// The scene of a file. Fails with one line if the machine that it names is none.
fn scene(name: &str, read: SceneFile) -> Result<Scene, String> {
    let machine = read.machine.map(|name| scaled(&name, read.belt)).transpose()?;
    let own = match &machine {
        Some(scaled) => scaled.problem(),
        None => motion(&read.values, &read.terms),
    };
    let mut families = Vec::new();
    let plots = read.plot.into_iter().map(|plot| plot_setup(plot, &mut families)).collect();
    Ok(Scene {
        name: name.to_owned(),
        also: read.also,
        title: read.title,
        watch: read.look,
        press: read.press,
        problem: Problem { until: read.until.unwrap_or(own.until), ..own },
        steps: read.steps,
        terms: machine.as_ref().map_or(read.terms, ScaledMachine::terms),
        layers: read.layers,
        plots,
        families,
        arrangement: read.arrange,
        machine: machine.map(Box::new),
        recording: None,
    })
}

/// The built-in machine with this name, with its belt at this speed.
fn scaled(name: &str, speed: Option<f64>) -> Result<ScaledMachine, String> {
    let machine = machine::library::find(name)?;
    ScaledMachine::at(machine, speed.unwrap_or(machine.belt.belt_speed))
}

/// The motion with these values: a declared term without one has its default, all others are zero.
fn motion(values: &BTreeMap<Knob, f64>, terms: &BTreeSet<Knob>) -> Problem {
    let mut problem = Problem::default();
    for knob in Knob::MOTION {
        let declared = !knob.is_parameter() || terms.contains(&knob);
        let usual = if declared { knob.usual() } else { 0.0 };
        problem.set(knob, values.get(&knob).copied().unwrap_or(usual));
    }
    problem
}

/// A plot of a scene, whose variants are added to the families.
fn plot_setup(read: PlotTable, families: &mut Vec<Vec<Variant>>) -> PlotSetup {
    let usual = Axes::default();
    let axes = Axes {
        abscissa: read.over.unwrap_or(usual.abscissa),
        ordinate: read.ordinate.unwrap_or(usual.ordinate),
        unit: read.unit,
        against: read.against.unwrap_or(usual.against),
    };
    let window = read.x.zip(read.y).map(|(x, y)| Window { x, y });
    let family = (!read.with.is_empty()).then_some(families.len());
    let variants = read.with.into_iter().map(|held| Variant { held });
    families.extend(family.map(|_| variants.collect()));
    PlotSetup { view: read.view, axes, window, family }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, State};
    use crate::scene::{MOST_PLOTS, library};

    const GOOD: &str = r#"title = "A test"
look = "At this."
press = "That."
terms = ["D", "r"]
values = { D = -0.4, q0 = 2 }
layers = ["trajectory"]
plot = [
  { view = "phase", x = [-3, 3], y = [-2.5, 2.5] },
  { view = "diagram", over = "D", x = [-1, 0.1], y = [0, 2] },
]
"#;

    #[test]
    fn declared_terms_have_values_and_all_others_are_zero() {
        let scene = parse("test", "test.toml", GOOD).unwrap();
        let Problem { parameters, initial, .. } = scene.problem;
        assert_eq!(parameters, Parameters { d: -0.4, d2: 0.0, d3: 0.0, r: Knob::R.usual() });
        assert_eq!(initial, State { q: 2.0, v: 0.0 });
        assert!(scene.declares(Knob::R) && scene.declares(Knob::V0));
        assert!(!scene.declares(Knob::D3));
    }

    #[test]
    fn a_diagram_shows_q_max_over_d_unless_it_says_otherwise() {
        let scene = parse("test", "test.toml", GOOD).unwrap();
        assert_eq!(scene.plots[1].axes, Axes::default());
        let period = GOOD.replace("over = \"D\"", "over = \"r\", ordinate = \"period\"");
        let scene = parse("test", "test.toml", &period).unwrap();
        assert_eq!(
            scene.plots[1].axes,
            Axes { abscissa: Knob::R, ordinate: Ordinate::Period, ..Axes::default() }
        );
    }

    #[test]
    fn a_plot_without_a_window_is_fitted() {
        let fitted = GOOD.replace(", x = [-1, 0.1], y = [0, 2]", "");
        let scene = parse("test", "test.toml", &fitted).unwrap();
        assert!(scene.plots[0].window.is_some());
        assert_eq!(scene.plots[1].window, None);
        assert!(scene.plots[1].opening().x.contains(-0.4));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place_and_what_is_allowed() {
        for (from, to, place, words) in [
            ("title", "titel", "1:1", "expected one of `title`"),
            ("A test\"", "A test", "1:", ""),
            ("D = -0.4", "D4 = 1", "5:12", "no number \"D4\"; did you mean D"),
            ("D = -0.4", "D = \"a\"", "5:16", "expected f64"),
            ("[-3, 3]", "[3, -3]", "8:25", "the second larger"),
            ("over", "ordinate = \"size\", over", "9:34", "expected one of `q_max`, `q_min`"),
            ("over", "unit = \"m\", over", "9:30", "expected `1` or `r`"),
            ("\"phase\"", "\"plane\"", "8:12", "unknown variant `plane`"),
            ("\"trajectory\"", "\"tail\"", "6:11", "expected one of `trajectory`"),
            (
                "title",
                "machine = \"none\"\ntitle",
                "1:1",
                "no machine \"none\"; there are textbook",
            ),
        ] {
            let error = parse("test", "test.toml", &GOOD.replacen(from, to, 1)).unwrap_err();
            let line = error.to_string();
            assert!(line.starts_with(&format!("test.toml:{place}")), "{to}: {line}");
            assert!(line.contains(words) && !line.contains('\n'), "{to}: {line}");
        }
    }

    #[test]
    fn every_scene_of_the_program_says_only_what_has_a_meaning() {
        for scene in library() {
            let name = &scene.name;
            assert!(scene.machine.is_some() || !scene.terms.is_empty(), "{name}");
            for knob in Knob::MOTION {
                let value = scene.problem.get(knob);
                assert_eq!(knob.check(value), Ok(value), "{name}");
                assert!(value == 0.0 || scene.declares(knob), "{name}: {knob}");
            }
            assert!(Knob::Until.check(scene.problem.until).is_ok(), "{name}");
            assert!(scene.steps.values().all(|step| *step > 0.0 && step.is_finite()), "{name}");
            let held = scene.families.iter().flatten().flat_map(|variant| &variant.held);
            assert!(held.into_iter().all(|(knob, value)| knob.check(*value).is_ok()), "{name}");
            assert!((1..=MOST_PLOTS).contains(&scene.plots.len()), "{name}");
            for PlotSetup { view, axes, .. } in &scene.plots {
                let Axes { abscissa, against, ordinate, unit } = *axes;
                let usual = Axes::default();
                assert!(abscissa.is_parameter() && against.is_parameter(), "{name}");
                let chart = *view == View::Regimes;
                assert!(chart || against == usual.against, "{name}: upwards only in a chart");
                assert!(!chart || abscissa != against, "{name}: one axis twice");
                let diagram = *view == View::Diagram;
                assert!(chart || diagram || abscissa == usual.abscissa, "{name}");
                assert!(diagram || (ordinate, unit) == (usual.ordinate, usual.unit), "{name}");
                assert!(unit == Unit::One || ordinate.spec().ratio.is_some(), "{name}");
            }
        }
        // Both ends of a window or none: a file that has one alone would lose it.
        for text in ["", ", y = [0, 2]"] {
            let scene = parse("test", "test.toml", &GOOD.replace(", y = [0, 2]", text)).unwrap();
            assert_eq!(scene.plots[1].window.is_some(), !text.is_empty());
        }
    }
}
