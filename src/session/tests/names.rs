//! Commands by their names: the palette and the command line.

use super::Trial;
use crate::flow::Method;
use crate::scene::{Layer, Ordinate, Topic, View};
use crate::session::read::completion::completion;
use crate::session::{
    Effect, Listed, Msg, Overlay, Pane, Prompt, commands, lines, run_line, update,
};

fn run(trial: &mut Trial, line: &str) -> Vec<Topic> {
    trial.press(":");
    trial.give(Msg::Paste(line.to_owned()));
    trial.press("<enter>")
}

fn prompt(trial: &Trial) -> &Prompt {
    match &trial.session.overlay {
        Some(Overlay::Prompt(prompt)) => prompt,
        other => panic!("no line is open but {other:?}"),
    }
}

#[test]
fn every_command_is_reached_from_the_palette_without_a_key_of_its_own() {
    let trial = Trial::open("plain");
    let list = crate::session::List::default();
    let listed: Vec<_> = trial.session.palette_rows(&list).iter().map(|row| row.name()).collect();
    for command in commands() {
        let inside = command.keys.iter().all(|(context, _)| context.is_overlay());
        let name = command.name.strip_prefix("toggle-").unwrap_or(command.name);
        assert!(inside || listed.contains(&name), "{name}");
    }
    for line in lines() {
        assert!(listed.contains(&line.name), "{}", line.name);
    }
}

#[test]
fn the_palette_runs_a_command_in_the_pane_that_it_belongs_to() {
    let mut trial = Trial::open("plain");
    trial.press("<space>next-abs<enter>");
    let focused = trial.session.focused().expect("the diagram has the focus");
    assert_eq!((focused.view, focused.axes.abscissa.spec().name), (View::Diagram, "D2"));
    trial.press("<space>step-size-larger<enter>");
    assert_eq!(trial.session.focus, Pane::Parameters);
    trial.press("<space>walk-on<enter>");
    assert_eq!(trial.notice(), "walk-on needs a branch: w on a diagram takes hold of one");
    trial.press("<space>no<space>such<space>thing<enter>");
    assert!(matches!(trial.session.overlay, Some(Overlay::List(Listed::Palette, _))));
    trial.press("<esc>");
    assert_eq!(trial.session.overlay, None);
}

#[test]
fn what_takes_words_gets_a_line_from_the_palette() {
    let mut trial = Trial::open("plain");
    trial.press("<space>open<space>a<space>sc<enter>supercritical<enter>");
    assert_eq!(trial.session.scene.name, "supercritical");
}

#[test]
fn values_are_set_by_name_as_one_change() {
    let mut trial = Trial::open("plain");
    let asked = run(&mut trial, "set D=-0.3 D3=0.5 until=100 method=taylor");
    assert!(asked.contains(&Topic::Trajectory));
    let problem = trial.session.problem;
    assert_eq!((problem.parameters.d, problem.parameters.d3), (-0.3, 0.5));
    assert_eq!((problem.until, problem.method), (100.0, Method::Taylor));
    run(&mut trial, "tol 1e-9");
    assert_eq!(trial.session.problem.tolerance, 1e-9);
    trial.press("u u");
    assert_eq!(trial.session.problem, trial.session.scene.problem);
}

#[test]
fn scenes_views_layers_windows_and_axes_have_names() {
    let mut trial = Trial::open("plain");
    run(&mut trial, "scene linear");
    assert_eq!(trial.session.scene.name, "linear");
    let on = trial.session.layers.contains(&Layer::Basin);
    run(&mut trial, "layer basin");
    assert_ne!(trial.session.layers.contains(&Layer::Basin), on);
    run(&mut trial, "layer basin on");
    run(&mut trial, "layer basin on");
    assert!(trial.session.layers.contains(&Layer::Basin));
    run(&mut trial, "window -3:3,-1:1.5");
    let window = trial.session.plots[0].window;
    assert_eq!((window.x.from(), window.y.to()), (-3.0, 1.5));
    run(&mut trial, "axes r period");
    let plot = trial.session.focused().expect("the diagram");
    assert_eq!(plot.axes.ordinate, Ordinate::Period);
    run(&mut trial, "view phase");
    assert!(trial.session.plots.iter().all(|plot| plot.view == View::Phase));
    run(&mut trial, "axes D");
    assert_eq!(
        prompt(&trial).refused.as_deref(),
        Some("axes: no plot shows a diagram; view diagram makes one")
    );
}

