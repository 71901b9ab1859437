//! The lattice of extremes: one row for each motion with the answers of all methods, and a summary.

use serde::Serialize;

use super::csv;
use super::json;
use super::table::Table;
use super::trajectory::ending;
use crate::flow::{Method, Outcome};
use crate::oscillator::Parameters;
use crate::study::extremes::verdict::{BUDGET, METHODS};
use crate::study::extremes::{MethodAnswer, MethodsVerdict, NamedExtreme};
use crate::words::number::{exact as short, significant};

/// As a readable table: the answer of `auto` and its cost, then the digits that each method lost.
pub fn table(verdicts: &[MethodsVerdict], named: &[NamedExtreme], tolerance: f64) -> String {
    let mut titles = vec!["D", "r", "D2", "D3", "start", "answer", "evaluations", "sensitive"];
    titles.extend(METHODS.map(|method| method.spec().name));
    let mut rows = Table::new(&titles);
    for verdict in verdicts {
        let Parameters { d, d2, d3, r } = verdict.case.parameters;
        let mut cells: Vec<String> = [d, r, d2, d3].map(|value| short(value, 12)).to_vec();
        cells.push(verdict.case.start.to_string());
        let auto = &verdict.answers[0];
        cells.extend([short_sentence(&auto.outcome), auto.cost.evaluations.to_string()]);
        cells.push(significant(verdict.sensitivity, 2));
        cells.extend(METHODS.map(|method| verdict.answer(method).map_or_else(String::new, mark)));
        rows.row(cells);
    }
    format!(
        "Below the name of a method: digits lost of those that the tolerance {tolerance:e} asks for,\n\
         or why there is no number: gave up within {BUDGET} evaluations, wrong (contradicts the \
         reference),\n? (nothing to compare with), nothing (it does not serve these parameters).\n\
         Sensitive: digits by which the answer magnifies a change of the damping (where a digit was \
         lost).\n\n{rows}\n{}\n{}",
        summary(verdicts),
        names(named)
    )
}

/// As comma-separated values: one row for each motion and method, all digits.
pub fn csv(verdicts: &[MethodsVerdict]) -> String {
    let rows = verdicts.iter().flat_map(|verdict| {
        verdict.answers.iter().map(move |answer| ExtremesRow::new(verdict, answer))
    });
    let rows: Vec<ExtremesRow> = rows.collect();
    rows.first().map_or_else(String::new, |first| csv::sheet(first, &rows))
}

/// A motion by one method.
#[derive(Serialize)]
struct ExtremesRow {
    #[serde(flatten)]
    parameters: Parameters,
    start: String,
    q0: f64,
    v0: f64,
    method: Method,
    answer: &'static str,
    tau: f64,
    q: Option<f64>,
    v: Option<f64>,
    reason: Option<String>,
    digits_lost: Option<f64>,
    sensitivity: f64,
    contradicts: bool,
    evaluations: u64,
    steps: u64,
}

impl ExtremesRow {
    fn new(verdict: &MethodsVerdict, answer: &MethodAnswer) -> Self {
        let (kind, tau, q, v) = ending(&answer.outcome);
        let reason = match answer.outcome {
            Outcome::GaveUp { reason, .. } => Some(reason.to_string()),
            _ => None,
        };
        ExtremesRow {
            parameters: verdict.case.parameters,
            start: verdict.case.start.to_string(),
            q0: verdict.case.initial.q,
            v0: verdict.case.initial.v,
            method: answer.method,
            answer: kind,
            tau,
            q,
            v,
            reason,
            digits_lost: answer.digits_lost,
            sensitivity: verdict.sensitivity,
            contradicts: answer.contradicts,
            evaluations: answer.cost.evaluations,
            steps: answer.cost.steps,
        }
    }
}

#[derive(Serialize)]
struct ExtremesDocument<'a> {
    tolerance: f64,
    budget: u64,
    motions: &'a [MethodsVerdict],
    named: &'a [NamedExtreme],
}

/// As one JSON document.
pub fn json(verdicts: &[MethodsVerdict], named: &[NamedExtreme], tolerance: f64) -> String {
    json::text(&ExtremesDocument { tolerance, budget: BUDGET, motions: verdicts, named })
}

/// How a motion ended, in a few words.
fn short_sentence(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Captured { tau, q } => {
            format!("captured at {} after {}", significant(*q, 4), significant(*tau, 4))
        }
        Outcome::Moving { q, v, .. } => {
            format!("moving at {}, {}", significant(*q, 4), significant(*v, 4))
        }
        Outcome::Escaped { tau } => format!("escaped after {}", significant(*tau, 4)),
        Outcome::GaveUp { tau, reason } => {
            format!("gave up after {}: {reason}", significant(*tau, 4))
        }
    }
}

/// How well a method answered.
fn mark(answer: &MethodAnswer) -> String {
    match answer {
        MethodAnswer { contradicts: true, .. } => "wrong".into(),
        MethodAnswer { digits_lost: Some(lost), .. } => format!("{lost:.1}"),
        MethodAnswer { outcome: Outcome::GaveUp { .. }, .. } => "gave up".into(),
        _ => "?".into(),
    }
}

/// How often each method answered, and how well.
fn summary(verdicts: &[MethodsVerdict]) -> String {
    type Asked<'a> = (Method, Vec<&'a MethodAnswer>);
    let asked = |method| (method, verdicts.iter().filter_map(|it| it.answer(method)).collect());
    let count = |answers: &[&MethodAnswer], which: &dyn Fn(&MethodAnswer) -> bool| {
        answers.iter().filter(|it| which(it)).count().to_string()
    };
    let lost = |answers: &[&MethodAnswer], low: f64, high: f64| {
        count(answers, &|it| it.digits_lost.is_some_and(|lost| lost > low && lost <= high))
    };
    let gave_up = |it: &MethodAnswer| matches!(it.outcome, Outcome::GaveUp { .. });
    let unchecked = |it: &MethodAnswer| !it.contradicts && it.digits_lost.is_none() && !gave_up(it);
    let table = Table::of(
        &METHODS.map(asked),
        &[
            ("method", &|(method, _): &Asked| method.to_string()),
            ("motions", &|(_, answers)| answers.len().to_string()),
            ("all digits", &|(_, answers)| lost(answers, f64::NEG_INFINITY, 0.0)),
            ("1 lost", &|(_, answers)| lost(answers, 0.0, 1.0)),
            ("2-4 lost", &|(_, answers)| lost(answers, 1.0, 4.0)),
            ("more lost", &|(_, answers)| lost(answers, 4.0, f64::INFINITY)),
            ("wrong", &|(_, answers)| count(answers, &|it| it.contradicts)),
            ("unchecked", &|(_, answers)| count(answers, &unchecked)),
            ("gave up", &|(_, answers)| count(answers, &gave_up)),
            ("evaluations", &|(_, answers)| {
                let most = answers.iter().map(|it| it.cost.evaluations).max();
                format!("<= {}", most.unwrap_or(0))
            }),
        ],
    );
    table.to_string()
}

fn names(named: &[NamedExtreme]) -> String {
    let table = Table::of(
        named,
        &[
            ("extreme", &|it| it.what.to_owned()),
            ("method", &|it| it.method.to_string()),
            ("what is measured", &|it| it.measure.to_owned()),
            ("measured", &|it| significant(it.measured, 2)),
            ("allowed", &|it| significant(it.allowed, 2)),
            ("evaluations", &|it| it.cost.evaluations.to_string()),
        ],
    );
    table.to_string()
}
