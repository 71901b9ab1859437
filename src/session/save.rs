//! Saved sessions: the complete state of a session as a TOML file.
//!
//! What the user made is saved: scene, motion, steps, plots, layers, marks, typed lines and the
//! history. Answers are not saved, because they follow from the rest. The appearance of the screen belongs to
//! the terminal, and the keys to the settings file. A field of `Session` that must survive the program has its
//! place here.
//!
//! The start of a session is also written as steps of a keystroke file, which lead to the same state from anywhere: a
//! built-in scene with other numbers as lines that could be typed, anything else, such as a machine or a saved session,
//! as a saved session embedded in the file.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::flow::Problem;
use crate::model::{Knob, State};
use crate::numerics::shortest;
use crate::portrait::RandomKick;
use crate::scene::{FileMistake, Point, Scene, Setting, find, placed};
use crate::session::act::compare;
use crate::session::act::history::{restore, snapshot};
use crate::session::act::screen_setup::focus_on;
use crate::session::read::completion::difference;
use crate::session::{
    Bookmarks, DisplaySettings, Done, EarlierState, History, Instruction, Letter, MOST_HARMONICS,
    Msg, NamedValue, Overlay, Pane, Plot, Prompt, Row, Session, Setup, Snapshot, Uncertainty,
    check_number,
};
use crate::words::counted;

/// The format that this program writes; it reads this and all earlier formats.
const VERSION: u32 = 1;

/// The file of a saved session.
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
    kicks: RandomKick,
    /// Lines typed on the command line, the most recent last.
    lines: Vec<String>,
    /// Without the plots, which stand by themselves.
    present: Snapshot,
    plots: Vec<Plot>,
    /// The motions at marks.
    #[serde(default)]
    marks: BTreeMap<char, Problem>,
    /// The settings of the machine at marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    belts: BTreeMap<char, Setting>,
    /// The starts of the other motions at marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    beside: BTreeMap<char, Vec<State>>,
    /// What is not known exactly at marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    doubts: BTreeMap<char, Uncertainty>,
    /// The motion of the point that was left last.
    left: Option<Problem>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    left_beside: Vec<State>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    left_belt: Option<Setting>,
    #[serde(default, skip_serializing_if = "Uncertainty::is_none")]
    left_doubt: Uncertainty,
    /// What the point left is called if it is pinned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pinned: Option<Letter>,
    /// Recorded keys of earlier versions, which are dropped.
    #[serde(default, skip_serializing)]
    #[expect(dead_code, reason = "a file that has them is still read")]
    registers: IgnoredAny,
    #[serde(default)]
    past: Vec<EarlierState>,
    #[serde(default)]
    future: Vec<EarlierState>,
}

/// The session as the text of a file. Fails with one line if the text cannot be made; no such session is known.
pub fn text(session: &Session) -> Done<String> {
    let left = session.marks.left.clone();
    let file = SavedSession {
        hopfscope: VERSION,
        selected: session.selected.name().to_owned(),
        focus: session.focus.number(),
        plot: session.plot + 1,
        enlarged: session.enlarged,
        unfolded: session.unfolded,
        harmonics: session.harmonics,
        kicks: session.kicks,
        lines: session.lines.clone(),
        present: snapshot(session),
        plots: session.plots.clone(),
        marks: of_marks(session, |setup| Some(setup.problem)),
        belts: of_marks(session, |setup| setup.setting.clone()),
        beside: of_marks(session, |setup| (!setup.others.is_empty()).then(|| setup.others.clone())),
        doubts: of_marks(session, |setup| (!setup.doubt.is_none()).then_some(setup.doubt)),
        left: left.as_ref().map(|setup| setup.problem),
        left_belt: left.as_ref().and_then(|setup| setup.setting.clone()),
        left_doubt: left.as_ref().map(|setup| setup.doubt).unwrap_or_default(),
        left_beside: left.map(|setup| setup.others).unwrap_or_default(),
        pinned: session.marks.pinned,
        registers: IgnoredAny,
        past: session.history.past.clone(),
        future: session.history.future.clone(),
    };
    let body = toml::to_string(&file as &dyn erased_serde::Serialize)
        .map_err(|error| format!("not saved: {error}"))?;
    Ok(format!("# A session of hopfscope; `hopfscope --open FILE` resumes it.\n{body}"))
}

