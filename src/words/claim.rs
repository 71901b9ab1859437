//! The verdicts on the claims of the paper.

use super::{joined, significant};
use crate::paper::{ClaimResult, POOR, Sense, Verdict};

/// The name of the verdict if no number could be computed.
const UNKNOWN: &str = "unknown";

/// The name of the verdict in documents.
pub fn name(examined: &ClaimResult) -> &'static str {
    examined.verdict().map_or(UNKNOWN, Verdict::name)
}

pub fn verdict(examined: &ClaimResult) -> String {
    let percent = |part: f64| format!("{} %", significant(100.0 * part, 2));
    let Ok(evidence) = &examined.evidence else { return UNKNOWN.to_owned() };
    let counts = || format!("{} of {}", evidence.held, evidence.cases);
    match evidence.verdict() {
        Verdict::Agrees if evidence.paper.is_none() => "holds".to_owned(),
        Verdict::Agrees => "agrees".to_owned(),
        Verdict::Approximates { within } if evidence.scale() == 1.0 => {
            format!("within {}", significant(within, 2))
        }
        Verdict::Approximates { within } => format!("within {}", percent(within)),
        Verdict::Corrected { within: None } => "corrected: holds".to_owned(),
        Verdict::Corrected { within: Some(within) } => format!("corrected: {}", percent(within)),
        Verdict::InPart if evidence.sense == Sense::Always => format!("in {}", counts()),
        Verdict::InPart => format!("in {}: {} off", counts(), percent(evidence.miss())),
        Verdict::False if evidence.sense == Sense::Always => format!("false: {}", counts()),
        Verdict::False if evidence.computed.value == 0.0 => "false".to_owned(),
        Verdict::False => format!("false: {} off", percent(evidence.miss())),
    }
}

/// What is claimed about the paper's number and the computed one, and the bound within which that is judged.
pub fn sense(sense: Sense) -> String {
    match sense {
        Sense::Equal => "equal".to_owned(),
        Sense::Near => format!("within {} %", significant(100.0 * POOR, 2)),
        Sense::AtMost => "at most".to_owned(),
        Sense::Tends => "approaches".to_owned(),
        Sense::Always => "in all cases".to_owned(),
    }
}

/// A line that counts the claims by verdict and by mark.
pub fn summary(examined: &[ClaimResult]) -> String {
    const NAMES: [(&str, &str); 9] = [
        ("agrees", "agree"),
        ("approximates", "hold approximately"),
        ("corrected", "hold when corrected"),
        ("in-part", "hold in part"),
        ("false", "are false"),
        (UNKNOWN, "could not be computed"),
        ("proved", "proved"),
        ("refuted", "refuted"),
        ("enclosed", "enclosed"),
    ];
    let parts = NAMES.into_iter().filter_map(|(name, words)| {
        let carries = |one: &&ClaimResult| {
            self::name(one) == name || one.mark().is_some_and(|mark| mark.name() == name)
        };
        let count = examined.iter().filter(carries).count();
        (count > 0).then(|| format!("{count} {words}"))
    });
    format!("{} claims: {}", examined.len(), joined(parts, ", "))
}
