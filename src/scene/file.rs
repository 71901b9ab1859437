//! Scene files, of the program and of the user: reads TOML into a [`Scene`]; and the scenes of what is opened by itself, a
//! machine or a recorded motion.
//!
//! A scene leaves out what follows from its source, which is an oscillator, a machine or a record: its numbers, and what is
//! drawn of it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::Serialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::examine::{examine, place};
use super::machine::{Machine, ScaledMachine, file};
use super::mistake::{Complaint, FileMistake, Result};
use super::placed::Placed;
use super::plot_setup::{Arrangement, Axes};
use super::scene::{Scene, named_or_whole};
use super::views::Layer;
use crate::fit::{Signal, length_in_metres};
use crate::flow::Problem;
use crate::model::Knob;
use crate::question::Recording;
use crate::question::record::{RecordOptions, apart};

/// Reads a file that a scene names, by that name, or says in one line why it cannot be read.
pub type Fetch<'a> = dyn FnMut(&str) -> Result<String, String> + 'a;

/// What is drawn where a scene says nothing else: of a machine, of a record, and of an oscillator.
const MACHINE: &str = include_str!("../../assets/templates/machine.toml");
const RECORD: &str = include_str!("../../assets/templates/record.toml");
const PLAIN: &str = include_str!("../../assets/scenes/plain.toml");

/// What a scene may leave out; a saved session, which holds a scene too, leaves out nothing.
#[derive(Default, Serialize)]
struct UsualScene {
    name: String,
    title: String,
    look: String,
    press: String,
    terms: BTreeSet<Knob>,
    problem: Problem,
    steps: BTreeMap<Knob, f64>,
    layers: BTreeSet<Layer>,
    arrangement: Arrangement,
    plots: [UsualPlot; 1],
}

/// The same of each of its plots.
#[derive(Default, Serialize)]
struct UsualPlot {
    axes: Axes,
}

/// Reads a scene of the program, which names no file.
pub fn parse(name: &str, file: &str, text: &str) -> Result<Scene, FileMistake> {
    study(name, file, text, &mut alone)
}

fn alone(_: &str) -> Result<String, String> {
    Err("a scene of the program stands alone".to_owned())
}

/// Reads a scene; `name` is the name by which it is opened, `file` the one in error messages, and `fetch` reads the files
/// that it names. Fails with [`FileMistake`], which names the place and what is allowed there.
pub fn study(name: &str, file: &str, text: &str, fetch: &mut Fetch) -> Result<Scene, FileMistake> {
    let read = DeTable::parse(text).map_err(Complaint::from).and_then(|read| {
        let places = read.clone();
        let scene = scene(read, fetch)?;
        let placed = |(path, message): (String, String)| Complaint {
            at: place(places.get_ref(), &path),
            message,
        };
        examine(&scene).map_err(placed)?;
        Ok(scene)
    });
    let mut scene = read.map_err(|complaint| complaint.in_file(file, text))?;
    name.clone_into(&mut scene.name);
    if scene.title.is_empty() {
        name.clone_into(&mut scene.title);
    }
    Ok(scene)
}

/// The scene of a file.
fn scene(mut read: Spanned<DeTable>, fetch: &mut Fetch) -> Result<Scene> {
    let given = read.get_mut();
    if let Some(key) = given.get("hopfscope") {
        let message = "a saved session, not a scene: --open FILE opens it".to_owned();
        return Err(Complaint { at: key.span(), message });
    }
    let machine = given.remove("machine").map(|value| machine(value, fetch)).transpose()?;
    let record = given.remove("record").map(|value| record(&value, fetch)).transpose()?;
    let template = match (&machine, &record) {
        (Some(_), _) => MACHINE,
        (None, Some(_)) => RECORD,
        (None, None) => PLAIN,
    };
    for (name, value) in DeTable::parse(template)?.into_inner() {
        if ["terms", "layers", "plots"].contains(&&**name.get_ref()) {
            given.entry(name).or_insert(value);
        }
    }
    let usual = UsualScene {
        problem: machine.as_ref().map(|it| it.problem()).unwrap_or_default(),
        ..UsualScene::default()
    };
    let usual = toml::to_string(&usual as &dyn erased_serde::Serialize);
    let usual = usual.expect("it is made of tables");
    let mut own = Placed::from(read);
    complete(own.0.get_mut(), Placed::from(DeTable::parse(&usual)?).0.get_ref());
    let mut scene: Scene = own.read()?;
    if let Some(scaled) = machine.as_ref().filter(|_| scene.terms.is_empty()) {
        scene.terms = scaled.terms();
    }
    scene.machine = machine;
    scene.recording = record.or(scene.recording);
    Ok(scene)
}

