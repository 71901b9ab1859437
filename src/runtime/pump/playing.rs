//! Files played in the loop, the effect of the user's keys meanwhile, and what is recorded.
//!
//! A recording keeps the command that asked for a replay, because it plays the same again. Only if the replay
//! ended early, or something besides its steps was given to the session, the recording has the given steps
//! instead of the command.

use std::io::{self, Write};
use std::path::Path;

use super::play::{Pause, Playing};
use super::{Application, EffectOutcome, Files, Pump};
use crate::runtime::application::{Event, LoopEnd};
use crate::session::read::waiting::forgets;
use crate::session::replay::{Action, Script};
use crate::session::{Code, Effect, Key, Msg, Notice};
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
    pub(super) fn users(&mut self, msg: Msg) -> io::Result<Option<LoopEnd>> {
        let Some(playing) = &mut self.playing else {
            if self.application.is_waiting() {
                if !forgets(&msg) && !leaves(&msg) {
                    self.held_back.push_back(Event::Session(msg));
                    return Ok(None);
                }
                // The waiting command has not been carried out, and never will be.
                self.options.recorder.forget(1);
                self.held_back.clear();
                if forgets(&msg) {
                    return self.update(msg);
                }
            }
            self.options.recorder.note(&msg);
            let stop = self.update(msg)?;
            if stop == Some(LoopEnd::Quit) {
                self.options.recorder.forget(1);
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
        if caption && BACK.iter().any(|code| is_key(&msg, *code)) {
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

    /// Records a message that is not input of the user.
    pub(super) fn note(&mut self, msg: &Msg) {
        match &mut self.playing {
            Some(playing) => {
                playing.timed = true;
                playing.given.note(msg);
            }
            None => self.options.recorder.note(msg),
        }
    }

    /// The text of a file, from the replay if that embeds it, else from disk; the recording embeds it.
    pub(super) fn read(&mut self, path: &Path) -> Result<String, String> {
        let embedded = self.playing.as_ref().and_then(|playing| playing.player.file(path));
        let result = embedded.map_or_else(|| Files::read(path), |text| Ok(text.to_owned()));
        if let Ok(text) = &result {
            let (recorder, asked) = match &mut self.playing {
                // If the replay is not played to its end, the recording has its steps, which ask for the file
                // themselves.
                Some(playing) => {
                    let asked = self.application.asked();
                    playing.given.embed(&path.display().to_string(), text, asked);
                    (&mut self.options.recorder, playing.asked)
                }
                None => (&mut self.options.recorder, self.application.asked()),
            };
            recorder.embed(&path.display().to_string(), text, asked);
        }
        result
    }

    /// Begins a replay; one that is already being played continues afterwards.
    pub(super) fn begin(&mut self, script: Script) -> io::Result<EffectOutcome> {
        let asked = self.application.asked();
        let Some(playing) = &mut self.playing else {
            self.playing = Some(Playing::new(script, asked));
            return Ok(EffectOutcome::Done);
        };
        playing.given.forget(asked);
        let Err(unmet) = playing.player.interject(script) else { return Ok(EffectOutcome::Done) };
        if self.unattended {
            self.unmet = Some(unmet);
            return Ok(EffectOutcome::Stop(LoopEnd::Quit));
        }
        let stop = self.played(true, format!("replay stopped: {unmet}"), false)?;
        Ok(stop.map_or(EffectOutcome::Done, EffectOutcome::Stop))
    }

    /// The refusal of an effect that writes a file, if a file that may not do so is played.
    pub(super) fn refusal(&mut self, effect: &Effect) -> Option<Msg> {
        let playing = self.playing.as_mut()?;
        if self.options.files.may_play_write {
            return None;
        }
        let path = effect.writes()?.display();
        let text = format!("{path} not written: a keystroke file writes only with --allow-write");
        playing.unwritten.get_or_insert(text.clone());
        let notice = Notice { error: true, text };
        let is_figure = matches!(effect, Effect::Figure { .. });
        Some(if is_figure { Msg::Written(notice) } else { Msg::Told(notice) })
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
        let screen = || view::screen::text(&application.picture(size));
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
                        // The command that asked for this replay also quits when it is played again.
                        self.settle(true);
                    }
                    Ok(stop)
                }
                Ok(Action::Done) => match playing.unwritten.take() {
                    Some(why) => self.played(true, format!("replay done, but {why}"), true),
                    None => self.played(false, "replay done".to_owned(), true),
                },
                Err(unmet) => self.played(true, format!("replay stopped: {unmet}"), false),
            };
        }
    }

    /// Ends a replay; `whole` says that it was played to its end.
    fn played(&mut self, error: bool, text: String, whole: bool) -> io::Result<Option<LoopEnd>> {
        self.settle(whole);
        self.update(Msg::Say(String::new(), None))?;
        self.update(Msg::Told(Notice { error, text }))
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

    /// Ends a replay in the recording: keeps the command that asked for it, or replaces that by the given
    /// steps.
    fn settle(&mut self, whole: bool) {
        let Some(playing) = self.playing.take() else { return };
        if !whole || playing.timed {
            self.options.recorder.forget(playing.asked);
            playing.given.steps().iter().for_each(|step| self.options.recorder.add(step.clone()));
        }
    }

    /// Writes what was recorded since the last call, if there is a file for it.
    pub(super) fn keep_record(&mut self) -> io::Result<()> {
        let kept = self.options.keep_record();
        if let Err(text) = kept {
            self.options.record = None;
            self.tell(Notice { error: true, text })?;
        }
        Ok(())
    }

    /// Completes the recording when the program ends.
    pub fn close_record(&mut self) {
        self.settle(false);
        if self.application.is_waiting() {
            self.options.recorder.forget(1);
        }
        // It is too late to tell the user about an error.
        drop(self.options.keep_record());
    }
}
