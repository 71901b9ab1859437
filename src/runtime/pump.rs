//! The loop: takes events, changes the session, asks the workers, draws.
//!
//! The loop waits in one place, the channel, and has no deadline when there is nothing to draw: an idle
//! explorer uses no processor time and writes no byte. After an event, it first takes all further events out of
//! the channel and then draws once, so that 500 keys at once cost one frame. A frame waits until the last one
//! is old enough and shown (see [`crate::terminal::pacing`]), and a moment for the worker, whose answer often
//! arrives within that time: one frame instead of two.

use std::collections::VecDeque;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender};
use ratatui::buffer::Buffer;
use ratatui::layout::Size;

use super::{
    Application, Compute, Event, Files, LoopEnd, Readers, RecordingFile, Workers, scan_file,
};
use crate::scene::Request;
use crate::session::replay::{LONGEST, Recorder, Script, ScriptError};
use crate::session::update::is_press;
use crate::session::{ComputedContent, Content, Effect, MouseAction, Msg, Notice};
use crate::terminal::{Cast, Screen};
use crate::view;

mod play;
mod playing;

use play::Replay;

/// How long a frame waits for the worker before it shows the old answers, marked as old.
const ANSWER_TIME: Duration = Duration::from_millis(8);

/// What the explorer is to do besides exploring.
#[derive(Default)]
pub struct Options {
    /// Keys to play at the start: each is given once the answers to the last one are on the screen.
    pub replay: Option<Script>,
    /// The steps that stand for this start in a recording, to which the user's actions are added; the command that
    /// plays the script in `replay` is the last of them.
    pub recorder: Recorder,
    /// The file to which the user's actions are recorded.
    pub record: Option<RecordingFile>,
    /// File for a session that is interrupted.
    pub keep: Option<PathBuf>,
    /// File for a session that the user quits.
    pub last: Option<PathBuf>,
    /// Whether the terminal reports the mouse at the start.
    pub mouse: bool,
    /// Destination of copies besides the clipboard.
    pub files: Files,
    /// Keeps every frame of a file that is played without a terminal.
    pub cast: Option<Cast>,
}

impl Options {
    /// Writes what was recorded since the last call, if there is a file for it. Fails with one line if it cannot
    /// be written.
    fn keep_record(&mut self) -> Result<(), String> {
        self.record.as_mut().map_or(Ok(()), |record| record.keep(&mut self.recorder))
    }
}

/// A step of the loop. Fails with why the loop ends or pauses there, if it does.
type Step = Result<(), LoopEnd>;

pub struct Pump<M, W: Write> {
    pub(super) application: M,
    screen: Screen<W>,
    workers: Workers,
    events: Receiver<Event>,
    /// Events that arrived while something else was awaited.
    missed: VecDeque<Event>,
    pub(super) options: Options,
    /// Time since which the state differs from the screen.
    changed: Option<Instant>,
    /// Time at which the session was last told how much time has passed, while something in it moves.
    beat: Option<Instant>,
    /// No frames are drawn while the terminal is given back.
    held: bool,
    playing: Option<Replay>,
    /// Input of the user that must wait until a replay or a command is over.
    held_back: VecDeque<Event>,
    /// Whether a file that takes time to make is being written.
    writing: bool,
    /// Whether there is no terminal: a file is played, and no frame drawn.
    unattended: bool,
    /// The pictures that this file asks for by name.
    kept: Vec<(String, Buffer)>,
    /// Its first expectation that was not met.
    unmet: Option<ScriptError>,
    terminal_size: fn() -> Size,
}

impl<M: Application, W: Write> Pump<M, W> {
    /// A loop that has drawn nothing yet, on both ends of its channel; `answer` computes what the application wants.
    pub fn new(
        application: M,
        screen: Screen<W>,
        answer: Arc<Compute>,
        (send, events): (Sender<Event>, Receiver<Event>),
        mut options: Options,
        terminal_size: fn() -> Size,
    ) -> Pump<M, W> {
        let mut playing = options.replay.take().map(Replay::new);
        if let Some(playing) = &mut playing {
            playing.player.in_frames = options.cast.is_some();
            // Its steps are recorded as they are given.
            options.recorder.forget(1);
        }
        let report = Arc::new(move |msg| drop(send.send(Event::Session(msg))));
        Pump {
            application,
            screen,
            workers: Workers::new(answer, report),
            events,
            missed: VecDeque::new(),
            options,
            changed: Some(Instant::now()),
            beat: None,
            held: false,
            playing,
            held_back: VecDeque::new(),
            writing: false,
            unattended: false,
            kept: Vec::new(),
            unmet: None,
            terminal_size,
        }
    }

