//! The explorer in a real terminal: what a user sees, how many bytes it writes, how it ends.

mod environments;
mod runtime;
mod sessions;
mod ssh;
mod support;

use std::collections::BTreeSet;
use std::process::{Command, Stdio};
use std::time::Duration;

use rustix::process::Signal;
use support::{Answers, PROGRAM, QUIET, TITLE, Terminal, all_at_once};

/// The explorer with its first picture complete.
fn explorer(arguments: &[&str], environment: &[(&str, &str)], size: (u16, u16)) -> Terminal {
    let mut terminal = Terminal::explorer(arguments, environment, size);
    terminal.quiet(QUIET);
    terminal
}

/// The screen without the line on the cost of the last key, since no two runs take equal times.
fn picture(terminal: &Terminal) -> String {
    let text = terminal.text();
    let rows = text.lines().filter(|row| !row.contains(" ms"));
    rows.map(str::trim_end).collect::<Vec<_>>().join("\n")
}

#[test]
fn it_shows_the_paper_s_oscillator_and_leaves_the_terminal_as_it_was() {
    let mut terminal = explorer(&[], &[], (80, 24));
    terminal.wait_for(TITLE);
    for pane in ["parameters", "phase plane", "cycles"] {
        assert!(terminal.text().contains(pane), "no {pane}\n{}", terminal.text());
    }
    let braille = |char| ('\u{2801}'..='\u{28ff}').contains(&char);
    assert!(terminal.text().contains(braille), "no curve\n{}", terminal.text());
    terminal.leave();
}

#[test]
fn a_step_moves_the_value_and_the_picture() {
    let mut terminal = explorer(&["--set", "D=-0.08"], &[], (80, 24));
    terminal.wait_for("-0.08");
    let before = picture(&terminal);
    terminal.types("\x1b[C");
    terminal.wait_for("-0.07");
    terminal.quiet(QUIET);
    let after = picture(&terminal);
    let moved = before.lines().zip(after.lines()).filter(|(before, after)| before != after).count();
    assert!(moved > 10, "only {moved} rows changed");
    terminal.leave();
}

#[test]
fn a_pasted_script_is_offered_and_played() {
    let mut terminal = explorer(&["--set", "D=-0.08"], &[], (80, 24));
    terminal.types("\x1b[200~<right*3> # three steps\r\x1b[201~");
    terminal.wait_for("keys");
    terminal.types("\r");
    terminal.wait_for("-0.05");
    terminal.wait_for("replay done");
    terminal.leave();
}

#[test]
fn no_size_breaks_it_and_the_picture_comes_back() {
    let mut terminal = explorer(&[], &[], (80, 24));
    let before = picture(&terminal);
    for (columns, rows) in
        [(1, 1), (2, 200), (500, 1), (59, 15), (60, 16), (200, 60), (500, 200), (10, 3)]
    {
        terminal.resize(columns, rows);
        terminal.quiet(Duration::from_millis(50));
    }
    terminal.resize(80, 24);
    terminal.wait("the picture again", |terminal| picture(terminal) == before);
    terminal.leave();
}

#[test]
fn a_full_picture_and_a_step_are_a_few_bytes() {
    let mut terminal = explorer(&[], &[], (80, 24));
    let full = terminal.written.len();
    assert!(full <= 3_200, "{full} bytes until the first picture was complete");
    for _ in 0..5 {
        let frames = terminal.frames();
        terminal.types("\x1b[C");
        terminal.wait("a frame", |terminal| terminal.frames() > frames);
        terminal.quiet(QUIET);
    }
    let stepped = (terminal.written.len() - full) / 5;
    assert!(stepped <= 1_300, "{stepped} bytes a step");
    terminal.leave();
}

#[test]
fn a_changed_cell_costs_at_most_five_bytes_at_every_size() {
    all_at_once(&[(80, 24), (120, 40), (200, 60)], |&size| {
        let mut terminal = explorer(&[], &[], size);
        let (mut bytes, mut changed) = (0, 0);
        for _ in 0..5 {
            let (before, written) = (terminal.cells(), terminal.written.len());
            let frames = terminal.frames();
            terminal.types("\x1b[C");
            terminal.wait("a frame", |terminal| terminal.frames() > frames);
            terminal.quiet(QUIET);
            bytes += terminal.written.len() - written;
            changed += before.iter().zip(terminal.cells()).filter(|(old, new)| *old != new).count();
        }
        assert!(changed > 500, "{changed} cells at {size:?}");
        assert!(bytes <= 5 * changed, "{bytes} bytes for {changed} cells at {size:?}");
        terminal.leave();
    });
}

