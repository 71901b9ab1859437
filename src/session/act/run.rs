//! Running commands by their keys and their names, and lines of the command line.

use crate::numerics::most_similar;
use crate::scene::ViewSpec;
use crate::session::act::general::toggle;
use crate::session::act::screen_setup::focus_on;
use crate::session::read::completion::names;
use crate::session::{Code, Command, CommandAction, Context, Done, Key, Session, called, place};
use crate::words::printable;

/// The key that is passed to commands that are run from a line.
pub(crate) const ENTER: Key = Key::plain(Code::Enter);

/// Runs a command here or in the pane where it applies, which then gets the focus.
pub fn run_where_it_belongs(session: &mut Session, command: &Command, key: Key) {
    match place(session, command) {
        Ok(Some(pane)) => focus_on(session, pane),
        Ok(None) => {}
        Err(place) => {
            return session.refuse(format!("{} {}", command.name, missing(session, place)));
        }
    }
    run(session, command, key);
}

/// Why a command cannot be run: what it needs, and how to get there.
fn missing(session: &Session, place: Context) -> String {
    match place.view() {
        Some(view) => {
            let ViewSpec { name, heading, .. } = view.spec();
            let heading = heading.to_lowercase();
            session.with_keys(&format!("needs the {heading}: {{views}} or :view {name} shows it"))
        }
        None if place == Context::Walk => {
            session.with_keys("needs a branch: {walk} on a diagram takes hold of one")
        }
        None if place == Context::Kick => {
            session.with_keys("needs a kick of the mass: {try-kick} tries one")
        }
        None => format!("works only {}", place.spec().title.to_lowercase()),
    }
}

/// Runs a command.
pub fn run(session: &mut Session, command: &Command, key: Key) {
    session.used.retain(|name| *name != command.name);
    session.used.push(command.name);
    match command.run {
        CommandAction::Act(act) => act(session),
        CommandAction::Press(act) => act(session, key),
        CommandAction::Move(act) => act(session, command.by),
        CommandAction::Try(act) => session.attempt(act),
        CommandAction::Toggle(layer) => toggle(session, layer),
        // It takes words, which a key cannot give.
        CommandAction::Line(..) => {}
    }
}

/// Runs a line while nothing is open. Fails with one line that says what is wrong and what is allowed; the
/// session is then unchanged.
pub fn run_line(session: &mut Session, text: &str) -> Done {
    let (name, rest) = called(text);
    let (line, command) = (session.keymap.line(name), session.keymap.named(name));
    match (line, command) {
        (_, Some(command)) if rest.is_empty() => {
            run_where_it_belongs(session, command, ENTER);
            Ok(())
        }
        (Some(line), _) if rest.is_empty() => {
            Err(format!("{name} needs {}: {}", line.arguments, line.doc))
        }
        (Some(line), _) => {
            let CommandAction::Line(_, run) = line.run else { return Ok(()) };
            run(session, rest).map_err(|why| printable::line(&format!("{name}: {why}")).into())
        }
        (None, Some(_)) => Err(format!("{name} takes no words, but there are {rest:?}")),
        (None, None) => Err(match most_similar(name, names(&session.keymap)) {
            Some(nearest) => format!("no command {name:?}; did you mean {nearest}?"),
            None => format!("no command {name:?}; Tab lists them"),
        }),
    }
}
