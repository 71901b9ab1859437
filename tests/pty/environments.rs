//! The explorer in every environment: locales, `NO_COLOR`, kinds of terminals, no terminal, and terminals whose
//! size changes or that it has to give back for a while.

use std::collections::BTreeSet;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::support::{Answers, PROGRAM, QUIET, TITLE, Terminal, all_at_once};

/// The parameters of all sequences that set colours and attributes.
fn attributes(written: &[u8]) -> BTreeSet<u8> {
    let written = String::from_utf8_lossy(written).into_owned();
    let parameters = written.split("\x1b[").skip(1).filter_map(|text| text.split_once('m'));
    let parameters = parameters.map(|(parameters, _)| parameters);
    let settings =
        parameters.filter(|text| text.chars().all(|char| char.is_ascii_digit() || char == ';'));
    settings.flat_map(|text| text.split(';')).filter_map(|number| number.parse().ok()).collect()
}

/// Whether a parameter sets a colour other than the terminal's default.
fn is_colour(number: u8) -> bool {
    matches!(number, 30..=38 | 40..=48 | 90..=97 | 100..=107)
}

/// The expected output in an environment.
struct Expected {
    colours: bool,
    /// Whether everything written is ASCII.
    ascii: bool,
    /// Characters of which some are on the screen.
    dots: std::ops::RangeInclusive<char>,
}

#[test]
fn every_kind_of_terminal_gets_what_it_can_show() {
    let braille = '\u{2801}'..='\u{28ff}';
    let blocks = '\u{2580}'..='\u{259f}';
    let stars = '*'..='*';
    let cases: [(&[(&str, &str)], Expected); 8] = [
        (&[], Expected { colours: true, ascii: false, dots: braille.clone() }),
        (&[("TERM", "")], Expected { colours: true, ascii: false, dots: braille.clone() }),
        (&[("TERM", "vt100")], Expected { colours: false, ascii: false, dots: braille.clone() }),
        (&[("TERM", "linux")], Expected { colours: true, ascii: false, dots: blocks }),
        (&[("TERM", "screen")], Expected { colours: true, ascii: false, dots: braille.clone() }),
        (&[("LANG", "C")], Expected { colours: true, ascii: true, dots: stars.clone() }),
        (&[("NO_COLOR", "1")], Expected { colours: false, ascii: false, dots: braille }),
        (
            &[("NO_COLOR", "1"), ("LANG", "C"), ("TERM", "vt100")],
            Expected { colours: false, ascii: true, dots: stars },
        ),
    ];
    all_at_once(&cases, |(environment, expected)| {
        let mut terminal = Terminal::start(&[PROGRAM], environment, (80, 24), Answers::AtOnce);
        terminal.wait_for(TITLE);
        terminal.quiet(QUIET);
        let attributes = attributes(&terminal.written);
        let colours = attributes.iter().any(|number| is_colour(*number));
        assert_eq!(colours, expected.colours, "{environment:?}: {attributes:?}");
        // Without colours things remain distinguishable: bold, dim, reverse.
        assert!(attributes.iter().any(|number| (1..=9).contains(number)), "{environment:?}");
        assert_eq!(terminal.written.is_ascii(), expected.ascii, "{environment:?}");
        let shown = terminal.text().chars().any(|char| expected.dots.contains(&char));
        assert!(shown, "{environment:?}\n{}", terminal.text());
        terminal.leave();
    });
}

/// The colour of the heading of the active pane.
fn heading(terminal: &Terminal) -> vt100::Color {
    terminal.screen().cell(1, 3).expect("the screen has a second row").fgcolor()
}

#[test]
fn the_theme_follows_the_background_that_the_terminal_tells_at_any_time() {
    const QUESTION: &[u8] = b"\x1b]11;?\x1b\\";
    let asked = |terminal: &Terminal| {
        terminal.written.windows(QUESTION.len()).filter(|bytes| *bytes == QUESTION).count()
    };
    let mut terminal = Terminal::start(&[PROGRAM], &[], (80, 24), Answers::AtOnce);
    // The picture does not wait for an answer to the query.
    terminal.wait_for(TITLE);
    terminal.quiet(QUIET);
    assert_eq!((asked(&terminal), heading(&terminal)), (1, vt100::Color::Idx(6)));
    terminal.types("\x1b]11;rgb:fdfd/f6f6/e3e3\x1b\\");
    // On a light ground colours are finer than the sixteen, where the terminal has them.
    terminal.wait("light theme", |terminal| heading(terminal) == vt100::Color::Idx(24));
    terminal.types("q");
    assert_eq!(terminal.end(), 0);
    for chosen in [&[PROGRAM, "--theme", "dark"][..], &[PROGRAM, "--color", "never"]] {
        let mut terminal = Terminal::start(chosen, &[], (80, 24), Answers::AtOnce);
        terminal.wait_for(TITLE);
        assert_eq!(asked(&terminal), 0, "{chosen:?}");
        terminal.leave();
    }
}

#[test]
fn a_terminal_on_one_side_only_is_refused_in_one_line() {
    for (redirection, named) in
        [("< /dev/null", "standard input"), ("> /dev/null", "standard output")]
    {
        let command = format!("{PROGRAM} {redirection}; echo code $?");
        let mut terminal = Terminal::start(&["sh", "-c", &command], &[], (200, 24), Answers::Never);
        terminal.wait_for("code");
        let said = terminal.text();
        assert!(said.contains(named) && said.contains("code 2"), "{said}");
        assert_eq!(said.trim().lines().count(), 2, "{said}");
        assert!(!terminal.screen().alternate_screen());
    }
}

