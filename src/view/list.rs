//! A list over the panes: its rows, which scroll so that the selected one is seen, and what is said of that one.

use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::{Look, Surface, pane, prose};
use crate::picture::Role;
use crate::session::List;

const WIDTH: u16 = 90;

/// Rows of text below a list of scenes or claims.
pub(super) const TEXT: u16 = 8;

#[derive(Default)]
pub(super) struct ListContent {
    pub title: &'static str,
    pub rows: Vec<ListLine>,
    /// About the selected row, below the list.
    pub about: Vec<Line<'static>>,
    pub below: u16,
}

pub(super) enum ListLine {
    /// Groups the rows below it.
    Heading(&'static str),
    Row(Vec<Span<'static>>),
}

impl ListContent {
    /// An empty list.
    pub fn new(title: &'static str) -> Self {
        ListContent { title, ..ListContent::default() }
    }

    /// Begins a group of rows, unless it has begun already.
    pub fn group(&mut self, heading: &'static str) {
        let last = self.rows.iter().rev().find_map(|row| match row {
            ListLine::Heading(heading) => Some(*heading),
            ListLine::Row(_) => None,
        });
        if last != Some(heading) {
            self.rows.push(ListLine::Heading(heading));
        }
    }

    pub fn row<const N: usize>(&mut self, cells: [Span<'static>; N]) {
        self.rows.push(ListLine::Row(cells.into()));
    }

    /// Draws it into the middle of the screen.
    pub fn draw(self, area: Rect, list: &List, screen: &mut Surface) {
        let below = if self.about.is_empty() { 0 } else { self.below + 1 };
        let rows = u16::try_from(self.rows.len()).unwrap_or(u16::MAX);
        let wanted = rows.saturating_add(2 + below);
        // No slivers of panes beside the list; the footer stays in sight.
        let width = if area.width < WIDTH + 10 { area.width } else { WIDTH };
        let height = area.height.saturating_sub(1).min(wanted.max(4));
        let area = pane::centred(area, width, height);
        if area.width < 4 || area.height < 4 {
            return;
        }
        let is_row = |(_, row): &(usize, &ListLine)| matches!(row, ListLine::Row(_));
        let places = self.rows.iter().enumerate().filter(is_row).map(|(place, _)| place);
        let count = places.clone().count();
        let remark = match count {
            0 => String::new(),
            _ => format!(" {} of {count} ", (list.selected + 1).min(count)),
        };
        let selected = places.clone().nth(list.selected).unwrap_or(0);
        let inner = screen.boxed(area, &heading(self.title, list), &remark);
        let about = below.min(inner.height.saturating_sub(4));
        let rows = Rect { height: inner.height - about, ..inner };
        if count == 0 {
            screen.line(rows, 0, screen.look.span("nothing found", Role::Quiet));
        }
        let first = pane::first_seen(selected, self.rows.len(), rows.height.into());
        let seen = self.rows.into_iter().enumerate().skip(first);
        let seen = seen.map(|(place, row)| drawn(row, place == selected, screen.look));
        screen.lines(rows, seen);
        if about > 0 {
            let text = Rect { y: rows.bottom() + 1, height: about - 1, ..inner };
            prose::write(text, self.about, screen);
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

fn drawn(row: ListLine, selected: bool, look: &Look) -> Line<'static> {
    let spans = match row {
        ListLine::Heading(text) => return Line::styled(text, look.style(Role::Title)),
        ListLine::Row(spans) => spans,
    };
    let pointer = if selected { look.symbols().pointer } else { " " };
    let style = |span: Span<'static>| {
        if selected { span.patch_style(look.style(Role::Selected)) } else { span }
    };
    let pointer = look.span(format!("{pointer} "), Role::Focus);
    std::iter::once(pointer).chain(spans.into_iter().map(style)).collect()
}
