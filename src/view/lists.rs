//! What the lists over the panes hold: everything, the scenes, the layers, the views, the costs, the claims of the paper. Those
//! that are searched show what is searched for. The rows scroll so that the selected one is seen, and below them stands what
//! is said of that one.

use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::{Look, Surface, pane};
use crate::numerics::cells;
use crate::paper::{Claim, ClaimResult, Verdict};
use crate::picture::Role;
use crate::scene::said::said_by;
use crate::scene::{Layer, SceneGroup, letters};
use crate::session::wants::CostRow;
use crate::session::{List, ListKind, Overlay, PaletteRow, Session};
use crate::words::{claim, joined, significant};

/// Columns of keys in the help.
const KEYS: usize = 16;

/// Adds the rows of a list, and what is said of the selected one.
type FillList = fn(&mut ListContent, &Session, &List, &Look);

/// Draws the open list, if there is one, into the middle of the screen.
pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let Some(Overlay::List(kind, list)) = &session.overlay else { return };
    let (title, below, fill): (_, _, FillList) = match kind {
        ListKind::Scenes => ("scenes", TEXT, scenes),
        ListKind::Layers => ("layers", 0, layers),
        ListKind::Views => ("show", 0, views),
        ListKind::Cost => ("what the picture costs", 0, costs),
        ListKind::Paper => ("the paper against computation", TEXT, paper),
        ListKind::Palette => ("everything", 2, palette),
        ListKind::Interrupted => ("interrupted sessions", 0, interrupted),
    };
    let mut content = ListContent { title, below, ..ListContent::default() };
    fill(&mut content, session, list, look);
    content.draw(area, list, screen);
}

/// Everything that has a name, and why it cannot be run if so.
fn palette(content: &mut ListContent, session: &Session, list: &List, look: &Look) {
    let found = session.palette_rows(list);
    let told = |row: PaletteRow| match session.refused(list, row) {
        Some(why) => look.span(look.sentence(why, &session.keymap), Role::Quiet),
        None => look.span(row.meaning(), Role::Text),
    };
    for row in &found {
        let keys = keys_of(session, *row, look);
        let keys = pane::fitting([keys.join(" "), keys.concat()], KEYS);
        let keys = if keys.is_empty() { row.name().to_owned() } else { keys };
        let keys = format!("{keys:<KEYS$} ");
        content.row(session.heading_in(list, *row), [look.span(keys, Role::Key), told(*row)]);
    }
    if let Some(row) = found.get(list.selected) {
        let name = match row {
            PaletteRow::Command(line) if line.words().is_some() => {
                format!(":{} {}", line.name, line.arguments)
            }
            row => row.name().to_owned(),
        };
        let name = look.span(format!("{name}   "), Role::Title);
        let kind = look.span(session.heading(*row).to_lowercase(), Role::Quiet);
        content.about = vec![vec![name, kind].into(), told(*row).into()];
    }
}

/// The keys of a row where it is run; the colon of a command that takes words.
fn keys_of(session: &Session, row: PaletteRow, look: &Look) -> Vec<String> {
    let PaletteRow::Command(command) = row else { return Vec::new() };
    if command.words().is_some() {
        return vec![format!(":{}", command.name)];
    }
    let place = session.place_of(row);
    let keys = place.map(|context| session.keymap.keys_in(context, command));
    keys.into_iter().flatten().map(|key| look.key(key)).collect()
}

/// The scenes in their groups, and what there is to see and to do in the selected one.
fn scenes(content: &mut ListContent, session: &Session, list: &List, look: &Look) {
    let found = session.scene_rows(list);
    for scene in &found {
        let heading = SceneGroup::of(scene).title();
        let figure = scene.also.as_deref().unwrap_or_default();
        let cells = [
            look.span(format!("{:<14}", scene.name), Role::Key),
            look.span(format!("{figure:<7}"), Role::Quiet),
            look.span(scene.title.as_str(), Role::Text),
        ];
        content.row(heading, cells);
    }
    if let Some(scene) = found.get(list.selected) {
        let said = |text: &str| look.sentence(&said_by(scene, text), &session.keymap);
        let text = |text: &str| look.span(said(text), Role::Quiet).into();
        content.about = vec![text(&scene.watch), Line::default(), text(&scene.press)];
    }
}

