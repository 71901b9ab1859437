//! Enclosures and proofs, for tables and documents.

use serde::Serialize;

use super::proof::certain;
use super::table::Table;
use crate::check::{Bounds, Certificate, StepKind};
use crate::numerics::Interval;
use crate::numerics::elementary::{log10, pow};
use crate::oscillator::Knob;
use crate::proof::cycles::Proof;
use crate::proof::kicks::{ProvedEdge, ProvedKicks};
use crate::proof::motion::{ProvedFate, ProvedMotion};
use crate::proof::range::{CountChange, MOST_STEPS, Range, RangePiece};
use crate::study::fold::BoundaryPoint;
use crate::words::number::significant;
use crate::words::stability;

const PLACES: usize = 12;

/// An interval in a document; an infinite end is null.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct IntervalDocument {
    lower: f64,
    upper: f64,
}

impl From<Interval> for IntervalDocument {
    fn from(it: Interval) -> Self {
        IntervalDocument { lower: it.lower(), upper: it.upper() }
    }
}

#[derive(Serialize)]
struct TurnRow {
    tau: IntervalDocument,
    q: IntervalDocument,
}

#[derive(Serialize)]
pub struct MotionDocument {
    outcome: &'static str,
    half_swings: usize,
    turns: Vec<TurnRow>,
    #[serde(flatten)]
    end: PointBounds,
}

/// The enclosure of a point of a motion, with a column for each bound.
#[derive(Serialize)]
pub struct PointBounds {
    tau: IntervalDocument,
    q: Option<IntervalDocument>,
    v: Option<IntervalDocument>,
    proved: bool,
    open: Option<&'static str>,
}

impl PointBounds {
    /// An example with all columns, for the heading.
    pub fn like() -> Self {
        PointBounds::of(Interval::ALL, Interval::ALL, Interval::ALL)
    }

    /// The bounds of a point that is enclosed.
    pub fn of(tau: Interval, q: Interval, v: Interval) -> Self {
        let [q, v] = [q, v].map(|it| Some(it.into()));
        PointBounds { tau: tau.into(), q, v, proved: true, open: None }
    }

    pub fn of_end(motion: &ProvedMotion, until: f64) -> Self {
        followed(motion, until).end
    }
}

/// A motion up to a time, for documents.
pub fn followed(motion: &ProvedMotion, until: f64) -> MotionDocument {
    let turns = motion.turns.iter().map(|turn| TurnRow { tau: turn.tau.into(), q: turn.q.into() });
    let (outcome, tau, q, v, open) = match motion.fate {
        ProvedFate::Captured { tau, q } => ("captured", tau, Some(q), None, None),
        ProvedFate::Moving { q, v } => ("moving", Interval::point(until), Some(q), Some(v), None),
        ProvedFate::Escaped { tau } => ("escaped", tau, None, None, None),
        ProvedFate::Open { tau, reason } => ("open", tau, None, None, Some(reason)),
    };
    let [q, v] = [q, v].map(|it| it.map(IntervalDocument::from));
    let end = PointBounds { tau: tau.into(), q, v, proved: open.is_none(), open };
    MotionDocument { outcome, half_swings: motion.turns.len(), turns: turns.collect(), end }
}

pub fn motion_line(motion: &ProvedMotion, until: f64) -> String {
    let number = |it| certain(it, PLACES);
    let swings = match motion.turns.len() {
        1 => "1 half swing".to_owned(),
        more => format!("{more} half swings"),
    };
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

/// Enclosures of the smallest kicks that are not captured.
#[derive(Serialize)]
pub struct KickEnclosures {
    edge: Option<&'static str>,
    displacement: Option<IntervalDocument>,
    impulse: Option<IntervalDocument>,
    from_rest_displacement: Option<IntervalDocument>,
    from_rest_impulse: Option<IntervalDocument>,
    proved: bool,
    open: Option<&'static str>,
}

fn name(edge: ProvedEdge) -> &'static str {
    match edge {
        ProvedEdge::None => "none",
        ProvedEdge::Cycle => "cycle",
        ProvedEdge::Separatrix => "separatrix",
    }
}

