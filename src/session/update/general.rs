//! Commands that belong to no pane: focus, layers, undo, looks, leaving.

use std::sync::Arc;

use super::desk::{desk, set_up};
use super::parameters::number;
use super::{inform, macros, refuse};
use crate::oscillator::Symbol;
use crate::scene::{Layer, Scene};
use crate::session::belt::Stand;
use crate::session::history::{Before, Desk, Snapshot};
use crate::session::message::Effect;
use crate::session::overlay::{Caption, Overlay};
use crate::session::playback::Playback;
use crate::session::plot::Pane;
use crate::session::settings::{GLYPHS, THEMES, next_of};
use crate::session::state::{ROWS, Row, Session, Steps};
use crate::session::step::shortest;
use crate::study::harmonic_error::ladder;

/// Harmonics at most: more cost more than the picture shows.
pub(in crate::session) const MOST_HARMONICS: usize = 63;

/// Gives the focus to another pane.
pub fn focus(session: &mut Session, by: isize) -> Vec<Effect> {
    // An enlarged plot gives its place to the next one.
    let panes = session.plots.len() + 1;
    let at = match session.focus {
        Pane::Parameters => 0,
        Pane::Plot(index) => index + 1,
    };
    let next = at.checked_add_signed(by).unwrap_or(panes - 1) % panes;
    focus_on(session, next.checked_sub(1).map_or(Pane::Parameters, Pane::Plot));
    Vec::new()
}

/// Gives the focus to a pane.
pub(in crate::session) fn focus_on(session: &mut Session, pane: Pane) {
    session.focus = pane;
    if let Pane::Plot(index) = pane {
        session.plot = index;
    }
}

/// Gives one plot the place of all, or shares it again.
pub fn enlarge(session: &mut Session) -> Vec<Effect> {
    session.enlarged = !session.enlarged;
    Vec::new()
}

/// Shows or hides a layer.
pub fn toggle(session: &mut Session, layer: Layer) -> Vec<Effect> {
    let on = !session.layers.remove(&layer);
    if on {
        session.layers.insert(layer);
    }
    let spec = layer.spec();
    inform(session, format!("{} {}: {}", spec.name, if on { "on" } else { "off" }, spec.meaning));
    Vec::new()
}

/// Takes the next number of harmonics of a ladder, and shows their cycles.
pub fn harmonics(session: &mut Session, more: bool) -> Vec<Effect> {
    let ladder = ladder(MOST_HARMONICS);
    let now = session.harmonics;
    let next = if more {
        ladder.iter().find(|count| **count > now)
    } else {
        ladder.iter().rev().find(|count| **count < now)
    };
    session.layers.insert(Layer::Balance);
    match next {
        Some(next) => {
            session.harmonics = *next;
            inform(session, format!("harmonic balance with N = {next}"));
        }
        None => refuse(session, format!("the number of harmonics ends at {now}")),
    }
    Vec::new()
}

/// Undoes the last change.
pub fn undo(session: &mut Session) -> Vec<Effect> {
    let mut history = std::mem::take(&mut session.history);
    let found = history.undo(|before| present(session, before));
    session.history = history;
    bring_back(session, found, "undo")
}

/// Redoes what was undone last.
pub fn redo(session: &mut Session) -> Vec<Effect> {
    let mut history = std::mem::take(&mut session.history);
    let found = history.redo(|after| present(session, after));
    session.history = history;
    bring_back(session, found, "redo")
}

/// Today's state, as far as `other` reaches.
fn present(session: &Session, other: &Before) -> Before {
    match other {
        Before::Stand(_) => Before::Stand(session.stand()),
        Before::Desk(_) => Before::Desk(desk(session)),
        Before::Scene(_) => Before::Scene(Box::new(snapshot(session))),
    }
}

/// Everything that a scene sets, as it is now.
fn snapshot(session: &Session) -> Snapshot {
    Snapshot {
        scene: Arc::clone(&session.scene),
        stand: session.stand(),
        steps: session.steps,
        layers: session.layers.clone(),
        desk: desk(session),
    }
}

/// Everything that a scene sets, as it opens.
fn opening(scene: Arc<Scene>) -> Snapshot {
    Snapshot {
        stand: Stand::of_scene(&scene),
        steps: Steps::of_scene(&scene),
        layers: scene.layers.clone(),
        desk: Desk { plots: scene.plots.clone(), arrangement: scene.arrangement },
        scene,
    }
}

