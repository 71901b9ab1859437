//! `hopfscope replay`: keystroke files without a terminal.

use std::fs;
use std::path::Path;

use crate::program::{Ran, run};

/// Replays a text with these additional arguments.
fn replay(folder: &Path, keys: &str, arguments: &[&str]) -> Ran {
    let file = folder.join("test.keys");
    fs::write(&file, keys).unwrap();
    run(&[&["replay", file.to_str().unwrap()], arguments].concat())
}

#[test]
fn the_last_screen_is_printed_at_the_size_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let ran = replay(folder.path(), "<wait>", &["--size", "90x30", "--set", "r=0.5"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    assert_eq!(ran.out.lines().count(), 30, "{}", ran.out);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 90));
    assert!(ran.out.contains("comes to rest at q ="), "{}", ran.out);
}

#[test]
fn named_screens_are_written_as_text_or_as_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let screens = folder.path().join("screens");
    let keys = "<wait> <screen before> <right*5> <screen after>";
    for format in ["text", "svg"] {
        let ran = replay(
            folder.path(),
            keys,
            &["--screens", screens.to_str().unwrap(), "--screen-format", format],
        );
        assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    }
    let read = |name: &str| fs::read_to_string(screens.join(name)).unwrap();
    assert_ne!(read("before.txt"), read("after.txt"));
    assert_eq!(read("before.txt").lines().count(), 40, "120x40 is the default");
    let picture = read("after.svg");
    assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"));
    assert!(picture.contains("<path "), "the motion is drawn");
    assert_eq!(picture.matches("<text").count(), picture.matches("</text>").count());
}

#[test]
fn an_expectation_that_is_not_met_ends_the_replay_with_1_and_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let keys = "# first\n<expect \"plain\">\n\n  <expect \"the moon\"> <expect \"the sun\">\n";
    let ran = replay(folder.path(), keys, &[]);
    assert_eq!(ran.code, 1);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(ran.err.contains("line 4") && ran.err.contains("the moon"), "{}", ran.err);
    assert!(!ran.out.is_empty(), "the last screen is printed");
}

#[test]
fn a_file_that_cannot_be_understood_is_refused_with_its_place_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    let screens = folder.path().join("screens");
    let keys = "<screen early>\n<right> <frobnicate>\n";
    let ran = replay(folder.path(), keys, &["--screens", screens.to_str().unwrap()]);
    assert_eq!((ran.code, ran.out.as_str()), (2, ""));
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    for part in ["test.keys", "line 2", "column 9", "frobnicate"] {
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
    assert!(!screens.exists());
}

#[test]
fn the_look_can_be_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let ran = replay(folder.path(), "<wait>", &["--glyphs", "ascii", "--color", "never"]);
    assert_eq!(ran.code, 0);
    assert!(ran.out.is_ascii(), "{}", ran.out);
}
