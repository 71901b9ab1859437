//! The lattice of extremes: one row for each motion with the answers of all methods, or for each set of parameters with
//! its limit cycles, and a summary.

use super::cycle_numbers::cycle_fields;
use super::motion::ending;
use super::{Answer, Columns, Document, Quantity};
use crate::accuracy::extremes::sets::{
    BUDGET as BUDGET_OF_SET, LatticeCycle, SetAnswer, SetVerdict,
};
use crate::accuracy::extremes::verdict::{BUDGET, METHODS};
use crate::accuracy::extremes::{MethodAnswer, MethodsVerdict, NamedExtreme};
use crate::flow::{Method, Outcome};
use crate::model::Parameters;
use crate::words::number::exact as short;
use crate::words::{significant, stability};

/// The answers of all methods; `named` computes the extremes that have a name.
pub fn extremes<'a>(
    verdicts: &'a [MethodsVerdict],
    named: impl Fn() -> Vec<NamedExtreme> + Copy + 'a,
    tolerance: f64,
) -> Answer<'a> {
    let json = move || {
        Document::default()
            .with("tolerance", tolerance)
            .with("budget", BUDGET)
            .with("motions", verdicts)
            .with("named", named())
            .text()
    };
    Answer::new(json, move || csv(verdicts), move || table(verdicts, &named(), tolerance))
}

/// As a readable table: the answer of `auto` and its cost, then the digits that each method lost.
fn table(verdicts: &[MethodsVerdict], named: &[NamedExtreme], tolerance: f64) -> String {
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
fn csv(verdicts: &[MethodsVerdict]) -> String {
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

/// Columns of text for the parameters, in the order of the lattice.
fn parameter_texts<'a, R: 'a>(parameters: fn(&R) -> Parameters) -> Columns<'a, R> {
    Columns::default()
        .text("D", move |row| short(parameters(row).d, 12))
        .text("r", move |row| short(parameters(row).r, 12))
        .text("D2", move |row| short(parameters(row).d2, 12))
        .text("D3", move |row| short(parameters(row).d3, 12))
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

/// The limit cycles at the extremes.
pub fn extreme_cycles(verdicts: &[SetVerdict]) -> Answer<'_> {
    let json =
        move || Document::default().with("budget", BUDGET_OF_SET).with("sets", verdicts).text();
    Answer::new(json, move || cycles_csv(verdicts), move || cycles_table(verdicts))
}

/// Residual above which the summary counts a cycle as not closed.
const CLOSED: f64 = 1e-11;

/// As a readable table.
fn cycles_table(verdicts: &[SetVerdict]) -> String {
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
        "Every limit cycle by amplitude, or why the search gave up within {BUDGET_OF_SET} evaluations of a half \
         map.\nResidual: by what fraction of the clearance a turn fails to close, followed again by other \
         steps.\n\n{}\n{}",
        rows.aligned_left(),
        sets_summary(verdicts)
    )
}

/// As comma-separated values: one row for each cycle, and one for a set without cycles.
fn cycles_csv(verdicts: &[SetVerdict]) -> String {
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
fn sets_summary(verdicts: &[SetVerdict]) -> String {
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
