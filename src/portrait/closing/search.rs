//! A search for all roots of a smooth function on an interval, that cannot pass over a close pair.
//!
//! The function is a difference `rise - fall` of two increasing functions: for limit cycles without a belt, where a
//! swing ends and where the next one has to start; for a return map, the image of a turning point and the point itself.
//! That alone proves intervals empty: between a and b the difference lies between `rise(a) - fall(b)` and
//! `rise(b) - fall(a)`. Where this is not enough, the cubic through values and slopes at both ends is compared with the
//! middle: if the cubic stays away from zero by more than eight times its error there, the interval is taken to be
//! empty; if it crosses zero once and monotonically, to hold one root. Otherwise the interval is halved, and an interval
//! at the limit of halving whose slopes point at an extremum towards zero is decided at that extremum.
//!
//! Guarantee: every interval between the roots found is excluded by monotonicity, or by a cubic whose error was
//! measured. Assumption: the function varies on scales not below the finest interval; those at which it does are told.

use crate::numerics::{Hermite, PlaceTolerance, illinois, root};

/// Relative width to which an extremum is sought: rounding.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// How far the cubic must stay from zero, in units of its error at the middle.
const SAFETY: f64 = 8.0;

/// Error of the cubic at the middle, as a fraction of the least value at both ends and there, that cannot hide a pair of
/// roots.
const PREDICTED: f64 = 0.05;

/// Values of the two increasing functions, their difference, and its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Where.
    pub at: f64,
    /// The increasing function that counts positive; `+inf` beyond its domain.
    pub rise: f64,
    /// The increasing function that counts negative; `+inf` beyond its domain.
    pub fall: f64,
    /// Their difference, which may be known better than both: positive outside the domain of `rise`, negative outside
    /// that of `fall`.
    pub value: f64,
    /// Slope of the difference (of no meaning where it is infinite).
    pub slope: f64,
}

impl Node {
    /// From the values of both functions.
    pub fn new(at: f64, rise: f64, fall: f64, slope: f64) -> Self {
        Node { at, rise, fall, value: rise - fall, slope }
    }

    /// Of the growth of an increasing map over its argument: the map less the argument.
    pub fn of_growth(at: f64, value: f64, slope: f64) -> Self {
        Node { at, rise: at + value, fall: at, value, slope }
    }

    fn is_finite(&self) -> bool {
        self.value.is_finite() && self.slope.is_finite()
    }
}

/// Two nodes between which the function changes its sign.
pub type Bracket = (Node, Node);

/// The places of a bracket.
pub fn places((low, high): &Bracket) -> root::Bracket {
    root::Bracket { low: low.at, high: high.at, rising: high.value > low.value }
}

/// A search, and what it found so far.
#[derive(Default)]
pub struct RootSearch {
    /// Half of the length of intervals that are not halved any more.
    pub finest: f64,
    /// Values below this count as zero: where all do, roots cannot be told apart, and none is found. If it is above
    /// 0, a function that rises or falls at both ends and in the middle is trusted to do so between, too, and one that a
    /// cubic predicts to a few percent to hold no more roots than the cubic.
    pub nothing: f64,
    /// Brackets of the roots, in their order.
    pub found: Vec<Bracket>,
    /// Intervals that were too short to halve and yet not decided by a cubic: roots may be missing there.
    pub unresolved: Vec<(f64, f64)>,
}

impl RootSearch {
    /// Collects brackets of all roots between two nodes.
    ///
    /// `function(at, fine)` may be off by `blur` where it is not asked to be fine; where that is too much to decide, it
    /// is asked again. A `blur` of 0 asks it to be fine from the beginning.
    pub fn between<E>(
        &mut self,
        low: Node,
        high: Node,
        blur: f64,
        function: &mut impl FnMut(f64, bool) -> Result<Node, E>,
    ) -> Result<(), E> {
        /// Beside a blur, values this many times larger decide; bounds below rounding never do.
        const CLEAR: f64 = 4.0;
        const ROUNDING: f64 = 1e-12;
        let bound = blur.max(ROUNDING);
        let surely_negative = high.rise < low.fall - bound;
        let surely_positive = low.rise > high.fall + bound;
        if surely_negative || surely_positive {
            return Ok(());
        }
        let blurred = |node: &Node| node.value.abs() < CLEAR * blur;
        let width = high.at - low.at;
        let mut middle = low;
        if !blurred(&low) && !blurred(&high) {
            middle = function(low.at + 0.5 * width, blur == 0.0)?;
        }
        let nodes = [low, middle, high];
        if nodes.iter().any(blurred) {
            let (low, high) = (function(low.at, true)?, function(high.at, true)?);
            return self.between(low, high, 0.0, function);
        }
        let changes = (low.value > 0.0) != (high.value > 0.0);
        let halves = [(low, middle), (middle, high)];
        let foretold = (middle.value - cubic(&low, &high).at(0.5)).abs();
        if nodes.iter().all(Node::is_finite) {
            let error = SAFETY * foretold + blur;
            if !changes && halves.iter().all(|(a, b)| stays_away(a, b, error)) {
                return Ok(());
            }
            if changes && halves.iter().all(|(a, b)| is_monotone(a, b, error)) {
                let second = (low.value > 0.0) == (middle.value > 0.0);
                self.found.push(halves[usize::from(second)]);
                return Ok(());
            }
        }
        // If all values have one sign and all slopes another, there is no room for roots, however rough the function.
        let one_way = low.slope * middle.slope > 0.0 && middle.slope * high.slope > 0.0;
        let least = nodes.iter().map(|node| node.value.abs()).fold(f64::INFINITY, f64::min);
        let predicted = foretold <= self.nothing.max(PREDICTED * least);
        let trusted = predicted || (one_way && foretold < 0.5 * width);
        let settled = self.nothing > 0.0 && trusted;
        let is_finest = width <= 2.0 * self.finest;
        if is_finest && !settled {
            self.unresolved.push((low.at, high.at));
        }
        for (low, high) in halves {
            if is_finest || settled {
                self.decide(low, high, function)?;
            } else {
                self.between(low, high, blur, function)?;
            }
        }
        Ok(())
    }