#[test]
fn every_command_of_the_keys_is_a_line_too() {
    let mut trial = Trial::open("plain");
    let on = trial.session.layers.contains(&Layer::Field);
    run(&mut trial, "toggle-field");
    assert_ne!(trial.session.layers.contains(&Layer::Field), on);
    run(&mut trial, "theme light");
    run(&mut trial, "theme");
    assert_eq!(trial.notice(), "theme: dark");
    run(&mut trial, "quit");
    assert!(trial.session.quit && trial.effects.contains(&Effect::Quit));
}

#[test]
fn what_is_wrong_stays_in_the_line_with_what_is_allowed() {
    for (line, said) in [
        ("sett D=1", "no command \"sett\"; did you mean set?"),
        ("xyzzy", "no command \"xyzzy\"; Tab lists them"),
        ("set", "set needs NAME=VALUE ..: Give values"),
        ("set D", "set: \"D\" is no NAME=VALUE, such as D=-0.3"),
        ("set E=1", "set: no value \"E\"; there are D, D2"),
        ("set D=-0.3 r=-1", "set: r = -1 is out of range; r takes 0 to 1e300"),
        ("set D=nan", "set: nan is no finite number; D takes -1000000 to 1000000"),
        ("method euler", "method: no method \"euler\"; there are auto"),
        ("tol 1", "tol: tolerance = 1 is out of range; tolerance takes 1e-15 to 0.01"),
        ("scene linaer", "scene: no scene \"linaer\"; did you mean linear"),
        ("layer basin maybe", "layer: basin can be on or off, not \"maybe\""),
        ("window 1:1,0:1", "window: [1.0, 1.0] is no interval"),
        ("window 1", "window: \"1\" is no X0:X1,Y0:Y1"),
        ("harmonics 0", "harmonics: \"0\" is not a number of harmonics from 1 to 63"),
        ("glyphs runes", "glyphs: no \"runes\"; there are auto, braille"),
        ("undo twice", "undo takes no words, but there are \"twice\""),
        ("axes q0", "axes: no diagram over \"q0\"; there are D, D2, D3, r"),
    ] {
        let mut trial = Trial::open("plain");
        let before = trial.session.problem;
        run(&mut trial, line);
        let refused = prompt(&trial).refused.clone().unwrap_or_default();
        assert!(refused.starts_with(said) && !refused.contains('\n'), "{line}: {refused}");
        assert_eq!(trial.session.problem, before, "{line}: all of it or nothing");
        trial.press("<backspace>");
        assert_eq!(prompt(&trial).refused, None);
        trial.press("<esc>");
        assert_eq!(trial.session.overlay, None);
    }
}

#[test]
fn tab_completes_and_goes_through_what_is_possible() {
    let mut trial = Trial::open("plain");
    trial.press(":sce<tab>");
    assert_eq!(prompt(&trial).input.text(), "scene");
    trial.press("<tab>");
    assert_eq!(prompt(&trial).input.text(), "scenes");
    trial.press("<S-tab><space>sup<tab>");
    assert_eq!(prompt(&trial).input.text(), "scene supercritical ");
    trial.press("<C-u>set<space>D3<tab>");
    assert_eq!(prompt(&trial).input.text(), "set D3=");
    trial.press("<tab>");
    assert_eq!(prompt(&trial).input.text(), "set D3=0 ");
    trial.press("<tab>");
    assert_eq!(prompt(&trial).input.text(), "set D3=0 D=");
    trial.press("<C-u>layer<space>zz<tab>");
    assert_eq!(prompt(&trial).refused.as_deref(), Some("nothing to complete here"));
    trial.press("<C-u>layer<space>fi<space>on<left*3><tab>");
    assert_eq!(prompt(&trial).input.text(), "layer field on");
}

#[test]
fn every_line_completes_its_words_to_ones_that_it_accepts() {
    for line in lines() {
        let mut trial = Trial::open("linear");
        trial.press("<tab>");
        let words = completion(&trial.session, &format!("{} ", line.name));
        let words = words.map_or(Vec::new(), |found| found.words);
        for word in words.iter().filter(|word| !word.ends_with('=')) {
            let mut session = trial.session.clone();
            let done = run_line(&mut session, &format!("{} {word}", line.name));
            assert!(done.is_ok(), "{} {word}: {done:?}", line.name);
        }
    }
}

#[test]
fn old_lines_come_back_and_the_new_one_is_not_lost() {
    let mut trial = Trial::open("plain");
    run(&mut trial, "set D=-0.2");
    run(&mut trial, "toggle-field");
    run(&mut trial, "set D=-0.2");
    assert_eq!(trial.session.lines, ["toggle-field", "set D=-0.2"]);
    trial.press(":un<up>");
    assert_eq!(prompt(&trial).input.text(), "set D=-0.2");
    trial.press("<up*5>");
    assert_eq!(prompt(&trial).input.text(), "toggle-field");
    trial.press("<down*5>");
    assert_eq!(prompt(&trial).input.text(), "un");
    trial.press("<up><enter>");
    assert_eq!(trial.session.overlay, None);
}

