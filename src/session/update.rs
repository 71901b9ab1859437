//! The transition of a session: [`update`] takes a message in and returns the effects for the outer rings. A key press
//! completes what is pending, runs a command, or types a character.
//!
//! Nothing here reads a clock or touches a file, so a session is determined by its messages, and every defect
//! can be reproduced by a keystroke file. The modules in `act` do what commands ask for, one concern each.

use crate::flow::Reason;
use crate::question::NoAnswer;
use crate::scene::{Reply, Request};
use crate::session::act::run::{ENTER, run, run_line, run_where_it_belongs};
use crate::session::act::{
    answers, compare, files, history, kick, lists, plots, preview, prompt, values, walk,
};
use crate::session::read::contexts;
use crate::session::replay::script::parse;
use crate::session::{
    Context, Effect, Key, Msg, Overlay, Pane, PendingInput, Price, Prompt, Row, Session,
    SessionCaption, Size, WaitingPress, called, elsewhere,
};

/// Takes a message in; a press that needs an answer that is still being computed waits for it.
pub fn update(session: &mut Session, message: Msg) -> Vec<Effect> {
    if is_press(&message) {
        // While a press waits, the only press that arrives here is one that cancels it.
        if session.waiting.take().is_some() && contexts::forgets(&message) {
            session.inform("the waiting key is dropped");
            return Vec::new();
        }
        // Any key of those that it names works on the page of help.
        if let (Msg::Key(key), Some(Overlay::Help(_))) = (&message, &session.overlay)
            && !session.means(*key)
        {
            lists::close(session);
        }
        if let Some(request) = session.awaited(&message) {
            session.waiting = Some(WaitingPress { message, request });
            return Vec::new();
        }
    }
    take_in(session, message);
    if let Some(message) = released(session) {
        take_in(session, message);
    }
    std::mem::take(&mut session.effects)
}

/// Maximum rounds of questions, in case a session never stops asking: windows are fitted after the first round,
/// and a press may wait for the answers about several motions in turn.
const ROUNDS: usize = 12;

/// Answers the questions of a session until there are none left; questions for which `answer` returns no
/// message stay open.
pub fn settle(session: &mut Session, mut answer: impl FnMut(&Session, &Request) -> Option<Msg>) {
    for _ in 0..ROUNDS {
        let mut open = session.wants();
        open.retain(|request| session.is_open(request));
        for request in open {
            if let Some(message) = answer(session, &request) {
                update(session, message);
            }
        }
    }
}

/// Takes a message in that does not have to wait.
fn take_in(session: &mut Session, message: Msg) {
    session.chord += u32::from(is_press(&message));
    let answered = matches!(message, Msg::Answered(_));
    match message {
        Msg::Key(key) => press(session, key),
        Msg::Paste(text) => paste(session, &text),
        Msg::Pointed(pointed) => {
            session.notice = None;
            session.price = Price::default();
            session.measuring = false;
            session.attempt(|session| plots::pointed(session, pointed));
        }
        Msg::Resize { width, height } => session.size = Size { width, height },
        Msg::Answered(reply) => take(session, *reply),
        Msg::Run(line) => {
            session.price = Price { key: Some(ENTER), ..Price::default() };
            (session.overlay, session.pending, session.notice) = (None, None, None);
            session.attempt(|session| run_line(session, &line));
        }
        Msg::Start(names) => history::begin(session, names),
        Msg::Ask { text, answer, place } => {
            session.caption = SessionCaption::Asked(text, place, answer);
        }
        Msg::Chapter(name) => session.chapter = name,
        Msg::Say(caption, place) => {
            // An empty caption says that a replay is over.
            session.caption = if caption.is_empty() {
                session.chapter.clear();
                SessionCaption::Nothing
            } else {
                SessionCaption::Tour(caption, place)
            };
        }
        Msg::Read { path, purpose, result } => {
            session.attempt(|session| files::read(session, &path, purpose, result));
        }
        Msg::Written(notice) => (session.writing, session.notice) = (None, Some(notice)),
        Msg::Told(notice) => session.notice = Some(notice),
        Msg::Elapsed { seconds } => session.elapse(seconds),
    }
    answers::follow_fit(session);
    keep_selection(session);
    compare::follow(session);
    session.preview = preview::of(session);
    let previewed = session.preview.iter().flat_map(|preview| preview.asks());
    session.answers.ask(session.asks().into_iter().chain(previewed).collect());
    lists::follow(session, answered);
    answers::resolve(session);
    session.keep_course();
    // It has the windows that were fitted just now.
    compare::follow(session);
    walk::keep_hold(session);
    kick::keep(session);
    if session.chord > 0 && session.overlay.is_none() && session.pending.is_none() {
        session.asked = std::mem::take(&mut session.chord);
    }
}

