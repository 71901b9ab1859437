//! Answers as comma-separated values: a line of names, then one row each, all digits, empty where a
//! value does not exist.

use crate::flow::{Outcome, Trajectory};
use crate::study::basin::Survey;
use crate::study::fold::Border;
use crate::study::{Branch, Cycle, Cycles};

/// All digits that tell this double from its neighbours: `0.1`, `-3.0`, `1e-300`.
pub(super) fn exact(value: f64) -> String {
    format!("{value:?}")
}

/// The same, or nothing where there is no number.
pub(super) fn exact_or_empty(value: Option<f64>) -> String {
    value.filter(|value| value.is_finite()).map_or_else(String::new, exact)
}

/// A motion: its start, every arrival at `v = 0`, and its end, each with what it is.
#[must_use]
pub fn trajectory(motion: &Trajectory) -> String {
    let mut out = String::from("what,tau,q,v\n");
    let mut row = |what: &str, tau: f64, q: Option<f64>, v: Option<f64>| {
        let cells = [what.to_owned(), exact(tau), exact_or_empty(q), exact_or_empty(v)];
        out.push_str(&line(&cells));
    };
    let initial = motion.problem.initial;
    row("start", 0.0, Some(initial.q), Some(initial.v));
    for crossing in &motion.crossings {
        row("turn", crossing.tau, Some(crossing.q), Some(0.0));
    }
    match motion.outcome {
        Outcome::Captured { tau, q } => row("captured", tau, Some(q), Some(0.0)),
        Outcome::Moving { tau, q, v } => row("moving", tau, Some(q), Some(v)),
        Outcome::Escaped { tau } => row("escaped", tau, None, None),
        Outcome::GaveUp { tau, .. } => row("gave-up", tau, None, None),
    }
    out
}

/// Names of the columns that describe a cycle.
pub(super) const CYCLE: &str =
    "stable,q_min,q_max,v_min,v_max,period,multiplier,log_multiplier,clearance,log_clearance,error";

pub(super) fn cycle(cycle: &Cycle) -> Vec<String> {
    vec![
        cycle.stable.to_string(),
        exact(cycle.q_min),
        exact(cycle.q_max),
        exact(cycle.v_min),
        exact(cycle.v_max),
        exact(cycle.period),
        exact_or_empty(cycle.multiplier),
        exact(cycle.log_multiplier),
        exact(cycle.clearance),
        exact(cycle.log_clearance),
        exact(cycle.error),
    ]
}

/// One row for each cycle.
#[must_use]
pub fn cycles(found: &Cycles) -> String {
    let rows = found.cycles.iter().map(|found| line(&cycle(found)));
    std::iter::once(format!("{CYCLE}\n")).chain(rows).collect()
}

/// One row for each point of a branch, with the number of the connected piece that it belongs to.
#[must_use]
pub fn branch(branch: &Branch) -> String {
    let mut out = format!("piece,{},{CYCLE}\n", branch.parameter);
    for (number, piece) in branch.pieces.iter().enumerate() {
        for point in piece {
            let mut cells = vec![number.to_string(), exact(point.value)];
            cells.extend(cycle(&point.cycle));
            out.push_str(&line(&cells));
        }
    }
    out
}

/// A basin over a window: one row.
#[must_use]
pub fn basin(found: &Survey) -> String {
    let Survey { counts, margin, .. } = found;
    let mut out = String::from(
        "captured,cycle,escaped,undecided,displacement,impulse,area,captured_part,lyapunov_share\n",
    );
    out.push_str(&line(&[
        counts.captured.to_string(),
        counts.cycle.to_string(),
        counts.escaped.to_string(),
        counts.undecided.to_string(),
        exact_or_empty(margin.displacement),
        exact_or_empty(margin.impulse),
        exact_or_empty(found.area),
        exact(found.captured),
        exact_or_empty(found.lyapunov_share),
    ]));
    out
}

/// One row for each value of the second parameter.
#[must_use]
pub fn border(found: &Border) -> String {
    let mut out = format!("{},D_F,q_max,period,D_F_harmonic,D_c,reason\n", found.second);
    for point in &found.points {
        let fold = point.fold;
        out.push_str(&line(&[
            exact(point.value),
            exact_or_empty(fold.map(|fold| fold.d)),
            exact_or_empty(fold.map(|fold| fold.q_max)),
            exact_or_empty(fold.map(|fold| fold.period)),
            exact_or_empty(point.harmonic_fold),
            exact_or_empty(point.escape),
            point.reason.clone().unwrap_or_default(),
        ]));
    }
    out
}

/// Cells as a line; those with a separator or quotes in them are quoted.
#[must_use]
pub fn line(cells: &[String]) -> String {
    let quoted = |cell: &String| {
        if cell.contains([',', '"', '\n']) {
            format!("\"{}\"", cell.replace('"', "\"\""))
        } else {
            cell.clone()
        }
    };
    cells.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_with_separators_are_quoted() {
        let cells = ["a,b", "say \"x\"", "plain"].map(str::to_owned);
        assert_eq!(line(&cells), "\"a,b\",\"say \"\"x\"\"\",plain\n");
    }
}
