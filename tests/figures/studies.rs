//! Studies: what is made of a file is made again of what it says, and mistakes are told with their place.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::sync::Arc;

use hopfscope::figure::{Figure, FigureForm, file};
use hopfscope::flow::Limits;
use hopfscope::question::Fineness;
use hopfscope::runtime::print::{complete, unseen};
use hopfscope::scan::LevelTarget;
use hopfscope::scene::file::study;
use hopfscope::scene::{Scene, find, library};
use hopfscope::session::{Playback, Session, Size, study as of_session};
use serde_json::Value;

use crate::program::{Ran, command};

/// Runs the program in a folder.
fn run_in(folder: &Path, line: &[&str]) -> Ran {
    let output = command(line).current_dir(folder).stdin(Stdio::null()).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Ran { code: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
}

fn session(scene: Scene) -> Session {
    let mut session = Session::new(Arc::new(scene), Size { width: 100, height: 30 });
    // As on paper: the whole motion, also where a scene plays it.
    session.playback = Playback::default();
    complete(&mut session, Fineness::PRINT, &Limits::PATIENT).unwrap();
    session
}

fn drawn(session: &Session) -> String {
    let figure = Figure::of(session, 0..session.plots.len());
    String::from_utf8(file(&figure, FigureForm::Json).unwrap()).unwrap()
}

/// The figure in a file, without what says where it is from.
fn figure(path: &Path) -> Value {
    let mut read: Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
    read["provenance"].take();
    read["figure"].take();
    read
}

#[test]
fn a_study_of_every_scene_draws_the_same_figure() {
    for scene in library() {
        let level = LevelTarget::read("impulse=0.3").unwrap();
        let levels = vec![level; usize::from(scene.name == "regimes")];
        let opened = session(Scene { levels, ..Scene::clone(scene) });
        let text = of_session::text(&opened).unwrap();
        let mut fetch = |_: &str| Err("a file".to_owned());
        let again = study(&scene.name, "again.toml", &text, &mut fetch).unwrap();
        assert_eq!(drawn(&session(again)), drawn(&opened), "{}", scene.name);
    }
}

#[test]
fn the_window_of_every_scene_shows_all_of_its_lines_and_gives_way_where_it_does_not() {
    for scene in library() {
        let opened = session(Scene::clone(scene));
        let left: Vec<_> = (0..opened.plots.len()).filter(|plot| unseen(&opened, *plot)).collect();
        assert_eq!(left, [0; 0], "{}", scene.name);
    }
    let folder = tempfile::tempdir().unwrap();
    // With less cubic damping the stable cycle is larger than the window.
    let line = ["figure", "fig16b", "--set", "D3=0.05", "--format", "json"];
    let moved = run_in(folder.path(), &line);
    assert!(moved.code == 0 && moved.err.contains("it is fitted"), "{}", moved.err);
}

/// A study in its folder, with the files that it names.
const STUDY: &str = r#"
title = "Two belts"
machine = "belt.toml"
problem.until = 30
outputs = ["a.json", "deep/b.svg", "data.ipynb"]
layers = ["whole", "trajectory", "belt", "cycles"]
plots = [{ view = "phase" }]

[[scans]]
over = ["v0=0.2:0.4:3"]
measure = ["margin"]
output = "margins.csv"
"#;

#[test]
fn one_command_makes_all_files_of_a_study_and_again_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let belts = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/belts/textbook.toml");
    fs::copy(belts, folder.join("belt.toml")).unwrap();
    fs::write(folder.join("my.toml"), STUDY).unwrap();
    let names = ["a.json", "deep/b.svg", "data.ipynb", "margins.csv"];
    let read = || names.map(|name| fs::read(folder.join("made").join(name)).unwrap());
    let made = run_in(folder, &["figure", "my.toml", "--output", "made/"]);
    assert_eq!((made.code, made.out.as_str()), (0, ""), "{}", made.err);
    let first = read();
    let told: Value = serde_json::from_slice(&first[0]).unwrap();
    let again = told["provenance"]["command"].as_str().unwrap();
    let words: Vec<&str> = again.split(' ').skip(1).collect();
    fs::remove_dir_all(folder.join("made")).unwrap();
    assert_eq!(run_in(folder, &words).code, 0, "{again}");
    assert_eq!(read(), first);
    // What is there and the same stays; what is something else is not replaced unasked.
    assert_eq!(run_in(folder, &words).code, 0);
    fs::write(folder.join("made/a.json"), "mine").unwrap();
    run_in(folder, &words).is_refused(&["made/a.json", "--force"]);
    assert_eq!(fs::read_to_string(folder.join("made/a.json")).unwrap(), "mine");
    // The rows are those of the machine, asked directly.
    let line = "scan --machine belt.toml --over v0=0.2:0.4:3 --measure margin";
    let rows = run_in(folder, &line.split(' ').collect::<Vec<_>>());
    assert_eq!(rows.out.as_bytes(), first[3]);
    let notebook: Value = serde_json::from_slice(&first[2]).unwrap();
    assert!(notebook["cells"].to_string().contains("'margins.csv'"));
}

