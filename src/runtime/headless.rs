//! Plays a keystroke file without a terminal: the same loop and the same workers, but no screen.

use std::io;
use std::sync::Arc;

use crossbeam_channel::unbounded;
use ratatui::layout::Size;

use super::application::{Event, ReplayResult};
use super::effects::Files;
use super::explorer::{Explorer, answer};
use super::pump::{Options, Pump};
use super::workers::Workers;
use crate::session::Session;
use crate::session::replay::Script;
use crate::terminal::{Environment, Screen};

/// Plays a file on a session at its size, until the file ends, an expectation is not met, or the session quits.
///
/// Effects outside the program are not carried out: a replay copies nothing, and writes files only if it may. It
/// does read the files that the session asks for.
pub fn play(
    session: Session,
    environment: Environment,
    script: Script,
    may_play_write: bool,
) -> io::Result<ReplayResult<Explorer>> {
    let crate::session::Size { width, height } = session.size;
    let (send, events) = unbounded();
    let report = Arc::new(move |msg| drop(send.send(Event::Session(msg))));
    let workers = Workers::new(Arc::new(answer), report);
    let screen = Screen::new(io::sink(), Size { width, height })?;
    let files = Files { may_play_write, ..Files::default() };
    let options = Options { replay: Some(script), files, ..Options::default() };
    let explorer = Explorer::new(session, environment);
    Pump::new(explorer, screen, workers, events, options, Size::default).unattended()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::find;
    use crate::scene::library::PLAIN;
    use crate::session::replay::parse;

    /// Plays a file on the plain scene.
    fn played(file: &str) -> ReplayResult<Explorer> {
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
