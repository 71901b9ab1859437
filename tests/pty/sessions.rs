//! Sessions in a real terminal: kept when interrupted, offered at the next start, written and opened, and the
//! first line that a new user sees.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::support::{Answers, PROGRAM, QUIET, Terminal, all_at_once};
use rustix::process::Signal;

/// The explorer, with its own folder for kept sessions, once its first picture is complete.
fn explorer(arguments: &[&str], memory: &Path) -> Terminal {
    let mut terminal = begun(arguments, memory);
    terminal.quiet(QUIET);
    terminal
}

/// The explorer as soon as it shows any picture.
fn begun(arguments: &[&str], memory: &Path) -> Terminal {
    let state = memory.to_str().unwrap();
    let environment = [("XDG_STATE_HOME", state), ("XDG_CONFIG_HOME", state)];
    Terminal::explorer(arguments, &environment, (100, 30))
}

/// The sessions kept in a folder.
fn kept(memory: &Path) -> Vec<PathBuf> {
    let folder = fs::read_dir(memory.join("hopfscope")).unwrap();
    let paths = folder.map(|entry| entry.unwrap().path());
    paths.filter(|path| path.to_str().unwrap().contains("interrupted-")).collect()
}

#[test]
fn the_first_start_plays_a_motion_and_what_was_kept_or_asked_for_comes_before_it() {
    let memory = tempfile::tempdir().unwrap();
    let mut terminal = begun(&[], memory.path());
    terminal.wait_for("Does it come to rest?");
    terminal.wait_for("playing");
    // A key is heard while it plays.
    terminal.types("\r");
    terminal.wait_for("arrows change the numbers; ? keys, space commands");
    terminal.wait_for("The plain oscillator");
    terminal.types("\x1b[C");
    terminal.wait_for("-0.09");
    terminal.leave();
    // The session that was left is kept.
    let mut terminal = begun(&[], memory.path());
    terminal.wait_for("The plain oscillator");
    assert!(!terminal.text().contains("arrows change the numbers"));
    terminal.leave();
    for arguments in [&["--set", "r=0.2"][..], &["--method", "rk4"]] {
        let memory = tempfile::tempdir().unwrap();
        let mut terminal = begun(arguments, memory.path());
        terminal.wait_for("The plain oscillator");
        terminal.leave();
    }
}

#[test]
fn an_interrupted_session_is_kept_offered_and_brought_back() {
    all_at_once(&[Signal::HUP, Signal::TERM], |&signal| {
        let memory = tempfile::tempdir().unwrap();
        let mut terminal = explorer(&["linear"], memory.path());
        terminal.types("-0.345\r");
        terminal.wait_for("-0.345");
        terminal.signal(signal);
        assert_eq!(terminal.end(), 128 + u32::try_from(signal.as_raw()).unwrap());
        terminal.assert_restored();
        assert_eq!(kept(memory.path()).len(), 1);

        let mut terminal = explorer(&[], memory.path());
        terminal.wait_for("a session was interrupted: F3 resumes it");
        terminal.types("\x1bOR");
        terminal.wait_for("the interrupted session is back");
        terminal.wait_for("-0.345");
        assert_eq!(kept(memory.path()), [] as [PathBuf; 0]);
        terminal.leave();
    });
}

#[test]
fn a_session_in_which_nothing_was_done_is_not_kept() {
    let memory = tempfile::tempdir().unwrap();
    let mut terminal = explorer(&["plain"], memory.path());
    terminal.signal(Signal::TERM);
    assert_eq!(terminal.end(), 143);
    assert_eq!(kept(memory.path()), [] as [PathBuf; 0]);
}

