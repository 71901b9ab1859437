//! Lists over the panes: everything, the scenes, the layers, the views. They scroll so that the selected row is
//! seen, and show what is searched for.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;

use super::content::{ListContent, ListLine, TEXT};
use super::costs;
use super::keys;
use super::look::Look;
use super::pane;
use super::paper;
use super::prose;
use crate::picture::role::Role;
use crate::scene::library::SceneGroup;
use crate::scene::said::said_by;
use crate::scene::{Layer, letters};
use crate::session::PaletteRow;
use crate::session::{List, Listed, Overlay, Session};

const WIDTH: u16 = 90;

/// Columns of keys in the help.
const KEYS: usize = 16;

/// Draws the open list, if there is one, into the middle of the screen.
pub fn draw(screen: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let Some(Overlay::List(listed, list)) = &session.overlay else { return };
    let content = match listed {
        Listed::Scenes => scenes(session, list, look),
        Listed::Layers => layers(session, list, look),
        Listed::Views => views(session, list, look),
        Listed::Cost => costs::content(session, list, look),
        Listed::Paper => paper::content(session, list, look),
        Listed::Palette => palette(session, list, look),
        Listed::Interrupted => interrupted(session, list, look),
    };
    let below = if content.about.is_empty() { 0 } else { content.below + 1 };
    let wanted = u16::try_from(content.rows.len()).unwrap_or(u16::MAX).saturating_add(2 + below);
    // No slivers of panes beside the list; the footer stays in sight.
    let width = if screen.width < WIDTH + 10 { screen.width } else { WIDTH };
    let height = screen.height.saturating_sub(1).min(wanted.max(4));
    let area = pane::centred(screen, width, height);
    if area.width < 4 || area.height < 4 {
        return;
    }
    pane::clear(area, buffer);
    let inner = Rect { x: area.x + 2, y: area.y + 1, width: width - 4, height: height - 2 };
    let about = below.min(inner.height.saturating_sub(4));
    let rows = Rect { height: inner.height - about, ..inner };
    let place = self::rows(rows, &content.rows, list.selected, look, buffer);
    if about > 0 {
        let text = Rect { y: rows.bottom() + 1, height: about - 1, ..inner };
        prose::write(text, content.about, look, buffer);
    }
    frame(area, &heading(content.title, list), &place, look, buffer);
}

fn heading(title: &str, list: &List) -> String {
    if list.searching || !list.search.is_empty() {
        let caret = if list.searching { "_" } else { "" };
        format!(" {title}: /{}{caret} ", list.search)
    } else {
        format!(" {title} ")
    }
}

/// Draws the rows around the selected one; returns which part of them is seen.
fn rows(
    area: Rect,
    rows: &[ListLine],
    selected: usize,
    look: &Look,
    buffer: &mut Buffer,
) -> String {
    let height = usize::from(area.height);
    let selectable = rows.iter().enumerate().filter(|(_, row)| matches!(row, ListLine::Row(_)));
    let index = selectable.clone().nth(selected).map_or(0, |(index, _)| index);
    let first = index.saturating_sub(height / 2).min(rows.len().saturating_sub(height));
    for (y, (place, row)) in (area.y..area.bottom()).zip(rows.iter().enumerate().skip(first)) {
        let line = match row {
            ListLine::Heading(text) => Line::styled(*text, look.style(Role::Title)),
            ListLine::Row(spans) => {
                let pointer = if place == index { look.symbols().pointer } else { " " };
                let mut line = vec![look.span(format!("{pointer} "), Role::Focus)];
                line.extend(spans.iter().cloned().map(|span| {
                    if place == index { span.patch_style(look.style(Role::Selected)) } else { span }
                }));
                Line::from(line)
            }
        };
        buffer.set_line(area.x, y, &pane::fitted(line, area.width.into(), look), area.width);
    }
    let count = selectable.count();
    if count == 0 {
        buffer.set_stringn(
            area.x,
            area.y,
            "nothing found",
            area.width.into(),
            look.style(Role::Quiet),
        );
        return String::new();
    }
    format!(" {} of {count} ", (selected + 1).min(count))
}

/// Draws a frame with a heading above and a remark below at the right.
pub(super) fn frame(area: Rect, heading: &str, remark: &str, look: &Look, buffer: &mut Buffer) {
    let symbols = look.symbols();
    let style = look.style(Role::Axis);
    let [top_left, top_right, bottom_left, bottom_right] = symbols.corners;
    let (right, bottom) = (area.right() - 1, area.bottom() - 1);
    let rule = symbols.rule.repeat(usize::from(area.width - 2));
    for (y, left, end) in [(area.y, top_left, top_right), (bottom, bottom_left, bottom_right)] {
        buffer.set_string(area.x, y, left, style);
        buffer.set_string(area.x + 1, y, &rule, style);
        buffer.set_string(right, y, end, style);
    }
    for y in area.y + 1..bottom {
        buffer.set_string(area.x, y, symbols.upright, style);
        buffer.set_string(right, y, symbols.upright, style);
    }
    let room = usize::from(area.width.saturating_sub(4));
    let style = Style::reset().patch(look.style(Role::Focus));
    buffer.set_string(area.x + 2, area.y, pane::cut(heading, room, look), style);
    let remark = pane::cut(remark, room, look);
    let length = u16::try_from(remark.chars().count()).unwrap_or(0);
    buffer.set_string(right - 1 - length, bottom, remark, look.style(Role::Quiet));
}

