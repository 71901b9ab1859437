//! What becomes of the motion and why, in a sentence; in its place the point of a branch that is held.

use super::{Look, margin, pane};
use crate::branch::SpecialKind;
use crate::flow::{Fate, Motion, Outcome};
use crate::model::Units;
use crate::picture::{Role, units};
use crate::portrait::{Border, Cycle, Drawing, Portrait};
use crate::scene::{Finding, Layer, Topic};
use crate::session::fate::End;
use crate::session::{BranchStop, Session, TriedKick};
use crate::words::motion::{of_machine, sentence, swings};
use crate::words::{Notation, joined, significant, stability};

/// What became of the motion, in a sentence; of a kick first whether it is survived, and of one that is being tried that
/// only when it is seen.
pub fn outcome(session: &Session) -> (String, Role) {
    if session.is_asked() {
        return ("what becomes of it?".into(), Role::Text);
    }
    let kick = session.kick().filter(|kick| !kick.is_shift);
    if let Some(kick) = kick.filter(|_| session.kicking && session.is_under_way()) {
        return (tried(session, kick), Role::Cursor);
    }
    let (text, role) = end_of_motion(session);
    match kick.filter(|_| role == Role::Text).and_then(|_| session.survives()) {
        Some(survives) => (format!("{}: {text}", if survives { SURVIVED } else { LOST }), role),
        None => (text, role),
    }
}

/// What is said of a kick after which the mass comes to rest again, and of any other.
const SURVIVED: &str = "survived";
const LOST: &str = "lost";

/// The kick that is being played, whose end is not told yet.
fn tried(session: &Session, TriedKick { size, border, .. }: TriedKick) -> String {
    let place = Notation(units::shown(session)).position(session.problem.initial.q, 3);
    let size_told = margin::told(session, false, [size, border.unwrap_or(size)], 4);
    let part = border.map_or_else(String::new, |border| {
        format!(", {} of the margin there", significant(size / border, 2))
    });
    format!("kick {size_told} from rest at {place}{part}: ..")
}

/// What became of the motion.
fn end_of_motion(session: &Session) -> (String, Role) {
    let asked = session.follows_motion();
    if let Some(text) = held_motions(session).filter(|_| !asked) {
        return (text, Role::Quiet);
    }
    if !session.layers.contains(&Layer::Trajectory) {
        return ("the motion is not shown".into(), Role::Quiet);
    }
    if let Some(failure) = session.failure(Topic::Trajectory, session.plot) {
        return (format!("no motion: {failure}"), Role::Failure);
    }
    let Some(found) = session.trajectory() else {
        // Where no plot shows it, it is not computed.
        let text = if asked {
            "computing the motion"
        } else {
            "the motion is not shown"
        };
        return (text.into(), Role::Quiet);
    };
    if session.is_under_way() {
        let text = session.with_keys("under way; {drop-cursor} shows the whole motion");
        return (text, Role::Quiet);
    }
    let running = session.running().filter(|_| session.draws_whole());
    if let Some((running, course)) = running.zip(session.course()) {
        return (by_whole_model(course, &running.reduced.units, found), Role::Text);
    }
    let notation = Notation(units::shown(session));
    if let Some((tau, q)) = session.contact() {
        // The mass would overtake its belt earlier.
        let (time, place) = (notation.moment(tau, 3), notation.position(q, 3));
        let text = format!("sticks to the belt at {time}, {place}: the model ends there");
        return (text, Role::Warning);
    }
    let text = match session.fate() {
        Some(end) => verdict(end, session.cycles_beside(found), found, notation),
        None => sentence(found, notation),
    };
    (text, Role::Text)
}

/// Ends of motions by their words in documents, and what is said where several end so.
const ENDS: [(&str, &str); 4] = [
    ("captured", "come to rest"),
    ("moving", "still move"),
    ("escaped", "escape"),
    ("gave-up", "given up"),
];

/// What became of the motions that plots hold, where there are any and all are known.
fn held_motions(session: &Session) -> Option<String> {
    let plots = session.on_show().filter(|plot| session.variants(*plot).is_some());
    let motions = |plot| session.found(Topic::Trajectory, plot, Finding::try_as_trajectory_ref);
    let words: Vec<_> = plots.flat_map(motions).map(|(_, found)| found.outcome.word()).collect();
    let parts = ENDS.into_iter().filter_map(|(word, said)| {
        let count = words.iter().filter(|own| **own == word).count();
        (count > 0).then(|| format!("{count} {said}"))
    });
    (!words.is_empty()).then(|| format!("{} motions: {}", words.len(), joined(parts, ", ")))
}

