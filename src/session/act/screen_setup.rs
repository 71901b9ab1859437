//! Commands that change what is on show: the view of a plot, the number of plots, how they share the screen, and
//! which pane has the focus. Each change but that of the focus can be undone.

use crate::numerics::cycled;
use crate::scene::{Arrangement, LAYERS, MOST_PLOTS, PlotSetup, VIEWS, View, ViewSpec};
use crate::session::{Done, EarlierState, Pane, Plot, Session, next_of};

/// Replaces the plots and their arrangement.
pub fn set_up(session: &mut Session, arrangement: Arrangement, plots: Vec<Plot>) {
    (session.arrangement, session.plots) = (arrangement, plots);
    let last = session.plots.len().saturating_sub(1);
    session.plot = session.plot.min(last);
    if let Pane::Plot(index) = session.focus {
        session.focus = Pane::Plot(index.min(last));
    }
    session.held = None;
}

/// Records the present plots before a change.
fn record(session: &mut Session) {
    let before = EarlierState::ScreenSetup(session.screen_setup());
    session.history.record(before);
    session.held = None;
}

/// The setup of a plot that changes to a view: the scene's setup if no other plot shows the same axes,
/// otherwise that of another plot with this view, otherwise the usual axes in a fitted window.
fn plot_setup(session: &Session, plot: usize, view: View) -> PlotSetup {
    let others = (0..session.plots.len()).filter(|other| *other != plot);
    let others = others.map(|other| session.plot_setup(other)).filter(|other| other.view == view);
    let others: Vec<PlotSetup> = others.collect();
    let absent = |setup: &&PlotSetup| others.iter().all(|other| other.axes != setup.axes);
    let here = session.scene.plots.get(plot);
    let of_scene = here.into_iter().chain(&session.scene.plots);
    let of_scene = of_scene.filter(|setup| setup.view == view).find(absent);
    let axes = session.plots.get(plot).map(|plot| plot.axes).unwrap_or_default();
    of_scene.or(others.first()).copied().unwrap_or(PlotSetup::fitting(view, axes))
}

/// Switches on the usual layers of a view if all its layers are off.
fn switch_on(session: &mut Session, view: View) {
    let of_view = || LAYERS.iter().filter(|row| row.view == view);
    if of_view().all(|row| !session.layers.contains(&row.layer)) {
        let usual = of_view().filter(|row| row.usual).map(|row| row.layer);
        session.layers.extend(usual);
    }
}

/// Changes the view of the plot in use.
pub fn show(session: &mut Session, view: View) {
    let index = session.plot;
    if session.plots[index].view != view {
        let plot_setup = plot_setup(session, index, view);
        record(session);
        session.plots[index] = Plot::opened(&plot_setup);
        switch_on(session, view);
    }
    focus_on(session, Pane::Plot(index));
    let ViewSpec { title, meaning, .. } = view.spec();
    session.inform(format!("{title}: {meaning}"));
}

/// Changes the view of the plot in use, unless the new one could show nothing: of a list, one knows that only
/// afterwards.
pub fn show_from_list(session: &mut Session, view: View) -> Done {
    if let Some(lacks) = session.lacks(view) {
        return Err(format!("{} {}", view.spec().title, session.with_keys(lacks)));
    }
    show(session, view);
    Ok(())
}

/// Changes the plot in use to the next view of the list that can show anything, cycling.
pub fn next_view(session: &mut Session, by: isize) {
    let can: Vec<View> =
        VIEWS.iter().map(|row| row.view).filter(|view| session.lacks(*view).is_none()).collect();
    let present = session.view_in_use();
    let before = can.iter().filter(|view| **view < present).count();
    // From a view that is not among them, the next one is the first behind it.
    let from = if can.get(before) == Some(&present) || by < 0 {
        by
    } else {
        by - 1
    };
    show(session, can[cycled(before, from, can.len())]);
}

/// Adds a plot beside the one in use: with the first view that is not on show, otherwise with the same view.
pub fn add(session: &mut Session) -> Done {
    if session.plots.len() >= MOST_PLOTS {
        return Err(format!("there are {MOST_PLOTS} plots already; no more fit"));
    }
    let index = session.plot;
    let absent = |view: &View| {
        session.lacks(*view).is_none() && session.plots.iter().all(|plot| plot.view != *view)
    };
    let view = VIEWS.iter().map(|row| row.view).find(absent);
    let plot_setup = match view {
        Some(view) => plot_setup(session, session.plots.len(), view),
        None => session.plot_setup(index),
    };
    record(session);
    session.plots.insert(index + 1, Plot::opened(&plot_setup));
    switch_on(session, plot_setup.view);
    session.enlarged = false;
    focus_on(session, Pane::Plot(index + 1));
    let ViewSpec { title, meaning, .. } = plot_setup.view.spec();
    session.inform(format!("{title} more: {meaning}"));
    Ok(())
}

/// Removes the plot in use.
pub fn remove(session: &mut Session) -> Done {
    if session.plots.len() < 2 {
        return Err("the last plot cannot be removed".to_owned());
    }
    record(session);
    let removed = session.plots.remove(session.plot);
    session.plot = session.plot.min(session.plots.len() - 1);
    if session.focus != Pane::Parameters {
        focus_on(session, Pane::Plot(session.plot));
    }
    session.inform(format!("{} removed", removed.view.spec().title));
    Ok(())
}

/// Swaps the plot in use with the next one.
pub fn move_on(session: &mut Session) -> Done {
    if session.plots.len() < 2 {
        return Err("there is only one plot".to_owned());
    }
    record(session);
    let (from, to) = (session.plot, (session.plot + 1) % session.plots.len());
    session.plots.swap(from, to);
    focus_on(session, Pane::Plot(to));
    Ok(())
}

/// Selects the next arrangement of the plots.
pub fn arrange(session: &mut Session) {
    record(session);
    let (arrangement, name) = next_of(session.arrangement);
    session.arrangement = arrangement;
    session.inform(format!("arrangement: {name}"));
}

/// Gives the focus to another pane.
pub fn focus(session: &mut Session, by: isize) {
    // If a plot is enlarged, the next plot takes its space.
    let panes = session.plots.len() + 1;
    focus_on(session, Pane::numbered(cycled(session.focus.number(), by, panes)));
}

pub fn focus_on(session: &mut Session, pane: Pane) {
    session.focus = pane;
    if let Pane::Plot(index) = pane {
        session.plot = index;
    }
}
