//! What all panes share: a title line that says what the pane shows, whether the keys go to it, and
//! whether its picture is up to date.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::symbols::line::HORIZONTAL;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use super::Look;
use crate::picture::{Picture, Role};
use crate::session::{AnswerState, Pane, Session};
use crate::words::wrapped;

/// A surface to draw on, and how things look there.
pub struct Surface<'a> {
    pub look: &'a Look,
    pub buffer: &'a mut Buffer,
}

impl Surface<'_> {
    /// Writes a row of `area` from its left end, as far as it fits.
    pub fn line(&mut self, area: Rect, row: u16, left: impl Into<Line<'static>>) {
        self.both_ends(area, row, left, "");
    }

    /// [`Self::line`] with a text at its right end where that fits whole.
    pub fn both_ends(
        &mut self,
        area: Rect,
        row: u16,
        left: impl Into<Line<'static>>,
        right: impl Into<Line<'static>>,
    ) {
        if row >= area.height {
            return;
        }
        let (left, right) = (fitted(left.into(), area.width.into(), self.look), right.into());
        let (x, y) = (area.x, area.y + row);
        let (end, _) = self.buffer.set_line(x, y, &left, area.width);
        let needed = cells(right.width());
        let start = area.width.checked_sub(needed).map(|start| x + start);
        if let Some(x) = start.filter(|x| needed > 0 && *x >= end) {
            self.buffer.set_line(x, y, &right, needed);
        }
    }

    /// Writes lines from the top of `area` down, as far as they fit.
    pub fn lines(&mut self, area: Rect, all: impl IntoIterator<Item = impl Into<Line<'static>>>) {
        for (row, text) in (0..area.height).zip(all) {
            self.line(area, row, text);
        }
    }

    /// Writes lines from the top of `area` down; those that are too long for a row go on in the next, in the
    /// style of their first words, and a mark says that the rest does not fit.
    pub fn prose(&mut self, area: Rect, lines: Vec<Line<'static>>) {
        let width = usize::from(area.width);
        let mut rows: Vec<Line> = lines.into_iter().flat_map(|line| broken(line, width)).collect();
        let height = usize::from(area.height);
        if rows.len() > height {
            rows.truncate(height);
            let mark = &self.look.symbols().more;
            if let Some(last) = rows.last_mut() {
                let room = width.saturating_sub(mark.chars().count() + 1);
                // As many words as fit.
                *last = broken(std::mem::take(last), room).into_iter().next().unwrap_or_default();
                last.push_span(format!(" {mark}"));
            }
        }
        self.lines(area, rows);
    }

    /// Writes a title line into the first row of `area`: what fits of the title, `names`, and the marks at the right.
    /// `names` are those of the axes and stand there as long as they fit whole; of the title held values matter more
    /// than the view.
    pub fn title(&mut self, area: Rect, title: &str, names: &str, heading: &Heading) {
        let look = self.look;
        let role = if heading.focused { Role::Focus } else { Role::Title };
        let pointer = if heading.focused {
            &look.symbols().pointer
        } else {
            " "
        };
        let width = usize::from(area.width);
        let mark = heading.mark.map(|mark| look.span(format!(" {mark}"), Role::Warning));
        let reading = heading.reading.as_ref().map(|reading| {
            let ends = reading.match_indices("  ").map(|(end, _)| end).chain([reading.len()]);
            // Whole quantities, as many as fit.
            let fit = ends.filter(|end| reading[..*end].chars().count() < width).last();
            &reading[..fit.unwrap_or(reading.len())]
        });
        let reading = reading.map(|reading| look.span(format!(" {reading}"), Role::Cursor));
        // What the cursor reads matters more than the end of the title.
        let right = fitted(mark.into_iter().chain(reading).collect(), width, look);
        let room = width.saturating_sub(right.width());
        let (view, held) = title.split_once(", ").unwrap_or((title, title));
        // A number matters more than its error.
        let number = held.split(" +- ").next().unwrap_or(held);
        let beside = [title, held, number, view].map(|text| (text, names));
        let beside = beside.into_iter().filter(|_| !names.is_empty());
        let alone = [names, title, held].map(|text| (text, ""));
        let fits = |(text, names): &(&str, &str)| {
            let gap = if names.is_empty() { 0 } else { 2 };
            let letters = [pointer, text, names].map(|part| part.chars().count());
            !text.is_empty() && letters.into_iter().sum::<usize>() + gap <= room
        };
        // Beside a reading, a title of which only a few letters fit is left out.
        let stump = heading.reading.is_some() && 2 * room < title.chars().count();
        let otherwise = (if stump { "" } else { title }, "");
        let (text, names) = beside.chain(alone).find(fits).unwrap_or(otherwise);
        let names = if names.is_empty() {
            String::new()
        } else {
            format!("  {names}")
        };
        let left = vec![look.span(format!("{pointer}{text}"), role), look.span(names, Role::Quiet)];
        let left = fitted(left.into(), room, look);
        self.both_ends(area, 0, left, right);
        if heading.focused {
            // The focused pane is recognized in any colours: its heading is a bar.
            let bar = look.style(Role::Focus).remove_modifier(Modifier::DIM);
            let row = Rect { height: area.height.min(1), ..area };
            self.buffer.set_style(row, bar.add_modifier(Modifier::REVERSED));
        }
    }

    /// Clears an area for a box with a frame, a heading above and a remark below at the right; returns the part of the box
    /// for its text.
    pub fn boxed(&mut self, area: Rect, heading: &str, remark: &str) -> Rect {
        let look = self.look;
        clear(area, self.buffer);
        let room = usize::from(area.width.saturating_sub(4));
        let above = [
            look.span(HORIZONTAL, Role::Axis),
            Span::styled(cut(heading, room, look), Style::reset().patch(look.style(Role::Focus))),
        ];
        let below =
            [look.span(cut(remark, room, look), Role::Quiet), look.span(HORIZONTAL, Role::Axis)];
        Block::bordered()
            .border_style(look.style(Role::Axis))
            .title_top(Line::from_iter(above))
            .title_bottom(Line::from_iter(below).right_aligned())
            .render(area, self.buffer);
        Rect { x: area.x + 2, y: area.y + 1, width: area.width - 4, height: area.height - 2 }
    }
}