/// A value for each mark that has one.
fn of_marks<T>(session: &Session, of: impl Fn(&Setup) -> Option<T>) -> BTreeMap<char, T> {
    let marks = session.marks.places.iter();
    marks.filter_map(|(name, mark)| Some((*name, of(mark)?))).collect()
}

/// Changes a session to that of a file. Appearance, keys and size stay, and so do answers that fit. Fails with
/// one line that says what is wrong; the session is then unchanged.
pub fn open(session: &mut Session, text: &str) -> Done {
    let mut file = read(text)?;
    let SavedSession { focus, plot, harmonics, .. } = file;
    let count = file.plots.len();
    if focus > count {
        return Err(format!("focus = {focus}, but there are {count} plots"));
    }
    if !(1..=count).contains(&plot) {
        return Err(format!("plot = {plot}, but there are {count}"));
    }
    let selected = Row::all().find(|row| row.name() == file.selected);
    let selected = selected.ok_or_else(|| format!("no row {:?} to select", file.selected))?;
    if !(1..=MOST_HARMONICS).contains(&harmonics) {
        return Err(format!("harmonics = {harmonics}, not 1 to {MOST_HARMONICS}"));
    }
    let mark = |problem, others, setting, doubt| {
        let setup = Setup { problem, others, setting, doubt };
        setup.check()?;
        Ok::<_, String>(setup)
    };
    let mut marks = Bookmarks::default();
    for (name, problem) in file.marks {
        let beside = file.beside.remove(&name).unwrap_or_default();
        let doubt = file.doubts.remove(&name).unwrap_or_default();
        let bookmark = mark(problem, beside, file.belts.remove(&name), doubt)?;
        marks.places.insert(name, bookmark);
    }
    if let Some(left) = file.left {
        marks.left = Some(mark(left, file.left_beside, file.left_belt, file.left_doubt)?);
        marks.pinned = file.pinned;
    }
    let is_place = |at: &Point| at.x.is_finite() && at.y.is_finite();
    file.plots.iter_mut().for_each(|plot| plot.cursor = plot.cursor.filter(is_place));

    let mut opened = Session::new(Arc::clone(&file.present.scene), session.size);
    restore(&mut opened, file.present, file.plots);
    // Of a file that was edited by hand, the focus says which plot is in use.
    opened.plot = plot - 1;
    focus_on(&mut opened, Pane::numbered(focus));
    (opened.selected, opened.marks) = (selected, marks);
    (opened.enlarged, opened.unfolded) = (file.enlarged, file.unfolded);
    (opened.harmonics, opened.kicks) = (harmonics, file.kicks);
    opened.lines = file.lines;
    opened.history = History { past: file.past, future: file.future };
    opened.answers = std::mem::take(&mut session.answers);
    compare::follow(&mut opened);
    opened.answers.ask(opened.asks());
    opened.answers.forget_others();
    opened.keymap = Arc::clone(&session.keymap);
    opened.display = session.display;
    *session = opened;
    Ok(())
}

/// A summary of a saved session in one line: its scene, what was changed, and how often. Fails with one line
/// that says what is wrong.
pub fn summary(text: &str) -> Done<String> {
    let file = read(text)?;
    let Snapshot { scene, setup, .. } = file.present;
    let marks = match file.marks.len() {
        0 => String::new(),
        count => format!(", {}", counted(count, "mark")),
    };
    let changes = counted(file.past.len(), "change");
    let changed = format!("{} {}", scene.name, difference(&Setup::of_scene(&scene), &setup));
    Ok(format!("{} ({changes}{marks})", changed.trim_end()))
}

