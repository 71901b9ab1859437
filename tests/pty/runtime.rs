//! The loop, the worker and the guard in a real terminal, around a small application that can be told to
//! misbehave: panics, slow answers of the terminal, signals, job control.
//!
//! The application runs in a separate process: this test program, started again in a pty.

use std::path::PathBuf;
use std::time::Duration;

use crate::support::{Answers, Terminal};
use hopfscope::flow::{Cost, Limits, Reason};
use hopfscope::model::{Parameters, State};
use hopfscope::runtime::workers::Tell;
use hopfscope::runtime::{Application, Options, launch};
use hopfscope::scene::{Finding, Reply, Request};
use hopfscope::session::{Code, Effect, Key, Msg};
use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect, Size};
use ratatui::widgets::Widget;
use rustix::process::Signal;

/// Counts right arrows and has each count confirmed by the worker.
#[derive(Default)]
struct Machinery {
    count: u32,
    confirmed: Option<Result<u32, String>>,
    size: (u16, u16),
    pasted: usize,
    told: String,
}

/// The request that encodes a number.
fn request(number: u32) -> Request {
    let parameters = Parameters { d: f64::from(number), d2: 0.0, d3: 0.0, r: 0.0 };
    Request::Capture { parameters, reach: 1.0, most: 1 }
}

/// The worker, which panics at 3.
fn confirm(request: &Request, _: &Limits, _: &Tell) -> Result<Finding, Reason> {
    let Request::Capture { parameters, .. } = *request else {
        return Err(Reason::OutOfRange);
    };
    assert!(parameters.d != 3.0, "three is too much");
    let point = State { q: parameters.d, v: 0.0 };
    Ok(Finding::Capture(vec![vec![point]], Cost::default()))
}

impl Application for Machinery {
    fn update(&mut self, msg: Msg) -> Vec<Effect> {
        match msg {
            Msg::Key(Key { code: Code::Right, .. }) => {
                self.count += 1;
                self.confirmed = None;
            }
            Msg::Key(Key { code: Code::Char('q'), .. }) => return vec![Effect::Quit],
            Msg::Key(Key { code: Code::Char('z'), control: true, .. }) => {
                return vec![Effect::Suspend];
            }
            Msg::Key(Key { code: Code::Char('p'), .. }) => panic!("told to panic"),
            Msg::Told(notice) => self.told = notice.text,
            Msg::Paste(text) => self.pasted = text.lines().count(),
            Msg::Resize { width, height } => self.size = (width, height),
            Msg::Answered(reply) => {
                let Reply { result, .. } = *reply;
                self.confirmed =
                    Some(result.map(|_| self.count).map_err(|failure| failure.to_string()));
            }
            _ => {}
        }
        vec![]
    }

    fn wants(&self) -> Vec<Request> {
        if self.confirmed.is_none() {
            vec![request(self.count)]
        } else {
            vec![]
        }
    }

    fn what_to_keep(&self) -> Option<String> {
        Some(format!("count {}", self.count))
    }

    fn picture(&self, size: Size) -> Buffer {
        let (width, height) = self.size;
        let confirmed = match &self.confirmed {
            None => "...".to_owned(),
            Some(Ok(number)) => format!("confirmed {number}"),
            Some(Err(why)) => why.clone(),
        };
        let text = format!(
            "count {} {confirmed}\nsize {width}x{height}\npasted {}\n{}",
            self.count, self.pasted, self.told
        );
        let mut buffer = Buffer::empty(Rect::from((Position::ORIGIN, size)));
        text.render(buffer.area, &mut buffer);
        buffer
    }
}

/// Not a test: the program that the tests start in a pty.
#[test]
#[ignore = "the program that the other tests start"]
fn machinery() {
    let keep = std::env::var_os("KEEP").map(PathBuf::from);
    let options = Options { keep, ..Options::default() };
    let ended = launch(Machinery::default(), std::sync::Arc::new(confirm), options).unwrap();
    let failed = ended != 0;
    println!(
        "{}",
        if failed {
            "ended by a signal"
        } else {
            "left by the user"
        }
    );
    std::process::exit(if failed { 77 } else { 0 });
}

/// The command that starts the application.
fn program() -> Vec<String> {
    let this = std::env::current_exe().unwrap().to_str().unwrap().to_owned();
    let arguments = ["--exact", "runtime::machinery", "--ignored", "--nocapture"];
    std::iter::once(this).chain(arguments.map(str::to_owned)).collect()
}

fn start(answers: Answers) -> Terminal {
    start_in(&[], answers)
}

