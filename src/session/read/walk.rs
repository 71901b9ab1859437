//! Computed branches as a path to walk along: their points and special points, in order along the curves.
//!
//! Everything here is a function of the branches; a diagram with variants has several. A walk holds the point
//! itself and not its index, so that it stays at the same point when the branch is computed again.

use crate::branch::{Branch, SpecialKind};
use crate::numerics::{by_number, hypot, ln};
use crate::scene::{Layer, Span, Topic, View};
use crate::session::{BranchStop, Session};

/// The connected pieces of branches, each a list of stops.
#[derive(Clone, Debug, Default)]
pub struct BranchPath {
    pieces: Vec<Vec<BranchStop>>,
    /// Width of the range of all values, the unit of distances.
    extent: f64,
    /// The same of the values upwards, on curves over two numbers.
    rise: f64,
}

impl Session {
    /// The path that a walk in a plot follows; empty where nothing is shown to walk along.
    pub fn path(&self, plot: usize) -> BranchPath {
        match self.plots[plot].view {
            View::Diagram if self.shows_in(Layer::Branch, plot) => {
                BranchPath::along(&self.branches(plot))
            }
            View::Regimes | View::Scan => {
                let curves = self.curves_over_two(plot).into_iter();
                BranchPath::over_two(curves.map(|(_, curve)| curve).collect())
            }
            _ => BranchPath::default(),
        }
    }

    /// Whether that path is up to date.
    pub fn is_path_fresh(&self, plot: usize) -> bool {
        let topics = [Topic::Branch, Topic::Regimes, Topic::Level];
        topics.into_iter().all(|topic| self.is_fresh(topic, plot))
    }
}

/// The position of a stop: index of its piece, and its index in the piece.
type Position = (usize, usize);

impl BranchPath {
    /// The way along branches, each of a variant. Walking onward leads from the end with the smaller value to
    /// the other end.
    pub fn along(branches: &[(usize, &Branch)]) -> Self {
        let points = branches.iter().flat_map(|(_, branch)| branch.pieces.iter().flatten());
        let values = Span::covering(points.map(|point| point.value));
        let (pieces, extent) = (Vec::new(), values.map_or(1.0, Span::width));
        let mut way = BranchPath { pieces, extent, rise: 1.0 };
        for (variant, branch) in branches {
            for piece in branch.pieces.iter().filter(|piece| !piece.is_empty()) {
                let mut stops: Vec<BranchStop> =
                    piece.iter().map(|point| BranchStop::on(*variant, point)).collect();
                if stops[0].value > stops[stops.len() - 1].value {
                    stops.reverse();
                }
                way.pieces.push(stops);
            }
            for special in &branch.special {
                way.insert(BranchStop::at(*variant, special));
            }
        }
        way
    }

    /// The way along curves over two numbers, in their order.
    pub fn over_two(curves: Vec<Vec<[f64; 2]>>) -> Self {
        let width = |axis: usize| {
            let all = Span::covering(curves.iter().flatten().map(|point| point[axis]));
            all.map_or(1.0, Span::width)
        };
        let (extent, rise) = (width(0), width(1));
        let stops = |curve: Vec<[f64; 2]>| curve.into_iter().map(BranchStop::over).collect();
        BranchPath { pieces: curves.into_iter().map(stops).collect(), extent, rise }
    }

    /// Whether there is nothing to walk along.
    pub fn is_empty(&self) -> bool {
        self.pieces.iter().all(Vec::is_empty)
    }

    /// Inserts a special point where the detour over it is shortest.
    fn insert(&mut self, special: BranchStop) {
        let apart = |one: Option<&BranchStop>, other: Option<&BranchStop>| {
            one.zip(other).map_or(0.0, |(one, other)| self.apart(one, other))
        };
        let around = |(piece, gap): Position| {
            let piece = &self.pieces[piece];
            (gap.checked_sub(1).map(|last| &piece[last]), piece.get(gap))
        };
        let detour = |place: &Position| {
            let (before, after) = around(*place);
            apart(before, Some(&special)) + apart(Some(&special), after) - apart(before, after)
        };
        let own = |piece: &[BranchStop]| piece[0].variant == special.variant;
        let pieces = (0..).zip(&self.pieces).filter(|(_, piece)| own(piece));
        let gaps = pieces.flat_map(|(index, piece)| (0..=piece.len()).map(move |gap| (index, gap)));
        let fitting = gaps.filter(|place| admits(special.special, around(*place)));
        if let Some((piece, gap)) = fitting.min_by(by_number(detour)) {
            self.pieces[piece].insert(gap, special);
        }
    }