    /// Collects the roots between two nodes where the function is nearly a cubic: one, or a pair about an extremum.
    fn decide<E>(
        &mut self,
        low: Node,
        high: Node,
        function: &mut impl FnMut(f64, bool) -> Result<Node, E>,
    ) -> Result<(), E> {
        /// What rounding makes of a value of zero, as a part of what counts as zero.
        const ROUNDING: f64 = 0.01;
        if low.value.abs().max(high.value.abs()) < ROUNDING * self.nothing {
            return Ok(());
        }
        if (low.value > 0.0) != (high.value > 0.0) {
            self.found.push((low, high));
        } else if let Some(extremum) = beyond_zero(low, high, function)? {
            self.found.extend([(low, extremum), (extremum, high)]);
        }
        Ok(())
    }
}

/// The cubic with the values and slopes of two nodes.
fn cubic(low: &Node, high: &Node) -> Hermite {
    let width = high.at - low.at;
    let slopes = (width * low.slope, width * high.slope);
    Hermite { values: (low.value, high.value), slopes }
}

/// Whether the cubic through two nodes of one sign stays further than `error` from zero between them.
fn stays_away(low: &Node, high: &Node, error: f64) -> bool {
    let sign = low.value.signum();
    let (cubic, ends) = (cubic(low, high), (sign * low.value).min(sign * high.value));
    let extrema = cubic.extrema().into_iter().flatten();
    let nearest = extrema.map(|t| sign * cubic.at(t)).fold(ends, f64::min);
    nearest > error
}

fn is_monotone(low: &Node, high: &Node, error: f64) -> bool {
    let sign = low.slope.signum();
    let mean = sign * (high.value - low.value) / (high.at - low.at);
    // Sufficient for a monotone cubic (Fritsch and Carlson): end slopes of at most three times the mean.
    let bounded = |slope: f64| sign * slope > 0.0 && sign * slope <= 3.0 * mean;
    bounded(low.slope) && bounded(high.slope) && error < mean * (high.at - low.at)
}

/// Where a function has the other sign between two nodes of one sign whose slopes point at an extremum towards zero.
fn beyond_zero<E>(
    low: Node,
    high: Node,
    function: &mut impl FnMut(f64, bool) -> Result<Node, E>,
) -> Result<Option<Node>, E> {
    let sign = low.value.signum();
    let towards_zero = sign * low.slope < 0.0 && sign * high.slope > 0.0;
    if !(towards_zero && low.is_finite() && high.is_finite()) {
        return Ok(None);
    }
    // A value beyond zero ends the search where an error would.
    let slope = |at| {
        let node = function(at, true).map_err(Err)?;
        let beyond = (node.value > 0.0) != (low.value > 0.0);
        if beyond { Err(Ok(node)) } else { Ok(node.slope) }
    };
    let width = PlaceTolerance::Absolute(ROUNDED * high.at.abs().max(1.0));
    match illinois([(low.at, low.slope), (high.at, high.slope)], 0.0, width, slope) {
        Err(end) => end.map(Some),
        Ok(_) => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `(u - a)(u - b)` as a difference of two increasing functions on [0, 4].
    fn parabola(a: f64, b: f64) -> impl FnMut(f64, bool) -> Result<Node, ()> {
        move |u, _| {
            let rise = u * u + 10.0 * u + a * b;
            Ok(Node {
                value: (u - a) * (u - b),
                ..Node::new(u, rise, (a + b + 10.0) * u, 2.0 * u - a - b)
            })
        }
    }

    fn roots_of(mut function: impl FnMut(f64, bool) -> Result<Node, ()>) -> Vec<Bracket> {
        let mut search = RootSearch { finest: 1e-4, ..RootSearch::default() };
        let (low, high) = (function(0.0, true).unwrap(), function(4.0, true).unwrap());
        search.between(low, high, 0.0, &mut function).unwrap();
        search.found
    }

    #[test]
    fn two_roots_are_bracketed_however_close() {
        for gap in [1.0, 1e-2, 1e-4, 1e-6] {
            let found = roots_of(parabola(1.234_5, 1.234_5 + gap));
            assert_eq!(found.len(), 2, "gap {gap}");
            assert!(found[0].0.at <= 1.234_5 && found[0].1.at >= 1.234_5);
            assert!(found[1].0.at <= 1.234_5 + gap && found[1].1.at >= 1.234_5 + gap);
        }
    }

    #[test]
    fn a_near_miss_is_no_root() {
        for lift in [1e-1, 1e-4, 1e-9] {
            let mut touching = parabola(2.2, 2.2);
            let lifted = |u: f64, fine: bool| {
                touching(u, fine).map(|node| Node {
                    rise: node.rise + lift,
                    value: node.value + lift,
                    ..node
                })
            };
            assert!(roots_of(lifted).is_empty(), "lift {lift}");
        }
    }
}
