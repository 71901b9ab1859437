//! One motion: its turning points, how it ends, and where its energy goes.

use super::certified::{PointBounds, followed, point_columns};
use super::table::digits;
use super::{About, Answer, Columns, Document, Quantity};
use crate::flow::{Crossing, Leg, Outcome, Problem, Sample, Trajectory};
use crate::model::{ContactState, Ledger, State, Work};
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

/// A motion: its start, every arrival at `v = 0` and its end, with what is proved of each; and where its energy goes.
pub fn motion<'a>(
    about: &About,
    motion: &'a Trajectory,
    certified: Option<&'a ProvedMotion>,
    seconds: f64,
) -> Answer<'a> {
    let problem = &motion.problem;
    let machine = about.is_machine();
    let proved =
        Columns::default().part("certified", point_columns(), |row: &MotionRow| row.bounds);
    let columns = columns_of_points(about, digits(problem.tolerance));
    let energy = motion.ledger.as_ref().map(|ledger| energy(ledger, machine));
    let amounts: Vec<_> = energy.iter().flat_map(Document::numbers).collect();
    let (steps, rejected) = (motion.cost.steps, motion.cost.rejected);
    let tolerance = exact(problem.tolerance, 24);
    let how = format!(
        "method {}, tolerance {tolerance}: {steps} steps, {rejected} rejected",
        motion.method
    );
    let (lead, how) = match motion.outcome {
        _ if !machine => (Some(sentence(motion, Writing::default())), Some(how)),
        Outcome::GaveUp { reason, .. } => (None, Some(reason.to_string())),
        _ => (None, None),
    };
    let outcome = Document::default().and(&motion.outcome);
    let rests = machine && matches!(motion.outcome, Outcome::Captured { .. });
    let answer = if machine { about.answer() } else { about.answer_to(&from(problem)) };
    answer
        .lines(lead)
        .with("initial", problem.initial)
        .with("method", motion.method)
        .with("tolerance", problem.tolerance)
        .with("outcome", outcome.with_any("v", rests.then_some(0.0)))
        .with("events", &motion.crossings)
        .with_any("phases", machine.then(|| phases(&motion.legs, ["tau", "q"])))
        .with("energy", energy)
        .with_any("evaluations", machine.then_some(motion.cost.evaluations))
        .with_any("certified", certified.map(|it| followed(it, problem.until)))
        .rows(columns.and(certified.map(|_| proved)), points(motion, certified, machine))
        .table(energy_columns(about.quantity("J", 6)), amounts)
        .lines(how)
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

/// The start of a motion, its turning points and its end, with what is proved of each. Of a machine it is also known how
/// far one was followed that escapes or is given up.
fn points(motion: &Trajectory, certified: Option<&ProvedMotion>, machine: bool) -> Vec<MotionRow> {
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
    let bounds = certified.map(|certified| PointBounds::of_end(certified, motion.problem.until).1);
    let Sample { tau, q, v } = motion.end();
    let (q, v) = motion.outcome.state().or(machine.then_some((q, v))).unzip();
    let end = MotionRow { what: motion.outcome.word(), tau, q, v, bounds };
    std::iter::once(start).chain(turns).chain([end]).collect()
}

/// The start of a motion.
pub(super) fn from(problem: &Problem) -> String {
    let State { q, v } = problem.initial;
    format!("; from q = {}, v = {}", exact(q, 24), exact(v, 24))
}

/// When and where the mass begins to slip, to stick or to rest, under these names.
pub(super) fn phases(legs: &[Leg], [time, place]: [&str; 2]) -> Vec<Document> {
    let phase = |leg: &Leg| {
        let phase = match leg.place {
            ContactState::Sticks => "stick",
            ContactState::Rests => "rest",
            ContactState::Slips(_) => "slip",
        };
        let Sample { tau, q, .. } = leg.start;
        Document::default().with(time, tau).with(place, q).with("phase", phase)
    };
    legs.iter().map(phase).collect()
}

/// The works along a motion. Those of the damper and of the guide of a machine are told as what they take, in J, and what
/// does not add up as a fraction of all.
pub(super) fn energy(ledger: &Ledger, machine: bool) -> Document {
    let ends = Document::default().with("start", ledger.start).with("end", ledger.end);
    let works = ledger.works.iter().fold(ends, |all, Work { source, amount, .. }| {
        let takes = matches!(*source, "damper" | "guide");
        all.with(source, if takes { -amount } else { *amount })
    });
    works.with("residual", if machine { ledger.imbalance() } else { ledger.residual })
}
