//! Answers made by hand, so that pictures of them are always the same, and sessions that have them.

use hopfscope::accuracy::harmonic_error::HarmonicBalance;
use hopfscope::accuracy::trade::Trade;
use hopfscope::branch::chart::{Band, Chart, ChartLine, Plane};
use hopfscope::branch::machine::MachineBranch;
use hopfscope::branch::regime::Regime;
use hopfscope::branch::{Branch, BranchPoint, Special, SpecialKind};
use hopfscope::flow::{Cost, Crossing, Limits, Motion, Outcome, Problem, Reason, Sample};
use hopfscope::model::{Knob, Ledger, Parameters, State};
use hopfscope::numerics::Interval;
use hopfscope::numerics::elementary::{cos, exp, ln, sin, sin_cos};
use hopfscope::portrait::basin::stability::Share;
use hopfscope::portrait::{Cycle, Drawing, Margin, Portrait, RestMargin, Return, ReturnMap};
use hopfscope::proof::cycles::ProvedCycle;
use hopfscope::proof::{ParameterBox, Proof};
use hopfscope::question;
use hopfscope::question::Rows;
use hopfscope::question::zones::{CertainZones, Extent};
use hopfscope::scan::ScanRow;
use hopfscope::scan::measure::Value;
use hopfscope::scene::{Finding, Layer, Request, find};
use hopfscope::session::{Key, Msg, Session, Size, update};
use std::f64::consts::TAU;
use std::sync::LazyLock;

const CHEAP: Cost = Cost { evaluations: 100, steps: 1, rejected: 0 };

/// A scene whose questions are not answered yet.
pub fn open(scene: &str, width: u16, height: u16) -> Session {
    Session::new(find(scene).unwrap(), Size { width, height })
}

/// Answers every open question by hand, at a price that is always the same.
pub fn settle(session: &mut Session) {
    settle_with(session, by_hand);
}

/// The same with other answers.
pub fn settle_with(session: &mut Session, answer: impl Fn(&Request) -> Finding) {
    hopfscope::session::settle(session, |_, request| {
        Some(Msg::answered(request.clone(), Ok(answer(request)), 0.000_25))
    });
    update(session, Msg::Elapsed { seconds: 0.0 });
}

/// A decay with D = 0.02 and r = 0.05 at 10/s, without noise except for rounding to three decimals.
pub fn record() -> String {
    let (decay, mut text) = (exp(-std::f64::consts::PI * 0.02 / 0.9998), String::new());
    let (mut from, mut side, mut t) = (3.0_f64, 1.0, 0.0);
    let root = (1.0_f64 - 0.02 * 0.02).sqrt();
    while from > 0.05 {
        for step in 0..20 {
            let tau = std::f64::consts::PI / root * f64::from(step) / 20.0;
            let swing = exp(-0.02 * tau) * (cos(root * tau) + 0.02 / root * sin(root * tau));
            let x = side * ((from - 0.05) * swing + 0.05);
            text += &format!("{:.5},{x:.3}\n", (t + tau) / 10.0);
        }
        t += std::f64::consts::PI / root;
        (from, side) = ((from - 0.05) * decay - 0.05, -side);
    }
    format!("time [s],displacement [mm]\n{text}")
}

pub fn press(session: &mut Session, keys: &str) {
    for key in keys.split_whitespace() {
        update(session, Msg::Key(key.parse::<Key>().unwrap()));
        settle(session);
    }
}

/// Whether a layer belongs to single figures and would be drawn over the others.
pub fn drawn_over(layer: Layer) -> bool {
    matches!(
        layer,
        Layer::Extents | Layer::Levels | Layer::Spirals | Layer::Record | Layer::Recorded
    )
}

