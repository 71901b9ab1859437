//! The whole state of a session, in one struct, and the small parts of it that have no file of their own.
//!
//! Nothing here computes or draws a motion. [`Session::wants`] returns, as a pure function of the state, the
//! questions whose answers are needed for what is on show; the outer rings ask them (see
//! `session::read::wants`).

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::branch::{BranchPoint, Special, SpecialKind};
use crate::flow::{Cost, Problem};
use crate::model::{Belt, Knob, State};
use crate::portrait::{Cycle, RandomKick};
use crate::scan::LevelTarget;
use crate::scene::{
    Arrangement, Axes, Layer, PlotSetup, Point, Request, ScaledMachine, Scene, Setting, Topic,
    View, Window,
};
use crate::session::{
    Answers, Bookmarks, Context, DisplaySettings, Effect, History, Key, Keymap, Msg, Notice,
    Overlay, Row, ScanOnShow, SessionCaption, Setup, StepSizes, Uncertainty,
};

/// Maximum number of harmonics: more would cost more than the picture can show.
pub const MOST_HARMONICS: usize = 63;

/// Initial number of harmonics: enough to show the gain over the paper's single one.
const HARMONICS: usize = 3;

/// A recomputation caused by a key press.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recomputation {
    pub topic: Topic,
    /// Counted cost.
    pub cost: Cost,
    /// Cost in wall-clock seconds.
    pub seconds: f64,
}

/// The cost of the last key press: only the recomputations that it caused.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Price {
    /// The key; `None` for the computations of the first picture.
    pub key: Option<Key>,
    /// The recomputations, in the order of their answers.
    pub recomputed: Vec<Recomputation>,
}

impl Price {
    /// Total number of evaluations of the field.
    pub fn evaluations(&self) -> u64 {
        self.recomputed.iter().map(|part| part.cost.evaluations).sum()
    }

    pub fn seconds(&self) -> f64 {
        self.recomputed.iter().map(|part| part.seconds).sum()
    }
}

/// The size of the screen, in cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Size {
    pub width: u16,
    pub height: u16,
}

/// Rows of a screen that has two status lines.
const DESIGNED: u16 = 20;

impl Size {
    /// Whether a screen has a second status line, which tells the margin.
    pub fn tells_margin(self) -> bool {
        self.height >= DESIGNED
    }
}

/// The complete state of a session; [`Session::new`] makes one that has the plots of a scene.
#[expect(
    clippy::struct_excessive_bools,
    reason = "what is on or off has nothing to do with each other"
)]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Session {
    /// The scene that was opened last.
    pub scene: Arc<Scene>,
    /// The present motion: parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Starts of the other motions on show, the oldest first.
    pub others: Vec<State>,
    /// The setting of the machine; `None` if the scene has no machine.
    pub setting: Option<Setting>,
    /// The machine of the scene with that setting.
    pub scaled: Option<Box<ScaledMachine>>,
    /// Half widths of the parameters, held numbers, and the disturbance.
    pub doubt: Uncertainty,
    /// Step sizes of the parameter pane.
    pub steps: StepSizes,
    /// The selected row of the parameter pane, always one of [`Session::rows`].
    pub selected: Row,
    /// Whether the pane also shows parameters that the scene does not declare.
    pub unfolded: bool,
    /// The pane that has the focus.
    pub focus: Pane,
    /// The plots, one to four, in the order in which they get the focus.
    pub plots: Vec<Plot>,
    /// Index of the plot that had the focus last; the only one on show if [`Session::enlarged`].
    pub plot: usize,
    /// Whether that plot takes the space of all.
    pub enlarged: bool,
    /// How the plots share the screen.
    pub arrangement: Arrangement,
    /// Playback of the motion.
    pub playback: Playback,
    /// Whether the arrows set the size of the kick by which the motion starts.
    pub kicking: bool,
    /// The point of the branch in focus at which a walk is held.
    pub held: Option<BranchStop>,
    /// Number N of harmonics in the layer `balance`.
    pub harmonics: usize,
    /// Random kicks in the layer `kicks`.
    pub kicks: RandomKick,
    pub layers: BTreeSet<Layer>,
    /// The level curves in charts and in scans over two numbers.
    pub levels: Vec<LevelTarget>,
    /// The overlay, which gets the keys.
    pub overlay: Option<Overlay>,
    /// The scene that is selected in the list of scenes, beside it.
    pub preview: Option<Box<Session>>,
    pub history: History,
    /// A count or a letter that the next key completes.
    pub pending: Option<PendingInput>,
    /// A press that waits for an answer.
    pub waiting: Option<WaitingPress>,
    /// Number of presses since nothing was open and nothing pending: they lead up to a command.
    pub chord: u32,
    /// Number of presses of the last such sequence that is complete.
    pub asked: u32,
    /// Points to come back to, and the point for comparison.
    pub marks: Bookmarks,
    /// The session at the point for comparison, if that is on show: it has the same plots and answers.
    pub other: Option<Box<Session>>,
    /// The caption above the status lines.
    pub caption: SessionCaption,
    /// The chapter of a tour or a lesson; empty where there is none.
    pub chapter: String,
    /// Interrupted sessions that can be continued, the most recent first.
    pub interrupted: Vec<KeptSession>,
    /// The file of the figure in progress.
    pub writing: Option<PathBuf>,
    /// Lines typed on the command line, the most recent last.
    pub lines: Vec<String>,
    /// Names of the commands of keys that were run, the most recent last.
    pub used: Vec<&'static str>,
    pub answers: Answers,
    /// The last scan, if any.
    pub scanned: Option<ScanOnShow>,
    /// Number of motions that a fit has computed so far.
    pub fitting: u64,
    /// Cost of the last key press.
    pub price: Price,
    /// Whether the last key changed the accuracy or the method; the error is then measured.
    pub measuring: bool,
    /// The notice to the user.
    pub notice: Option<Notice>,
    /// The bindings of keys to commands.
    pub keymap: Arc<Keymap>,
    /// How the user wants the screen to look.
    pub display: DisplaySettings,
    /// The size of the screen.
    pub size: Size,
    /// What the outer rings shall do after this message.
    pub effects: Vec<Effect>,
    /// Whether the user has quit.
    pub quit: bool,
}

