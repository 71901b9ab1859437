//! Enclosures of motions, kicks, ranges and borders, for tables and documents.

use super::columns::{bounds, certain};
use super::{Columns, Document, Quantity};
use crate::branch::fold::BoundaryPoint;
use crate::numerics::Interval;
use crate::proof::kicks::{ProvedEdge, ProvedKicks};
use crate::proof::motion::{ProvedFate, ProvedMotion, ProvedTurn};
use crate::proof::range::{CountChange, Range, RangePiece};

/// The enclosure of a point of a motion.
#[derive(Clone, Copy)]
pub(super) struct PointBounds {
    tau: Interval,
    q: Option<Interval>,
    v: Option<Interval>,
    /// Why nothing is known of the motion from here on.
    open: Option<&'static str>,
}

impl PointBounds {
    /// The bounds of a point that is enclosed.
    pub(super) fn of(tau: Interval, q: Interval, v: Interval) -> Self {
        PointBounds { tau, q: Some(q), v: Some(v), open: None }
    }

    /// How a motion ends, by `until` at the latest, and where.
    pub(super) fn of_end(motion: &ProvedMotion, until: f64) -> (&'static str, Self) {
        let at = |tau, q, v, open| PointBounds { tau, q, v, open };
        match motion.fate {
            ProvedFate::Captured { tau, q } => ("captured", at(tau, Some(q), None, None)),
            ProvedFate::Moving { q, v } => ("moving", Self::of(Interval::point(until), q, v)),
            ProvedFate::Escaped { tau } => ("escaped", at(tau, None, None, None)),
            ProvedFate::Open { tau, reason } => ("open", at(tau, None, None, Some(reason))),
        }
    }
}

/// The columns of the enclosure of a point.
pub(super) fn point_columns<'a>() -> Columns<'a, PointBounds> {
    Columns::default()
        .bounds("tau", |point: &PointBounds| Some(point.tau))
        .bounds("q", |point| point.q)
        .bounds("v", |point| point.v)
        .word("proved", |point| point.open.is_none())
        .word("open", |point| point.open)
}

/// A motion up to a time, for documents.
pub(super) fn followed(motion: &ProvedMotion, until: f64) -> Document {
    let turn = |turn: &ProvedTurn| {
        Document::default().with("tau", bounds(turn.tau)).with("q", bounds(turn.q))
    };
    let (outcome, end) = PointBounds::of_end(motion, until);
    Document::default()
        .with("outcome", outcome)
        .with("half_swings", motion.turns.len())
        .with("turns", motion.turns.iter().map(turn).collect::<Vec<_>>())
        .and(&point_columns().object(&end))
}

/// The columns of enclosures of the smallest kicks that are not captured.
pub(super) fn kick_columns<'a>() -> Columns<'a, &'a ProvedKicks> {
    const NO_EDGE: &str = "what borders the basin";
    let name = |edge| match edge {
        ProvedEdge::None => "none",
        ProvedEdge::Cycle => "cycle",
        ProvedEdge::Separatrix => "separatrix",
    };
    Columns::default()
        .word("edge", move |kicks: &&ProvedKicks| kicks.edge.map(name))
        .titled("border of the basin, proved")
        .bounds("displacement", |kicks| kicks.displacement)
        .titled("displacement from q = 0, proved")
        .bounds("impulse", |kicks| kicks.impulse)
        .titled("impulse at q = 0, proved")
        .bounds("from_rest_displacement", |kicks| kicks.rest_displacement)
        .titled("displacement from any rest position, proved")
        .bounds("from_rest_impulse", |kicks| kicks.rest_impulse)
        .titled("impulse at any rest position, proved")
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
        .titled("every value from")
        .number("upper", END, |piece| piece.over.upper())
        .titled("to")
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
        .titled("cycles below")
        .word("above", |change| change.above.len())
        .titled("above")
}

/// A range, for documents.
pub(super) fn decided(range: &Range) -> Document {
    let open = range.pieces.iter().filter(|piece| piece.cycles.is_none());
    let open: Vec<_> = open.map(|piece| bounds(piece.over)).collect();
    Document::default()
        .with("pieces", range_pieces().objects(&range.pieces))
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
        Document::default()
            .with("value", self.value)
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