pub fn by_hand(request: &Request) -> Finding {
    match request {
        Request::Trajectory { problem, .. } => Finding::Trajectory(spiral(*problem)),
        Request::Cycles { parameters, .. } => {
            let cycles = vec![cycle(0.5, false), cycle(1.2, true)];
            let drawn = drawing(cycles, circle(0.5), vec![circle(0.5), circle(1.2)]);
            Finding::Cycles(Drawing { parameters: *parameters, ..drawn }, None)
        }
        Request::Scan { scan, from } => {
            let measured = scan.measured().len();
            let row = |index: usize| ScanRow {
                // A slope with a hole in it.
                values: (0..measured)
                    .map(|column| match index % 7 {
                        3 => Value::Nothing,
                        // Many digits, so that a cut shows.
                        _ => Value::Number(
                            0.010_030_5 * f64::from(u32::try_from(index * (column + 1)).unwrap()),
                        ),
                    })
                    .collect(),
                reason: (index == 17).then(|| "edge: budget of 40 evaluations spent".to_owned()),
                cost: Cost::default(),
            };
            let rows = (*from..scan.points()).map(row).collect();
            Finding::Scan(Rows { first: *from, rows })
        }
        Request::Zones { .. } => Finding::Zones(CertainZones {
            safe: Extent::Within(circle(0.4)),
            hopeful: Extent::Within(circle(0.6)),
            nominal: margin(0.5),
            guaranteed: Ok(margin(0.4)),
            cost: Cost { evaluations: 400, steps: 20, rejected: 0 },
        }),
        Request::Capture { .. } => Finding::Capture(
            vec![circle(0.2), circle(0.35)],
            Cost { evaluations: 800, steps: 40, rejected: 0 },
        ),
        Request::Branch { parameter, .. } => Finding::Branch(folded(*parameter)),
        Request::ReturnMap { parameters, .. } => Finding::ReturnMap(halving(*parameters)),
        Request::Regimes { plane, .. } => Finding::Regimes(parted(*plane)),
        // No screen asks for level curves.
        Request::Level { scan, target } => {
            Finding::Level(scan.curves(*target, 1e-2, &Limits::PATIENT).unwrap())
        }
        Request::Trade(_) => Finding::Trade(compared()),
        // Of the cycles made up above.
        Request::Proof { parameters } => {
            let known = |low, high, stable| ProvedCycle {
                within: Interval::new(low, high),
                stable,
                enclosure: None,
            };
            Finding::Proof(Proof {
                parameters: ParameterBox::from(parameters),
                theorem: None,
                cycles: vec![known(0.3, 0.5, false), known(1.0, 1.2, true)],
                open: Vec::new(),
                swings: 0,
            })
        }
        // Of these the pictures show little more than that they were answered.
        Request::Kicks { .. } => {
            let share = Share { part: 0.125, error: 1e-11 };
            Finding::Kicks(share, CHEAP)
        }
        Request::Balance { parameters, harmonics } => Finding::Balance(HarmonicBalance {
            parameters: *parameters,
            harmonics: *harmonics,
            balanced: Vec::new(),
            unknown: None,
            cost: CHEAP,
        }),
        Request::MachineBranch { .. } => {
            Finding::MachineBranch(MachineBranch { cost: CHEAP, ..MachineBranch::default() })
        }
        Request::Claims => Finding::Claims(Vec::new()),
        // There is no reference for made-up answers.
        Request::Reference(_) => Finding::Reference(Err(Reason::OutOfRange)),
        Request::Fit { .. } | Request::Refit { .. } => {
            question::answer(request, &Limits::PATIENT).expect("records can be fitted")
        }
    }
}

/// The margin of a basin whose border is a circle, for r = 0.1.
fn margin(radius: f64) -> Margin {
    let impulse = Some((radius * radius - 0.1 * 0.1).sqrt());
    let from_rest = RestMargin { displacement: Some(radius - 0.1), impulse };
    Margin { displacement: Some(radius), impulse: Some(radius), from_rest }
}

/// A basin bordered by a cycle, with these cycles and their curves.
pub fn drawing(cycles: Vec<Cycle>, edge: Vec<State>, curves: Vec<Vec<State>>) -> Drawing {
    let margin = margin(0.5);
    let symmetric = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
    let works = Ledger::of_terms(&symmetric, (0.72, 0.72), [2.5, 0.25, -2.0, -0.75]);
    let works = vec![Ledger { residual: 3e-15, ..works }; curves.len()];
    let mut portrait = Portrait::of_oscillator(&symmetric, 3.0, &Limits::PATIENT).unwrap();
    portrait.cost = Cost { evaluations: 1_200, steps: 60, rejected: 0 };
    Drawing {
        parameters: symmetric,
        cycles,
        curves,
        works,
        edge,
        margin,
        nearest: margin.from_rest.impulse.map(|v| State { q: 0.1, v }),
        area: Some(0.8),
        lyapunov_share: Some(0.3),
        portrait: Box::new(portrait),
    }
}

