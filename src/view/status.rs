//! The status lines: what becomes of the motion, and which kicks are survived; while the accuracy is changed, how
//! the motion was computed and what that cost.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::{Look, fitted::UNRELIABLE, keys, machine, margin, pane, walk};
use crate::flow::{Outcome, Trajectory, trajectory::choice};
use crate::picture::{Role, units};
use crate::scene::{Answer, Layer, Topic};
use crate::session::fate::{End, MotionVerdict, SideOfBorder};
use crate::session::{Session, wants::named};
use crate::words::motion::{Writing, sentence, swings};
use crate::words::number::{count, duration, significant};

/// Draws the title line: what the scene is, and its name.
pub fn title(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let left = look.span(format!(" {}", session.scene.title), Role::Title);
    let right = look.span(format!("{} ", session.scene.name), Role::Quiet);
    pane::both_ends(area, 0, left, right, look, buffer);
}

/// Draws the status lines: the outcome first, then method, cost and error.
pub fn draw(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let (text, role) = if let Some(held) = walk::reading(session, look, area.width) {
        (held, Role::Cursor)
    } else {
        let (sentence, role) = outcome(session);
        let of = session.number(0).map_or_else(String::new, |number| format!("motion {number} "));
        // The symbol belongs to the motion: what else is said has none.
        let symbol = Some(symbol(session, look)).filter(|_| role == Role::Text);
        (format!("{}{of}{sentence}", symbol.unwrap_or_default()), role)
    };
    let fitting = session.is_fitting();
    let fitting = fitting.then(|| format!("fitting: {} motions, esc stops ", session.fitting));
    let computing = if session.is_busy() { "computing " } else { "" };
    let busy = fitting.as_deref().unwrap_or(computing);
    let busy = match session.writing.as_ref().and_then(|path| path.file_name()) {
        Some(name) => format!("{busy}writing {} ", name.display()),
        None => busy.to_owned(),
    };
    let busy = match session.keymap.key_of("play-motion").filter(|_| session.is_playing()) {
        Some(key) => format!("{busy}playing, {} holds ", keys::name(key, look)),
        None if session.is_playing() => format!("{busy}playing "),
        None => busy,
    };
    // That a computation is running matters more than the end of the sentence.
    let room = usize::from(area.width).saturating_sub(busy.chars().count());
    let text = pane::cut(&shorter(session, format!(" {text}"), room), room, look);
    let left = look.span(text, role);
    pane::both_ends(area, 0, left, look.span(busy, Role::Warning), look, buffer);

    let quiet = |text| look.span(text, Role::Quiet);
    // While the accuracy is changed, the cost stands here; at other times a key of its own lists it.
    if !session.measures() {
        let width = usize::from(area.width).saturating_sub(1);
        let text = margin::status(session, width).unwrap_or_default();
        let failed = text.starts_with(UNRELIABLE);
        let role = if failed { Role::Warning } else { Role::Quiet };
        return pane::line(area, 1, look.span(format!(" {text}"), role), look, buffer);
    }
    let line = |words| (work(session, look, words), price(session, look, words));
    let fits = |(left, right): &(String, String)| {
        left.chars().count() + right.chars().count() + 4 <= usize::from(area.width)
    };
    let (left, right) = WORDS.iter().map(line).find(fits).unwrap_or_else(|| line(&WORDS[3]));
    pane::both_ends(area, 1, quiet(format!(" {left}")), quiet(format!("{right} ")), look, buffer);
}

/// A verdict that fits into this many columns, if that is possible: why it is so matters more than after how many
/// half swings, or how large a cycle is that the parameter pane lists.
fn shorter(session: &Session, mut text: String, room: usize) -> String {
    let too_long = |text: &String| text.chars().count() > room;
    if let Some(swings) = session.trajectory().map(swings).filter(|_| too_long(&text)) {
        text = text.replacen(&swings, "", 1);
    }
    let size = [", q_max ", ", x_max "].into_iter().find_map(|size| text.split_once(size));
    let size = size.and_then(|(head, rest)| Some((head, rest.split_once(" (")?)));
    match size {
        Some((head, (_, why))) if too_long(&text) => format!("{head} ({why}"),
        _ => text,
    }
}