/// Clears an area for what stands over the panes, and what it would leave of words and numbers beside it.
fn clear(area: Rect, buffer: &mut Buffer) {
    let full = buffer.area;
    for y in area.y..area.bottom() {
        let is_letter =
            |x: &u16| buffer[(*x, y)].symbol().starts_with(|it: char| it.is_ascii_graphic());
        let leftward = (full.x..=area.x).rev().take_while(is_letter);
        let rightward = (area.right() - 1..full.right()).take_while(is_letter);
        for x in leftward.chain(rightward).collect::<Vec<_>>() {
            buffer[(x, y)].set_symbol(" ");
        }
    }
    Clear.render(area, buffer);
}

/// A number of columns or rows as screens count them.
pub fn cells(count: usize) -> u16 {
    u16::try_from(count).unwrap_or(u16::MAX)
}

/// The first of so many rows that is seen where `height` of them are, with the selected one among them.
pub fn first_seen(selected: usize, rows: usize, height: usize) -> usize {
    selected.saturating_sub(height / 2).min(rows.saturating_sub(height))
}

/// A picture in its place, below a title line.
pub struct FramedPicture<'a> {
    pub area: Rect,
    pub picture: Picture<'a>,
    pub heading: Heading,
}

/// What stands in a title line besides the title.
#[derive(Clone, Debug, Default)]
pub struct Heading {
    /// Whether the keys go to this pane.
    pub focused: bool,
    /// Why the picture is not up to date.
    pub mark: Option<&'static str>,
    pub reading: Option<String>,
}

impl Heading {
    pub fn of(session: &Session, pane: Pane) -> Self {
        Heading {
            focused: session.focus == pane && session.overlay.is_none(),
            mark: if let Pane::Plot(index) = pane {
                mark(session, index)
            } else {
                None
            },
            reading: None,
        }
    }
}