    /// The distance of two points: by their values in units of the whole range, and by the logarithm of their
    /// sizes. For a cycle at infinity only the value counts. Points of different branches are infinitely far
    /// apart.
    fn apart(&self, one: &BranchStop, other: &BranchStop) -> f64 {
        if one.variant != other.variant {
            return f64::INFINITY;
        }
        let size =
            |stop: &BranchStop| stop.cycle.map(|cycle| ln(cycle.q_max.max(f64::MIN_POSITIVE)));
        let rises = one.up.zip(other.up).map_or(0.0, |(one, other)| (one - other) / self.rise);
        let values = hypot((one.value - other.value) / self.extent, rises);
        let sizes = size(one).zip(size(other));
        sizes.map_or(values, |(one, other)| hypot(values, one - other))
    }

    /// All stops with their positions.
    fn stops(&self) -> impl Iterator<Item = (Position, &BranchStop)> {
        (0..).zip(&self.pieces).flat_map(|(piece, stops)| {
            (0..).zip(stops).map(move |(place, stop)| ((piece, place), stop))
        })
    }

    /// The stop for which `measure` is smallest.
    pub fn nearest(&self, measure: impl Fn(&BranchStop) -> f64) -> Option<BranchStop> {
        self.pieces.iter().flatten().copied().min_by(by_number(measure))
    }

    /// The start of a walk at a value of the parameter: the stop beside it on the innermost cycle there, which
    /// borders the basin; if there is no cycle, the stop with the nearest value.
    pub fn start(&self, value: f64) -> Option<BranchStop> {
        let distance = |stop: &BranchStop| (stop.value - value).abs();
        let beside = self.pieces.iter().flat_map(|piece| piece.windows(2)).filter_map(|pair| {
            let around = (pair[0].value <= value) != (pair[1].value <= value);
            pair.iter().copied().min_by(by_number(distance)).filter(|_| around)
        });
        let size = |stop: &BranchStop| stop.cycle.map_or(f64::INFINITY, |cycle| cycle.q_max);
        beside.min_by(by_number(size)).or_else(|| self.nearest(distance))
    }

    /// The same stop on this way, or the nearest one.
    pub fn again(&self, held: &BranchStop) -> Option<BranchStop> {
        self.place(held).map(|(piece, place)| self.pieces[piece][place])
    }

    fn place(&self, held: &BranchStop) -> Option<Position> {
        let same = self.stops().find(|(_, stop)| *stop == held);
        let distance = |(_, stop): &(Position, &BranchStop)| self.apart(held, stop);
        let nearest = || self.stops().min_by(by_number(distance));
        same.or_else(nearest).map(|(place, _)| place)
    }

    /// The stop `count` stops further along the same piece, or the end of the piece.
    pub fn further(&self, held: &BranchStop, count: isize) -> Option<BranchStop> {
        let (piece, place) = self.place(held)?;
        let stops = &self.pieces[piece];
        Some(stops[place.saturating_add_signed(count).min(stops.len() - 1)])
    }

    /// The next special point or end of a piece; continues on other pieces, and around after the last one.
    pub fn landmark(&self, held: &BranchStop, onward: bool) -> Option<BranchStop> {
        let here = self.place(held)?;
        let marked = |(piece, place): Position, stop: &BranchStop| {
            stop.special.is_some() || place == 0 || place + 1 == self.pieces[piece].len()
        };
        let landmarks = || self.stops().filter(|(place, stop)| marked(*place, stop));
        let next = if onward {
            landmarks().find(|(place, _)| *place > here).or_else(|| landmarks().next())
        } else {
            landmarks().filter(|(place, _)| *place < here).last().or_else(|| landmarks().last())
        };
        next.map(|(_, stop)| *stop)
    }
}

