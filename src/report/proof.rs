//! Proofs about limit cycles, for tables and documents.

use serde::Serialize;

use crate::numerics::Interval;
use crate::numerics::elementary::log10;
use crate::oscillator::ParameterBox;
use crate::portrait::Cycle;
use crate::proof::cycles::{Open, Proof};
use crate::proof::enclose::Enclosure;
use crate::study::proved::matching;
use crate::words::cycles;
use crate::words::number::significant;

/// A cycle with what is proved about it.
#[derive(Serialize)]
pub(super) struct ProvedCycleDocument<'a> {
    #[serde(flatten)]
    cycle: &'a Cycle,
    /// Whether it is proved to exist, to be the only one nearby, and to lie in its enclosure.
    proved: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    enclosure: Option<Enclosure>,
}

/// What is proved about a cycle, or an interval of clearances that is open, with a column for each bound.
#[derive(Serialize)]
pub(super) struct CycleBounds {
    proved: bool,
    open: Option<&'static str>,
    #[serde(flatten)]
    enclosure: Option<Enclosure>,
    #[serde(flatten)]
    clearances: Option<Clearances>,
}

#[derive(Serialize)]
struct Clearances {
    clearance: Interval,
}

impl CycleBounds {
    /// An example with all columns, for the heading.
    pub(super) fn like() -> Self {
        let q = Interval::ALL;
        let all = Enclosure {
            q_max: q,
            q_min: q,
            v_max: q,
            v_min: q,
            period: q,
            multiplier: q,
            clearance: q,
        };
        CycleBounds::of(Some(all))
    }

    pub(super) fn of(enclosure: Option<Enclosure>) -> Self {
        CycleBounds { proved: enclosure.is_some(), open: None, enclosure, clearances: None }
    }

    pub(super) fn open(proof: &Proof) -> impl Iterator<Item = Self> {
        proof.open.iter().map(|open| CycleBounds {
            proved: false,
            open: Some(open.reason),
            enclosure: None,
            clearances: Some(Clearances { clearance: Interval::new(open.lower, open.upper) }),
        })
    }
}

/// The number of cycles, with what is proved about it.
#[derive(Serialize)]
pub(super) struct Count<'a> {
    /// Whether it is proved that there are these cycles and no others.
    proved: bool,
    /// Intervals of clearances about which nothing is known.
    open: &'a [Open],
    /// The parameters for which this holds: the doubles nearest to the decimal numbers given.
    parameters: ParameterBox,
}

/// Every cycle with what is proved about it.
pub(super) fn rows<'a>(cycles: &'a [Cycle], proof: &Proof) -> Vec<ProvedCycleDocument<'a>> {
    let row = |cycle| {
        let enclosure = enclosure(proof, cycle);
        ProvedCycleDocument { cycle, proved: enclosure.is_some(), enclosure }
    };
    cycles.iter().map(row).collect()
}

pub(super) fn enclosure(proof: &Proof, cycle: &Cycle) -> Option<Enclosure> {
    matching(proof, cycle).and_then(|proved| proved.enclosure)
}

/// The proof of the number of cycles.
pub(super) fn count(proof: &Proof) -> Count<'_> {
    Count { proved: proof.is_complete(), open: &proof.open, parameters: proof.parameters }
}

/// `2 cycles, proved ..`, or what is open.
pub(super) fn sentence(found: usize, proof: &Proof) -> String {
    let cycles = cycles(found);
    if proof.is_complete() {
        return format!("{cycles}, proved for the parameters as doubles\n");
    }
    let mut out = format!("{cycles} found; not proved that there are no others:\n");
    for open in &proof.open {
        let (lower, upper) = (significant(open.lower, 6), significant(open.upper, 6));
        let range = if open.upper.is_finite() {
            let width = significant(open.upper - open.lower, 2);
            format!("from {lower} to {upper} (width {width})")
        } else {
            format!("from {lower} on")
        };
        out += &format!("  clearances {range} are open: {}\n", open.reason);
    }
    out
}

/// The digits on which both ends of an enclosure agree, at most `most`. If there are none: a power of ten as a
/// bound of a number that overflows or underflows, else `?`.
pub(super) fn certain(value: Interval, most: usize) -> String {
    let ends = |digits| [value.lower(), value.upper()].map(|end| significant(end, digits));
    let agreed = (1..=most).rev().map(ends).find(|[lower, upper]| lower == upper);
    agreed.map(|[digits, _]| digits).or_else(|| beyond(value)).unwrap_or_else(|| "?".to_owned())
}

/// `> 1e149` for an enclosure without an upper end that lies above 1e100, `< 1e-322` for one that reaches from 0
/// to less than 1e-100.
fn beyond(value: Interval) -> Option<String> {
    const HUGE: f64 = 1e100;
    let power = |of: f64| log10(of).floor();
    if value.lower() > HUGE && value.upper() == f64::INFINITY {
        return Some(format!("> 1e{}", power(value.lower()) - 1.0));
    }
    let tiny = value.lower() == 0.0 && value.upper() < 1.0 / HUGE;
    tiny.then(|| format!("< 1e{}", power(value.upper()) + 2.0))
}

/// A line that explains `?`; empty if the table has none.
pub(super) fn uncertain(table: &str) -> &'static str {
    if table.contains('?') {
        "?: no digit of it is certain; bounds of half swings as stiff as these say little of it\n"
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_digits_on_which_both_ends_agree_are_shown() {
        assert_eq!(certain(Interval::new(0.123_449, 0.123_451), 10), "0.12345");
        assert_eq!(certain(Interval::new(0.123_44, 0.123_46), 10), "0.123");
        assert_eq!(certain(Interval::new(1.0, 3.0), 10), "?");
        assert_eq!(certain(Interval::new(1.0, f64::INFINITY), 10), "?");
        assert_eq!(certain(Interval::new(1.3e150, f64::INFINITY), 10), "> 1e149");
        assert_eq!(certain(Interval::new(0.0, 5e-324), 10), "< 1e-322");
        assert_eq!(certain(Interval::point(0.1), 10), "0.1");
    }
}