/// Why the picture of a plot is not up to date: the worst of what its layers need.
fn mark(session: &Session, plot: usize) -> Option<&'static str> {
    let asked = session.asked_by(plot);
    if asked.iter().any(|request| session.answers.failure(request).is_some()) {
        return Some("no answer");
    }
    let standings = asked.iter().map(|request| session.answers.standing(request));
    let worst = standings.map(|standing| match standing {
        AnswerState::Fresh(_) => None,
        AnswerState::Draft(_) => Some("draft"),
        AnswerState::Stale(_) => Some("stale"),
        AnswerState::None => Some("computing"),
    });
    // The worse state comes later in the alphabet.
    worst.max().flatten()
}

/// A text that fits into `width` columns; where it is cut, it ends with a mark, and never with a part of a word with
/// digits, which could be taken for another number.
pub fn cut(text: &str, width: usize, look: &Look) -> String {
    let letters: Vec<char> = text.chars().collect();
    if letters.len() <= width {
        return text.to_owned();
    }
    let mark = if width == 0 { "" } else { &look.symbols().more };
    let room = width.saturating_sub(mark.chars().count());
    let blank = |letter: &char| letter.is_whitespace();
    let begin = letters[..room].iter().rposition(blank).map_or(0, |at| at + 1);
    let end = letters[room..].iter().position(blank).map_or(letters.len(), |at| room + at);
    let number = letters[begin..end].iter().any(char::is_ascii_digit);
    let kept = if number && end > room { begin } else { room };
    letters[..kept].iter().copied().chain(mark.chars()).collect()
}

/// [`cut`] for a text in several styles.
pub fn fitted(line: Line<'static>, width: usize, look: &Look) -> Line<'static> {
    let text = line.to_string();
    let short = cut(&text, width, look);
    if short == text {
        return line;
    }
    let mut letters = short.chars();
    let spans = line.spans.into_iter().map(|span| {
        let count = span.content.chars().count();
        Span::styled(letters.by_ref().take(count).collect::<String>(), span.style)
    });
    Line { spans: spans.collect(), ..line }
}

/// The first of some texts that fits into this width, the last if none does.
pub fn fitting<T: Default + ToString>(texts: impl IntoIterator<Item = T>, width: usize) -> T {
    let mut last = T::default();
    for text in texts {
        last = text;
        if last.to_string().chars().count() <= width {
            break;
        }
    }
    last
}

/// What is left of an area below so many rows.
pub fn below(area: Rect, rows: u16) -> Rect {
    let rows = rows.min(area.height);
    Rect { y: area.y + rows, height: area.height - rows, ..area }
}

/// A line in rows of at most so many columns, broken between words.
fn broken(line: Line<'static>, width: usize) -> Vec<Line<'static>> {
    if line.width() <= width {
        return vec![line];
    }
    let style = line.style.patch(line.spans.first().map(|span| span.style).unwrap_or_default());
    wrapped(&line.to_string(), width)
        .into_iter()
        .map(|row| Line::from(Span::styled(row, style)))
        .collect()
}

/// The rows that lines take in `width` columns.
pub fn rows(lines: &[Line<'static>], width: u16) -> u16 {
    cells(lines.iter().map(|line| broken(line.clone(), width.into()).len()).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::settings;
    use crate::view::screen;

    #[test]
    fn a_cut_text_has_a_mark_and_no_part_of_a_number() {
        let look = Look::new(settings::DisplaySettings::default());
        let text = "margin 0.0100305 of D = -0.25";
        for (width, expected) in [
            (29, text),
            (28, "margin 0.0100305 of D = \u{2026}"),
            (17, "margin 0.0100305\u{2026}"),
            (16, "margin \u{2026}"),
            (5, "marg\u{2026}"),
            (1, "\u{2026}"),
            (0, ""),
        ] {
            assert_eq!(cut(text, width, &look), expected, "{width}");
        }
        let styled = Line::from(vec![Span::raw("margin 0.01"), Span::raw("00305 of")]);
        assert_eq!(fitted(styled, 12, &look).to_string(), "margin \u{2026}");
    }

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
            Surface { look: &look, buffer: &mut buffer }.prose(area, lines());
            assert_eq!(screen::text(&buffer), expected);
        }
    }
}
