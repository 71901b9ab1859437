//! Reads a session from its file.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Deserialize;

use super::file::{SavedChange, SavedPlot, SavedScene, SavedSession, Show, VERSION};
use crate::flow::Problem;
use crate::model::{Knob, State};
use crate::scene::{MOST_PLOTS, Misread, PlotSetup, Scene, Setting, find, misread};
use crate::session::read::numbers::difference;
use crate::session::state::session::MOST_HARMONICS;
use crate::session::state::starts::MOST_MOTIONS;
use crate::session::state::{
    Before, Bookmark, Bookmarks, History, Pane, Plot, Row, ScreenSetup, Session, Setup, Snapshot,
    Starts, Uncertainty,
};

/// Changes a session to that of a file. Appearance, keys and size stay, and so do answers that fit. Fails with
/// one line that says what is wrong; the session is then unchanged.
pub fn open(session: &mut Session, text: &str) -> Result<(), String> {
    let file = read(text)?;
    let scene = scene(file.present.scene)?;
    let Show { motion, ref beside, belt, doubt, .. } = file.present;
    let setup = checked(motion, beside, belt.as_ref(), doubt)?;
    let plots = checked_plots(file.plots, |plot| opened(&plot))?;
    let in_range = |index: usize| index < plots.len();
    let focus = match file.focus.checked_sub(1) {
        None => Pane::Parameters,
        Some(index) if in_range(index) => Pane::Plot(index),
        Some(_) => {
            return Err(format!("focus = {}, but there are {} plots", file.focus, plots.len()));
        }
    };
    let plot = file.plot.checked_sub(1).filter(|index| in_range(*index));
    let plot =
        plot.ok_or_else(|| format!("plot = {}, but there are {}", file.plot, plots.len()))?;
    let row = |row: &Row| row.name() == file.selected;
    let selected = Row::all().find(row);
    let selected = selected.ok_or_else(|| format!("no row {:?} to select", file.selected))?;
    let most = MOST_HARMONICS;
    if !(1..=most).contains(&file.harmonics) {
        return Err(format!("harmonics = {}, not 1 to {most}", file.harmonics));
    }
    let mark = |problem, beside: &[State], belt: Option<Setting>, doubt| {
        checked(problem, beside, belt.as_ref(), doubt).map(|setup| Bookmark::new(&setup))
    };
    let doubt = |name: &char| file.doubts.get(name).copied().unwrap_or_default();
    let beside = |name: &char| file.beside.get(name).map_or(&[][..], Vec::as_slice);
    let belt = |name: &char| file.belts.get(name).copied();
    let places = file.marks.into_iter();
    let places = places.map(|(name, problem)| {
        Ok((name, mark(problem, beside(&name), belt(&name), doubt(&name))?))
    });
    let places = places.collect::<Result<BTreeMap<_, _>, String>>()?;
    let left = file
        .left
        .map(|left| mark(left, &file.left_beside, file.left_belt, file.left_doubt))
        .transpose()?;
    let changes =
        |changes: Vec<SavedChange>| changes.into_iter().map(before).collect::<Result<_, _>>();
    let history = History::of(changes(file.past)?, changes(file.future)?);

    let mut opened = Session::new(scene, session.size);
    opened.set_setup(&setup);
    opened.steps = file.present.steps;
    opened.layers = file.present.layers;
    opened.arrangement = file.present.arrangement;
    opened.plots = plots;
    (opened.plot, opened.focus, opened.selected) = (plot, focus, selected);
    (opened.enlarged, opened.unfolded) = (file.enlarged, file.unfolded);
    (opened.harmonics, opened.kicks) = (file.harmonics, file.kicks);
    (opened.lines, opened.history) = (file.lines, history);
    opened.marks = Bookmarks { places, left };
    opened.answers = std::mem::take(&mut session.answers);
    opened.answers.ask(opened.asks());
    opened.answers.forget_others();
    opened.keymap = Arc::clone(&session.keymap);
    opened.display = session.display;
    *session = opened;
    Ok(())
}

/// A summary of a saved session in one line: its scene, what was changed, and how often. Fails with one line
/// that says what is wrong.
pub fn summary(text: &str) -> Result<String, String> {
    let file = read(text)?;
    let scene = scene(file.present.scene)?;
    let Show { motion, beside, belt, .. } = file.present;
    let setup = checked(motion, &beside, belt.as_ref(), Uncertainty::default())?;
    let changed = difference(&Setup::of_scene(&scene), &setup);
    let marks = match file.marks.len() {
        0 => String::new(),
        1 => ", 1 mark".to_owned(),
        count => format!(", {count} marks"),
    };
    let changes = match file.past.len() {
        1 => "1 change".to_owned(),
        count => format!("{count} changes"),
    };
    let with = if changed.is_empty() { changed } else { format!(" {changed}") };
    Ok(format!("{}{with} ({changes}{marks})", scene.name))
}

