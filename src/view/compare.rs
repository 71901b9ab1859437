//! A beside B in words: what differs in a row of the parameters, the margins of both points, and what becomes of both
//! motions.

use super::{Look, margin, pane, parameters, verdict};
use crate::numerics::decimal_sum;
use crate::picture::Role;
use crate::portrait::Border;
use crate::scene::Topic;
use crate::session::{Letter, Row, Session};
use crate::words::{cycles, exact};

/// Columns of a difference.
const DIFFERENCE: usize = 10;

/// What a row is at the pinned point, and how far the present value is from that; `None` where both are the same.
pub fn row(session: &Session, row: Row, width: usize, look: &Look) -> Option<String> {
    let (other, [present, pinned]) = both(session)?;
    let value = |of: &Session, width| parameters::value(of, &of.setup(), row, width, look);
    if value(session, usize::MAX) == value(other, usize::MAX) {
        return None;
    }
    let theirs = format!("{pinned} {}", value(other, width.saturating_sub(2)));
    let Row::Number(knob) = row else { return Some(theirs) };
    let difference = decimal_sum(session.value(knob), -other.value(knob));
    let difference = format!("{present}-{pinned} {}", exact(difference, DIFFERENCE));
    let both = ["  ", " "].map(|blanks| format!("{theirs}{blanks}{difference}"));
    Some(pane::fitting(both.into_iter().chain([theirs]), width))
}

/// Both counts of cycles, where they differ.
pub fn counts(session: &Session) -> Option<String> {
    let (other, [present, pinned]) = both(session)?;
    let [own, theirs] = [session, other].map(|it| Some(fresh(it)?.cycles.len()));
    let (own, theirs) = own.zip(theirs).filter(|(own, theirs)| own != theirs)?;
    Some(format!("{present} {}, {pinned} {}", cycles(own), cycles(theirs)))
}

/// The margins of both points, A first.
pub fn margins(session: &Session, width: usize) -> Option<String> {
    /// Columns of what leads, and of a margin without names.
    const REST: usize = 44;
    let told =
        in_order(session)?.map(|(letter, of)| margin(of, letter, width.saturating_sub(REST)));
    let [Some(a), Some(b)] = told else { return None };
    // What the numbers are is said once.
    let b = ["shift ", "impulse "].iter().fold(b, |told, name| told.replace(name, ""));
    Some(format!("margin from rest: {a}; {b}"))
}

/// That of one of them; `None` while it is not known.
fn margin(session: &Session, letter: &str, width: usize) -> Option<String> {
    let found = fresh(session)?;
    let known = session.machine_margins().map_or(found.margin, |both| both.whole);
    Some(match found.portrait.border {
        Border::NoBasin => format!("{letter} rest repels"),
        _ if found.parameters.r == 0.0 => format!("{letter} no friction"),
        _ => margin::in_pane(session, letter, &known, width)
            .unwrap_or_else(|| format!("{letter} every kick is survived")),
    })
}

/// What becomes of both motions, A first; `None` where none is pinned.
pub fn outcomes(session: &Session) -> Option<String> {
    let told = in_order(session)?.map(|(letter, of)| (letter, verdict::outcome(of)));
    let [(a, (first, Role::Text)), (b, (second, Role::Text))] = told else { return None };
    // Why it is so is told of one motion.
    let [first, second] = [first, second].map(|it| it.split(" (").next().unwrap_or(&it).to_owned());
    Some(format!("{a} {first}; {b} {second}"))
}

/// The session at the pinned point, and the letters of the present one and of that.
fn both(session: &Session) -> Option<(&Session, [&'static str; 2])> {
    Some((session.pinned()?, session.letters()?.map(Letter::name)))
}

/// Both sessions with their letters, A first.
fn in_order(session: &Session) -> Option<[(&'static str, &Session); 2]> {
    let (other, [present, pinned]) = both(session)?;
    let mut all = [(present, session), (pinned, other)];
    all.sort_by_key(|(letter, _)| *letter);
    Some(all)
}

/// The cycles of a session, if they are not those of other numbers.
fn fresh(session: &Session) -> Option<&crate::portrait::Drawing> {
    session.cycles().filter(|_| !session.is_stale(Topic::Cycles, session.plot))
}
