//! Proofs: of limit cycles, and enclosures of motions, kicks, ranges and borders, for tables and documents.

use super::cycle_numbers::{CycleNumber, NUMBERS, cycle_fields, number_columns};
use super::{About, Answer, Columns, Document, Format, Quantity, bounds, certain, ends};
use crate::branch::BoundaryPoint;
use crate::check::{Bounds, Certificate, StepKind};
use crate::numerics::Interval;
use crate::portrait::{Cycle, matching};
use crate::proof::{
    CountChange, Enclosure, Proof, ProvedCycle, ProvedKicks, ProvedMotion, ProvedPoint, Range,
    RangePiece,
};
use crate::words::{counted, cycles, significant, stability};

/// A cycle with what is proved about it, or an interval of clearances that is open.
#[derive(Default)]
pub(super) struct ProvedRow<'a> {
    stable: Option<bool>,
    /// `None` if it is one for each of many parameters.
    cycle: Option<&'a Cycle>,
    enclosure: Option<Enclosure>,
    open: Option<Interval>,
}

impl<'a> ProvedRow<'a> {
    /// Every cycle that was found.
    pub(super) fn found(found: &'a [Cycle], proof: &Proof) -> Vec<Self> {
        let row = |cycle: &'a Cycle| ProvedRow {
            stable: Some(cycle.stable),
            cycle: Some(cycle),
            enclosure: matching(proof, cycle).and_then(|proved| proved.enclosure),
            open: None,
        };
        found.iter().map(row).collect()
    }

    /// Where a number is proved to lie; of an open interval, the clearance.
    fn bounds(&self, CycleNumber { name, bounds, .. }: &CycleNumber) -> Option<Interval> {
        let open = self.open.filter(|_| *name == "clearance");
        open.or(self.enclosure.as_ref().map(bounds))
    }

    /// Whether it exists, is the only one nearby, and lies in its enclosure.
    fn document(&self) -> Document {
        let own = match self.cycle {
            Some(cycle) => Document::default().and(cycle),
            None => Document::of("stable", self.stable),
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
fn bound_columns(proof: &Proof) -> Columns<'_, ProvedRow<'_>> {
    let columns = Columns::default()
        .file("proved", |row: &ProvedRow| row.enclosure.is_some())
        .file("open", |row| row.open.map(|gap| proof.why_open(gap)));
    // Not as bounds: their field would replace the number of that name in the object of the row.
    [1, 0, 3, 2, 4, 5, 6].map(|at| &NUMBERS[at]).into_iter().fold(columns, |all, number| {
        let end = |end: fn(Interval) -> f64| move |row: &ProvedRow| row.bounds(number).map(end);
        all.file(&format!("{}_lower", number.name), end(Interval::lower))
            .file(&format!("{}_upper", number.name), end(Interval::upper))
    })
}

/// An answer with its cycles and what is proved about them: a row for each, and in files for each interval of clearances
/// that is open; the parameters for which this holds are the doubles nearest to the decimal numbers given.
pub(super) fn with_proof(answer: Answer, rows: &[ProvedRow], proof: &Proof) -> Answer {
    let open = proof.open.iter().map(|gap| ProvedRow { open: Some(*gap), ..Default::default() });
    let open: Vec<_> = open.collect();
    let gap = |gap: &Interval| bounds(*gap).with("reason", proof.why_open(*gap));
    let own = if proof.parameters.is_point() {
        cycle_fields(|row: &ProvedRow| row.cycle.copied())
    } else {
        Columns::default().file("stable", |row: &ProvedRow| row.stable)
    };
    let kind = |row: &ProvedRow| {
        let is_open = row.cycle.is_some() && row.enclosure.is_none();
        let not_proved = if is_open { ", not proved" } else { "" };
        row.stable.map_or("", stability).to_owned() + not_proved
    };
    let texts = Columns::default().text("cycle", kind);
    let is_unknown = |row: &ProvedRow| NUMBERS.iter().any(|number| row.text(number) == "?");
    let count = Document::of("proved", proof.is_complete())
        .with("open", proof.open.iter().map(gap).collect::<Vec<_>>())
        .with("parameters", proof.parameters);
    answer
        .with("cycles", rows.iter().map(ProvedRow::document).collect::<Vec<_>>())
        .with("count", count)
        .csv(&own.and(bound_columns(proof)), rows.iter().chain(&open))
        .table(number_columns(texts, ProvedRow::text).table(rows))
        .lines(rows.iter().any(is_unknown).then_some(UNKNOWN))
        .lines(sentences(rows.len(), proof))
}

/// What `?` means.
const UNKNOWN: &str =
    "?: no digit of it is certain; bounds of half swings as stiff as these say little of it";

/// `2 cycles, proved ..`, or what is open.
fn sentences(found: usize, proof: &Proof) -> Vec<String> {
    let cycles = cycles(found);
    if proof.is_complete() {
        let is_point = proof.parameters.is_point();
        let of = if is_point {
            "the parameters as doubles"
        } else {
            "all of these parameters"
        };
        return vec![format!("{cycles}, proved for {of}")];
    }
    let open = proof.open.iter().map(|gap| {
        let (lower, upper) = (significant(gap.lower(), 6), significant(gap.upper(), 6));
        let range = if gap.upper().is_finite() {
            let width = significant(gap.upper() - gap.lower(), 2);
            format!("from {lower} to {upper} (width {width})")
        } else {
            format!("from {lower} on")
        };
        format!("  clearances {range} are open: {}", proof.why_open(*gap))
    });
    let first = format!("{cycles} found; not proved that there are no others:");
    std::iter::once(first).chain(open).collect()
}

/// The cycles that exist for all parameters in a box.
pub fn boxed(proof: &Proof) -> Answer {
    let row = |cycle: &ProvedCycle| ProvedRow {
        stable: Some(cycle.stable),
        enclosure: cycle.enclosure,
        ..ProvedRow::default()
    };
    let rows: Vec<_> = proof.cycles.iter().map(row).collect();
    with_proof(Answer::new("", About::boxed(&proof.parameters).heading()), &rows, proof)
}

/// The statement of a certificate that has been checked.
pub fn certificate_table(certificate: &Certificate) -> String {
    let interval = |[lower, upper]: Bounds| Interval::new(lower, upper);
    let steps = certificate.steps.iter();
    let proved = steps.filter_map(|step| Some((step.kind, step.clearance?)));
    let stable = |(kind, _): &(StepKind, Bounds)| stability(*kind == StepKind::Stable);
    let columns = Columns::default()
        .text("cycle", stable)
        .text("right clearance", move |(_, clearance)| certain(interval(*clearance)));
    let count = match certificate.cycles {
        0 => "no limit cycle".to_owned(),
        some => counted(some, "limit cycle"),
    };
    let steps = certificate.steps.len();
    let parameters = certificate.parameters.map(interval).into();
    Answer::new("", About::boxed(&parameters).heading())
        .table(columns.table(proved))
        .lines([format!("{count} and no other, at any amplitude: {steps} steps checked")])
        .told(Format::Table)
}

/// The columns of the enclosure of a point of a motion.
pub(super) fn point_columns<'a>() -> Columns<'a, ProvedPoint> {
    Columns::default()
        .bounds("tau", |point: &ProvedPoint| Some(point.tau))
        .bounds("q", |point| point.q)
        .bounds("v", |point| point.v)
        .word("proved", |point| point.open.is_none())
        .word("open", |point| point.open)
}

/// A motion up to a time, for documents.
pub(super) fn followed(motion: &ProvedMotion) -> Document {
    let turn =
        |turn: &ProvedPoint| Document::of("tau", bounds(turn.tau)).with("q", turn.q.map(bounds));
    Document::of("outcome", motion.fate)
        .with("half_swings", motion.turns.len())
        .with("turns", motion.turns.iter().map(turn).collect::<Vec<_>>())
        .and(&point_columns().object(&motion.end))
}

/// The columns of enclosures of the smallest kicks that are not captured.
pub(super) fn kick_columns<'a>() -> Columns<'a, &'a ProvedKicks> {
    const NO_EDGE: &str = "what borders the basin";
    Columns::default()
        .word("edge", |kicks: &&ProvedKicks| kicks.edge)
        .bounds("displacement", |kicks| kicks.sizes.displacement)
        .bounds("impulse", |kicks| kicks.sizes.impulse)
        .bounds("from_rest_displacement", |kicks| kicks.sizes.from_rest.displacement)
        .bounds("from_rest_impulse", |kicks| kicks.sizes.from_rest.impulse)
        .file("proved", |kicks| kicks.open.is_none() && kicks.edge.is_some())
        .word("open", |kicks| kicks.open.or_else(|| kicks.edge.is_none().then_some(NO_EDGE)))
}

/// The columns of what holds for every value in a piece of a range; `value` names the number that varies.
pub(super) fn piece_columns<'a>(range: &'a Range, value: &str) -> Columns<'a, &'a RangePiece> {
    // In an open piece, where the number of cycles changes.
    let change = |piece: &RangePiece| {
        let mut changes = range.changes.iter().map(|change| change.between);
        changes.find(|change| piece.cycles.is_none() && change.is_within(piece.over))
    };
    Columns::default()
        .bounds(value, |piece: &&RangePiece| Some(piece.over))
        .file("cycles", |piece| piece.cycles.as_ref().map(Vec::len))
        .file("proved", |piece| piece.cycles.is_some())
        .bounds("change", move |piece| change(piece))
}

