//! Enclosures and proofs, for tables and documents.

use super::columns::{Columns, bounds};
use super::cycle_numbers::NUMBERS;
use super::json::Document;
use super::proof::{CycleBounds, certain, count, cycle_columns, sentence, uncertain};
use crate::branch::fold::BoundaryPoint;
use crate::check::{Bounds, Certificate, StepKind};
use crate::model::Knob;
use crate::numerics::Interval;
use crate::numerics::elementary::{log10, pow};
use crate::proof::Proof;
use crate::proof::cycles::ProvedCycle;
use crate::proof::kicks::{ProvedEdge, ProvedKicks};
use crate::proof::motion::{ProvedFate, ProvedMotion, ProvedTurn};
use crate::proof::range::{CountChange, MOST_STEPS, Range, RangePiece};
use crate::words::number::significant;
use crate::words::{counted, stability};

const PLACES: usize = 12;

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

pub fn motion_line(motion: &ProvedMotion, until: f64) -> String {
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

pub fn kicks_lines(kicks: &ProvedKicks) -> String {
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

pub fn range_table(range: &Range, symbol: Knob) -> String {
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
    pub(super) value: f64,
    pub(super) fold: Option<Interval>,
    pub(super) escape: Option<Interval>,
    /// What the search found and is not proved.
    pub(super) open: Vec<&'static str>,
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
}

pub fn border_lines(points: &[BorderProof], symbol: Knob) -> String {
    let cell = |it: Option<Interval>| it.map_or("-".to_owned(), |it| certain(it, PLACES));
    let columns = Columns::default()
        .text(symbol.spec().name, |point: &&BorderProof| significant(point.value, 10))
        .text("D_F, proved", |point| cell(point.fold))
        .text("D_c, proved", |point| cell(point.escape));
    format!("\n{}", columns.table(points))
}

/// The cycles that exist for all parameters in a box, as a table.
pub fn box_table(proof: &Proof) -> String {
    let ends = |it: Interval| {
        if !it.is_finite() {
            return certain(it, PLACES);
        }
        let [lower, upper] = outward(it);
        format!("{lower} .. {upper}")
    };
    let kind = |cycle: &&ProvedCycle| stability(cycle.stable).to_owned();
    // Without the clearance, which is q_max but for r.
    let table = NUMBERS[..6].iter().fold(Columns::default().text("cycle", kind), |all, number| {
        all.text(number.name, move |cycle| {
            cycle.enclosure.map_or("?".to_owned(), |it| ends((number.bounds)(&it)))
        })
    });
    let table = table.table(&proof.cycles);
    let p = proof.parameters;
    let parameters = [("D", p.d), ("D2", p.d2), ("D3", p.d3), ("r", p.r)];
    let heading = parameters.map(|(name, it)| {
        if it.is_point() {
            format!("{name} = {}", it.lower())
        } else {
            format!("{name} = {} .. {}", it.lower(), it.upper())
        }
    });
    let table = table.aligned_left();
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

/// The same for a document.
pub fn boxed(proof: &Proof) -> Document {
    let cycle = |cycle: &ProvedCycle| {
        Document::default()
            .with("stable", cycle.stable)
            .with("proved", true)
            .with_any("enclosure", cycle.enclosure)
    };
    Document::default()
        .with("cycles", proof.cycles.iter().map(cycle).collect::<Vec<_>>())
        .with("count", count(proof))
}

/// The same as rows.
pub fn box_csv(proof: &Proof) -> String {
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
