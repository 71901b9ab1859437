//! A beside B in words: what differs in a row of the parameters, the margins of both points, and what becomes of both
//! motions.

use super::{margin, margin::Sizes, pane, verdict};
use crate::numerics::decimal_sum;
use crate::picture::Role;
use crate::portrait::{Border, Drawing, Margin};
use crate::scene::Topic;
use crate::session::{Row, Session};
use crate::words::{cycles, exact};

/// What stands behind a row in this room: its value at the pinned point, and how far the present one is from that; `None`
/// where both are the same. A value is not cut: that before it moves to the left.
pub fn row(
    session: &Session,
    row: Row,
    room: usize,
    value: impl Fn(&Session, usize) -> String,
) -> Option<String> {
    /// Columns of a number, and of one whose digits all matter: those that follow from others have more.
    const NUMBER: usize = 8;
    const EXACT: usize = 14;
    let ([present, pinned], other) = (session.letters()?, session.other.as_deref()?);
    if value(session, usize::MAX) == value(other, usize::MAX) {
        return None;
    }
    let theirs = format!("{pinned} {}", value(other, room.saturating_sub(4).clamp(NUMBER, EXACT)));
    let short = ["  ", " "].map(|blanks| format!("{blanks}{theirs}"));
    let Row::Number(knob) = row else { return Some(pane::fitting(short, room)) };
    let difference = decimal_sum(session.value(knob), -other.value(knob));
    let difference = format!("{present}-{pinned} {}", exact(difference, NUMBER));
    let long = ["  ", " "].map(|blanks| format!("  {theirs}{blanks}{difference}"));
    Some(pane::fitting(long.into_iter().chain(short), room))
}

/// Both counts of cycles, where they differ.
pub fn counts(session: &Session) -> Option<String> {
    let told = session.sides()?.map(|(letter, of)| Some((letter, fresh(of)?.cycles.len())));
    let [Some((a, first)), Some((b, second))] = told else { return None };
    (first != second).then(|| format!("{a} {}, {b} {}", cycles(first), cycles(second)))
}

/// The margins of both points, A first.
pub fn margins(session: &Session, width: usize) -> Option<String> {
    /// Columns of what leads, and of a margin without names.
    const REST: usize = 44;
    let sides = session.sides()?;
    let beside = known(sides[0].1).map_or([None; 2], |it| margin::sizes(sides[0].1, it.from_rest));
    let room = width.saturating_sub(REST);
    let told = sides.map(|(letter, of)| margin(of, letter, beside, room));
    let [Some(a), Some(b)] = told else { return None };
    // One margin is told as always.
    let differ = a[1..] != b[1..];
    // What the numbers are is said once.
    let b = ["shift ", "impulse "].iter().fold(b, |told, name| told.replace(name, ""));
    differ.then(|| format!("margin from rest: {a}; {b}"))
}

/// That of one of them; `None` while it is not known.
fn margin(session: &Session, letter: &str, beside: Sizes, width: usize) -> Option<String> {
    let known = known(session)?;
    Some(match fresh(session)?.portrait.border {
        Border::NoBasin => format!("{letter} rest repels"),
        _ => margin::in_pane(session, (letter, &known), beside, width)
            .unwrap_or_else(|| format!("{letter} every kick is survived")),
    })
}

fn known(session: &Session) -> Option<Margin> {
    let found = fresh(session).filter(|found| found.parameters.r > 0.0)?;
    Some(session.machine_margins().map_or(found.margin, |both| both.whole))
}

/// What becomes of both motions, A first; `None` where none is pinned.
pub fn outcomes(session: &Session) -> Option<String> {
    let told = session.sides()?.map(|(letter, of)| (letter, verdict::outcome(of)));
    let [(a, (first, Role::Text)), (b, (second, Role::Text))] = told else { return None };
    // Why it is so is told of one motion.
    let [first, second] = [first, second].map(|it| it.split(" (").next().unwrap_or(&it).to_owned());
    (first != second).then(|| format!("{a} {first}; {b} {second}"))
}

/// The cycles of a session, if they are not those of other numbers.
fn fresh(session: &Session) -> Option<&Drawing> {
    session.cycles().filter(|_| !session.is_stale(Topic::Cycles, session.plot))
}
