//! Writes a session to its file.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::de::IgnoredAny;

use super::file::{SavedChange, SavedPlot, SavedScene, SavedSession, Show, VERSION};
use crate::scene::{Scene, find};
use crate::session::state::{
    Before, Overlay, Pane, Plot, ScreenSetup, Session, Setup, Uncertainty,
};

/// The session as the text of a file. Fails with one line if the text cannot be made; no such session is known.
pub fn text(session: &Session) -> Result<String, String> {
    let (past, future) = session.history.parts();
    let left = session.marks.left.as_ref().map(|mark| &mark.setup);
    let file = SavedSession {
        hopfscope: VERSION,
        selected: session.selected.name().to_owned(),
        focus: match session.focus {
            Pane::Parameters => 0,
            Pane::Plot(index) => index + 1,
        },
        plot: session.plot + 1,
        enlarged: session.enlarged,
        unfolded: session.unfolded,
        harmonics: session.harmonics,
        kicks: session.kicks,
        lines: session.lines.clone(),
        present: Show {
            arrangement: session.arrangement,
            layers: session.layers.clone(),
            steps: session.steps,
            motion: session.problem,
            beside: session.others.all().to_vec(),
            belt: session.setting,
            doubt: session.doubt,
            scene: named(&session.scene),
        },
        plots: session.plots.iter().map(saved_plot).collect(),
        marks: of_marks(session, |setup| Some(setup.problem)),
        belts: of_marks(session, |setup| setup.setting),
        beside: of_marks(session, |setup| {
            Some(setup.others.all().to_vec()).filter(|beside| !beside.is_empty())
        }),
        doubts: of_marks(session, |setup| Some(setup.doubt).filter(|doubt| !doubt.is_none())),
        left: left.map(|setup| setup.problem),
        left_beside: left.map_or_else(Vec::new, |setup| setup.others.all().to_vec()),
        left_belt: left.and_then(|setup| setup.setting),
        left_doubt: left.map_or_else(Uncertainty::default, |setup| setup.doubt),
        registers: IgnoredAny,
        past: past.iter().map(change).collect(),
        future: future.iter().map(change).collect(),
    };
    let body = toml::to_string(&file).map_err(|error| format!("not saved: {error}"))?;
    Ok(format!("# A session of hopfscope; `hopfscope --open FILE` resumes it.\n{body}"))
}

/// A value for each mark that has one.
fn of_marks<T>(session: &Session, of: impl Fn(&Setup) -> Option<T>) -> BTreeMap<char, T> {
    let marks = session.marks.places.iter();
    marks.filter_map(|(name, mark)| Some((*name, of(&mark.setup)?))).collect()
}

fn named(scene: &Arc<Scene>) -> SavedScene {
    match find(&scene.name) {
        Ok(known) if known == *scene => SavedScene::Library(scene.name.clone()),
        _ => SavedScene::Full(Box::new(Scene::clone(scene))),
    }
}

fn saved_plot(plot: &Plot) -> SavedPlot {
    let Plot { view, axes, window, framing, cursor, family, .. } = *plot;
    SavedPlot { view, framing, axes, window, cursor, family }
}

fn change(before: &Before) -> SavedChange {
    match before {
        Before::Setup(setup) => {
            let Setup { problem, others, setting, doubt } = &**setup;
            let motion = *problem;
            match (others.all(), setting) {
                ([], None) if doubt.is_none() => SavedChange::Motion(motion),
                ([], Some(belt)) if doubt.is_none() => {
                    SavedChange::MotionOnBelt { motion, belt: *belt }
                }
                (others, belt) => {
                    let (beside, doubt) = (others.to_vec(), *doubt);
                    SavedChange::Motions { motion, beside, belt: *belt, doubt }
                }
            }
        }
        Before::ScreenSetup(ScreenSetup { plots, arrangement }) => {
            SavedChange::Plots { arrangement: *arrangement, plots: plots.clone() }
        }
        Before::Scene(snapshot) => SavedChange::Scene {
            plots: snapshot.screen_setup.plots.clone(),
            show: Box::new(Show {
                arrangement: snapshot.screen_setup.arrangement,
                layers: snapshot.layers.clone(),
                steps: snapshot.steps,
                motion: snapshot.setup.problem,
                beside: snapshot.setup.others.all().to_vec(),
                belt: snapshot.setup.setting,
                doubt: snapshot.setup.doubt,
                scene: named(&snapshot.scene),
            }),
        },
    }
}

impl Session {
    /// Whether the user made something whose loss would matter: a change, a mark.
    pub fn is_worth_keeping(&self) -> bool {
        let (past, future) = self.history.depth();
        past + future > 0
            || !self.marks.places.is_empty()
            || matches!(self.overlay, Some(Overlay::Entry(_)))
    }
}
