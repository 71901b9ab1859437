//! What everything on the screen is: the things that the glossary explains, in reading order; the one that is pointed at,
//! highlighted where it stands; and its card.

use std::cmp::Reverse;
use std::collections::BTreeSet;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;
use ratatui::text::Line;

use super::layout::Layout;
use super::{Surface, pane, parameters, plot};
use crate::numerics::cycled;
use crate::picture::{self, Role, legend};
use crate::scene::{GLOSSARY, GlossaryEntry};
use crate::session::{Explanation, Overlay, Pane, Session};

/// Something on the screen that is explained.
pub struct Thing {
    pub entry: &'static GlossaryEntry,
    /// Its pane, in the order in which they are read: the title line, the parameters, the plots, the words below.
    pane: usize,
    /// Where it stands in letters; empty where it does not.
    pub place: Rect,
    /// The plot that draws it, and as what.
    pub drawn: Option<(usize, Role)>,
}

/// A word that has an entry.
type Known<'a> = (&'a str, &'static GlossaryEntry);

/// What is explained, if anything is, on a screen where the panes are drawn.
pub fn pointed(parts: &Layout, session: &Session, buffer: &Buffer) -> Option<Thing> {
    let Some(Overlay::Explanation(Explanation { entry, steps, .. })) = &session.overlay else {
        return None;
    };
    if let Some(entry) = entry.filter(|_| steps.is_empty()) {
        return Some(Thing { entry, pane: 0, place: Rect::default(), drawn: None });
    }
    let all = things(parts, session, buffer);
    let mut heads: Vec<usize> = (0..all.len()).collect();
    heads.dedup_by_key(|at| all[*at].pane);
    // Where one begins: in the plot with the keys; otherwise at the margin, which is what all this is about.
    let first = match session.focus {
        pane @ Pane::Plot(_) => all.iter().position(|thing| thing.pane == 1 + pane.number()),
        Pane::Parameters => all.iter().rposition(|thing| thing.entry.name == "margin"),
    };
    let at = steps.iter().fold(first.unwrap_or(0), |at, [by, panes]| {
        let head = heads.iter().rposition(|head| *head <= at).unwrap_or(0);
        match *panes {
            0 => cycled(at, *by as isize, all.len()),
            panes => heads[cycled(head, panes as isize, heads.len())],
        }
    });
    all.into_iter().nth(at)
}

/// Everything on the screen that is explained, in reading order; in each pane each entry once.
pub fn things(parts: &Layout, session: &Session, buffer: &Buffer) -> Vec<Thing> {
    let (equation, plain) = (session.equation(), known("word"));
    let own = GlossaryEntry::of("word", "equation").map(|entry| (&*equation, entry));
    let written = [known("plot"), plain.clone()].concat();
    let title: Vec<Known> = own.into_iter().chain(plain.iter().copied()).collect();
    let mut all = words(buffer, parts.title, 0, &title);
    all.extend(rows(parts.parameters, session, buffer, &plain));
    for (index, area) in parts.plots.iter().enumerate().filter(|(_, area)| !area.is_empty()) {
        let (pane, title) = (2 + index, Rect { height: 1, ..*area });
        all.extend(words(buffer, title, pane, &plain));
        let picture = picture::in_room(session, index, plot::room(*area));
        let names = picture.items.iter().filter_map(|item| legend::called(&picture, item));
        all.extend(names.filter_map(|(name, role)| {
            let entry = line_entry(&name)?;
            let place = words(buffer, parts.legend, pane, &[(&name, entry)]).pop();
            let place = place.map_or(Rect::default(), |thing| thing.place);
            Some(Thing { entry, pane, place, drawn: Some((index, role)) })
        }));
        all.extend(words(buffer, pane::below(*area, 1), pane, &written));
    }
    for area in [parts.playback, parts.status] {
        all.extend(words(buffer, area, 2 + parts.plots.len(), &plain));
    }
    let mut seen = BTreeSet::new();
    all.retain(|thing| seen.insert((thing.pane, thing.entry.name)));
    all
}

/// What explains a line, an area or a mark of a picture; some names have numbers at their end.
pub fn line_entry(name: &str) -> Option<&'static GlossaryEntry> {
    let before = |by: &str| name.split(by).next().unwrap_or(name);
    let plain = name.trim_end_matches(|it: char| it.is_ascii_digit()).trim();
    let mut stems = [name, before(", "), before(" = "), plain].into_iter();
    stems.find_map(|stem| GlossaryEntry::of("line", stem))
}

/// The rows of the parameter pane, and what stands below them.
fn rows(area: Rect, session: &Session, buffer: &Buffer, known: &[Known]) -> Vec<Thing> {
    /// Columns of numbers below their heading.
    const COLUMN: u16 = 8;
    if session.display.lecture {
        return words(buffer, area, 1, known);
    }
    let shown = parameters::shown(session, area.height);
    let below = pane::below(area, 1 + pane::cells(shown.len()));
    let (places, own) = (pane::below(area, 1).rows(), session.rows());
    let rows = places.zip(&own[shown]).filter_map(|(row, own)| {
        let entry = GlossaryEntry::of("number", own.name_in(&session.problem))?;
        Some(Thing { entry, pane: 1, place: Rect { x: row.x + 1, ..row }, drawn: None })
    });
    let mut all: Vec<Thing> = rows.collect();
    let cycles = session.cycles().map_or(0, |found| pane::cells(found.cycles.len()));
    for mut thing in words(buffer, below, 1, known) {
        let Rect { y, height, .. } = thing.place;
        let is_heading = line_at(buffer, Rect { y, ..area }).starts_with(" cycles ");
        if is_heading && thing.entry.name != "cycle" {
            let x = thing.place.right().saturating_sub(COLUMN);
            thing.place = Rect { x, y, width: COLUMN, height: height + cycles };
        }
        all.push(thing);
    }
    all
}

