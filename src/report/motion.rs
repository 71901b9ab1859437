//! One motion: its turning points, how it ends, and where its energy goes.

use super::certified::{PointBounds, followed, point_columns};
use super::table::digits;
use super::{About, Answer, Columns, Document, Quantity};
use crate::flow::machine::motion::{Leg, turns};
use crate::flow::machine::turn::ContactState;
use crate::flow::{Crossing, Fate, MachineLedger, MachineMotion, Outcome, Problem, Trajectory};
use crate::model::{MachineProblem, State};
use crate::numerics::Interval;
use crate::proof::motion::ProvedMotion;
use crate::words::motion::{Writing, sentence};
use crate::words::number::exact;

/// A point of a motion: its start, every arrival at `v = 0`, or its end.
#[derive(Clone)]
struct MotionRow {
    what: &'static str,
    tau: f64,
    q: Option<f64>,
    v: Option<f64>,
    bounds: Option<PointBounds>,
}

impl MotionRow {
    fn new(what: &'static str, tau: f64, q: f64, v: f64) -> Self {
        MotionRow { what, tau, q: Some(q), v: Some(v), bounds: None }
    }
}

/// The columns of points.
fn columns_of_points<'a>(about: &About, digits: usize) -> Columns<'a, MotionRow> {
    let [time, length, speed] = ["s", "m", "m/s"].map(|unit| about.quantity(unit, digits));
    Columns::default()
        .word("what", |row: &MotionRow| row.what)
        .number("tau", time, |row| row.tau)
        .number("q", length, |row| row.q)
        .number("v", speed, |row| row.v)
}

/// How a motion ends, when, and the displacement and velocity there.
pub(super) fn ending(outcome: &Outcome) -> (&'static str, f64, Option<f64>, Option<f64>) {
    match *outcome {
        Outcome::Captured { tau, q } => ("captured", tau, Some(q), Some(0.0)),
        Outcome::Moving { tau, q, v } => ("moving", tau, Some(q), Some(v)),
        Outcome::Escaped { tau } => ("escaped", tau, None, None),
        Outcome::GaveUp { tau, .. } => ("gave-up", tau, None, None),
    }
}

/// The motion of the oscillator of the paper; one row for each of its points.
pub fn motion<'a>(
    about: &About,
    motion: &'a Trajectory,
    certified: Option<&'a ProvedMotion>,
    seconds: f64,
) -> Answer<'a> {
    let problem = &motion.problem;
    let proved =
        Columns::default().part("certified", point_columns(), |row: &MotionRow| row.bounds);
    let columns = columns_of_points(about, digits(problem.tolerance));
    let energy = motion.ledger.map(|ledger| Document::default().and(&ledger));
    let (steps, rejected) = (motion.cost.steps, motion.cost.rejected);
    about
        .answer_to(&from(problem))
        .lines([sentence(motion, Writing::default())])
        .fields(move |all| {
            all.with("initial", problem.initial)
                .with("method", motion.method)
                .with("tolerance", problem.tolerance)
                .with("outcome", motion.outcome)
                .with("events", &motion.crossings)
                .with("energy", motion.ledger)
                .with_any("certified", certified.map(|it| followed(it, problem.until)))
        })
        .rows(columns.and(certified.map(|_| proved)), points(motion, certified))
        .table(
            energy_columns(Quantity::pure(6)),
            energy.iter().flat_map(Document::numbers).collect::<Vec<_>>(),
        )
        .lines([format!(
            "method {}, tolerance {}: {steps} steps, {rejected} rejected",
            motion.method,
            exact(problem.tolerance, 24)
        )])
        .cost(motion.cost, seconds)
}

/// The columns of an energy ledger.
fn energy_columns<'a>(amount: Quantity) -> Columns<'a, (String, f64)> {
    Columns::default().text("energy", |(name, _): &(String, f64)| name.clone()).number(
        "amount",
        amount,
        |(_, amount)| *amount,
    )
}