pub fn survived(kicks: &ProvedKicks) -> KickEnclosures {
    KickEnclosures {
        edge: kicks.edge.map(name),
        displacement: kicks.displacement.map(IntervalDocument::from),
        impulse: kicks.impulse.map(IntervalDocument::from),
        from_rest_displacement: kicks.rest_displacement.map(IntervalDocument::from),
        from_rest_impulse: kicks.rest_impulse.map(IntervalDocument::from),
        proved: kicks.open.is_none() && kicks.edge.is_some(),
        open: kicks.open.or_else(|| kicks.edge.is_none().then_some("what borders the basin")),
    }
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
    let kicked = [
        ("displacement from the worst rest position", kicks.rest_displacement),
        ("impulse at the worst rest position", kicks.rest_impulse),
        ("displacement from q = 0", kicks.displacement),
        ("impulse at q = 0", kicks.impulse),
    ];
    let lines: String = kicked.into_iter().filter_map(line).collect();
    edge + &lines + &kicks.open.map(|why| format!("open: {why}\n")).unwrap_or_default()
}

impl KickEnclosures {
    /// An example with all columns, for the heading.
    pub fn like() -> Self {
        let all = Some(IntervalDocument::from(Interval::ALL));
        KickEnclosures {
            edge: None,
            displacement: all,
            impulse: all,
            from_rest_displacement: all,
            from_rest_impulse: all,
            proved: false,
            open: None,
        }
    }
}

/// What holds for every value in a piece of a range, with a column for each bound.
#[derive(Clone, Copy, Serialize)]
pub struct PieceBounds {
    value: IntervalDocument,
    cycles: Option<usize>,
    proved: bool,
    /// In an open piece, where the number of cycles changes.
    change: Option<IntervalDocument>,
}

impl PieceBounds {
    /// An example with all columns, for the heading.
    pub fn like() -> Self {
        let all = Interval::ALL.into();
        PieceBounds { value: all, cycles: None, proved: false, change: Some(all) }
    }

    pub fn of(range: &Range) -> Vec<Self> {
        let row = |piece: &RangePiece| {
            let mut changes = range.changes.iter();
            let change = changes.find(|change| change.between.is_within(piece.over));
            let (cycles, value) = (piece.cycles.as_ref().map(Vec::len), piece.over.into());
            let change = change.filter(|_| cycles.is_none()).map(|change| change.between.into());
            PieceBounds { value, cycles, proved: cycles.is_some(), change }
        };
        range.pieces.iter().map(row).collect()
    }
}

#[derive(Serialize)]
struct PieceRow {
    #[serde(flatten)]
    over: IntervalDocument,
    cycles: Option<usize>,
    stable: Option<Vec<bool>>,
    proved: bool,
}

#[derive(Serialize)]
struct ChangeRow {
    #[serde(flatten)]
    between: IntervalDocument,
    below: usize,
    above: usize,
}

/// The number of cycles over a range of a parameter, where it is proved.
#[derive(Serialize)]
pub struct ProvedRange {
    pieces: Vec<PieceRow>,
    changes: Vec<ChangeRow>,
    open: Vec<IntervalDocument>,
    proved: bool,
    /// Whether more work might decide what is open.
    exhausted: bool,
}

/// The pieces and changes of a range, for documents.
pub fn decided(range: &Range) -> ProvedRange {
    let piece = |piece: &RangePiece| PieceRow {
        over: piece.over.into(),
        cycles: piece.cycles.as_ref().map(Vec::len),
        stable: piece.cycles.clone(),
        proved: piece.cycles.is_some(),
    };
    let change = |change: &CountChange| ChangeRow {
        between: change.between.into(),
        below: change.below.len(),
        above: change.above.len(),
    };
    let open = range.pieces.iter().filter(|piece| piece.cycles.is_none());
    let open: Vec<IntervalDocument> = open.map(|piece| piece.over.into()).collect();
    ProvedRange {
        pieces: range.pieces.iter().map(piece).collect(),
        changes: range.changes.iter().map(change).collect(),
        proved: open.is_empty(),
        open,
        exhausted: range.exhausted,
    }
}

