//! A motion.

use super::certified::{PointBounds, followed, point_columns};
use super::columns::{Columns, Quantity};
use super::json::Document;
use super::table::{digits, motion as question};
use crate::flow::{Crossing, Outcome, Trajectory};
use crate::model::State;
use crate::numerics::Interval;
use crate::proof::motion::ProvedMotion;
use crate::words::motion::{Writing, sentence};
use crate::words::number::{duration, exact};

pub fn json(motion: &Trajectory, certified: Option<&ProvedMotion>, seconds: f64) -> String {
    let problem = &motion.problem;
    Document::default()
        .with("parameters", problem.parameters)
        .with("initial", problem.initial)
        .with("method", motion.method)
        .with("tolerance", problem.tolerance)
        .with("outcome", motion.outcome)
        .with("events", &motion.crossings)
        .with("energy", motion.ledger)
        .with_any("certified", certified.map(|certified| followed(certified, problem.until)))
        .cost(&motion.cost, seconds)
        .text()
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

/// A point of a motion: its start, every arrival at `v = 0`, or its end.
struct MotionPoint {
    what: &'static str,
    tau: f64,
    q: Option<f64>,
    v: Option<f64>,
    bounds: Option<PointBounds>,
}

/// One row for each point.
pub fn csv(motion: &Trajectory, certified: Option<&ProvedMotion>) -> String {
    let State { q, v } = motion.problem.initial;
    let row = |what, tau, q, v, bounds| MotionPoint { what, tau, q, v, bounds };
    let known = |tau, q, v| PointBounds::of(tau, q, Interval::point(v));
    let exactly = certified.map(|_| known(Interval::point(0.0), Interval::point(q), v));
    let start = row("start", 0.0, Some(q), Some(v), exactly);
    let turn = |(index, crossing): (usize, &Crossing)| {
        let enclosed = certified.and_then(|certified| certified.turns.get(index));
        let enclosed = enclosed.map(|turn| known(turn.tau, turn.q, 0.0));
        row("turn", crossing.tau, Some(crossing.q), Some(0.0), enclosed)
    };
    let turns = motion.crossings.iter().enumerate().map(turn);
    let (what, tau, q, v) = ending(&motion.outcome);
    let bounds = certified.map(|certified| PointBounds::of_end(certified, motion.problem.until).1);
    let end = row(what, tau, q, v, bounds);
    let proved =
        Columns::default().part("certified", point_columns(), |row: &MotionPoint| row.bounds);
    let columns = Columns::default()
        .file("what", |row: &MotionPoint| row.what)
        .file("tau", |row| row.tau)
        .file("q", |row| row.q)
        .file("v", |row| row.v)
        .and(certified.map(|_| proved));
    columns.csv(std::iter::once(start).chain(turns).chain([end]))
}

/// The problem, every turning point, the outcome, the energy balance and the cost.
pub fn table(motion: &Trajectory, seconds: f64) -> String {
    let problem = &motion.problem;
    let number = Quantity::pure(digits(problem.tolerance));
    let turns = Columns::default()
        .text("half swing", |(count, _): &(usize, &Crossing)| count.to_string())
        .number("tau", number, |(_, crossing)| crossing.tau)
        .number("q", number, |(_, crossing)| crossing.q)
        .table((1..).zip(&motion.crossings));
    let mut out = format!("{}\n{}\n\n", question(problem), sentence(motion, Writing::default()));
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
