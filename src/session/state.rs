//! The whole state of a session in one struct.
//!
//! Nothing here computes a motion or draws one. [`Session::wants`] says, as a pure function of the
//! state, which questions must be answered for what is on show; the outer rings ask them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::history::History;
use super::key::Key;
use super::keymap::Keymap;
use super::overlay::Overlay;
use super::settings::Look;
use super::step::StepSize;
use super::walk::Stop;
use crate::flow::{Cost, Problem, Trajectory};
use crate::oscillator::Symbol;
use crate::scene::answer::{Borders, Failure};
use crate::scene::{
    Answer, Answered, Layer, Ordinate, PANES, Pane, Point, Request, Scene, Slot, Span, Window,
};
use crate::study::harmonic_error::HarmonicBalance;
use crate::study::{Branch, Cycles};

/// A row of the parameter pane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Row {
    /// One of the six numbers that define a motion.
    Parameter(Symbol),
    /// Time at which the motion stops.
    Until,
    /// How to integrate.
    Method,
    /// Relative error of a step.
    Tolerance,
}

/// Every row, in the order in which they stand.
pub const ROWS: [Row; 9] = [
    Row::Parameter(Symbol::D),
    Row::Parameter(Symbol::D2),
    Row::Parameter(Symbol::D3),
    Row::Parameter(Symbol::R),
    Row::Parameter(Symbol::Q0),
    Row::Parameter(Symbol::V0),
    Row::Until,
    Row::Method,
    Row::Tolerance,
];

impl Row {
    /// The name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Row::Parameter(symbol) => symbol.spec().name,
            Row::Until => "until",
            Row::Method => "method",
            Row::Tolerance => "tolerance",
        }
    }
}

/// The step sizes of the six numbers and of the end time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Steps {
    /// Step of each parameter, in the order of the table.
    pub parameters: [StepSize; 6],
    /// Step of the end time.
    pub until: StepSize,
}

impl Steps {
    /// The step of a row; `None` where a step is no number (method) or a factor of ten (tolerance).
    #[must_use]
    pub fn of(&self, row: Row) -> Option<StepSize> {
        match row {
            Row::Parameter(symbol) => Some(self.parameters[symbol as usize]),
            Row::Until => Some(self.until),
            Row::Method | Row::Tolerance => None,
        }
    }

    /// The step of a row, to be changed.
    pub fn of_mut(&mut self, row: Row) -> Option<&mut StepSize> {
        match row {
            Row::Parameter(symbol) => Some(&mut self.parameters[symbol as usize]),
            Row::Until => Some(&mut self.until),
            Row::Method | Row::Tolerance => None,
        }
    }

    /// The steps with which a scene opens.
    #[must_use]
    pub fn of_scene(scene: &Scene) -> Self {
        let step = |symbol: Symbol| {
            StepSize::near(scene.steps.get(&symbol).copied().unwrap_or(symbol.spec().step))
        };
        Steps {
            parameters: [
                step(Symbol::D),
                step(Symbol::D2),
                step(Symbol::D3),
                step(Symbol::R),
                step(Symbol::Q0),
                step(Symbol::V0),
            ],
            until: StepSize::near(UNTIL_STEP),
        }
    }
}

/// Harmonics at first: what more than the paper's one buys can be seen.
const HARMONICS: usize = 3;

/// Bands of capture that are drawn at most: more would fill the plane.
const MOST_BANDS: usize = 24;

/// First step of the end time: somewhat more than one and a half periods.
const UNTIL_STEP: f64 = 10.0;

/// Who chose a plot's window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framing {
    /// The scene.
    Scene,
    /// It was fitted to what is on show.
    Fitted,
    /// It will be fitted as soon as what is on show is computed.
    Fitting,
    /// The user, by zooming and panning.
    User,
}

/// A plot: where one looks, and what one points at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plot {
    /// What part of the world is on show.
    pub window: Window,
    /// Who chose the window.
    pub framing: Framing,
    /// The cursor, in world coordinates.
    pub cursor: Option<Point>,
}

impl Plot {
    /// A plot without a cursor, in a scene that would show `scene`.
    #[must_use]
    pub fn new(window: Window, scene: Window) -> Self {
        let framing = if window == scene { Framing::Scene } else { Framing::User };
        Plot { window, framing, cursor: None }
    }
}

/// One recomputation that a key press caused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recomputed {
    /// What was recomputed.
    pub slot: Slot,
    /// What it cost, counted.
    pub cost: Cost,
    /// What it cost in wall-clock seconds.
    pub seconds: f64,
}

/// What the last key press cost: the recomputations that it caused and nothing else.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Price {
    /// The key; `None` for the computations of the first picture.
    pub key: Option<Key>,
    /// What was recomputed, in the order of the answers.
    pub recomputed: Vec<Recomputed>,
}

