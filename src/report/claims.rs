//! The claims of the paper compared with computation: one row for each claim.

use super::{Answer, Columns, Document, Quantity};
use crate::numerics::Interval;
use crate::paper::{Certainty, ClaimResult, Evidence, Verdict};
use crate::words::claim;

/// What was found; `None` if nothing could be computed.
fn found(examined: &ClaimResult) -> Option<&Evidence> {
    examined.evidence.as_ref().ok()
}

fn columns<'a>() -> Columns<'a, ClaimResult> {
    const NUMBER: Quantity = Quantity::pure(6);
    let place = |it: &ClaimResult| Some(found(it)?.place.clone()).filter(|it| !it.is_empty());
    let end = |it: &ClaimResult, end: fn(Interval) -> f64| {
        found(it)?.computed.bounds.map(end).filter(|end| end.is_finite())
    };
    Columns::default()
        .word("equation", |it: &ClaimResult| it.claim.equation)
        .file("section", |it| it.claim.section)
        .file("claim", |it| it.claim.statement)
        .file("at", place)
        .word("basis", |it| it.claim.basis)
        .file("sense", |it| Some(found(it)?.sense))
        .text("sense", |it| Some(claim::sense(found(it)?.sense)))
        .text("verdict", claim::verdict)
        .text("proof", |it| it.mark().map(Certainty::name))
        .file("cases", |it| Some(found(it)?.cases))
        .file("held", |it| Some(found(it)?.held))
        .number("paper", NUMBER, |it| found(it)?.paper)
        .number("corrected", NUMBER, |it| found(it)?.corrected)
        .number("computed", NUMBER, |it| Some(found(it)?.computed.value))
        .file("error", |it| Some(found(it)?.computed.error))
        .file("difference", |it| found(it)?.difference())
        .file("bound", |it| Some(found(it)?.bound()))
        .file("verdict", claim::name)
        .file("within", |it| it.verdict().and_then(Verdict::within))
        .file("scene", |it| it.claim.scene)
        .file("proof", |it| it.mark().map(Certainty::name))
        .file("lower", move |it| end(it, Interval::lower))
        .file("upper", move |it| end(it, Interval::upper))
        // Last in text, as its length varies.
        .text("claim", sentence)
}

/// Every claim, and the reason if nothing could be computed; lines go on below themselves at a width.
pub fn claims(examined: &[ClaimResult], width: usize, seconds: f64) -> Answer {
    let reason = |it: &ClaimResult| it.evidence.as_ref().err().copied();
    Answer::default()
        .with("claims", columns().field("reason", reason).objects(examined))
        .csv(&columns(), examined)
        .table(columns().table(examined))
        .costing(&claim::summary(examined), Document::default(), seconds)
        .within(width)
}

/// The claim, and where it was tested.
fn sentence(examined: &ClaimResult) -> String {
    let statement = examined.claim.statement;
    match &examined.evidence {
        Ok(evidence) if evidence.place.is_empty() => statement.to_owned(),
        Ok(evidence) => format!("{statement} [{}]", evidence.place),
        Err(reason) => format!("{statement} [not computed: {reason}]"),
    }
}