/// Adds what a table leaves out of the usual one; each table of a list is completed by the first of the usual list.
fn complete<'a>(own: &mut DeValue<'a>, usual: &DeValue<'a>) {
    match (own, usual) {
        (DeValue::Table(own), DeValue::Table(usual)) => {
            for (name, usual) in usual {
                match own.get_mut(name) {
                    Some(own) => complete(own.get_mut(), usual.get_ref()),
                    None => drop(own.insert(name.clone(), usual.clone())),
                }
            }
        }
        (DeValue::Array(own), DeValue::Array(usual)) => {
            for (own, usual) in own.iter_mut().zip(usual.iter().cycle()) {
                complete(own.get_mut(), usual.get_ref());
            }
        }
        _ => {}
    }
}

/// A machine of the program by its name, one of a file beside the scene, or one in full.
fn machine(value: Spanned<DeValue>, fetch: &mut Fetch) -> Result<Box<ScaledMachine>> {
    let at = value.span();
    let refused = |message: String| Complaint { at: at.clone(), message };
    let path = match value.get_ref() {
        DeValue::String(name) if name.ends_with(".toml") => name.to_string(),
        _ => {
            let read = named_or_whole(Placed(value)).map_err(|why| why.or_at(at.clone()))?;
            return read.ok_or_else(|| refused("no machine".to_owned()));
        }
    };
    let text = fetch(&path).map_err(refused)?;
    let beside = |table: &str| fetch(&Path::new(&path).with_file_name(table).to_string_lossy());
    let title = Path::new(&path).file_stem().unwrap_or_default().to_string_lossy();
    let described = file::parse(&title, &path, &text, beside);
    let described = described.map_err(|error| refused(error.to_string()))?;
    let scaled = Machine::try_from(described).map_err(str::to_owned);
    let scaled = scaled.and_then(|it| ScaledMachine::try_from(it).map_err(|why| why.to_string()));
    scaled.map(Box::new).map_err(|why| refused(format!("{path}: {why}")))
}

/// A record beside the scene, with how it is read, as in `run.csv mass=2 kg columns=1,3`.
fn record(value: &Spanned<DeValue>, fetch: &mut Fetch) -> Result<Recording> {
    let line: String = Placed(value.clone()).read()?;
    let (file, words) = apart(&line);
    let opened = RecordOptions::of_words(words).and_then(|options| {
        let opened = options.opened(Path::new(file), fetch(file)?.as_bytes());
        opened.map_err(|why| format!("{file}: {why}"))
    });
    opened.map(Recording::from).map_err(|message| Complaint { at: value.span(), message })
}

/// A scene of a file of the program, to be completed: its plots need what it does not have yet.
fn template(text: &str) -> Scene {
    let read = DeTable::parse(text).map_err(Complaint::from);
    read.and_then(|read| scene(read, &mut alone)).expect("tests open machines and records")
}

impl ScaledMachine {
    /// A scene of the machine: the mass on its belt and the phase plane.
    pub fn scene(self) -> Scene {
        Scene {
            name: self.machine.name.clone(),
            title: self.machine.title.clone(),
            watch: self.machine.watch.clone(),
            terms: self.terms(),
            problem: self.problem(),
            machine: Some(Box::new(self)),
            ..template(MACHINE)
        }
    }
}

