//! Keys and names of commands: as the table has them, as a settings file changes them, and as the palette finds them.

use std::collections::{BTreeMap, BTreeSet};

use hopfscope::scene::{VIEWS, plain};
use hopfscope::session::config::{Config, parse};
use hopfscope::session::settings::{Colors, Glyphs, Theme};
use hopfscope::session::state::keymap::{CONTEXTS, ContextSpec};
use hopfscope::session::{Command, Context, Key, Keymap, PaletteRow, Session, Size, commands};

fn key(text: &str) -> Key {
    text.parse().unwrap()
}

fn meaning(config: &Config, context: Context, text: &str) -> Option<&'static str> {
    config.keymap.command(&[context], key(text)).map(|command| command.name)
}

#[test]
fn an_empty_file_changes_nothing() {
    assert_eq!(parse("config.toml", "").unwrap(), Config::default());
}

#[test]
fn looks_and_keys_are_what_the_file_says() {
    let text = "theme = \"light\"\nglyphs = \"block\"\ncolor = \"256\"\nscene = \"hopf\"\n\
                mouse = true\n[keys.parameters]\nstep-up = [\"l\", \"<A-l>\"]\nstep-down = []\n";
    let config = parse("config.toml", text).unwrap();
    assert_eq!(config.theme, Some(Theme::Light));
    assert_eq!((config.glyphs, config.colors), (Some(Glyphs::Block), Some(Colors::Indexed)));
    assert_eq!((config.scene.as_deref(), config.mouse), (Some("hopf"), true));
    assert_eq!(meaning(&config, Context::Parameters, "<A-l>"), Some("step-up"));
    assert_eq!(meaning(&config, Context::Parameters, "<right>"), None);
    assert_eq!(meaning(&config, Context::Parameters, "h"), None);
    // The file does not change its keys in plots.
    assert_eq!(meaning(&config, Context::Plots, "<gt>"), Some("step-up"));
}

#[test]
fn keys_of_everywhere_hold_on_a_walk_too_unless_it_has_its_own() {
    let text =
        "[keys.everywhere]\nquit = [\"<C-q>\"]\nundo = [\"<A-u>\"]\n[keys.walk]\nundo = [\"u\"]\n";
    let config = parse("config.toml", text).unwrap();
    assert_eq!(meaning(&config, Context::Walk, "<C-q>"), Some("quit"));
    assert_eq!(meaning(&config, Context::Walk, "q"), None);
    assert_eq!(meaning(&config, Context::Walk, "u"), Some("undo"));
    assert_eq!(meaning(&config, Context::Walk, "<A-u>"), None);
}

#[test]
fn two_commands_can_swap_their_keys() {
    let text = "[keys.parameters]\nstep-up = [\"h\"]\nstep-down = [\"l\"]\n";
    let config = parse("config.toml", text).unwrap();
    assert_eq!(meaning(&config, Context::Parameters, "h"), Some("step-up"));
    assert_eq!(meaning(&config, Context::Parameters, "l"), Some("step-down"));
}

#[test]
fn keys_of_a_form_that_is_gone_are_passed_over() {
    // Some of these commands are gone with the form, others apply elsewhere still.
    let gone = "[keys.form]\nstart-scan = [\"<C-s>\"]\nnext-field = []\nback = []\n";
    assert_eq!(parse("config.toml", gone).unwrap(), Config::default());
    let text = gone.to_owned() + "[keys.everywhere]\nscan-form = [\"<A-j>\"]\n";
    let config = parse("config.toml", &text).unwrap();
    assert_eq!(meaning(&config, Context::Everywhere, "<A-j>"), Some("scan"));
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    for (text, said) in [
        ("theme = \"blue\"", "1:9: no \"blue\"; there are auto, light, dark, contrast, mono"),
        ("themes = 1", "1:1: unknown field `themes`"),
        ("scene = \"hoff\"", "1:9: no scene \"hoff\"; did you mean hopf?"),
        ("[keys.everwhere]", "1:7: no context \"everwhere\"; did you mean everywhere?"),
        ("[keys.parameters]\nstep-upp = []", "2:1: no command \"step-upp\"; did you mean step-up?"),
        ("[keys.walk]\nstep-up = []", "2:1: step-up applies in parameters, plots"),
        ("[keys.parameters]\nstep-up = [\"<rigth>\"]", "2:12: unknown key <rigth>"),
        ("[keys.parameters]\nstep-up = [\"k\"]", "2:12: k already means select-previous"),
        ("[keys.parameters]\nstep-up = [\"q\"]", "2:12: q already means quit"),
        ("[keys.everywhere]\nquit = []", "2:8: quit needs a key here"),
        ("[keys.entry]\naccept = [\"y\"]", "2:11: y types a character here"),
        ("[keys", "1:"),
    ] {
        let error = parse("config.toml", text).unwrap_err().to_string();
        assert!(error.starts_with(&format!("config.toml:{said}")), "{text}: {error}");
        assert!(!error.contains('\n'));
    }
}

