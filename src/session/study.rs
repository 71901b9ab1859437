//! Studies: the present state of a session as a scene file, of which `hopfscope figure` makes the same figure again.

use crate::scene::{PlotSetup, Scene, View};
use crate::session::{Done, Framing, Plot, Session, Setup};

/// The present state as the text of a study. Fails with one line where it is more than a scene holds.
pub fn text(session: &Session) -> Done<String> {
    let set_up = |plot: &Plot| {
        let Plot { view, axes, family, window, framing, .. } = *plot;
        let window = (framing != Framing::Fitting).then_some(window);
        PlotSetup { view, axes, window, family }
    };
    let scene = Scene {
        also: None,
        next: None,
        plays: false,
        machine: session.scaled.clone(),
        problem: session.problem,
        beside: session.others.clone(),
        layers: session.layers.clone(),
        levels: session.levels.clone(),
        plots: session.plots.iter().map(set_up).collect(),
        arrangement: session.arrangement,
        ..Scene::clone(&session.scene)
    };
    let scans = session.plots.iter().any(|plot| plot.view == View::Scan);
    let compares = session.marks.pinned.is_some();
    if scans || compares || Setup::of_scene(&scene).doubt != session.doubt {
        let line =
            "a study holds no A beside B, no scan on show and no uncertainty; write FILE does";
        return Err(line.to_owned());
    }
    let body = toml::to_string(&scene as &dyn erased_serde::Serialize)
        .map_err(|error| format!("not written: {error}"))?;
    Ok(format!("# A study: `hopfscope figure FILE` draws it, `hopfscope FILE` opens it.\n{body}"))
}
