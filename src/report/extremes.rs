//! The lattice of extremes: one row for each motion with the answers of all methods, and a summary.

use super::columns::{Columns, Quantity};
use super::extreme_cycles::parameter_texts;
use super::json::Document;
use super::trajectory::ending;
use crate::accuracy::extremes::verdict::{BUDGET, METHODS};
use crate::accuracy::extremes::{MethodAnswer, MethodsVerdict, NamedExtreme};
use crate::flow::{Method, Outcome};
use crate::model::Parameters;
use crate::words::number::significant;

/// As a readable table: the answer of `auto` and its cost, then the digits that each method lost.
pub fn table(verdicts: &[MethodsVerdict], named: &[NamedExtreme], tolerance: f64) -> String {
    let columns = parameter_texts(|it: &&MethodsVerdict| it.case.parameters)
        .text("start", |it| it.case.start.to_string())
        .text("answer", |it| short_sentence(&it.answers[0].outcome))
        .text("evaluations", |it| it.answers[0].cost.evaluations.to_string())
        .text("sensitive", |it| significant(it.sensitivity, 2));
    let columns = METHODS.into_iter().fold(columns, |columns, method| {
        let name = method.spec().name;
        columns.text(name, move |it| it.answer(method).map_or_else(String::new, mark))
    });
    let rows = columns.table(verdicts);
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
    type MethodRow<'a> = (&'a MethodsVerdict, &'a MethodAnswer);
    let example = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.0 };
    let reason = |outcome: Outcome| match outcome {
        Outcome::GaveUp { reason, .. } => Some(reason.to_string()),
        _ => None,
    };
    let columns = Columns::default()
        .fields(&example, |(verdict, _): &MethodRow| Some(verdict.case.parameters))
        .file("start", |(verdict, _)| verdict.case.start.to_string())
        .file("q0", |(verdict, _)| verdict.case.initial.q)
        .file("v0", |(verdict, _)| verdict.case.initial.v)
        .file("method", |(_, answer)| answer.method)
        .file("answer", |(_, answer)| ending(&answer.outcome).0)
        .file("tau", |(_, answer)| ending(&answer.outcome).1)
        .file("q", |(_, answer)| ending(&answer.outcome).2)
        .file("v", |(_, answer)| ending(&answer.outcome).3)
        .file("reason", move |(_, answer)| reason(answer.outcome))
        .file("digits_lost", |(_, answer)| answer.digits_lost)
        .file("sensitivity", |(verdict, _)| verdict.sensitivity)
        .file("contradicts", |(_, answer)| answer.contradicts)
        .file("evaluations", |(_, answer)| answer.cost.evaluations)
        .file("steps", |(_, answer)| answer.cost.steps);
    columns.csv(verdicts.iter().flat_map(|it| it.answers.iter().map(move |answer| (it, answer))))
}

/// As one JSON document.
pub fn json(verdicts: &[MethodsVerdict], named: &[NamedExtreme], tolerance: f64) -> String {
    Document::default()
        .with("tolerance", tolerance)
        .with("budget", BUDGET)
        .with("motions", verdicts)
        .with("named", named)
        .text()
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
    let most = |answers: &[&MethodAnswer]| answers.iter().map(|it| it.cost.evaluations).max();
    Columns::default()
        .text("method", |(method, _): &Asked| method.to_string())
        .text("motions", |(_, answers)| answers.len().to_string())
        .text("all digits", move |(_, answers)| lost(answers, f64::NEG_INFINITY, 0.0))
        .text("1 lost", move |(_, answers)| lost(answers, 0.0, 1.0))
        .text("2-4 lost", move |(_, answers)| lost(answers, 1.0, 4.0))
        .text("more lost", move |(_, answers)| lost(answers, 4.0, f64::INFINITY))
        .text("wrong", move |(_, answers)| count(answers, &|it| it.contradicts))
        .text("unchecked", move |(_, answers)| count(answers, &unchecked))
        .text("gave up", move |(_, answers)| count(answers, &gave_up))
        .text("evaluations", move |(_, answers)| format!("<= {}", most(answers).unwrap_or(0)))
        .table(METHODS.map(asked))
        .to_string()
}

fn names(named: &[NamedExtreme]) -> String {
    const NUMBER: Quantity = Quantity::pure(2);
    Columns::default()
        .text("extreme", |it: &&NamedExtreme| it.what.to_owned())
        .text("method", |it| it.method.to_string())
        .text("what is measured", |it| it.measure.to_owned())
        .number("measured", NUMBER, |it| it.measured)
        .number("allowed", NUMBER, |it| it.allowed)
        .text("evaluations", |it| it.cost.evaluations.to_string())
        .table(named)
        .to_string()
}
