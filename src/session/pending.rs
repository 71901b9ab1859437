//! Keys that wait for the next one: a count before a key, and the letter of a register or a mark.

use super::history::Before;
use super::key::Key;
use super::keymap::Context;
use super::message::Effect;
use super::state::Session;
use super::update::{act, macros, marks, refuse};

/// Largest count.
pub const MOST: u32 = 9999;

/// What the next key is waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pending {
    /// More digits, or the key to be pressed so many times. Zero: no digit yet.
    Count(u32),
    /// The letter of a register or mark.
    Letter {
        /// What to do with it.
        what: Letter,
        /// How often.
        count: u32,
    },
}

/// What a letter is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Letter {
    /// The register in which to record.
    Record,
    /// The register to play.
    Play,
    /// The mark to set.
    Mark,
    /// The mark to go to.
    GoTo,
}

impl Letter {
    /// What is asked, for the footer.
    #[must_use]
    pub fn question(self) -> &'static str {
        match self {
            Letter::Record => "record into which register? a to z",
            Letter::Play => "play which register? a to z; the same key: the last one",
            Letter::Mark => "mark this point by which letter? a to z",
            Letter::GoTo => "go to which mark? a to z; the same key: the point left last",
        }
    }
}

/// Waits for more of a count; the digit is that of the key.
pub fn count(session: &mut Session, key: Key) -> Vec<Effect> {
    let before = match session.pending {
        Some(Pending::Count(before)) => before,
        _ => 0,
    };
    let digit = key.typed().and_then(|char| char.to_digit(10)).unwrap_or(0);
    session.pending = Some(Pending::Count((10 * before + digit).min(MOST)));
    Vec::new()
}

/// Deletes the last digit of a count.
pub fn delete_digit(session: &mut Session) -> Vec<Effect> {
    if let Some(Pending::Count(count)) = &mut session.pending {
        *count /= 10;
    }
    Vec::new()
}

/// Waits for a letter.
pub fn ask(session: &mut Session, what: Letter) -> Vec<Effect> {
    session.pending = Some(Pending::Letter { what, count: 1 });
    Vec::new()
}

/// Waits no longer.
pub fn drop(session: &mut Session) -> Vec<Effect> {
    session.pending = None;
    Vec::new()
}

/// Presses the key for which something was pending.
pub(super) fn resolve(session: &mut Session, pending: Pending, key: Key) -> Vec<Effect> {
    let context = match pending {
        Pending::Count(_) => Context::Count,
        Pending::Letter { .. } => Context::Letter,
    };
    if let Some(command) = session.keymap.command(&[context], key) {
        return (command.run)(session, key);
    }
    session.pending = None;
    match pending {
        Pending::Count(count) => repeat(session, key, count.max(1)),
        Pending::Letter { what, count } => letter(session, what, count, key),
    }
}

/// Presses a key many times, as one change: until something refuses, opens, or asks for a letter, which
/// then gets the count.
fn repeat(session: &mut Session, key: Key, count: u32) -> Vec<Effect> {
    let depth = session.history.depth().0;
    let overlay = session.overlay.clone();
    let mut effects = Vec::new();
    for _ in 0..count {
        if !session.means(key) {
            effects.extend(act(session, key));
            break;
        }
        session.notice = None;
        effects.extend(act(session, key));
        if let Some(Pending::Letter { count: times, .. }) = &mut session.pending {
            *times = count;
        }
        let refused = session.notice.as_ref().is_some_and(|notice| notice.error);
        let opened = match (&session.overlay, &overlay) {
            (Some(now), Some(before)) => now.differs(before),
            (now, before) => now.is_some() != before.is_some(),
        };
        if refused || opened || session.quit || session.pending.is_some() {
            break;
        }
    }
    session.history.merge(depth, |before| matches!(before, Before::Stand(_)));
    effects
}

/// Does what a letter was asked for. The key that asks stands for the last register or point.
fn letter(session: &mut Session, what: Letter, count: u32, key: Key) -> Vec<Effect> {
    let asks =
        |name| session.keymap.command(session.contexts(), key).is_some_and(|c| c.name == name);
    let name = match key.typed() {
        Some(name) if name.is_ascii_lowercase() => Some(name),
        _ => None,
    };
    match (what, name) {
        (Letter::Record, Some(name)) => macros::record(session, name),
        (Letter::Play, Some(name)) => macros::play(session, name, count),
        (Letter::Play, None) if asks("play-macro") => macros::play_again(session, count),
        (Letter::Mark, Some(name)) => marks::set(session, name),
        (Letter::GoTo, Some(name)) => marks::go_to(session, name),
        (Letter::GoTo, None) if asks("go-to-mark") => marks::go_back(session),
        (_, None) if session.keymap.command(&[Context::Always], key).is_some() => act(session, key),
        (_, None) => {
            refuse(session, format!("{key} is no letter from a to z"));
            Vec::new()
        }
    }
}
