//! Keys that need another key: a count before a key, and the letter of a mark.

use crate::session::message::key::Key;
use crate::session::state::pending::MOST;
use crate::session::state::{Letter, Pending, Session};

/// Adds the digit of this key to a count, and waits for more.
pub fn count(session: &mut Session, key: Key) {
    let before = match session.pending {
        Some(Pending::Count(before)) => before,
        _ => 0,
    };
    let digit = key.typed().and_then(|char| char.to_digit(10)).unwrap_or(0);
    session.pending = Some(Pending::Count((10 * before + digit).min(MOST)));
}

/// Deletes the last digit of a count.
pub fn delete_digit(session: &mut Session) {
    if let Some(Pending::Count(count)) = &mut session.pending {
        *count /= 10;
    }
}

/// Waits for a letter.
pub fn ask(session: &mut Session, what: Letter) {
    session.pending = Some(Pending::Letter(what));
}

pub fn forget(session: &mut Session) {
    session.pending = None;
}
