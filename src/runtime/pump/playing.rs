//! Files and registers played in the loop, what the user's keys do meanwhile, and what is recorded of it.
//!
//! A recording keeps what asked for a play, since that plays again; only where the play was not the whole
//! one, or time passed in it, the keys that it gave take the place of what asked for it.

use std::io::{self, Write};
use std::path::Path;

use super::play::{Pause, Playing};
use super::{Application, EffectOutcome, Files, Pump, picture};
use crate::runtime::event::{Event, LoopEnd};
use crate::session::read::waiting::forgets;
use crate::session::replay::{Action, Script};
use crate::session::{Code, Key, Msg, Notice};
use crate::view;

/// Keys that go back to the caption before: also those of a presenter's remote control.
const BACK: [Code; 3] = [Code::Backspace, Code::Left, Code::PageUp];

/// Leaves whatever is open, and whatever keys the user has chosen.
fn leaves(msg: &Msg) -> bool {
    matches!(msg, Msg::Key(Key { code: Code::Char('c'), control: true, .. }))
}

fn is_key(msg: &Msg, code: Code) -> bool {
    matches!(msg, Msg::Key(key) if *key == Key::plain(code))
}

impl<M: Application, W: Write> Pump<M, W> {
    /// Something that the user did: given to the session; while something is played, to that.
    pub(super) fn users(&mut self, msg: Msg) -> io::Result<Option<LoopEnd>> {
        let Some(playing) = &mut self.playing else {
            if self.application.is_waiting() {
                if !forgets(&msg) && !leaves(&msg) {
                    self.held_back.push_back(Event::Session(msg));
                    return Ok(None);
                }
                // What waits has not happened, and now it will not.
                self.recorder.forget(1);
                self.held_back.clear();
                if forgets(&msg) {
                    return self.update(msg);
                }
            }
            self.recorder.note(&msg);
            let stop = self.update(msg)?;
            if stop == Some(LoopEnd::Quit) {
                self.recorder.forget(1);
            }
            return Ok(stop);
        };
        let caption = playing.pause == Pause::Caption;
        if matches!(msg, Msg::Key(key) if caption && self.application.tries(key)) {
            (playing.tried, playing.timed) = (true, true);
            playing.given.note(&msg);
            return self.update(msg);
        }
        if is_key(&msg, Code::Esc) {
            return self.played(false, "replay stopped".to_owned(), false);
        }
        if leaves(&msg) {
            return Ok(Some(LoopEnd::Quit));
        }
        if playing.register {
            self.held_back.push_back(Event::Session(msg));
        } else if caption && BACK.iter().any(|code| is_key(&msg, *code)) {
            playing.go_back();
        } else if caption && matches!(msg, Msg::Key(_)) {
            playing.go_on();
        } else if is_key(&msg, Code::Char('q')) {
            return Ok(Some(LoopEnd::Quit));
        } else if is_key(&msg, Code::Char(' ')) {
            let wished = playing.pause == Pause::Wished;
            playing.pause = if wished { Pause::Not } else { Pause::Wished };
            let text =
                if wished { "" } else { "replay held: space continues, esc stops, q leaves" };
            return self.update(Msg::Told(Notice { error: false, text: text.to_owned() }));
        }
        Ok(None)
    }

    /// Notes what happened besides what the user did.
    pub(super) fn note(&mut self, msg: &Msg) {
        match &mut self.playing {
            Some(playing) => {
                playing.timed = true;
                playing.given.note(msg);
            }
            None => self.recorder.note(msg),
        }
    }

    /// The text of a file: as what is played has it, else as it is; a recording embeds it.
    pub(super) fn read(&mut self, path: &Path) -> Result<String, String> {
        let embedded = self.playing.as_ref().and_then(|playing| playing.player.file(path));
        let result = embedded.map_or_else(|| Files::read(path), |text| Ok(text.to_owned()));
        if let Ok(text) = &result {
            let (recorder, asked) = match &mut self.playing {
                // What is not played to its end asks for its files by itself.
                Some(playing) => {
                    let asked = self.application.asked();
                    playing.given.embed(&path.display().to_string(), text, asked);
                    (&mut self.recorder, playing.asked)
                }
                None => (&mut self.recorder, self.application.asked()),
            };
            recorder.embed(&path.display().to_string(), text, asked);
        }
        result
    }

