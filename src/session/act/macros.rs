//! Macros: keys that are recorded into registers and played again.
//!
//! A macro is a short keystroke file. When keys are played during a recording, the recording has these keys and
//! not the command that played them, so that a recorded macro is self-contained and never plays another.

use crate::session::act::history::snapshot;
use crate::session::act::notice::{inform, refuse};
use crate::session::effect::Effect;
use crate::session::message::Msg;
use crate::session::replay::recorder::Recorder;
use crate::session::replay::script::Script;
use crate::session::state::macros::Played;
use crate::session::state::pending::{Letter, Pending};
use crate::session::state::session::Session;

/// Maximum number of keys that a macro presses, repetitions included.
const MOST: u64 = 100_000;

/// Counts and records a message if it is input of the user.
pub(in crate::session) fn note(session: &mut Session, message: &Msg) {
    let macros = &mut session.macros;
    if matches!(message, Msg::Key(_) | Msg::Paste(_) | Msg::Pointed(_) | Msg::Run(_)) {
        macros.chord += 1;
        if let Some(played) = &mut macros.played {
            played.left = played.left.saturating_sub(1);
        }
        if let Some((_, recorder)) = &mut macros.recording {
            recorder.note(message);
        }
    }
}

/// Begins a new chord if nothing is open and nothing pending.
pub(in crate::session) fn rest(session: &mut Session) {
    if session.macros.played.as_ref().is_some_and(|played| played.left == 0) {
        end(session);
    }
    let macros = &mut session.macros;
    if macros.chord > 0 && session.overlay.is_none() && session.pending.is_none() {
        macros.asked = std::mem::take(&mut macros.chord);
    }
}

/// Asks for a register to record into, or ends the present recording.
pub fn record_or_end(session: &mut Session) -> Vec<Effect> {
    match session.macros.recording.take() {
        None => session.pending = Some(Pending::Letter { what: Letter::Record, count: 1 }),
        Some((register, mut recorder)) => {
            recorder.forget(session.macros.chord);
            let steps = recorder.steps().to_vec();
            let presses = Script::repeated(&steps, 1).keys();
            session.macros.registers.insert(register, steps);
            session.macros.last = Some(register);
            let keys = if presses == 1 { "key" } else { "keys" };
            inform(session, format!("register {register} has {presses} {keys}"));
        }
    }
    Vec::new()
}

pub(in crate::session) fn record(session: &mut Session, register: char) -> Vec<Effect> {
    session.macros.recording = Some((register, Recorder::default()));
    inform(session, format!("recording into register {register}"))
}

/// Removes the command that plays keys from the recording, so that these keys are recorded instead.
pub(in crate::session) fn inline(session: &mut Session) {
    let chord = session.macros.chord;
    if let Some((_, recorder)) = &mut session.macros.recording {
        recorder.forget(chord);
    }
}

/// Plays a register this many times.
pub(in crate::session) fn play(session: &mut Session, register: char, times: u32) -> Vec<Effect> {
    let Some(steps) = session.macros.registers.get(&register) else {
        return refuse(session, format!("register {register} is empty"));
    };
    let keys = Script::repeated(steps, 1).keys();
    if keys * u64::from(times) > MOST {
        return refuse(session, format!("{times} times {keys} keys are more than {MOST}"));
    }
    let script = Script::repeated(steps, times);
    inline(session);
    session.macros.last = Some(register);
    let left = script.presses();
    if let Some(played) = &mut session.macros.played {
        // A register from a file can play another one.
        played.left += left;
    } else {
        let (depth, before) = (session.history.depth().0, Box::new(snapshot(session)));
        session.macros.played = Some(Played { left, depth, before });
    }
    vec![Effect::PlayRegister(script)]
}

/// Merges all changes made by a register into one, when it has been played to its end or was stopped.
pub(in crate::session) fn end(session: &mut Session) {
    if let Some(Played { depth, before, .. }) = session.macros.played.take() {
        session.history.merge_all(depth, before);
    }
}

/// Plays the register that was played or recorded last.
pub(in crate::session) fn play_again(session: &mut Session, times: u32) -> Vec<Effect> {
    if let Some(register) = session.macros.last {
        return play(session, register, times);
    }
    refuse(session, "no register has been played yet")
}
