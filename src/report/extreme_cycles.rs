//! The limit cycles at the extremes: one row for each set of parameters, and a summary.

use serde::Serialize;

use super::csv;
use super::json;
use super::table::Table;
use crate::oscillator::Parameters;
use crate::portrait::{Cycle, CycleErrors};
use crate::study::extremes::sets::{BUDGET, LatticeCycle, SetAnswer, SetVerdict};
use crate::words::number::{exact as short, significant};
use crate::words::stability;

/// Residual above which the summary counts a cycle as not closed.
const CLOSED: f64 = 1e-11;

/// As a readable table.
pub fn table(verdicts: &[SetVerdict]) -> String {
    let list = |verdict: &SetVerdict, digits: usize, value: &dyn Fn(&LatticeCycle) -> f64| {
        let values = verdict.cycles().iter().map(|it| significant(value(it), digits));
        values.collect::<Vec<_>>().join(", ")
    };
    let rows = Table::of(
        verdicts,
        &[
            ("D", &|it| short(it.parameters.d, 12)),
            ("r", &|it| short(it.parameters.r, 12)),
            ("D2", &|it| short(it.parameters.d2, 12)),
            ("D3", &|it| short(it.parameters.d3, 12)),
            ("cycles", &|it| sentence(&it.answer)),
            ("q_max", &|it| list(it, 4, &|found| found.cycle.q_max)),
            ("ln multiplier", &|it| list(it, 3, &|found| found.cycle.log_multiplier)),
            ("residual", &|it| list(it, 2, &|found| found.residual)),
            ("evaluations", &|it| it.cost.evaluations.to_string()),
        ],
    );
    format!(
        "Every limit cycle by amplitude, or why the search gave up within {BUDGET} evaluations of a half \
         map.\nResidual: by what fraction of the clearance a turn fails to close, followed again by other \
         steps.\n\n{}\n{}",
        rows.aligned_left(),
        summary(verdicts)
    )
}

/// As comma-separated values: one row for each cycle, and one for a set without cycles.
pub fn csv(verdicts: &[SetVerdict]) -> String {
    let row = |verdict: &SetVerdict, answer, found: Option<&LatticeCycle>| ExtremeCyclesRow {
        parameters: verdict.parameters,
        answer,
        reason: match &verdict.answer {
            SetAnswer::GaveUp { reason } => Some(reason.to_string()),
            SetAnswer::Found { .. } => None,
        },
        evaluations: verdict.cost.evaluations,
        residual: found.map(|found| found.residual),
        cycle: found.map(|found| found.cycle),
    };
    let rows = verdicts.iter().flat_map(|verdict| match &verdict.answer {
        SetAnswer::GaveUp { .. } => vec![row(verdict, "gave-up", None)],
        SetAnswer::Found { cycles } if cycles.is_empty() => vec![row(verdict, "none", None)],
        SetAnswer::Found { cycles } => {
            cycles.iter().map(|found| row(verdict, "cycle", Some(found))).collect()
        }
    });
    let like = ExtremeCyclesRow {
        parameters: Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.0 },
        answer: "",
        reason: None,
        evaluations: 0,
        residual: None,
        cycle: Some(Cycle { errors: Some(CycleErrors::default()), ..Cycle::default() }),
    };
    csv::sheet(&like, rows)
}

/// A set of parameters with one of its cycles, if it has any.
#[derive(Serialize)]
struct ExtremeCyclesRow {
    #[serde(flatten)]
    parameters: Parameters,
    answer: &'static str,
    reason: Option<String>,
    evaluations: u64,
    residual: Option<f64>,
    #[serde(flatten)]
    cycle: Option<Cycle>,
}

#[derive(Serialize)]
struct ExtremeCyclesDocument<'a> {
    budget: u64,
    sets: &'a [SetVerdict],
}

/// As one JSON document.
pub fn json(verdicts: &[SetVerdict]) -> String {
    json::text(&ExtremeCyclesDocument { budget: BUDGET, sets: verdicts })
}

/// The answer in a few words.
fn sentence(answer: &SetAnswer) -> String {
    match answer {
        SetAnswer::GaveUp { reason } => format!("gave up: {reason}"),
        SetAnswer::Found { cycles } if cycles.is_empty() => "none".into(),
        SetAnswer::Found { cycles } => {
            let kinds = cycles.iter().map(|found| stability(found.cycle.stable));
            kinds.collect::<Vec<_>>().join(", ")
        }
    }
}

/// How often each answer occurred.
fn summary(verdicts: &[SetVerdict]) -> String {
    let gave_up = |it: &&SetVerdict| matches!(it.answer, SetAnswer::GaveUp { .. });
    let with = |count: usize| {
        verdicts.iter().filter(|it| !gave_up(it) && it.cycles().len() == count).count()
    };
    let residuals = || verdicts.iter().flat_map(SetVerdict::cycles).map(|found| found.residual);
    let most = verdicts.iter().filter(|it| !gave_up(it)).map(|it| it.cost.evaluations).max();
    let table = Table::of(
        &[verdicts],
        &[
            ("sets", &|all| all.len().to_string()),
            ("none", &|_| with(0).to_string()),
            ("one", &|_| with(1).to_string()),
            ("two", &|_| with(2).to_string()),
            ("gave up", &|all| all.iter().filter(gave_up).count().to_string()),
            ("not closed to 1e-11", &|_| {
                residuals().filter(|&residual| residual > CLOSED).count().to_string()
            }),
            ("evaluations", &|_| format!("<= {}", most.unwrap_or(0))),
        ],
    );
    table.to_string()
}
