//! A terminal for tests: a real pty with an emulator behind it.
//!
//! Everything waits for a condition with a deadline, never for a fixed time. The emulator answers requests for
//! the cursor position like a terminal, unless a test wants it slow or silent.

// The benchmark compiles this file, too, and uses only a part of it.
#![allow(dead_code)]

use std::io::{Read, Write};
use std::num::NonZero;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use rustix::process::{Pid, Signal, kill_process};
use rustix::termios::{LocalModes, tcgetattr};

/// Checks all cases at once, each with a terminal of its own: most of their time is waiting.
pub fn all_at_once<T: Sync>(cases: &[T], check: impl Fn(&T) + Sync) {
    std::thread::scope(|scope| {
        for case in cases {
            scope.spawn(|| check(case));
        }
    });
}

/// Time within which a screen must be as expected, however busy the machine is.
const DEADLINE: Duration = Duration::from_secs(120);

/// Time within which a program must end, or anything else happen.
const SHORT: Duration = Duration::from_secs(30);

/// The program under test.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_hopfscope");

/// Text in the title of the plain scene.
pub const TITLE: &str = "The plain oscillator";

/// Silence after which a picture is complete: the program sends a frame within 16 ms.
pub const QUIET: Duration = Duration::from_millis(200);

/// A request for the cursor position.
const REQUEST: &[u8] = b"\x1b[6n";

/// How the terminal answers requests for the cursor position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answers {
    /// As soon as they are read.
    AtOnce,
    /// When the test asks for it.
    WhenTold,
    /// Never.
    Never,
}

/// A program in a terminal.
pub struct Terminal {
    master: Box<dyn MasterPty + Send>,
    keyboard: Box<dyn Write + Send>,
    child: Box<dyn Child + Send + Sync>,
    output: Receiver<Vec<u8>>,
    screen: vt100::Parser,
    /// All output of the program so far.
    pub written: Vec<u8>,
    /// How the terminal answers.
    pub answers: Answers,
    /// Number of requests not answered yet.
    owed: usize,
    /// Length of the output searched for requests.
    searched: usize,
    /// Length of the output passed to the emulator.
    emulated: usize,
}

/// Polls a condition until it holds.
pub fn poll(what: &str, mut condition: impl FnMut() -> bool) {
    let deadline = Instant::now() + SHORT;
    while !condition() {
        assert!(Instant::now() < deadline, "no {what} in time");
        std::thread::yield_now();
    }
}

fn size(columns: u16, rows: u16) -> PtySize {
    PtySize { cols: columns, rows, pixel_width: 0, pixel_height: 0 }
}

fn cells(number: u16) -> NonZero<u16> {
    NonZero::new(number).expect("a terminal has cells")
}

impl Terminal {
    /// Starts a program in a terminal. The environment has only what a UTF-8 terminal has, and what
    /// `environment` adds or overrides; an empty value removes a variable.
    pub fn start(
        program: &[&str],
        environment: &[(&str, &str)],
        (columns, rows): (u16, u16),
        answers: Answers,
    ) -> Terminal {
        let pair = native_pty_system().openpty(size(columns, rows)).unwrap();
        let mut command = CommandBuilder::new(program[0]);
        command.args(&program[1..]);
        command.env_clear();
        let usual = [("PATH", "/usr/bin:/bin"), ("TERM", "xterm-256color"), ("LANG", "C.UTF-8")];
        for (name, value) in usual.iter().chain(environment) {
            command.env(name, value);
        }
        for (name, _) in environment.iter().filter(|(_, value)| value.is_empty()) {
            command.env_remove(name);
        }
        let child = pair.slave.spawn_command(command).unwrap();
        let mut reader = pair.master.try_clone_reader().unwrap();
        let (send, output) = channel();
        std::thread::spawn(move || {
            let mut buffer = vec![0; 65536];
            while let Ok(count @ 1..) = reader.read(&mut buffer) {
                if send.send(buffer[..count].to_vec()).is_err() {
                    break;
                }
            }
        });
        Terminal {
            keyboard: pair.master.take_writer().unwrap(),
            master: pair.master,
            child,
            output,
            screen: vt100::Parser::new(cells(rows), cells(columns), 0),
            written: Vec::new(),
            answers,
            owed: 0,
            searched: 0,
            emulated: 0,
        }
    }