#[test]
fn an_empty_line_does_nothing() {
    let mut trial = Trial::open("plain");
    let before = trial.session.clone();
    trial.press(":<enter>:<space><enter>");
    assert_eq!((trial.session.problem, &trial.session.lines), (before.problem, &before.lines));
    let _ = update(&mut trial.session, Msg::Idle);
}

#[test]
fn the_palette_finds_what_has_all_the_words() {
    let mut trial = Trial::open("plain");
    trial.press("<space>mark<space>go");
    let Some(Overlay::List(Listed::Palette, list)) = &trial.session.overlay else {
        panic!("the palette")
    };
    let rows = trial.session.palette_rows(list);
    let names: Vec<_> = rows.iter().map(|row| row.name()).collect();
    assert_eq!(names[0], "go-to-mark");
    assert!(names.contains(&"goto") && !names.contains(&"set-mark"), "{names:?}");
}

/// What the palette finds for some words.
fn found(words: &str) -> Vec<(&'static str, &'static str)> {
    let trial = Trial::open("plain");
    let list = crate::session::List { search: words.to_owned(), ..Default::default() };
    let rows = trial.session.palette_rows(&list);
    rows.iter().map(|row| (trial.session.heading(*row), row.name())).collect()
}

/// What a person types, and the row that is meant.
#[rustfmt::skip]
const MEANT: [(&str, &str); 60] = [
    ("fold", "walk-to-next"), ("export", "save-figure"), ("stable", "cycles"), ("animate", "play-motion"),
    ("fig 16", "fig16"), ("fig16b", "supercritical"), ("time series", "time-series"), ("damping", "damping"),
    ("save", "write"), ("zoom", "zoom-in"), ("undo", "undo"), ("amplitude", "diagram"), ("basin", "basin"),
    ("hopf", "hopf"), ("period", "axes"), ("quit", "quit"), ("exit", "quit"), ("copy", "copy-number"),
    ("theme", "theme"), ("help", "help"), ("keys", "help"), ("color", "color"), ("bifurcation", "diagram"),
    ("phase plane", "phase"), ("friction", "friction"), ("sweep", "scan-form"), ("scan", "scan-form"),
    ("kick", "start-inside"), ("tolerance", "tol"), ("method", "next-method"), ("mouse", "mouse"),
    ("record", "record"), ("macro", "macro"), ("mark", "set-mark"), ("import", "fit"), ("load", "open"),
    ("open", "open"), ("print", "save-figure"), ("csv", "save-scan"), ("eigenvalue", "eigenvalues"),
    ("poincare", "return-map"), ("return map", "return-map"), ("lyapunov", "lyapunov"), ("restart", "reset-scene"),
    ("reset", "reset-value"), ("squeal", "groan"), ("tour", "tour"), ("window", "window"), ("axis", "axes"),
    ("new plot", "add-plot"), ("split", "add-plot"), ("redo", "redo"), ("screenshot", "copy-screen"),
    ("play", "play-motion"), ("uncertainty", "wider"), ("border", "boundaries"), ("clutch", "clutch"),
    ("48", "(48)"), ("search", "palette"), ("resume", "restore"),
];

#[test]
fn what_a_person_types_finds_first_what_is_meant() {
    let first = |words: &str| found(words).first().map(|(_, name)| *name);
    let wrong: Vec<_> = MEANT.iter().filter(|(words, name)| first(words) != Some(name)).collect();
    let found: Vec<_> = wrong.iter().map(|(words, _)| (words, first(words))).collect();
    assert!(wrong.is_empty(), "{found:?}");
}

#[test]
fn a_key_that_is_searched_for_comes_before_all_that_has_its_letter() {
    for (key, name) in [("i", "start-inside"), ("%", "scan-form"), ("W", "add-plot")] {
        assert_eq!(found(key)[0].1, name, "{key}");
    }
}

#[test]
fn a_picker_lists_first_what_is_called_so() {
    for (keys, view) in [("V/damping<enter>", View::Damping), ("V/phase<enter>", View::Phase)] {
        let mut trial = Trial::open("energy");
        trial.press(keys);
        assert_eq!(trial.session.view_in_use(), view, "{keys}");
    }
    let mut trial = Trial::open("plain");
    trial.press("s/escape<enter>");
    assert_eq!(trial.session.scene.name, "escape");
}

