//! Saved sessions: everything that a session is, as a TOML file, and back.
//!
//! What is saved is what the user made: scene, motion, steps, plots, layers, marks, registers, typed lines
//! and the history. Answers are not: they follow from the rest. How the screen looks belongs to the
//! terminal, and which key means what to the settings. A field of [`Session`] that should survive the
//! program has its place here.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::flow::Problem;
use crate::flow::method::{EPSILON_RANGE, STEP_RANGE};
use crate::oscillator::{PARAMETERS, State, Symbol};
use crate::scene::file::{TOLERANCE_RANGE, UNTIL_RANGE};
use crate::scene::{
    Arrangement, Axes, Layer, MOST_PLOTS, PlotSetup, Point, Scene, Setting, View, Window, find,
};
use crate::session::read::numbers::difference;
use crate::session::replay;
use crate::session::replay::script::Step;
use crate::session::state::doubt::Doubt;
use crate::session::state::history::{Before, History, ScreenSetup, Snapshot};
use crate::session::state::marks::{Bookmark, Marks};
use crate::session::state::overlay::Overlay;
use crate::session::state::plot::{Framing, Pane, Plot};
use crate::session::state::rows::{ROWS, Row, Steps};
use crate::session::state::session::{MOST_HARMONICS, Session};
use crate::session::state::setup::Setup;
use crate::session::state::starts::{MOST_MOTIONS, Starts};
use crate::study::kicks::Kicks;

/// The format that this program writes; it reads this one and all before.
const VERSION: u32 = 1;

/// A session as it stands on disk.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedSession {
    hopfscope: u32,
    /// The selected row of the parameter pane, by its name.
    selected: String,
    /// The pane in focus: 0 for the parameters, then the plots.
    focus: usize,
    /// The plot in use, from 1.
    plot: usize,
    enlarged: bool,
    unfolded: bool,
    harmonics: usize,
    #[serde(default)]
    kicks: Kicks,
    /// Lines typed on the command line, the newest last.
    lines: Vec<String>,
    present: Show,
    plots: Vec<SavedPlot>,
    #[serde(default)]
    marks: BTreeMap<char, Problem>,
    /// What the machine is set to at marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    belts: BTreeMap<char, Setting>,
    /// Where the motions start beside those of marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    beside: BTreeMap<char, Vec<State>>,
    /// What is not known exactly at marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    doubts: BTreeMap<char, Doubt>,
    /// The point left last for a mark.
    left: Option<Problem>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    left_beside: Vec<State>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    left_belt: Option<Setting>,
    #[serde(default, skip_serializing_if = "Doubt::is_none")]
    left_doubt: Doubt,
    /// Recorded keys, as keystroke files.
    #[serde(default)]
    registers: BTreeMap<char, String>,
    #[serde(default)]
    past: Vec<Change>,
    #[serde(default)]
    future: Vec<Change>,
}

/// A scene, by its name if it comes with the program, else in full.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Named {
    Library(String),
    Whole(Box<Scene>),
}

/// What a scene sets, as it is or was.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Show {
    arrangement: Arrangement,
    layers: BTreeSet<Layer>,
    steps: Steps,
    motion: Problem,
    /// Where the motions beside it start.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    beside: Vec<State>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    belt: Option<Setting>,
    #[serde(default, skip_serializing_if = "Doubt::is_none")]
    doubt: Doubt,
    scene: Named,
}

/// A plot and where one looks in it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedPlot {
    view: View,
    framing: Framing,
    axes: Axes,
    window: Window,
    cursor: Option<Point>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    family: Option<usize>,
}

/// A change that can be undone or redone: the state on its other side.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Change {
    Motion(Problem),
    MotionOnBelt {
        motion: Problem,
        belt: Setting,
    },
    Motions {
        motion: Problem,
        beside: Vec<State>,
        belt: Option<Setting>,
        #[serde(default, skip_serializing_if = "Doubt::is_none")]
        doubt: Doubt,
    },
    Plots {
        arrangement: Arrangement,
        plots: Vec<PlotSetup>,
    },
    Scene {
        plots: Vec<PlotSetup>,
        show: Box<Show>,
    },
}

