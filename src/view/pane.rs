//! What all panes share: a title line that says what the pane shows, whether the keys go to it, and
//! whether its picture is today's.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::look::{Look, Role};
use crate::scene::Slot;
use crate::session::{Pane, Session};

/// The middle of the screen above the footer, for what stands over the panes.
#[must_use]
pub fn centred(screen: Rect, width: u16, height: u16) -> Rect {
    let x = screen.x + (screen.width - width) / 2;
    let y = screen.y + (screen.height.saturating_sub(1) - height) / 2;
    Rect { x, y, width, height }
}

/// What stands in a title line besides the title.
#[derive(Clone, Debug, Default)]
pub struct Heading {
    /// Whether the keys go to this pane.
    pub focused: bool,
    /// Why the picture is not today's.
    pub mark: Option<&'static str>,
    /// What the cursor reads.
    pub reading: Option<String>,
}

impl Heading {
    /// The heading of a pane, as the session has it.
    #[must_use]
    pub fn of(session: &Session, pane: Pane) -> Self {
        Heading {
            focused: session.focus == pane && session.overlay.is_none(),
            mark: match pane {
                Pane::Parameters => None,
                Pane::Plot(index) => mark(session, index),
            },
            reading: None,
        }
    }
}

/// Why the picture of a plot is not today's: the worst of what its layers need.
fn mark(session: &Session, plot: usize) -> Option<&'static str> {
    let needed = session.needs(plot);
    let any = |test: &dyn Fn(Slot) -> bool| needed.iter().any(|slot| test(*slot));
    if any(&|slot| session.failure(slot, plot).is_some()) {
        Some("no answer")
    } else if any(&|slot| session.is_stale(slot, plot) && session.answered(slot, plot).is_some()) {
        let rough = |slot| session.has_draft(slot, plot);
        Some(if needed.iter().all(|slot| !session.is_stale(*slot, plot) || rough(*slot)) {
            "draft"
        } else {
            "stale"
        })
    } else if any(&|slot| session.is_stale(slot, plot)) {
        Some("computing")
    } else {
        None
    }
}

/// Writes a title line into the first row of `area`: the title, then what fits of `names`, and the
/// marks at the right.
pub fn title(
    area: Rect,
    title: &str,
    names: &str,
    heading: &Heading,
    look: &Look,
    buffer: &mut Buffer,
) {
    let (pointer, role) =
        if heading.focused { (look.symbols().pointer, Role::Focus) } else { (" ", Role::Title) };
    let mut left = vec![Span::styled(format!("{pointer}{title}"), look.style(role))];
    let mut right = Vec::new();
    if let Some(mark) = heading.mark {
        right.push(Span::styled(format!(" {mark}"), look.style(Role::Warning)));
    }
    if let Some(reading) = &heading.reading {
        right.push(Span::styled(format!(" {reading}"), look.style(Role::Cursor)));
    }
    // Where there is no room for the whole title, what is held tells more than what is drawn.
    if let Some((_, held)) = title.split_once(", ") {
        let taken: usize = right.iter().map(Span::width).sum();
        if title.len() + 1 + taken > usize::from(area.width) {
            left = vec![Span::styled(format!("{pointer}{held}"), look.style(role))];
        }
    }
    let width = |spans: &[Span]| spans.iter().map(Span::width).sum::<usize>();
    let room = usize::from(area.width).saturating_sub(width(&left) + width(&right));
    if room > names.len() + 2 {
        left.push(Span::styled(format!("  {names}"), look.style(Role::Quiet)));
    } else if heading.reading.is_none()
        && names.len() > title.len()
        && room + title.len() >= names.len()
    {
        // The axes say more than the title, and two plots of a view differ in them.
        left = vec![Span::styled(format!("{pointer}{names}"), look.style(role))];
    }
    // What the cursor reads matters more than the end of the title.
    let taken = width(&right).min(usize::from(area.width));
    let taken = u16::try_from(taken).unwrap_or(area.width);
    let left_part = Rect { width: area.width - taken, ..area };
    line(left_part, 0, left, "", buffer);
    line(Rect { x: area.right() - taken, width: taken, ..area }, 0, "", right, buffer);
}

/// A text that fits into `width` columns; where it is cut, it ends with a mark.
#[must_use]
pub fn cut(text: &str, width: usize, look: &Look) -> String {
    let mark = look.symbols().more;
    if text.chars().count() <= width {
        return text.to_owned();
    }
    let kept = width.saturating_sub(mark.chars().count());
    text.chars().take(kept).chain(mark.chars()).collect()
}

/// Writes a row of `area`: `left` from its left end and, where it fits, `right` at its right end.
pub fn line(
    area: Rect,
    row: u16,
    left: impl Into<Line<'static>>,
    right: impl Into<Line<'static>>,
    buffer: &mut Buffer,
) {
    if row >= area.height {
        return;
    }
    let (left, right) = (left.into(), right.into());
    let (x, y) = (area.x, area.y + row);
    let needed = u16::try_from(right.width()).unwrap_or(u16::MAX);
    let start = area.width.saturating_sub(needed);
    let (end, _) = buffer.set_line(x, y, &left, area.width);
    if needed > 0 && x + start >= end {
        buffer.set_line(x + start, y, &right, needed);
    }
}
