//! The line about playback: a bar with the head on it, whether the motion is played or paused, how fast, the time of all
//! time, and the keys for that.

use ratatui::layout::Rect;
use ratatui::text::Span;

use super::{Look, Surface, pane};
use crate::numerics::{real, truncated};
use crate::picture::{Mark, Role, units};
use crate::session::Session;
use crate::words::Notation;

/// Columns of the bar, which takes what the texts leave.
const BAR: (usize, usize) = (8, 60);

/// The keys and what they do, in longer and shorter words; `#` stands for what the first does next, `@` for the pace.
const KEYS: [&str; 4] = [
    "{play-motion} #  {motion-back} {motion-on} scrub  {motion-pace} pace: @  {drop-cursor} whole motion",
    "{play-motion} #  {motion-back} {motion-on} scrub  {motion-pace} @",
    "{play-motion} #  {motion-pace} @",
    "{play-motion} #",
];

/// Draws the line, if there is room for it and something to play.
pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    if area.is_empty() || session.trajectory().is_none() {
        return;
    }
    let look = screen.look;
    let at = session.head().map_or(0.0, |head| head.tau);
    let end = session.last_moment();
    let state = match session.playback.at {
        _ if session.playback.playing => "playing",
        Some(_) if session.drawn_until().is_none() => "ended",
        _ => "paused",
    };
    let notation = Notation(units::shown(session));
    let whole = notation.time(end, 3);
    // As wide at any time, so that nothing moves beside it.
    let width = whole.chars().count() + 1;
    let time = format!("{} {:>width$} of {whole}", notation.name("tau", "t"), notation.time(at, 3));
    let room = usize::from(area.width).saturating_sub(BAR.0 + 4);
    let next = if session.playback.playing { "pauses" } else { "plays" };
    let pace = session.pace();
    let brief = pace.trim_end_matches(" than real time");
    let texts = KEYS.iter().zip([&pace, brief, brief, brief]).map(|(keys, pace)| {
        let keys = look.sentence(keys, &session.keymap);
        format!("{time}  {}", keys.replace('#', next).replace('@', pace))
    });
    let text = pane::fitting(texts, room.saturating_sub(state.len()));
    let left = usize::from(area.width).saturating_sub(text.chars().count() + state.len() + 4);
    let share = if end > 0.0 { at / end } else { 0.0 };
    let mut spans = vec![look.span(format!(" {state} "), Role::Title)];
    spans.extend(bar(left.clamp(BAR.0, BAR.1), share, look));
    spans.push(look.span(format!(" {text}"), Role::Quiet));
    screen.line(area, 0, spans);
}

/// A bar of so many columns with the head at a share of it.
fn bar(columns: usize, share: f64, look: &Look) -> [Span<'static>; 3] {
    let symbols = look.symbols();
    let place = truncated(share * real(columns - 1) + 0.5);
    let rule = |count: usize| symbols.axis[3].repeat(count);
    [
        look.span(rule(place), Role::Trajectory),
        look.span(symbols.mark(Mark::Head).to_string(), Role::Cursor),
        look.span(rule(columns - 1 - place), Role::Axis),
    ]
}
