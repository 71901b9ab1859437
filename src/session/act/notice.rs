//! Lines for the user.

use crate::session::effect::Effect;
use crate::session::message::Notice;
use crate::session::message::key::Key;
use crate::session::state::session::Session;

/// Shows a line that is not a complaint. That is all a command did that ends with it: the outer rings have
/// nothing to do.
pub(in crate::session) fn inform(session: &mut Session, text: impl Into<String>) -> Vec<Effect> {
    session.notice = Some(Notice { error: false, text: text.into() });
    Vec::new()
}

/// A sentence in which `{command}` stands for the key of that command.
pub(in crate::session) fn with_keys(session: &Session, sentence: &str) -> String {
    session.keymap.fill(sentence, Key::said)
}

/// Shows a line that says what was refused, with no more to do than [`inform`].
pub(in crate::session) fn refuse(session: &mut Session, text: impl Into<String>) -> Vec<Effect> {
    session.notice = Some(Notice { error: true, text: text.into() });
    Vec::new()
}