    /// Starts the explorer and waits for its first picture.
    pub fn explorer(
        arguments: &[&str],
        environment: &[(&str, &str)],
        size: (u16, u16),
    ) -> Terminal {
        let program = [&[PROGRAM], arguments].concat();
        let mut terminal = Terminal::start(&program, environment, size, Answers::AtOnce);
        terminal.wait("the first picture", |terminal| terminal.screen().alternate_screen());
        terminal
    }

    /// Types bytes.
    pub fn types(&mut self, bytes: &str) {
        self.keyboard.write_all(bytes.as_bytes()).unwrap();
        self.keyboard.flush().unwrap();
    }

    /// Changes the size of the terminal.
    pub fn resize(&mut self, columns: u16, rows: u16) {
        self.screen.screen_mut().set_size(cells(rows), cells(columns));
        self.master.resize(size(columns, rows)).unwrap();
    }

    /// The characters on the screen, with minus signs replaced by hyphens.
    pub fn text(&self) -> String {
        self.screen.screen().contents().replace('\u{2212}', "-")
    }

    /// Content and style of every cell, as far as they are seen: a blank has no colour but that of its ground.
    pub fn cells(&self) -> Vec<String> {
        let screen = self.screen();
        let (rows, columns) = screen.size();
        let all =
            (0..rows.get()).flat_map(|row| (0..columns.get()).map(move |column| (row, column)));
        let seen = |(row, column)| {
            let cell = screen.cell(row, column).expect("a cell of the screen");
            if cell.contents().trim().is_empty() && !cell.inverse() && !cell.underline() {
                return format!("{:?}", cell.bgcolor());
            }
            format!("{cell:?}")
        };
        all.map(seen).collect()
    }

    /// The emulated screen.
    pub fn screen(&self) -> &vt100::Screen {
        self.screen.screen()
    }

    /// The process id of the program.
    pub fn process(&self) -> Pid {
        let id = self.child.process_id().expect("the program was started");
        Pid::from_raw(i32::try_from(id).unwrap()).unwrap()
    }

    /// Whether all threads of the program sleep: it has read what was typed, and computes nothing. Always so where the
    /// system does not tell.
    pub fn sleeps(&self) -> bool {
        let process = self.process().as_raw_nonzero();
        let Ok(threads) = std::fs::read_dir(format!("/proc/{process}/task")) else { return true };
        threads.flatten().all(|thread| {
            let state = std::fs::read_to_string(thread.path().join("stat"));
            // A thread that has just ended computes nothing, either.
            state.ok().is_none_or(|state| state.contains(") S "))
        })
    }

    /// Sends a signal to the program.
    pub fn signal(&self, signal: Signal) {
        kill_process(self.process(), signal).unwrap();
    }

    /// Whether the terminal echoes keys and collects lines, as in a shell.
    pub fn is_cooked(&self) -> bool {
        let name = self.master.tty_name().expect("a pty has a name");
        let terminal = std::fs::File::open(name).unwrap();
        let modes = tcgetattr(&terminal).unwrap().local_modes;
        modes.contains(LocalModes::ECHO | LocalModes::ICANON)
    }

    /// Reads what the program has written; `false` if there is no more and will be none.
    fn listen(&mut self, until: Instant) -> bool {
        let time = until.saturating_duration_since(Instant::now());
        match self.output.recv_timeout(time) {
            Ok(bytes) => {
                self.written.extend(bytes);
                self.emulate();
                let new = &self.written[self.searched..];
                let requests: Vec<usize> = new
                    .windows(REQUEST.len())
                    .enumerate()
                    .filter(|(_, window)| *window == REQUEST)
                    .map(|(place, _)| place)
                    .collect();
                if let Some(last) = requests.last() {
                    self.searched += last + REQUEST.len();
                }
                self.owed += requests.len();
                if self.answers == Answers::AtOnce {
                    self.answer();
                }
                true
            }
            Err(RecvTimeoutError::Timeout) => true,
            Err(RecvTimeoutError::Disconnected) => false,
        }
    }

    /// Passes the output to the emulator in whole characters: if a read ends inside one, vte 0.15 loses an
    /// ASCII character that follows.
    fn emulate(&mut self) {
        let new = &self.written[self.emulated..];
        let whole = match std::str::from_utf8(new) {
            Err(error) if error.error_len().is_none() => error.valid_up_to(),
            _ => new.len(),
        };
        self.screen.process(&new[..whole]);
        self.emulated += whole;
    }

