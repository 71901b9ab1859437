//! Enclosures of motions, kicks, ranges and borders, for tables and documents.

use super::columns::bounds;
use super::proof::{PLACES, certain};
use super::{Columns, Document};
use crate::branch::fold::BoundaryPoint;
use crate::model::Knob;
use crate::numerics::Interval;
use crate::proof::kicks::{ProvedEdge, ProvedKicks};
use crate::proof::motion::{ProvedFate, ProvedMotion, ProvedTurn};
use crate::proof::range::{CountChange, MOST_STEPS, Range, RangePiece};
use crate::words::{counted, significant};

/// The enclosure of a point of a motion.
#[derive(Clone, Copy)]
pub(super) struct PointBounds {
    pub tau: Interval,
    pub q: Option<Interval>,
    pub v: Option<Interval>,
    /// Why nothing is known of the motion from here on.
    pub open: Option<&'static str>,
}

impl PointBounds {
    /// The bounds of a point that is enclosed.
    pub(super) fn of(tau: Interval, q: Interval, v: Interval) -> Self {
        PointBounds { tau, q: Some(q), v: Some(v), open: None }
    }

    /// How a motion ends, by `until` at the latest, and where.
    pub(super) fn of_end(motion: &ProvedMotion, until: f64) -> (&'static str, Self) {
        match motion.fate {
            ProvedFate::Captured { tau, q } => {
                ("captured", PointBounds { tau, q: Some(q), v: None, open: None })
            }
            ProvedFate::Moving { q, v } => {
                ("moving", PointBounds::of(Interval::point(until), q, v))
            }
            ProvedFate::Escaped { tau } => {
                ("escaped", PointBounds { tau, q: None, v: None, open: None })
            }
            ProvedFate::Open { tau, reason } => {
                ("open", PointBounds { tau, q: None, v: None, open: Some(reason) })
            }
        }
    }
}

/// The columns of the enclosure of a point.
pub(super) fn point_columns<'a>() -> Columns<'a, PointBounds> {
    Columns::default()
        .bounds("tau", |point: &PointBounds| Some(point.tau))
        .bounds("q", |point| point.q)
        .bounds("v", |point| point.v)
        .file("proved", |point| point.open.is_none())
        .file("open", |point| point.open)
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

pub(super) fn motion_line(motion: &ProvedMotion, until: f64) -> String {
    let number = |it| certain(it, PLACES);
    let swings = counted(motion.turns.len(), "half swing");
    let sentence = match motion.fate {
        ProvedFate::Captured { tau, q } => {
            format!("captured after {swings} at q = {}, tau = {}", number(q), number(tau))
        }
        ProvedFate::Moving { q, v } => {
            let (q, v) = (number(q), number(v));
            format!("moving at tau = {until}, after {swings}: q = {q}, v = {v}")
        }
        ProvedFate::Escaped { tau } => format!("escapes after {swings}, at tau = {}", number(tau)),
        ProvedFate::Open { tau, reason } => {
            return format!("open from tau = {} on, after {swings}: {reason}\n", number(tau));
        }
    };
    format!("proved: {sentence}\n")
}

fn name(edge: ProvedEdge) -> &'static str {
    match edge {
        ProvedEdge::None => "none",
        ProvedEdge::Cycle => "cycle",
        ProvedEdge::Separatrix => "separatrix",
    }
}

/// The columns of enclosures of the smallest kicks that are not captured.
pub(super) fn kick_columns<'a>() -> Columns<'a, &'a ProvedKicks> {
    const NO_EDGE: &str = "what borders the basin";
    Columns::default()
        .file("edge", |kicks: &&ProvedKicks| kicks.edge.map(name))
        .bounds("displacement", |kicks| kicks.displacement)
        .bounds("impulse", |kicks| kicks.impulse)
        .bounds("from_rest_displacement", |kicks| kicks.rest_displacement)
        .bounds("from_rest_impulse", |kicks| kicks.rest_impulse)
        .file("proved", |kicks| kicks.open.is_none() && kicks.edge.is_some())
        .file("open", |kicks| kicks.open.or_else(|| kicks.edge.is_none().then_some(NO_EDGE)))
}