/// Processor time used so far, in ticks, and how often any of its threads has woken up.
#[cfg(target_os = "linux")]
fn activity(terminal: &Terminal) -> (u64, u64) {
    let process = format!("/proc/{}", terminal.process().as_raw_nonzero());
    let stat = std::fs::read_to_string(format!("{process}/stat")).unwrap();
    // The name, in brackets, may contain blanks; user and system time are fields 14 and 15.
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap().split_whitespace().collect();
    let ticks = fields[11].parse::<u64>().unwrap() + fields[12].parse::<u64>().unwrap();
    let mut wakes = 0;
    for task in std::fs::read_dir(format!("{process}/task")).unwrap() {
        let status = std::fs::read_to_string(task.unwrap().path().join("status")).unwrap();
        let switches = status.lines().filter(|line| line.contains("voluntary_ctxt_switches"));
        let counts = switches.map(|line| line.split_whitespace().last().unwrap().parse::<u64>());
        wakes += counts.map(Result::unwrap).sum::<u64>();
    }
    (ticks, wakes)
}

#[test]
#[cfg(target_os = "linux")]
fn idle_it_writes_nothing_and_does_not_wake_up() {
    let mut terminal = explorer(&[], &[], (80, 24));
    let before = activity(&terminal);
    assert_eq!(terminal.watch(Duration::from_secs(3)), 0, "bytes while idle");
    assert_eq!(activity(&terminal), before, "processor time or wake-ups while idle");
    terminal.leave();
}

#[test]
fn five_hundred_arrows_at_once_end_where_five_hundred_slow_ones_do() {
    let options = ["--set", "D=-0.9", "--set", "D3=0.3"];
    let mut slow = explorer(&options, &[], (80, 24));
    slow.types("[[");
    slow.quiet(QUIET);
    for _ in 0..100 {
        let frames = slow.frames();
        slow.types(&"\x1b[C".repeat(5));
        slow.wait("a frame", |terminal| terminal.frames() > frames);
    }
    slow.quiet(QUIET);
    let expected = picture(&slow);

    let mut fast = explorer(&options, &[], (80, 24));
    fast.types("[[");
    fast.quiet(QUIET);
    let before = fast.written.len();
    fast.types(&"\x1b[C".repeat(500));
    fast.wait("the same screen", |terminal| picture(terminal) == expected);
    fast.quiet(QUIET);
    let bytes = fast.written.len() - before;
    assert!(bytes < 50_000, "{bytes} bytes for 500 keys at once");
    slow.leave();
    fast.leave();
}

/// Keys that need an answer, each after a key that requests a new one, as a terminal sends them.
const HASTY: [(&str, &[&str]); 10] = [
    ("supercritical", &["\x1b[C", "i"]),
    ("supercritical", &["\x1b[C", "o"]),
    ("supercritical", &["\x1b[C", "w", "\x1b[C", "\t", "\r"]),
    ("supercritical", &["\x1b[C", "\t", "0", "+", "H", "\x1b[D", "\r"]),
    ("supercritical", &["\x1b[C", ":", "start-outside", "\r", "i"]),
    ("regimes", &["\x1b[C", "\t", "\x1b[C", "\x1b[A", "\r"]),
    ("energy", &["\x1b[C", "\t", "\x1b[A", "\r"]),
    ("linear", &["\x1b[C", "\x1b[20~", "\x1b[20~", "\x1b[18~"]),
    ("linear", &["\"", "a", "\x1b[C", "\x1b[C", "'", "a"]),
    ("plain", &["\x1b[C", "\x1b[15~", "i", "o", "d"]),
];

/// Number of silences after which two screens that still differ will remain different.
const MOST_SILENCES: usize = 40;