/// A motion that winds inwards and comes to rest after three half swings.
pub fn spiral(problem: Problem) -> Motion {
    let State { q, .. } = problem.initial;
    let sample = |index: u16| {
        let tau = 9.47 * f64::from(index) / 300.0;
        let radius = q * (1.0 - tau / 10.0);
        Sample { tau, q: radius * cos(tau), v: -radius * sin(tau) }
    };
    let ledger = Ledger::of_terms(&problem.parameters, (0.5, 0.0), [0.0; 4]);
    let ledger = Ledger { residual: 2e-14, ..ledger };
    Motion {
        problem,
        method: problem.method,
        implicit_steps: 0,
        outcome: Outcome::Captured { tau: 9.47, q: -0.053 },
        crossings: [3.1, 6.3, 9.47].map(|tau| Crossing { tau, q: 0.1 }).to_vec(),
        legs: Vec::new(),
        extremes: None,
        ledger: Some(ledger),
        samples: (0..=300).map(sample).collect(),
        cost: Cost { evaluations: 432, steps: 18, rejected: 0 },
    }
}

pub fn circle(radius: f64) -> Vec<State> {
    let corner = |index: u8| sin_cos(TAU * f64::from(index) / 120.0);
    (0..=120).map(corner).map(|(sin, cos)| State { q: radius * cos, v: -radius * sin }).collect()
}

pub fn cycle(radius: f64, stable: bool) -> Cycle {
    Cycle {
        stable,
        q_min: -radius,
        q_max: radius,
        v_min: -radius,
        v_max: radius,
        period: 6.3,
        multiplier: (!stable).then_some(3.8),
        log_multiplier: if stable { -710.0 } else { ln(3.8) },
        clearance: radius - 0.1,
        log_clearance: ln(radius - 0.1),
        error: Some(1e-14),
        ..Cycle::default()
    }
}

/// A map on which every turning point on the right comes to half of it, or from far out to twice it.
pub fn halving(parameters: Parameters) -> ReturnMap {
    let turn = |index: u8| {
        let from = 0.02 * f64::from(index);
        Return { from, to: Some(if from < 1.0 { 0.5 * from } else { 2.0 * from - 1.5 }) }
    };
    ReturnMap {
        parameters,
        sides: [Vec::new(), (5..=100).map(turn).collect()],
        cost: Cost { evaluations: 900, steps: 30, rejected: 0 },
    }
}

/// A chart whose lines are parted by a border that moves to the left.
pub fn parted(plane: Plane) -> Chart {
    let line = |index: u8| {
        let part = f64::from(index) / 20.0;
        let (from, to) = plane.right_range;
        let fold = -0.4 * part;
        let band = |from, to, regime| Band { from, to, regime: Some(regime) };
        let bands = vec![band(from, fold, Regime::Coexisting), band(fold, to, Regime::Global)];
        let at = plane.up_range.0 + part * (plane.up_range.1 - plane.up_range.0);
        let harmonic = Some(0.9 * fold);
        ChartLine { at, bands, fold: Some(fold), harmonic, escape: None, failure: None }
    };
    let cost = Cost { evaluations: 9_000, steps: 300, rejected: 0 };
    Chart { plane, lines: (0..=20).map(line).collect(), cost }
}

/// What accuracy costs on a short motion, computed once and for all.
pub fn compared() -> Box<Trade> {
    static FOUND: LazyLock<Box<Trade>> = LazyLock::new(|| {
        let parameters = Parameters { d: -0.1, d2: 0.0, d3: 0.05, r: 0.1 };
        let problem = Problem { parameters, until: 20.0, ..Problem::default() };
        let limits = Limits { evaluations: 50_000, ..Limits::PATIENT };
        Box::new(Trade::of(None, &problem, &limits).unwrap())
    });
    FOUND.clone()
}

/// A branch that turns back at a fold.
pub fn folded(parameter: Knob) -> Branch {
    let point = |index: u16| {
        let q_max = 0.05 + f64::from(index) * 0.02;
        BranchPoint {
            value: -0.05 / q_max - 0.15 * q_max * q_max,
            cycle: cycle(q_max, q_max > 0.55),
        }
    };
    let fold = Special::new(SpecialKind::Fold, -0.136_2, Some(cycle(0.55, false)));
    let escape = Special::new(SpecialKind::Escape, 0.05, None);
    Branch {
        parameter,
        pieces: vec![(0..120).map(point).collect()],
        special: vec![fold, escape],
        vague: Vec::new(),
        cost: Cost { evaluations: 56_000, steps: 900, rejected: 3 },
    }
}