fn bring_back(session: &mut Session, found: Option<Before>, name: &str) -> Vec<Effect> {
    match found {
        None => refuse(session, format!("nothing to {name}")),
        Some(Before::Stand(stand)) => {
            inform(session, format!("{name}: {}", difference(&session.stand(), &stand)));
            session.set_stand(stand);
        }
        Some(Before::Desk(desk)) => {
            let titles: Vec<_> = desk.plots.iter().map(|plot| plot.view.spec().title).collect();
            inform(session, format!("{name}: {}", titles.join(", ")));
            set_up(session, &desk);
        }
        Some(Before::Scene(snapshot)) => {
            inform(session, format!("{name}: scene {}", snapshot.scene.name));
            restore(session, *snapshot);
        }
    }
    Vec::new()
}

/// What is different in `new`, as `name = value`; of a belt at another speed that alone, because the
/// parameters follow from it.
pub(super) fn difference(old: &Stand, new: &Stand) -> String {
    let value = |stand: &Stand, row: Row| match row {
        Row::Method => stand.problem.method.to_string(),
        Row::Belt => stand.belt_speed.map(shortest).unwrap_or_default(),
        row => shortest(number(stand, row)),
    };
    let belt = new.belt_speed.is_some() && old.belt_speed != new.belt_speed;
    let follows = |row: &Row| belt && matches!(row, Row::Parameter(_));
    let rows = ROWS.into_iter().filter(|row| !follows(row));
    let changed = rows.filter(|row| value(old, *row) != value(new, *row));
    let said = changed.map(|row| {
        let unit = if row == Row::Belt { " m/s" } else { "" };
        format!("{} = {}{unit}", row.name_in(&new.problem), value(new, row))
    });
    said.collect::<Vec<_>>().join(", ")
}

fn restore(session: &mut Session, snapshot: Snapshot) {
    session.scene = snapshot.scene;
    session.set_stand(snapshot.stand);
    session.steps = snapshot.steps;
    session.layers = snapshot.layers;
    set_up(session, &snapshot.desk);
    session.playback = Playback { pace: session.playback.pace, ..Playback::default() };
    session.held = None;
}

/// Opens a scene, as one change that can be undone.
pub(in crate::session) fn open_scene(session: &mut Session, scene: Arc<Scene>) {
    let before = snapshot(session);
    let opened = opening(scene);
    if before != opened {
        session.history.record(Before::Scene(Box::new(before)));
    }
    restore(session, opened);
    session.unfolded = false;
    session.selected = Row::FIRST;
    // Where the sentences of a scene begin.
    session.focus = Pane::Parameters;
}

/// Makes what stands here the beginning of a session: its scene opens like this, with these parameters
/// among its own, and nothing was done before.
pub(super) fn begin(session: &mut Session, names: Vec<Symbol>) {
    let mut scene = Arc::clone(&session.scene);
    let opens = Arc::make_mut(&mut scene);
    opens.problem = session.problem;
    opens.terms.extend(names);
    *session = Session {
        look: session.look,
        keymap: Arc::clone(&session.keymap),
        interrupted: session.interrupted.take(),
        ..Session::new(scene, session.size)
    };
}

/// Brings the scene back as it was opened.
pub fn reset_scene(session: &mut Session) -> Vec<Effect> {
    let scene = Arc::clone(&session.scene);
    inform(session, format!("scene {} as it was opened", scene.name));
    open_scene(session, scene);
    Vec::new()
}

/// Shows what there is to see in the scene and to press, or hides it.
pub fn explain(session: &mut Session) -> Vec<Effect> {
    session.caption =
        if session.caption == Caption::Scene { Caption::Nothing } else { Caption::Scene };
    Vec::new()
}

/// Draws with other characters.
pub fn glyphs(session: &mut Session) -> Vec<Effect> {
    let (glyphs, name) = next_of(&GLYPHS, session.look.glyphs);
    session.look.glyphs = glyphs;
    inform(session, format!("glyphs: {name}"));
    Vec::new()
}

/// Uses the next theme.
pub fn theme(session: &mut Session) -> Vec<Effect> {
    let (theme, name) = next_of(&THEMES, session.look.theme);
    session.look.theme = theme;
    inform(session, format!("theme: {name}"));
    Vec::new()
}

/// Closes what is open.
pub fn back(session: &mut Session) -> Vec<Effect> {
    session.overlay = None;
    Vec::new()
}

/// Asks again what has no answer.
pub fn retry(session: &mut Session) -> Vec<Effect> {
    if session.failures.is_empty() {
        inform(session, "nothing has failed");
    }
    session.failures.clear();
    Vec::new()
}

/// Agrees to press the pasted keys.
pub fn accept_offer(session: &mut Session) -> Vec<Effect> {
    match session.overlay.take() {
        Some(Overlay::Offer(script)) => {
            macros::inline(session);
            vec![Effect::Play(script)]
        }
        other => {
            session.overlay = other;
            Vec::new()
        }
    }
}

/// Leaves.
pub fn quit(session: &mut Session) -> Vec<Effect> {
    session.quit = true;
    vec![Effect::Quit]
}