/// What becomes of a motion and why, in a sentence.
fn verdict(end: End, among: Option<&Drawing>, motion: &Motion, notation: Notation) -> String {
    let border = among.and_then(|found| match found.portrait.border {
        border if border.parts_without_cycle() => Some("separatrix"),
        _ => found.cycles.iter().any(|cycle| !cycle.stable).then_some("unstable cycle"),
    });
    let side = if matches!(end, End::Rests | End::Decays) {
        "inside"
    } else {
        "outside"
    };
    let why = border.map_or_else(String::new, |border| format!(" ({side} the {border})"));
    let end = match (end, motion.outcome) {
        (End::OnTheEdge { distance }, _) => {
            let distance = significant(distance, 1);
            return format!("on the unstable cycle to {distance}: decided by rounding");
        }
        (End::Rests, Outcome::Captured { .. }) if motion.crossings.is_empty() => {
            return sentence(motion, notation);
        }
        (End::Rests, Outcome::Captured { q, .. }) => {
            let (place, swings) = (notation.position(q, 3), swings(motion.crossings.len()));
            format!("comes to rest at {place}{swings}")
        }
        (End::Rests, _) => {
            format!("comes to rest, after {}", notation.moment(motion.problem.until, 3))
        }
        (End::Onto { q_max, grows }, _) => {
            let way = if grows { "grows" } else { "falls" };
            format!("{way} onto the stable cycle, {}", notation.amplitude(q_max, 4))
        }
        (End::Grows, Outcome::Escaped { .. }) => sentence(motion, notation),
        (End::Grows, _) => "grows without bound".to_owned(),
        (End::Decays, _) => "decays towards the equilibrium".to_owned(),
    };
    end + &why
}

/// What becomes of the motion of a machine, in its own units, by the whole model.
fn by_whole_model((portrait, fate): (&Portrait, Fate), units: &Units, motion: &Motion) -> String {
    let within = match portrait.border {
        Border::Cycle => " (inside the unstable cycle)",
        Border::Grazing => " (inside the motion that touches the belt)",
        Border::Capture => " (inside the motion that ends where the guide just holds)",
        Border::Separatrix => " (inside the separatrix)",
        Border::None | Border::NoBasin | Border::Unknown(_) => "",
    };
    let rest = match motion.outcome {
        Outcome::Captured { tau, q } => [Some(q * units.displacement), Some(tau * units.time)],
        _ => [None; 2],
    };
    of_machine(fate, rest, portrait.tends_to(fate), within, 4)
}

/// Significant digits: as many as fit, at most as many as distinguish special points from others.
const DIGITS: [usize; 5] = [10, 8, 6, 5, 4];

/// What is held, in a line of at most `width` columns if that is possible; `None` where nothing is.
pub fn held_point(session: &Session, look: &Look, width: u16) -> Option<String> {
    let held = session.held?;
    let numbers = session.numbers_over(session.plot);
    let names: Vec<&str> = numbers.iter().map(|knob| knob.spec().name).collect();
    let shown = session.shown(session.plot);
    // The present values stand in the parameter pane.
    let other = shown.get(held.variant).filter(|shown| !shown.present);
    // Of curves over two numbers, that on which the point lies.
    let curves = held.up.map(|up| (session.curves_over_two(session.plot), [held.value, up]));
    let curve = curves.and_then(|(curves, at)| {
        curves.into_iter().find(|(_, points)| points.contains(&at)).map(|(name, _)| name)
    });
    let label = curve.or(other.map(|shown| shown.variant.label.clone())).unwrap_or_default();
    let line = |digits: &usize| point(&names, &label, &held, *digits, &look.symbols().dot);
    // The status line begins with a blank and a symbol.
    Some(pane::fitting(DIGITS.iter().map(line), usize::from(width).saturating_sub(4)))
}

fn point(names: &[&str], label: &str, held: &BranchStop, digits: usize, dot: &str) -> String {
    let values = std::iter::once(held.value).chain(held.up);
    let number = |(name, value): (&&str, f64)| format!("{name} {}", significant(value, digits));
    let mut parts: Vec<String> = names.iter().zip(values).map(number).collect();
    // The values that the variant holds, where the diagram shows several.
    parts.extend(Some(label.to_owned()).filter(|label| !label.is_empty()));
    if let Some(kind) = held.special {
        parts.insert(0, kind.name(held.cycle.as_ref()).to_owned());
    }
    match &held.cycle {
        None if held.up.is_some() => {}
        None => parts.push("the cycle is infinite".to_owned()),
        Some(cycle) => {
            // Neither at a fold nor where the cycle vanishes.
            if !matches!(held.special, Some(SpecialKind::Fold | SpecialKind::Hopf)) {
                parts.insert(0, stability(cycle.stable).to_owned());
            }
            let short = digits.min(5);
            let [low, high] = [cycle.q_min, cycle.q_max].map(|end| significant(end, short));
            parts.push(format!("q {low} .. {high}"));
            parts.push(format!("period {}", significant(cycle.period, short)));
            parts.push(format!("multiplier {}", multiplier(cycle)));
        }
    }
    parts.join(&format!(" {dot} "))
}

/// The multiplier, as a power of e where it is too large or too small to be read.
pub fn multiplier(cycle: &Cycle) -> String {
    match cycle.multiplier {
        Some(multiplier) if multiplier > 0.0 || cycle.log_multiplier.is_infinite() => {
            significant(multiplier, 4)
        }
        _ => format!("e^{}", significant(cycle.log_multiplier, 4)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Reason;

    #[test]
    fn motions_that_end_in_any_way_are_counted() {
        let ends: [Outcome; 4] = [
            Outcome::Captured { tau: 0.0, q: 0.0 },
            Outcome::Moving { tau: 0.0, q: 0.0, v: 0.0 },
            Outcome::Escaped { tau: 0.0 },
            Outcome::GaveUp { tau: 0.0, reason: Reason::Interrupted },
        ];
        for end in ends {
            assert!(ENDS.iter().any(|(word, _)| *word == end.word()), "{end:?}");
        }
    }
}