#[test]
fn a_session_that_cannot_be_kept_says_so_when_it_is_left() {
    let memory = tempfile::tempdir().unwrap();
    fs::create_dir_all(memory.path().join("hopfscope/last.toml")).unwrap();
    let mut terminal = explorer(&["linear"], memory.path());
    terminal.types("-0.345\r");
    terminal.wait_for("-0.345");
    terminal.types("q");
    terminal.wait_for("hopfscope: the session is not kept: ");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn a_session_is_saved_and_resumed() {
    let memory = tempfile::tempdir().unwrap();
    let file = memory.path().join("mine.toml");
    let line = |command: &str| format!(":{command} {}\r", file.display());
    let mut terminal = explorer(&["linear"], memory.path());
    terminal.types(":set D=-0.345\r");
    terminal.wait_for("-0.345");
    terminal.types(&line("write"));
    terminal.wait_for("written to");
    let written = fs::read_to_string(&file).unwrap();
    terminal.types(&line("write"));
    terminal.wait_for("already exists");
    assert_eq!(fs::read_to_string(&file).unwrap(), written);
    terminal.leave();

    let mut terminal = explorer(&["--open", file.to_str().unwrap()], memory.path());
    terminal.wait_for("-0.345");
    terminal.types("u");
    terminal.wait_for("undo: D = -0.4");
    terminal.leave();
}

#[test]
fn the_tour_goes_on_by_any_key_but_those_it_names_and_is_left_by_escape() {
    let memory = tempfile::tempdir().unwrap();
    let mut terminal = explorer(&["tour"], memory.path());
    terminal.wait_for("any key: on, backspace: back");
    terminal.wait_for("dry friction");
    terminal.types(" ");
    terminal.wait_for("takes a step");
    // The caption names the key that steps: the key does its work, and the tour continues regardless.
    terminal.types("\x1b[C");
    terminal.wait_for("-0.35");
    assert!(terminal.text().contains("takes a step"), "the caption stays");
    terminal.types(" ");
    terminal.wait_for("Starts inside the dashed curve");
    terminal.wait_for("-0.6");
    // An arrow that is not named goes back.
    terminal.types("\x1b[D");
    terminal.wait_for("takes a step");
    terminal.types("\x1b");
    terminal.wait_for("replay stopped");
    assert!(!terminal.text().contains("esc: leave"));
    terminal.leave();
}

#[test]
fn a_key_writes_the_plot_in_use_as_a_figure_and_replaces_none() {
    let memory = tempfile::tempdir().unwrap();
    let file = memory.path().join("pane.svg");
    let mut terminal = explorer(&["linear"], memory.path());
    let press = |terminal: &mut Terminal| {
        terminal.types("\x1bf");
        terminal.wait_for("figure-pane linear-1.svg");
        terminal.types(&format!("\x15figure-pane {}\r", file.display()));
    };
    press(&mut terminal);
    terminal.wait_for("written to");
    let written = fs::read_to_string(&file).unwrap();
    let picture = roxmltree::Document::parse(&written).unwrap();
    assert_eq!(picture.root_element().tag_name().name(), "svg");
    let panels = picture.descendants().filter(|node| node.has_tag_name("clipPath")).count();
    assert_eq!(panels, 1, "the pane in use, not all");
    press(&mut terminal);
    terminal.wait_for("already exists; add ! to overwrite");
    assert_eq!(fs::read_to_string(&file).unwrap(), written);
    terminal.leave();
}

/// The nonblank rows of a screen, without the line of costs, which depends on the machine.
fn screen(text: &str) -> Vec<String> {
    let rows = text.trim_end().lines().map(|row| row.trim_end().to_owned());
    let costs = |row: &String| row.contains(" ms") || row.contains("recomputed ");
    rows.filter(|row| !row.is_empty() && !costs(row)).collect()
}

/// The last screen of a recording, from the command `replay`.
fn replayed(file: &Path) -> Vec<String> {
    let arguments = ["replay", file.to_str().unwrap()];
    let output = std::process::Command::new(PROGRAM).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    screen(&String::from_utf8(output.stdout).unwrap())
}

#[test]
fn a_recording_plays_what_was_recorded_without_the_key_that_left() {
    let memory = tempfile::tempdir().unwrap();
    explorer(&["plain"], memory.path()).leave();
    let saved = memory.path().join("saved.toml");
    let mut terminal = explorer(&["fig16b"], memory.path());
    terminal.types(&format!("\x1b[C\"a\x1b[C:write {}\r", saved.display()));
    terminal.wait_for("written to");
    terminal.leave();
    let cases = [
        (&["supercritical", "--set", "q0=0.5"][..], "\x1b[C\x1b[C\x1b[C"),
        (&["--set", "D3=0.5", "--method", "rk4", "--step", "0.02", "--theme", "light"], "Ro"),
        (&["--belt", "textbook", "--glyphs", "ascii"], "\t+"),
        (&["--open", saved.to_str().unwrap()], "u'a"),
    ];
    all_at_once(&cases, |(arguments, keys)| {
        let memory = tempfile::tempdir().unwrap();
        explorer(&["plain"], memory.path()).leave();
        let file = memory.path().join("r.keys");
        let all = [*arguments, &["--record", file.to_str().unwrap()]].concat();
        let mut terminal = explorer(&all, memory.path());
        for key in keys.split_inclusive(|char: char| char != '\x1b' && char != '[') {
            terminal.types(key);
            terminal.rest();
        }
        let last = screen(&terminal.text());
        terminal.leave();
        assert_eq!(replayed(&file), last, "{}", fs::read_to_string(&file).unwrap());
    });
}

#[test]
fn a_recording_survives_any_end_of_the_program_and_replaces_no_other_file() {
    let memory = tempfile::tempdir().unwrap();
    let file = memory.path().join("scan.csv");
    fs::write(&file, "data\n").unwrap();
    let path = file.to_str().unwrap();
    let refused = |arguments: &[&str]| {
        let program = [&[PROGRAM], arguments].concat();
        let mut terminal = Terminal::start(&program, &[], (100, 30), Answers::AtOnce);
        assert_eq!(terminal.end(), 2);
        assert!(terminal.text().contains("is not a recording; add --force to overwrite"));
    };
    refused(&["supercritical", "--record", path]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "data\n");
    let mut terminal = explorer(&["--record", path, "--force"], memory.path());
    terminal.types("-0.345\r");
    terminal.wait_for("-0.345");
    terminal.quiet(QUIET);
    terminal.signal(Signal::KILL);
    terminal.end();
    let recorded = fs::read_to_string(&file).unwrap();
    assert!(recorded.contains("- 0 . 3 4 5 <enter>"), "{recorded}");
    // A recording is replaced by the next one without asking.
    explorer(&["--record", path], memory.path()).leave();
    assert!(!fs::read_to_string(&file).unwrap().contains("<enter>"));
}

#[test]
fn keys_pressed_while_a_file_plays_are_not_mixed_into_it() {
    let memory = tempfile::tempdir().unwrap();
    let file = memory.path().join("slow.keys");
    // A line is typed repeatedly while the user presses other keys.
    let line = ":set<space>r=0.25<enter><right>";
    fs::write(&file, format!("s/asymmetry<enter>{}", line.repeat(10))).unwrap();
    let mut terminal = begun(&["--play", file.to_str().unwrap()], memory.path());
    terminal.wait_for("Asymmetry");
    for _ in 0..5 {
        terminal.types("x7");
        terminal.next(Duration::from_millis(5));
    }
    terminal.wait_for("replay done");
    for row in [" D         -0.1 step ", " r           0.25 "] {
        assert!(terminal.text().replace('\u{25b8}', " ").contains(row), "{}", terminal.text());
    }
    terminal.leave();
}

#[test]
fn keys_that_need_an_answer_end_on_the_same_screen_in_one_write_and_one_by_one() {
    let cases = [
        ("supercritical", &["\x1b[C", "\x1b[C", "i", "\x1b[C", "o"][..]),
        ("supercritical", &[":set r=0.15\r", "\t", "\t", "w", "\x1b[C", "\t", "\r", "u"]),
        ("linear", &["\"a", "\x1b[C", ":view trade\r", "\x1b[D", "\x1b[D", "\r", "'a"]),
        ("fig17", &["\x1b[C", "\t", "0", "+", "H", "\x1b[A", "\r"]),
    ];
    all_at_once(&cases, |(scene, keys)| {
        let memory = tempfile::tempdir().unwrap();
        explorer(&["plain"], memory.path()).leave();
        let end = |writes: &[String]| {
            let mut terminal = explorer(&[scene], memory.path());
            for keys in writes {
                terminal.types(keys);
                terminal.rest();
            }
            let last = screen(&terminal.text());
            terminal.leave();
            last
        };
        let one_by_one: Vec<String> = keys.iter().map(ToString::to_string).collect();
        assert_eq!(end(&[keys.concat()]), end(&one_by_one), "{keys:?} in {scene}");
    });
}

#[test]
fn a_session_that_is_left_is_the_last_one_unless_nothing_was_done() {
    let memory = tempfile::tempdir().unwrap();
    explorer(&["linear"], memory.path()).leave();
    assert!(!memory.path().join("hopfscope/last.toml").exists(), "nothing was done");
    let mut terminal = explorer(&["linear"], memory.path());
    terminal.types(":set D=-0.345\r");
    terminal.wait_for("-0.345");
    terminal.leave();
    let mut terminal = explorer(&["--last"], memory.path());
    terminal.wait_for("-0.345");
    terminal.types("u");
    terminal.wait_for("undo: D = -0.4");
    terminal.leave();
}

#[test]
fn interrupted_sessions_are_offered_newest_first_and_forgotten_all_at_once() {
    let memory = tempfile::tempdir().unwrap();
    let folder = memory.path().join("hopfscope");
    for damping in ["-0.345", "-0.456"] {
        let mut terminal = explorer(&["linear"], memory.path());
        terminal.types(&format!(":set D={damping}\r"));
        terminal.wait_for(damping);
        terminal.signal(Signal::TERM);
        assert_eq!(terminal.end(), 143);
    }
    assert_eq!(kept(memory.path()).len(), 2);
    let mut terminal = explorer(&[], memory.path());
    terminal.wait_for("F3 lists them, F4 forgets all");
    terminal.types("\x1bOR");
    terminal.wait_for("interrupted sessions");
    terminal.wait_for("linear D = -0.345 (1 change)");
    assert!(terminal.text().find("-0.456") < terminal.text().find("-0.345"), "the newest first");
    terminal.types("X");
    terminal.wait_for("2 interrupted sessions are not offered again");
    assert_eq!(kept(memory.path()), [] as [PathBuf; 0]);
    terminal.leave();
    let last = fs::read_to_string(folder.join("last.toml")).unwrap();
    assert!(last.contains("-0.456"), "the newest is the last one");
}