impl Price {
    /// Evaluations of the field in all.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.recomputed.iter().map(|part| part.cost.evaluations).sum()
    }

    /// Seconds in all.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.recomputed.iter().map(|part| part.seconds).sum()
    }
}

/// A line for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// Whether something was refused or failed.
    pub error: bool,
    /// The line.
    pub text: String,
}

/// The size of the screen, in cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Columns.
    pub width: u16,
    /// Rows.
    pub height: u16,
}

/// Everything that a session is.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// The scene that was opened last.
    pub scene: Arc<Scene>,
    /// The motion on show: parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Step sizes of the parameter pane.
    pub steps: Steps,
    /// The selected row of the parameter pane, always one of [`Session::rows`].
    pub selected: Row,
    /// Whether parameters stand in the pane that the scene does not declare.
    pub unfolded: bool,
    /// The pane that gets the keys.
    pub focus: Pane,
    /// The plot that had the focus last; the one on show when [`Session::enlarged`].
    pub plot: Pane,
    /// Whether that plot takes the other's place too.
    pub enlarged: bool,
    /// The phase plane: x is q, y is v.
    pub phase: Plot,
    /// The diagram: x is the value of [`Session::abscissa`], y is the [`Session::ordinate`].
    pub diagram: Plot,
    /// The parameter along the diagram's horizontal axis: D, D2, D3 or r.
    pub abscissa: Symbol,
    /// The property of the cycles along its vertical axis.
    pub ordinate: Ordinate,
    /// The point of the branch that is held, while the user walks along it.
    pub held: Option<Stop>,
    /// Number N of harmonics of the layer `balance`.
    pub harmonics: usize,
    /// The layers that are on.
    pub layers: BTreeSet<Layer>,
    /// What lies over the panes and gets the keys.
    pub overlay: Option<Overlay>,
    /// Undo and redo.
    pub history: History,
    /// The last good answer of each kind, with its question.
    pub answers: BTreeMap<Slot, Answered>,
    /// The last question of each kind that has no answer, and why.
    pub failures: BTreeMap<Slot, (Request, Failure)>,
    /// What the last key press cost.
    pub price: Price,
    /// A line for the user.
    pub notice: Option<Notice>,
    /// Which key means which command.
    pub keymap: Arc<Keymap>,
    /// What the user wishes of the screen.
    pub look: Look,
    /// The size of the screen.
    pub size: Size,
    /// Whether the user has left.
    pub quit: bool,
}

impl Session {
    /// A session that has just opened a scene.
    #[must_use]
    pub fn new(scene: Arc<Scene>, size: Size) -> Self {
        Session {
            problem: scene.problem,
            steps: Steps::of_scene(&scene),
            selected: ROWS[0],
            unfolded: false,
            focus: Pane::Parameters,
            plot: Pane::Phase,
            enlarged: false,
            phase: Plot::new(scene.phase, scene.phase),
            diagram: Plot::new(scene.diagram, scene.diagram),
            abscissa: scene.abscissa,
            ordinate: scene.ordinate,
            held: None,
            harmonics: HARMONICS,
            layers: scene.layers.clone(),
            overlay: None,
            history: History::default(),
            answers: BTreeMap::new(),
            failures: BTreeMap::new(),
            price: Price::default(),
            notice: None,
            keymap: Arc::new(Keymap::default()),
            look: Look::default(),
            size,
            quit: false,
            scene,
        }
    }

    /// The value of one of the six numbers.
    #[must_use]
    pub fn value(&self, symbol: Symbol) -> f64 {
        symbol.get(&self.problem.parameters, &self.problem.initial)
    }

    /// The rows of the parameter pane: what the scene declares, what is not zero, all when unfolded.
    #[must_use]
    pub fn rows(&self) -> Vec<Row> {
        let stands = |row: &Row| match *row {
            Row::Parameter(symbol) => {
                self.unfolded || self.scene.declares(symbol) || self.value(symbol) != 0.0
            }
            Row::Until | Row::Method | Row::Tolerance => true,
        };
        ROWS.into_iter().filter(stands).collect()
    }

    /// The panes on show.
    #[must_use]
    pub fn panes(&self) -> Vec<Pane> {
        let shown = |pane: &Pane| !self.enlarged || *pane == Pane::Parameters || *pane == self.plot;
        PANES.into_iter().filter(shown).collect()
    }

    /// Whether a layer is on and its pane on show.
    #[must_use]
    pub fn shows(&self, layer: Layer) -> bool {
        self.layers.contains(&layer) && self.panes().contains(&layer.spec().pane)
    }

