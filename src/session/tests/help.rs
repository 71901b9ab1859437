//! The page of help, and what the list of everything leaves out.

use std::sync::Arc;

use super::{Trial, open_list};
use crate::numerics::cells;
use crate::session::config::parse;
use crate::session::{CONTEXTS, Context, Key, List, PaletteRow, Session, commands};

#[test]
fn help_is_a_page_from_which_its_keys_work() {
    Trial::open("supercritical").goes(&[
        ("?", "open help"),
        ("<esc>", "open none"),
        ("? q", "open none | quit false"),
        ("? <right>", "open none | D -0.29"),
        ("? <left> <tab> ? 3<gt>", "open none | D -0.27 | pending none"),
        ("<S-tab>", ""),
        ("? ?", "open Palette"),
        ("?", "open none"),
        ("? <pgdn> G <esc>", "open none"),
        // What is open below the page keeps its keys, and comes back.
        ("s <home> ? <esc>", "open Scenes | list 0"),
        ("? j", "open Scenes | list 1"),
        ("<esc>", "open none"),
        ("<tab*2> w <home> ? <tab>", "open none | special Fold"),
        ("? <space> undo", "open Palette"),
    ]);
}

#[test]
fn every_line_of_the_page_names_keys_that_there_are() {
    let lines = include_str!("../../../assets/help.txt").lines().filter_map(cells);
    let mut count = 0;
    for [context, names, text] in lines {
        let context = Context::named(context).unwrap_or_else(|| panic!("no context {context}"));
        assert!(text.len() < 120 && (names == "-" || text.len() < 62), "{text}");
        for name in names.split(' ').filter(|name| *name != "-") {
            let command = commands().find(|command| command.name == name);
            let command = command.unwrap_or_else(|| panic!("no command {name}"));
            let chains = CONTEXTS.iter().map(|row| &row.chain);
            let held = |chain: &&Vec<Context>| {
                chain.contains(&context)
                    && chain.iter().any(|at| command.contexts().any(|it| it == *at))
            };
            assert!(chains.clone().any(|chain| held(&chain)), "{name} has no key in {context:?}");
        }
        count += 1;
    }
    assert!(count > 60, "{count}");
}

#[test]
fn every_pane_and_list_has_a_page_of_three_to_ten_lines() {
    let session = Trial::open("plain").session;
    let text = |context: &Context| {
        context.takes_text()
            || matches!(context, Context::Count | Context::Letter | Context::Offer | Context::Page)
    };
    let pages = CONTEXTS.iter().filter(|row| row.chain.len() > 1 && !text(&row.context));
    for row in pages {
        let keys = session.help_rows(&row.chain);
        assert!((3..=10).contains(&keys.len()), "{:?}: {}", row.context, keys.len());
        let about = session.help_about(&row.chain);
        assert!(about.len() > 20 || row.name == "help", "{:?}: {about:?}", row.context);
    }
}

#[test]
fn the_page_names_the_keys_that_the_user_has() {
    let config = parse("config.toml", "[keys.parameters]\nstep-up = [\"<A-l>\"]\n").unwrap();
    let mut trial = Trial::open("plain");
    trial.session.keymap = Arc::new(config.keymap);
    let rows = trial.session.help_rows(trial.session.contexts());
    let step = rows.iter().find(|row| row.text.contains("by a step")).expect("the steps");
    let keys: Vec<String> = step.keys.iter().map(Key::to_string).collect();
    assert_eq!(keys, ["<left>", "<A-l>"]);
}

/// The names of the rows that the open list shows.
fn listed(session: &Session) -> Vec<&'static str> {
    let list = open_list(session).expect("a list");
    session.palette_rows(list).iter().map(|row| row.name()).collect()
}

#[test]
fn what_cannot_be_run_is_not_listed_and_found_last_with_the_reason() {
    let mut trial = Trial::open("plain");
    trial.press("? ?");
    let names = listed(&trial.session);
    for name in ["undo", "walk-on", "scan-table", "drop-motion", "speeds", "restore"] {
        assert!(!names.contains(&name), "{name} would be refused");
    }
    assert!(names.contains(&"walk") && names.contains(&"remove-plot"));
    trial.press("/walk");
    let names = listed(&trial.session);
    assert_eq!(names[0], "walk");
    let last = *names.last().unwrap();
    let list = open_list(&trial.session).unwrap();
    let rows = trial.session.palette_rows(list);
    let row = rows.last().unwrap();
    assert_eq!(trial.session.heading_in(list, *row), "Not now", "{last}");
    assert!(trial.session.refused(list, *row).unwrap().contains("needs a branch"));
    // Once a branch is held it can be walked along.
    trial.press("<esc*2> <tab*2> w ? ?");
    let names = listed(&trial.session);
    assert!(names.contains(&"walk-on") && names.contains(&"walk-let-go"), "{names:?}");
}

#[test]
fn of_rows_that_match_alike_the_one_used_last_comes_first() {
    let first = |trial: &Trial| {
        let list = List { search: "zoom".to_owned(), ..List::default() };
        trial.session.palette_rows(&list)[0].name()
    };
    let mut trial = Trial::open("plain");
    assert_eq!(first(&trial), "zoom-in");
    trial.press("<tab> -");
    assert_eq!(first(&trial), "zoom-out");
    trial.press("+");
    assert_eq!(first(&trial), "zoom-in");
}

#[test]
fn one_thing_has_one_row() {
    for scene in ["plain", "groan"] {
        let mut trial = Trial::open(scene);
        trial.press("? ?");
        let rows = trial.session.palette_rows(open_list(&trial.session).unwrap());
        // A scene, a view and a layer may have one name: they are not the same.
        let things = ["Scenes", "Machines"].map(|kind| {
            let of_kind = |row: &&PaletteRow| trial.session.heading(**row) == kind;
            rows.iter().filter(of_kind).map(|row| row.name()).collect::<Vec<_>>()
        });
        let commands = rows.iter().filter(|row| matches!(row, PaletteRow::Command(_)));
        for mut names in [things.concat(), commands.map(|row| row.name()).collect()] {
            assert!(names.len() > 30, "{names:?}");
            names.sort_unstable();
            let twice: Vec<_> = names.windows(2).filter(|pair| pair[0] == pair[1]).collect();
            assert!(twice.is_empty(), "{twice:?}");
        }
    }
}

#[test]
fn a_layer_is_shown_with_its_view() {
    Trial::open("plain").goes(&[
        ("<tab> <space> lyapunov<enter>", "+lyapunov | focus 0 phase"),
        ("<space> boundaries<enter>", "+boundaries | focus 0 regimes"),
        ("u", "focus 0 phase"),
    ]);
}

#[test]
fn the_selected_scene_is_shown_beside_the_list_and_opens_from_its_answers() {
    let mut trial = Trial::open("plain");
    trial.press("s <home> <down*2>");
    assert_eq!(trial.session.preview, None, "no room");
    trial.press("<esc> <resize 120x40> s <home> <down*2>");
    let preview = trial.session.preview.as_deref().expect("the scene");
    assert_eq!(preview.scene.name, "capture");
    assert!(preview.trajectory().is_some() && !preview.is_busy());
    let (depth, scene) = (trial.session.history.depth(), trial.session.scene.name.clone());
    assert_eq!((depth, scene.as_str()), ((0, 0), "plain"));
    assert_eq!(trial.press("<enter>"), [], "all is known");
    assert_eq!((trial.session.scene.name.as_str(), &trial.session.preview), ("capture", &None));
}