#[test]
fn every_command_takes_the_file_of_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = run_in(folder, &["scenes", "--show", "fig16b"]).out;
    fs::write(folder.join("my.toml"), text).unwrap();
    for line in ["cycles", "margin", "trajectory --until 20", "branch --over D=-0.3:-0.1:5"] {
        let mut words: Vec<&str> = line.split(' ').collect();
        let of_scene = run_in(folder, &[&words[..], &["--scene", "fig16b"]].concat());
        words.extend(["--scene", "my.toml"]);
        let first = |text: &str| text.lines().take(8).map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(first(&run_in(folder, &words).out), first(&of_scene.out), "{line}");
    }
    // A study about a machine asks the machine.
    fs::write(folder.join("belt.toml"), "machine = \"textbook\"\n").unwrap();
    let own = run_in(folder, &["cycles", "--machine", "textbook", "--set", "v0=0.2"]).out;
    let asked = run_in(folder, &["cycles", "belt.toml", "--set", "v0=0.2"]).out;
    assert_eq!(asked.lines().nth(4), own.lines().nth(4));
}

#[test]
fn mistakes_in_a_study_are_told_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = |line: &str| format!("problem.parameters = {{ D = -0.3 }}\n{line}\n");
    for (line, words) in [
        ("problem.until = -1", "my.toml:2:17: until = -1 is outside its range"),
        ("machine = \"no.toml\"", "my.toml:2:11: no.toml: No such file"),
        ("record = \"no.csv\"", "my.toml:2:10: "),
        ("outputs = [\"a.bmp\"]", "a figure ends in .pdf"),
        ("outputs = [\"../a.pdf\"]", "without .."),
        ("outputs = [\"/tmp/a.pdf\"]", "without .."),
        (
            "[[scans]]\nover = \"D=0:1:5\"\nmeasure = \"margins\"\noutput = \"a.csv\"",
            "no measure \"margins\"",
        ),
        (
            "[[scans]]\nover = \"D=0:1\"\nmeasure = \"margin\"\noutput = \"a.csv\"",
            "NAME=FROM:TO:COUNT",
        ),
        ("[[scans]]\nover = \"D=0:1:5\"\nmeasure = \"margin\"", "--output <FILE>"),
        ("sheet.panels = [3]", "there is no panel 3"),
        ("plots = []", "0 plots; there can be 1 to 4"),
    ] {
        fs::write(folder.join("my.toml"), text(line)).unwrap();
        run_in(folder, &["figure", "my.toml"]).is_refused(&[words]);
    }
    fs::write(folder.join("my.toml"), b"title = \"\xff\"").unwrap();
    run_in(folder, &["cycles", "my.toml"]).is_refused(&["my.toml", "UTF-8"]);
    run_in(folder, &["cycles", "./none.toml"]).is_refused(&["none.toml", "No such file"]);
}

#[test]
fn a_figure_of_the_explorer_is_drawn_again_by_the_command_that_it_names() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (number, keys) in [
        "<right*3> <tab> +",
        "p <right*2> i",
        "<run \"scene slow-belt\"> <run \"set belt=0.25\"> <wait>",
        "<run \"scene fig16\"> <tab*2> z",
        "<run \"scene regimes\"> <run \"level impulse=0.25\">",
    ]
    .into_iter()
    .enumerate()
    {
        let name = format!("f{number}");
        let text = format!("{keys} <wait> <run \"figure {name}.json\"> <wait>");
        fs::write(folder.join("walk.keys"), text).unwrap();
        let played = run_in(folder, &["replay", "walk.keys", "--write", "made"]);
        assert_eq!(played.code, 0, "{}", played.err);
        let written = folder.join("made").join(format!("{name}.json"));
        let told: Value = serde_json::from_slice(&fs::read(&written).unwrap()).unwrap();
        let line = told["provenance"]["command"].as_str().unwrap().to_owned();
        let first = figure(&written);
        fs::remove_file(&written).unwrap();
        let words: Vec<&str> = line.split(' ').skip(1).collect();
        let again = run_in(folder, &words);
        assert_eq!((again.code, again.err.as_str()), (0, ""), "{line}");
        assert_eq!(figure(&written), first, "{keys}");
    }
}

#[test]
fn a_keystroke_file_writes_into_its_folder_and_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for path in ["../out.toml", "/tmp/hopfscope-outside.toml", "a/../../out.toml"] {
        fs::write(folder.join("walk.keys"), format!("<run \"write! {path}\">")).unwrap();
        let played = run_in(folder, &["replay", "walk.keys", "--write", "made"]);
        assert!(played.code == 1 && played.err.contains("is not in made"), "{}", played.err);
        assert!(!folder.join(path).exists(), "{path}");
    }
    fs::write(folder.join("walk.keys"), "<run \"study my.toml\">").unwrap();
    assert_eq!(run_in(folder, &["replay", "walk.keys", "--write", "made"]).code, 0);
    assert!(find("plain").is_ok() && folder.join("made/my.toml").is_file());
}