    /// Why a layer that is on shows nothing, where that lies in the axes of the diagram.
    #[must_use]
    pub fn not_drawn(&self, layer: Layer) -> Option<&'static str> {
        let harmonic = matches!(layer, Layer::Harmonic | Layer::Asymptotes);
        (harmonic && self.ordinate.spec().harmonic.is_none())
            .then_some("not drawn: the harmonic answer has no multiplier")
    }

    /// The questions that what is on show needs answered, the most urgent first; nothing for a layer
    /// that is off.
    #[must_use]
    pub fn wants(&self) -> Vec<Request> {
        let needed: BTreeSet<Slot> = self
            .layers
            .iter()
            .filter(|layer| self.shows(**layer))
            .filter_map(|layer| layer.spec().needs)
            .collect();
        needed.into_iter().filter_map(|slot| self.request(slot)).collect()
    }

    /// The question of a kind, with exactly the inputs that its answer depends on.
    ///
    /// `None` where there is nothing to ask: no bands without friction, no branch where the window of the
    /// diagram lies outside the range of its parameter.
    #[must_use]
    pub fn request(&self, slot: Slot) -> Option<Request> {
        let Problem { parameters, tolerance, .. } = self.problem;
        Some(match slot {
            Slot::Trajectory => Request::Trajectory(self.problem),
            Slot::Cycles => Request::Cycles { parameters },
            Slot::Balance => Request::Balance { parameters, harmonics: self.harmonics },
            Slot::Capture if parameters.r == 0.0 => return None,
            Slot::Capture => {
                Request::Capture { parameters, reach: self.capture_reach(), most: MOST_BANDS }
            }
            Slot::Branch => {
                let mut others = parameters;
                self.abscissa.set(&mut others, &mut { self.problem.initial }, 0.0);
                let range = self.branch_range()?;
                Request::Branch {
                    parameters: others,
                    parameter: self.abscissa,
                    range: (range.from(), range.to()),
                    tolerance,
                }
            }
        })
    }

    /// How far out bands of capture can be seen, rounded up to a power of two: small changes of the
    /// window ask nothing new.
    fn capture_reach(&self) -> f64 {
        let Window { x, y } = self.phase.window;
        let farthest = |span: Span| span.from().abs().max(span.to().abs());
        farthest(x).hypot(farthest(y)).log2().ceil().exp2()
    }

    /// The part of the diagram's horizontal axis that its parameter can reach.
    fn branch_range(&self) -> Option<Span> {
        let spec = self.abscissa.spec();
        self.diagram.window.x.within(spec.min, spec.max)
    }

    /// Whether what is held of a kind is not the answer to today's question.
    #[must_use]
    pub fn is_stale(&self, slot: Slot) -> bool {
        self.answers.get(&slot).map(|held| &held.request) != self.request(slot).as_ref()
    }

    /// Whether a question has neither an answer nor a reason for having none.
    #[must_use]
    pub fn is_open(&self, request: &Request) -> bool {
        let slot = request.slot();
        let answered = self.answers.get(&slot).map(|held| &held.request);
        let failed = self.failures.get(&slot).map(|(request, _)| request);
        answered != Some(request) && failed != Some(request)
    }

    /// Whether something on show is still to be computed.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.wants().iter().any(|request| self.is_open(request))
    }

    /// Why today's question of a kind has no answer.
    #[must_use]
    pub fn failure(&self, slot: Slot) -> Option<&Failure> {
        let wanted = self.request(slot)?;
        self.failures.get(&slot).filter(|(request, _)| *request == wanted).map(|(_, why)| why)
    }

    /// The last motion computed, stale or not.
    #[must_use]
    pub fn trajectory(&self) -> Option<&Trajectory> {
        match self.answers.get(&Slot::Trajectory).map(|held| &held.result) {
            Some(Ok(Answer::Trajectory(found))) => Some(found),
            _ => None,
        }
    }

    /// The last cycles computed, stale or not.
    #[must_use]
    pub fn cycles(&self) -> Option<&Cycles> {
        match self.answers.get(&Slot::Cycles).map(|held| &held.result) {
            Some(Ok(Answer::Cycles(found))) => Some(found),
            _ => None,
        }
    }

    /// The last borders of capture bands computed, stale or not.
    #[must_use]
    pub fn borders(&self) -> Option<&Borders> {
        match self.answers.get(&Slot::Capture).map(|held| &held.result) {
            Some(Ok(Answer::Capture(found))) => Some(found),
            _ => None,
        }
    }

    /// The last harmonic balance computed, stale or not.
    #[must_use]
    pub fn balance(&self) -> Option<&HarmonicBalance> {
        match self.answers.get(&Slot::Balance).map(|held| &held.result) {
            Some(Ok(Answer::Balance(found))) => Some(found),
            _ => None,
        }
    }

    /// The last branch computed over the parameter of the diagram, stale or not.
    #[must_use]
    pub fn branch(&self) -> Option<&Branch> {
        match self.answers.get(&Slot::Branch).map(|held| &held.result) {
            Some(Ok(Answer::Branch(found))) if found.parameter == self.abscissa => Some(found),
            _ => None,
        }
    }
}