#[test]
fn keys_that_need_an_answer_end_on_the_same_screen_in_one_write_and_one_by_one() {
    all_at_once(&HASTY, |(scene, keys)| {
        let mut slow = explorer(&[scene], &[], (120, 40));
        for key in *keys {
            slow.types(key);
            slow.wait("the answers", |it| !it.text().contains("computing"));
            slow.quiet(QUIET);
        }
        let mut fast = explorer(&[scene], &[], (120, 40));
        fast.types(&keys.concat());
        // Either may be silent while computing.
        let mut end_alike = || {
            slow.quiet(QUIET);
            fast.quiet(QUIET);
            picture(&slow) == picture(&fast)
        };
        assert!(
            (0..MOST_SILENCES).any(|_| end_alike()),
            "{scene} {keys:?}:\n{}\n{}",
            slow.text(),
            fast.text()
        );
        slow.leave();
        fast.leave();
    });
}

#[test]
fn the_mouse_starts_a_motion_and_zooms_if_it_is_wanted() {
    let mut terminal = explorer(&["--mouse"], &[], (80, 24));
    let before = picture(&terminal);
    // A click right of the centre of the phase plane, then the wheel.
    terminal.types("\x1b[<0;45;12M\x1b[<0;45;12m");
    terminal.wait("a start", |terminal| picture(terminal) != before);
    terminal.quiet(QUIET);
    let started = picture(&terminal);
    terminal.types("\x1b[<64;45;12M");
    terminal.wait("a closer look", |terminal| picture(terminal) != started);
    terminal.types("u");
    terminal.wait_for("undo: q0");
    // F2 leaves the mouse to the terminal, then takes it again.
    terminal.types("\x1bOQ");
    terminal.wait_for("mouse off");
    terminal.wait("the end of the mouse's reports", |terminal| {
        String::from_utf8_lossy(&terminal.written).contains("\x1b[?1006l\x1b[?1000l")
    });
    terminal.types("\x1bOQ");
    terminal.wait_for("mouse on");
    terminal.leave();
    let without = explorer(&[], &[], (80, 24));
    assert!(!String::from_utf8_lossy(&without.written).contains("\x1b[?1000h"));
    without.leave();
}

/// The last text sent to the clipboard.
fn clipboard(terminal: &Terminal) -> String {
    let written = String::from_utf8_lossy(&terminal.written).into_owned();
    let (_, sequence) = written.rsplit_once("\x1b]52;c;").expect("a copy");
    let (coded, _) = sequence.split_once("\x1b\\").expect("a copy has an end");
    let decode = Command::new("base64")
        .arg("-d")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .and_then(|mut child| {
            let mut input = child.stdin.take().expect("a pipe");
            std::io::Write::write_all(&mut input, coded.as_bytes())?;
            drop(input);
            child.wait_with_output()
        });
    String::from_utf8(decode.unwrap().stdout).unwrap()
}

#[test]
fn a_copied_command_line_gives_the_numbers_on_the_screen() {
    let home = tempfile::tempdir().unwrap();
    let state = home.path().to_str().unwrap();
    let start = ["--set", "r=0.5", "--set", "q0=2"];
    let mut terminal = explorer(&start, &[("XDG_STATE_HOME", state)], (120, 40));
    terminal.wait_for("comes to rest at q = -0.116");
    terminal.types("\x19");
    terminal.wait_for("sent to the terminal");
    let line = clipboard(&terminal);
    assert_eq!(std::fs::read_to_string(home.path().join("hopfscope/copy.txt")).unwrap(), line);
    let (program, words) = line.split_once(' ').unwrap();
    assert_eq!(program, "hopfscope");
    let ran = Command::new(PROGRAM).args(words.split(' ')).output().unwrap();
    let answer = String::from_utf8(ran.stdout).unwrap();
    assert!(answer.contains("comes to rest at q = -0.116"), "{line}\n{answer}");
    terminal.types("\x1by");
    terminal.quiet(QUIET);
    assert!(clipboard(&terminal).contains(TITLE));
    terminal.leave();
}

#[test]
fn signals_end_it_with_their_exit_code() {
    let cases = [(Signal::TERM, 143), (Signal::HUP, 129), (Signal::INT, 130), (Signal::QUIT, 131)];
    all_at_once(&cases, |&(signal, code)| {
        let mut terminal = explorer(&[], &[], (80, 24));
        terminal.signal(signal);
        assert_eq!(terminal.end(), code, "{signal:?}");
        terminal.assert_restored();
    });
}

