//! The limit cycles at the extremes: one row for each set of parameters, and a summary.

use serde::Serialize;

use super::csv::{CYCLE, cycle, exact, line};
use super::json;
use super::table::Table;
use crate::oscillator::Parameters;
use crate::study::extremes::sets::{BUDGET, Found, SetAnswer, SetVerdict};
use crate::view::number::{exact as short, significant};

/// Residual above which a row of the summary counts a cycle apart.
const CLOSED: f64 = 1e-11;

/// As a table to read.
#[must_use]
pub fn table(verdicts: &[SetVerdict]) -> String {
    let mut rows = Table::new(&[
        "D",
        "r",
        "D2",
        "D3",
        "cycles",
        "q_max",
        "ln multiplier",
        "residual",
        "evaluations",
    ]);
    for verdict in verdicts {
        let Parameters { d, d2, d3, r } = verdict.parameters;
        let mut cells: Vec<String> = [d, r, d2, d3].map(|value| short(value, 12)).to_vec();
        cells.push(sentence(&verdict.answer));
        let list = |value: &dyn Fn(&Found) -> f64, digits: usize| {
            let values = verdict.cycles().iter().map(|it| significant(value(it), digits));
            values.collect::<Vec<_>>().join(", ")
        };
        cells.push(list(&|it| it.cycle.q_max, 4));
        cells.push(list(&|it| it.cycle.log_multiplier, 3));
        cells.push(list(&|it| it.residual, 2));
        cells.push(verdict.cost.evaluations.to_string());
        rows.row(cells);
    }
    format!(
        "Every limit cycle by amplitude, or why the search gave up within {BUDGET} evaluations of a half \
         map.\nResidual: by what part of the clearance a turn fails to close, followed again by other \
         steps.\n\n{}\n{}",
        rows.aligned_left(),
        summary(verdicts)
    )
}

/// As comma-separated values: one row for each cycle, or for a set without any.
#[must_use]
pub fn csv(verdicts: &[SetVerdict]) -> String {
    let mut out = format!("D,D2,D3,r,answer,reason,evaluations,residual,{CYCLE}\n");
    let nothing = vec![String::new(); CYCLE.split(',').count()];
    for verdict in verdicts {
        let Parameters { d, d2, d3, r } = verdict.parameters;
        let mut row = |answer: &str, reason: String, residual: String, cycle: &[String]| {
            let mut cells = [d, d2, d3, r].map(exact).to_vec();
            let evaluations = verdict.cost.evaluations.to_string();
            cells.extend([answer.to_owned(), reason, evaluations, residual]);
            cells.extend_from_slice(cycle);
            out.push_str(&line(&cells));
        };
        match &verdict.answer {
            SetAnswer::GaveUp { reason } => {
                row("gave-up", reason.to_string(), String::new(), &nothing);
            }
            SetAnswer::Found { cycles } if cycles.is_empty() => {
                row("none", String::new(), String::new(), &nothing);
            }
            SetAnswer::Found { cycles } => {
                for it in cycles {
                    row("cycle", String::new(), exact(it.residual), &cycle(&it.cycle));
                }
            }
        }
    }
    out
}

#[derive(Serialize)]
struct Document<'a> {
    budget: u64,
    sets: &'a [SetVerdict],
}

/// As one JSON document.
#[must_use]
pub fn json(verdicts: &[SetVerdict]) -> String {
    json::text(&Document { budget: BUDGET, sets: verdicts })
}

/// The answer in a few words.
fn sentence(answer: &SetAnswer) -> String {
    match answer {
        SetAnswer::GaveUp { reason } => format!("gave up: {reason}"),
        SetAnswer::Found { cycles } if cycles.is_empty() => "none".into(),
        SetAnswer::Found { cycles } => {
            let kind = |it: &Found| if it.cycle.stable { "stable" } else { "unstable" };
            cycles.iter().map(kind).collect::<Vec<_>>().join(", ")
        }
    }
}

/// How often which answer came.
fn summary(verdicts: &[SetVerdict]) -> String {
    let gave_up = |it: &&SetVerdict| matches!(it.answer, SetAnswer::GaveUp { .. });
    let with = |count: usize| {
        verdicts.iter().filter(|it| !gave_up(it) && it.cycles().len() == count).count()
    };
    let residuals = || verdicts.iter().flat_map(SetVerdict::cycles).map(|found| found.residual);
    let most = verdicts.iter().filter(|it| !gave_up(it)).map(|it| it.cost.evaluations).max();
    let mut table = Table::new(&[
        "sets",
        "none",
        "one",
        "two",
        "gave up",
        "not closed to 1e-11",
        "evaluations",
    ]);
    table.row(vec![
        verdicts.len().to_string(),
        with(0).to_string(),
        with(1).to_string(),
        with(2).to_string(),
        verdicts.iter().filter(gave_up).count().to_string(),
        residuals().filter(|&residual| residual > CLOSED).count().to_string(),
        format!("<= {}", most.unwrap_or(0)),
    ]);
    table.to_string()
}
