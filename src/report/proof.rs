//! Proofs about limit cycles, for tables and documents.

use super::columns::{certain, ends};
use super::cycle_numbers::{CycleNumber, NUMBERS, cycle_fields, number_columns};
use super::{About, Answer, Columns, Document, Format};
use crate::check::{Bounds, Certificate, StepKind};
use crate::model::ParameterBox;
use crate::numerics::Interval;
use crate::portrait::Cycle;
use crate::portrait::proved::matching;
use crate::proof::cycles::{OpenGap, ProvedCycle};
use crate::proof::{Enclosure, Proof};
use crate::words::{counted, cycles, significant, stability};

/// A cycle with what is proved about it, or an interval of clearances that is open.
#[derive(Default)]
pub(super) struct ProvedRow<'a> {
    stable: Option<bool>,
    /// `None` if it is one for each of many parameters.
    cycle: Option<&'a Cycle>,
    enclosure: Option<Enclosure>,
    open: Option<&'a OpenGap>,
}

impl<'a> ProvedRow<'a> {
    /// Every cycle that was found.
    pub(super) fn found(found: &'a [Cycle], proof: &Proof) -> Vec<Self> {
        let enclosure = |cycle| matching(proof, cycle).and_then(|proved| proved.enclosure);
        let row = |cycle: &'a Cycle| ProvedRow {
            stable: Some(cycle.stable),
            cycle: Some(cycle),
            enclosure: enclosure(cycle),
            open: None,
        };
        found.iter().map(row).collect()
    }

    fn proved(cycle: &ProvedCycle) -> Self {
        let ProvedCycle { stable, enclosure, .. } = *cycle;
        ProvedRow { stable: Some(stable), enclosure, ..ProvedRow::default() }
    }

    /// Where a number is proved to lie; of an open interval, the clearance.
    fn bounds(&self, CycleNumber { name, bounds, .. }: &CycleNumber) -> Option<Interval> {
        let open = self.open.filter(|_| *name == "clearance");
        let open = open.map(|it| Interval::new(it.lower, it.upper));
        open.or(self.enclosure.as_ref().map(bounds))
    }

    /// Whether it exists, is the only one nearby, and lies in its enclosure.
    fn document(&self) -> Document {
        let own = match self.cycle {
            Some(cycle) => Document::default().and(cycle),
            None => Document::default().with("stable", self.stable),
        };
        own.with("proved", self.cycle.is_none() || self.enclosure.is_some())
            .with_any("enclosure", self.enclosure)
    }

    /// A number to the digits that are certain, or as it was found.
    fn text(&self, number: &CycleNumber) -> String {
        /// Cycles are computed to rounding error.
        const FOUND: usize = 10;
        match (self.bounds(number), self.cycle) {
            (Some(bounds), Some(_)) => certain(bounds),
            (Some(bounds), None) => ends(bounds),
            (None, Some(cycle)) => number.text(cycle, FOUND),
            (None, None) => "?".to_owned(),
        }
    }
}

/// The columns of files for what is proved.
fn bound_columns<'a>() -> Columns<'a, ProvedRow<'a>> {
    let columns = Columns::default()
        .file("proved", |row: &ProvedRow| row.enclosure.is_some())
        .file("open", |row| row.open.map(|open| open.reason));
    [1, 0, 3, 2, 4, 5, 6]
        .map(|at| &NUMBERS[at])
        .into_iter()
        .fold(columns, |all, number| all.bounds(number.name, move |row| row.bounds(number)))
}

/// An answer with its cycles and what is proved about them: a row for each, and in files for each interval of clearances
/// that is open; the parameters for which this holds are the doubles nearest to the decimal numbers given.
pub(super) fn with_proof<'a>(
    answer: Answer<'a>,
    rows: impl Fn() -> Vec<ProvedRow<'a>> + Copy + 'a,
    proof: &'a Proof,
) -> Answer<'a> {
    let open = proof.open.iter().map(|open| ProvedRow { open: Some(open), ..Default::default() });
    let is_box = !proof.parameters.is_point();
    let own = if is_box {
        Columns::default().file("stable", |row: &ProvedRow| row.stable)
    } else {
        cycle_fields(|row: &ProvedRow| row.cycle.copied())
    };
    let kind = |row: &ProvedRow| {
        let is_open = row.cycle.is_some() && row.enclosure.is_none();
        let not_proved = if is_open { ", not proved" } else { "" };
        row.stable.map_or("", stability).to_owned() + not_proved
    };
    let texts = Columns::default().text("cycle", kind);
    let is_unknown = |row: &ProvedRow| NUMBERS.iter().any(|number| row.text(number) == "?");
    let unknown = rows().iter().any(is_unknown).then_some(UNKNOWN);
    answer
        .fields(move |all| {
            let cycles: Vec<_> = rows().iter().map(ProvedRow::document).collect();
            let count = Document::default()
                .with("proved", proof.is_complete())
                .with("open", &proof.open)
                .with("parameters", proof.parameters);
            all.with("cycles", cycles).with("count", count)
        })
        .csv(own.and(bound_columns()), rows().into_iter().chain(open))
        .table(number_columns(texts, ProvedRow::text), rows())
        .lines(unknown)
        .lines(sentences(rows().len(), proof, if is_box { BOX } else { POINT }))
}

/// What `?` means.
const UNKNOWN: &str =
    "?: no digit of it is certain; bounds of half swings as stiff as these say little of it";

/// For which parameters a proof holds.
const POINT: &str = "for the parameters as doubles";
const BOX: &str = "for all of these parameters";

/// `2 cycles, proved ..`, or what is open.
fn sentences(found: usize, proof: &Proof, parameters: &str) -> Vec<String> {
    let cycles = cycles(found);
    if proof.is_complete() {
        return vec![format!("{cycles}, proved {parameters}")];
    }
    let open = proof.open.iter().map(|open| {
        let (lower, upper) = (significant(open.lower, 6), significant(open.upper, 6));
        let range = if open.upper.is_finite() {
            let width = significant(open.upper - open.lower, 2);
            format!("from {lower} to {upper} (width {width})")
        } else {
            format!("from {lower} on")
        };
        format!("  clearances {range} are open: {}", open.reason)
    });
    let first = format!("{cycles} found; not proved that there are no others:");
    std::iter::once(first).chain(open).collect()
}

/// The cycles that exist for all parameters in a box.
pub fn boxed(proof: &Proof) -> Answer<'_> {
    let rows = || proof.cycles.iter().map(ProvedRow::proved).collect();
    with_proof(Answer::new("", About::boxed(&proof.parameters).heading()), rows, proof)
}

/// The statement of a certificate that has been checked.
pub fn certificate_table(certificate: &Certificate) -> String {
    let interval = |[lower, upper]: Bounds| Interval::new(lower, upper);
    let steps = certificate.steps.iter();
    let proved = steps.filter_map(|step| Some((step.kind, step.clearance?)));
    let columns = Columns::default()
        .text("cycle", |(kind, _): &(StepKind, Bounds)| {
            stability(*kind == StepKind::Stable).to_owned()
        })
        .text("right clearance", move |(_, clearance)| certain(interval(*clearance)));
    let count = match certificate.cycles {
        0 => "no limit cycle".to_owned(),
        some => counted(some, "limit cycle"),
    };
    let steps = certificate.steps.len();
    let [d, d2, d3, r] = certificate.parameters.map(interval);
    Answer::new("", About::boxed(&ParameterBox { d, d2, d3, r }).heading())
        .table(columns, proved)
        .lines([format!("{count} and no other, at any amplitude: {steps} steps checked")])
        .told(Format::Table)
}
