//! Notices to the user.

use crate::session::effect::Effect;
use crate::session::message::Notice;
use crate::session::message::key::Key;
use crate::session::state::session::Session;

/// Shows a notice that reports no refusal. Returns no effects, so that a command can end with it.
pub(in crate::session) fn inform(session: &mut Session, text: impl Into<String>) -> Vec<Effect> {
    session.notice = Some(Notice { error: false, text: text.into() });
    Vec::new()
}

/// A sentence in which each `{command}` is replaced by the key of that command.
pub(in crate::session) fn with_keys(session: &Session, sentence: &str) -> String {
    session.keymap.fill(sentence, Key::said)
}

/// Shows a notice that says what was refused. Returns no effects, like [`inform`].
pub(in crate::session) fn refuse(session: &mut Session, text: impl Into<String>) -> Vec<Effect> {
    session.notice = Some(Notice { error: true, text: text.into() });
    Vec::new()
}

/// Shows what is unlikely about the numbers of the machine that was just read or typed.
pub(in crate::session) fn warn_of_units(session: &mut Session) -> Vec<Effect> {
    session.unlikely_number().map_or_else(Vec::new, |line| inform(session, line))
}
