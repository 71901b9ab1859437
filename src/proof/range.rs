//! A range of a parameter, piece by piece: the number of cycles for every value in a piece, and the values
//! between which this number changes.

use super::cycles::prove;
use super::field::ParameterBox;
use crate::numerics::Interval;
use crate::numerics::elementary::powi;
use crate::oscillator::Symbol;

/// Part of a range, with what is proved for all values in it.
#[derive(Clone, Debug, PartialEq)]
pub struct RangePiece {
    /// The values of the parameter.
    pub over: Interval,
    /// Whether each cycle attracts, smallest cycle first; `None` where their number is open.
    pub cycles: Option<Vec<bool>>,
}

/// Whether each cycle attracts, for all parameters of the box; `None` where that is not proved.
pub fn cycles_at(parameters: &ParameterBox) -> Option<Vec<bool>> {
    let proof = prove(parameters, &[]);
    proof.is_complete().then(|| proof.cycles.iter().map(|cycle| cycle.stable).collect())
}

/// A range of a parameter, decided piece by piece.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Range {
    /// Its pieces, in order.
    pub pieces: Vec<RangePiece>,
    /// Where the number of cycles changes.
    pub changes: Vec<CountChange>,
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

/// Decides a range of values.
pub fn range(base: &ParameterBox, symbol: Symbol, (low, high): (f64, f64)) -> Range {
    /// Number of initial parts of the range.
    const PARTS: i32 = 16;
    /// Halvings of a part.
    const HALVINGS: u32 = 10;
    let mut ask = |value: Interval| cycles_at(&base.with(symbol, value));
    let mut pieces = Vec::new();
    let mut from = low;
    for part in 1..=PARTS {
        let to = low + (high - low) * f64::from(part) / f64::from(PARTS);
        let to = if part == PARTS { high } else { to };
        split(&mut ask, Interval::new(from, to), HALVINGS, &mut pieces);
        from = to;
    }
    let mut changes = Vec::new();
    for three in pieces.windows(3) {
        let [before, open, after] = three else { continue };
        if let (Some(below), None, Some(above)) = (&before.cycles, &open.cycles, &after.cycles)
            && below != above
        {
            let between = narrowed(&mut ask, open.over, [below, above]);
            changes.push(CountChange { between, below: below.clone(), above: above.clone() });
        }
    }
    Range { pieces, changes }
}

/// Decides an interval of values, or its halves.
fn split(
    ask: &mut impl FnMut(Interval) -> Option<Vec<bool>>,
    over: Interval,
    halvings: u32,
    pieces: &mut Vec<RangePiece>,
) {
    let middle = over.middle();
    let cycles = ask(over);
    if cycles.is_none() && halvings > 0 && middle > over.lower() && middle < over.upper() {
        split(ask, Interval::new(over.lower(), middle), halvings - 1, pieces);
        return split(ask, Interval::new(middle, over.upper()), halvings - 1, pieces);
    }
    match pieces.last_mut() {
        Some(last) if last.cycles == cycles => last.over = last.over.hull(over),
        _ => pieces.push(RangePiece { over, cycles }),
    }
}

/// Narrows an interval of values over which the cycles change, while both ends remain proved.
fn narrowed(
    ask: &mut impl FnMut(Interval) -> Option<Vec<bool>>,
    over: Interval,
    [below, above]: [&Vec<bool>; 2],
) -> Interval {
    let (mut low, mut high) = (over.lower(), over.upper());
    while let middle = Interval::new(low, high).middle()
        && middle > low
        && middle < high
    {
        match ask(Interval::point(middle)) {
            Some(cycles) if cycles == *below => low = middle,
            Some(cycles) if cycles == *above => high = middle,
            _ => break,
        }
    }
    Interval::new(low, high)
}

/// The change between the values `at - away abs(at)` and `at + away abs(at)`, if there is one.
pub fn change_within(
    base: &ParameterBox,
    symbol: Symbol,
    at: f64,
    away: f64,
) -> Option<CountChange> {
    let ask = |value: f64| cycles_at(&base.with(symbol, Interval::point(value)));
    let (low, high) = (at - away * at.abs(), at + away * at.abs());
    let (below, above) = (ask(low)?, ask(high)?);
    let between = Interval::new(low, high);
    (below != above).then_some(CountChange { between, below, above })
}

/// The change nearest to a value, if there is one: between values on both sides at which the numbers of cycles
/// are proved and differ.
pub fn change_near(base: &ParameterBox, symbol: Symbol, hint: f64) -> Option<CountChange> {
    /// Distances to try, as powers of ten relative to the value.
    const AWAY: std::ops::RangeInclusive<i32> = -12..=-3;
    let mut ask = |value: Interval| cycles_at(&base.with(symbol, value));
    let mut found = AWAY.map(|power| powi(10.0, power));
    let found = found.find_map(|away| change_within(base, symbol, hint, away))?;
    let between = narrowed(&mut ask, found.between, [&found.below, &found.above]);
    Some(CountChange { between, ..found })
}