impl Session {
    /// A session that has just opened a scene, with the default keys.
    pub fn new(scene: Arc<Scene>, size: Size) -> Self {
        let Setup { problem, others, setting, doubt } = Setup::of_scene(&scene);
        Session {
            problem,
            others,
            setting,
            scaled: scene.machine.clone(),
            doubt,
            steps: StepSizes::of_scene(&scene),
            plots: scene.plots.iter().map(Plot::opened).collect(),
            arrangement: scene.arrangement,
            harmonics: HARMONICS,
            layers: scene.layers.clone(),
            levels: scene.levels.clone(),
            playback: Playback::of_scene(&scene),
            size,
            scene,
            ..Session::default()
        }
    }

    /// The present value of a number.
    pub fn value(&self, knob: Knob) -> f64 {
        self.value_in(&self.setup(), knob)
    }

    /// The value of a number in a setup, 0 if there is none. One of the machine that is not set is that of its file;
    /// or, where others determine it, that of the present machine.
    pub fn value_in(&self, setup: &Setup, knob: Knob) -> f64 {
        let present = setup.setting == self.setting;
        let scaled = if present { &self.scaled } else { &self.scene.machine };
        let of_machine = || knob.of_belt(&scaled.as_ref()?.machine.belt);
        setup.get(knob).or_else(of_machine).unwrap_or(0.0)
    }

    /// The present setup: the motions on show, the setting of the machine, and what is not known exactly.
    pub fn setup(&self) -> Setup {
        let Session { problem, others, setting, doubt, .. } = self;
        let (others, setting) = (others.clone(), setting.clone());
        Setup { problem: *problem, others, setting, doubt: *doubt }
    }

    /// Whether there is such a number: one of a machine or its friction law is that of the scene's machine.
    pub fn has(&self, row: Row) -> bool {
        let of_belt = |knob: Knob| knob.of_belt(&self.scene.machine.as_ref()?.machine.belt);
        row.stepped().is_none_or(|knob| !knob.is_of_machine() || of_belt(knob).is_some())
    }

    /// The rows of the parameter pane: those that the scene declares and those that are not zero, and of a machine those
    /// that no others determine, in place of how a motion is computed unless that is changed; all rows if unfolded.
    pub fn rows(&self) -> Vec<Row> {
        let stands = |&row: &Row| match row {
            row if !self.has(row) => false,
            _ if self.unfolded => true,
            Row::Method | Row::Tolerance | Row::Number(Knob::Until) => {
                let asked = |it: &Problem| (it.until, it.method, it.setting());
                let as_opened = asked(&self.problem) == asked(&self.scene.problem);
                self.scene.machine.is_none() || self.selected == row || !as_opened
            }
            Row::Number(knob) if row.is_of_machine() => {
                self.setting.as_ref().is_some_and(|it| it.get(knob).is_some())
                    || self.scene.machine.as_ref().is_some_and(|it| is_told(&it.machine.belt, knob))
            }
            Row::Number(Knob::Disturbance) => {
                self.scene.recording.is_some() || self.asks_for_certainty()
            }
            Row::Number(knob) => self.scene.declares(knob) || self.value(knob) != 0.0,
        };
        Row::all().filter(stands).collect()
    }
}

/// Whether a number of a machine is told where not all are: those that are no coefficient of a damper, which stands beside D
/// and D3, and neither usual nor determined by others.
fn is_told(belt: &Belt, knob: Knob) -> bool {
    let determined = match knob {
        Knob::Damping | Knob::CubicDamping => return false,
        Knob::Friction => None,
        Knob::StaticCoefficient => belt.law.mu(0.0),
        Knob::StaticGuide => Some(belt.friction),
        _ => knob.spec().default,
    };
    knob.of_belt(belt) != determined
}

/// Largest count before a key.
pub const LARGEST_COUNT: u32 = 9999;

