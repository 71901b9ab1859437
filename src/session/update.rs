//! The transition of a session: [`update`] takes a message in and returns the effects for the outer rings.
//!
//! Nothing here reads a clock or touches a file, so a session is determined by its messages, and every defect
//! can be reproduced by a keystroke file. The modules beside this one do what commands ask for, one concern
//! each.

use crate::flow::Reason;
use crate::question::NoAnswer;
use crate::scene::{Answered, Request};
use crate::session::act::notice::{attempt, inform, refuse, with_keys};
use crate::session::act::{answers, files, history, mouse, typing, walk};
use crate::session::effect::Effect;
use crate::session::message::Msg;
use crate::session::press::{ENTER, press, run_untyped};
use crate::session::read::waiting;
use crate::session::replay::parse::parse;
use crate::session::replay::script::Instruction;
use crate::session::state::{
    Entry, Overlay, Pane, Price, Row, Session, SessionCaption, Size, Waiting,
};

/// Takes a message in; a press that needs an answer that is still being computed waits for it.
pub fn update(session: &mut Session, message: Msg) -> Vec<Effect> {
    if is_press(&message) {
        // While a press waits, the only press that arrives here is one that cancels it.
        if session.waiting.take().is_some() && waiting::forgets(&message) {
            inform(session, "the waiting key is dropped");
            return Vec::new();
        }
        if let (Some(request), Some(step)) = (session.awaited(&message), Instruction::of(&message))
        {
            session.waiting = Some(Waiting { step, request });
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
    match message {
        Msg::Key(key) => press(session, key),
        Msg::Paste(text) => paste(session, &text),
        Msg::Pointed(pointed) => {
            session.notice = None;
            session.price = Price::default();
            session.measuring = false;
            attempt(session, |session| mouse::pointed(session, pointed));
        }
        Msg::Resize { width, height } => session.size = Size { width, height },
        Msg::Answered(answered) => take(session, *answered),
        Msg::Run(line) => {
            session.price = Price { key: Some(ENTER), recomputed: Vec::new() };
            run_untyped(session, &line);
        }
        Msg::Start(names) => history::begin(session, names),
        Msg::Say(caption, place) => {
            // An empty caption says that a replay is over.
            session.caption = if caption.is_empty() {
                SessionCaption::Nothing
            } else {
                SessionCaption::Tour(caption, place)
            };
        }
        Msg::Read { path, purpose, result } => {
            attempt(session, |session| files::read(session, &path, purpose, result));
        }
        Msg::Written(notice) => {
            (session.writing, session.notice) = (None, Some(notice));
        }
        Msg::Told(notice) => session.notice = Some(notice),
        Msg::Elapsed { seconds } => session.elapse(seconds),
        Msg::Idle => {}
    }
    answers::follow_fit(session);
    keep_selection(session);
    let asked = session.asks().into_iter().chain(session.compared().cloned()).collect();
    session.answers.ask(asked);
    answers::resolve(session);
    walk::keep_hold(session);
    if session.chord > 0 && session.overlay.is_none() && session.pending.is_none() {
        session.asked = std::mem::take(&mut session.chord);
    }
}

/// Whether a message is input of the user.
fn is_press(message: &Msg) -> bool {
    matches!(message, Msg::Key(_) | Msg::Paste(_) | Msg::Pointed(_) | Msg::Run(_))
}

/// Pasted text goes into the open line, a number into a new line; keystrokes are offered as a replay.
fn paste(session: &mut Session, text: &str) {
    session.notice = None;
    if session.contexts()[0].takes_text() {
        typing::insert(session, text);
        return;
    }
    let number = text.trim().parse::<f64>().is_ok();
    if number && session.overlay.is_none() && session.focus == Pane::Parameters {
        let entry = Entry::new(session.selected, text.trim().to_owned());
        session.overlay = Some(Overlay::Entry(entry));
        return;
    }
    // Text that names no key in angle brackets was probably pasted by mistake.
    if !text.contains('<') && !text.trim_start().starts_with('#') {
        return refuse(
            session,
            "the pasted text names no key such as <right>: it is not a keystroke file",
        );
    }
    match parse(text) {
        Ok(script) if script.keys() > 0 => {
            session.overlay = Some(Overlay::Offer(script));
        }
        Ok(_) => inform(session, "the pasted text presses no key"),
        Err(error) => refuse(session, format!("the pasted text is not a keystroke file: {error}")),
    }
}

/// Takes an answer of the worker; reports a failure if the question is still asked.
fn take(session: &mut Session, answered: Answered) {
    let name = answered.request.topic().name();
    let failure = answered.result.as_ref().err().cloned();
    let asked = session.take(answered);
    if let Some(failure) = failure.filter(|_| asked)
        && failure != NoAnswer::Reason(Reason::Interrupted)
    {
        let again = with_keys(session, "{retry} tries again");
        refuse(session, format!("{name}: {failure}; {again}"));
    }
}

/// Keeps the selection on a row that the pane shows.
fn keep_selection(session: &mut Session) {
    let rows = session.rows();
    if !rows.contains(&session.selected) {
        let mut after = Row::all().skip_while(|row| *row != session.selected);
        session.selected = after.find(|row| rows.contains(row)).unwrap_or(Row::Tolerance);
    }
}

/// Releases the press that waits, if its answer is there or will not come.
fn released(session: &mut Session) -> Option<Msg> {
    let message = session.waiting.as_ref()?.step.message()?;
    let request = session.awaited(&message);
    session.waiting = session
        .waiting
        .take()
        .zip(request)
        .map(|(waiting, request)| Waiting { request, ..waiting });
    (!session.is_waiting()).then_some(message)
}
