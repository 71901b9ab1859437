//! The claims of the paper compared with computation: one row for each claim.

use serde::Serialize;

use super::csv;
use super::json::{Seconds, text};
use crate::flow::Reason;
use crate::numerics::Interval;
use crate::study::claims::{Certainty, ClaimResult, Finding, Sense, Verdict};
use crate::words::claim;
use crate::words::number::{duration, significant};

#[derive(Default, Serialize)]
struct ClaimRow<'a> {
    equation: &'a str,
    section: &'a str,
    claim: &'a str,
    at: Option<&'a str>,
    basis: &'a str,
    sense: Option<&'static str>,
    cases: Option<usize>,
    held: Option<usize>,
    paper: Option<f64>,
    corrected: Option<f64>,
    computed: Option<f64>,
    error: Option<f64>,
    difference: Option<f64>,
    bound: Option<f64>,
    verdict: &'static str,
    within: Option<f64>,
    scene: Option<&'a str>,
    /// What is certain: `proved`, `refuted` or `enclosed`.
    proof: Option<&'static str>,
    /// Bounds of the computed number.
    lower: Option<f64>,
    upper: Option<f64>,
}

/// A claim, with the reason if nothing could be computed.
#[derive(Serialize)]
struct ReasonedClaim<'a> {
    #[serde(flatten)]
    row: ClaimRow<'a>,
    reason: Option<String>,
}

#[derive(Serialize)]
struct ClaimDocument<'a> {
    claims: Vec<ReasonedClaim<'a>>,
    cost: Seconds,
}

fn sense(sense: Sense) -> &'static str {
    match sense {
        Sense::Equal => "equal",
        Sense::Near => "near",
        Sense::AtMost => "at-most",
        Sense::Tends { .. } => "tends",
        Sense::Always => "always",
    }
}

fn row(examined: &ClaimResult) -> ClaimRow<'_> {
    let claim = examined.claim;
    let finding = examined.finding.as_ref().ok();
    let verdict = finding.map(Finding::verdict);
    let bounds = finding.and_then(|finding| finding.computed.bounds);
    ClaimRow {
        equation: claim.equation,
        section: claim.section,
        claim: claim.statement,
        basis: claim.basis,
        at: finding.map(|finding| finding.place.as_str()).filter(|place| !place.is_empty()),
        sense: finding.map(|finding| sense(finding.sense)),
        cases: finding.map(|finding| finding.cases),
        held: finding.map(|finding| finding.held),
        paper: finding.and_then(|finding| finding.paper),
        corrected: finding.and_then(|finding| finding.corrected),
        computed: finding.map(|finding| finding.computed.value),
        error: finding.map(|finding| finding.computed.error),
        difference: finding.and_then(Finding::difference),
        bound: finding.map(Finding::bound),
        proof: finding.and_then(|finding| finding.mark).map(Certainty::name),
        lower: bounds.map(Interval::lower).filter(|end| end.is_finite()),
        upper: bounds.map(Interval::upper).filter(|end| end.is_finite()),
        verdict: claim::name(examined),
        within: verdict.and_then(Verdict::within),
        scene: claim.scene,
    }
}

/// One document with every claim.
pub fn json(examined: &[ClaimResult], seconds: f64) -> String {
    let reason = |examined: &ClaimResult| examined.finding.as_ref().err().map(Reason::to_string);
    let claim = |examined| ReasonedClaim { row: row(examined), reason: reason(examined) };
    let claims = examined.iter().map(claim).collect();
    text(&ClaimDocument { claims, cost: Seconds { seconds } })
}

/// One row for each claim.
pub fn csv(examined: &[ClaimResult]) -> String {
    csv::sheet(&ClaimRow::default(), examined.iter().map(row))
}

/// A table with the numbers first and the claim last, as its length varies.
pub fn table(examined: &[ClaimResult], seconds: f64) -> String {
    let titles =
        ["where", "basis", "sense", "verdict", "proof", "paper", "corrected", "computed", "claim"];
    let rows = examined.iter().map(|examined| {
        let number =
            |value: Option<f64>| value.map_or("-".to_owned(), |value| significant(value, 6));
        let finding = examined.finding.as_ref().ok();
        [
            examined.claim.equation.to_owned(),
            examined.claim.basis.to_owned(),
            finding.map_or("-".to_owned(), |finding| claim::sense(finding.sense)),
            claim::verdict(examined),
            mark(finding),
            number(finding.and_then(|finding| finding.paper)),
            number(finding.and_then(|finding| finding.corrected)),
            number(finding.map(|finding| finding.computed.value)),
            sentence(examined),
        ]
    });
    let rows: Vec<_> = std::iter::once(titles.map(str::to_owned)).chain(rows).collect();
    let width =
        |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; 8] = std::array::from_fn(width);
    let mut out = String::new();
    for row in &rows {
        for (column, (cell, width)) in row.iter().zip(widths).enumerate() {
            // Words to the left, numbers to the right.
            out +=
                &if column < 5 { format!("{cell:width$}  ") } else { format!("{cell:>width$}  ") };
        }
        out += &format!("{}\n", row[8]);
    }
    out + &format!("\n{}, {}\n", claim::summary(examined), duration(seconds))
}

/// `proved`, `refuted`, `enclosed`, or `-`.
fn mark(finding: Option<&Finding>) -> String {
    finding.and_then(|finding| finding.mark).map_or("-", Certainty::name).to_owned()
}

/// The claim, and where it was tested.
pub fn sentence(examined: &ClaimResult) -> String {
    let statement = examined.claim.statement;
    match &examined.finding {
        Ok(finding) if finding.place.is_empty() => statement.to_owned(),
        Ok(finding) => format!("{statement} [{}]", finding.place),
        Err(reason) => format!("{statement} [not computed: {reason}]"),
    }
}
