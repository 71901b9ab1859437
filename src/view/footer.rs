//! The last line: the keys that matter now; or what the program has to say; or the value being typed.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;
use ratatui::text::Span;

use super::keys;
use super::look::{Look, Role};
use super::pane;
use crate::session::keymap::Hint;
use crate::session::{Entry, Notice, Overlay, Row, Session};

/// Hints that are never left out, at the right end of the line.
const ALWAYS: [&str; 4] = ["help", "accept", "replay", "quit"];

/// The hint that joins them while something is open.
const CLOSE: &str = "close";

/// Draws the line.
pub fn draw(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let hints = session.hints();
    let (always, others): (Vec<&Hint>, Vec<&Hint>) = hints.iter().partition(|hint| {
        ALWAYS.contains(&hint.text) || (hint.text == CLOSE && session.overlay.is_some())
    });
    let mut right: Vec<Span> = always.into_iter().flat_map(|hint| spans(hint, look)).collect();
    right.push(Span::raw(" "));
    let left = match (&session.overlay, &session.notice) {
        (Some(Overlay::Entry(entry)), _) => self::entry(entry, look),
        (Some(Overlay::Offer(script)), _) => {
            let text =
                format!(" pasted {} steps of a keystroke file: press them?", script.steps.len());
            vec![Span::styled(text, look.style(Role::Warning))]
        }
        (_, Some(Notice { error, text })) => {
            let role = if *error { Role::Failure } else { Role::Text };
            let text = pane::cut(&format!(" {text}"), usize::from(area.width), look);
            vec![Span::styled(text, look.style(role))]
        }
        _ => {
            let taken: usize = right.iter().map(Span::width).sum();
            fitting(&others, usize::from(area.width).saturating_sub(taken + 1), look)
        }
    };
    pane::line(area, 0, left, right, buffer);
}

/// The first hints that fit into `width`, whole.
fn fitting(hints: &[&Hint], width: usize, look: &Look) -> Vec<Span<'static>> {
    let mut line = Vec::new();
    let mut used = 0;
    for hint in hints {
        let spans = spans(hint, look);
        used += spans.iter().map(Span::width).sum::<usize>();
        if used > width {
            break;
        }
        line.extend(spans);
    }
    line
}

fn spans(hint: &Hint, look: &Look) -> [Span<'static>; 2] {
    [
        Span::styled(
            format!(" {}", keys::names(hint.keys.iter().copied(), look)),
            look.style(Role::Key),
        ),
        Span::styled(format!(" {} ", hint.text), look.style(Role::Quiet)),
    ]
}

/// The value being typed, with its caret, and what is allowed or why it was refused.
fn entry(entry: &Entry, look: &Look) -> Vec<Span<'static>> {
    let text: Vec<char> = entry.text.chars().chain([' ']).collect();
    let (before, rest) = text.split_at(entry.caret.min(text.len() - 1));
    let style = look.style(Role::Text);
    let remark = match (&entry.refused, entry.row) {
        (Some(why), _) => Span::styled(format!("  {why}"), look.style(Role::Failure)),
        (None, Row::Parameter(symbol)) => {
            let spec = symbol.spec();
            let range = format!("  {} .. {}, {}", spec.min, spec.max, spec.meaning);
            Span::styled(range, look.style(Role::Quiet))
        }
        (None, _) => Span::raw(""),
    };
    vec![
        Span::styled(format!(" {} = ", entry.row.name()), look.style(Role::Title)),
        Span::styled(before.iter().collect::<String>(), style),
        Span::styled(rest[0].to_string(), style.add_modifier(Modifier::REVERSED)),
        Span::styled(rest[1..].iter().collect::<String>(), style),
        remark,
    ]
}
