//! Plays a keystroke file without a terminal: the same application and the same workers, but no screen.
//!
//! Nothing here waits for time to pass. While something is wanted, the next step waits for the workers' next
//! message; otherwise the next step of the file is taken.

use std::io;

use crossbeam_channel::unbounded;
use ratatui::buffer::Buffer;
use ratatui::layout::Size;

use super::application::{Application, EffectOutcome, Host};
use super::effects::Files;
use super::event::LoopEnd;
use super::new_file::Readers;
use super::panics::Notes;
use super::worker::Tell;
use super::workers::Workers;
use super::{picture, scan_file};
use crate::flow::{Limits, Reason};
use crate::scene::{Answer, Request};
use crate::session::replay::{Action, Player, Script, ScriptError};
use crate::session::{Effect, Msg, Notice};
use crate::view;

/// The result of a keystroke file.
#[derive(Clone, Debug)]
pub struct ReplayResult<M> {
    /// The application at the end.
    pub application: M,
    /// The last picture; [`crate::view::screen::text`] has its characters.
    pub screen: Buffer,
    /// The pictures that the file asks for by name, in its order.
    pub kept: Vec<(String, Buffer)>,
    /// The first expectation that was not met; playing ended there.
    pub unmet: Option<ScriptError>,
    /// Why the first file that was to be written was not.
    pub unwritten: Option<String>,
}

/// Plays a file on an application at this size, until the file ends, an expectation is not met, or the
/// application quits.
///
/// Effects outside the program are not carried out: a replay copies nothing, and writes files only if it may. It
/// does read the files that the session asks for. Fails if the system provides no thread for the worker.
pub fn play<M: Application>(
    application: M,
    answer: impl Fn(&Request, &Limits, &Tell) -> Result<Answer, Reason> + Send + Sync + 'static,
    script: Script,
    mut size: Size,
    may_write: bool,
) -> io::Result<ReplayResult<M>> {
    let (send, messages) = unbounded();
    let mut workers = Workers::start(answer, Notes::default(), move |msg| drop(send.send(msg)))?;
    let player = Player::new(script);
    let mut replay = Replay { application, player, may_write, unmet: None, unwritten: None };
    let mut kept = Vec::new();
    let mut given = Some(Msg::Resize { width: size.width, height: size.height });
    let unmet = loop {
        if let Some(msg) = given.take() {
            if let Msg::Resize { width, height } = msg {
                size = Size { width, height };
            }
            workers.arrived(&msg);
            if replay.give(msg)?.is_some() {
                break replay.unmet.take();
            }
        }
        // Answers are taken first, as in the explorer; otherwise those of asynchronous keys would pile up.
        given = messages.try_recv().ok();
        if given.is_some() {
            continue;
        }
        let Replay { application, player, .. } = &mut replay;
        workers.ask(application.wants());
        let screen = || view::screen::text(&picture::of(application, size));
        let next = if application.is_waiting() {
            Ok(Action::Wait)
        } else {
            player.next(workers.asked().is_empty(), screen)
        };
        match next {
            Ok(Action::Give(msg)) => given = Some(msg),
            Ok(Action::Keep(name)) => kept.push((name, picture::of(application, size))),
            // The workers live as long as their handle, so a message arrives.
            Ok(Action::Wait) => given = messages.recv().ok(),
            Ok(Action::Done) => break None,
            Err(unmet) => break Some(unmet),
        }
    };
    let screen = picture::of(&replay.application, size);
    let Replay { application, unwritten, .. } = replay;
    Ok(ReplayResult { application, screen, kept, unmet, unwritten })
}

/// An application and the player of the file.
struct Replay<M> {
    application: M,
    player: Player,
    may_write: bool,
    unmet: Option<ScriptError>,
    unwritten: Option<String>,
}