/// Whether a message is input of the user.
pub fn is_press(message: &Msg) -> bool {
    matches!(message, Msg::Key(_) | Msg::Paste(_) | Msg::Pointed(_) | Msg::Run(_))
}

/// Pasted text goes into the open line, a number into a new line; assignments are made, and keystrokes are offered as a
/// replay.
fn paste(session: &mut Session, text: &str) {
    session.notice = None;
    if session.contexts()[0].takes_text() {
        prompt::insert(session, text);
        return;
    }
    let number = text.trim().parse::<f64>().is_ok();
    if number && session.overlay.is_none() && session.focus == Pane::Parameters {
        let entry = Prompt::of_row(session.selected, text.trim());
        session.overlay = Some(Overlay::Prompt(entry));
        return;
    }
    if session.overlay.is_none() && called(text).0 == "set" {
        return session.attempt(|session| values::paste(session, text));
    }
    // Text that names no key in angle brackets was probably pasted by mistake.
    if !text.contains('<') && !text.trim_start().starts_with('#') {
        return session
            .refuse("the pasted text names no key such as <right>: it is not a keystroke file");
    }
    match parse(text) {
        Ok(script) if script.keys() > 0 => session.overlay = Some(Overlay::Offer(script)),
        Ok(_) => session.inform("the pasted text presses no key"),
        Err(error) => session.refuse(format!("the pasted text is not a keystroke file: {error}")),
    }
}

/// Takes an answer of the worker; reports a failure if the question is still asked.
fn take(session: &mut Session, reply: Reply) {
    let name = reply.request.topic().name();
    let failure = reply.result.as_ref().err().cloned();
    let failure = failure.filter(|why| *why != NoAnswer::Reason(Reason::Interrupted));
    if let (true, Some(failure)) = (session.take(reply), failure) {
        let again = session.with_keys("{retry} tries again");
        session.refuse(format!("{name}: {failure}; {again}"));
    }
}

/// Keeps the selection on a row that the pane shows.
fn keep_selection(session: &mut Session) {
    let rows = session.rows();
    if !rows.contains(&session.selected) {
        let mut after = Row::all().skip_while(|row| *row != session.selected);
        let next = after.find(|row| rows.contains(row));
        session.selected = next.or(rows.last().copied()).unwrap_or_default();
    }
}

/// Releases the press that waits, if its answer is there or will not come.
fn released(session: &mut Session) -> Option<Msg> {
    let message = session.waiting.as_ref()?.message.clone();
    let request = session.awaited(&message);
    session.waiting = request.map(|request| WaitingPress { message: message.clone(), request });
    session.waiting.is_none().then_some(message)
}

/// Handles a key press.
fn press(session: &mut Session, key: Key) {
    session.notice = None;
    session.measuring = false;
    session.price = Price { key: Some(key), ..Price::default() };
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
        prompt::insert(session, &char.to_string());
    } else if let Some(command) = elsewhere(session, key) {
        run_where_it_belongs(session, command, key);
    } else {
        let text = format!("{} has no meaning here; {{help}} lists the keys", key.said());
        session.inform_of_keys(&text);
    }
}

/// Handles the key that completes a count or a letter.
fn resolve(session: &mut Session, pending: PendingInput, key: Key) {
    if let Some(command) = session.keymap.command(&[pending.context()], key) {
        return run(session, command, key);
    }
    session.pending = None;
    let again = session.keymap.command(session.contexts(), key);
    let letter = key.typed().filter(char::is_ascii_lowercase);
    match (pending, letter) {
        (PendingInput::Count(count), _) => repeat(session, key, count.max(1)),
        (PendingInput::Mark, Some(name)) => compare::set_mark(session, name),
        (PendingInput::GoTo, Some(name)) => {
            session.attempt(|session| compare::go_to_mark(session, name));
        }
        // The key that asked for the letter, pressed again, means the last point.
        (PendingInput::GoTo, None) if again.is_some_and(|it| it.name == "go-to-mark") => {
            session.attempt(compare::go_back);
        }
        (_, None) if session.keymap.command(&[Context::Always], key).is_some() => act(session, key),
        (_, None) => session.refuse(format!("{} is not a letter from a to z", key.said())),
    }
}

/// Presses a key `count` times as one change. Stops early if a press is refused, opens something, quits, or
/// asks for a letter.
fn repeat(session: &mut Session, key: Key, count: u32) {
    let depth = session.history.depth().0;
    let open = |session: &Session| session.overlay.as_ref().map(Overlay::kind);
    let before = open(session);
    for _ in 0..count {
        if !session.means(key) {
            act(session, key);
            break;
        }
        session.notice = None;
        act(session, key);
        let refused = session.notice.as_ref().is_some_and(|notice| notice.error);
        if refused || open(session) != before || session.quit || session.pending.is_some() {
            break;
        }
    }
    session.history.merge(depth);
}
