//! Sentences in a box: broken between words, and with a mark where the rest does not fit.

use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::Surface;
use crate::words::wrapped;

/// Writes lines from the top of `area` down; those that are too long for a row go on in the next, in the
/// style of their first words.
pub fn write(area: Rect, lines: Vec<Line<'static>>, screen: &mut Surface) {
    let width = usize::from(area.width);
    let mut rows: Vec<Line> = lines.into_iter().flat_map(|line| broken(line, width)).collect();
    let height = usize::from(area.height);
    if rows.len() > height && height > 0 {
        rows.truncate(height);
        let mark = screen.look.symbols().more;
        if let Some(last) = rows.last_mut() {
            let room = width.saturating_sub(mark.chars().count() + 1);
            *last = up_to(std::mem::take(last), room);
            last.push_span(format!(" {mark}"));
        }
    }
    screen.lines(area, rows);
}

/// As many words of a line as fit.
fn up_to(line: Line<'static>, width: usize) -> Line<'static> {
    broken(line, width).into_iter().next().unwrap_or_default()
}

fn broken(line: Line<'static>, width: usize) -> Vec<Line<'static>> {
    if line.width() <= width {
        return vec![line];
    }
    let style = line.style.patch(line.spans.first().map(|span| span.style).unwrap_or_default());
    let text: String = line.spans.iter().map(|span| span.content.as_ref()).collect();
    wrapped(&text, width).into_iter().map(|row| Line::from(Span::styled(row, style))).collect()
}

/// The rows that lines take in `width` columns.
pub fn rows(lines: &[Line<'static>], width: u16) -> u16 {
    let rows = lines.iter().map(|line| broken(line.clone(), width.into()).len()).sum::<usize>();
    u16::try_from(rows).unwrap_or(u16::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::settings;
    use crate::view::{Look, screen::text};
    use ratatui::buffer::Buffer;

    #[test]
    fn what_goes_on_below_has_a_mark() {
        let look = Look::new(settings::DisplaySettings::default());
        let lines = || vec![Line::from("one two three four five"), Line::from("six")];
        assert_eq!(rows(&lines(), 9), 4);
        for (height, expected) in
            [(4, "one two\nthree\nfour five\nsix\n"), (3, "one two\nthree\nfour \u{2026}\n")]
        {
            let mut buffer = Buffer::empty(Rect::new(0, 0, 9, height));
            let area = buffer.area;
            write(area, lines(), &mut Surface { look: &look, buffer: &mut buffer });
            assert_eq!(text(&buffer), expected);
        }
    }
}
