//! Proofs about limit cycles, for tables and documents.

use super::cycle_numbers::NUMBERS;
use super::{Answer, Columns, Document};
use crate::check::{Bounds, Certificate, StepKind};
use crate::numerics::Interval;
use crate::numerics::elementary::{log10, pow};
use crate::portrait::Cycle;
use crate::portrait::proved::matching;
use crate::proof::cycles::{OpenGap, ProvedCycle};
use crate::proof::{Enclosure, Proof};
use crate::words::{cycles, significant, stability};

/// Digits of enclosures.
pub(super) const PLACES: usize = 12;

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
    let of = |it: &CycleBounds, name: &str, bounds: fn(&Enclosure) -> Interval| match it {
        CycleBounds::Cycle(enclosure) => enclosure.as_ref().map(bounds),
        CycleBounds::Open(it) if name == "clearance" => Some(Interval::new(it.lower, it.upper)),
        CycleBounds::Open(_) => None,
    };
    ["q_max", "q_min", "v_max", "v_min", "period", "multiplier", "clearance"]
        .into_iter()
        .filter_map(|name| NUMBERS.iter().find(|number| number.name == name))
        .filter_map(|number| Some((number.name, number.bounds?)))
        .fold(columns, |all, (name, bounds)| all.bounds(name, move |it| of(it, name, bounds)))
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

/// The cycles that exist for all parameters in a box.
pub fn boxed(proof: &Proof) -> Answer<'_> {
    let cycle = |cycle: &ProvedCycle| {
        Document::default()
            .with("stable", cycle.stable)
            .with("proved", true)
            .with_any("enclosure", cycle.enclosure)
    };
    let json = move || {
        Document::default()
            .with("cycles", proof.cycles.iter().map(cycle).collect::<Vec<_>>())
            .with("count", count(proof))
            .text()
    };
    let csv = || {
        type BoxRow<'a> = (Option<bool>, CycleBounds<'a>);
        let columns = Columns::default().file("stable", |(stable, _): &BoxRow| *stable).part(
            "certified",
            cycle_columns(),
            |(_, bounds)| Some(*bounds),
        );
        let cycles = proof.cycles.iter();
        let cycles = cycles.map(|cycle| (Some(cycle.stable), CycleBounds::Cycle(cycle.enclosure)));
        let open = proof.open.iter().map(|open| (None, CycleBounds::Open(open)));
        columns.csv(cycles.chain(open))
    };
    Answer::new(json, csv, || box_table(proof))
}

fn box_table(proof: &Proof) -> String {
    let ends = |it: Interval| {
        if !it.is_finite() {
            return certain(it, PLACES);
        }
        let [lower, upper] = outward(it);
        format!("{lower} .. {upper}")
    };
    let kind = |cycle: &&ProvedCycle| stability(cycle.stable).to_owned();
    // Without the clearance, which is q_max but for r.
    let bounded = NUMBERS.iter().filter(|number| number.name != "clearance");
    let bounded = bounded.filter_map(|number| Some((number.name, number.bounds?)));
    let table = bounded.fold(Columns::default().text("cycle", kind), |all, (name, bounds)| {
        all.text(name, move |cycle| cycle.enclosure.map_or("?".to_owned(), |it| ends(bounds(&it))))
    });
    let table = table.table(&proof.cycles).aligned_left();
    let p = proof.parameters;
    let heading = [("D", p.d), ("D2", p.d2), ("D3", p.d3), ("r", p.r)].map(|(name, it)| {
        if it.is_point() {
            format!("{name} = {}", it.lower())
        } else {
            format!("{name} = {} .. {}", it.lower(), it.upper())
        }
    });
    let text = if proof.cycles.is_empty() {
        String::new()
    } else {
        format!("{table}\n{}", uncertain(&table))
    };
    let line = sentence(proof.cycles.len(), proof);
    let line = line.replace("for the parameters as doubles", "for all of these parameters");
    format!("{}\n\n{text}{line}", heading.join(", "))
}

/// The ends of an interval, rounded outward to six digits.
fn outward(it: Interval) -> [String; 2] {
    let step = |value: f64| {
        let digits = pow(10.0, log10(value.abs()).floor() - 5.0);
        if digits.is_finite() { digits } else { 0.0 }
    };
    let end = |value: f64, sign: f64| {
        let near = significant(value, 6);
        let read: f64 = near.parse().unwrap_or(f64::NAN);
        let inside = sign * (value - read) > 0.0;
        if inside { significant(value + sign * step(value), 6) } else { near }
    };
    [end(it.lower(), -1.0), end(it.upper(), 1.0)]
}

/// The statement of a certificate that has been checked.
pub fn certificate_table(certificate: &Certificate) -> String {
    let interval = |[lower, upper]: Bounds| Interval::new(lower, upper);
    let value = |(name, it): (&str, Bounds)| {
        if it[0] == it[1] {
            format!("{name} = {:?}", it[0])
        } else {
            format!("{name} in {}", interval(it))
        }
    };
    let proved = certificate.steps.iter().filter_map(|step| Some((step.kind, step.clearance?)));
    let table = Columns::default()
        .text("cycle", |(kind, _): &(StepKind, Bounds)| {
            stability(*kind == StepKind::Stable).to_owned()
        })
        .text("right clearance", |(_, clearance)| certain(interval(*clearance), PLACES))
        .table(proved);
    let count = match certificate.cycles {
        0 => "no limit cycle".to_owned(),
        1 => "1 limit cycle".to_owned(),
        more => format!("{more} limit cycles"),
    };
    let table = if table.is_empty() { String::new() } else { format!("{table}\n") };
    let steps = certificate.steps.len();
    let values = ["D", "D2", "D3", "r"].into_iter().zip(certificate.parameters).map(value);
    let values = values.collect::<Vec<_>>().join(", ");
    format!("{values}\n\n{table}{count} and no other, at any amplitude: {steps} steps checked\n")
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