fn start_in(environment: &[(&str, &str)], answers: Answers) -> Terminal {
    let program = program();
    let program: Vec<&str> = program.iter().map(String::as_str).collect();
    let mut terminal = Terminal::start(&program, environment, (80, 24), answers);
    terminal.wait_for("count 0 confirmed 0");
    terminal
}

#[test]
fn it_starts_draws_and_leaves_the_terminal_as_it_was() {
    let mut terminal = start(Answers::AtOnce);
    assert!(terminal.screen().alternate_screen() && terminal.screen().hide_cursor());
    assert!(terminal.screen().bracketed_paste() && !terminal.is_cooked());
    terminal.types("\x1b[C");
    terminal.wait_for("count 1 confirmed 1");
    terminal.types("q");
    assert_eq!(terminal.end(), 0);
    terminal.assert_restored();
    assert!(terminal.text().contains("left by the user"));
}

#[test]
fn what_was_done_is_kept_however_it_is_interrupted_and_not_when_it_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept");
    let started = |keys: &str| {
        let mut terminal = start_in(&[("KEEP", path.to_str().unwrap())], Answers::AtOnce);
        terminal.types(keys);
        terminal.wait_for("count 1 confirmed 1");
        terminal
    };
    let kept = || std::fs::read_to_string(&path).ok();
    let mut terminal = started("\x1b[C");
    terminal.types("q");
    assert_eq!((terminal.end(), kept()), (0, None));
    let ends: [fn(&mut Terminal); 3] = [
        |terminal| terminal.types("p"),
        |terminal| terminal.signal(Signal::TERM),
        |terminal| terminal.signal(Signal::HUP),
    ];
    for end in ends {
        let mut terminal = started("\x1b[C");
        end(&mut terminal);
        assert_ne!(terminal.end(), 0);
        terminal.assert_restored();
        assert_eq!(kept().as_deref(), Some("count 1"));
        std::fs::remove_file(&path).unwrap();
    }
}

#[test]
fn it_follows_the_size_and_repaints() {
    let mut terminal = start(Answers::AtOnce);
    for (columns, rows) in [(1, 1), (500, 200), (30, 3), (80, 24)] {
        terminal.resize(columns, rows);
        if columns > 20 {
            terminal.wait_for(&format!("size {columns}x{rows}"));
            terminal.wait_for("count 0 confirmed 0");
        }
    }
    terminal.leave();
}

#[test]
fn while_a_frame_is_under_way_no_other_is_sent() {
    let mut terminal = start(Answers::AtOnce);
    terminal.quiet(Duration::from_millis(100));
    terminal.answers = Answers::WhenTold;
    let before = terminal.frames();
    terminal.types("\x1b[C");
    terminal.wait("a frame", |terminal| terminal.frames() > before);
    for _ in 0..15 {
        terminal.types("\x1b[C");
        // Longer than the minimum time between frames.
        terminal.watch(Duration::from_millis(20));
    }
    assert_eq!(terminal.frames(), before + 1, "frames queue behind a slow terminal");
    terminal.answer();
    terminal.wait_for("count 16 confirmed 16");
    assert_eq!(terminal.frames(), before + 2, "more than the newest state was drawn");
    terminal.answers = Answers::AtOnce;
    terminal.answer();
    terminal.leave();
}

#[test]
fn a_silent_terminal_is_still_served_and_soon_no_longer_queried() {
    let mut terminal = start(Answers::Never);
    for count in 1..=40 {
        terminal.types("\x1b[C");
        terminal.wait_for(&format!("count {count} "));
    }
    let owed = terminal.owed();
    assert!((1..=16).contains(&owed), "{owed} requests");
    terminal.leave();
}

#[test]
fn an_answer_still_under_way_at_the_end_does_not_reach_the_shell() {
    let mut terminal = start(Answers::AtOnce);
    terminal.quiet(Duration::from_millis(100));
    terminal.answers = Answers::WhenTold;
    let before = terminal.owed();
    terminal.types("\x1b[C");
    terminal.wait("a request", |terminal| terminal.owed() > before);
    terminal.types("q");
    // While it waits for the answer, it still holds the terminal.
    terminal.watch(Duration::from_millis(50));
    assert!(terminal.screen().alternate_screen());
    terminal.answer();
    assert_eq!(terminal.end(), 0);
    terminal.assert_restored();
}