    /// Runs until an event that concerns the whole process.
    pub fn run(&mut self) -> LoopEnd {
        loop {
            if let Err(end) = self.round() {
                return end;
            }
        }
    }

    /// Plays a step, asks the workers, waits for an event, and handles it and all that have come meanwhile.
    fn round(&mut self) -> Step {
        self.play()?;
        // Without a terminal, answers that are there are taken before more is asked for, and none between that and the
        // next step: what a file shows does not depend on how soon they come.
        while self.unattended
            && let Ok(event) = self.events.try_recv()
        {
            self.handle(event)?;
        }
        self.workers.ask(&self.application.wants());
        self.keep_record()?;
        let mut next = self.wait()?;
        while let Some(event) = next {
            self.handle(event)?;
            self.release();
            next = self.missed.pop_front().or_else(|| self.events.try_recv().ok());
        }
        Ok(())
    }

    /// Waits for the next event; draws and returns none if a frame is due first.
    fn wait(&mut self) -> io::Result<Option<Event>> {
        self.release();
        if let Some(event) = self.missed.pop_front() {
            return Ok(Some(event));
        }
        if self.unattended && self.changed.take().is_some() {
            return Ok(None);
        }
        let event = match self.due() {
            None => self.events.recv().map_err(RecvTimeoutError::from),
            Some(due) => self.events.recv_deadline(due),
        };
        match event {
            Ok(event) => Ok(Some(event)),
            Err(RecvTimeoutError::Timeout) => self.draw().map(|()| None),
            // All threads are gone; the one that reads the keys reports that before.
            Err(RecvTimeoutError::Disconnected) => Ok(Some(Event::End(LoopEnd::Closed))),
        }
    }

    /// Shows a notice in the session.
    pub fn tell(&mut self, notice: Notice) -> Step {
        self.update(Msg::Told(notice))
    }

    /// Stops drawing until [`Pump::repaint`], because the terminal is given back.
    pub fn hold(&mut self) {
        self.held = true;
        self.beat = None;
    }

    /// Draws again, on a terminal that was just taken.
    pub fn repaint(&mut self) -> io::Result<()> {
        self.held = false;
        self.resized();
        self.screen.probe(Instant::now(), self.application.asks_for_background())
    }

    /// Waits for an answer that the terminal owes, so that it does not arrive after the program has ended.
    pub fn await_terminal(&mut self) {
        while let Some(until) = self.screen.pacing.last_wait() {
            match self.events.recv_deadline(until) {
                Ok(Event::Shown) => drop(self.screen.pacing.answered(Instant::now())),
                Ok(event) => self.missed.push_back(event),
                Err(_) => return,
            }
        }
    }

    fn handle(&mut self, event: Event) -> Step {
        match event {
            Event::Session(msg) if is_press(&msg) => return self.users(msg),
            Event::Session(msg) => {
                if let Msg::Written(notice) = &msg {
                    self.writing = false;
                    self.note_unwritten(notice);
                }
                self.workers.arrived(&msg);
                return self.update(msg);
            }
            Event::Mouse { gesture, column, row } => {
                if let Some(place) = self.application.place(self.screen.size(), column, row) {
                    return self.users(Msg::Pointed(MouseAction { gesture, place }));
                }
            }
            Event::Shown => drop(self.screen.pacing.answered(Instant::now())),
            Event::Background { is_light } => {
                self.application.background(is_light);
                self.changed.get_or_insert_with(Instant::now);
            }
            Event::Resized => self.resized(),
            Event::End(end) => return Err(end),
        }
        Ok(())
    }

    /// Follows the size of the terminal, and draws everything again even if that is the size it was: in between
    /// it may have been another one, which has moved or cut what is on the screen.
    fn resized(&mut self) {
        self.screen.repaint((self.terminal_size)());
        let Size { width, height } = self.screen.size();
        let msg = Msg::Resize { width, height };
        self.options.recorder.note(&msg);
        // A resize has no effects.
        drop(self.application.update(msg));
        self.changed.get_or_insert_with(Instant::now);
    }

    /// Changes the session and carries out the resulting effects in their order.
    fn update(&mut self, msg: Msg) -> Step {
        self.changed.get_or_insert_with(Instant::now);
        for effect in self.application.update(msg) {
            self.carry_out(effect)?;
        }
        Ok(())
    }