/// The columns of the pieces of a range.
pub(super) fn range_pieces<'a>() -> Columns<'a, RangePiece> {
    const END: Quantity = Quantity::pure(10);
    Columns::default()
        .number("lower", END, |piece: &RangePiece| piece.over.lower())
        .number("upper", END, |piece| piece.over.upper())
        .word("cycles", |piece| piece.cycles.as_ref().map(Vec::len))
        .field("stable", |piece| piece.cycles.clone())
        .word("proved", |piece| piece.cycles.is_some())
}

/// The columns of the changes of the number of cycles in a range.
pub(super) fn range_changes<'a>() -> Columns<'a, CountChange> {
    Columns::default()
        .file("lower", |change: &CountChange| change.between.lower())
        .file("upper", |change| change.between.upper())
        .text("the number changes at", |change| certain(change.between))
        .word("below", |change| change.below.len())
        .word("above", |change| change.above.len())
}

/// A range, for documents.
pub(super) fn decided(range: &Range) -> Document {
    let open = range.pieces.iter().filter(|piece| piece.cycles.is_none());
    let open: Vec<_> = open.map(|piece| bounds(piece.over)).collect();
    Document::of("pieces", range_pieces().objects(&range.pieces))
        .with("changes", range_changes().objects(&range.changes))
        .with("open", &open)
        .with("proved", open.is_empty())
        // Whether more work might decide what is open.
        .with("exhausted", range.exhausted)
}