#[test]
fn five_hundred_arrows_at_once_are_not_five_hundred_frames() {
    let mut terminal = start(Answers::AtOnce);
    let before = terminal.frames();
    terminal.types(&"\x1b[C".repeat(500));
    terminal.wait_for("count 500 confirmed 500");
    let frames = terminal.frames() - before;
    assert!(frames <= 20, "{frames} frames");
    terminal.leave();
}

#[test]
fn five_hundred_arrows_and_then_q_are_all_handled() {
    let mut terminal = start(Answers::AtOnce);
    terminal.types(&("\x1b[C".repeat(500) + "q"));
    assert_eq!(terminal.end(), 0);
    terminal.assert_restored();
}

#[test]
fn a_paste_is_one_message() {
    let mut terminal = start(Answers::AtOnce);
    terminal.types(&format!("\x1b[200~{}\x1b[201~", "q\r".repeat(1000)));
    terminal.wait_for("pasted 1000");
    terminal.leave();
}

#[test]
fn a_panic_of_the_interface_restores_the_terminal_and_is_reported() {
    let mut terminal = start(Answers::AtOnce);
    terminal.types("p");
    assert_eq!(terminal.end(), 101);
    terminal.assert_restored();
    // Reported on the screen visible afterwards, not on the alternate screen, which is gone.
    assert!(terminal.text().contains("told to panic"), "{}", terminal.text());
}

#[test]
fn a_panic_of_the_worker_is_shown_and_survived() {
    let mut terminal = start(Answers::AtOnce);
    terminal.types("\x1b[C\x1b[C\x1b[C");
    terminal.wait_for("internal error: three is too much (");
    assert!(terminal.screen().alternate_screen() && !terminal.is_cooked());
    terminal.types("\x1b[C");
    terminal.wait_for("count 4 confirmed 4");
    terminal.leave();
}

#[test]
fn a_signal_ends_it_and_the_terminal_is_restored() {
    for signal in [Signal::TERM, Signal::HUP, Signal::INT, Signal::QUIT] {
        let mut terminal = start(Answers::AtOnce);
        terminal.signal(signal);
        assert_eq!(terminal.end(), 77, "{signal:?}");
        terminal.assert_restored();
    }
}

#[test]
fn without_job_control_nothing_stops_it() {
    // The program leads its session, as under `ssh -t`: nothing could continue it.
    let mut terminal = start(Answers::AtOnce);
    terminal.types("\x1a\x1b[C");
    terminal.wait_for("count 1 confirmed 1");
    terminal.wait_for("there is no shell");
    terminal.signal(Signal::TSTP);
    terminal.types("\x1b[C");
    terminal.wait_for("count 2 confirmed 2");
    terminal.leave();
}

/// A shell with job control that has started the application.
fn start_in_shell() -> Terminal {
    let shell = ["bash", "--norc", "--noprofile", "-i"];
    let mut terminal = Terminal::start(&shell, &[("PS1", "ready> ")], (80, 24), Answers::AtOnce);
    terminal.wait_for("ready> ");
    terminal.types(&(program().join(" ") + "\r"));
    terminal.wait_for("count 0 confirmed 0");
    terminal
}

/// Quits the application and then the shell, once it has its terminal back.
fn leave_shell(mut terminal: Terminal) {
    terminal.types("q");
    terminal.wait("a prompt after the end", |terminal| {
        let text = terminal.text();
        text.split("left by the user").nth(1).is_some_and(|after| after.contains("ready> "))
    });
    terminal.types("exit\r");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn ctrl_z_gives_the_terminal_to_the_shell_and_fg_brings_the_picture_back() {
    let mut terminal = start_in_shell();
    for count in 1..=2 {
        terminal.types("\x1b[C");
        terminal.wait_for(&format!("count {count} confirmed {count}"));
        terminal.types("\x1a");
        terminal.wait("the shell", |terminal| {
            let stops = terminal.text().matches("Stopped").count();
            !terminal.screen().alternate_screen() && stops == count
        });
        assert!(!terminal.screen().hide_cursor());
        terminal.types("fg\r");
        terminal.wait_for(&format!("count {count} confirmed {count}"));
        assert!(terminal.screen().alternate_screen() && !terminal.is_cooked());
        terminal.types("\x0c");
    }
    leave_shell(terminal);
}

#[test]
fn a_size_that_changed_while_it_was_stopped_is_noticed() {
    let mut terminal = start_in_shell();
    terminal.types("\x1a");
    terminal.wait_for("Stopped");
    terminal.resize(100, 30);
    terminal.types("fg\r");
    terminal.wait_for("size 100x30");
    leave_shell(terminal);
}