    /// Begins to play; something that is played already continues afterwards.
    pub(super) fn begin(&mut self, script: Script, register: bool) -> io::Result<EffectOutcome> {
        let asked = self.application.asked();
        let Some(playing) = &mut self.playing else {
            self.playing = Some(Playing::new(script, register, asked));
            return Ok(EffectOutcome::Done);
        };
        playing.given.forget(asked);
        if playing.player.interject(script) {
            return Ok(EffectOutcome::Done);
        }
        let stop = self.played(true, "replay stopped: it plays itself".to_owned(), false)?;
        Ok(stop.map_or(EffectOutcome::Done, EffectOutcome::Stop))
    }

    /// The next step of a replay, if the screen shows all that happened before it.
    ///
    /// A replay inside the explorer has the size of the terminal and keeps no pictures.
    pub(super) fn play(&mut self) -> io::Result<Option<LoopEnd>> {
        if self.changed.is_some()
            || !self.events.is_empty()
            || !self.missed.is_empty()
            || self.application.is_waiting()
        {
            return Ok(None);
        }
        let (application, size) = (&self.application, self.screen.size());
        let idle = application.wants().is_empty() && !self.writing;
        let screen = || view::screen::text(&picture::of(application, size));
        let Some(playing) = self.playing.as_mut().filter(|it| it.pause == Pause::Not) else {
            return Ok(None);
        };
        loop {
            return match playing.player.next(idle, screen) {
                Ok(Action::Give(Msg::Resize { .. }) | Action::Keep(_)) => continue,
                Ok(Action::Wait) => Ok(None),
                Ok(Action::Give(msg)) => {
                    if matches!(msg, Msg::Say(..)) && playing.player.said() > playing.passed {
                        playing.pause = Pause::Caption;
                    }
                    playing.given.note(&msg);
                    let stop = self.update(msg)?;
                    if stop == Some(LoopEnd::Quit) {
                        // What asked for this leaves again.
                        self.settle(true);
                    }
                    Ok(stop)
                }
                Ok(Action::Done) => self.played(false, "replay done".to_owned(), true),
                Err(unmet) => self.played(true, format!("replay stopped: {unmet}"), false),
            };
        }
    }

    /// Ends a replay; `whole` if it was played to its end.
    fn played(&mut self, error: bool, text: String, whole: bool) -> io::Result<Option<LoopEnd>> {
        self.settle(whole);
        self.update(Msg::Say(String::new(), None))?;
        self.update(Msg::Told(Notice { error, text }))
    }

    /// What the user did meanwhile happens before everything else, once it can.
    pub(super) fn release(&mut self) {
        if self.playing.is_some() || self.application.is_waiting() {
            return;
        }
        while let Some(event) = self.held_back.pop_back() {
            self.missed.push_front(event);
        }
    }

    /// What was played is over: the recording has what asked for it, or what it gave.
    fn settle(&mut self, whole: bool) {
        let Some(playing) = self.playing.take() else { return };
        if !whole || playing.timed {
            self.recorder.forget(playing.asked);
            playing.given.steps().iter().for_each(|step| self.recorder.add(step.clone()));
        }
    }

    /// Writes what was recorded since the last time, if a file is kept of it.
    pub(super) fn keep_record(&mut self) -> io::Result<()> {
        let kept = self.record.as_mut().map_or(Ok(()), |record| record.keep(&mut self.recorder));
        if let Err(text) = kept {
            self.record = None;
            self.tell(Notice { error: true, text })?;
        }
        Ok(())
    }

    /// The program ends: what was recorded is complete.
    pub fn close_record(&mut self) {
        self.settle(false);
        if self.application.is_waiting() {
            self.recorder.forget(1);
        }
        // Whatever the user has to be told about it comes too late.
        drop(self.record.as_mut().map(|record| record.keep(&mut self.recorder)));
    }
}
