//! The limit cycles at the extremes: one row for each set of parameters, and a summary.

use super::columns::Columns;
use super::cycle_numbers::cycle_fields;
use super::json::Document;
use crate::accuracy::extremes::sets::{BUDGET, LatticeCycle, SetAnswer, SetVerdict};
use crate::model::Parameters;
use crate::words::number::{exact as short, significant};
use crate::words::stability;

/// Residual above which the summary counts a cycle as not closed.
const CLOSED: f64 = 1e-11;

/// As a readable table.
pub fn table(verdicts: &[SetVerdict]) -> String {
    let list = |verdict: &SetVerdict, digits: usize, value: fn(&LatticeCycle) -> f64| {
        let values = verdict.cycles().iter().map(|it| significant(value(it), digits));
        values.collect::<Vec<_>>().join(", ")
    };
    let rows = parameter_texts(|it: &&SetVerdict| it.parameters)
        .text("cycles", |it| sentence(&it.answer))
        .text("q_max", move |it| list(it, 4, |found| found.cycle.q_max))
        .text("ln multiplier", move |it| list(it, 3, |found| found.cycle.log_multiplier))
        .text("residual", move |it| list(it, 2, |found| found.residual))
        .text("evaluations", |it| it.cost.evaluations.to_string())
        .table(verdicts);
    format!(
        "Every limit cycle by amplitude, or why the search gave up within {BUDGET} evaluations of a half \
         map.\nResidual: by what fraction of the clearance a turn fails to close, followed again by other \
         steps.\n\n{}\n{}",
        rows.aligned_left(),
        summary(verdicts)
    )
}

/// Columns of text for the parameters, in the order of the lattice.
pub(super) fn parameter_texts<'a, R: 'a>(parameters: fn(&R) -> Parameters) -> Columns<'a, R> {
    Columns::default()
        .text("D", move |row| short(parameters(row).d, 12))
        .text("r", move |row| short(parameters(row).r, 12))
        .text("D2", move |row| short(parameters(row).d2, 12))
        .text("D3", move |row| short(parameters(row).d3, 12))
}

/// As comma-separated values: one row for each cycle, and one for a set without cycles.
pub fn csv(verdicts: &[SetVerdict]) -> String {
    type SetRow<'a> = (&'a SetVerdict, Option<&'a LatticeCycle>);
    let kind = |(verdict, cycle): &SetRow| match &verdict.answer {
        SetAnswer::GaveUp { .. } => "gave-up",
        SetAnswer::Found { .. } if cycle.is_none() => "none",
        SetAnswer::Found { .. } => "cycle",
    };
    let reason = |(verdict, _): &SetRow| match &verdict.answer {
        SetAnswer::GaveUp { reason } => Some(reason.to_string()),
        SetAnswer::Found { .. } => None,
    };
    let example = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.0 };
    let columns = Columns::default()
        .fields(&example, |(verdict, _): &SetRow| Some(verdict.parameters))
        .file("answer", kind)
        .file("reason", reason)
        .file("evaluations", |(verdict, _)| verdict.cost.evaluations)
        .file("residual", |(_, cycle)| cycle.map(|found| found.residual))
        .and(cycle_fields(|(_, cycle): &SetRow| cycle.map(|found| found.cycle)));
    let rows = verdicts.iter().flat_map(|verdict| {
        let cycles = verdict.cycles().iter().map(Some);
        let none = verdict.cycles().is_empty().then_some(None);
        cycles.chain(none).map(move |cycle| (verdict, cycle))
    });
    columns.csv(rows)
}

/// As one JSON document.
pub fn json(verdicts: &[SetVerdict]) -> String {
    Document::default().with("budget", BUDGET).with("sets", verdicts).text()
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
    let open = residuals().filter(|&residual| residual > CLOSED).count();
    let counts = [
        ("sets", verdicts.len()),
        ("none", with(0)),
        ("one", with(1)),
        ("two", with(2)),
        ("gave up", verdicts.iter().filter(gave_up).count()),
        ("not closed to 1e-11", open),
    ];
    counts
        .into_iter()
        .fold(Columns::default(), |all, (title, count)| {
            all.text(title, move |()| count.to_string())
        })
        .text("evaluations", move |()| format!("<= {}", most.unwrap_or(0)))
        .table([()])
        .to_string()
}
