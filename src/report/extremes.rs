//! The lattice of extremes: one row for each motion with the answers of all methods, or for each set of parameters with
//! its limit cycles, and a summary.

use super::cycle_numbers::cycle_fields;
use super::{Answer, Columns, Document, Quantity, Table};
use crate::accuracy::extremes::sets::{BUDGET as BUDGET_OF_SET, LatticeCycle, SetVerdict};
use crate::accuracy::extremes::verdict::{BUDGET, METHODS};
use crate::accuracy::extremes::{MethodAnswer, MethodsVerdict, NamedExtreme};
use crate::flow::{Method, Outcome};
use crate::model::{Knob, Parameters};
use crate::words::{exact as short, significant, stability};

/// Few digits of what has more in files.
const FEW: Quantity = Quantity::pure(4);

/// The answers of all methods, and the extremes that have a name.
pub fn extremes(verdicts: &[MethodsVerdict], named: &[NamedExtreme], tolerance: f64) -> Answer {
    let rows = verdicts.iter().flat_map(|it| it.answers.iter().map(move |answer| (it, answer)));
    let first = verdicts.iter().map(|it| (it, &it.answers[0]));
    let columns = method_columns();
    Answer::default()
        .with("tolerance", tolerance)
        .with("budget", BUDGET)
        .with("motions", verdicts)
        .with("named", named)
        .csv(&columns, rows)
        .lines([format!(include_str!("../../assets/extremes.txt"), tolerance, BUDGET).trim_end()])
        .table(columns.table(first).unbroken(None))
        .table(summary(verdicts))
        .table(named_columns().table(named))
}

/// A motion, and what a method answered.
type MethodRow<'a> = (&'a MethodsVerdict, &'a MethodAnswer);

/// The columns of answers; text has those of the first method alone, and how well the others did.
fn method_columns<'a>() -> Columns<'a, MethodRow<'a>> {
    let columns = parameter_columns(|(verdict, _): &MethodRow| verdict.case.parameters)
        .word("start", |(verdict, _)| verdict.case.start)
        .file("q0", |(verdict, _)| verdict.case.initial.q)
        .file("v0", |(verdict, _)| verdict.case.initial.v)
        .file("method", |(_, answer)| answer.method)
        .word("answer", |(_, answer)| answer.outcome.word())
        .number("tau", FEW, |(_, answer)| answer.outcome.tau())
        .number("q", FEW, |(_, answer)| answer.outcome.state().map(|at| at.0))
        .number("v", FEW, |(_, answer)| answer.outcome.state().map(|at| at.1))
        .file("reason", |(_, answer)| answer.outcome.answered().err())
        .file("digits_lost", |(_, answer)| answer.digits_lost)
        .file("sensitivity", |(verdict, _)| verdict.sensitivity)
        .file("contradicts", |(_, answer)| answer.contradicts)
        .word("evaluations", |(_, answer)| answer.cost.evaluations)
        .file("steps", |(_, answer)| answer.cost.steps)
        .text("sensitive", |(verdict, _)| significant(verdict.sensitivity, 2));
    METHODS.into_iter().fold(columns, |columns, method| {
        let cell = move |(verdict, _): &MethodRow| verdict.answer(method).map(mark);
        columns.text(method.spec().name, move |row| cell(row).unwrap_or_default())
    })
}

/// The columns of parameters; text has them in the order of the lattice.
fn parameter_columns<'a, R: 'a>(parameters: fn(&R) -> Parameters) -> Columns<'a, R> {
    let example = Parameters::from([0.0; 4]);
    let files = Columns::default().fields(&example, move |row| Some(parameters(row)));
    [Knob::D, Knob::R, Knob::D2, Knob::D3].into_iter().fold(files, |columns, knob| {
        columns.text(knob.spec().name, move |row| short(parameters(row).value(knob), 12))
    })
}

/// How well a method answered.
fn mark(answer: &MethodAnswer) -> String {
    match (answer.digits_lost, kind(answer)) {
        (Some(lost), _) => format!("{lost:.1}"),
        (None, UNCHECKED) => "?".to_owned(),
        (None, why) => why.to_owned(),
    }
}

/// Kinds of answers, the best first.
const KINDS: [&str; 7] =
    ["all digits", "1 lost", "2-4 lost", "more lost", "wrong", UNCHECKED, "gave up"];

/// The kind of an answer with which nothing can be compared.
const UNCHECKED: &str = "unchecked";

/// The one of [`KINDS`] to which an answer belongs.
fn kind(answer: &MethodAnswer) -> &'static str {
    match (answer.digits_lost, answer.outcome) {
        _ if answer.contradicts => "wrong",
        (Some(..=0.0), _) => "all digits",
        (Some(..=1.0), _) => "1 lost",
        (Some(..=4.0), _) => "2-4 lost",
        (Some(_), _) => "more lost",
        (None, Outcome::GaveUp { .. }) => "gave up",
        (None, _) => UNCHECKED,
    }
}

