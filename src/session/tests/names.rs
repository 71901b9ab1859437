//! Commands by their names: the palette and the command line.

use std::sync::Arc;

use super::facts::refuses;
use super::{Trial, open_list};
use crate::model::FrictionLaw;
use crate::scene::View;
use crate::session::read::completion::completion;
use crate::session::{Effect, List, run_line};

#[test]
fn the_palette_runs_a_command_in_the_pane_that_it_belongs_to() {
    Trial::open("plain").goes(&[
        ("<space>next-abs<enter>", "focus 1 diagram | abscissa D2"),
        ("<space>step-size-larger<enter>", "focus parameters"),
        (
            "<space>walk-on<enter>",
            "notice walk-on needs a branch: w on a diagram takes hold of one",
        ),
        ("<space>no<space>such<space>thing<enter>", "open Palette"),
        ("<esc>", "open none"),
        // A command that takes words opens the line.
        ("<space>as<space>one<space>change<enter>D=-0.3<enter>", "D -0.3"),
    ]);
}

#[test]
fn values_are_set_by_name_as_one_change() {
    let mut trial = Trial::open("plain");
    trial.goes(&[
        (
            ": set D=-0.3 D3=0.5 until=100 method=taylor",
            "asked Trajectory.. | D -0.3 | D3 0.5 | until 100 | method taylor",
        ),
        (": tol 1e-9", "tolerance 1e-9"),
        ("u u", "changes 0 2"),
    ]);
    assert_eq!(trial.session.problem, trial.session.scene.problem);
}

#[test]
fn scenes_views_layers_windows_and_axes_have_names() {
    let mut trial = Trial::open("plain");
    trial.goes(&[
        (": scene linear", "scene linear | +basin"),
        (": layer basin", "-basin"),
        (": layer basin on", "+basin"),
        (": layer basin on", "+basin"),
        (": window -3:3,-1:1.5", ""),
    ]);
    let window = trial.session.plots[0].window;
    assert_eq!((window.x.from(), window.y.to()), (-3.0, 1.5));
    trial.goes(&[(": axes r period", "ordinate period"), (": view phase", "")]);
    assert!(trial.session.plots.iter().all(|plot| plot.view == View::Phase));
    let why = "refused axes: no plot shows a diagram; view diagram makes one";
    trial.goes(&[(": axes D", why)]);
}

#[test]
fn every_command_of_the_keys_is_a_line_too() {
    let mut trial = Trial::open("plain");
    trial.goes(&[
        (": toggle-field", "-field"),
        (": theme light", ""),
        (": theme", "notice theme: dark"),
        (": quit", "quit true"),
    ]);
    assert!(trial.effects.contains(&Effect::Quit));
}

#[test]
fn what_is_wrong_stays_in_the_line_with_what_is_allowed() {
    refuses(
        "plain",
        &[
            (": sett D=1", "no command \"sett\"; did you mean set?"),
            (": xyzzy", "no command \"xyzzy\"; Tab lists them"),
            (": set", "set needs NAME=VALUE ..: Set values"),
            (": set D", "set: \"D\" is not NAME=VALUE, such as D=-0.3"),
            (": set E=1", "set: no number \"E\"; there are D, D2"),
            (": set D=-0.3 r=-1", "set: r = -1 is outside its range 0 .. 1e150"),
            (": set D=nan", "set: \"nan\" is not a number; D takes -1e6 .. 1e6"),
            (": method euler", "method: no method \"euler\"; there are auto"),
            (": tol 1", "tol: tolerance = 1 is outside its range 1e-15 .. 0.01"),
            (": scene linaer", "scene: no scene \"linaer\"; did you mean linear"),
            (": layer basin maybe", "layer: basin can be on or off, not \"maybe\""),
            (": window 1:1,0:1", "window: [1.0, 1.0] is not an interval"),
            (": window 1", "window: \"1\" is not X0:X1,Y0:Y1"),
            (": harmonics 0", "harmonics: \"0\" is not a number of harmonics from 1 to 63"),
            (": glyphs runes", "glyphs: no \"runes\"; there are auto, braille"),
            (": undo twice", "undo takes no words, but there are \"twice\""),
            (": axes q0", "axes: no diagram over \"q0\"; there are D, D2, D3, r"),
        ],
    );
}

#[test]
fn tab_completes_and_goes_through_what_is_possible() {
    Trial::open("plain").goes(&[
        (":sce<tab>", "typed scene"),
        ("<tab>", "typed scenes"),
        ("<S-tab><space>sup<tab>", "typed scene supercritical "),
        ("<C-u>set<space>D3<tab>", "typed set D3="),
        ("<tab>", "typed set D3=0 "),
        ("<tab>", "typed set D3=0 D="),
        ("<C-u>layer<space>zz<tab>", "refused nothing to complete here"),
        ("<C-u>layer<space>fi<space>on<left*3><tab>", "typed layer field on"),
    ]);
}

