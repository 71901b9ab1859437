//! What the lists over the panes hold: everything, the scenes, the layers, the views, the costs. Those that are
//! searched show what is searched for.

use ratatui::layout::Rect;
use ratatui::text::Line;

use super::list::{ListContent, TEXT};
use super::{Look, Surface, keys, paper};
use crate::picture::Role;
use crate::scene::library::SceneGroup;
use crate::scene::said::said_by;
use crate::scene::{Answered, Finding, Layer, Topic, letters};
use crate::session::wants::{CostRow, Requirement, named};
use crate::session::{AnswerState, List, Listed, Overlay, PaletteRow, Session};
use crate::words::duration;
use crate::words::number::count;

/// Columns of keys in the help.
const KEYS: usize = 16;

/// Draws the open list, if there is one, into the middle of the screen.
pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let Some(Overlay::List(listed, list)) = &session.overlay else { return };
    let content = match listed {
        Listed::Scenes => scenes(session, list, look),
        Listed::Layers => layers(session, list, look),
        Listed::Views => views(session, list, look),
        Listed::Cost => costs(session, list, look),
        Listed::Paper => paper::content(session, list, look),
        Listed::Palette => palette(session, list, look),
        Listed::Interrupted => interrupted(session, list, look),
    };
    content.draw(area, list, screen);
}

/// Everything that has a name: with headings where nothing is searched, the best first where something is.
fn palette(session: &Session, list: &List, look: &Look) -> ListContent {
    let found = session.palette_rows(list);
    let mut content = ListContent { below: 2, ..ListContent::new("everything") };
    for row in &found {
        let heading = if list.search.is_empty() { session.heading(*row) } else { "" };
        let keys = keys_of(session, *row, look);
        let spaced = keys.join(" ");
        let keys = if spaced.chars().count() > KEYS { keys.concat() } else { spaced };
        let keys = if keys.is_empty() { row.name().to_owned() } else { keys };
        let keys = format!("{keys:<KEYS$} ");
        content.row(heading, [look.span(keys, Role::Key), look.span(row.meaning(), Role::Text)]);
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
        let heading = if list.search.is_empty() { SceneGroup::of(scene).title() } else { "" };
        let figure = scene.also.as_deref().unwrap_or_default();
        let cells = [
            look.span(format!("{:<14}", scene.name), Role::Key),
            look.span(format!("{figure:<7}"), Role::Quiet),
            look.span(scene.title.as_str(), Role::Text),
        ];
        content.row(heading, cells);
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
        let letter = letters.iter().find(|(_, layer)| *layer == spec.layer);
        let letter = letter.map_or(' ', |(letter, _)| *letter);
        let on = if session.layers.contains(&spec.layer) { "[x]" } else { "[ ]" };
        let meaning = session.not_drawn(spec.layer).unwrap_or(spec.meaning);
        let name = look.span(format!("{letter} {on} {:<16}", spec.name), Role::Key);
        content.row(spec.view.spec().title, [name, look.span(meaning, Role::Text)]);
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
        content.row("", [look.span(title, Role::Key), look.span(text, role)]);
    }
    content
}

fn interrupted(session: &Session, list: &List, look: &Look) -> ListContent {
    let mut content = ListContent::new("interrupted sessions");
    for (_, kept) in session.interrupted_rows(list) {
        let when = format!("{:<12} ", kept.when);
        content.row("", [look.span(when, Role::Key), look.span(kept.what.clone(), Role::Text)]);
    }
    content
}

/// What each question of the picture took, and what a step of each number asks again.
fn costs(session: &Session, list: &List, look: &Look) -> ListContent {
    /// Columns of what a row is about.
    const NAME: usize = 14;
    let mut content = ListContent::new("what the picture costs");
    for row in session.cost_rows(list) {
        let heading = if matches!(row, CostRow::Step(..)) { "a step of" } else { "" };
        let (name, text) = match row {
            CostRow::Asked(requirement) => asked(session, &requirement),
            CostRow::Formulas(layers) => ("formulas", format!("nothing for {}", names(&layers))),
            CostRow::Step(row, reused, anew) => {
                (row.name_in(&session.problem), consequence(&reused, &anew))
            }
        };
        let name = format!("{name:<NAME$}");
        content.row(heading, [look.span(name, Role::Key), look.span(text, Role::Text)]);
    }
    content
}

fn names(layers: &[Layer]) -> String {
    layers.iter().map(|layer| layer.spec().name).collect::<Vec<_>>().join(", ")
}

/// What a question took, and for which layers it is asked.
fn asked(session: &Session, requirement: &Requirement) -> (&'static str, String) {
    let topic = requirement.request.topic();
    let held = match session.answers.standing(&requirement.request) {
        AnswerState::Fresh(held) => Some(held),
        _ => None,
    };
    let price = held.map_or_else(|| "not answered".to_owned(), price);
    (topic.name(), format!("{price} for {}", names(&requirement.layers)))
}

fn price(answered: &Answered) -> String {
    let cost = answered.result.as_ref().map(Finding::cost).unwrap_or_default();
    let (evaluations, steps) = (count(cost.evaluations), count(cost.steps));
    format!("{evaluations:>6} ev {steps:>6} steps {:>8}", duration(answered.seconds))
}

/// What a step recomputes and what it reuses.
fn consequence(reused: &[Topic], anew: &[Topic]) -> String {
    let part = |name: &str, topics: &[Topic]| {
        (!topics.is_empty()).then(|| format!("{name} {}", named(topics, ", ")))
    };
    let parts = part("recomputes", anew).into_iter().chain(part("reuses", reused));
    let parts: Vec<_> = parts.collect();
    if parts.is_empty() { "nothing is asked".to_owned() } else { parts.join("; ") }
}