/// The session as the text of a file.
///
/// # Errors
/// One line, if the text cannot be made; no session is known for which that is so.
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
        plots: session.plots.iter().map(look).collect(),
        marks: of_marks(session, |setup| Some(setup.problem)),
        belts: of_marks(session, |setup| setup.setting),
        beside: of_marks(session, |setup| {
            Some(setup.others.all().to_vec()).filter(|beside| !beside.is_empty())
        }),
        doubts: of_marks(session, |setup| Some(setup.doubt).filter(|doubt| !doubt.is_none())),
        left: left.map(|setup| setup.problem),
        left_beside: left.map_or_else(Vec::new, |setup| setup.others.all().to_vec()),
        left_belt: left.and_then(|setup| setup.setting),
        left_doubt: left.map_or_else(Doubt::default, |setup| setup.doubt),
        registers: session
            .macros
            .registers
            .iter()
            .map(|(name, steps)| (*name, replay::text("", steps)))
            .collect(),
        past: past.iter().map(change).collect(),
        future: future.iter().map(change).collect(),
    };
    let body = toml::to_string(&file).map_err(|error| format!("not saved: {error}"))?;
    Ok(format!("# A session of hopfscope; `hopfscope --open FILE` resumes it.\n{body}"))
}

/// What is so of the marks, as far as it is.
fn of_marks<T>(session: &Session, of: impl Fn(&Setup) -> Option<T>) -> BTreeMap<char, T> {
    let marks = session.marks.places.iter();
    marks.filter_map(|(name, mark)| Some((*name, of(&mark.setup)?))).collect()
}

fn named(scene: &Arc<Scene>) -> Named {
    match find(&scene.name) {
        Ok(known) if known == *scene => Named::Library(scene.name.clone()),
        _ => Named::Whole(Box::new(Scene::clone(scene))),
    }
}

fn look(plot: &Plot) -> SavedPlot {
    let Plot { view, axes, window, framing, cursor, family, .. } = *plot;
    SavedPlot { view, framing, axes, window, cursor, family }
}

