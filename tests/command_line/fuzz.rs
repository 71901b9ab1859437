//! Everything read from outside - scene files, settings, machines, tables, keystroke files, pasted text,
//! command lines, options - is either understood or refused in one line. Nothing panics, nothing hangs.
//!
//! The inputs are the program's own files with a few bytes changed, pieces of them in a wrong order, and
//! unrelated text. Seeds are fixed, so every run reads the same.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use hopfscope::scene::{file, library, machine, plain};
use hopfscope::session::read::completion::completion;
use hopfscope::session::{Keymap, Msg, Session, Size, config, replay, run_line, update};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// A message for people: one line, not empty, without terminal control characters.
fn assert_one_line(message: &str, input: &str) {
    assert!(!message.trim().is_empty(), "an empty refusal of {input:?}");
    assert!(!message.chars().any(char::is_control), "{message:?} refuses {input:?}");
}

/// The texts of all files with this extension in a folder of the project.
fn files(folder: &str, extension: &str) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|it| it.unwrap().path()).collect();
    paths.sort();
    paths.retain(|path| path.extension().is_some_and(|it| it == extension));
    paths.iter().map(|path| fs::read_to_string(path).unwrap()).collect()
}

/// Text fragments likely to cause trouble.
const SPLINTERS: [&str; 36] = [
    "",
    "\0",
    "\u{1b}[2J",
    "\u{feff}",
    "\r",
    "\n",
    "\t",
    " ",
    "'",
    "\"",
    "\"\"\"",
    "[",
    "]",
    "[[",
    "{",
    "}",
    "=",
    "<",
    ">",
    "<<",
    "#",
    ",",
    ":",
    "-",
    "nan",
    "inf",
    "-inf",
    "1e400",
    "-0.0",
    "5e-324",
    "99999999999999999999",
    "0x",
    "\u{202e}",
    "e\u{301}",
    "\u{1f41f}",
    "<wait*100000>",
];

/// One change of a text: the place, the number of characters replaced, and the replacement.
type Change = (prop::sample::Index, usize, prop::sample::Index);

fn changes() -> impl Strategy<Value = Vec<Change>> {
    let change = (any::<prop::sample::Index>(), 0..6_usize, any::<prop::sample::Index>());
    prop::collection::vec(change, 1..6)
}

/// The text with these changes; each replacement is a splinter or a later piece of the text.
fn changed(text: &str, changes: &[Change]) -> String {
    let mut letters: Vec<char> = text.chars().collect();
    for (place, length, what) in changes {
        let at = place.index(letters.len() + 1);
        let end = (at + length).min(letters.len());
        let choice = what.index(SPLINTERS.len() + 8);
        let piece: Vec<char> = match SPLINTERS.get(choice) {
            Some(splinter) => splinter.chars().collect(),
            None => letters[end..].iter().take(1 << (choice - SPLINTERS.len())).copied().collect(),
        };
        letters.splice(at..end, piece);
    }
    letters.into_iter().collect()
}

/// Passes each of the texts with changes, and arbitrary texts, to `read`.
fn fuzz(texts: &[String], cases: u32, read: impl Fn(&str)) {
    let config =
        Config { cases, max_shrink_iters: 64, failure_persistence: None, ..Config::default() };
    let seed = [7; 32];
    let random = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
    let mut runner = TestRunner::new_with_rng(config, random);
    let from_text = (any::<prop::sample::Index>(), changes())
        .prop_map(|(which, changes)| changed(which.get::<String>(texts), &changes));
    let inputs = prop_oneof![8 => from_text, 1 => any::<String>(), 1 => "[ -~\n]{0,200}"];
    runner
        .run(&inputs, |input| {
            read(&input);
            Ok(())
        })
        .unwrap();
}

#[test]
fn scene_files() {
    fuzz(&files("assets/scenes", "toml"), 3_000, |text| {
        if let Err(refused) = file::parse("fuzzed", "fuzzed.toml", text) {
            assert_one_line(&refused.to_string(), text);
        }
    });
}

#[test]
fn settings_files() {
    let settings = "scene = \"hopf\"\nglyphs = \"ascii\"\ncolor = \"256\"\ntheme = \"light\"\nmouse = true\n\n\
                    [keys.parameters]\nstep-up = [\"<right>\", \"l\", \"+\"]\n[keys.everywhere]\nquit = [\"q\"]\n";
    fuzz(&[settings.to_owned()], 3_000, |text| {
        if let Err(refused) = config::parse("settings.toml", text) {
            assert_one_line(&refused.to_string(), text);
        }
    });
}

