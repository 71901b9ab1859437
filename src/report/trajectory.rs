//! A motion.

use serde::Serialize;

use super::certified::{MotionDocument, PointBounds, followed};
use super::csv;
use super::json::{self, CountedCost};
use super::table::{Table, digits, motion as question};
use crate::flow::{Crossing, Method, Outcome, Trajectory};
use crate::numerics::Interval;
use crate::oscillator::{Ledger, Parameters, State};
use crate::proof::motion::ProvedMotion;
use crate::words::motion::{Writing, sentence};
use crate::words::number::{duration, exact, significant};

#[derive(Serialize)]
struct TrajectoryDocument<'a> {
    parameters: &'a Parameters,
    initial: &'a State,
    method: Method,
    tolerance: f64,
    outcome: &'a Outcome,
    events: &'a [Crossing],
    energy: Option<&'a Ledger>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<MotionDocument>,
    cost: CountedCost,
}

/// A point of a motion: its start, every arrival at `v = 0`, and its end.
#[derive(Default, Serialize)]
struct TrajectoryRow {
    what: &'static str,
    tau: f64,
    q: Option<f64>,
    v: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<PointBounds>,
}

pub fn json(motion: &Trajectory, certified: Option<&ProvedMotion>, seconds: f64) -> String {
    json::text(&TrajectoryDocument {
        parameters: &motion.problem.parameters,
        initial: &motion.problem.initial,
        method: motion.method,
        tolerance: motion.problem.tolerance,
        outcome: &motion.outcome,
        events: &motion.crossings,
        energy: motion.ledger.as_ref(),
        certified: certified.map(|certified| followed(certified, motion.problem.until)),
        cost: CountedCost { counted: motion.cost, seconds },
    })
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

/// One row for each point.
pub fn csv(motion: &Trajectory, certified: Option<&ProvedMotion>) -> String {
    let State { q, v } = motion.problem.initial;
    let row = |what, tau, q, v| TrajectoryRow { what, tau, q, v, certified: None };
    let mut start = row("start", 0.0, Some(q), Some(v));
    let (what, tau, last_q, last_v) = ending(&motion.outcome);
    let mut end = row(what, tau, last_q, last_v);
    if let Some(certified) = certified {
        let [tau, q, v] = [0.0, q, v].map(Interval::point);
        start.certified = Some(PointBounds::of(tau, q, v));
        end.certified = Some(PointBounds::of_end(certified, motion.problem.until));
    }
    let enclosed = certified.map_or(&[][..], |certified| &certified.turns);
    let turn = |(index, crossing): (usize, &Crossing)| TrajectoryRow {
        certified: enclosed
            .get(index)
            .map(|turn| PointBounds::of(turn.tau, turn.q, Interval::point(0.0))),
        ..row("turn", crossing.tau, Some(crossing.q), Some(0.0))
    };
    let turns = motion.crossings.iter().enumerate().map(turn);
    let like = TrajectoryRow {
        certified: certified.map(|_| PointBounds::like()),
        ..TrajectoryRow::default()
    };
    csv::sheet(&like, std::iter::once(start).chain(turns).chain([end]))
}

/// The problem, every turning point, the outcome, the energy balance and the cost.
pub fn table(motion: &Trajectory, seconds: f64) -> String {
    let problem = &motion.problem;
    let places = digits(problem.tolerance);
    let number = |value: f64| significant(value, places);
    let numbered: Vec<(usize, &Crossing)> = (1..).zip(&motion.crossings).collect();
    let turns = Table::of(
        &numbered,
        &[
            ("half swing", &|(number, _)| number.to_string()),
            ("tau", &|(_, crossing)| number(crossing.tau)),
            ("q", &|(_, crossing)| number(crossing.q)),
        ],
    );
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
        let ledger = Table::of(
            &amounts,
            &[
                ("energy", &|(name, _)| (*name).to_owned()),
                ("amount", &|(_, value)| significant(*value, 6)),
            ],
        );
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
