//! The paper against computation, as text: one row for each claim.

use serde::Serialize;

use super::csv::{exact_or_empty, line};
use crate::flow::Reason;
use crate::study::claims::{Examined, Finding, Sense, Verdict};
use crate::view::number::{duration, significant};

/// One claim, as a document.
#[derive(Serialize)]
struct Row<'a> {
    equation: &'a str,
    section: &'a str,
    claim: &'a str,
    at: Option<&'a str>,
    sense: Option<&'static str>,
    cases: Option<usize>,
    paper: Option<f64>,
    corrected: Option<f64>,
    computed: Option<f64>,
    error: Option<f64>,
    difference: Option<f64>,
    bound: Option<f64>,
    verdict: &'static str,
    within: Option<f64>,
    scene: Option<&'a str>,
    reason: Option<String>,
}

#[derive(Serialize)]
struct Document<'a> {
    claims: Vec<Row<'a>>,
    cost: Cost,
}

#[derive(Serialize)]
struct Cost {
    seconds: f64,
}

/// What no number could be computed for.
const UNKNOWN: &str = "unknown";

fn sense(sense: Sense) -> &'static str {
    match sense {
        Sense::Equal => "equal",
        Sense::Near => "near",
        Sense::AtMost => "at-most",
        Sense::Tends { .. } => "tends",
        Sense::Always => "always",
    }
}

fn row(examined: &Examined) -> Row<'_> {
    let claim = examined.claim;
    let finding = examined.finding.as_ref().ok();
    let verdict = finding.map(Finding::verdict);
    Row {
        equation: claim.equation,
        section: claim.section,
        claim: claim.statement,
        at: finding.map(|finding| finding.place.as_str()).filter(|place| !place.is_empty()),
        sense: finding.map(|finding| sense(finding.sense)),
        cases: finding.map(|finding| finding.cases),
        paper: finding.and_then(|finding| finding.paper),
        corrected: finding.and_then(|finding| finding.corrected),
        computed: finding.map(|finding| finding.computed.value),
        error: finding.map(|finding| finding.computed.error),
        difference: finding.and_then(Finding::difference),
        bound: finding.map(Finding::bound),
        verdict: verdict.map_or(UNKNOWN, Verdict::name),
        within: verdict.and_then(Verdict::within),
        scene: claim.scene,
        reason: examined.finding.as_ref().err().map(Reason::to_string),
    }
}

/// One document with every claim.
#[must_use]
pub fn json(examined: &[Examined], seconds: f64) -> String {
    let claims = examined.iter().map(row).collect();
    super::json::text(&Document { claims, cost: Cost { seconds } })
}

/// One row for each claim.
#[must_use]
pub fn csv(examined: &[Examined]) -> String {
    let titles = [
        "equation",
        "section",
        "claim",
        "at",
        "sense",
        "cases",
        "paper",
        "corrected",
        "computed",
        "error",
        "difference",
        "bound",
        "verdict",
        "within",
        "scene",
    ];
    let rows = examined.iter().map(row).map(|row| {
        let text = |text: Option<&str>| text.unwrap_or_default().to_owned();
        line(&[
            row.equation.to_owned(),
            row.section.to_owned(),
            row.claim.to_owned(),
            text(row.at),
            text(row.sense),
            row.cases.map(|cases| cases.to_string()).unwrap_or_default(),
            exact_or_empty(row.paper),
            exact_or_empty(row.corrected),
            exact_or_empty(row.computed),
            exact_or_empty(row.error),
            exact_or_empty(row.difference),
            exact_or_empty(row.bound),
            row.verdict.to_owned(),
            exact_or_empty(row.within),
            text(row.scene),
        ])
    });
    std::iter::once(line(&titles.map(str::to_owned))).chain(rows).collect()
}

/// Columns for reading: the numbers first, because what is claimed has no fixed length.
#[must_use]
pub fn table(examined: &[Examined], seconds: f64) -> String {
    let titles = ["where", "verdict", "paper", "corrected", "computed", "claim"];
    let rows = examined.iter().map(|examined| {
        let number =
            |value: Option<f64>| value.map_or("-".to_owned(), |value| significant(value, 6));
        let finding = examined.finding.as_ref().ok();
        [
            examined.claim.equation.to_owned(),
            words(examined),
            number(finding.and_then(|finding| finding.paper)),
            number(finding.and_then(|finding| finding.corrected)),
            number(finding.map(|finding| finding.computed.value)),
            sentence(examined),
        ]
    });
    let rows: Vec<_> = std::iter::once(titles.map(str::to_owned)).chain(rows).collect();
    let width =
        |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths = [0, 1, 2, 3, 4].map(width);
    let mut out = String::new();
    for [place, verdict, paper, corrected, computed, claim] in &rows {
        let [a, b, c, d, e] = widths;
        out += &format!(
            "{place:a$}  {verdict:b$}  {paper:>c$}  {corrected:>d$}  {computed:>e$}  {claim}\n"
        );
    }
    out + &format!("\n{}, {}\n", summary(examined), duration(seconds))
}

/// The claim, and where it was tested.
#[must_use]
pub fn sentence(examined: &Examined) -> String {
    let statement = examined.claim.statement;
    match &examined.finding {
        Ok(finding) if finding.place.is_empty() => statement.to_owned(),
        Ok(finding) => format!("{statement} [{}]", finding.place),
        Err(reason) => format!("{statement} [not computed: {reason}]"),
    }
}

/// The verdict in words.
#[must_use]
pub fn words(examined: &Examined) -> String {
    let percent = |part: f64| format!("{} %", significant(100.0 * part, 2));
    let Ok(finding) = &examined.finding else { return UNKNOWN.to_owned() };
    let counts = || format!("{} of {}", finding.computed.value, finding.cases);
    match finding.verdict() {
        Verdict::Agrees if finding.paper.is_none() => "holds".to_owned(),
        Verdict::Agrees => "agrees".to_owned(),
        Verdict::Approximates { within } if finding.scale() == 1.0 => {
            format!("within {}", significant(within, 2))
        }
        Verdict::Approximates { within } => format!("within {}", percent(within)),
        Verdict::Corrected { within: None } => "corrected: holds".to_owned(),
        Verdict::Corrected { within: Some(within) } => format!("corrected: {}", percent(within)),
        Verdict::InPart => format!("in {}", counts()),
        Verdict::False if finding.sense == Sense::Always => format!("false: {}", counts()),
        Verdict::False if finding.computed.value == 0.0 => "false".to_owned(),
        Verdict::False => format!("false: {} off", percent(finding.miss())),
    }
}

/// How many claims have which verdict.
#[must_use]
pub fn summary(examined: &[Examined]) -> String {
    const NAMES: [(&str, &str); 6] = [
        ("agrees", "agree"),
        ("approximates", "hold approximately"),
        ("corrected", "hold when corrected"),
        ("in-part", "hold in part"),
        ("false", "are false"),
        (UNKNOWN, "could not be computed"),
    ];
    let count = |name: &str| examined.iter().filter(|one| row(one).verdict == name).count();
    let counts = NAMES.iter().map(|&(name, words)| (count(name), words));
    let parts =
        counts.filter(|(count, _)| *count > 0).map(|(count, words)| format!("{count} {words}"));
    format!("{} claims: {}", examined.len(), parts.collect::<Vec<_>>().join(", "))
}
