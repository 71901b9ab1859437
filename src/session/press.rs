//! The effect of a key press: it completes what is pending, runs a command, or types a character.

use crate::numerics::similar::most_similar;
use crate::session::act::focus::focus_on;
use crate::session::act::notice::{attempt, inform, refuse, with_keys};
use crate::session::act::{general, marks, typing};
use crate::session::command_row::CommandAction;
use crate::session::commands;
use crate::session::effect::Done;
use crate::session::lines;
use crate::session::message::key::{Code, Key};
use crate::session::read::completion::names;
use crate::session::read::palette::{elsewhere, place};
use crate::session::state::command::full_name;
use crate::session::state::{
    Command, Context, Letter, NextCommand, Overlay, Pending, Price, Prompt, Session,
};
use crate::words::printable;

/// The key that is passed to commands that are run from a line.
pub(super) const ENTER: Key = Key::plain(Code::Enter);

/// Handles a key press.
pub(super) fn press(session: &mut Session, key: Key) {
    session.notice = None;
    session.measuring = false;
    session.price = Price { key: Some(key), recomputed: Vec::new() };
    match session.pending {
        Some(pending) => resolve(session, pending, key),
        None => act(session, key),
    }
}

/// Does what the key means in the present contexts.
fn act(session: &mut Session, key: Key) {
    let contexts = session.contexts();
    if let Some(command) = session.keymap.command(contexts, key) {
        return run(session, command, key);
    }
    if let Some(char) = key.typed().filter(|_| contexts[0].takes_text()) {
        typing::insert(session, &char.to_string());
    } else if let Some(command) = elsewhere(session, key) {
        run_where_it_belongs(session, command, key);
    } else {
        let text = format!("{} has no meaning here; {{help}} lists the keys", key.said());
        let text = with_keys(session, &text);
        inform(session, text);
    }
}

/// Handles the key that completes a count or a letter.
fn resolve(session: &mut Session, pending: Pending, key: Key) {
    let context = match pending {
        Pending::Count(_) => Context::Count,
        Pending::Letter(_) => Context::Letter,
    };
    if let Some(command) = session.keymap.command(&[context], key) {
        return run(session, command, key);
    }
    session.pending = None;
    match pending {
        Pending::Count(count) => repeat(session, key, count.max(1)),
        Pending::Letter(what) => letter(session, what, key),
    }
}

/// Presses a key `count` times as one change. Stops early if a press is refused, opens something, quits, or
/// asks for a letter.
fn repeat(session: &mut Session, key: Key, count: u32) {
    let depth = session.history.depth().0;
    let overlay = session.overlay.clone();
    for _ in 0..count {
        if !session.means(key) {
            act(session, key);
            break;
        }
        session.notice = None;
        act(session, key);
        let refused = session.notice.as_ref().is_some_and(|notice| notice.error);
        let opened = match (&session.overlay, &overlay) {
            (Some(now), Some(before)) => now.differs(before),
            (now, before) => now.is_some() != before.is_some(),
        };
        if refused || opened || session.quit || session.pending.is_some() {
            break;
        }
    }
    session.history.merge(depth);
}

/// Uses a letter for its purpose. The key that asked for the letter, pressed again, means the last point.
fn letter(session: &mut Session, what: Letter, key: Key) {
    let asks =
        |name| session.keymap.command(session.contexts(), key).is_some_and(|c| c.name == name);
    let name = match key.typed() {
        Some(name) if name.is_ascii_lowercase() => Some(name),
        _ => None,
    };
    match (what, name) {
        (Letter::Mark, Some(name)) => marks::set(session, name),
        (Letter::GoTo, Some(name)) => attempt(session, |session| marks::go_to(session, name)),
        (Letter::GoTo, None) if asks("go-to-mark") => {
            attempt(session, marks::go_back);
        }
        (_, None) if session.keymap.command(&[Context::Always], key).is_some() => act(session, key),
        (_, None) => refuse(session, format!("{} is not a letter from a to z", key.said())),
    }
}

/// Runs a command here or in the pane where it applies, which then gets the focus.
fn run_where_it_belongs(session: &mut Session, command: &Command, key: Key) {
    match place(session, command) {
        Ok(Some(pane)) => focus_on(session, pane),
        Ok(None) => {}
        Err(place) => {
            return refuse(session, format!("{} {}", command.name, missing(session, place)));
        }
    }
    run(session, command, key);
}

/// Why a command cannot be run: what it needs, and how to get there.
fn missing(session: &Session, place: Context) -> String {
    match place.view() {
        Some(view) => {
            let spec = view.spec();
            let heading = spec.heading.to_lowercase();
            with_keys(
                session,
                &format!("needs the {heading}: {{views}} or :view {} shows it", spec.name),
            )
        }
        None if place == Context::Walk => {
            with_keys(session, "needs a branch: {walk} on a diagram takes hold of one")
        }
        None => format!("works only {}", place.title().to_lowercase()),
    }
}

/// Runs a command, or the command that it chooses.
fn run(session: &mut Session, command: &Command, key: Key) {
    match commands::run(command.name) {
        Some(CommandAction::Act(act)) => act(session, key),
        Some(CommandAction::Try(act)) => attempt(session, act),
        Some(CommandAction::Toggle(layer)) => general::toggle(session, layer),
        Some(CommandAction::Choose(choose)) => match choose(session) {
            Ok(Some(NextCommand::Command(command))) => run_where_it_belongs(session, command, key),
            Ok(Some(NextCommand::Line(text))) => run_typed(session, &text),
            Ok(None) => {}
            Err(why) => refuse(session, why),
        },
        None => {}
    }
}

/// Runs the text of the command line; if it is refused, the line stays open with the reason.
fn run_typed(session: &mut Session, text: &str) {
    let open = session.overlay.take();
    if let Err(why) = run_line(session, text) {
        let Some(Overlay::Prompt(prompt)) = open else { return refuse(session, why) };
        let refused = Prompt { refused: Some(why), completion: None, back: 0, ..prompt };
        session.overlay = Some(Overlay::Prompt(refused));
    }
}

/// Runs a line while nothing is open. Fails with one line that says what is wrong and what is allowed; the
/// session is then unchanged.
pub fn run_line(session: &mut Session, text: &str) -> Done {
    let (name, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let (name, rest) = (full_name(name), rest.trim());
    let (line, command) = (session.keymap.line(name), session.keymap.named(name));
    match (line, command) {
        (_, Some(command)) if rest.is_empty() => {
            run_where_it_belongs(session, command, ENTER);
            Ok(())
        }
        (Some(line), _) if rest.is_empty() => {
            Err(format!("{name} needs {}: {}", line.arguments, line.doc))
        }
        (Some(_), _) => {
            let run = lines::run(name).map_or(Ok(()), |run| run(session, rest));
            run.map_err(|why| printable::line(&format!("{name}: {why}")).into())
        }
        (None, Some(_)) => Err(format!("{name} takes no words, but there are {rest:?}")),
        (None, None) => Err(match most_similar(name, names(&session.keymap)) {
            Some(nearest) => format!("no command {name:?}; did you mean {nearest}?"),
            None => format!("no command {name:?}; Tab lists them"),
        }),
    }
}

/// Runs a line that was not typed.
pub(super) fn run_untyped(session: &mut Session, text: &str) {
    (session.overlay, session.pending, session.notice) = (None, None, None);
    attempt(session, |session| run_line(session, text));
}
