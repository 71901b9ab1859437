//! One motion: its turning points, how it ends, and where its energy goes.

use super::certified::{PointBounds, followed, motion_line, point_columns};
use super::table::digits;
use super::{About, Answer, Columns, Document, Quantity};
use crate::flow::machine::motion::{Leg, turns};
use crate::flow::machine::turn::ContactState;
use crate::flow::{Crossing, Fate, MachineLedger, MachineMotion, Outcome, Problem, Trajectory};
use crate::model::{MachineProblem, State};
use crate::numerics::Interval;
use crate::proof::motion::ProvedMotion;
use crate::words::duration;
use crate::words::motion::{Writing, sentence};
use crate::words::number::exact;

/// A point of a motion: its start, every arrival at `v = 0`, or its end.
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
fn point_of_motion<'a>(about: &About) -> Columns<'a, MotionRow> {
    let [time, length, speed] = ["s", "m", "m/s"].map(|unit| about.quantity(unit, 10));
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
    about: &'a About,
    motion: &'a Trajectory,
    certified: Option<&'a ProvedMotion>,
    seconds: f64,
) -> Answer<'a> {
    let problem = &motion.problem;
    let document = move || {
        Document::default()
            .with("initial", problem.initial)
            .with("method", motion.method)
            .with("tolerance", problem.tolerance)
            .with("outcome", motion.outcome)
            .with("events", &motion.crossings)
            .with("energy", motion.ledger)
            .with_any("certified", certified.map(|certified| followed(certified, problem.until)))
    };
    let csv = move || {
        let proved =
            Columns::default().part("certified", point_columns(), |row: &MotionRow| row.bounds);
        point_of_motion(about).and(certified.map(|_| proved)).csv(points(motion, certified))
    };
    let line = move || certified.map(|it| motion_line(it, problem.until)).unwrap_or_default();
    let json = move || about.json(&document(), &motion.cost, seconds);
    Answer::new(json, csv, move || text(about, motion, seconds)).below(line)
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

/// The parameters and the start of a motion.
pub(super) fn question(about: &About, problem: &Problem) -> String {
    let State { q, v } = problem.initial;
    format!("{}; from q = {}, v = {}", about.heading(&[]), exact(q, 24), exact(v, 24))
}

/// The problem, every turning point, the outcome, the energy balance and the cost.
fn text(about: &About, motion: &Trajectory, seconds: f64) -> String {
    let problem = &motion.problem;
    let number = Quantity::pure(digits(problem.tolerance));
    let turns = Columns::default()
        .text("half swing", |(count, _): &(usize, &Crossing)| count.to_string())
        .number("tau", number, |(_, crossing)| crossing.tau)
        .number("q", number, |(_, crossing)| crossing.q)
        .table((1..).zip(&motion.crossings));
    let told = sentence(motion, Writing::default());
    let mut out = format!("{}\n{told}\n\n", question(about, problem));
    if !turns.is_empty() {
        out += &format!("{turns}\n");
    }
    if let Some(energy) = &motion.ledger {
        let amounts = [
            ("at the start", energy.start),
            ("from linear damping", energy.linear),
            ("from quadratic damping", energy.quadratic),
            ("from cubic damping", energy.cubic),
            ("from friction", energy.friction),
            ("at the end", energy.end),
            ("unaccounted for", energy.residual),
        ];
        let ledger = Columns::default()
            .text("energy", |(name, _): &(&str, f64)| (*name).to_owned())
            .number("amount", Quantity::pure(6), |(_, amount)| *amount)
            .table(amounts);
        out += &format!("{ledger}\n");
    }
    let cost = motion.cost;
    out + &format!(
        "method {}, tolerance {}: {} evaluations, {} steps, {} rejected, {}\n",
        motion.method,
        exact(problem.tolerance, 24),
        cost.evaluations,
        cost.steps,
        cost.rejected,
        duration(seconds),
    )
}

/// A motion of a machine: every standstill, how it ends, where it rides on the belt, and where its energy goes.
pub fn of_machine<'a>(
    about: &'a About,
    MachineProblem { start: (q, v), .. }: &'a MachineProblem,
    found: &'a MachineMotion,
    seconds: f64,
) -> Answer<'a> {
    let MachineMotion { legs, end, outcome, .. } = found;
    let kind = outcome.word();
    let reason = if let Fate::Unknown(why) = outcome { Some(why.to_string()) } else { None };
    let points = move || {
        let start = MotionRow::new("start", 0.0, *q, *v);
        let turned = turns(legs).map(|leg| MotionRow::new("turn", leg.t, leg.x, 0.0));
        let points = std::iter::once(start).chain(turned);
        points.chain([MotionRow::new(kind, end.t, end.x, end.v)])
    };
    let told = reason.clone();
    let document = move || {
        let place = |q: f64, v: f64| Document::default().with("q", q).with("v", v);
        let known = matches!(kind, "captured" | "moving").then(|| place(end.x, end.v));
        let outcome = Document::default().with("kind", kind).with("tau", end.t);
        let events = turns(legs).map(|leg| Document::default().with("tau", leg.t).with("q", leg.x));
        Document::default()
            .with("initial", place(*q, *v))
            .with("method", found.method)
            .with("tolerance", found.tolerance)
            .with("outcome", known.iter().fold(outcome, Document::and).with_any("reason", told))
            .with("events", events.collect::<Vec<_>>())
            .with("phases", phases(legs, ["tau", "q"]))
            .with("energy", found.ledger.as_ref().map(energy))
            .with("evaluations", found.cost.evaluations)
    };
    let csv = move || point_of_motion(about).csv(points());
    about.answer(found.cost, seconds, document, csv, move || {
        let table = point_of_motion(about).table(points()).aligned_left();
        let reason = reason.map(|why| format!("{why}\n")).unwrap_or_default();
        format!("{}\n\n{table}\n{reason}", about.heading(&[]))
    })
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