/// A value of a second parameter, and the values of D at which the cycles change there.
pub struct BorderProof {
    value: f64,
    fold: Option<Interval>,
    escape: Option<Interval>,
    /// What the search found and is not proved.
    open: Vec<&'static str>,
}

impl BorderProof {
    /// The enclosures at a point that the search found.
    pub fn new(point: &BoundaryPoint, fold: Option<Interval>, escape: Option<Interval>) -> Self {
        let missing = [
            ("the fold", point.fold.is_some() && fold.is_none()),
            ("the escape point", point.escape.is_some() && escape.is_none()),
        ];
        let open = missing.into_iter().filter_map(|(what, open)| open.then_some(what)).collect();
        BorderProof { value: point.value, fold, escape, open }
    }

    pub(super) fn document(&self) -> Document {
        Document::of("value", self.value)
            .with("fold", self.fold.map(bounds))
            .with("escape", self.escape.map(bounds))
            .with("proved", self.open.is_empty())
            .with("open", &self.open)
    }
}

/// The columns of what is proved of a border.
pub(super) fn border_columns<'a>() -> Columns<'a, &'a BorderProof> {
    Columns::default()
        .bounds("D_F", |proof: &&BorderProof| proof.fold)
        .bounds("D_c", |proof| proof.escape)
        .word("proved", |proof| proof.open.is_empty())
        .word("open", |proof| proof.open.join(", "))
}