pub fn range_table(range: &Range, symbol: Knob) -> String {
    let name = symbol.spec().name;
    let mut table = Table::new(&["from", "to", "cycles"]);
    for piece in &range.pieces {
        let cycles =
            piece.cycles.as_ref().map_or("open".to_owned(), |it| format!("{}, proved", it.len()));
        let ends = [piece.over.lower(), piece.over.upper()].map(|end| significant(end, 10));
        table.row([ends.as_slice(), &[cycles]].concat());
    }
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
#[derive(Serialize)]
pub struct BorderProof {
    pub value: f64,
    pub fold: Option<IntervalDocument>,
    pub escape: Option<IntervalDocument>,
    /// Whether everything that the search found is proved.
    pub proved: bool,
    /// What is not proved.
    pub open: Vec<&'static str>,
}

impl BorderProof {
    /// The enclosures at a point that the search found.
    pub fn new(point: &BoundaryPoint, fold: Option<Interval>, escape: Option<Interval>) -> Self {
        let missing = [
            ("the fold", point.fold.is_some() && fold.is_none()),
            ("the escape point", point.escape.is_some() && escape.is_none()),
        ];
        let open: Vec<_> =
            missing.into_iter().filter_map(|(what, open)| open.then_some(what)).collect();
        BorderProof {
            value: point.value,
            fold: fold.map(IntervalDocument::from),
            escape: escape.map(IntervalDocument::from),
            proved: open.is_empty(),
            open,
        }
    }
}

pub fn border_lines(points: &[BorderProof], symbol: Knob) -> String {
    let mut table = Table::new(&[symbol.spec().name, "D_F, proved", "D_c, proved"]);
    let cell = |it: Option<IntervalDocument>| {
        it.map_or("-".to_owned(), |it| certain(Interval::new(it.lower, it.upper), PLACES))
    };
    for point in points {
        table.row(vec![significant(point.value, 10), cell(point.fold), cell(point.escape)]);
    }
    format!("\n{table}")
}

/// The cycles that exist for all parameters in a box, as a table.
pub fn box_table(proof: &Proof) -> String {
    let mut table =
        Table::new(&["cycle", "q_min", "q_max", "v_min", "v_max", "period", "multiplier"]);
    for cycle in &proof.cycles {
        let kind = stability(cycle.stable);
        let mut cells = vec![kind.to_owned()];
        let ends = |it: Interval| {
            if !it.is_finite() {
                return certain(it, PLACES);
            }
            let [lower, upper] = outward(it);
            format!("{lower} .. {upper}")
        };
        match cycle.enclosure {
            Some(it) => cells.extend(
                [it.q_min, it.q_max, it.v_min, it.v_max, it.period, it.multiplier].map(ends),
            ),
            None => cells.extend(std::iter::repeat_n("?".to_owned(), 6)),
        }
        table.row(cells);
    }
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
        format!("{table}\n{}", super::proof::uncertain(&table))
    };
    let line = super::proof::sentence(proof.cycles.len(), proof);
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

#[derive(Serialize)]
struct BoxCycle {
    stable: bool,
    proved: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    enclosure: Option<crate::proof::Enclosure>,
}

#[derive(Serialize)]
struct BoxDocument<'a> {
    cycles: Vec<BoxCycle>,
    count: super::proof::Count<'a>,
}

/// The same for a document.
pub fn boxed(proof: &Proof) -> impl Serialize {
    let cycles = proof.cycles.iter().map(|cycle| BoxCycle {
        stable: cycle.stable,
        proved: true,
        enclosure: cycle.enclosure,
    });
    BoxDocument { cycles: cycles.collect(), count: super::proof::count(proof) }
}

/// The same as rows.
pub fn box_csv(proof: &Proof) -> String {
    #[derive(Serialize)]
    struct BoxRow {
        stable: Option<bool>,
        certified: super::proof::CycleBounds,
    }
    let cycles = proof.cycles.iter().map(|cycle| BoxRow {
        stable: Some(cycle.stable),
        certified: super::proof::CycleBounds::of(cycle.enclosure),
    });
    let open = super::proof::CycleBounds::open(proof);
    let open = open.map(|certified| BoxRow { stable: None, certified });
    let like = BoxRow { stable: None, certified: super::proof::CycleBounds::like() };
    super::csv::sheet(&like, cycles.chain(open))
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
    let mut table = Table::new(&["cycle", "right clearance"]);
    let mut some = false;
    for step in &certificate.steps {
        if let Some(clearance) = step.clearance {
            some = true;
            let kind = stability(step.kind == StepKind::Stable);
            table.row(vec![kind.to_owned(), certain(interval(clearance), PLACES)]);
        }
    }
    let count = match certificate.cycles {
        0 => "no limit cycle".to_owned(),
        1 => "1 limit cycle".to_owned(),
        more => format!("{more} limit cycles"),
    };
    let table = if some { format!("{table}\n") } else { String::new() };
    let steps = certificate.steps.len();
    let values = ["D", "D2", "D3", "r"].into_iter().zip(certificate.parameters).map(value);
    let values = values.collect::<Vec<_>>().join(", ");
    format!("{values}\n\n{table}{count} and no other, at any amplitude: {steps} steps checked\n")
}