/// Everything that has a name: with headings where nothing is searched, the best first where something is.
fn palette(session: &Session, list: &List, look: &Look) -> ListContent {
    let found = session.palette_rows(list);
    let mut content = ListContent { below: 2, ..ListContent::new("everything") };
    for row in &found {
        if list.search.is_empty() {
            content.group(session.heading(*row));
        }
        let keys = keys_of(session, *row, look);
        let spaced = keys.join(" ");
        let keys = if spaced.chars().count() > KEYS { keys.concat() } else { spaced };
        let keys = if keys.is_empty() { row.name().to_owned() } else { keys };
        let keys = format!("{keys:<KEYS$} ");
        content.row([look.span(keys, Role::Key), look.span(row.meaning(), Role::Text)]);
    }
    if let Some(row) = found.get(list.selected) {
        let name = match row {
            PaletteRow::Line(line) => format!(":{} {}", line.name, line.arguments),
            row => row.name().to_owned(),
        };
        let name = look.span(format!("{name}   "), Role::Title);
        let kind = look.span(session.heading(*row).to_lowercase(), Role::Quiet);
        let meaning = Line::styled(row.meaning(), look.style(Role::Quiet));
        content.about = vec![Line::from(vec![name, kind]), meaning];
    }
    content
}

/// The keys of a row where it is run; the colon of a command that takes words.
fn keys_of(session: &Session, row: PaletteRow, look: &Look) -> Vec<String> {
    match row {
        PaletteRow::Command(command) => {
            let place = session.place_of(command);
            let places = session.keymap.places(command);
            let here = places.into_iter().find(|(context, _)| Some(*context) == place);
            let keys = here.map(|(_, keys)| keys).unwrap_or_default();
            keys.into_iter().map(|key| keys::name(key, look)).collect()
        }
        PaletteRow::Line(line) => vec![format!(":{}", line.name)],
        _ => Vec::new(),
    }
}

/// The scenes in their groups, and what there is to see and to do in the selected one.
fn scenes(session: &Session, list: &List, look: &Look) -> ListContent {
    let found = session.scene_rows(list);
    let mut content = ListContent { below: TEXT, ..ListContent::new("scenes") };
    for scene in &found {
        if list.search.is_empty() {
            content.group(SceneGroup::of(scene).title());
        }
        let figure = scene.also.as_deref().unwrap_or_default();
        content.row([
            look.span(format!("{:<14}", scene.name), Role::Key),
            look.span(format!("{figure:<7}"), Role::Quiet),
            look.span(scene.title.as_str(), Role::Text),
        ]);
    }
    if let Some(scene) = found.get(list.selected) {
        let quiet = look.style(Role::Quiet);
        let text = |text: &str| {
            Line::styled(keys::sentence(&said_by(scene, text), &session.keymap, look), quiet)
        };
        content.about = vec![text(&scene.watch), Line::default(), text(&scene.press)];
    }
    content
}

/// The layers, and which of them are on; those of the plot in use with the letter that switches them.
fn layers(session: &Session, list: &List, look: &Look) -> ListContent {
    let mut content = ListContent::new("layers");
    let letters: Vec<(char, Layer)> = letters(session.view_in_use()).collect();
    for spec in session.layer_rows(list) {
        content.group(spec.view.spec().title);
        let letter = letters.iter().find(|(_, layer)| *layer == spec.layer);
        let letter = letter.map_or(' ', |(letter, _)| *letter);
        let on = if session.layers.contains(&spec.layer) { "[x]" } else { "[ ]" };
        let meaning = session.not_drawn(spec.layer).unwrap_or(spec.meaning);
        content.row([
            look.span(format!("{letter} {on} {:<16}", spec.name), Role::Key),
            look.span(meaning, Role::Text),
        ]);
    }
    content
}

/// The views, with those on show marked.
fn views(session: &Session, list: &List, look: &Look) -> ListContent {
    let mut content = ListContent::new("show");
    for spec in session.view_rows(list) {
        let shown = session.plots.iter().any(|plot| plot.view == spec.view);
        let on = if shown { "[x]" } else { "[ ]" };
        let title = format!("{on} {:<14}", spec.title);
        let lacks =
            session.lacks(spec.view).map(|text| keys::sentence(text, &session.keymap, look));
        let (text, role) = match lacks {
            Some(lacks) => (lacks, Role::Quiet),
            None => (spec.meaning.to_owned(), Role::Text),
        };
        content.row([look.span(title, Role::Key), look.span(text, role)]);
    }
    content
}

fn interrupted(session: &Session, list: &List, look: &Look) -> ListContent {
    let mut content = ListContent::new("interrupted sessions");
    for (_, kept) in session.interrupted_rows(list) {
        let when = format!("{:<12} ", kept.when);
        content.row([look.span(when, Role::Key), look.span(kept.what.clone(), Role::Text)]);
    }
    content
}