/// Input that the next key completes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PendingInput {
    /// The next key is another digit, or the key to press this many times. Zero means no digit yet.
    Count(u32),
    /// The next key is the letter of the mark to set.
    Mark,
    /// The next key is the letter of the mark to go to.
    GoTo,
}

impl PendingInput {
    /// The context of the next key.
    pub fn context(self) -> Context {
        match self {
            PendingInput::Count(_) => Context::Count,
            PendingInput::Mark | PendingInput::GoTo => Context::Letter,
        }
    }
}

/// The pace at which the motion is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// Seconds per period of the free oscillation.
    Period(f64),
    /// The real pace of the machine; only a scene of a machine has it.
    Real,
}

/// All paces other than that of a machine.
pub(crate) const PACES: [Pace; 4] =
    [Pace::Period(8.0), Pace::Period(4.0), Pace::Period(2.0), Pace::Period(1.0)];

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Playback {
    /// Dimensionless time of the head; `None` before the first playback.
    pub at: Option<f64>,
    /// Whether the head advances as time passes.
    pub playing: bool,
    pub pace: Pace,
}

impl Default for Playback {
    fn default() -> Self {
        Playback { at: None, playing: false, pace: PACES[1] }
    }
}

impl Playback {
    /// A scene that plays begins with its motion.
    fn of_scene(scene: &Scene) -> Self {
        let (at, playing) = (scene.plays.then_some(0.0), scene.plays);
        Playback { at, playing, ..Playback::default() }
    }
}

/// A session that was interrupted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KeptSession {
    pub path: PathBuf,
    /// How long ago it ended, in words.
    pub when: String,
    /// A summary of the session in one line.
    pub what: String,
}

/// A press that waits, and the request whose answer it needs.
#[derive(Clone, Debug, PartialEq)]
pub struct WaitingPress {
    pub message: Msg,
    /// The request that must be answered first.
    pub request: Request,
}

/// A point of a branch, or of a curve over two numbers, where a walk can stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchStop {
    /// Index of the variant whose branch this is, if a diagram shows several.
    pub variant: usize,
    /// Value of the branch's parameter, or of the number to the right.
    pub value: f64,
    /// Value of the number upwards, on a curve over two.
    pub up: Option<f64>,
    /// The cycle there; `None` where its amplitude is infinite.
    pub cycle: Option<Cycle>,
    /// The kind of special point, if it is one.
    pub special: Option<SpecialKind>,
}

impl BranchStop {
    pub fn on(variant: usize, point: &BranchPoint) -> Self {
        let (value, cycle) = (point.value, Some(point.cycle));
        BranchStop { variant, value, up: None, cycle, special: None }
    }

    /// A special point of the branch of a variant.
    pub fn at(variant: usize, point: &Special) -> Self {
        let (value, cycle, special) = (point.value, point.cycle, Some(point.kind));
        BranchStop { variant, value, up: None, cycle, special }
    }

    /// A point of a curve over two numbers.
    pub fn over([value, up]: [f64; 2]) -> Self {
        BranchStop { variant: 0, value, up: Some(up), cycle: None, special: None }
    }
}

/// A part of the screen that can have the focus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pane {
    /// The list of parameters, method and tolerance.
    #[default]
    Parameters,
    /// A plot, by its index among `Session::plots`.
    Plot(usize),
}

impl Pane {
    /// Its number in the order in which the panes get the focus: 0 for the parameters, then the plots.
    pub fn number(self) -> usize {
        if let Pane::Plot(index) = self { index + 1 } else { 0 }
    }

    /// The pane of a number.
    pub fn numbered(number: usize) -> Self {
        number.checked_sub(1).map_or(Pane::Parameters, Pane::Plot)
    }
}

/// How a plot's window was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Framing {
    Scene,
    /// Fitted to what is on show.
    Fitted,
    /// To be fitted as soon as what is on show is computed.
    Fitting,
    /// By the user, by zooming and panning.
    User,
}

/// A plot: its view, its window and its cursor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plot {
    pub view: View,
    /// Its axes, where the view leaves a choice.
    pub axes: Axes,
    /// The family of variants, by its index in the scene, that the plot shows in place of the present values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub family: Option<usize>,
    /// The part of the world on show.
    pub window: Window,
    /// How the window was chosen.
    pub framing: Framing,
    /// The cursor, in world coordinates.
    pub cursor: Option<Point>,
}

impl Plot {
    /// A plot as a scene sets it up.
    pub fn opened(plot_setup: &PlotSetup) -> Self {
        Plot {
            view: plot_setup.view,
            axes: plot_setup.axes,
            family: plot_setup.family,
            window: plot_setup.opening(),
            framing: plot_setup.window.map_or(Framing::Fitting, |_| Framing::Scene),
            cursor: None,
        }
    }

    /// Marks the plot as to be fitted, beginning from this window.
    pub fn fit_from(&mut self, window: Window) {
        (self.window, self.framing, self.cursor) = (window, Framing::Fitting, None);
    }
}
