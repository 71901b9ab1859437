//! The status lines: what becomes of the motion, and which kicks are survived; while the accuracy is changed, how
//! the motion was computed and what that cost.

use ratatui::layout::Rect;

use super::{Look, Surface, compare, fitted::UNRELIABLE, gauge, margin, pane, verdict};
use crate::flow::choice;
use crate::picture::{Role, end_mark};
use crate::scene::{Scene, Topic};
use crate::session::Session;
use crate::session::wants::named;
use crate::words::motion::swings;
use crate::words::{count, duration, significant};

/// Draws the title line: what the scene is, the name of the scene, and where there is room for it beside a short title the
/// equation of motion.
pub fn title(area: Rect, session: &Session, screen: &mut Surface) {
    let (title, name, equation) = (&*session.scene.title, &session.scene.name, session.equation());
    let full = format!("{equation}  {name}");
    let brief = title.split(" (").next().unwrap_or(title);
    let ways = [(title, &full), (brief, &full), (title, name)];
    let letters = |text: &str| text.chars().count();
    let fits = |way: &(&str, &String)| letters(way.0) + letters(way.1) + 5 <= area.width.into();
    let (title, right) = ways.into_iter().find(fits).unwrap_or((title, name));
    let left = screen.look.span(format!(" {title}"), Role::Title);
    let right = screen.look.span(format!("{right} "), Role::Quiet);
    screen.both_ends(area, 0, left, right);
}

/// Draws the sentence of a first screen: what one sees, and what to press.
pub fn sentence(area: Rect, session: &Session, screen: &mut Surface) {
    let Scene { watch, press, .. } = &*session.scene;
    let text = screen.look.sentence(&session.said(&format!("{watch} {press}")), &session.keymap);
    let inside = Rect { x: area.x + 1, width: area.width.saturating_sub(2), ..area };
    screen.prose(inside, vec![screen.look.span(text, Role::Text).into()]);
}

/// Draws the status lines: the outcome first, then method, cost and error.
pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let (text, role) = if let Some(held) = verdict::held_point(session, look, area.width) {
        (held, Role::Cursor)
    } else {
        let (sentence, role) = verdict::outcome(session);
        let letter = session.letter().map(|letter| format!("{letter} ")).unwrap_or_default();
        let of = session.number(0).map_or_else(String::new, |number| format!("motion {number} "));
        // The symbol belongs to the motion: what else is said has none.
        let symbol = if role == Role::Text && !session.is_asked() {
            symbol(session, look)
        } else {
            String::new()
        };
        (format!("{symbol}{letter}{of}{sentence}"), role)
    };
    let busy = busy(session);
    // That a computation is running matters more than the end of the sentence.
    let room = usize::from(area.width).saturating_sub(busy.chars().count());
    let both = compare::outcomes(session).filter(|_| role == Role::Text);
    let both = both.map(|both| format!(" {both}")).filter(|both| both.chars().count() <= room);
    let text = both.unwrap_or_else(|| shorter(session, format!(" {text}"), room));
    let text = pane::cut(&text, room, look);
    let left = look.span(text, role);
    screen.both_ends(area, 0, left, look.span(busy, Role::Warning));

    let quiet = |text| look.span(text, Role::Quiet);
    // While the accuracy is changed, the cost stands here; at other times a key of its own lists it.
    if !session.measures() {
        return survived(area, session, screen);
    }
    let line = |shorter| (work(session, look, shorter), price(session, look, shorter));
    let fits = |(left, right): &(String, String)| {
        left.chars().count() + right.chars().count() + 4 <= usize::from(area.width)
    };
    let (left, right) = (0..SHORTEST).map(line).find(fits).unwrap_or_else(|| line(SHORTEST));
    screen.both_ends(area, 1, quiet(format!(" {left}")), quiet(format!("{right} ")));
}

/// Draws which kicks are survived, in the second row, behind the gauge of the one that is being tried.
pub(super) fn survived(area: Rect, session: &Session, screen: &mut Surface) {
    let (look, width) = (screen.look, usize::from(area.width).saturating_sub(1));
    let both = compare::margins(session, width);
    let told = both.or_else(|| margin::status(session)).filter(|_| !session.is_asked());
    let text = told.unwrap_or_default();
    let failed = text.starts_with(UNRELIABLE);
    let role = if failed { Role::Warning } else { Role::Quiet };
    let text = look.span(format!(" {text}"), role);
    match gauge::gauge(session, width, look).filter(|_| session.kicking) {
        Some(gauge) => screen.both_ends(area, 1, gauge, text),
        None => screen.line(area, 1, text),
    }
}

