//! Files played in the loop, the effect of the user's keys meanwhile, and what is recorded.
//!
//! A recording has the steps that a replay has given to the session instead of the command that asked for it. Without a
//! terminal nothing waits for time to pass, no frame is drawn, and the end of the file is that of the loop.

use std::io::Write;
use std::path::Path;

use ratatui::layout::Size;

use super::play::{Pause, RIGHT, Replay, SHOWN};
use super::{Application, Files, Pump, Step};
use crate::flow::Limits;
use crate::runtime::{Event, LoopEnd, ReplayResult};
use crate::session::read::contexts::forgets;
use crate::session::replay::{Action, Script, ScriptError};
use crate::session::{Code, Content, Effect, Key, Msg, Notice};
use crate::view;

/// Keys that go back to the previous caption, including those of a presenter's remote control.
const BACK: [Code; 3] = [Code::Backspace, Code::Left, Code::PageUp];

/// Whether a message is Ctrl-C, which leaves whatever is open, whichever keys the user has chosen.
fn leaves(msg: &Msg) -> bool {
    matches!(msg, Msg::Key(Key { code: Code::Char('c'), control: true, .. }))
}

fn is_key(msg: &Msg, code: Code) -> bool {
    matches!(msg, Msg::Key(key) if *key == Key::plain(code))
}

impl<M: Application, W: Write> Pump<M, W> {
    /// Handles input of the user: gives it to the session or, while something is played, to the replay.
    pub(super) fn users(&mut self, msg: Msg) -> Step {
        let Some(playing) = &mut self.playing else {
            if self.application.is_waiting() {
                if !forgets(&msg) && !leaves(&msg) {
                    self.held_back.push_back(Event::Session(msg));
                    return Ok(());
                }
                // The waiting command has not been carried out, and never will be.
                self.options.recorder.forget(1);
                self.held_back.clear();
                if forgets(&msg) {
                    return self.update(msg);
                }
            }
            return self.record(msg);
        };
        let caption = playing.pause == Pause::Caption;
        let opens = matches!(msg, Msg::Key(key) if self.application.tries(key));
        if playing.player.has_task() && (opens || !(is_key(&msg, Code::Esc) || leaves(&msg))) {
            playing.shows = is_key(&msg, Code::PageDown) && !opens;
            return if playing.shows { Ok(()) } else { self.record(msg) };
        }
        if caption && opens {
            playing.tried = true;
            return self.record(msg);
        }
        if is_key(&msg, Code::Esc) {
            return self.played(false, "replay stopped".to_owned());
        }
        if leaves(&msg) {
            return Err(LoopEnd::Quit);
        }
        if caption && BACK.iter().any(|code| is_key(&msg, *code)) {
            if let Some(passed) = playing.player.said().checked_sub(2) {
                playing.again(passed);
            }
        } else if let (true, Msg::Key(key)) = (caption, &msg) {
            playing.goes_on(*key);
        } else if is_key(&msg, Code::Char('q')) {
            return Err(LoopEnd::Quit);
        } else if is_key(&msg, Code::Char(' ')) {
            let wished = playing.pause == Pause::Wished;
            playing.pause = if wished { Pause::Not } else { Pause::Wished };
            let text = if wished {
                ""
            } else {
                "replay paused: space continues, esc stops, q leaves"
            };
            return self.tell(Notice { error: false, text: text.to_owned() });
        }
        Ok(())
    }

    /// The text of a file, from the replay if that embeds it, else from disk; the recording embeds it.
    pub(super) fn read(&mut self, path: &Path) -> Result<String, String> {
        let embedded = self.playing.as_ref().and_then(|playing| playing.player.file(path));
        let result = embedded.map_or_else(|| Files::read(path), |text| Ok(text.to_owned()));
        if let Ok(text) = &result {
            let asked = self.application.asked();
            self.options.recorder.embed(&path.display().to_string(), text, asked);
        }
        result
    }

    /// Begins a replay; one that is already being played continues afterwards.
    pub(super) fn begin(&mut self, script: Script) -> Step {
        self.options.recorder.forget(self.application.asked());
        let Some(playing) = &mut self.playing else {
            self.playing = Some(Replay::new(script));
            return Ok(());
        };
        match playing.player.interject(script) {
            Ok(()) => Ok(()),
            Err(unmet) => self.fail(unmet),
        }
    }

    /// Why an effect is not carried out while a file is played: one that writes a file if the played one may not do so, and
    /// without a terminal one that needs it, of which nothing is said; `None` for one that is.
    pub(super) fn withheld(&self, effect: &Effect) -> Option<String> {
        self.playing.as_ref()?;
        match effect {
            Effect::Write { path, .. } if !self.options.files.may_play_write => {
                let path = path.display();
                Some(format!("{path} not written: a keystroke file writes only with --allow-write"))
            }
            Effect::Write { path, content, .. } if !matches!(content, Content::Record { .. }) => {
                self.options.files.place(path).err()
            }
            _ if !self.unattended => None,
            Effect::Write { content: Content::Record { .. }, .. } => {
                Some("a replay records nothing".to_owned())
            }
            Effect::Suspend
            | Effect::Repaint
            | Effect::Copy(_)
            | Effect::CopyScreen
            | Effect::Mouse(_)
            | Effect::PutAside(_) => Some(String::new()),
            _ => None,
        }
    }

