//! The lattice of extremes: one row for each motion, with every method's answer; and a summary.

use serde::Serialize;

use super::csv::{exact, exact_or_empty, line};
use super::json;
use super::table::Table;
use crate::flow::{Method, Outcome};
use crate::oscillator::Parameters;
use crate::study::extremes::verdict::{BUDGET, METHODS};
use crate::study::extremes::{Answer, Named, Verdict};
use crate::view::number::{exact as short, significant};

/// As a table to read: the answer of `auto` and its cost, then the digits that each method lost.
#[must_use]
pub fn table(verdicts: &[Verdict], named: &[Named], tolerance: f64) -> String {
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
#[must_use]
pub fn csv(verdicts: &[Verdict]) -> String {
    let mut out = String::from(
        "D,D2,D3,r,start,q0,v0,method,answer,tau,q,v,reason,digits_lost,sensitivity,contradicts,evaluations,steps\n",
    );
    for verdict in verdicts {
        let Parameters { d, d2, d3, r } = verdict.case.parameters;
        let initial = verdict.case.initial;
        for answer in &verdict.answers {
            let mut cells = [d, d2, d3, r].map(exact).to_vec();
            cells.push(verdict.case.start.to_string());
            cells.extend([exact(initial.q), exact(initial.v), answer.method.to_string()]);
            let nothing = String::new;
            let (kind, tau, q, v, reason) = match answer.outcome {
                Outcome::Captured { tau, q } => ("captured", tau, exact(q), exact(0.0), nothing()),
                Outcome::Moving { tau, q, v } => ("moving", tau, exact(q), exact(v), nothing()),
                Outcome::Escaped { tau } => ("escaped", tau, nothing(), nothing(), nothing()),
                Outcome::GaveUp { tau, reason } => {
                    ("gave-up", tau, nothing(), nothing(), reason.to_string())
                }
            };
            cells.extend([kind.to_owned(), exact(tau), q, v, reason]);
            cells.push(answer.digits_lost.map_or_else(nothing, exact));
            cells.push(exact_or_empty(Some(verdict.sensitivity)));
            cells.push(answer.contradicts.to_string());
            cells.extend(
                [answer.cost.evaluations, answer.cost.steps].map(|count| count.to_string()),
            );
            out.push_str(&line(&cells));
        }
    }
    out
}

#[derive(Serialize)]
struct Document<'a> {
    tolerance: f64,
    budget: u64,
    motions: &'a [Verdict],
    named: &'a [Named],
}

/// As one JSON document.
#[must_use]
pub fn json(verdicts: &[Verdict], named: &[Named], tolerance: f64) -> String {
    json::text(&Document { tolerance, budget: BUDGET, motions: verdicts, named })
}

/// What became of a motion, in a few words.
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
fn mark(answer: &Answer) -> String {
    match answer {
        Answer { contradicts: true, .. } => "wrong".into(),
        Answer { digits_lost: Some(lost), .. } => format!("{lost:.1}"),
        Answer { outcome: Outcome::GaveUp { .. }, .. } => "gave up".into(),
        _ => "?".into(),
    }
}

/// How often each method answered how well.
fn summary(verdicts: &[Verdict]) -> String {
    let mut table = Table::new(&[
        "method",
        "motions",
        "all digits",
        "1 lost",
        "2-4 lost",
        "more lost",
        "wrong",
        "unchecked",
        "gave up",
        "evaluations",
    ]);
    for method in METHODS {
        let answers: Vec<&Answer> = verdicts.iter().filter_map(|it| it.answer(method)).collect();
        table.row(tally(method, &answers));
    }
    table.to_string()
}

fn tally(method: Method, answers: &[&Answer]) -> Vec<String> {
    let count =
        |which: &dyn Fn(&Answer) -> bool| answers.iter().filter(|it| which(it)).count().to_string();
    let lost = |low: f64, high: f64| {
        count(&|it: &Answer| it.digits_lost.is_some_and(|lost| lost > low && lost <= high))
    };
    let gave_up = |it: &Answer| matches!(it.outcome, Outcome::GaveUp { .. });
    let most = answers.iter().map(|it| it.cost.evaluations).max().unwrap_or(0);
    vec![
        method.to_string(),
        answers.len().to_string(),
        lost(f64::NEG_INFINITY, 0.0),
        lost(0.0, 1.0),
        lost(1.0, 4.0),
        lost(4.0, f64::INFINITY),
        count(&|it| it.contradicts),
        count(&|it| !it.contradicts && it.digits_lost.is_none() && !gave_up(it)),
        count(&gave_up),
        format!("<= {most}"),
    ]
}

/// The extremes that have names.
fn names(named: &[Named]) -> String {
    let mut table = Table::new(&[
        "extreme",
        "method",
        "what is measured",
        "measured",
        "allowed",
        "evaluations",
    ]);
    for it in named {
        table.row(vec![
            it.what.to_owned(),
            it.method.to_string(),
            it.measure.to_owned(),
            significant(it.measured, 2),
            significant(it.allowed, 2),
            it.cost.evaluations.to_string(),
        ]);
    }
    table.to_string()
}