    /// Answers all requests for the cursor position.
    pub fn answer(&mut self) {
        let (row, column) = self.screen.screen().cursor_position();
        for _ in 0..std::mem::take(&mut self.owed) {
            // The program may have ended in the meantime.
            let _ = write!(self.keyboard, "\x1b[{};{}R", row + 1, column + 1);
        }
    }

    /// Number of requests for the cursor position not answered yet.
    pub fn owed(&self) -> usize {
        self.owed
    }

    /// Waits until the condition holds; `what` describes it in the failure message.
    pub fn wait(&mut self, what: &str, condition: impl Fn(&Terminal) -> bool) {
        let deadline = Instant::now() + DEADLINE;
        while !condition(self) {
            let alive = self.listen(deadline);
            assert!(alive || condition(self), "the program ended before {what}\n{}", self.text());
            assert!(Instant::now() < deadline, "no {what} in time\n{}", self.text());
        }
    }

    /// Waits until the screen shows this text.
    pub fn wait_for(&mut self, text: &str) {
        self.wait(text, |terminal| terminal.text().contains(text));
    }

    /// Number of bytes that arrive until there are none for this long.
    pub fn quiet(&mut self, time: Duration) -> usize {
        let before = self.written.len();
        let mut last = (before, Instant::now());
        while last.1.elapsed() < time && self.listen(last.1 + time) {
            if self.written.len() > last.0 {
                last = (self.written.len(), Instant::now());
            }
        }
        self.written.len() - before
    }

    /// Waits until everything is computed and shown.
    pub fn rest(&mut self) {
        const LONG: Duration = Duration::from_millis(150);
        let works = ["computing", "waiting for", "stale"];
        let deadline = Instant::now() + DEADLINE;
        loop {
            self.quiet(LONG);
            // A busy machine is silent before it has read the keys, too.
            let slept = self.sleeps();
            let silent = self.quiet(LONG) == 0;
            let shown = self.text();
            if slept && silent && self.sleeps() && works.iter().all(|word| !shown.contains(word)) {
                return;
            }
            let alive = self.child.try_wait().unwrap().is_none();
            assert!(alive && Instant::now() < deadline, "no rest in time\n{shown}");
        }
    }

    /// Number of bytes of the next piece of output; 0 if none comes within this time.
    pub fn next(&mut self, time: Duration) -> usize {
        let before = self.written.len();
        self.listen(Instant::now() + time);
        self.written.len() - before
    }

    /// Number of bytes that arrive within this time.
    pub fn watch(&mut self, time: Duration) -> usize {
        let before = self.written.len();
        let until = Instant::now() + time;
        while Instant::now() < until && self.listen(until) {}
        self.written.len() - before
    }

    /// Number of frames written.
    pub fn frames(&self) -> usize {
        let begin = b"\x1b[?2026h";
        self.written.windows(begin.len()).filter(|window| *window == begin).count()
    }

    /// Waits for the end of the program and returns its exit code.
    pub fn end(&mut self) -> u32 {
        let deadline = Instant::now() + SHORT;
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                // Its last output may still be in transit: the terminal closes after it.
                while Instant::now() < deadline && self.listen(deadline) {}
                return status.exit_code();
            }
            assert!(Instant::now() < deadline, "the program does not end\n{}", self.text());
            self.listen(Instant::now() + Duration::from_millis(20));
        }
    }

    /// Leaves with `q`, and checks the state of the terminal.
    pub fn leave(mut self) {
        self.types("q");
        assert_eq!(self.end(), 0);
        self.assert_restored();
    }

    /// Fails unless every mode that the program turned on is off again.
    pub fn assert_restored(&self) {
        let screen = self.screen();
        assert!(!screen.alternate_screen(), "alternate screen left on");
        assert!(!screen.hide_cursor(), "cursor left hidden");
        assert!(!screen.bracketed_paste(), "bracketed paste left on");
        let text = String::from_utf8_lossy(&self.written);
        let mut on = std::collections::BTreeSet::new();
        for sequence in text.split("\x1b[?").skip(1) {
            let end = sequence.find(|c: char| !c.is_ascii_digit()).unwrap_or(sequence.len());
            let (mode, rest) = sequence.split_at(end);
            match rest.chars().next() {
                Some('h') => drop(on.insert(mode)),
                Some('l') => drop(on.remove(mode)),
                _ => {}
            }
        }
        // The cursor is the only mode that is on in a shell.
        assert_eq!(on.into_iter().collect::<Vec<_>>(), ["25"], "modes that are on");
        assert!(self.is_cooked(), "raw mode left on");
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
