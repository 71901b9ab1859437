//! Proofs about limit cycles, for tables and documents.

use super::columns::Columns;
use super::cycle_numbers::{CycleNumber, NUMBERS};
use super::json::Document;
use crate::numerics::Interval;
use crate::numerics::elementary::log10;
use crate::portrait::Cycle;
use crate::portrait::proved::matching;
use crate::proof::cycles::OpenGap;
use crate::proof::{Enclosure, Proof};
use crate::words::cycles;
use crate::words::number::significant;

/// What is proved about a cycle, or an interval of clearances that is open.
#[derive(Clone, Copy)]
pub(super) enum CycleBounds<'a> {
    Cycle(Option<Enclosure>),
    Open(&'a OpenGap),
}

/// The columns of what is proved, one for each bound.
pub(super) fn cycle_columns<'a>() -> Columns<'a, CycleBounds<'a>> {
    let columns = Columns::default()
        .file("proved", |it| matches!(it, CycleBounds::Cycle(Some(_))))
        .file("open", |it| if let CycleBounds::Open(open) = it { Some(open.reason) } else { None });
    let of = |it: &CycleBounds, number: &CycleNumber| match it {
        CycleBounds::Cycle(enclosure) => enclosure.as_ref().map(number.bounds),
        CycleBounds::Open(it) if number.name == "clearance" => {
            Some(Interval::new(it.lower, it.upper))
        }
        CycleBounds::Open(_) => None,
    };
    ["q_max", "q_min", "v_max", "v_min", "period", "multiplier", "clearance"]
        .into_iter()
        .filter_map(|name| NUMBERS.iter().find(|number| number.name == name))
        .fold(columns, |all, number| all.bounds(number.name, move |it| of(it, number)))
}

/// Every cycle with what is proved about it: whether it exists, is the only one nearby, and lies in its enclosure.
pub(super) fn documents(cycles: &[Cycle], proof: &Proof) -> Vec<Document> {
    let document = |cycle| {
        let enclosure = enclosure(proof, cycle);
        Document::default()
            .and(cycle)
            .with("proved", enclosure.is_some())
            .with_any("enclosure", enclosure)
    };
    cycles.iter().map(document).collect()
}

pub(super) fn enclosure(proof: &Proof, cycle: &Cycle) -> Option<Enclosure> {
    matching(proof, cycle).and_then(|proved| proved.enclosure)
}

/// Whether it is proved that there are these cycles and no others, the intervals of clearances about which nothing is
/// known, and the parameters for which this holds: the doubles nearest to the decimal numbers given.
pub(super) fn count(proof: &Proof) -> Document {
    Document::default()
        .with("proved", proof.is_complete())
        .with("open", &proof.open)
        .with("parameters", proof.parameters)
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
