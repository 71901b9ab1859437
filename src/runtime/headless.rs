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
use super::panics::Notes;
use super::picture;
use super::worker::Tell;
use super::workers::Workers;
use crate::flow::{Limits, Reason};
use crate::scene::{Answer, Request};
use crate::session::replay::{Action, Player, Script, Unmet};
use crate::session::{Effect, Msg, Notice};
use crate::view;

/// The result of a keystroke file.
#[derive(Clone, Debug)]
pub struct Played<M> {
    /// The application at the end.
    pub application: M,
    /// The last picture; [`crate::view::screen::text`] has its characters.
    pub screen: Buffer,
    /// The pictures that the file asks for by name, in its order.
    pub kept: Vec<(String, Buffer)>,
    /// The first expectation that was not met; playing ended there.
    pub unmet: Option<Unmet>,
}

/// Plays a file on an application at this size, until the file ends, an expectation is not met, or the
/// application quits.
///
/// Effects outside the program are not carried out: a replay writes no files and copies nothing. It does read
/// the files that the session asks for. Fails if the system provides no thread for the worker.
pub fn play<M: Application>(
    application: M,
    answer: impl Fn(&Request, &Limits, &Tell) -> Result<Answer, Reason> + Send + Sync + 'static,
    script: Script,
    mut size: Size,
) -> io::Result<Played<M>> {
    let (send, messages) = unbounded();
    let mut workers = Workers::start(answer, Notes::default(), move |msg| drop(send.send(msg)))?;
    let mut replay = Replay { application, player: Player::new(script) };
    let mut kept = Vec::new();
    let mut given = Some(Msg::Resize { width: size.width, height: size.height });
    let unmet = loop {
        if let Some(msg) = given.take() {
            if let Msg::Resize { width, height } = msg {
                size = Size { width, height };
            }
            workers.arrived(&msg);
            if replay.give(msg)?.is_some() {
                break None;
            }
        }
        let Replay { application, player } = &mut replay;
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
    Ok(Played { application: replay.application, screen, kept, unmet })
}

/// An application and the player of the file.
struct Replay<M> {
    application: M,
    player: Player,
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
            Effect::Play(script) | Effect::PlayRegister(script) => {
                self.player.interject(script);
                EffectOutcome::Done
            }
            Effect::Figure { path, .. } => {
                let text = format!("{} not written: a replay writes no files", path.display());
                EffectOutcome::Told(Msg::Written(Notice { error: false, text }))
            }
            Effect::Suspend
            | Effect::Repaint
            | Effect::Copy(_)
            | Effect::CopyScreen
            | Effect::Mouse(_)
            | Effect::SaveScan { .. }
            | Effect::Record { .. }
            | Effect::StopWriting
            | Effect::PutAside(_)
            | Effect::Write { .. } => EffectOutcome::Done,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runtime::Explorer;
    use crate::runtime::explorer::answer;
    use crate::scene::library::{PLAIN, find};
    use crate::session::Session;
    use crate::session::replay::parse;
    use crate::terminal::Environment;

    const SIZE: Size = Size { width: 80, height: 24 };

    /// Plays a file on the plain scene.
    fn played(file: &str) -> Played<Explorer> {
        let size = crate::session::Size { width: SIZE.width, height: SIZE.height };
        let session = Session::new(find(PLAIN).unwrap(), size);
        let explorer = Explorer::new(session, Environment::default());
        play(explorer, answer, parse(file).unwrap(), SIZE).unwrap()
    }

    fn text(picture: &Buffer) -> String {
        view::screen::text(picture)
    }

    #[test]
    fn a_file_ends_on_a_picture_that_is_computed() {
        let end = played("");
        assert_eq!(end.unmet, None);
        assert!(end.application.wants().is_empty());
        assert!(text(&end.screen).contains("phase plane"), "{}", text(&end.screen));
    }

    #[test]
    fn keys_size_and_named_pictures_are_what_the_file_says() {
        let end = played("<screen before> <right*2> <screen after> <resize 100x30>");
        let names: Vec<&str> = end.kept.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["before", "after"]);
        assert_ne!(text(&end.kept[0].1), text(&end.kept[1].1));
        assert_eq!(end.screen.area.as_size(), Size { width: 100, height: 30 });
    }

    #[test]
    fn the_first_expectation_that_is_not_met_ends_it() {
        let end = played("<expect \"phase plane\">\n<expect \"no such text\">\n<screen never>");
        assert_eq!(end.unmet.unwrap().line, 2);
        assert!(end.kept.is_empty());
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