impl<M: Application> Replay<M> {
    /// Carries out an effect that writes a file, if it may, and reports the result.
    fn written(&mut self, effect: Effect) -> Msg {
        let is_figure = matches!(effect, Effect::Figure { .. });
        let refusal = unasked(&effect).filter(|_| !self.may_write);
        let notice = refusal.unwrap_or_else(|| self.write(effect));
        if notice.error {
            self.unwritten.get_or_insert(notice.text.clone());
        }
        if is_figure { Msg::Written(notice) } else { Msg::Told(notice) }
    }

    fn write(&self, effect: Effect) -> Notice {
        match effect {
            Effect::Write { path, text, replace } => {
                Files::write(&path, text, replace, Readers::Owner)
            }
            Effect::SaveScan { path, scan, rows } => scan_file::save(&path, &scan, &rows),
            Effect::Figure { path, plot, replace } => {
                let drawn = self.application.figure(&path, plot);
                match drawn.and_then(|work| work(&Limits::PATIENT)) {
                    Ok(content) => Files::write(&path, content, replace, Readers::Usual),
                    Err(text) => Notice { error: true, text },
                }
            }
            _ => Notice { error: true, text: "a replay records nothing".to_owned() },
        }
    }
}

/// The refusal of an effect that writes a file, when a keystroke file asks for it.
pub(super) fn unasked(effect: &Effect) -> Option<Notice> {
    let path = effect.writes()?.display();
    let text = format!("{path} not written: a keystroke file writes only with --allow-write");
    Some(Notice { error: true, text })
}

impl<M: Application> Host for Replay<M> {
    type Application = M;

    fn application(&mut self) -> &mut M {
        &mut self.application
    }

    fn carry_out(&mut self, effect: Effect) -> io::Result<EffectOutcome> {
        Ok(match effect {
            Effect::Quit => EffectOutcome::Stop(LoopEnd::Quit),
            // A session depends on the files that it reads.
            Effect::Read { path, purpose } => {
                let embedded = self.player.file(&path).map(|text| Ok(text.to_owned()));
                let result = embedded.unwrap_or_else(|| Files::read(&path));
                EffectOutcome::Told(Msg::Read { path, purpose, result })
            }
            Effect::Play(script) => match self.player.interject(script) {
                Ok(()) => EffectOutcome::Done,
                Err(unmet) => {
                    self.unmet = Some(unmet);
                    EffectOutcome::Stop(LoopEnd::Quit)
                }
            },
            Effect::Figure { .. }
            | Effect::SaveScan { .. }
            | Effect::Record { .. }
            | Effect::Write { .. } => EffectOutcome::Told(self.written(effect)),
            Effect::Suspend
            | Effect::Repaint
            | Effect::Copy(_)
            | Effect::CopyScreen
            | Effect::Mouse(_)
            | Effect::StopWriting
            | Effect::PutAside(_) => EffectOutcome::Done,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runtime::Explorer;
    use crate::runtime::explorer::answer;
    use crate::scene::find;
    use crate::scene::library::PLAIN;
    use crate::session::Session;
    use crate::session::replay::parse;
    use crate::terminal::Environment;

    const SIZE: Size = Size { width: 80, height: 24 };

    /// Plays a file on the plain scene.
    fn played(file: &str) -> ReplayResult<Explorer> {
        let size = crate::session::Size { width: SIZE.width, height: SIZE.height };
        let session = Session::new(find(PLAIN).unwrap(), size);
        let explorer = Explorer::new(session, Environment::default());
        play(explorer, answer, parse(file).unwrap(), SIZE, false).unwrap()
    }

    #[test]
    fn the_screen_has_the_size_that_the_file_sets() {
        let end = played("<right> <resize 100x30>");
        assert_eq!(end.screen.area.as_size(), Size { width: 100, height: 30 });
    }

    #[test]
    fn quitting_ends_it_and_later_keys_are_not_pressed() {
        let end = played("q <expect \"no such text\">");
        assert_eq!(end.unmet, None);
    }

    #[test]
    fn waiting_for_every_answer_and_for_none_end_on_the_same_numbers() {
        let slow = played("<right*30>").application.session().problem;
        let fast = played("<async> <right*30>").application.session().problem;
        assert_eq!(slow, fast);
    }
}