/// The names of displacement and impulse from the worst rest position, then from the middle.
pub(super) fn named<T>(sizes: [T; 4]) -> impl Iterator<Item = (&'static str, T)> {
    const NAMES: [&str; 4] = [
        "displacement from the worst rest position",
        "impulse at the worst rest position",
        "displacement from q = 0",
        "impulse at q = 0",
    ];
    NAMES.into_iter().zip(sizes)
}

pub(super) fn kicks_lines(kicks: &ProvedKicks) -> String {
    let edge = match kicks.edge {
        Some(ProvedEdge::None) => "proved: every start is captured\n".to_owned(),
        Some(edge) => format!("proved: the border of the basin is a {}\n", name(edge)),
        None => "open: what borders the basin\n".to_owned(),
    };
    let line = |(what, bounds): (&str, Option<Interval>)| {
        bounds.map(|it| {
            format!("proved: smallest {what} that is not captured {}\n", certain(it, PLACES))
        })
    };
    let ProvedKicks { rest_displacement, rest_impulse, displacement, impulse, .. } = *kicks;
    let kicked = named([rest_displacement, rest_impulse, displacement, impulse]);
    let lines: String = kicked.filter_map(line).collect();
    edge + &lines + &kicks.open.map(|why| format!("open: {why}\n")).unwrap_or_default()
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

/// The pieces and changes of a range, for documents.
pub(super) fn decided(range: &Range) -> Document {
    let piece = |piece: &RangePiece| {
        bounds(piece.over)
            .with("cycles", piece.cycles.as_ref().map(Vec::len))
            .with("stable", &piece.cycles)
            .with("proved", piece.cycles.is_some())
    };
    let change = |change: &CountChange| {
        bounds(change.between).with("below", change.below.len()).with("above", change.above.len())
    };
    let open = range.pieces.iter().filter(|piece| piece.cycles.is_none());
    let open: Vec<_> = open.map(|piece| bounds(piece.over)).collect();
    Document::default()
        .with("pieces", range.pieces.iter().map(piece).collect::<Vec<_>>())
        .with("changes", range.changes.iter().map(change).collect::<Vec<_>>())
        .with("open", &open)
        .with("proved", open.is_empty())
        // Whether more work might decide what is open.
        .with("exhausted", range.exhausted)
}

pub(super) fn range_table(range: &Range, symbol: Knob) -> String {
    let name = symbol.spec().name;
    let count = |cycles: &Vec<bool>| format!("{}, proved", cycles.len());
    let columns = Columns::default()
        .text("from", |piece: &&RangePiece| significant(piece.over.lower(), 10))
        .text("to", |piece| significant(piece.over.upper(), 10))
        .text("cycles", |piece| piece.cycles.as_ref().map_or("open".to_owned(), count));
    let table = columns.table(&range.pieces);
    let changes = range.changes.iter().map(|change| {
        let (below, above) = (change.below.len(), change.above.len());
        let at = certain(change.between, PLACES);
        format!("proved: from {below} to {above} cycles at {name} = {at}\n")
    });
    let changes: String = changes.collect();
    let exhausted = if range.exhausted {
        format!("open after {MOST_STEPS} steps: a narrower range may be decided\n")
    } else {
        String::new()
    };
    format!("\nfor every value of {name} in\n{table}{changes}{exhausted}")
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
        .file("proved", |proof| proof.open.is_empty())
        .file("open", |proof| proof.open.join(", "))
}

pub(super) fn border_lines(points: &[BorderProof], symbol: Knob) -> String {
    let cell = |it: Option<Interval>| it.map_or("-".to_owned(), |it| certain(it, PLACES));
    let columns = Columns::default()
        .text(symbol.spec().name, |point: &&BorderProof| significant(point.value, 10))
        .text("D_F, proved", |point| cell(point.fold))
        .text("D_c, proved", |point| cell(point.escape));
    format!("\n{}", columns.table(points))
}