/// Reads the file, if its format is known; its marks are examined where they are used. Fails with one line that says
/// what is wrong.
fn read(text: &str) -> Done<SavedSession> {
    #[derive(Deserialize)]
    struct Head {
        hopfscope: Option<u32>,
    }
    let refused = |mistake: FileMistake| format!("line {}: {}", mistake.line, mistake.message);
    let head: Head = placed::toml("", text).map_err(refused)?;
    match head.hopfscope {
        None => Err("not a saved session: it does not say hopfscope = 1".to_owned()),
        Some(version @ (0 | VERSION..)) if version != VERSION => {
            Err(format!("a session of format {version}; this program reads up to {VERSION}"))
        }
        Some(_) => {
            let file: SavedSession = placed::toml("", text).map_err(refused)?;
            file.present.check()?;
            check_number(&file.plots)?;
            file.past.iter().chain(&file.future).try_for_each(EarlierState::check)?;
            Ok(file)
        }
    }
}

impl Session {
    /// Whether the user made something whose loss would matter: a change, a mark.
    pub fn is_worth_keeping(&self) -> bool {
        self.history.depth() != (0, 0)
            || !self.marks.places.is_empty()
            || self.marks.pinned.is_some()
            || matches!(self.overlay, Some(Overlay::Prompt(Prompt { row: Some(_), .. })))
    }
}

/// The name under which a file embeds a session.
const CARRIED: &str = "start.toml";

/// The steps that lead to this session, which must have nothing open. Fails with one line if the session cannot
/// be saved; no such session is known.
pub fn opening(session: &Session) -> Done<Vec<Instruction>> {
    let mut steps = display_lines(session.display);
    let saved = text(session)?;
    let is_new = text(&Session::new(session.scene.clone(), session.size))? == saved;
    if let Some((lines, names)) = scene(&session.scene).filter(|_| is_new) {
        steps.extend(lines);
        steps.push(Instruction::Give(Msg::Start(names)));
    } else {
        steps.push(Instruction::File { name: CARRIED.to_owned(), text: saved });
        steps.push(run(format!("open {CARRIED}")));
        // The scene opens with these numbers, so they are no change; an earlier change can still be undone.
        steps.extend(is_new.then(|| Instruction::Give(Msg::Start(Vec::new()))));
    }
    Ok(steps)
}

/// The step that runs a line.
fn run(line: String) -> Instruction {
    Instruction::Give(Msg::Run(line))
}

/// The steps that set the user's wishes for the screen, where they differ from the defaults.
fn display_lines(display: DisplaySettings) -> Vec<Instruction> {
    fn line<T: NamedValue + Default>(name: &str, value: T) -> Option<String> {
        (value != T::default()).then(|| format!("{name} {}", value.into()))
    }
    let switched = |on: bool, line: &str| on.then(|| line.to_owned());
    let lines = [
        line("glyphs", display.glyphs),
        line("color", display.colors),
        line("theme", display.theme),
        switched(display.stretched, "equal off"),
        switched(display.dimensionless, "units off"),
        switched(display.mouse, "mouse"),
        switched(display.lecture, "lecture"),
    ];
    lines.into_iter().flatten().map(run).collect()
}

/// The lines that open a built-in scene with other numbers, and the parameters that were added to its terms;
/// `None` for any other scene.
fn scene(scene: &Scene) -> Option<(Vec<Instruction>, Vec<Knob>)> {
    let known = find(&scene.name).ok()?;
    let mut with_numbers = Scene::clone(&known);
    with_numbers.problem = scene.problem;
    with_numbers.terms.extend(&scene.terms);
    if with_numbers != *scene {
        return None;
    }
    let names = scene.terms.difference(&known.terms).copied().collect();
    let (from, to) = (known.problem, scene.problem);
    let accuracy = [Knob::Until, Knob::Tolerance, Knob::Step, Knob::Epsilon];
    let numbers = Knob::MOTION.into_iter().chain(accuracy);
    let given = numbers.filter(|knob| from.get(*knob) != to.get(*knob));
    let words = given.map(|knob| format!("{knob}={}", shortest(to.get(knob))));
    // Last, because the tolerance is the number that sets the accuracy of the method.
    let method = (from.method != to.method).then(|| format!("method={}", to.method));
    let words: Vec<String> = words.chain(method).collect();
    let set = (!words.is_empty()).then(|| run(format!("set {}", words.join(" "))));
    let lines = std::iter::once(run(format!("scene {}", scene.name))).chain(set);
    Some((lines.collect(), names))
}
