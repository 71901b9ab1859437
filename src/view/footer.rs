//! The last line: the keys that matter now; or what the program has to say; or the value being typed.

use ratatui::layout::Rect;
use ratatui::style::Modifier;
use ratatui::text::Span;

use super::{Look, Surface, pane};
use crate::flow::QUALITIES;
use crate::model::{Knob, KnobSpec};
use crate::picture::Role;
use crate::session::{
    Hint, Input, Notice, Overlay, PendingInput, Prompt, Row, Session, read::completion::described,
};

/// Hints that are never left out, at the right end of the line.
const ALWAYS: [&str; 5] = ["help", "accept", "replay", "forget", "quit"];

/// The hints that are left in a lecture.
const LECTURE: [&str; 12] = [
    "step", "size", "far", "turn", "let go", "play", "lecture", "help", "accept", "replay",
    "forget", CLOSE,
];

/// The hint that joins them while something is open.
const CLOSE: &str = "close";

/// Fewest columns of a text being typed beside the reason why it was refused, and of a remark beside the text.
const LEAST: usize = 12;

pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let mut hints = session.hints();
    hints.retain(|hint| !session.display.lecture || LECTURE.contains(&hint.text));
    let (always, others): (Vec<&Hint>, Vec<&Hint>) = hints.iter().partition(|hint| {
        ALWAYS.contains(&hint.text) || (hint.text == CLOSE && session.overlay.is_some())
    });
    let mut right: Vec<Span> = always.into_iter().flat_map(|hint| spans(hint, look)).collect();
    right.push(Span::raw(" "));
    let left = match (&session.waiting, session.pending, &session.overlay, &session.notice) {
        (Some(key), ..) => {
            let topic = key.request.topic().name();
            vec![
                look.span(format!(" waiting for: {topic} "), Role::Title),
                look.span(" esc forgets the key that waits", Role::Quiet),
            ]
        }
        (_, Some(key), ..) => vec![pending(key, look)],
        (_, _, Some(Overlay::Prompt(prompt)), _) => typed(prompt, session, area.width.into(), look),
        (_, _, Some(Overlay::Offer(script)), _) => {
            let text =
                format!(" pasted {} steps of a keystroke file: press them?", script.steps.len());
            vec![look.span(text, Role::Warning)]
        }
        (.., Some(Notice { error, text })) => {
            let role = if *error { Role::Failure } else { Role::Text };
            vec![look.span(format!(" {text}"), role)]
        }
        _ => {
            let taken: usize = right.iter().map(Span::width).sum();
            fitting(&others, usize::from(area.width).saturating_sub(taken + 1), look)
        }
    };
    screen.both_ends(area, 0, left, right);
}

/// The first hints that fit into `width`, whole.
fn fitting(hints: &[&Hint], width: usize, look: &Look) -> Vec<Span<'static>> {
    let mut used = 0;
    let fits = |spans: &[Span; 2]| {
        used += spans.iter().map(Span::width).sum::<usize>();
        used <= width
    };
    hints.iter().map(|hint| spans(hint, look)).take_while(fits).flatten().collect()
}

fn spans(hint: &Hint, look: &Look) -> [Span<'static>; 2] {
    [
        look.span(format!(" {}", look.keys(hint.keys.iter().copied())), Role::Key),
        look.span(format!(" {} ", hint.text), Role::Quiet),
    ]
}

/// What the next key is waited for.
fn pending(pending: PendingInput, look: &Look) -> Span<'static> {
    let text = match pending {
        PendingInput::Count(0) => " how many times? a number, then a key".to_owned(),
        PendingInput::Count(count) => format!(" {count} times: which key?"),
        PendingInput::Mark => " mark this point by which letter? a to z".to_owned(),
        PendingInput::GoTo => {
            " go to which mark? a to z; the same key: the point left last".to_owned()
        }
    };
    look.span(text, Role::Title)
}