#[test]
fn every_default_key_can_be_said_in_a_file() {
    use std::fmt::Write;
    let mut text = String::new();
    for &ContextSpec { context, name, .. } in CONTEXTS.iter() {
        writeln!(text, "[keys.{name}]").unwrap();
        for command in commands() {
            if let Some((_, keys)) = command.keys.iter().find(|(at, _)| *at == context) {
                let keys: Vec<_> = keys.iter().map(ToString::to_string).collect();
                writeln!(text, "{} = {keys:?}", command.name).unwrap();
            }
        }
    }
    let config = parse("config.toml", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let usual = Keymap::default();
    for command in commands() {
        assert_eq!(config.keymap.places(command), usual.places(command), "{}", command.name);
    }
}

#[test]
fn sentences_of_scenes_name_commands_and_follow_the_keys() {
    let config = parse("config.toml", "[keys.everywhere]\nundo = [\"<A-u>\"]").unwrap();
    let written = |text: &str| config.keymap.fill(text, |key| key.to_string());
    assert_eq!(written("{undo} or {step-up}, {no"), "<A-u> or <right>, {no");
    for scene in hopfscope::scene::library() {
        for text in [&scene.watch, &scene.press] {
            for name in text.split('{').skip(1).map(|rest| rest.split('}').next().unwrap()) {
                let known = commands().any(|command| command.name == name);
                assert!(known, "{}: no command {name}", scene.name);
            }
        }
    }
}

#[test]
fn keys_are_written_as_people_write_them() {
    for text in [
        "a",
        "Z",
        "?",
        "[",
        "é",
        "<space>",
        "<lt>",
        "<hash>",
        "<C-r>",
        "<S-tab>",
        "<A-left>",
        "<C-A-S-f12>",
        "<pgup>",
        "<esc>",
        "<C-space>",
        "<C-lt>",
        "<C-->",
        "<A-*>",
    ] {
        let key: Key = text.parse().unwrap();
        assert_eq!(key.to_string(), text);
    }
}

#[test]
fn other_names_mean_the_same_key() {
    for (text, canonical) in [
        ("<CR>", "<enter>"),
        ("<Esc>", "<esc>"),
        ("<c-R>", "<C-r>"),
        ("<a>", "a"),
        ("<S-A>", "A"),
        ("<bs>", "<backspace>"),
        (">", "<gt>"),
        ("<u+20>", "<space>"),
    ] {
        assert_eq!(text.parse::<Key>().unwrap().to_string(), canonical);
    }
}

#[test]
fn what_is_no_key_is_said_with_the_nearest_name() {
    for (text, line) in [
        ("<rigth>", "unknown key <rigth>; did you mean <right>?"),
        ("<C-pgpu>", "unknown key <C-pgpu>; did you mean <pgup>?"),
        ("<f13>", "unknown key <f13>; a key is a character"),
        ("<>", "unknown key <>;"),
        ("<", "unknown key <<>;"),
        ("ab", "unknown key <ab>;"),
        ("", "unknown key <>;"),
    ] {
        let said = text.parse::<Key>().unwrap_err();
        assert!(said.starts_with(line), "{said}");
    }
}

/// Every default key with its context and command.
fn bindings() -> impl Iterator<Item = (Context, Key, &'static str)> {
    commands().flat_map(|command| {
        command.keys.iter().flat_map(move |(context, keys)| {
            keys.iter().map(move |key| (*context, *key, command.name))
        })
    })
}

#[test]
fn no_key_means_two_things_where_contexts_hold_together() {
    for chain in CONTEXTS.iter().map(|row| &row.chain) {
        let mut meanings = BTreeMap::new();
        for (_, key, name) in bindings().filter(|(context, ..)| chain.contains(context)) {
            if let Some(other) = meanings.insert(key, name) {
                panic!("{key} means {other} and {name} in {chain:?}");
            }
        }
    }
}

#[test]
fn every_command_has_a_name_of_its_own_a_key_and_one_line_of_explanation() {
    let names: BTreeSet<_> = commands().map(|command| command.name).collect();
    assert_eq!(names.len(), commands().count());
    for Command { name, keys, doc, .. } in commands() {
        let of_layer = name.starts_with("toggle-");
        assert!(of_layer || keys.iter().any(|(_, keys)| !keys.is_empty()), "{name} has no key");
        assert!(doc.len() > 4 && doc.len() <= 72, "{name}: {doc}");
        assert!(doc.starts_with(char::is_uppercase) && !doc.ends_with('.'), "{name}: {doc}");
    }
}

#[test]
fn an_arrow_key_that_arrives_in_pieces_destroys_nothing() {
    // Over a slow line, <up> can arrive as <esc>, [, A; application mode sends O instead of [.
    for (context, key, name) in bindings() {
        let piece = key.typed().is_some_and(|char| "OABCD".contains(char));
        // The line of this one is left by the escape of the next key.
        let opens_a_line = name == "type-parameter";
        assert!(!piece || opens_a_line, "{name} is bound to {key} in {context:?}");
    }
    for (_, key, name) in bindings() {
        if key.typed() == Some('[') {
            assert_eq!(name, "step-size-smaller");
        }
        if key.to_string() == "<esc>" {
            assert!(
                [
                    "back",
                    "drop-cursor",
                    "search-drop",
                    "walk-let-go",
                    "kick-let-go",
                    "forget-pending"
                ]
                .contains(&name),
                "{name}"
            );
        }
    }
}

/// Commands with the same meaning in different panes: directions, and what is drawn along an axis.
const ALIKE: [&[&str]; 9] = [
    &["step-down", "walk-back", "scan-back", "cursor-left", "kick-smaller"],
    &["step-up", "walk-on", "scan-on", "cursor-right", "kick-larger"],
    &["select-next", "walk-back", "scan-down", "cursor-down", "kick-far-smaller"],
    &["select-previous", "walk-on", "scan-up", "cursor-up", "kick-far-larger"],
    &["step-far-down", "walk-far-back", "scan-far-back", "pan-left", "kick-far-smaller"],
    &["step-far-up", "walk-far-on", "scan-far-on", "pan-right", "kick-far-larger"],
    &["next-abscissa", "next-chart-right"],
    &["next-ordinate", "next-chart-up", "scan-column"],
    &["walk", "walk-let-go"],
];

#[test]
fn no_letter_means_two_things_outside_of_lists_and_forms() {
    let mut meanings: BTreeMap<char, BTreeSet<&str>> = BTreeMap::new();
    for (context, key, name) in bindings() {
        let letter = key.typed().filter(char::is_ascii_alphabetic);
        if let Some(letter) = letter.filter(|_| !context.is_overlay()) {
            meanings.entry(letter).or_default().insert(name);
        }
    }
    assert!(meanings.len() > 30, "{meanings:?}");
    // In the table of a scan nothing is kicked: there t is what it was before there were kicks.
    let both: BTreeSet<_> = ["scan-table", "try-kick"].into();
    assert_eq!(meanings.remove(&'t'), Some(both));
    meanings.retain(|_, names| {
        names.len() > 1 && !ALIKE.iter().any(|alike| names.iter().all(|it| alike.contains(it)))
    });
    assert!(meanings.is_empty(), "{meanings:?}");
}

/// The headings and names that the palette finds for some words.
fn found(words: &str) -> Vec<(&'static str, &'static str)> {
    let session = Session::new(plain(), Size { width: 80, height: 24 });
    let list = hopfscope::session::List { search: words.to_owned(), ..Default::default() };
    let rows = session.palette_rows(&list);
    rows.iter().map(|row| (session.heading(*row), row.name())).collect()
}

/// Words that a person may type, and the row that is meant.
#[rustfmt::skip]
const MEANT: [(&str, &str); 59] = [
    ("fold", "walk-to-next"), ("export", "save-figure"), ("stable", "cycles"), ("animate", "play-motion"),
    ("fig 16", "fig16"), ("fig16b", "supercritical"), ("time series", "time-series"), ("damping", "damper"),
    ("save", "write"), ("zoom", "zoom-in"), ("undo", "undo"), ("amplitude", "diagram"), ("basin", "basin"),
    ("hopf", "hopf"), ("period", "axes"), ("quit", "quit"), ("exit", "quit"), ("copy", "copy-number"),
    ("theme", "theme"), ("help", "help"), ("keys", "help"), ("color", "color"), ("bifurcation", "diagram"),
    ("phase plane", "phase"), ("friction", "friction"), ("sweep", "scan"), ("scan", "scan"),
    ("kick", "try-kick"), ("tolerance", "tol"), ("method", "next-method"), ("mouse", "mouse"),
    ("record", "record"), ("mark", "set-mark"), ("import", "fit"), ("load", "open"),
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
    for (key, name) in [("i", "start-inside"), ("%", "scan"), ("W", "add-plot")] {
        assert_eq!(found(key)[0].1, name, "{key}");
    }
}

#[test]
fn every_command_is_reached_from_the_palette_without_a_key_of_its_own() {
    let session = Session::new(plain(), Size { width: 80, height: 24 });
    let list = hopfscope::session::List::default();
    let rows = session.palette_rows(&list);
    let listed: Vec<_> = rows.iter().map(|row| row.name()).collect();
    for command in commands() {
        let inside = command.keys.iter().all(|(context, _)| context.is_overlay());
        let name = command.name.strip_prefix("toggle-").unwrap_or(command.name);
        // A digit cannot be typed in a list.
        let typed = command.keys.iter().any(|(_, keys)| keys.contains(&key("1")));
        let is_it = |it: &(&str, &str)| [name, command.name].contains(&it.1);
        assert!(inside || found(name).iter().any(is_it) != typed, "{name}");
    }
    // A line without a row of its own has one beside it that does the same.
    for line in Keymap::default().lines() {
        let beside = if line.hint.is_empty() { line.name } else { line.hint };
        assert!(listed.contains(&beside), "{}", line.name);
        let commands = rows.iter().filter(|row| matches!(row, PaletteRow::Command(_)));
        assert!(commands.filter(|row| row.name() == beside).count() <= 1, "{beside}");
    }
}

#[test]
fn every_line_has_a_name_of_its_own_and_one_line_of_explanation() {
    let names: BTreeSet<_> = Keymap::default().lines().map(|line| line.name).collect();
    assert_eq!(names.len(), Keymap::default().lines().count());
    for Command { name, arguments, doc, .. } in Keymap::default().lines() {
        assert!(!arguments.is_empty(), "{name} takes nothing: it is a row of COMMANDS");
        assert!(doc.len() > 4 && doc.len() <= 60, "{name}: {doc}");
        assert!(doc.starts_with(char::is_uppercase) && !doc.ends_with('.'), "{name}: {doc}");
    }
}

#[test]
fn a_name_may_mean_a_key_too_only_where_the_key_opens_its_line_or_takes_the_next_of_the_same() {
    let is_key = |name: &&str| commands().any(|command| command.name == *name);
    let both: Vec<_> = Keymap::default().lines().map(|line| line.name).filter(is_key).collect();
    assert_eq!(both, ["scan", "theme", "units", "equal", "glyphs"]);
}

#[test]
fn every_context_has_a_name_of_its_own() {
    let names: BTreeSet<_> = CONTEXTS.iter().map(|row| row.name).collect();
    // Every line of the file is read, and all contexts that it names.
    assert_eq!((CONTEXTS.len(), names.len()), (VIEWS.len() + 22, VIEWS.len() + 22));
    let most_specific = CONTEXTS.iter().filter(|row| row.chain.len() > 1).count();
    assert_eq!(most_specific, CONTEXTS.len() - 4);
    assert!(VIEWS.iter().all(|row| names.contains(row.name)), "{names:?}");
}