/// Parses the file, if its format is known.
fn read(text: &str) -> Result<SavedSession, String> {
    #[derive(Deserialize)]
    struct Head {
        hopfscope: Option<u32>,
    }
    let refused = |misread: Misread| format!("line {}: {}", misread.line, misread.message);
    let head: Head = misread::toml("", text).map_err(refused)?;
    match head.hopfscope {
        None => Err("not a saved session: it does not say hopfscope = 1".to_owned()),
        Some(version @ (0 | VERSION..)) if version != VERSION => {
            Err(format!("a session of format {version}; this program reads up to {VERSION}"))
        }
        Some(_) => misread::toml("", text).map_err(refused),
    }
}

fn scene(named: SavedScene) -> Result<Arc<Scene>, String> {
    match named {
        SavedScene::Library(name) => find(&name),
        SavedScene::Full(scene) => {
            checked(scene.problem, &[], None, Uncertainty::default())?;
            if scene.plots.is_empty() || scene.plots.len() > MOST_PLOTS {
                return Err(format!("a scene with {} plots", scene.plots.len()));
            }
            Ok(Arc::new(*scene))
        }
    }
}

/// The setup of a motion and a machine, if all numbers are within their ranges.
fn checked(
    problem: Problem,
    beside: &[State],
    setting: Option<&Setting>,
    doubt: Uncertainty,
) -> Result<Setup, String> {
    let accuracy = [Knob::Until, Knob::Tolerance, Knob::Step, Knob::Epsilon];
    for knob in Knob::MOTION.into_iter().chain(accuracy) {
        knob.check(problem.get(knob))?;
    }
    setting.map_or(Ok(()), Setting::checked)?;
    let others = Starts::of(beside).ok_or_else(|| {
        format!("{} motions beside another; there can be {}", beside.len(), MOST_MOTIONS - 1)
    })?;
    for (symbol, value) in
        beside.iter().flat_map(|start| [(Knob::Q0, start.q), (Knob::V0, start.v)])
    {
        symbol.check(value)?;
    }
    Ok(Setup { problem, others, setting: setting.copied(), doubt: doubt.checked()? })
}

/// Converts plots, if their number is allowed on a screen.
fn checked_plots<T, U>(plots: Vec<T>, make: impl Fn(T) -> U) -> Result<Vec<U>, String> {
    match plots.len() {
        1..=MOST_PLOTS => Ok(plots.into_iter().map(make).collect()),
        count => Err(format!("{count} plots; there can be 1 to {MOST_PLOTS}")),
    }
}

fn opened(saved: &SavedPlot) -> Plot {
    let SavedPlot { view, framing, axes, window, cursor, family } = *saved;
    let plot = Plot::opened(&PlotSetup { view, axes, window: Some(window), family });
    Plot {
        framing,
        cursor: cursor.filter(|cursor| cursor.x.is_finite() && cursor.y.is_finite()),
        ..plot
    }
}

fn before(change: SavedChange) -> Result<Before, String> {
    let known = Uncertainty::default();
    let setup = |motion, beside: &[State], belt: Option<Setting>, doubt| {
        checked(motion, beside, belt.as_ref(), doubt).map(|setup| Before::Setup(Box::new(setup)))
    };
    Ok(match change {
        SavedChange::Motion(motion) => setup(motion, &[], None, known)?,
        SavedChange::MotionOnBelt { motion, belt } => setup(motion, &[], Some(belt), known)?,
        SavedChange::Motions { motion, beside, belt, doubt } => {
            setup(motion, &beside, belt, doubt)?
        }
        SavedChange::Plots { arrangement, plots } => Before::ScreenSetup(ScreenSetup {
            plots: checked_plots(plots, |plot| plot)?,
            arrangement,
        }),
        SavedChange::Scene { plots, show } => {
            let Show { arrangement, layers, steps, motion, beside, belt, doubt, scene } = *show;
            Before::Scene(Box::new(Snapshot {
                scene: self::scene(scene)?,
                setup: checked(motion, &beside, belt.as_ref(), doubt)?,
                steps,
                layers,
                screen_setup: ScreenSetup {
                    plots: checked_plots(plots, |plot| plot)?,
                    arrangement,
                },
            }))
        }
    })
}