/// What goes on: a computation, a file that is written.
fn busy(session: &Session) -> String {
    let mut busy = String::new();
    if session.is_fitting() {
        busy += &format!("fitting: {} motions, esc stops ", session.fitting);
    } else if session.is_busy() {
        busy += "computing ";
    }
    if let Some(name) = session.writing.as_ref().and_then(|path| path.file_name()) {
        busy += &format!("writing {} ", name.display());
    }
    busy
}

/// A verdict that fits into this many columns, if that is possible: why it is so matters more than after how many
/// half swings or what time and where, or how large a cycle is that the parameter pane lists.
fn shorter(session: &Session, mut text: String, room: usize) -> String {
    let too_long = |text: &String| text.chars().count() > room;
    let swings = session.trajectory().map(|motion| swings(motion.crossings.len()));
    if let Some(swings) = swings.filter(|_| too_long(&text)) {
        text = text.replacen(&swings, "", 1);
    }
    for part in [", q_max ", ", x_max ", ", after ", " at q = ", " at x = "] {
        // The part goes on to the reason.
        let (head, rest) = text.split_once(part).unwrap_or((&text, ""));
        let why = rest.find(" (").map_or("", |start| &rest[start..]);
        if too_long(&text) && !rest.is_empty() {
            text = format!("{head}{why}");
        }
    }
    text
}

/// How often the words of the second line can be shortened, for narrow screens.
const SHORTEST: usize = 3;

/// Why an error is not the measured one, in shorter and shorter words: the tighter run gave up, the motion did, they
/// end differently.
const UNMEASURED: [[&str; 3]; SHORTEST] = [
    [
        "the tighter run gave up",
        "no tighter run: this one gave up",
        "the tighter run ends otherwise",
    ],
    ["tighter run gave up", "gave up", "tighter run ends otherwise"],
    ["gave up", "gave up", "ends otherwise"],
];

/// The mark at the end of the motion in the phase plane.
fn symbol(session: &Session, look: &Look) -> String {
    let motion = session.trajectory().filter(|_| session.contact().is_none());
    let mark = motion.and_then(|found| end_mark(&found.outcome));
    mark.map_or_else(String::new, |mark| format!("{} ", look.symbols().mark(mark)))
}

/// How the motion was computed while the dial is in use, what it cost, and its error: the measured one, else that of
/// the energy.
fn work(session: &Session, look: &Look, shorter: usize) -> String {
    let Some(motion) = session.trajectory() else { return String::new() };
    let full = shorter == 0;
    let seconds = session.standing(Topic::Trajectory, session.plot).reply();
    let seconds = seconds.map_or(0.0, |reply| reply.seconds);
    let quality = session.problem.quality().map_or("typed", |quality| quality.name);
    let chosen = choice(motion).filter(|_| shorter < 2);
    let evaluations = if full { "evaluations" } else { "ev" };
    let mut parts = vec![
        quality.to_owned(),
        chosen.unwrap_or_else(|| motion.method.to_string()),
        format!("{} {evaluations}", count(motion.cost.evaluations)),
    ];
    parts.extend((shorter < SHORTEST).then(|| duration(seconds)));
    let measured = session.measured();
    let why = measured.and_then(Result::err);
    let why = why.map(|why| UNMEASURED[shorter.saturating_sub(1)][why as usize]);
    if let Some(Ok((deviation, reference))) = measured {
        let least = deviation.error.max(reference.error);
        let measured = if full { "measured error" } else { "measured" };
        parts.push(format!("{measured} {}", significant(least, 2)));
    } else if let Some(ledger) = motion.ledger.as_ref().filter(|_| !session.draws_whole()) {
        let largest = ledger.start.max(ledger.end);
        let error = if largest > 0.0 {
            (ledger.residual / largest).abs()
        } else {
            0.0
        };
        let why = why.map_or(String::new(), |why| format!(" ({why})"));
        parts.push(format!("energy error {}{why}", significant(error, 1)));
    } else if let Some(why) = why {
        parts.push(why.to_owned());
    }
    parts.join(&format!(" {} ", look.symbols().dot))
}

/// What the last key recomputed, and what that cost.
fn price(session: &Session, look: &Look, shorter: usize) -> String {
    let price = &session.price;
    if price.recomputed.is_empty() {
        return String::new();
    }
    let topics: Vec<Topic> = price.recomputed.iter().map(|part| part.topic).collect();
    let key = price.key.map_or_else(|| "open".into(), |key| look.key(key));
    let recomputed = if shorter == 0 { "recomputed " } else { "" };
    let (names, evaluations) = (named(&topics, "+"), count(price.evaluations()));
    format!("{key}: {recomputed}{names} {evaluations} ev {}", duration(price.seconds()))
}
