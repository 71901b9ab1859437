//! A range of a parameter, piece by piece: the number of cycles for every value in a piece, and the values
//! between which this number changes.

use super::field::ParameterBox;
use super::stabilities;
use crate::model::Knob;
use crate::numerics::{Interval, powi};

/// Part of a range, with what is proved for all values in it.
#[derive(Clone, Debug, PartialEq)]
pub struct RangePiece {
    /// The values of the parameter.
    pub over: Interval,
    /// Whether each cycle attracts, smallest cycle first; `None` where their number is open.
    pub cycles: Option<Vec<bool>>,
}

impl RangePiece {
    fn open(low: f64, high: f64) -> Self {
        RangePiece { over: Interval::new(low, high), cycles: None }
    }
}

/// A range of a parameter, decided piece by piece.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Range {
    /// Its pieces, in order.
    pub pieces: Vec<RangePiece>,
    /// Where the number of cycles changes.
    pub changes: Vec<CountChange>,
    /// Whether pieces are open because [`MOST_STEPS`] were taken, and might be decided by more.
    pub exhausted: bool,
    /// Integration steps taken.
    pub steps: u32,
}

/// Values of a parameter between which cycles appear or vanish.
#[derive(Clone, Debug, PartialEq)]
pub struct CountChange {
    /// The values; the number of cycles is proved at both ends.
    pub between: Interval,
    /// Whether each cycle attracts, at the lower end.
    pub below: Vec<bool>,
    /// Whether each cycle attracts, at the upper end.
    pub above: Vec<bool>,
}

/// Integration steps after which no part of a range is halved any more: some seconds.
pub const MOST_STEPS: u32 = 2_000_000;

/// The same for a single change.
const MOST_FOR_CHANGE: u32 = MOST_STEPS / 8;

/// Asks for the cycles at values of a parameter until the steps that this takes are too many.
struct Inquiry<'a> {
    base: &'a ParameterBox,
    symbol: Knob,
    steps: u32,
    most: u32,
}

impl<'a> Inquiry<'a> {
    fn new(base: &'a ParameterBox, symbol: Knob, most: u32) -> Self {
        Inquiry { base, symbol, steps: 0, most }
    }

    fn is_exhausted(&self) -> bool {
        self.steps >= self.most
    }

    /// Whether each cycle attracts, for all values of an interval; `None` where that is not proved.
    fn cycles(&mut self, value: Interval) -> Option<Vec<bool>> {
        if self.is_exhausted() {
            return None;
        }
        let (cycles, steps) = stabilities(&self.base.with(self.symbol, value));
        self.steps += steps;
        cycles
    }
}

/// Decides a range of values.
pub fn range(base: &ParameterBox, symbol: Knob, (low, high): (f64, f64)) -> Range {
    /// Number of initial parts of the range.
    const PARTS: i32 = 16;
    /// Halvings of a part.
    const HALVINGS: u32 = 10;
    let mut asked = Inquiry::new(base, symbol, MOST_STEPS);
    let end = |part: i32| match part {
        PARTS => high,
        _ => low + (high - low) * f64::from(part) / f64::from(PARTS),
    };
    let piece = |part: i32| RangePiece::open(end(part), end(part + 1));
    let mut pieces: Vec<_> = (0..PARTS).map(piece).collect();
    // The widest parts first: where the work ends, what is open is about as wide everywhere.
    for halvings in 0..=HALVINGS {
        for piece in pieces.iter_mut().filter(|piece| piece.cycles.is_none()) {
            piece.cycles = asked.cycles(piece.over);
        }
        if halvings < HALVINGS && !asked.is_exhausted() {
            pieces = pieces.into_iter().flat_map(halves).collect();
        }
    }
    let exhausted = asked.is_exhausted() && pieces.iter().any(|it| it.cycles.is_none());
    pieces.dedup_by(|next, piece| {
        let alike = next.cycles == piece.cycles;
        if alike {
            piece.over = piece.over.hull(next.over);
        }
        alike
    });
    let mut changes = Vec::new();
    for three in pieces.windows(3) {
        let [before, open, after] = three else { continue };
        if let (Some(below), None, Some(above)) = (&before.cycles, &open.cycles, &after.cycles)
            && below != above
        {
            let mut near = Inquiry::new(base, symbol, MOST_FOR_CHANGE);
            let between = narrowed(open.over, [below, above], Interval::middle, |at| {
                near.cycles(Interval::point(at))
            });
            asked.steps += near.steps;
            changes.push(CountChange { between, below: below.clone(), above: above.clone() });
        }
    }
    Range { pieces, changes, exhausted, steps: asked.steps }
}

/// The halves of an open piece; what is decided, or two neighbouring doubles, stays whole.
fn halves(piece: RangePiece) -> Vec<RangePiece> {
    let (low, middle, high) = (piece.over.lower(), piece.over.middle(), piece.over.upper());
    if piece.cycles.is_some() || middle == low || middle == high {
        return vec![piece];
    }
    vec![RangePiece::open(low, middle), RangePiece::open(middle, high)]
}

/// Narrows an interval at whose ends these verdicts are certain, as long as the verdict in its middle is one of both;
/// `middle` finds that.
pub(super) fn narrowed<T: PartialEq>(
    over: Interval,
    [below, above]: [&T; 2],
    middle: impl Fn(Interval) -> f64,
    mut verdict: impl FnMut(f64) -> Option<T>,
) -> Interval {
    let (mut low, mut high) = (over.lower(), over.upper());
    while let at = middle(Interval::new(low, high))
        && at > low
        && at < high
    {
        match verdict(at) {
            Some(found) if found == *below => low = at,
            Some(found) if found == *above => high = at,
            _ => break,
        }
    }
    Interval::new(low, high)
}

/// An interval near a guess at whose ends a verdict is certain and different, the nearest of those whose ends have
/// these distances from the guess, relative to it; narrowed as far as the verdict in its middle is certain.
pub(super) fn bracket<T: PartialEq>(
    near: f64,
    mut distances: impl Iterator<Item = f64>,
    mut verdict: impl FnMut(f64) -> Option<T>,
) -> Option<Interval> {
    let (over, below, above) = distances.find_map(|distance| {
        let away = distance * near.abs();
        let (below, above) = (verdict(near - away)?, verdict(near + away)?);
        (below != above).then_some((Interval::new(near - away, near + away), below, above))
    })?;
    Some(narrowed(over, [&below, &above], Interval::middle, verdict))
}

/// The change between the values `at - away abs(at)` and `at + away abs(at)`, if there is one.
pub fn change_within(base: &ParameterBox, knob: Knob, at: f64, away: f64) -> Option<CountChange> {
    let mut asked = Inquiry::new(base, knob, MOST_FOR_CHANGE);
    let mut ask = |value: f64| asked.cycles(Interval::point(value));
    let (low, high) = (at - away * at.abs(), at + away * at.abs());
    let (below, above) = (ask(low)?, ask(high)?);
    let between = Interval::new(low, high);
    (below != above).then_some(CountChange { between, below, above })
}

/// Values nearest to this one between which the number of cycles changes, if there are any: at both it is proved.
pub fn change_near(base: &ParameterBox, symbol: Knob, hint: f64) -> Option<Interval> {
    /// Distances to try, as powers of ten.
    const AWAY: std::ops::RangeInclusive<i32> = -12..=-3;
    let mut asked = Inquiry::new(base, symbol, MOST_STEPS);
    let distances = AWAY.map(|power| powi(10.0, power));
    bracket(hint, distances, |at| asked.cycles(Interval::point(at)))
}