/// Whether a special point can lie between two stops, one of which is missing at the end of a piece: a fold
/// where stability changes, a crossing between values of different signs, and an end at an end.
fn admits(kind: Option<SpecialKind>, around: (Option<&BranchStop>, Option<&BranchStop>)) -> bool {
    let stable = |stop: &BranchStop| stop.cycle.is_some_and(|cycle| cycle.stable);
    match (kind, around) {
        (Some(SpecialKind::Fold), (Some(one), Some(other))) => stable(one) != stable(other),
        (Some(SpecialKind::ZeroCrossing), (Some(one), Some(other))) => {
            (one.value < 0.0) != (other.value < 0.0)
        }
        (Some(SpecialKind::Escape | SpecialKind::Hopf), (None, _) | (_, None)) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::branch::along::{Points, branch};
    use crate::flow::Limits;
    use crate::model::{Knob, Parameters};

    const FOLDED: Parameters = Parameters { d: 0.0, d2: 0.2, d3: 0.5, r: 0.1 };

    fn over(parameters: &Parameters, symbol: Knob, range: (f64, f64)) -> BranchPath {
        let found =
            branch(parameters, symbol, range, Points::Even(60), 1e-8, &Limits::PATIENT).unwrap();
        BranchPath::along(&[(0, &found)])
    }

    /// The landmarks from the first stop of the first piece until it is reached again.
    fn landmarks(way: &BranchPath) -> Vec<BranchStop> {
        let first = way.pieces[0][0];
        let mut found = vec![first];
        while let Some(next) = way.landmark(&found[found.len() - 1], true)
            && next != first
        {
            found.push(next);
        }
        found
    }

    #[test]
    fn the_fold_stands_between_the_unstable_and_the_stable_cycles() {
        let way = over(&FOLDED, Knob::D, (-0.9, 0.1));
        let stops = &way.pieces[0];
        let fold = stops.iter().position(|stop| stop.special == Some(SpecialKind::Fold)).unwrap();
        assert!((stops[fold].value + 0.172_784_103_071_94).abs() < 1e-12);
        let stable = |stop: &BranchStop| stop.cycle.unwrap().stable;
        assert!(stops[..fold].iter().all(|stop| !stable(stop)));
        assert!(stops[fold + 1..].iter().all(stable));
        assert!(stops.iter().all(|stop| stop.value <= stops[fold].value));
        let kinds: Vec<_> = landmarks(&way).iter().map(|stop| stop.special).collect();
        assert_eq!(kinds, [None, Some(SpecialKind::Fold), None], "and around");
        // There and back again.
        let back = way.landmark(&stops[0], false).unwrap();
        assert_eq!(&back, stops.last().unwrap());
        assert_eq!(way.further(&stops[fold], -1), Some(stops[fold - 1]));
        assert_eq!(way.further(&stops[0], isize::MIN), Some(stops[0]));
        assert_eq!(way.further(&stops[0], isize::MAX).as_ref(), stops.last());
    }

    #[test]
    fn of_several_branches_each_is_walked_by_itself() {
        let frictions = [0.05, 0.2];
        let found = frictions.map(|r| {
            let parameters = Parameters { r, ..FOLDED };
            branch(&parameters, Knob::D, (-0.9, 0.1), Points::Even(60), 1e-8, &Limits::PATIENT)
                .unwrap()
        });
        let way = BranchPath::along(&[(0, &found[0]), (1, &found[1])]);
        let marks: Vec<_> =
            landmarks(&way).iter().map(|stop| (stop.variant, stop.special)).collect();
        let fold = Some(SpecialKind::Fold);
        let ends = [(0, None), (0, fold), (0, None), (1, None), (1, fold), (1, None)];
        assert_eq!(marks, ends, "from one branch on to the other, and around");
        for (index, found) in found.iter().enumerate() {
            let alone = BranchPath::along(&[(index, found)]);
            assert_eq!(way.pieces[index], alone.pieces[0]);
            let held = alone.start(-0.6).unwrap();
            assert_eq!(way.again(&held), Some(held));
        }
    }

    #[test]
    fn a_walk_begins_on_the_border_of_the_basin() {
        let way = over(&FOLDED, Knob::D, (-0.9, 0.1));
        let start = way.start(-0.4).unwrap();
        assert!(!start.cycle.unwrap().stable && (start.value + 0.4).abs() < 0.05);
        // Beyond the fold there is no cycle: the nearest value is that of the fold.
        assert_eq!(way.start(0.0).unwrap().special, Some(SpecialKind::Fold));
    }

    #[test]
    fn escape_and_the_vanishing_cycle_end_their_branches_and_zero_is_crossed_on_the_way() {
        for (parameters, kind, at) in [
            (Parameters { d2: 0.5, d3: 0.0, ..FOLDED }, SpecialKind::Escape, "end"),
            (Parameters { d2: 0.0, r: 0.0, ..FOLDED }, SpecialKind::Hopf, "end"),
            (Parameters { d2: 0.0, d3: -0.5, ..FOLDED }, SpecialKind::ZeroCrossing, "way"),
        ] {
            let way = over(&parameters, Knob::D, (-0.5, 0.1));
            let [stops] = &way.pieces[..] else { panic!("one piece for {kind:?}") };
            let place = stops.iter().position(|stop| stop.special == Some(kind)).unwrap();
            let is_end = place == 0 || place + 1 == stops.len();
            assert_eq!(if is_end { "end" } else { "way" }, at, "{kind:?} at {place}");
            if kind == SpecialKind::ZeroCrossing {
                assert!(stops[place - 1].value < 0.0 && stops[place + 1].value > 0.0);
            }
        }
    }

    #[test]
    fn a_point_is_found_again_on_a_branch_computed_anew() {
        let way = over(&FOLDED, Knob::D, (-0.9, 0.1));
        let held = way.start(-0.4).unwrap();
        let closer = over(&FOLDED, Knob::D, (-0.5, -0.1));
        let again = closer.again(&held).unwrap();
        assert!((again.value - held.value).abs() < 0.02);
        assert_eq!(again.cycle.unwrap().stable, held.cycle.unwrap().stable);
        assert_eq!(closer.again(&again), Some(again));
    }
}
