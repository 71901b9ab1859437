//! The lattice of extremes: one row for each motion with the answers of all methods, or for each set of parameters with
//! its limit cycles, and a summary.

use std::collections::BTreeMap;

use super::cycle_numbers::cycle_fields;
use super::{Answer, Columns, Document, Quantity};
use crate::accuracy::extremes::sets::{BUDGET as BUDGET_OF_SET, LatticeCycle, SetVerdict};
use crate::accuracy::extremes::verdict::{BUDGET, METHODS};
use crate::accuracy::extremes::{MethodAnswer, MethodsVerdict, NamedExtreme};
use crate::flow::{Method, Outcome};
use crate::model::{Knob, Parameters, Reason};
use crate::words::{exact as short, joined, significant, stability};

/// Few digits of what has more in files.
const FEW: Quantity = Quantity::pure(4);

/// The answers of all methods, and the extremes that have a name; lines go on below themselves at a width.
pub fn extremes(
    verdicts: &[MethodsVerdict],
    named: &[NamedExtreme],
    tolerance: f64,
    width: usize,
) -> Answer {
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
        .table(columns.table(first))
        .table(named_columns().table(named))
        .lines(METHODS.map(|method| conclusion(method, verdicts)))
        .within(width)
}

/// What a person reads of a method: how many motions it answers, how well, and why not the others.
fn conclusion(method: Method, verdicts: &[MethodsVerdict]) -> String {
    let answers = || verdicts.iter().filter_map(|it| it.answer(method));
    let wrong = answers().filter(|answer| answer.contradicts).count();
    let digits = || answers().filter(|it| !it.contradicts).filter_map(|it| it.digits_lost);
    let [exact, one, four] = [0.0, 1.0, 4.0].map(|most| digits().filter(|it| *it <= most).count());
    let lost = significant(digits().fold(0.0, f64::max), 2);
    let answered = answered("motions", answers().map(|answer| answer.outcome.answered().err()));
    format!(
        "{method}: {answered}; {wrong} wrong; {exact} with all digits, {one} with 1 lost at most, {four} with 4, the others with {lost}"
    )
}

/// How many are answered, and why the others are not: each kind of reason with its number of times.
fn answered(what: &str, reasons: impl Iterator<Item = Option<Reason>>) -> String {
    let mut counts = BTreeMap::new();
    for reason in reasons {
        let why = reason.map_or_else(String::new, |why| why.to_string());
        let words = why.split(' ').map(|it| if it.parse::<f64>().is_ok() { ".." } else { it });
        *counts.entry(joined(words, " ")).or_insert(0) += 1;
    }
    let done = counts.remove("").unwrap_or(0);
    let all = done + counts.values().sum::<usize>();
    let left = counts.iter().map(|(why, times)| format!("; {times} gave up, because {why}"));
    format!("{done} of {all} {what} answered{}", joined(left, ""))
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
    match (answer.digits_lost, answer.outcome) {
        (Some(lost), _) => format!("{lost:.1}"),
        _ if answer.contradicts => "wrong".to_owned(),
        (None, Outcome::GaveUp { .. }) => "gave up".to_owned(),
        (None, _) => "?".to_owned(),
    }
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

/// The limit cycles at the extremes: one row for each cycle, and one for a set without cycles; lines go on below themselves
/// at a width.
pub fn extreme_cycles(verdicts: &[SetVerdict], width: usize) -> Answer {
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
        .table(set_columns().table(rows))
        .lines(set_conclusion(verdicts))
        .within(width)
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

/// Residual above which a cycle is counted as not closed.
const CLOSED: f64 = 1e-11;

/// What a person reads of the cycles: whether all are found, why not, and how well they close.
fn set_conclusion(verdicts: &[SetVerdict]) -> [String; 2] {
    let found = answered("sets", verdicts.iter().map(|it| it.answer.as_ref().err().copied()));
    let residuals = || verdicts.iter().flat_map(SetVerdict::cycles).map(|it| it.residual);
    let largest = significant(residuals().fold(0.0, f64::max), 2);
    let (count, open) = (residuals().count(), residuals().filter(|it| *it > CLOSED).count());
    [found, format!("{count} cycles, {open} not closed to {CLOSED:e}; largest residual {largest}")]
}
