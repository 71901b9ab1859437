//! Sessions in a real terminal: kept when they are interrupted, offered at the next start, written and
//! opened, and the first line that a new user sees.

mod support;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::process::Signal;
use support::{Answers, Terminal};

/// The explorer, whose memory is a folder of its own.
fn explorer(arguments: &[&str], memory: &Path) -> Terminal {
    let program: Vec<&str> =
        [env!("CARGO_BIN_EXE_hopfscope")].iter().chain(arguments).copied().collect();
    let state = memory.to_str().unwrap();
    let environment = [("XDG_STATE_HOME", state), ("XDG_CONFIG_HOME", state)];
    let mut terminal = Terminal::start(&program, &environment, (100, 30), Answers::AtOnce);
    terminal.wait("the first picture", |terminal| terminal.screen().alternate_screen());
    terminal.quiet(Duration::from_millis(200));
    terminal
}

fn leave(mut terminal: Terminal) {
    terminal.types("q");
    assert_eq!(terminal.end(), 0);
    terminal.assert_restored();
}

/// The kept sessions in a folder.
fn kept(memory: &Path) -> Vec<PathBuf> {
    let folder = fs::read_dir(memory.join("hopfscope")).unwrap();
    let paths = folder.map(|entry| entry.unwrap().path());
    paths.filter(|path| path.to_str().unwrap().contains("interrupted-")).collect()
}

#[test]
fn the_first_start_says_what_to_press_and_the_next_one_does_not() {
    let memory = tempfile::tempdir().unwrap();
    let mut terminal = explorer(&[], memory.path());
    terminal.wait_for("arrows change the numbers; ? keys, <space> commands");
    leave(terminal);
    let terminal = explorer(&[], memory.path());
    assert!(!terminal.text().contains("arrows change the numbers"));
    leave(terminal);
}

#[test]
fn an_interrupted_session_is_kept_offered_and_brought_back() {
    for signal in [Signal::HUP, Signal::TERM] {
        let memory = tempfile::tempdir().unwrap();
        let mut terminal = explorer(&["linear"], memory.path());
        terminal.types("-0.345\r");
        terminal.wait_for("-0.345");
        terminal.signal(signal);
        assert_eq!(terminal.end(), 128 + u32::try_from(signal.as_raw()).unwrap());
        terminal.assert_restored();
        assert_eq!(kept(memory.path()).len(), 1);

        let mut terminal = explorer(&[], memory.path());
        terminal.wait_for("a session was interrupted: <f3> goes on with it");
        terminal.types("\x1bOR");
        terminal.wait_for("the interrupted session is back");
        terminal.wait_for("-0.345");
        assert_eq!(kept(memory.path()), [] as [PathBuf; 0]);
        leave(terminal);
    }
}

#[test]
fn a_session_in_which_nothing_was_done_is_not_kept() {
    let memory = tempfile::tempdir().unwrap();
    let mut terminal = explorer(&[], memory.path());
    terminal.signal(Signal::TERM);
    assert_eq!(terminal.end(), 143);
    assert_eq!(kept(memory.path()), [] as [PathBuf; 0]);
}

#[test]
fn a_session_is_written_and_gone_on_with() {
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
    terminal.wait_for("is there already");
    assert_eq!(fs::read_to_string(&file).unwrap(), written);
    leave(terminal);

    let mut terminal = explorer(&["--open", file.to_str().unwrap()], memory.path());
    terminal.wait_for("-0.345");
    terminal.types("u");
    terminal.wait_for("undo: D = -0.4");
    leave(terminal);
}

#[test]
fn the_tour_goes_on_by_any_key_and_is_left_by_escape() {
    let memory = tempfile::tempdir().unwrap();
    let mut terminal = explorer(&["tour"], memory.path());
    terminal.wait_for("any key: on, esc: leave the tour");
    terminal.wait_for("dry friction");
    terminal.types(" ");
    terminal.wait_for("takes a step");
    terminal.types("\x1b");
    terminal.wait_for("replay stopped");
    assert!(!terminal.text().contains("leave the tour"));
    leave(terminal);
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
    terminal.wait_for("is there already; with ! behind the command it is replaced");
    assert_eq!(fs::read_to_string(&file).unwrap(), written);
    leave(terminal);
}