/// Runs the program without a terminal; returns its exit code and messages.
fn without_terminal(arguments: &[&str], term: &str) -> (Option<i32>, String) {
    let output = Command::new(PROGRAM)
        .args(arguments)
        .env("TERM", term)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert!(output.stdout.is_empty());
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn where_there_is_no_terminal_one_line_says_what_to_do_instead() {
    let (code, said) = without_terminal(&[], "xterm");
    assert_eq!(code, Some(2));
    assert!(said.contains("not a terminal") && said.contains("trajectory"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

#[test]
fn a_dumb_terminal_is_refused_in_one_line() {
    let mut terminal = Terminal::start(&[PROGRAM], &[("TERM", "dumb")], (80, 24), Answers::Never);
    assert_eq!(terminal.end(), 2);
    let said = String::from_utf8_lossy(&terminal.written).into_owned();
    assert!(said.contains("TERM=dumb") && said.contains("trajectory"), "{said}");
    assert!(!said.contains('\x1b'), "{said:?}");
}

/// The rows that a draw on an empty screen changes, before and after it.
fn damaged(terminal: &mut Terminal) -> Vec<[String; 2]> {
    terminal.rest();
    let (before, text) = (terminal.cells(), terminal.text());
    let frames = terminal.frames();
    terminal.types("\x0c");
    terminal.wait("a fresh draw", |terminal| terminal.frames() > frames);
    terminal.rest();
    let (after, width) = (terminal.cells(), usize::from(terminal.screen().size().1.get()));
    let rows = before.chunks(width).zip(after.chunks(width)).map(|(before, after)| before == after);
    let texts = text
        .lines()
        .zip(terminal.text().lines())
        .map(|(one, other)| [one, other].map(str::to_owned))
        .collect::<Vec<_>>();
    let changed = rows.zip(texts).filter(|(same, _)| !same).map(|(_, texts)| texts);
    // What the last key has cost is never the same.
    changed.filter(|[before, _]| !before.contains(" ms")).collect()
}

/// Gaps between two changes of the size, in ms.
const GAPS: [u64; 6] = [0, 5, 20, 60, 150, 300];

#[test]
fn a_size_that_changes_there_and_back_leaves_no_damage() {
    let cases = [(60, 16, ""), (100, 30, ""), (60, 16, "\x1b[C"), (100, 30, "\x1b[C")];
    all_at_once(&cases, |&(columns, rows, keys)| {
        let mut terminal = Terminal::explorer(&["supercritical"], &[], (80, 24));
        for gap in GAPS {
            terminal.quiet(QUIET);
            terminal.types(&keys.repeat(3));
            terminal.resize(columns, rows);
            terminal.watch(Duration::from_millis(gap));
            terminal.types(keys);
            terminal.resize(80, 24);
            assert_eq!(
                damaged(&mut terminal),
                [[""; 2]; 0],
                "{columns}x{rows}, {gap} ms, {keys:?}"
            );
        }
        terminal.leave();
    });
}

#[test]
fn on_a_slow_line_a_size_that_changes_there_and_back_leaves_no_damage() {
    all_at_once(&GAPS, |&gap| {
        let mut terminal = Terminal::explorer(&["supercritical"], &[], (80, 24));
        terminal.quiet(QUIET);
        terminal.answers = Answers::WhenTold;
        // A frame is under way while the size changes.
        terminal.types("\x1b[C");
        terminal.watch(Duration::from_millis(50));
        for (columns, rows) in [(60, 16), (100, 30), (80, 24)] {
            terminal.resize(columns, rows);
            terminal.watch(Duration::from_millis(gap));
        }
        while terminal.owed() > 0 {
            terminal.answer();
            terminal.quiet(Duration::from_millis(100));
        }
        terminal.answers = Answers::AtOnce;
        assert_eq!(damaged(&mut terminal), [[""; 2]; 0], "{gap} ms");
        terminal.leave();
    });
}

#[test]
fn a_stop_leaves_no_damage() {
    let shell = ["bash", "--norc", "--noprofile", "-i"];
    let mut terminal = Terminal::start(&shell, &[("PS1", "ready> ")], (80, 24), Answers::AtOnce);
    terminal.wait_for("ready> ");
    terminal.types(&format!("{PROGRAM} supercritical\r"));
    terminal.wait("the first picture", |terminal| terminal.screen().alternate_screen());
    for stops in 1..=3 {
        terminal.quiet(QUIET);
        // The frame under way is confirmed before the shell has the terminal, later ones too late.
        terminal.types("\x1b[C\x1b[C\x1a");
        terminal.wait("the shell", |terminal| !terminal.screen().alternate_screen());
        terminal.resize(60, 16);
        terminal.resize(80, 24);
        terminal.wait("the stop", |it| it.text().matches("Stopped").count() == stops);
        terminal.types("fg\r");
        terminal.wait("the picture", |terminal| terminal.screen().alternate_screen());
        assert_eq!(damaged(&mut terminal), [[""; 2]; 0], "stop {stops}");
    }
    terminal.types("q");
    terminal.wait("the shell", |terminal| !terminal.screen().alternate_screen());
}