#[test]
fn the_study_of_the_documentation_is_made_in_one_command() {
    let folder = tempfile::tempdir().unwrap();
    let study = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/studies/kicks.toml");
    let results = folder.path().join("results");
    let names = ["kicks.pdf", "kicks.png", "kicks.json", "kicks.ipynb", "margins.csv"];
    let read = || names.map(|name| fs::read(results.join(name)).unwrap());
    let made = run_in(folder.path(), &["figure", study, "--output", "results/"]);
    assert_eq!((made.code, made.out.as_str()), (0, ""), "{}", made.err);
    let first = read();
    assert_eq!(String::from_utf8_lossy(&first[4]).lines().count(), 1 + 9 * 7);
    let told: Value = serde_json::from_slice(&first[2]).unwrap();
    let curves = told["panels"][0]["curves"].as_array().unwrap();
    for level in ["impulse=0.2", "impulse=0.3", "impulse=0.4"] {
        assert!(curves.iter().any(|curve| curve["name"] == level), "{level}");
    }
    // And again, byte for byte, by the command that its provenance names.
    fs::remove_dir_all(&results).unwrap();
    let line = told["provenance"]["command"].as_str().unwrap();
    let again = run_in(folder.path(), &line.split(' ').skip(1).collect::<Vec<_>>());
    assert_eq!((again.code, read()), (0, first), "{line}");
}

/// Of a saved session those panels are drawn that are asked for, in that order, each with its own window.
#[test]
fn panels_and_windows_of_a_session_are_those_that_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("walk.keys"), "<run \"write s.toml\">").unwrap();
    let line = ["replay", "walk.keys", "--scene", "fig17", "--write", "."];
    assert_eq!(run_in(folder, &line).code, 0);
    let of = |source: &[&str], more: &[&str]| {
        let ran = run_in(folder, &[&["figure"], source, &["--format", "json"], more].concat());
        assert_eq!(ran.code, 0, "{}", ran.err);
        let told: Value = serde_json::from_str(&ran.out).unwrap();
        told["panels"].clone()
    };
    let (whole, some) = (of(&["--open", "s.toml"], &[]), ["--panels", "3,1"]);
    let [third, first] = [2, 0].map(|panel| whole[panel].clone());
    assert_eq!(of(&["--open", "s.toml"], &some), Value::from(vec![third, first]));
    assert_eq!(of(&["--open", "s.toml"], &some), of(&["fig17"], &some));
    let windows = ["--panels", "4,3", "--window=-1:1,-2:2", "--window=-3:3,-4:4"];
    let shown = of(&["--open", "s.toml"], &windows);
    let from =
        |panel: usize| (shown[panel]["x"]["from"].clone(), shown[panel]["y"]["from"].clone());
    assert_eq!(
        (from(0), from(1)),
        ((Value::from(-1.0), (-2.0).into()), ((-3.0).into(), (-4.0).into()))
    );
    let text = run_in(folder, &["figure", "--open", "s.toml", "--panels", "2"]);
    assert_eq!(text.out.matches("over D").count(), 1, "{}", text.out);
    let two =
        ["figure", "--open", "s.toml", "--panels", "2", "--window=0:1,0:1", "--window=0:1,0:1"];
    run_in(folder, &two).is_refused(&["--window: 2 for 1 panels"]);
}

#[test]
fn the_facts_for_a_caption_stand_beside_the_pictures_of_a_study_too() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(
        folder.join("my.toml"),
        "problem.parameters = { D = -0.3, D3 = 0.5 }\noutputs = [\"a.svg\"]\n",
    )
    .unwrap();
    assert_eq!(run_in(folder, &["figure", "my.toml", "--caption"]).code, 0);
    assert!(fs::read_to_string(folder.join("a.txt")).unwrap().contains("D3 = 0.5"));
    run_in(folder, &["figure", "fig07", "--caption"]).is_refused(&["--caption", "--output"]);
}

/// A figure is written with the session that draws it; a study that has its name is the user's.
#[test]
fn a_figure_of_the_explorer_replaces_no_study_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("a.toml"), "mine").unwrap();
    fs::write(folder.join("walk.keys"), "<run \"figure! a.svg\"> <wait>").unwrap();
    assert_eq!(run_in(folder, &["replay", "walk.keys", "--write", "."]).code, 0);
    assert_eq!(fs::read_to_string(folder.join("a.toml")).unwrap(), "mine");
    let drawn = run_in(folder, &["figure", "--open", "a.svg.toml", "--output", "b.svg"]);
    assert_eq!(drawn.code, 0, "{}", drawn.err);
    // The session follows the figure; what is no session is kept.
    let first = fs::read_to_string(folder.join("a.svg.toml")).unwrap();
    let keys = "<run \"set D=-0.2\"> <run \"figure! a.svg\"> <wait>";
    fs::write(folder.join("walk.keys"), keys).unwrap();
    run_in(folder, &["replay", "walk.keys", "--write", "."]);
    assert_ne!(fs::read_to_string(folder.join("a.svg.toml")).unwrap(), first);
    fs::write(folder.join("a.svg.toml"), "mine").unwrap();
    run_in(folder, &["replay", "walk.keys", "--write", "."]);
    assert_eq!(fs::read_to_string(folder.join("a.svg.toml")).unwrap(), "mine");
}