#[test]
fn tables_of_friction() {
    fuzz(&files("assets/belts", "csv"), 2_000, |text| {
        if let Err(refused) = machine::table::table("fuzzed.csv", text) {
            assert_one_line(&refused, text);
        }
    });
}

#[test]
fn quantities_with_units() {
    let texts = ["12.5 mm/s", "-3e-4 N", "1 kg", "0.1", "7 rad/s"].map(str::to_owned);
    fuzz(&texts, 2_000, |text| {
        if let Err(refused) = hopfscope::model::unit::measured(text) {
            assert_one_line(&refused, text);
        }
    });
}

#[test]
fn keystroke_files() {
    fuzz(&files("assets/replays", "keys"), 3_000, |text| {
        if let Err(refused) = replay::parse(text) {
            assert_one_line(&refused.to_string(), text);
        }
    });
}

fn session() -> Session {
    Session::new(plain(), Size { width: 100, height: 30 })
}

#[test]
fn lines_of_commands() {
    let mut texts: Vec<String> = Keymap::default().lines().map(|it| it.name.to_owned()).collect();
    texts.extend(
        [
            "set D -0.3",
            "scene hopf",
            "layer basin on",
            "window -1 1",
            "axes D q_max",
            "theme light",
        ]
        .map(str::to_owned),
    );
    fuzz(&texts, 2_000, |text| {
        let mut session = session();
        let _ = completion(&session, text);
        if let Err(refused) = run_line(&mut session, text) {
            assert_one_line(&refused, text);
        }
    });
}

#[test]
fn pasted_text_wherever_text_can_be_typed() {
    let texts = ["-0.125", "set D=0.5", "1e-300", "a\nb\nc"].map(str::to_owned);
    let places = ["", "<enter>", ":", "?", "=", "/"].map(|keys| replay::parse(keys).unwrap());
    fuzz(&texts, 1_000, |text| {
        for place in &places {
            let mut session = session();
            for step in &place.steps {
                if let replay::Instruction::Key { key, .. } = step.step {
                    update(&mut session, Msg::Key(key));
                }
            }
            update(&mut session, Msg::Paste(text.to_owned()));
            assert!(session.problem.parameters.d.is_finite());
        }
    });
}

/// Options come from a shell, so they contain no null character.
#[test]
fn values_of_options() {
    let commands: [&[&str]; 6] = [
        &["trajectory", "--until", "1", "--set"],
        &["trajectory", "--until"],
        &["basin", "--grid", "2x2", "--window"],
        &["branch", "--over"],
        &["replay", "--size"],
        &["cycles", "--harmonics"],
    ];
    let values = ["D=-0.3", "1e3", "-1:1,-1:1", "D=-0.5:-0.1:3", "80x24", "3"].map(str::to_owned);
    let config =
        Config { cases: 60, max_shrink_iters: 16, failure_persistence: None, ..Config::default() };
    let random = TestRng::from_seed(RngAlgorithm::ChaCha, &[9; 32]);
    let mut runner = TestRunner::new_with_rng(config, random);
    let inputs = (0..commands.len(), changes());
    runner
        .run(&inputs, |(which, changes)| {
            let value = changed(&values[which], &changes).replace('\0', "0");
            let output = Command::new(env!("CARGO_BIN_EXE_hopfscope"))
                .args(commands[which])
                .arg(&value)
                .stdin(Stdio::null())
                .output()
                .unwrap();
            let code = output.status.code();
            assert!(matches!(code, Some(0..=2)), "{:?} {value:?}: {code:?}", commands[which]);
            let said = String::from_utf8(output.stderr).unwrap();
            if code == Some(2) {
                assert_one_line(said.trim_end_matches('\n'), &value);
            }
            Ok(())
        })
        .unwrap();
}

#[test]
fn the_files_that_are_changed_are_understood_unchanged() {
    for text in files("assets/scenes", "toml") {
        file::parse("whole", "whole.toml", &text).unwrap();
    }
    for text in files("assets/replays", "keys") {
        replay::parse(&text).unwrap();
    }
    for text in files("assets/belts", "csv") {
        machine::table::table("whole.csv", &text).unwrap();
    }
    assert!(library().len() > 5);
}