    fn copy(&mut self, text: &str) -> Step {
        self.screen.control(&Files::clipboard(text))?;
        self.told(self.options.files.copy(text).into(), Msg::Told)
    }

    /// Writes a file, and tells the session what became of it.
    fn write(&mut self, path: &Path, content: Content, replace: bool) -> Step {
        let place = self.options.files.place(path);
        let path = place.as_deref().unwrap_or(path);
        let done = match content {
            Content::Computed(content) => return self.make(path, content, replace),
            Content::Record { forget } => self.write_record(path, forget, replace),
            Content::Scan(scan, rows) => scan_file::save(path, &scan, &rows),
            Content::Text(text) => Files::write(path, text, replace, Readers::Owner),
        };
        self.told(done.into(), Msg::Told)
    }

    /// Begins to make and write files; if that fails, the session is told why.
    fn make(&mut self, path: &Path, content: ComputedContent, replace: bool) -> Step {
        let begun = Files::admit(path, replace)
            .and_then(|()| self.application.make(path, content, &self.options.recorder))
            .and_then(|work| self.workers.write(path, replace, work));
        let Err(text) = begun else {
            self.writing = true;
            return Ok(());
        };
        self.told(Notice { error: true, text }, Msg::Written)
    }

    /// Writes the recording to a file, without the key presses that asked for this.
    fn write_record(&self, path: &Path, forget: u32, replace: bool) -> Result<String, String> {
        RecordingFile::admit(path, replace, "add ! to overwrite")?;
        let mut recorder = self.options.recorder.clone();
        recorder.forget(forget);
        Files::write(path, recorder.text(), true, Readers::Owner)
    }

    /// When to draw; `None` if the screen is up to date and nothing moves.
    fn due(&self) -> Option<Instant> {
        if self.held {
            return None;
        }
        let Some(changed) = self.changed else {
            // Motion is drawn as often as its bytes and the line allow.
            let beat = self.beat.filter(|_| self.application.is_moving())?;
            return Some((beat + self.screen.pause()).max(self.screen.pacing.next(beat)));
        };
        let is_long = self.workers.asked().all(Request::is_long);
        let patience = if is_long { Duration::ZERO } else { ANSWER_TIME };
        Some((changed + patience).max(self.screen.pacing.next(changed)))
    }

    /// Tells the session how much time has passed since it was last told, while something in it moves.
    fn pass_time(&mut self) {
        let now = Instant::now();
        let last = self.beat.replace(now);
        if let Some(last) = last.filter(|_| self.application.is_moving()) {
            let msg = Msg::Elapsed { seconds: (now - last).as_secs_f64().min(LONGEST) };
            self.options.recorder.note(&msg);
            // The passing of time has no effects.
            drop(self.application.update(msg));
        }
        self.beat = self.beat.filter(|_| self.application.is_moving());
    }

    fn draw(&mut self) -> io::Result<()> {
        self.pass_time();
        let picture = self.application.picture(self.screen.size());
        self.screen.draw(Instant::now(), picture)?;
        self.changed = None;
        Ok(())
    }

    /// Tells the application by a message what became of an effect, which may have further effects.
    fn told(&mut self, notice: Notice, message: fn(Notice) -> Msg) -> Step {
        self.note_unwritten(&notice);
        self.update(message(notice))
    }

    fn carry_out(&mut self, effect: Effect) -> Step {
        if let Some(text) = self.withheld(&effect) {
            let awaited = matches!(&effect, Effect::Write { content: Content::Computed(_), .. });
            let message = if awaited { Msg::Written } else { Msg::Told };
            let notice = Notice { error: true, text };
            return if notice.text.is_empty() {
                Ok(())
            } else {
                self.told(notice, message)
            };
        }
        match effect {
            Effect::Quit => return Err(LoopEnd::Quit),
            Effect::Suspend => return Err(LoopEnd::Suspend),
            Effect::Mouse(on) => return Err(LoopEnd::Mouse(on)),
            Effect::Repaint => self.resized(),
            Effect::StopWriting => self.workers.stop_writing(),
            Effect::PutAside(path) => Files::put_aside(&path),
            Effect::Write { path, content, replace } => self.write(&path, content, replace)?,
            Effect::Read { path, purpose } => {
                let result = self.read(&path);
                self.update(Msg::Read { path, purpose, result })?;
            }
            Effect::Play(script) => self.begin(script)?,
            Effect::Copy(text) => self.copy(&text)?,
            Effect::CopyScreen => {
                let picture = self.application.picture(self.screen.size());
                self.copy(&view::screen::text(&picture))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
