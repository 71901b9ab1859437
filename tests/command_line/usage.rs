//! Use of the command line: wrong input, help, closed pipes, settings. The answers of the commands are in `main.rs`.

use std::fs;
use std::io::Read;
use std::process::Stdio;

use crate::program::{command, run};

/// A wrong command line, and the words that its error message must contain.
const WRONG: [(&str, &[&str]); 37] = [
    ("--sett D=1", &["--sett", "did you mean '--set'"]),
    ("nowhere", &["nowhere", "hopfscope scenes", "hopfscope --help"]),
    ("supercritcal", &["supercritcal", "did you mean supercritical"]),
    ("trajectry", &["trajectry", "the command trajectory"]),
    ("trajectory --scene captur", &["captur", "did you mean capture"]),
    ("trajectory surplus", &["surplus"]),
    ("trajectory --set D", &["'D'", "NAME=VALUE"]),
    ("trajectory --set d=1", &["\"d\"", "D, D2, D3, r, q0, v0"]),
    ("trajectory --set D=NaN", &["D=NaN", "-1e6 .. 1e6"]),
    ("trajectory --set D=-inf", &["D=-inf", "-1e6 .. 1e6"]),
    ("trajectory --set q0=1e400", &["q0=1e400", "-1e150 .. 1e150"]),
    ("trajectory --set r=-0.1", &["r=-0.1", "0 .. 1e150"]),
    ("trajectory --set D2=-1e-151", &["D2=-1e-151", "allowed: 0, or 1e-150 and more"]),
    ("trajectory --set D=abc", &["D=abc", "not a number"]),
    ("trajectory --until NaN", &["NaN", "0 .. 1e9"]),
    ("trajectory --until -1", &["-1", "0 .. 1e9"]),
    ("trajectory --tol 0", &["'0'", "1e-15 .. 0.01"]),
    ("trajectory --tol 1e400", &["1e400", "1e-15 .. 0.01"]),
    ("trajectory --method euler", &["euler", "taylor"]),
    ("trajectory --format xml", &["xml", "table, json, csv"]),
    ("trajectory --repeat 0", &["'0'", "1..=1000000"]),
    ("trajectory --repeat -1", &["-1"]),
    ("cycles --until 5", &["--until"]),
    ("cycles --harmonics 0", &["0", "1 .. 255"]),
    ("cycles --harmonics 256", &["256", "1 .. 255"]),
    ("cycles --harmonics x", &["x", "1 .. 255"]),
    ("branch", &["--over"]),
    ("branch --over D", &["'D'", "NAME=FROM:TO:COUNT"]),
    ("border --over D=-0.9:-0.1:4", &["not over D", "D2, D3 or r"]),
    ("branch --over D=0:1:0", &["COUNT = 0", "2 .. 1000000"]),
    ("branch --over D=0:nan:9", &["nan", "-1e6 .. 1e6"]),
    ("branch --over r=-1:1:9", &["r=-1:1:9", "0 .. 1e150"]),
    ("branch --over q0=0:1:9", &["q0", "D, D2, D3, r"]),
    (
        "scan --over D=-1:1:3 --measure guaranteed --half-width r=0.1 --half-width r=0.2",
        &["r has two half widths"],
    ),
    ("replay /does/not/exist", &["/does/not/exist", "No such file"]),
    ("replay x --size 80", &["80", "WxH"]),
    ("--glyphs cuneiform", &["cuneiform", "braille"]),
];

#[test]
fn wrong_input_is_answered_with_one_line_that_names_it_and_exit_code_2() {
    for (line, names) in WRONG {
        let ran = run(&line.split_whitespace().collect::<Vec<_>>());
        assert_eq!(ran.out, "", "{line}");
        assert!(ran.err.starts_with("hopfscope: "), "{line}: {}", ran.err);
        ran.is_refused(names);
    }
}

#[test]
fn without_a_terminal_the_explorer_names_the_other_commands() {
    let ran = run(&[]);
    assert_eq!((ran.code, ran.out.as_str()), (2, ""));
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    for command in ["trajectory", "cycles", "replay"] {
        assert!(ran.err.contains(command), "{}", ran.err);
    }
}

#[test]
fn help_and_version_are_answers() {
    for option in ["--help", "--version", "-h", "-V"] {
        let ran = run(&[option]);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{option}");
        assert!(ran.out.contains("hopfscope"), "{option}: {}", ran.out);
    }
    let help = run(&["trajectory", "--help"]).out;
    for option in ["--scene", "--set", "--method", "--tol", "--format", "--repeat", "--until"] {
        assert!(help.contains(option), "{option} is not in the help: {help}");
    }
}

#[test]
fn a_closed_pipe_is_not_an_error() {
    // Several megabytes of rows, of which the reader takes a few bytes.
    let options = ["trajectory", "--set", "D=0", "--set", "r=0", "--until", "200000"];
    let mut child = command(&[&options[..], &["--format", "csv"]].concat())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = [0; 16];
    child.stdout.take().unwrap().read_exact(&mut first).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
}

#[test]
fn keys_lists_what_the_settings_file_makes_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("config.toml");
    let file = path.to_str().unwrap();
    std::fs::write(&path, "[keys.parameters]\nstep-up = [\"<A-l>\"]\n").unwrap();
    let listed = run(&["keys", "--config", file]);
    assert_eq!(listed.code, 0);
    assert!(listed.err.contains(file), "{}", listed.err);
    let row = listed
        .out
        .lines()
        .find(|line| line.starts_with("parameters") && line.contains(" step-up "));
    assert!(row.unwrap().contains("<A-l>"), "{row:?}");
    let usual = run(&["keys", "--no-config", "--format", "csv"]);
    assert!(usual.out.contains("parameters,step-up,<right> l,"), "{}", usual.out);
    assert_eq!(usual.err, "");
    // A mistake is reported in one line with its place, wherever settings are read.
    std::fs::write(&path, "[keys.parameters]\nstep-up = [\"k\"]\n").unwrap();
    for arguments in [vec!["keys", "--config", file], vec!["--config", file]] {
        run(&arguments).is_refused(&["config.toml:2:12: k already means select-previous"]);
    }
    run(&["keys", "--config", "/no/such/file"]).is_refused(&["/no/such/file", "No such file"]);
}

#[test]
fn a_certificate_is_checked_by_another_run_and_says_where_it_comes_from() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.json");
    let path = path.to_str().unwrap();
    let write =
        ["cycles", "--set", "D=-0.3", "--set", "D3=0.5", "--set", "r=0.1", "--certificate", path];
    assert_eq!(run(&write).code, 0);
    let checked = run(&["check", path]);
    assert_eq!((checked.code, checked.err.as_str()), (0, ""));
    assert!(checked.out.contains("2 limit cycles and no other"), "{}", checked.out);
    let source = fs::read_to_string(format!("{path}.provenance")).unwrap();
    assert!(source.contains("hopfscope cycles --set D=-0.3"), "{source}");
    // With one step removed there is a gap.
    let text = fs::read_to_string(path).unwrap();
    let step = text.lines().nth(5).unwrap();
    fs::write(path, text.replacen(&format!("{step}\n"), "", 1)).unwrap();
    let refused = run(&["check", path]);
    assert_eq!((refused.code, refused.out.as_str()), (1, ""), "{}", refused.err);
    assert_eq!(refused.err.lines().count(), 1, "{}", refused.err);
}
