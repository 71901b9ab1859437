//! A list over the panes: its rows, which scroll so that the selected one is seen, and what is said of that one.

use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::{Look, Surface, pane};
use crate::picture::Role;
use crate::session::List;

const WIDTH: u16 = 90;

/// Rows of text below a list of scenes or claims.
pub(super) const TEXT: u16 = 8;

#[derive(Default)]
pub(super) struct ListContent {
    pub title: &'static str,
    /// The rows, each with the heading of its group, which may be empty.
    pub rows: Vec<(&'static str, Vec<Span<'static>>)>,
    /// About the selected row, below the list.
    pub about: Vec<Line<'static>>,
    pub below: u16,
}

impl ListContent {
    /// An empty list.
    pub fn new(title: &'static str) -> Self {
        ListContent { title, ..ListContent::default() }
    }

    pub fn row<const N: usize>(&mut self, heading: &'static str, cells: [Span<'static>; N]) {
        self.rows.push((heading, cells.into()));
    }

    /// The lines of the list, with the headings of groups, and the number of the one that is selected.
    fn lines(&mut self, selected: usize, look: &Look) -> (Vec<Line<'static>>, usize) {
        let (mut lines, mut group, mut place) = (Vec::new(), "", 0);
        for (index, (heading, cells)) in std::mem::take(&mut self.rows).into_iter().enumerate() {
            if heading != group {
                lines.push(Line::styled(heading, look.style(Role::Title)));
                group = heading;
            }
            if index == selected {
                place = lines.len();
            }
            lines.push(drawn(cells, index == selected, look));
        }
        (lines, place)
    }

    /// Draws it into the middle of the screen.
    pub fn draw(mut self, area: Rect, list: &List, screen: &mut Surface) {
        let count = self.rows.len();
        let (lines, selected) = self.lines(list.selected, screen.look);
        let below = if self.about.is_empty() { 0 } else { self.below + 1 };
        let rows = u16::try_from(lines.len()).unwrap_or(u16::MAX);
        let wanted = rows.saturating_add(2 + below);
        // No slivers of panes beside the list; the footer stays in sight.
        let width = if area.width < WIDTH + 10 { area.width } else { WIDTH };
        let height = area.height.saturating_sub(1).min(wanted.max(4));
        let area = pane::centred(area, width, height);
        if area.width < 4 || area.height < 4 {
            return;
        }
        let remark = match count {
            0 => String::new(),
            _ => format!(" {} of {count} ", (list.selected + 1).min(count)),
        };
        let inner = screen.boxed(area, &heading(self.title, list), &remark);
        let about = below.min(inner.height.saturating_sub(4));
        let rows = Rect { height: inner.height - about, ..inner };
        if count == 0 {
            screen.line(rows, 0, screen.look.span("nothing found", Role::Quiet));
        }
        let first = pane::first_seen(selected, lines.len(), rows.height.into());
        screen.lines(rows, lines.into_iter().skip(first));
        if about > 0 {
            let text = Rect { y: rows.bottom() + 1, height: about - 1, ..inner };
            screen.prose(text, self.about);
        }
    }
}

fn heading(title: &str, list: &List) -> String {
    if list.searching || !list.search.is_empty() {
        let caret = if list.searching { "_" } else { "" };
        format!(" {title}: /{}{caret} ", list.search)
    } else {
        format!(" {title} ")
    }
}

fn drawn(spans: Vec<Span<'static>>, selected: bool, look: &Look) -> Line<'static> {
    let pointer = if selected { look.symbols().pointer } else { " " };
    let style = |span: Span<'static>| {
        if selected { span.patch_style(look.style(Role::Selected)) } else { span }
    };
    let pointer = look.span(format!("{pointer} "), Role::Focus);
    std::iter::once(pointer).chain(spans.into_iter().map(style)).collect()
}
