//! Where a level curve crosses an arc around one of its points.

use super::target::LevelEnd;
use crate::flow::{Cost, Limits, Result};
use crate::numerics::{PlaceTolerance, illinois, sin_cos, try_bisect};
use crate::scan::Scan;

/// A place within both ranges, each from 0 to 1.
pub(super) type Place = [f64; 2];

/// By how much the column is larger than the value, or why it has no number.
pub(super) type Excess = Result<f64, LevelEnd>;

/// Error of a point, as a part of the ranges.
pub(super) const ERROR: f64 = 1e-13;

/// Largest angle between a curve and its course so far.
const WIDEST: f64 = 2.5;

/// An arc around a point of a curve; outside of the ranges, their edge stands for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelArc {
    pub from: Place,
    /// Angle at which the curve is expected.
    pub heading: f64,
    pub reach: f64,
    /// 1 where the column is larger to the left of the curve, -1 where it is to the right.
    pub side: f64,
}

/// A point of a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelPoint {
    pub place: Place,
    /// By how much the column jumps there; 0 where it goes through the value.
    pub step: f64,
    /// Whether the curve leaves the ranges there.
    pub end: Option<LevelEnd>,
}

impl LevelArc {
    /// The point so far along the heading, and so far across, to the left; and the same within the ranges.
    fn point(&self, along: f64, across: f64) -> [Place; 2] {
        let (sin, cos) = sin_cos(self.heading);
        let [x, y] = self.from;
        let point = [x + along * cos - across * sin, y + along * sin + across * cos];
        [point, point.map(|part| part.clamp(0.0, 1.0))]
    }

    /// The point at an angle from the heading.
    fn at(&self, turn: f64) -> [Place; 2] {
        let (sin, cos) = sin_cos(turn);
        self.point(self.reach * cos, self.reach * sin)
    }
}

/// What measures, and what that has cost so far.
pub(super) struct LevelMeter<'a> {
    pub scan: &'a Scan,
    /// The place of the column in a row, and the value.
    pub column: usize,
    pub value: f64,
    /// Largest distance between a curve and its chords.
    pub chord: f64,
    pub limits: &'a Limits<'a>,
    pub cost: Cost,
}