/// How often each method answered, and how well.
fn summary(verdicts: &[MethodsVerdict]) -> Table {
    type Asked<'a> = (Method, Vec<&'a MethodAnswer>);
    let asked = |method| (method, verdicts.iter().filter_map(|it| it.answer(method)).collect());
    let most = |answers: &[&MethodAnswer]| answers.iter().map(|it| it.cost.evaluations).max();
    let columns = Columns::default()
        .text("method", |(method, _): &Asked| *method)
        .text("motions", |(_, answers)| answers.len());
    let columns = KINDS.into_iter().fold(columns, |columns, name| {
        let is = move |answer: &&&MethodAnswer| kind(answer) == name;
        columns.text(name, move |(_, answers)| answers.iter().filter(is).count())
    });
    columns
        .text("evaluations", move |(_, answers)| format!("<= {}", most(answers).unwrap_or(0)))
        .table(METHODS.map(asked))
}

fn named_columns<'a>() -> Columns<'a, NamedExtreme> {
    const NUMBER: Quantity = Quantity::pure(2);
    Columns::default()
        .text("extreme", |it: &NamedExtreme| it.what)
        .text("method", |it| it.method)
        .text("what is measured", |it| it.measure)
        .number("measured", NUMBER, |it| it.measured)
        .number("allowed", NUMBER, |it| it.allowed)
        .text("evaluations", |it| it.cost.evaluations)
}

/// The limit cycles at the extremes: one row for each cycle, and one for a set without cycles.
pub fn extreme_cycles(verdicts: &[SetVerdict]) -> Answer {
    let rows = verdicts.iter().flat_map(|verdict| {
        let cycles = verdict.cycles().iter().map(Some);
        let none = verdict.cycles().is_empty().then_some(None);
        cycles.chain(none).map(move |cycle| (verdict, cycle))
    });
    let sets = verdicts.iter().map(|SetVerdict { parameters, answer, cost }| {
        let kind = if answer.is_ok() { "found" } else { "gave-up" };
        let answer = Document::of("kind", kind)
            .with_any("cycles", answer.as_ref().ok())
            .with_any("reason", answer.as_ref().err());
        Document::of("parameters", parameters).with("answer", answer).with("cost", cost)
    });
    Answer::default()
        .with("budget", BUDGET_OF_SET)
        .with("sets", sets.collect::<Vec<_>>())
        .csv(&set_columns(), rows.clone())
        .lines([format!(include_str!("../../assets/extreme-cycles.txt"), BUDGET_OF_SET).trim_end()])
        .table(set_columns().table(rows).unbroken(None))
        .table(sets_summary(verdicts))
}

/// A set of parameters, and a cycle of it.
type SetRow<'a> = (&'a SetVerdict, Option<&'a LatticeCycle>);

fn set_columns<'a>() -> Columns<'a, SetRow<'a>> {
    let kind = |(verdict, cycle): &SetRow| match (&verdict.answer, cycle) {
        (Err(_), _) => "gave-up",
        (Ok(_), None) => "none",
        (Ok(_), Some(_)) => "cycle",
    };
    let reason = |(verdict, _): &SetRow| verdict.answer.as_ref().err().copied();
    let shown = |(_, cycle): &SetRow, value: fn(&LatticeCycle) -> f64| FEW.text(cycle.map(value));
    parameter_columns(|(verdict, _): &SetRow| verdict.parameters)
        .word("answer", kind)
        .text("stability", |(_, cycle)| Some(stability((*cycle)?.cycle.stable)))
        .text("q_max", move |row| shown(row, |it| it.cycle.q_max))
        .text("ln multiplier", move |row| shown(row, |it| it.cycle.log_multiplier))
        .word("reason", reason)
        .word("evaluations", |(verdict, _)| verdict.cost.evaluations)
        .number("residual", Quantity::pure(2), |(_, cycle)| Some((*cycle)?.residual))
        .and(cycle_fields(|(_, cycle): &SetRow| Some((*cycle)?.cycle)))
}

/// Residual above which the summary counts a cycle as not closed.
const CLOSED: f64 = 1e-11;

/// How often each answer occurred.
fn sets_summary(verdicts: &[SetVerdict]) -> Table {
    let answered = || verdicts.iter().filter(|it| it.answer.is_ok());
    let with = |count: usize| answered().filter(|it| it.cycles().len() == count).count();
    let open = || verdicts.iter().flat_map(SetVerdict::cycles).filter(|it| it.residual > CLOSED);
    let most = || answered().map(|it| it.cost.evaluations).max().unwrap_or(0);
    Columns::default()
        .word("sets", |()| verdicts.len())
        .word("none", |()| with(0))
        .word("one", |()| with(1))
        .word("two", |()| with(2))
        .word("gave up", |()| verdicts.len() - answered().count())
        .word("not closed to 1e-11", |()| open().count())
        .text("evaluations", |()| format!("<= {}", most()))
        .table([()])
}