fn change(before: &Before) -> Change {
    match before {
        Before::Setup(setup) => {
            let Setup { problem, others, setting, doubt } = &**setup;
            let motion = *problem;
            match (others.all(), setting) {
                ([], None) if doubt.is_none() => Change::Motion(motion),
                ([], Some(belt)) if doubt.is_none() => Change::MotionOnBelt { motion, belt: *belt },
                (others, belt) => {
                    let (beside, doubt) = (others.to_vec(), *doubt);
                    Change::Motions { motion, beside, belt: *belt, doubt }
                }
            }
        }
        Before::ScreenSetup(ScreenSetup { plots, arrangement }) => {
            Change::Plots { arrangement: *arrangement, plots: plots.clone() }
        }
        Before::Scene(snapshot) => Change::Scene {
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

/// Makes a session what a file says. Look, keys and size stay, and so do answers, as far as they fit.
///
/// # Errors
/// One line that says what is wrong; the session is as it was.
pub fn open(session: &mut Session, text: &str) -> Result<(), String> {
    let file = read(text)?;
    let scene = scene(file.present.scene)?;
    let setup = checked(file.present.motion, &file.present.beside, file.present.belt)?;
    let setup = Setup { doubt: file.present.doubt.checked()?, ..setup };
    let plots = checked_plots(file.plots, |look| opened(&look))?;
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
    let selected = ROWS.into_iter().find(row);
    let selected = selected.ok_or_else(|| format!("no row {:?} to select", file.selected))?;
    let most = MOST_HARMONICS;
    if !(1..=most).contains(&file.harmonics) {
        return Err(format!("harmonics = {}, not 1 to {most}", file.harmonics));
    }
    let mark = |problem, beside: &[State], belt, doubt| {
        let doubt = Doubt::checked(doubt)?;
        checked(problem, beside, belt).map(|it| Bookmark::new(&Setup { doubt, ..it }))
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
    let register = |(name, keys): (char, String)| Ok((name, steps(name, &keys)?));
    let registers = file.registers.into_iter().map(register);
    let registers = registers.collect::<Result<BTreeMap<_, _>, String>>()?;
    let changes = |changes: Vec<Change>| changes.into_iter().map(before).collect::<Result<_, _>>();
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
    opened.marks = Marks { places, left };
    opened.macros.registers = registers;
    opened.answers = std::mem::take(&mut session.answers);
    opened.answers.ask(opened.asks());
    opened.answers.forget_others();
    opened.keymap = Arc::clone(&session.keymap);
    opened.look = session.look;
    *session = opened;
    Ok(())
}

/// What is in a saved session, in a line: its scene, what was changed, and how often.
///
/// # Errors
/// One line that says what is wrong.
pub fn summary(text: &str) -> Result<String, String> {
    let file = read(text)?;
    let scene = scene(file.present.scene)?;
    let setup = checked(file.present.motion, &file.present.beside, file.present.belt)?;
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

/// The file, if it is one of a format that is known.
fn read(text: &str) -> Result<SavedSession, String> {
    #[derive(Deserialize)]
    struct Head {
        hopfscope: Option<u32>,
    }
    let refused = |error: toml::de::Error| {
        let line =
            error.span().map_or(0, |span| text[..span.start.min(text.len())].matches('\n').count());
        let message = error.message().lines().next().unwrap_or_default();
        format!("line {}: {message}", line + 1)
    };
    let head: Head = toml::from_str(text).map_err(refused)?;
    match head.hopfscope {
        None => Err("no saved session: it does not say hopfscope = 1".to_owned()),
        Some(version @ (0 | VERSION..)) if version != VERSION => {
            Err(format!("a session of format {version}; this program reads up to {VERSION}"))
        }
        Some(_) => toml::from_str(text).map_err(refused),
    }
}

fn scene(named: Named) -> Result<Arc<Scene>, String> {
    match named {
        Named::Library(name) => find(&name).map_err(|missing| missing.to_string()),
        Named::Whole(scene) => {
            checked(scene.problem, &[], None)?;
            if scene.plots.is_empty() || scene.plots.len() > MOST_PLOTS {
                return Err(format!("a scene with {} plots", scene.plots.len()));
            }
            Ok(Arc::new(*scene))
        }
    }
}

/// A motion, and a setting of a machine, whose numbers are all within their ranges.
fn checked(problem: Problem, beside: &[State], setting: Option<Setting>) -> Result<Setup, String> {
    for row in &PARAMETERS {
        let value = row.symbol.get(&problem.parameters, &problem.initial);
        row.check(value).map_err(|refused| refused.to_string())?;
    }
    for (name, value, (min, max)) in [
        ("until", problem.until, UNTIL_RANGE),
        ("tolerance", problem.tolerance, TOLERANCE_RANGE),
        ("step", problem.step, STEP_RANGE),
        ("epsilon", problem.epsilon, EPSILON_RANGE),
    ] {
        if !(min..=max).contains(&value) {
            return Err(format!("{name} = {value:?} is outside its range {min:?} .. {max:?}"));
        }
    }
    let setting = setting.map(Setting::checked).transpose();
    let setting = setting.map_err(|refused| refused.to_string())?;
    let others = Starts::of(beside).ok_or_else(|| {
        format!("{} motions beside another; there can be {}", beside.len(), MOST_MOTIONS - 1)
    })?;
    for (symbol, value) in
        beside.iter().flat_map(|start| [(Symbol::Q0, start.q), (Symbol::V0, start.v)])
    {
        symbol.spec().check(value).map_err(|refused| refused.to_string())?;
    }
    Ok(Setup { problem, others, setting, doubt: Doubt::default() })
}

/// As many plots as a screen can have.
fn checked_plots<T, U>(plots: Vec<T>, make: impl Fn(T) -> U) -> Result<Vec<U>, String> {
    match plots.len() {
        1..=MOST_PLOTS => Ok(plots.into_iter().map(make).collect()),
        count => Err(format!("{count} plots; there can be 1 to {MOST_PLOTS}")),
    }
}

fn opened(look: &SavedPlot) -> Plot {
    let SavedPlot { view, framing, axes, window, cursor, family } = *look;
    let plot = Plot::opened(&PlotSetup { view, axes, window: Some(window), family });
    Plot {
        framing,
        cursor: cursor.filter(|cursor| cursor.x.is_finite() && cursor.y.is_finite()),
        ..plot
    }
}

fn steps(name: char, keys: &str) -> Result<Vec<Step>, String> {
    let script = replay::parse(keys).map_err(|error| format!("register {name}: {error}"))?;
    Ok(script.steps.into_iter().map(|located| located.step).collect())
}

fn before(change: Change) -> Result<Before, String> {
    Ok(match change {
        Change::Motion(problem) => Before::Setup(Box::new(checked(problem, &[], None)?)),
        Change::MotionOnBelt { motion, belt } => {
            Before::Setup(Box::new(checked(motion, &[], Some(belt))?))
        }
        Change::Motions { motion, beside, belt, doubt } => Before::Setup(Box::new(Setup {
            doubt: doubt.checked()?,
            ..checked(motion, &beside, belt)?
        })),
        Change::Plots { arrangement, plots } => Before::ScreenSetup(ScreenSetup {
            plots: checked_plots(plots, |plot| plot)?,
            arrangement,
        }),
        Change::Scene { plots, show } => {
            let Show { arrangement, layers, steps, motion, beside, belt, doubt, scene } = *show;
            Before::Scene(Box::new(Snapshot {
                scene: self::scene(scene)?,
                setup: Setup { doubt: doubt.checked()?, ..checked(motion, &beside, belt)? },
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

impl Session {
    /// Whether the user did something that would be missed: a change, a mark, a register.
    pub fn is_worth_keeping(&self) -> bool {
        let (past, future) = self.history.depth();
        past + future > 0
            || !self.marks.places.is_empty()
            || !self.macros.registers.is_empty()
            || matches!(self.overlay, Some(Overlay::Entry(_)))
    }
}