impl Recording {
    /// A scene of the record: decrements, time series, phase plane and the distribution of the margin, with the
    /// motion that the fit will find.
    pub fn scene(self) -> Scene {
        let mut scene = template(RECORD);
        let (shown, seen) = match self.record.signal {
            Signal::Displacement => (Layer::Position, "Dots are what was measured,"),
            Signal::Velocity => (Layer::Velocity, "Dots are the velocities measured,"),
            Signal::Acceleration => {
                (Layer::Position, "The accelerations measured are seen in the residuals only;")
            }
        };
        let unit = self.record.unit.as_deref();
        let mut units =
            format!("lengths are in {} and times in 1/omega0", unit.unwrap_or("the file's unit"));
        if unit.and_then(length_in_metres).is_some() && !self.record.t.is_empty() {
            units.insert_str(0, "axes are in units of length and seconds; with units off ");
        }
        scene.layers.insert(shown);
        Scene {
            name: self.name.clone(),
            title: format!("{}, {}", self.name, scene.title),
            watch: format!("{seen} {}", scene.watch.replace("{units}", &units)),
            recording: Some(self),
            ..scene
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Problem;
    use crate::model::{Knob, Parameters, State};
    use crate::scene::machine::library::machines;
    use crate::scene::{Axes, MOST_PLOTS, Ordinate, PlotSetup, Unit, View, library};

    const GOOD: &str = r#"title = "A test"
look = "At this."
press = "That."
terms = ["D", "r"]
problem.parameters = { D = -0.4, D2 = 0, D3 = 0, r = 0.1 }
problem.initial = { q = 2, v = 0 }
problem.until = 60
layers = ["trajectory"]
plots = [
  { view = "phase", window = { x = [-3, 3], y = [-2.5, 2.5] } },
  { view = "diagram", axes = { abscissa = "D" }, window = { x = [-1, 0.1], y = [0, 2] } },
]
"#;

    #[test]
    fn a_scene_has_the_numbers_of_its_file_and_declares_its_terms() {
        let scene = parse("test", "test.toml", GOOD).unwrap();
        let Problem { parameters, initial, until, .. } = scene.problem;
        assert_eq!(parameters, Parameters { d: -0.4, d2: 0.0, d3: 0.0, r: 0.1 });
        assert_eq!((initial, until), (State { q: 2.0, v: 0.0 }, Knob::Until.usual()));
        assert!(scene.declares(Knob::R) && scene.declares(Knob::V0));
        assert!(!scene.declares(Knob::D3));
    }

    #[test]
    fn a_diagram_shows_q_max_over_d_unless_it_says_otherwise() {
        let scene = parse("test", "test.toml", GOOD).unwrap();
        assert_eq!(scene.plots[1].axes, Axes::default());
        let period = GOOD.replace("abscissa = \"D\"", "abscissa = \"r\", ordinate = \"period\"");
        let scene = parse("test", "test.toml", &period).unwrap();
        assert_eq!(
            scene.plots[1].axes,
            Axes { abscissa: Knob::R, ordinate: Ordinate::Period, ..Axes::default() }
        );
    }

    #[test]
    fn a_plot_without_a_window_is_fitted() {
        let fitted = GOOD.replace(", window = { x = [-1, 0.1], y = [0, 2] }", "");
        let scene = parse("test", "test.toml", &fitted).unwrap();
        assert!(scene.plots[0].window.is_some());
        assert_eq!(scene.plots[1].window, None);
        assert!(scene.plots[1].opening().x.contains(-0.4));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place_and_what_is_allowed() {
        for (from, to, place, words) in [
            ("title", "titel", "1:1", "`also`, `title`, `look`"),
            ("A test\"", "A test", "1:", ""),
            ("\"D\", \"r\"", "\"D4\"", "4:10", "no number \"D4\"; did you mean D"),
            ("D = -0.4", "D = \"a\"", "5:28", "expected f64"),
            ("[-3, 3]", "[3, -3]", "10:36", "the second larger"),
            (
                "abscissa = \"D\"",
                "ordinate = \"size\"",
                "11:43",
                "expected one of `q_max`, `q_min`",
            ),
            ("abscissa = \"D\"", "unit = \"m\"", "11:39", "expected `1` or `r`"),
            ("abscissa", "over", "11:32", "unknown field `over`"),
            ("\"phase\"", "\"plane\"", "10:12", "unknown variant `plane`"),
            ("view = \"phase\", window", "view = \"phase\", x", "10:21", "unknown field `x`"),
            ("\"trajectory\"", "\"tail\"", "8:11", "expected one of `trajectory`"),
            ("D = -0.4", "D = nan", "5:28", "D = NaN is outside its range"),
            ("until = 60", "until = -1", "7:17", "until = -1 is outside its range"),
            ("view = \"phase\"", "view = \"speeds\"", "10:12", "needs a machine"),
            ("abscissa = \"D\"", "abscissa = \"q0\"", "11:43", "an axis is D, D2, D3 or r"),
            ("{ view = \"diagram\"", "{ family = 0, view = \"diagram\"", "11:14", "no such family"),
            ("title", "hopfscope = 1\ntitle", "1:13", "--open FILE"),
            ("title", "machine = \"x.toml\"\ntitle", "1:11", "stands alone"),
            ("title", "record = \"x.csv mass=2 m\"\ntitle", "1:10", "m = 2 m has the wrong unit"),
            ("title", "machine = \"groan 1 m\"\ntitle", "1:11", "\"1 m\" is no speed of its belt"),
            ("title", "machine = \"none\"\ntitle", "1:", "no machine \"none\"; there are textbook"),
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
                let Axes { abscissa, against, ordinate, unit, machine } = *axes;
                let usual = Axes::default();
                assert!(abscissa.is_parameter() && against.is_parameter(), "{name}");
                assert!(machine.is_of_machine(), "{name}");
                let chart = *view == View::Regimes;
                assert!(chart || against == usual.against, "{name}: upwards only in a chart");
                assert!(!chart || abscissa != against, "{name}: one axis twice");
                let diagram = *view == View::Diagram;
                assert!(chart || diagram || abscissa == usual.abscissa, "{name}");
                assert!(diagram || (ordinate, unit) == (usual.ordinate, usual.unit), "{name}");
                assert!(unit == Unit::One || ordinate.spec().ratio.is_some(), "{name}");
            }
        }
    }

    #[test]
    fn a_machine_is_opened_with_its_own_words_and_numbers() {
        for machine in machines() {
            let scaled = ScaledMachine::try_from(machine.clone()).unwrap();
            let scene = scaled.clone().scene();
            assert_eq!((&scene.title, &scene.watch), (&machine.title, &machine.watch));
            assert_eq!((scene.problem, &scene.terms), (scaled.problem(), &scaled.terms()));
        }
    }
}