/// The layers, and which of them are on; those of the plot in use with the letter that switches them.
fn layers(content: &mut ListContent, session: &Session, list: &List, look: &Look) {
    let letters: Vec<(char, Layer)> = letters(session.view_in_use()).collect();
    for spec in session.layer_rows(list) {
        let letter = letters.iter().find(|(_, layer)| *layer == spec.layer);
        let letter = letter.map_or(' ', |(letter, _)| *letter);
        let on = if session.layers.contains(&spec.layer) {
            "[x]"
        } else {
            "[ ]"
        };
        let meaning = session.not_drawn(spec.layer).unwrap_or(spec.meaning);
        let name = look.span(format!("{letter} {on} {:<16}", spec.name), Role::Key);
        content.row(spec.view.spec().title, [name, look.span(meaning, Role::Text)]);
    }
}

/// The views, with those on show marked.
fn views(content: &mut ListContent, session: &Session, list: &List, look: &Look) {
    for spec in session.view_rows(list) {
        let shown = session.plots.iter().any(|plot| plot.view == spec.view);
        let on = if shown { "[x]" } else { "[ ]" };
        let title = format!("{on} {:<14}", spec.title);
        let lacks = session.lacks(spec.view).map(|text| look.sentence(text, &session.keymap));
        let (text, role) = match lacks {
            Some(lacks) => (lacks, Role::Quiet),
            None => (spec.meaning.to_owned(), Role::Text),
        };
        content.row("", [look.span(title, Role::Key), look.span(text, role)]);
    }
}

fn interrupted(content: &mut ListContent, session: &Session, list: &List, look: &Look) {
    for (_, kept) in session.interrupted_rows(list) {
        let when = format!("{:<12} ", kept.when);
        content.row("", [look.span(when, Role::Key), look.span(kept.what.clone(), Role::Text)]);
    }
}

/// What each question of the picture took, and what a step of each number asks again.
fn costs(content: &mut ListContent, session: &Session, list: &List, look: &Look) {
    for CostRow { name, text, is_step } in session.cost_rows(list) {
        let heading = if is_step { "a step of" } else { "" };
        let name = look.span(format!("{name:<14}"), Role::Key);
        content.row(heading, [name, look.span(text, Role::Text)]);
    }
}

/// The claims of the paper, section by section, with their verdicts.
fn paper(content: &mut ListContent, session: &Session, list: &List, look: &Look) {
    let found = session.claim_rows(list);
    for (claim, examined) in &found {
        let (verdict, role) = match examined {
            Some(examined) => (claim::verdict(examined), role_of(examined)),
            None => ("computing".to_owned(), Role::Quiet),
        };
        let cells = [
            look.span(format!("{:<14} ", claim.equation), Role::Key),
            look.span(format!("{verdict:<17} "), role),
            look.span(claim.statement, Role::Text),
        ];
        content.row(heading_of(claim.section), cells);
    }
    if let Some((claim, examined)) = found.get(list.selected) {
        content.about = about_claim(claim, *examined, look);
    }
    if !session.examined().is_empty() {
        let summary = claim::summary(session.examined());
        content.about.push(look.span(summary, Role::Quiet).into());
    }
}

