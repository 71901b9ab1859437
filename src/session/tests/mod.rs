//! The effect of keys on a session: the keys are read by the program's own parser, and the questions are
//! answered with made-up answers.

mod axes;
mod belt;
mod compare;
mod dependence;
mod dial;
mod screen_setup;

mod entries;
mod facts;
mod help;
mod kick;
mod kicks;
mod language;
mod motions;
mod names;
mod plots;
mod recorded;
mod requests;
mod saved;
mod scan;
mod strange;
mod undo;
mod views;
mod waiting;
mod walk;

use std::sync::Arc;

use super::replay::{Action, Player, parse};
use super::{Effect, List, Msg, Overlay, Session, Size, update};
use crate::accuracy::{Deviation, HarmonicBalance, Reference, ReferenceSource, Trade, TradePoint};
use crate::branch::{Branch, BranchPoint, Chart, MachineBranch, Special, SpecialKind};
use crate::flow::{Cost, Limits, Method, Motion, Outcome, Problem, Reason, Sample};
use crate::model::{Ledger, Parameters, State};
use crate::numerics::{Twofold, ln};
use crate::portrait::{Cycle, Drawing, Margin, Portrait, ReturnMap, Share};
use crate::proof::{ParameterBox, Proof};
use crate::question::{CertainZones, Extent, Rows};
use crate::scan::{LevelCurve, LevelEnd, Levels};
use crate::scene::{Finding, Fit, Request, Scene, Topic, find};

/// A session whose questions are answered as soon as they are asked.
struct Trial {
    session: Session,
    /// The questions since the last keys.
    asked: Vec<Request>,
    /// The effects so far.
    effects: Vec<Effect>,
}

/// Number of evaluations that each made-up answer claims.
const COST: u64 = 100;

/// The list that is open.
fn open_list(session: &Session) -> Option<&List> {
    if let Some(Overlay::List(_, list)) = &session.overlay {
        Some(list)
    } else {
        None
    }
}

impl Trial {
    /// A session that has just opened a scene and shows it.
    fn open(scene: &str) -> Self {
        Trial::of(find(scene).unwrap())
    }

    /// Opens a scene without its variants, so that its plots show only the present values.
    fn alone(scene: &str) -> Self {
        let mut scene = find(scene).unwrap();
        let alone = Arc::make_mut(&mut scene);
        alone.families.clear();
        alone.plots.iter_mut().for_each(|plot| plot.family = None);
        Trial::of(scene)
    }

    fn of(scene: Arc<Scene>) -> Self {
        let session = Session::new(scene, Size { width: 80, height: 24 });
        let mut trial = Trial { session, asked: Vec::new(), effects: Vec::new() };
        trial.settle();
        trial
    }

    /// Gives a message and answers the resulting questions.
    fn give(&mut self, message: Msg) {
        let effects = update(&mut self.session, message);
        self.effects.extend(effects);
        self.settle();
    }

    /// Presses keys; returns the topics that had to be computed. Proofs are left out: they follow the cycles,
    /// and nothing waits for them.
    fn press(&mut self, keys: &str) -> Vec<Topic> {
        self.asked.clear();
        let mut player = Player::new(parse(keys).unwrap_or_else(|error| panic!("{keys}: {error}")));
        while let Action::Give(message) = player.next(true, String::new).unwrap() {
            let before = self.effects.len();
            self.give(message);
            for effect in &self.effects[before..] {
                if let Effect::Play(script) = effect {
                    player.interject(script.clone()).unwrap();
                }
            }
            self.reads(before, Some(&player));
        }
        self.asked.iter().map(Request::topic).filter(|topic| *topic != Topic::Proof).collect()
    }

    /// Reads the files that were asked for since the effect with this index, from the texts embedded in the
    /// played file.
    fn reads(&mut self, since: usize, player: Option<&Player>) {
        let effects = self.effects.split_off(since);
        self.effects.extend(effects.iter().cloned());
        for effect in effects {
            if let Effect::Read { path, purpose } = effect
                && let Some(text) = player.and_then(|player| player.file(&path))
            {
                let result = Ok(text.to_owned());
                self.give(Msg::Read { path, purpose, result });
            }
        }
    }

