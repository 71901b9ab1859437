//! Plays a keystroke file without a terminal: the same session and the same workers, but no screen.
//!
//! Nothing here waits for time to pass. While something is wanted, the next step waits for the workers' next
//! message; otherwise the next step of the file is taken.

use std::io;
use std::sync::Arc;

use crossbeam_channel::unbounded;
use ratatui::buffer::Buffer;
use ratatui::layout::Size;

use super::application::{Application, EffectOutcome, Host, LoopEnd};
use super::effects::Files;
use super::explorer::{Explorer, answer};
use super::new_file::Readers;
use super::scan_file;
use super::workers::Workers;
use crate::flow::Limits;
use crate::session::replay::{Action, Player, Script, ScriptError};
use crate::session::{Effect, Msg, Notice, Session};
use crate::terminal::Environment;
use crate::view;

/// The result of a keystroke file.
#[derive(Clone, Debug)]
pub struct ReplayResult {
    /// The application at the end.
    pub application: Explorer,
    /// The last picture; [`crate::view::screen::text`] has its characters.
    pub screen: Buffer,
    /// The pictures that the file asks for by name, in its order.
    pub kept: Vec<(String, Buffer)>,
    /// The first expectation that was not met; playing ended there.
    pub unmet: Option<ScriptError>,
    /// Why the first file that was to be written was not.
    pub unwritten: Option<String>,
}

/// Plays a file on a session at its size, until the file ends, an expectation is not met, or the session quits.
///
/// Effects outside the program are not carried out: a replay copies nothing, and writes files only if it may. It
/// does read the files that the session asks for.
pub fn play(
    session: Session,
    environment: Environment,
    script: Script,
    may_write: bool,
) -> io::Result<ReplayResult> {
    let crate::session::Size { width, height } = session.size;
    let mut size = Size { width, height };
    let application = Explorer::new(session, environment);
    let (send, messages) = unbounded();
    let report = Arc::new(move |msg| drop(send.send(msg)));
    let mut workers = Workers::new(Arc::new(answer), report);
    let player = Player::new(script);
    let mut replay = Replay { application, player, may_write, unmet: None, unwritten: None };
    let mut kept = Vec::new();
    let mut given = Some(Msg::Resize { width, height });
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
        workers.ask(&application.wants());
        let screen = || view::screen::text(&application.picture(size));
        let next = if application.is_waiting() {
            Ok(Action::Wait)
        } else {
            player.next(workers.asked().next().is_none(), screen)
        };
        match next {
            Ok(Action::Give(msg)) => given = Some(msg),
            Ok(Action::Keep(name)) => kept.push((name, application.picture(size))),
            // The workers live as long as their handle, so a message arrives.
            Ok(Action::Wait) => given = messages.recv().ok(),
            Ok(Action::Done) => break None,
            Err(unmet) => break Some(unmet),
        }
    };
    let screen = replay.application.picture(size);
    let Replay { application, unwritten, .. } = replay;
    Ok(ReplayResult { application, screen, kept, unmet, unwritten })
}

/// An application and the player of the file.
struct Replay {
    application: Explorer,
    player: Player,
    may_write: bool,
    unmet: Option<ScriptError>,
    unwritten: Option<String>,
}

impl Replay {
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

impl Host for Replay {
    type Application = Explorer;

    fn application(&mut self) -> &mut Explorer {
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
    use crate::scene::find;
    use crate::scene::library::PLAIN;
    use crate::session::replay::parse;

    /// Plays a file on the plain scene.
    fn played(file: &str) -> ReplayResult {
        let size = crate::session::Size { width: 80, height: 24 };
        let session = Session::new(find(PLAIN).unwrap(), size);
        play(session, Environment::default(), parse(file).unwrap(), false).unwrap()
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