/// The words of the second line.
#[derive(Clone, Copy)]
struct StatusWords {
    evaluations: &'static str,
    error: &'static str,
    /// The same beside a dial at which another error would be measured.
    energy: &'static str,
    measured: &'static str,
    /// Why that is not the measured error: the tighter run gave up, the motion did, they end differently.
    unmeasured: [&'static str; 3],
    recomputed: &'static str,
    duration: bool,
    /// Whether the choice of `auto` is explained.
    choice: bool,
}

/// The words in full, and shorter for narrow screens.
const WORDS: [StatusWords; 4] = {
    let full = StatusWords {
        evaluations: "evaluations",
        error: "energy error",
        energy: "energy error",
        measured: "measured error",
        unmeasured: [
            "the tighter run gave up",
            "no tighter run: this one gave up",
            "the tighter run ends otherwise",
        ],
        recomputed: "recomputed ",
        duration: true,
        choice: true,
    };
    let short = StatusWords {
        evaluations: "ev",
        error: "error",
        measured: "measured",
        recomputed: "",
        ..full
    };
    let unmeasured = ["tighter run gave up", "gave up", "tighter run ends otherwise"];
    let shorter = StatusWords { unmeasured, choice: false, ..short };
    let unmeasured = ["gave up", "gave up", "ends otherwise"];
    [full, short, shorter, StatusWords { unmeasured, duration: false, ..shorter }]
};

/// What became of the motion, in a sentence.
fn outcome(session: &Session) -> (String, Role) {
    let needs = |plot: usize| session.needs(plot).contains(&Topic::Trajectory);
    let asked = session.on_show().any(|plot| session.variants(plot).is_none() && needs(plot));
    if let Some(text) = held_motions(session).filter(|_| !asked) {
        return (text, Role::Quiet);
    }
    if !session.layers.contains(&Layer::Trajectory) {
        return ("the motion is not shown".into(), Role::Quiet);
    }
    if let Some(failure) = session.failure(Topic::Trajectory, session.plot) {
        return (format!("no motion: {failure}"), Role::Failure);
    }
    match session.trajectory() {
        // Where no plot shows it, it is not computed.
        None if !asked => ("the motion is not shown".into(), Role::Quiet),
        None => ("computing the motion".into(), Role::Quiet),
        Some(found) if session.course().is_some() => (machine::outcome(session, found), Role::Text),
        Some(found) => alarm(session).unwrap_or_else(|| {
            let fate = session.fate();
            let writing = Writing(units::shown(session));
            let text = match fate {
                Some(fate) => verdict(&fate, found, writing),
                None => sentence(found, writing),
            };
            (text, Role::Text)
        }),
    }
}

/// What became of the motions that plots hold, where there are any and all are known.
fn held_motions(session: &Session) -> Option<String> {
    let plots = session.on_show().filter(|plot| session.variants(*plot).is_some());
    let found = plots.flat_map(|plot| session.found(Topic::Trajectory, plot));
    let outcomes: Vec<Outcome> = found
        .filter_map(|(.., answer)| match answer {
            Answer::Trajectory(found) => Some(found.outcome),
            _ => None,
        })
        .collect();
    let word = |end: &Outcome| match end {
        Outcome::Captured { .. } => "come to rest",
        Outcome::Moving { .. } => "still move",
        Outcome::Escaped { .. } => "escape",
        Outcome::GaveUp { .. } => "given up",
    };
    let parts =
        ["come to rest", "still move", "escape", "given up"].into_iter().filter_map(|name| {
            let number = outcomes.iter().filter(|end| word(end) == name).count();
            (number > 0).then(|| format!("{number} {name}"))
        });
    let parts: Vec<String> = parts.collect();
    (!parts.is_empty()).then(|| format!("{} motions: {}", outcomes.len(), parts.join(", ")))
}

/// What stands in place of the outcome where the mass would overtake its belt earlier.
fn alarm(session: &Session) -> Option<(String, Role)> {
    let (tau, q) = session.contact()?;
    let writing = Writing(units::shown(session));
    let (time, place) = (writing.time(tau, 3), writing.position(q, 3));
    let text = format!("sticks to the belt at {time}, {place}: the model ends there");
    Some((text, Role::Warning))
}

/// The mark at the end of the motion in the phase plane.
fn symbol(session: &Session, look: &Look) -> String {
    let symbols = look.symbols();
    match session.trajectory().map(|found| found.outcome) {
        _ if session.contact().is_some() => String::new(),
        Some(Outcome::Captured { .. }) => format!("{} ", symbols.rest),
        Some(Outcome::Moving { .. }) => format!("{} ", symbols.head),
        _ => String::new(),
    }
}

/// What becomes of a motion and why, in a sentence.
fn verdict(fate: &MotionVerdict, motion: &Trajectory, writing: Writing) -> String {
    let why = match fate.place {
        SideOfBorder::InsideCycle => " (inside the unstable cycle)",
        SideOfBorder::OutsideCycle => " (outside the unstable cycle)",
        SideOfBorder::InsideSeparatrix => " (inside the separatrix)",
        SideOfBorder::OutsideSeparatrix => " (outside the separatrix)",
        SideOfBorder::Anywhere => "",
    };
    let end = match (fate.end, motion.outcome) {
        (End::OnTheEdge { distance }, _) => {
            let distance = significant(distance, 1);
            return format!("on the unstable cycle to {distance}: decided by rounding");
        }
        (End::Rests, Outcome::Captured { .. }) if motion.crossings.is_empty() => {
            return sentence(motion, writing);
        }
        (End::Rests, Outcome::Captured { q, .. }) => {
            format!("comes to rest at {}{}", writing.position(q, 3), swings(motion))
        }
        (End::Rests, _) => {
            format!("comes to rest, after {}", writing.time(motion.problem.until, 3))
        }
        (End::Onto { q_max, grows: true }, _) => {
            format!("grows onto the stable cycle, {}", writing.amplitude(q_max, 4))
        }
        (End::Onto { q_max, .. }, _) => {
            format!("falls onto the stable cycle, {}", writing.amplitude(q_max, 4))
        }
        (End::Grows, Outcome::Escaped { tau }) => {
            format!("escapes at {}{}", writing.time(tau, 4), swings(motion))
        }
        (End::Grows, _) => "grows without bound".to_owned(),
        (End::Decays, _) => "decays towards the equilibrium".to_owned(),
    };
    end + why
}

/// How the motion was computed, what it cost, and its error: measured while the dial is in use, else
/// that of the energy.
fn work(session: &Session, look: &Look, words: &StatusWords) -> String {
    let Some(motion) = session.trajectory() else { return String::new() };
    let seconds = session.standing(Topic::Trajectory, session.plot).answered();
    let seconds = seconds.map_or(0.0, |answered| answered.seconds);
    let chosen = choice(motion).filter(|_| session.measures() && words.choice);
    let mut parts = vec![
        chosen.unwrap_or_else(|| motion.method.to_string()),
        format!("{} {}", count(motion.cost.evaluations), words.evaluations),
    ];
    if words.duration {
        parts.push(duration(seconds));
    }
    if session.measures() {
        parts.insert(
            0,
            session.problem.quality().map_or("typed", |quality| quality.name).to_owned(),
        );
    }
    let why = session.unmeasured().map(|why| words.unmeasured[why as usize]);
    if let Some((deviation, reference)) = session.measured() {
        let least = deviation.error.max(reference.error);
        parts.push(format!("{} {}", words.measured, significant(least, 2)));
    } else if let Some(ledger) = motion.ledger {
        let largest = ledger.start.max(ledger.end);
        let error = if largest > 0.0 { (ledger.residual / largest).abs() } else { 0.0 };
        let name = if session.measures() { words.energy } else { words.error };
        let why = why.map_or(String::new(), |why| format!(" ({why})"));
        parts.push(format!("{name} {}{why}", significant(error, 1)));
    } else if let Some(why) = why {
        parts.push(why.to_owned());
    }
    parts.join(&format!(" {} ", look.symbols().dot))
}

/// What the last key recomputed, and what that cost.
fn price(session: &Session, look: &Look, words: &StatusWords) -> String {
    let price = &session.price;
    if price.recomputed.is_empty() {
        return String::new();
    }
    let topics: Vec<Topic> = price.recomputed.iter().map(|part| part.topic).collect();
    let key = price.key.map_or_else(|| "open".into(), |key| keys::name(key, look));
    let (recomputed, evaluations) = (words.recomputed, count(price.evaluations()));
    let names = named(&topics, "+");
    format!("{key}: {recomputed}{names} {evaluations} ev {}", duration(price.seconds()))
}