/// What can be typed as the value of a row.
fn allowed(row: Row, session: &Session) -> String {
    match row {
        Row::Tolerance => {
            let names = QUALITIES.map(|quality| quality.name).join(", ");
            format!("{}, or {names}", row.knob_in(&session.problem).range())
        }
        Row::BELT => "speed of the belt, such as 0.3 m/s or 30 cm/s".to_owned(),
        Row::Number(knob) if row.is_of_machine() => {
            let KnobSpec { meaning, unit, .. } = *knob.spec();
            let unit = if unit.is_empty() {
                "a number"
            } else {
                &format!("in {unit} or with its unit")
            };
            format!("{meaning}, {unit}")
        }
        Row::Number(Knob::Disturbance) => {
            "bound on a force that varies in any way, in the unit of r or in N".to_owned()
        }
        Row::Number(Knob::Until) | Row::Method => String::new(),
        Row::Number(knob) => format!("{}, {}", knob.range(), knob.spec().meaning),
    }
}

/// A value or a command being typed, with its caret, and what is allowed or what it can become and takes, or why it was
/// refused. Where there is no room for all, the caret is seen, and the reason of a refusal goes before the text, which its
/// user knows.
fn typed(prompt: &Prompt, session: &Session, width: usize, look: &Look) -> Vec<Span<'static>> {
    let lead = match prompt.row {
        Some(row) => format!(" {} = ", row.name_in(&session.problem)),
        None => " :".to_owned(),
    };
    let lead = look.span(lead, Role::Title);
    let remark = remark(prompt, session, look);
    let room = width.saturating_sub(lead.width());
    let needed: usize = remark.iter().map(Span::width).sum();
    let for_remark = if prompt.refused.is_some() { needed } else { 0 };
    let text = around(&prompt.input, room.saturating_sub(for_remark).max(LEAST).min(room), look);
    let left = room - text.iter().map(|span| span.content.chars().count()).sum::<usize>();
    // A sign alone would look like the sign that the text goes on.
    let remark = (left >= LEAST || left >= needed).then(|| pane::fitted(remark.into(), left, look));
    std::iter::once(lead).chain(text).chain(remark.unwrap_or_default()).collect()
}

/// What stands behind a text being typed.
fn remark(prompt: &Prompt, session: &Session, look: &Look) -> Vec<Span<'static>> {
    let text = match (&prompt.refused, prompt.row, &prompt.completion) {
        (Some(why), ..) => return vec![look.span(format!("  {why}"), Role::Failure)],
        (None, Some(row), _) => allowed(row, session),
        (None, None, Some(completion)) => {
            let word = |(index, word): (usize, &String)| {
                let role = if index == completion.at {
                    Role::Key
                } else {
                    Role::Quiet
                };
                [Span::raw(" "), look.span(word.clone(), role)]
            };
            let words = completion.words.iter().enumerate().flat_map(word);
            return std::iter::once(Span::raw(" ")).chain(words).collect();
        }
        (None, None, None) => described(&session.keymap, &prompt.input.text()).map_or_else(
            || "the name of a command; Tab completes".to_owned(),
            |(arguments, doc)| format!("{arguments} {doc}"),
        ),
    };
    vec![look.span(format!("  {text}"), Role::Quiet)]
}

/// The part of a text around its caret that fits into `width` columns, with marks where it is cut. Its words may be cut
/// within, as in any editor: the caret stays where it is.
fn around(input: &Input, width: usize, look: &Look) -> [Span<'static>; 3] {
    let mark = &look.symbols().more;
    let caret = input.before.chars().count();
    let mut letters: Vec<char> = input.text().chars().collect();
    if caret == letters.len() {
        letters.push(' ');
    }
    let from = pane::first_seen(caret, letters.len(), width);
    let to = letters.len().min(from + width);
    let shown = |(at, letter): (usize, &char)| {
        let cut = (at == from && from > 0) || (at + 1 == to && to < letters.len());
        if cut && at != caret {
            mark.to_owned()
        } else {
            letter.to_string()
        }
    };
    let mut shown = letters.iter().enumerate().map(shown).take(to).skip(from);
    let style = look.style(Role::Text);
    [
        Span::styled(shown.by_ref().take(caret - from).collect::<String>(), style),
        Span::styled(shown.next().unwrap_or_default(), style.add_modifier(Modifier::REVERSED)),
        Span::styled(shown.collect::<String>(), style),
    ]
}