/// The start of a motion, its turning points and its end, with what is proved of each.
fn points(motion: &Trajectory, certified: Option<&ProvedMotion>) -> Vec<MotionRow> {
    let State { q, v } = motion.problem.initial;
    let known = |tau, q, v| PointBounds::of(tau, q, Interval::point(v));
    let exactly = certified.map(|_| known(Interval::point(0.0), Interval::point(q), v));
    let start = MotionRow { bounds: exactly, ..MotionRow::new("start", 0.0, q, v) };
    let turn = |(index, crossing): (usize, &Crossing)| {
        let enclosed = certified.and_then(|certified| certified.turns.get(index));
        let bounds = enclosed.map(|turn| known(turn.tau, turn.q, 0.0));
        MotionRow { bounds, ..MotionRow::new("turn", crossing.tau, crossing.q, 0.0) }
    };
    let turns = motion.crossings.iter().enumerate().map(turn);
    let (what, tau, q, v) = ending(&motion.outcome);
    let bounds = certified.map(|certified| PointBounds::of_end(certified, motion.problem.until).1);
    let end = MotionRow { what, tau, q, v, bounds };
    std::iter::once(start).chain(turns).chain([end]).collect()
}

/// The start of a motion.
pub(super) fn from(problem: &Problem) -> String {
    let State { q, v } = problem.initial;
    format!("; from q = {}, v = {}", exact(q, 24), exact(v, 24))
}

/// A motion of a machine: every standstill, how it ends, where it rides on the belt, and where its energy goes.
pub fn of_machine<'a>(
    about: &About,
    MachineProblem { start: (q, v), .. }: &'a MachineProblem,
    found: &'a MachineMotion,
    seconds: f64,
) -> Answer<'a> {
    let MachineMotion { legs, end, outcome, .. } = found;
    let kind = outcome.word();
    let reason = if let Fate::Unknown(why) = outcome { Some(why.to_string()) } else { None };
    let turned = turns(legs).map(|leg| MotionRow::new("turn", leg.t, leg.x, 0.0));
    let points = std::iter::once(MotionRow::new("start", 0.0, *q, *v)).chain(turned);
    let points: Vec<_> = points.chain([MotionRow::new(kind, end.t, end.x, end.v)]).collect();
    let energy = found.ledger.as_ref().map(energy);
    let amounts: Vec<_> = energy.iter().flat_map(Document::numbers).collect();
    let told = reason.clone();
    about
        .answer()
        .fields(move |all| {
            let place = |q: f64, v: f64| Document::default().with("q", q).with("v", v);
            let known = matches!(kind, "captured" | "moving").then(|| place(end.x, end.v));
            let outcome = Document::default().with("kind", kind).with("tau", end.t);
            let event = |leg: &Leg| Document::default().with("tau", leg.t).with("q", leg.x);
            all.with("initial", place(*q, *v))
                .with("method", found.method)
                .with("tolerance", found.tolerance)
                .with("outcome", known.iter().fold(outcome, Document::and).with_any("reason", told))
                .with("events", turns(legs).map(event).collect::<Vec<_>>())
                .with("phases", phases(legs, ["tau", "q"]))
                .with("energy", energy)
                .with("evaluations", found.cost.evaluations)
        })
        .rows(columns_of_points(about, 10), points)
        .table(energy_columns(about.quantity("J", 6)), amounts)
        .lines(reason)
        .cost(found.cost, seconds)
}

/// When and where the mass begins to slip, to stick or to rest, under these names.
pub(super) fn phases(legs: &[Leg], [time, place]: [&str; 2]) -> Vec<Document> {
    let phase = |leg: &Leg| {
        let phase = match leg.place {
            ContactState::Sticks => "stick",
            ContactState::Rests => "rest",
            ContactState::Slips(_) => "slip",
        };
        Document::default().with(time, leg.t).with(place, leg.x).with("phase", phase)
    };
    legs.iter().map(phase).collect()
}

/// The works along a motion of a machine, in J.
pub(super) fn energy(ledger: &MachineLedger) -> Document {
    Document::default().and(ledger).with("residual", ledger.residual())
}