#[test]
fn every_other_word_is_of_something_that_is_listed() {
    let all: Vec<&str> = found("").into_iter().map(|(_, name)| name).collect();
    for (name, _) in crate::session::read::search::ALIASES {
        assert!(all.contains(name), "{name}");
    }
}

#[test]
fn the_list_begins_with_what_belongs_to_the_pane_in_focus() {
    let mut trial = Trial::open("plain");
    for (keys, heading) in [("<esc>", "Parameters"), ("<tab>", "Phase plane")] {
        trial.press(keys);
        let rows = trial.session.palette_rows(&crate::session::List::default());
        assert_eq!(trial.session.heading(rows[0]), heading);
    }
    assert!(found("").iter().all(|(_, name)| *name != "caret-left"), "of lines only");
}

#[test]
fn scenes_views_layers_and_claims_are_run_from_the_palette() {
    let mut trial = Trial::open("plain");
    trial.press("<space>eigenvalues<enter>");
    let shown = trial.session.plots.iter().any(|plot| plot.view == View::Eigenvalues);
    assert!(shown, "{}", trial.notice());
    trial.press("<space>lyapunov<enter>");
    assert!(trial.session.layers.contains(&crate::scene::Layer::Lyapunov), "{}", trial.notice());
    trial.press("<space>fig16b<enter>");
    assert_eq!(trial.session.scene.name, "supercritical");
    trial.press("<space>clutch<enter>");
    assert!(trial.session.scene.machine.is_some(), "{}", trial.notice());
}

#[test]
fn words_that_are_no_command_are_looked_for_in_the_list_of_everything() {
    let mut trial = Trial::open("supercritical");
    run(&mut trial, "animate");
    assert!(
        matches!(&trial.session.overlay, Some(Overlay::List(Listed::Palette, list)) if list.search == "animate")
    );
    trial.press("<enter>");
    assert!(
        trial.session.overlay.is_none() && trial.session.playback.playing,
        "{}",
        trial.notice()
    );
    run(&mut trial, "fig 16");
    assert!(matches!(trial.session.overlay, Some(Overlay::List(Listed::Palette, _))));
}

#[test]
fn scenes_are_picked_from_groups_by_any_of_their_names() {
    let mut trial = Trial::open("fig16b");
    trial.press("s<enter>");
    assert_eq!(trial.session.scene.name, "supercritical");
    trial.press("s/fig16a<enter>");
    assert_eq!(trial.session.scene.name, "marginal");
    run(&mut trial, "scene fig07");
    assert_eq!(trial.session.scene.name, "linear");
    trial.press("s<end><enter>");
    assert!(trial.session.scene.machine.is_some());
}

#[test]
fn a_key_of_another_plot_on_show_goes_there() {
    let mut trial = Trial::open("plain");
    trial.press("<tab> N");
    assert_eq!(trial.session.focused().map(|plot| plot.view), Some(View::Diagram));
    assert_ne!(trial.session.focused().map(|plot| plot.axes.unit), Some(crate::scene::Unit::One));
    let mut trial = Trial::open("energy");
    trial.press("t");
    assert!(trial.notice().contains("needs the scan"), "{}", trial.notice());
}

#[test]
fn short_names_of_other_programs_are_known() {
    let mut trial = Trial::open("plain");
    run(&mut trial, "w");
    assert!(
        prompt(&trial).refused.as_deref().is_some_and(|why| why.starts_with("write needs FILE"))
    );
    trial.press("<esc>");
    run(&mut trial, "set tol=1e-8");
    assert_eq!(trial.session.problem.tolerance, 1e-8);
    run(&mut trial, "q");
    assert!(trial.session.quit);
}

#[test]
fn numbers_points_and_rows_are_copied() {
    let copied = |scene: &str, keys: &str| {
        let mut trial = Trial::open(scene);
        trial.press(keys);
        match trial.effects.last() {
            Some(Effect::Copy(text)) => text.clone(),
            _ => trial.notice().to_owned(),
        }
    };
    assert_eq!(copied("supercritical", "y"), "-0.3");
    assert_eq!(copied("supercritical", "<A-r>"), "D=-0.3 D2=0 D3=0.5 r=0.1 q0=0.3 v0=0");
    assert_eq!(copied("supercritical", "<tab>y"), "nothing is pointed at: arrows show a cursor");
    assert_eq!(copied("supercritical", "<tab><right>y").split(' ').count(), 2);
    let held = copied("supercritical", "w<tab><A-r>");
    let names = held.split(' ').filter_map(|word| Some(word.split_once('=')?.0));
    let names: Vec<&str> = names.collect();
    let expected = ["D", "q_max", "q_min", "v_min", "v_max", "period", "D2", "D3", "r", "q0", "v0"];
    assert_eq!(names, expected, "{held}");
}