#[test]
fn ctrl_z_and_fg_bring_back_the_same_picture() {
    let shell = ["bash", "--norc", "--noprofile", "-i"];
    let mut terminal = Terminal::start(&shell, &[("PS1", "ready> ")], (80, 24), Answers::AtOnce);
    terminal.wait_for("ready> ");
    terminal.types(&format!("{PROGRAM}\r"));
    terminal.wait_for(TITLE);
    terminal.quiet(QUIET);
    let before = picture(&terminal);
    terminal.types("\x1a");
    terminal.wait_for("Stopped");
    assert!(!terminal.screen().alternate_screen() && !terminal.screen().hide_cursor());
    terminal.types("fg\r");
    terminal.wait("the picture again", |terminal| picture(terminal) == before);
    terminal.types("q");
    terminal.wait("the shell", |terminal| !terminal.screen().alternate_screen());
}

/// The first child of a process, once it has one.
#[cfg(target_os = "linux")]
fn child(terminal: &Terminal) -> Option<String> {
    let parent = terminal.process().as_raw_nonzero();
    let children = std::fs::read_to_string(format!("/proc/{parent}/task/{parent}/children"));
    children.ok()?.split_whitespace().next().map(|id| format!("/proc/{id}"))
}

#[test]
#[cfg(target_os = "linux")]
fn it_ends_when_its_terminal_goes_away() {
    let shell = ["bash", "--norc", "--noprofile", "-i"];
    let mut terminal = Terminal::start(&shell, &[("PS1", "ready> ")], (80, 24), Answers::AtOnce);
    terminal.wait_for("ready> ");
    terminal.types(&format!("{PROGRAM}\r"));
    terminal.wait_for(TITLE);
    let program = child(&terminal).expect("the shell has started it");
    assert!(std::fs::exists(&program).unwrap());
    // The shell leads the session; its end takes the terminal away from the program.
    terminal.signal(Signal::KILL);
    support::poll("the end of the program", || !std::fs::exists(&program).unwrap_or(false));
}

/// The control sequences in the output of a program, in the notation of the handbook.
fn sequences(written: &[u8]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let text = String::from_utf8_lossy(written);
    let mut rest = text.chars();
    while let Some(char) = rest.next() {
        let name = match char {
            '\x1b' => {
                let mut body: String = rest.next().into_iter().collect();
                if body == "[" {
                    while !body[1..].ends_with(|last: char| ('@'..='~').contains(&last)) {
                        body.push(rest.next().expect("a sequence has an end"));
                    }
                }
                if body == "]" {
                    while !body.ends_with("\x1b\\") {
                        body.push(rest.next().expect("a sequence has an end"));
                    }
                    body = body.replace('\x1b', "ESC");
                }
                written_as(&body)
            }
            '\r' => "CR".to_owned(),
            '\n' => "LF".to_owned(),
            '\x08' => "BS".to_owned(),
            control if control.is_control() => format!("{control:?}"),
            _ => continue,
        };
        found.insert(name);
    }
    found
}

/// The notation of the handbook for a sequence, given the part after the escape character.
fn written_as(body: &str) -> String {
    let (parameters, last) = body.split_at(body.len() - 1);
    let count = parameters.split(';').count();
    match (parameters.strip_prefix('[').unwrap_or(parameters), last, count) {
        (_, "m", _) => "ESC[...m".to_owned(),
        ("", "H", _) => "ESC[H".to_owned(),
        (_, "H", 1) => "ESC[rowH".to_owned(),
        (_, "H", 2) => "ESC[row;columnH".to_owned(),
        (_, "B" | "C" | "D", 1) => format!("ESC[n{last}"),
        _ => format!("ESC{body}"),
    }
}

#[test]
fn every_control_sequence_is_in_the_handbook() {
    let mut terminal = explorer(&[], &[], (80, 24));
    for keys in ["\x1b[C", "?", "\x1b[B", "\x1b", "\t\x1b[C", "\x0c", "G\x1b[D", "0.5\r"] {
        terminal.types(keys);
        terminal.quiet(QUIET);
    }
    terminal.resize(100, 30);
    terminal.quiet(QUIET);
    terminal.types("\x03");
    assert_eq!(terminal.end(), 0);
    let handbook =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/terminal.md"));
    let handbook = handbook.unwrap();
    let found = sequences(&terminal.written);
    assert!(found.len() > 12, "{found:?}");
    for sequence in found {
        assert!(handbook.contains(&format!("`{sequence}`")), "docs/terminal.md lacks {sequence}");
    }
}