/// What stands above the claims of a section.
fn heading_of(section: &'static str) -> &'static str {
    let mut rows = include_str!("../../assets/sections.txt").lines().filter_map(cells);
    rows.find(|[number, _]| *number == section).map_or(section, |[_, heading]| heading)
}

/// What holds is quiet, what does not is loud.
fn role_of(examined: &ClaimResult) -> Role {
    match examined.verdict() {
        Some(Verdict::Agrees | Verdict::Approximates { .. }) => Role::Text,
        Some(Verdict::Corrected { .. } | Verdict::InPart) => Role::Warning,
        Some(Verdict::False) => Role::Failure,
        None => Role::Quiet,
    }
}

/// The claim in full, its numbers, and the scene that shows it.
fn about_claim(claim: &Claim, examined: Option<&ClaimResult>, look: &Look) -> Vec<Line<'static>> {
    let text = |text: String| look.span(text, Role::Text).into();
    let mut lines: Vec<Line> = vec![text(format!("{}: {}", claim.equation, claim.statement))];
    match examined.map(|examined| &examined.evidence) {
        None => {}
        Some(Err(reason)) => lines.push(text(format!("not computed: {reason}"))),
        Some(Ok(evidence)) => {
            let number = |name: &str, value: Option<f64>| {
                value.map(|value| format!("{name} {}", significant(value, 10)))
            };
            let error = Some(evidence.computed.error).filter(|error| *error > 0.0);
            let parts = [
                number("paper", evidence.paper),
                number("corrected", evidence.corrected),
                number("computed", Some(evidence.computed.value)),
                error.map(|error| format!("known to {}", significant(error, 1))),
            ];
            lines.push(text(joined(parts.into_iter().flatten(), ", ")));
            let judged = [
                &format!("compared with: {}", claim.basis),
                &claim::sense(evidence.sense),
                &evidence.place,
            ];
            let judged = joined(judged.into_iter().filter(|text| !text.is_empty()), "; ");
            lines.push(look.span(judged, Role::Quiet).into());
        }
    }
    if let Some(scene) = claim.scene {
        lines.push(look.span(format!("scene {scene}"), Role::Quiet).into());
    }
    lines
}

const WIDTH: u16 = 90;

/// Rows of text below a list of scenes or claims.
const TEXT: u16 = 8;

#[derive(Default)]
struct ListContent {
    title: &'static str,
    /// The rows, each with the heading of its group, which may be empty.
    rows: Vec<(&'static str, Vec<Span<'static>>)>,
    /// About the selected row, below the list.
    about: Vec<Line<'static>>,
    below: u16,
}

impl ListContent {
    fn row<const N: usize>(&mut self, heading: &'static str, cells: [Span<'static>; N]) {
        self.rows.push((heading, cells.into()));
    }

    /// The lines of the list, with the headings of groups, and the number of the one that is selected.
    fn lines(&mut self, selected: usize, look: &Look) -> (Vec<Line<'static>>, usize) {
        let (mut lines, mut group, mut place) = (Vec::new(), "", 0);
        for (index, (heading, cells)) in std::mem::take(&mut self.rows).into_iter().enumerate() {
            if heading != group {
                lines.push(look.span(heading, Role::Title).into());
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
    fn draw(mut self, area: Rect, list: &List, screen: &mut Surface) {
        let count = self.rows.len();
        let (lines, selected) = self.lines(list.selected, screen.look);
        let below = if self.about.is_empty() { 0 } else { self.below + 1 };
        let wanted = pane::cells(lines.len()).saturating_add(2 + below);
        // No slivers of panes beside the list; the footer stays in sight.
        let width = if area.width <= WIDTH + 10 { area.width } else { WIDTH };
        let above_footer = area.height.saturating_sub(1);
        let height = above_footer.min(wanted.max(4));
        let (x, y) = (area.x + (area.width - width) / 2, area.y + (above_footer - height) / 2);
        let area = Rect { x, y, width, height };
        let remark = match count {
            0 => String::new(),
            _ => format!(" {} of {count} ", (list.selected + 1).min(count)),
        };
        let inner = screen.boxed(area, &heading(self.title, list), &remark);
        let least = pane::cells(lines.len()).min(4);
        let about = below.min(inner.height.saturating_sub(least));
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
    let pointer = if selected { &look.symbols().pointer } else { " " };
    let style = |span: Span<'static>| {
        if selected {
            span.patch_style(look.style(Role::Selected))
        } else {
            span
        }
    };
    let pointer = look.span(format!("{pointer} "), Role::Focus);
    std::iter::once(pointer).chain(spans.into_iter().map(style)).collect()
}
