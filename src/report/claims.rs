//! The claims of the paper compared with computation: one row for each claim.

use super::{Answer, Columns, Document, Quantity};
use crate::numerics::Interval;
use crate::paper::{Certainty, ClaimResult, Evidence, Verdict};
use crate::words::claim;

/// Something of what was found; `None` if nothing could be computed.
fn found<T>(examined: &ClaimResult, part: impl Fn(&Evidence) -> T) -> Option<T> {
    examined.evidence.as_ref().ok().map(part)
}

fn columns<'a>() -> Columns<'a, ClaimResult> {
    const NUMBER: Quantity = Quantity::pure(6);
    let place = |it: &Evidence| Some(it.place.clone()).filter(|place| !place.is_empty());
    let end = |it: &ClaimResult, end: fn(Interval) -> f64| {
        found(it, |it| it.computed.bounds).flatten().map(end).filter(|end| end.is_finite())
    };
    Columns::default()
        .word("equation", |it: &ClaimResult| it.claim.equation)
        .file("section", |it| it.claim.section)
        .file("claim", |it| it.claim.statement)
        .file("at", move |it| found(it, place).flatten())
        .word("basis", |it| it.claim.basis)
        .file("sense", |it| found(it, |it| it.sense))
        .text("sense", |it| found(it, |it| claim::sense(it.sense)).unwrap_or("-".to_owned()))
        .text("verdict", claim::verdict)
        .text("proof", |it| it.mark().map_or("-", Certainty::name).to_owned())
        .file("cases", |it| found(it, |it| it.cases))
        .file("held", |it| found(it, |it| it.held))
        .number("paper", NUMBER, |it| found(it, |it| it.paper).flatten())
        .number("corrected", NUMBER, |it| found(it, |it| it.corrected).flatten())
        .number("computed", NUMBER, |it| found(it, |it| it.computed.value))
        .file("error", |it| found(it, |it| it.computed.error))
        .file("difference", |it| found(it, Evidence::difference).flatten())
        .file("bound", |it| found(it, Evidence::bound))
        .file("verdict", |it| claim::name(it))
        .file("within", |it| it.verdict().and_then(Verdict::within))
        .file("scene", |it| it.claim.scene)
        .file("proof", |it| it.mark().map(Certainty::name))
        .file("lower", move |it| end(it, Interval::lower))
        .file("upper", move |it| end(it, Interval::upper))
        // Last in text, as its length varies.
        .text("claim", sentence)
}

/// Every claim, and the reason if nothing could be computed; sentences are wrapped to a width, if one is given.
pub fn claims(examined: &[ClaimResult], width: Option<usize>, seconds: f64) -> Answer {
    let reason = |it: &ClaimResult| it.evidence.as_ref().err().map(ToString::to_string);
    Answer::default()
        .with("claims", columns().field("reason", reason).objects(examined))
        .csv(&columns(), examined)
        .table(columns().table(examined).unbroken(width))
        .costing(&claim::summary(examined), Document::default(), seconds)
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