    /// Notes that a file which a replay asked for was not written.
    pub(super) fn note_unwritten(&mut self, notice: &Notice) {
        if let Some(playing) = self.playing.as_mut().filter(|_| notice.error) {
            playing.unwritten.get_or_insert(notice.text.clone());
        }
    }

    /// Takes the next step of a replay, if the screen shows everything before it.
    ///
    /// Inside the explorer, a replay has the size of the terminal and keeps no pictures.
    pub(super) fn play(&mut self) -> Step {
        let has_events = !(self.unattended || self.events.is_empty() && self.missed.is_empty());
        if self.changed.is_some() || has_events || self.application.is_waiting() {
            return Ok(());
        }
        let (application, size) = (&self.application, self.screen.size());
        let idle = application.wants().is_empty() && !self.writing;
        let screen = || view::screen::text(&application.picture(size));
        let Some(playing) = self.playing.as_mut().filter(|it| it.pause == Pause::Not) else {
            return Ok(());
        };
        loop {
            let passes = self.unattended || playing.player.said() <= playing.passed;
            let had_task = playing.player.has_task();
            let number = playing.player.said();
            let action = playing.player.next(idle, screen);
            let is_done = had_task && !playing.player.has_task();
            if is_done && !passes {
                playing.note(number, RIGHT);
            }
            return match action {
                Ok(Action::Keep(name)) => {
                    if self.unattended {
                        self.kept.push((name, application.picture(size)));
                    }
                    continue;
                }
                Ok(Action::Give(Msg::Resize { .. })) if !self.unattended => continue,
                Ok(Action::Task(msg)) if passes || playing.shows => {
                    if !passes {
                        playing.note(number, SHOWN);
                    }
                    playing.shows = false;
                    playing.player.helped();
                    self.record(msg)
                }
                Ok(Action::Wait | Action::Task(_)) => Ok(()),
                Ok(Action::Give(mut msg)) => {
                    if !self.unattended {
                        msg = playing.waits_at(msg);
                    }
                    if let Msg::Resize { width, height } = msg {
                        self.screen.repaint(Size { width, height });
                    }
                    self.record(msg)
                }
                Ok(Action::Done) if self.unattended => Err(LoopEnd::Quit),
                Ok(Action::Done) => {
                    let unwritten = playing.unwritten.take();
                    let failed = unwritten.is_some();
                    let but = unwritten.map(|why| format!("replay done, but {why}"));
                    let how = but.unwrap_or_else(|| playing.score());
                    self.played(failed, how)
                }
                Err(unmet) => self.fail(unmet),
            };
        }
    }

    /// Plays a file without a terminal until it ends, an expectation is not met, the session quits, or the limits say so.
    pub fn unattended(mut self, limits: &Limits) -> ReplayResult<M> {
        self.unattended = true;
        let Size { width, height } = self.screen.size();
        // Neither the size nor a frame that nobody sees can end the loop.
        drop(self.update(Msg::Resize { width, height }));
        while !(limits.interrupted)() && self.round().is_ok() {}
        // A figure that has been begun is written.
        while self.writing
            && let Ok(event) = self.events.recv()
        {
            drop(self.handle(event));
        }
        let screen = self.application.picture(self.screen.size());
        let unwritten = self.playing.and_then(|playing| playing.unwritten);
        let Pump { application, kept, unmet, mut options, .. } = self;
        if let Some(cast) = &mut options.cast {
            cast.show(screen.clone());
        }
        let cast = options.cast;
        ReplayResult { application, screen, kept, unmet, unwritten, cast }
    }

    /// Ends a replay whose file cannot be played further.
    fn fail(&mut self, unmet: ScriptError) -> Step {
        if !self.unattended {
            return self.played(true, format!("replay stopped: {unmet}"));
        }
        self.unmet = Some(unmet);
        Err(LoopEnd::Quit)
    }

    /// Ends a replay.
    fn played(&mut self, error: bool, text: String) -> Step {
        self.playing = None;
        self.update(Msg::Say(String::new(), None))?;
        self.tell(Notice { error, text })
    }

    /// Puts held-back input before all other events, once nothing makes it wait.
    pub(super) fn release(&mut self) {
        if self.playing.is_some() || self.application.is_waiting() {
            return;
        }
        while let Some(event) = self.held_back.pop_back() {
            self.missed.push_front(event);
        }
    }

    /// Gives the session a message that is recorded, unless it quits.
    fn record(&mut self, msg: Msg) -> Step {
        if let Some(cast) = &mut self.options.cast {
            cast.film(&msg, || self.application.picture(self.screen.size()));
        }
        self.options.recorder.note(&msg);
        let done = self.update(msg);
        if done == Err(LoopEnd::Quit) {
            self.options.recorder.forget(1);
        }
        done
    }

    /// Writes what was recorded since the last call, if there is a file for it.
    pub(super) fn keep_record(&mut self) -> Step {
        let Err(text) = self.options.keep_record() else { return Ok(()) };
        self.options.record = None;
        self.tell(Notice { error: true, text })
    }

    /// Completes the recording when the program ends.
    pub fn close_record(&mut self) {
        if self.application.is_waiting() {
            self.options.recorder.forget(1);
        }
        // It is too late to tell the user about an error.
        drop(self.options.keep_record());
    }
}
