//! Undo and redo, and opening scenes, which can be undone, too.

use std::sync::Arc;

use crate::fit::NoEstimate;
use crate::model::Knob;
use crate::scene::{Finding, PlotSetup, Reply, Scene, Topic, find};
use crate::session::act::compare;
use crate::session::act::screen_setup::set_up;
use crate::session::read::completion::difference;
use crate::session::{
    Done, EarlierState, Framing, Pane, Playback, Plot, Row, ScreenSetup, Session, Snapshot,
};
use crate::words::joined;

/// Undoes the last change.
pub fn undo(session: &mut Session) -> Done {
    let before = session.history.past.pop().ok_or("nothing to undo")?;
    session.history.future.push(present(session, &before));
    bring_back(session, "undo", before);
    Ok(())
}

/// Redoes the change that was undone last.
pub fn redo(session: &mut Session) -> Done {
    let after = session.history.future.pop().ok_or("nothing to redo")?;
    session.history.past.push(present(session, &after));
    bring_back(session, "redo", after);
    Ok(())
}

/// Stops fitting the record on show: restores the state before.
pub fn stop_fitting(session: &mut Session) {
    let recording = session.scene.recording.clone();
    while session.scene.recording == recording && undo(session).is_ok() {}
    if session.scene.recording == recording
        && let Some(request) = session.request(Topic::Fit, session.plot)
    {
        let result = Ok(Finding::Fit(NoEstimate::Interrupted.into()));
        session.answers.keep(Reply { request, result, seconds: 0.0, complete: true });
    }
    session.fitting = 0;
    session.inform("the fit was stopped");
}

/// The present state, to the extent of `other`.
fn present(session: &Session, other: &EarlierState) -> EarlierState {
    match other {
        EarlierState::Setup(_) => EarlierState::Setup(Box::new(session.setup())),
        EarlierState::Swap(_) => EarlierState::Swap(Box::new(session.setup())),
        EarlierState::ScreenSetup(_) => EarlierState::ScreenSetup(session.screen_setup()),
        EarlierState::Scene { .. } => whole(session),
    }
}

/// Everything that a scene determines, as it is now.
fn whole(session: &Session) -> EarlierState {
    let (plots, show) = (session.screen_setup().plots, Box::new(snapshot(session)));
    EarlierState::Scene { plots, show }
}

/// Everything that a scene determines but its plots, as it is now.
pub fn snapshot(session: &Session) -> Snapshot {
    Snapshot {
        scene: Arc::clone(&session.scene),
        setup: session.setup(),
        steps: session.steps,
        layers: session.layers.clone(),
        levels: session.levels.clone(),
        arrangement: session.arrangement,
    }
}

/// Brings a state back, and says what differs.
fn bring_back(session: &mut Session, name: &str, state: EarlierState) {
    match state {
        EarlierState::Setup(setup) => {
            session.inform(format!("{name}: {}", difference(&session.setup(), &setup)));
            session.set_setup(*setup);
        }
        EarlierState::Swap(setup) => {
            session.inform(format!("{name}: {}", difference(&session.setup(), &setup)));
            compare::exchange_back(session, &setup);
            session.set_setup(*setup);
        }
        EarlierState::ScreenSetup(ScreenSetup { arrangement, plots }) => {
            let titles = plots.iter().map(|plot| plot.view.spec().title);
            session.inform(format!("{name}: {}", joined(titles, ", ")));
            set_up(session, arrangement, opened(&plots));
            mark_own_windows(session);
        }
        EarlierState::Scene { plots, show } => {
            session.inform(format!("{name}: scene {}", show.scene.name));
            restore(session, *show, opened(&plots));
            mark_own_windows(session);
        }
    }
}

/// Marks the plots that came back with a window of their own, which is not the scene's: it was fitted or chosen.
fn mark_own_windows(session: &mut Session) {
    for index in 0..session.plots.len() {
        let Plot { view, axes, window, framing, .. } = session.plots[index];
        let of_scene = session.plot_of_scene(index, view);
        let is_others = |of: PlotSetup| of.axes != axes || of.window != Some(window);
        if framing == Framing::Scene && of_scene.is_none_or(is_others) {
            session.plots[index].framing = Framing::Fitted;
        }
    }
}

/// The plots as they were set up.
fn opened(plots: &[PlotSetup]) -> Vec<Plot> {
    plots.iter().map(Plot::opened).collect()
}

/// Makes this the present state.
pub fn restore(session: &mut Session, snapshot: Snapshot, plots: Vec<Plot>) {
    compare::keep(session, &snapshot.scene);
    session.scene = snapshot.scene;
    session.set_setup(snapshot.setup);
    session.steps = snapshot.steps;
    session.layers = snapshot.layers;
    session.levels = snapshot.levels;
    set_up(session, snapshot.arrangement, plots);
    session.playback = Playback { pace: session.playback.pace, ..Playback::default() };
    session.kicking = false;
}

/// Opens a scene, as one change that can be undone.
pub fn open_scene(session: &mut Session, scene: Arc<Scene>) {
    let (before, opens) = (whole(session), Session::new(scene, session.size));
    if before != whole(&opens) {
        session.history.record(before);
    }
    let playback = Playback { pace: session.playback.pace, ..opens.playback };
    restore(session, snapshot(&opens), opens.plots);
    session.playback = playback;
    session.unfolded = false;
    session.selected = Row::default();
    // The descriptions of scenes begin there.
    session.focus = Pane::Parameters;
}

/// What to press first.
pub const FIRST_KEYS: &str = "arrows change the numbers; {help} keys, {palette} commands, {explain} what to see, {tour} a tour";

/// Goes on from a first screen to the scene that it leads to. Returns whether there is one.
pub fn goes_deeper(session: &mut Session) -> bool {
    let next = session.scene.next.as_deref().and_then(|next| find(next).ok());
    let Some(next) = next else { return false };
    open_scene(session, next);
    session.inform_of_keys(FIRST_KEYS);
    true
}

/// Makes the present state the start of a session: its scene opens like this, with these parameters added to
/// its own, and the history is empty.
pub fn begin(session: &mut Session, names: Vec<Knob>) {
    let mut scene = Arc::clone(&session.scene);
    let opens = Arc::make_mut(&mut scene);
    opens.problem = session.problem;
    opens.terms.extend(names);
    *session = Session {
        display: session.display,
        keymap: Arc::clone(&session.keymap),
        interrupted: std::mem::take(&mut session.interrupted),
        ..Session::new(scene, session.size)
    };
}

/// Restores the scene as it opens.
pub fn reset_scene(session: &mut Session) {
    let scene = Arc::clone(&session.scene);
    session.inform(format!("scene {} as it was opened", scene.name));
    open_scene(session, scene);
}