/// The words by which entries are known on the screen: what they explain of a kind, the longest first.
fn known(kind: &'static str) -> Vec<Known<'static>> {
    let texts = |it: &'static GlossaryEntry| it.texts(kind).map(move |text| (text, it));
    let mut known: Vec<Known> = GLOSSARY.iter().flat_map(texts).collect();
    known.sort_by_key(|(text, _)| Reverse(text.len()));
    known
}

/// Where words that are known, the first ones first, stand in an area.
fn words(buffer: &Buffer, area: Rect, pane: usize, known: &[Known]) -> Vec<Thing> {
    let is_part = |it: char| it.is_alphanumeric() || ['_', '\''].contains(&it);
    let mut all = Vec::new();
    for row in area.rows() {
        let (line, mut end) = (line_at(buffer, row), 0);
        for (column, (at, _)) in line.char_indices().enumerate() {
            let (before, rest) = line.split_at(at);
            let is_here = |(text, _): &&Known| {
                rest.strip_prefix(text).is_some_and(|after| !after.starts_with(is_part))
            };
            let free = at >= end && !before.ends_with(is_part);
            if let Some((text, entry)) = known.iter().find(is_here).filter(|_| free) {
                let (x, width) = (row.x + pane::cells(column), pane::cells(text.chars().count()));
                all.push(Thing { entry, pane, place: Rect { x, width, ..row }, drawn: None });
                end = at + text.len();
            }
        }
    }
    all
}

/// The text in a row of the screen.
fn line_at(buffer: &Buffer, row: Rect) -> String {
    row.columns().map(|cell| buffer[(cell.x, row.y)].symbol()).collect()
}

/// The card of an entry, line by line; with what it refers to, if that is asked for.
fn card(entry: &GlossaryEntry, session: &Session, screen: &Surface) -> Vec<Line<'static>> {
    let sentence = |text: &str| screen.look.sentence(text, &session.keymap);
    let mut told = vec![
        ("", sentence(entry.definition), Role::Text),
        ("", session.with_numbers(entry.formula), Role::Selected),
        ("unit: ", entry.unit.to_owned(), Role::Quiet),
        ("read on: ", sentence(entry.further), Role::Quiet),
    ];
    if matches!(&session.overlay, Some(Overlay::Explanation(shown)) if shown.more) {
        let others = entry.further.split([';', ',']).map(str::trim);
        let others = others.filter_map(|name| GlossaryEntry::of("word", name));
        let text = |it: &GlossaryEntry| format!("{}: {}", it.name, sentence(it.definition));
        told.extend(others.map(|it| ("", text(it), Role::Text)));
    }
    let told = told.into_iter().filter(|(_, text, _)| !text.is_empty());
    told.map(|(lead, text, role)| screen.look.span(lead.to_owned() + &text, role).into()).collect()
}

/// Highlights what is explained where it stands, and draws its card where it covers least of it.
pub fn draw(parts: &Layout, thing: &Thing, session: &Session, screen: &mut Surface) {
    /// Columns of a card, if the screen has so many.
    const WIDTH: u16 = 66;
    let pen = screen.look.style(Role::Cursor).add_modifier(Modifier::REVERSED);
    screen.buffer.set_style(thing.place, pen);
    let told = card(thing.entry, session, screen);
    let Rect { y, width, .. } = parts.title;
    let area =
        Rect { y: y + 1, height: parts.legend.y.saturating_sub(y + 1), width, x: parts.title.x };
    let width = WIDTH.min(area.width);
    let height = (pane::rows(&told, width - 4) + 2).min(area.height);
    let plot = thing.drawn.map_or(Rect::default(), |(index, _)| parts.plots[index]);
    let covers = |card: &Rect| [thing.place, plot].map(|it| card.intersection(it).area());
    let (right, bottom) = (area.right() - width, area.bottom() - height);
    let corners = [(area.x, bottom), (right, bottom), (right, area.y), (area.x, area.y)];
    let corners = corners.map(|(x, y)| Rect { x, y, width, height });
    let card = corners.into_iter().min_by_key(covers).unwrap_or(area);
    let inner = screen.boxed(card, &format!(" {} ", thing.entry.name), "");
    screen.prose(inner, told);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_and_mark_has_an_entry() {
        let lines = include_str!("../../assets/lines.txt").lines();
        let cells = lines.filter(|line| line.contains(" | ")).map(|line| line.split(" | "));
        // What the legend calls it, or where that is left out its name.
        let shown =
            cells.map(|mut cells| (cells.next(), cells.nth(2).filter(|brief| *brief != "-")));
        let names = shown.filter_map(|(name, brief)| brief.or(name));
        let open: Vec<&str> = names.filter(|name| line_entry(name).is_none()).collect();
        assert_eq!(open, Vec::<&str>::new());
    }
}
