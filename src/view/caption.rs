//! A box of text above the status lines: the caption of a tour, or what there is to see in the scene and
//! to press. It takes no keys: what it says can be tried while it is read.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::keys;
use super::lists::frame;
use super::look::Look;
use super::pane;
use crate::picture::role::Role;
use crate::session::Session;
use crate::session::overlay::Caption;

const WIDTH: u16 = 100;

/// Draws the box at the bottom of `area`, if there is something to say and room for it.
pub fn draw(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let filled = |text: &str| session.keymap.fill(text, |key| keys::name(key, look));
    let (heading, paragraphs) = match &session.caption {
        Caption::Tour(caption, place) => {
            let place = place.map_or(String::new(), |(step, of)| format!("{step} of {of}, "));
            let heading = format!(" {place}any key: on, esc: leave the tour, backspace: back ");
            (heading, vec![filled(caption)])
        }
        Caption::Scene => {
            let heading = filled(" {explain}: hide ");
            let [look, press] = [&session.scene.look, &session.scene.press];
            (heading, [look, press].map(|text| filled(&session.said(text))).to_vec())
        }
        Caption::Nothing => return,
    };
    let width = area.width.min(WIDTH);
    let inner = width.saturating_sub(4);
    let mut lines = Vec::new();
    for paragraph in &paragraphs {
        lines.extend(wrapped(paragraph, usize::from(inner)));
    }
    let height = u16::try_from(lines.len()).unwrap_or(u16::MAX).saturating_add(2).min(area.height);
    if inner < 10 || height < 3 {
        return;
    }
    let place =
        Rect { x: area.x + (area.width - width) / 2, y: area.bottom() - height, width, height };
    pane::clear(place, buffer);
    // Who presents is read from afar.
    let role = if session.caption == Caption::Scene { Role::Text } else { Role::Title };
    for (y, line) in (place.y + 1..place.bottom() - 1).zip(lines) {
        buffer.set_stringn(place.x + 2, y, line, inner.into(), look.style(role));
    }
    frame(place, &heading, "", look, buffer);
}

/// A text in lines of at most `width` columns, broken between words where possible.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut();
        match line {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_whole_and_lines_within_their_width() {
        let text = "one two three four five";
        assert_eq!(wrapped(text, 9), ["one two", "three", "four five"]);
        assert_eq!(wrapped("", 9), [""]);
        assert_eq!(wrapped("incomprehensible", 3), ["incomprehensible"]);
    }
}