    fn settle(&mut self) {
        super::settle(&mut self.session, |_, request| {
            self.asked.push(request.clone());
            Some(answered(request.clone()))
        });
        assert!(!self.session.is_busy(), "answers make the session ask again and again");
    }

    /// The questions that are asked and not answered.
    fn open_questions(&self) -> Vec<Request> {
        let mut open: Vec<Request> = self.session.wants();
        open.retain(|request| self.session.is_open(request));
        open
    }

    /// The first branch of a diagram.
    fn branch(&self, plot: usize) -> &Branch {
        self.session.branches(plot)[0].1
    }

    /// Why the typed text was refused.
    fn refused(&self) -> String {
        let refused = match &self.session.overlay {
            Some(Overlay::Prompt(prompt)) => &prompt.refused,
            other => panic!("it is taken: {other:?}"),
        };
        refused.clone().unwrap_or_default()
    }

    /// The notice to the user.
    fn notice(&self) -> &str {
        self.session.notice.as_ref().map_or("", |notice| &notice.text)
    }
}

/// That of an oscillator of which the made-up answers say something else, at this cost.
fn portrait(cost: Cost) -> Box<Portrait> {
    let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
    let found = Portrait::of_oscillator(&parameters, 3.0, &Limits::PATIENT);
    let mut portrait = Box::new(found.expect("it has one"));
    portrait.cost = cost;
    portrait
}

/// An unstable cycle at `r + 1`, or a stable one at `r + 3`.
fn cycle(stable: bool, r: f64) -> Cycle {
    let clearance = if stable { 3.0 } else { 1.0 };
    let q = r + clearance;
    Cycle {
        stable,
        q_min: -q,
        q_max: q,
        v_min: -q,
        v_max: q,
        period: 6.0,
        multiplier: Some(if stable { 0.5 } else { 2.0 }),
        log_multiplier: if stable { ln(0.5) } else { ln(2.0) },
        clearance,
        log_clearance: ln(clearance),
        error: Some(0.0),
        ..Cycle::default()
    }
}

/// Two methods, the second more accurate and more expensive.
fn trade(cost: Cost) -> Trade {
    let problem = Problem::default();
    let row = |method, tolerance, evaluations, error| TradePoint {
        problem: Problem { method, tolerance, ..problem },
        method,
        outcome: Outcome::Moving { tau: problem.until, q: 0.0, v: 0.0 },
        deviation: Ok(Deviation { error, time: 0.0, agrees: true }),
        turns: 3,
        cost: Cost { evaluations, ..cost },
        seconds: 0.0,
    };
    let zero = Twofold::from(0.0);
    let reference = Reference {
        turns: Vec::new(),
        end: Outcome::Moving { tau: zero, q: zero, v: zero },
        source: ReferenceSource::TwicePrecision,
        error: 1e-30,
        scale: 1.0,
        cost,
    };
    let rows =
        vec![row(Method::Taylor, 1e-4, 100, 1e-5), row(Method::Dop853, 1e-12, 10_000, 1e-13)];
    Trade { problem, reference, rows }
}

/// Made-up zones: a nominal margin, and half of it as the guaranteed one.
fn zones() -> CertainZones {
    let margin =
        |part: f64| Margin { displacement: Some(part), impulse: Some(part), ..Margin::ENDLESS };
    CertainZones {
        safe: Extent::Within(Vec::new()),
        hopeful: Extent::Everything,
        nominal: margin(0.5),
        guaranteed: Ok(margin(0.25)),
        cost: Cost { evaluations: COST, steps: 1, rejected: 0 },
    }
}

/// A request with its made-up answer.
fn answered(request: Request) -> Msg {
    let result = Ok(by_hand(&request));
    Msg::answered(request, result, 0.001)
}