#[test]
fn every_line_completes_its_words_to_ones_that_it_accepts() {
    for line in crate::session::Keymap::default().lines() {
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
    trial.goes(&[(": set D=-0.2", ""), (": toggle-field", ""), (": set D=-0.2", "")]);
    assert_eq!(trial.session.lines, ["toggle-field", "set D=-0.2"]);
    trial.goes(&[
        (":un<up>", "typed set D=-0.2"),
        ("<up*5>", "typed toggle-field"),
        ("<down*5>", "typed un"),
        ("<up><enter>", "open none"),
        // An empty line has no effect.
        (":<enter>:<space><enter>", "D -0.2 | open none"),
    ]);
    assert_eq!(trial.session.lines, ["toggle-field", "set D=-0.2"]);
}

#[test]
fn the_palette_finds_what_has_all_the_words() {
    let mut trial = Trial::open("plain");
    trial.press("<space>mark<space>go");
    let list = open_list(&trial.session).expect("the palette");
    let rows = trial.session.palette_rows(list);
    let names: Vec<_> = rows.iter().map(|row| row.name()).collect();
    assert_eq!(names[0], "go-to-mark");
    assert!(!names.contains(&"set-mark"), "{names:?}");
}

#[test]
fn a_picker_lists_first_what_is_called_so() {
    for (search, view) in [("damping", View::Damping), ("phase", View::Phase)] {
        let list = List { search: search.to_owned(), ..List::default() };
        let rows = Trial::open("energy").session.view_rows(&list);
        assert_eq!(rows[0].view, view, "{search}");
    }
    let mut trial = Trial::open("plain");
    trial.press("s/escape<enter>");
    assert_eq!(trial.session.scene.name, "escape");
}

/// The headings and names that the palette finds for some words.
fn found(words: &str) -> Vec<(&'static str, &'static str)> {
    let trial = Trial::open("plain");
    let list = crate::session::List { search: words.to_owned(), ..Default::default() };
    let rows = trial.session.palette_rows(&list);
    rows.iter().map(|row| (trial.session.heading(*row), row.name())).collect()
}

#[test]
fn every_other_word_is_of_something_that_is_listed() {
    for name in crate::session::read::lists::SYNONYMS.keys() {
        assert!(found(name).iter().any(|(_, found)| found == name), "{name}");
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
    trial.goes(&[
        ("<space>eigenvalues<enter>", "focus 0 eigenvalues"),
        ("<space>lyapunov<enter>", "+lyapunov | focus 0 phase"),
    ]);
    trial.goes(&[
        ("<space>fig16b<enter>", "scene supercritical"),
        // From groups, by any of their names.
        ("s<enter>", "scene supercritical"),
        ("s/fig16a<enter>", "scene marginal"),
        (": scene fig07", "scene linear"),
        ("s<end><enter>", ""),
    ]);
    assert!(trial.session.scene.machine.is_some());
    trial.goes(&[(": scene plain", ""), ("<space>clutch<enter>", "")]);
    assert!(trial.session.scene.machine.is_some(), "{}", trial.notice());
}

#[test]
fn words_that_are_no_command_are_looked_for_in_the_list_of_everything() {
    let mut trial = Trial::open("supercritical");
    trial.goes(&[(": animate", "open Palette")]);
    let list = open_list(&trial.session);
    assert_eq!(list.unwrap().search, "animate");
    trial.goes(&[("<enter>", "open none")]);
    assert!(trial.session.playback.playing, "{}", trial.notice());
    trial.goes(&[(": fig 16", "open Palette")]);
}

#[test]
fn a_key_of_another_plot_on_show_goes_there() {
    let mut trial = Trial::open("plain");
    trial.goes(&[("<tab> N", "focus 1 diagram")]);
    assert_ne!(trial.session.focused().map(|plot| plot.axes.unit), Some(crate::scene::Unit::One));
    Trial::open("energy").goes(&[("S", "notice ..needs the scan..")]);
}

#[test]
fn short_names_of_other_programs_are_known() {
    Trial::open("plain").goes(&[
        (": w", "refused write needs FILE.."),
        ("<esc>", "open none"),
        (": set tol=1e-8", "tolerance 1e-8"),
        (": q", "quit true"),
    ]);
}

/// What keys in a scene copy, or else what is said.
fn copied(scene: &str, keys: &str) -> String {
    let mut trial = Trial::open(scene);
    trial.press(keys);
    match trial.effects.last() {
        Some(Effect::Copy(text)) => text.clone(),
        _ => trial.notice().to_owned(),
    }
}

#[test]
fn numbers_points_and_rows_are_copied() {
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

#[test]
fn the_copied_command_of_a_machine_asks_about_the_machine() {
    let bstab = "hopfscope trajectory --machine bstab";
    let start = "--set x=1.4 --set v=0 --until 120 --method auto --tol 1e-10";
    assert_eq!(copied("benchmark", "<C-y>"), format!("{bstab} {start}"));
    let set = format!("{bstab} --set R=2 {start}");
    assert_eq!(copied("benchmark", ":set<space>R=2<space>N<enter><C-y>"), set);
    let diagram = "hopfscope branch --machine textbook --over v0=0.05:0.5:200";
    assert_eq!(copied("slow-belt", "<tab><tab><tab><tab><C-y>"), diagram);
    // A machine of a file has no name that says all, even if its file is named like one of the program: it is told by
    // the equation.
    let mut trial = Trial::open("benchmark");
    let scaled = Arc::make_mut(&mut trial.session.scene).machine.as_mut().unwrap();
    scaled.machine.belt.law = FrictionLaw::Constant { mu: 0.3 };
    trial.press(":set<space>R=2<space>N<enter><C-y>");
    let Some(Effect::Copy(text)) = trial.effects.last() else { panic!("nothing copied") };
    assert!(text.starts_with("hopfscope trajectory --set D="), "{text}");
}