impl LevelMeter<'_> {
    /// The values of both numbers at a place.
    pub fn values(&self, place: Place) -> [f64; 2] {
        [0, 1].map(|axis| self.scan.over()[axis].at(place[axis]))
    }

    /// What is measured at a place, and what it costs.
    pub fn measured(&self, place: Place) -> Result<(Excess, Cost)> {
        let row = self.scan.row_at(self.values(place), self.limits)?;
        let excess = row.values[self.column].number().map(|number| number - self.value);
        let why = row.reason.as_ref().map_or(LevelEnd::Ceases, |_| LevelEnd::Unknown);
        Ok((excess.ok_or(why), row.cost))
    }

    pub fn excess(&mut self, place: Place) -> Result<Excess> {
        let measured = self.measured(place)?;
        Ok(self.cost.spend(measured))
    }

    /// What stands for a column without a number on an arc: as long as there are numbers at the end of one side, what would be
    /// at the other side, farther away. Not a number where neither end has one, or both have.
    fn missing(&mut self, arc: &LevelArc) -> Result<f64> {
        let [left, right] = [WIDEST, -WIDEST].map(|turn| arc.at(turn)[1]);
        Ok(match (self.excess(left)?, self.excess(right)?) {
            (Err(_), Ok(_)) => f64::INFINITY,
            (Ok(_), Err(_)) => f64::NEG_INFINITY,
            _ => f64::NAN,
        })
    }

    /// Where the curve crosses an arc, or why it does not.
    pub fn crossing(&mut self, arc: &LevelArc) -> Result<Result<LevelPoint, LevelEnd>> {
        /// Angles within which the curve is sought, one after the other.
        const TURNS: [f64; 4] = [0.02, 0.1, 0.5, WIDEST];
        let (mut missing, mut why) = (None, LevelEnd::Unknown);
        let mut value = |turn: f64| match (self.excess(arc.at(turn)[1])?, missing) {
            (Ok(excess), _) => Ok(arc.side * excess),
            (Err(_), Some(missing)) => Ok(missing),
            (Err(end), None) => {
                why = end;
                Ok(*missing.insert(self.missing(arc)?))
            }
        };
        let mut ends = [(0.0, f64::NAN); 2];
        for turn in TURNS {
            ends = [(-turn, value(-turn)?), (turn, value(turn)?)];
            if ends[0].1 * ends[1].1 <= 0.0 {
                break;
            }
        }
        let [near, far] = ends;
        if (near.1 * far.1).is_nan() || near.1 * far.1 > 0.0 {
            return Ok(Err(why));
        }
        let width = ERROR / arc.reach;
        let slope = ((far.1 - near.1) / (far.0 - near.0)).abs();
        let small = if slope.is_finite() { slope * width } else { 0.0 };
        let [best, other] = illinois([near, far], small, PlaceTolerance::Absolute(width), value)?;
        let step = if best.1.abs() <= small {
            0.0
        } else {
            (best.1 - other.1).abs()
        };
        if !step.is_finite() {
            return Ok(Err(why));
        }
        let [point, place] = arc.at(best.0);
        Ok(Ok(LevelPoint { place, step, end: (point != place).then_some(LevelEnd::Edge) }))
    }

    /// Where a curve that goes on along an arc's heading ends on the border of what has numbers; `None` unless that border is
    /// near on one side, and the column goes through the value along it.
    pub fn end(&mut self, arc: &LevelArc) -> Result<Option<Place>> {
        /// Error of the end along the curve, as a part of the ranges: rounding blurs the column near a fold.
        const ALONG: f64 = 3e-10;
        let missing = self.missing(arc)?;
        if missing.is_nan() {
            return Ok(None);
        }
        let (reach, towards) = (arc.reach, missing.signum());
        let (from, to) = (self.at_border(arc, 0.0, towards)?, self.at_border(arc, reach, towards)?);
        let ends = from.zip(to).map(|(from, to)| [(0.0, from.0), (reach, to.0)]);
        let Some(ends) = ends.filter(|[from, to]| from.1 * to.1 <= 0.0) else { return Ok(None) };
        // Secants: near its end a curve is short, and the column along the border nearly straight.
        let ([mut before, mut last], mut end) = (ends, None);
        for _ in 0..5 {
            let along = last.0 - last.1 * (last.0 - before.0) / (last.1 - before.1);
            let Some((limit, place)) = self.at_border(arc, along, towards)? else { break };
            (before, last, end) = (last, (along, limit), Some(place));
            if (last.0 - before.0).abs() < ALONG {
                break;
            }
        }
        Ok(end)
    }

    /// The column at the border of what has numbers, by its limit there, on a line across the heading; and where that is.
    fn at_border(
        &mut self,
        arc: &LevelArc,
        along: f64,
        towards: f64,
    ) -> Result<Option<(f64, Place)>> {
        /// The square root of the distance from the border at which the column is read: its extrapolation has errors of the
        /// order of the cube, and of the rounding of the border over this.
        const ROOT: f64 = 1e-4;
        /// From a thousandth of the ranges to rounding.
        const HALVINGS: u32 = 42;
        let at = |across: f64| arc.point(along, towards * across)[1];
        let mut lacks = |across: f64| Ok(self.excess(at(across))?.is_err());
        if lacks(-arc.reach)? || !lacks(arc.reach)? {
            return Ok(None);
        }
        let (inside, _) = try_bisect(-arc.reach, arc.reach, HALVINGS, lacks)?;
        let mut beside = |times: f64| self.excess(at(inside - times * ROOT * times * ROOT));
        let (Ok(one), Ok(two), Ok(three)) = (beside(1.0)?, beside(2.0)?, beside(3.0)?) else {
            return Ok(None);
        };
        // A parabola over the root of the distance.
        Ok(Some((3.0 * (one - two) + three, at(inside))))
    }
}