/// A made-up answer: a motion that stays at its start, two cycles, and one fold.
pub fn by_hand(request: &Request) -> Finding {
    let cost = Cost { evaluations: COST, steps: 1, rejected: 0 };
    match request {
        Request::Trajectory { problem, .. } => {
            let Problem { initial: State { q, v }, until, .. } = *problem;
            Finding::Trajectory(Motion {
                problem: *problem,
                method: Method::Taylor,
                implicit_steps: 0,
                outcome: Outcome::Moving { tau: until, q, v },
                crossings: Vec::new(),
                legs: Vec::new(),
                extremes: None,
                ledger: None,
                samples: vec![Sample { tau: 0.0, q, v }],
                cost,
            })
        }
        Request::Cycles { parameters, .. } => Finding::Cycles(
            Drawing {
                parameters: *parameters,
                cycles: vec![cycle(false, parameters.r), cycle(true, parameters.r)],
                curves: Vec::new(),
                works: vec![Ledger::of_terms(parameters, (0.0, 0.0), [1.0, 0.0, 0.0, -1.0]); 2],
                edge: Vec::new(),
                margin: Margin::ENDLESS,
                nearest: None,
                area: None,
                lyapunov_share: None,
                portrait: portrait(cost),
            },
            None,
        ),
        Request::Trade(_) => Finding::Trade(Box::new(trade(cost))),
        // There is no reference for made-up answers.
        Request::Reference(_) => Finding::Reference(Err(Reason::OutOfRange)),
        Request::Zones { .. } => Finding::Zones(zones()),
        Request::Kicks { .. } => {
            let share = Share { part: 0.125, error: 1e-11 };
            Finding::Kicks(share, cost)
        }
        Request::Capture { .. } => Finding::Capture(Vec::new(), cost),
        Request::Balance { parameters, harmonics } => Finding::Balance(HarmonicBalance {
            parameters: *parameters,
            harmonics: *harmonics,
            balanced: Vec::new(),
            unknown: None,
            cost,
        }),
        Request::ReturnMap { parameters, .. } => Finding::ReturnMap(ReturnMap {
            parameters: *parameters,
            sides: [Vec::new(), Vec::new()],
            cost,
        }),
        Request::Proof { parameters } => Finding::Proof(Proof {
            parameters: ParameterBox::from(parameters),
            theorem: None,
            cycles: Vec::new(),
            open: Vec::new(),
            swings: 0,
        }),
        Request::Claims => Finding::Claims(Vec::new()),
        Request::Fit { recording } => {
            Finding::Fit(Fit::of(recording, &Limits::PATIENT, &|_| ()).expect("nobody interrupts"))
        }
        Request::Refit { fit, held, drawn } => {
            Finding::Refit(fit.held(*held, *drawn, &Limits::PATIENT).expect("nobody interrupts"))
        }
        Request::MachineBranch { .. } => {
            Finding::MachineBranch(MachineBranch { cost, ..MachineBranch::default() })
        }
        Request::Regimes { plane, .. } => {
            Finding::Regimes(Chart { plane: *plane, lines: Vec::new(), cost })
        }
        // From one corner of the ranges to the opposite one, of values below 1.
        Request::Level { scan, target } => {
            let [first, last] =
                [0.0, 1.0].map(|part| [0, 1].map(|axis| scan.over()[axis].at(part)));
            let middle = [0, 1].map(|axis| f64::midpoint(first[axis], last[axis]));
            let (points, ends) = (vec![first, middle, last], Some([LevelEnd::Edge; 2]));
            let mut curves = vec![LevelCurve { points, ends, step: 0.0 }];
            curves.retain(|_| target.value < 1.0);
            Finding::Level(Levels { curves, seen: Some([0.0, 1.0]), cost })
        }
        Request::Scan { scan, from } => {
            Finding::Scan(Rows { first: *from, rows: scan::rows(scan, *from..scan.points()) })
        }
        Request::Branch { parameter, range: (from, to), parameters, .. } => {
            let fold = Cycle { q_max: 1.5, log_multiplier: 0.0, ..cycle(false, parameters.r) };
            let point = |stable| BranchPoint { value: *from, cycle: cycle(stable, parameters.r) };
            Finding::Branch(Branch {
                parameter: *parameter,
                pieces: vec![vec![point(false), point(true)]],
                special: vec![Special::new(SpecialKind::Fold, *to, Some(fold))],
                vague: Vec::new(),
                cost,
            })
        }
    }
}
