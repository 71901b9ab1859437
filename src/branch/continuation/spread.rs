//! Points spread evenly over a followed curve, as a diagram shows it.
//!
//! Continuation takes strides as long as the curve lets it. A table or a picture wants points at even
//! distances: they are interpolated between those that were followed. Next to a fold there may be no cycle at
//! an interpolated parameter, so that those are corrected to the curve.

use nalgebra::Vector3;

use super::{CurvePoint, Tangent, is_beside};
use crate::branch::CycleCurve;
use crate::flow::Result;
use crate::numerics::real;
use crate::portrait::Route;

/// Where a cycle of the curve is to be found.
pub struct CurvePlace {
    /// The parameter.
    pub p: f64,
    /// Logarithm of the clearance: of a cycle, or interpolated.
    pub u: f64,
    /// Logarithm of its multiplier, to tell folds.
    pub log_multiplier: f64,
}

impl From<&CurvePoint> for CurvePlace {
    fn from(point: &CurvePoint) -> Self {
        CurvePlace { p: point.p, u: point.u, log_multiplier: point.log_multiplier }
    }
}

impl CycleCurve<'_> {
    /// `count` places spread evenly over a followed curve, both ends included.
    ///
    /// Distance is measured in p, u and amplitude together, each relative to what the curve spans: this
    /// is how far apart points look on a diagram. Between followed points the curve is interpolated by
    /// polynomials through six of them.
    pub fn spread(&mut self, points: &[CurvePoint], count: usize) -> Result<Vec<CurvePlace>> {
        let arc = arc_lengths(points);
        let total = arc[arc.len() - 1];
        if total == 0.0 {
            return Ok(points.iter().map(CurvePlace::from).collect());
        }
        let window = points.len().min(6);
        let mut spread = vec![CurvePlace::from(&points[0])];
        self.slope_in_p = None;
        for index in 1..count.saturating_sub(1) {
            let s = total * real(index) / real(count - 1);
            let after = arc.partition_point(|&length| length <= s).clamp(1, points.len() - 1);
            let base = after.saturating_sub(window / 2).min(points.len() - window);
            let pair = [&points[after - 1], &points[after]];
            let smooth = interpolate(&points[base..base + window], &arc[base..base + window], s);
            let fraction = (s - arc[after - 1]) / (arc[after] - arc[after - 1]);
            // A polynomial through points at uneven distances may lead anywhere; the chord does not.
            let beside = is_beside(pair, smooth, self.scale);
            if beside && let Some(place) = between_steep(pair, smooth) {
                spread.push(place);
                continue;
            }
            let mut found = if beside { self.corrected(pair, smooth)? } else { None };
            if found.is_none() {
                let [one, other] = pair;
                let on_chord = |from: f64, to: f64| from + fraction * (to - from);
                let near = (on_chord(one.u, other.u), on_chord(one.p, other.p));
                found = self.corrected(pair, near)?;
            }
            spread.extend(found);
        }
        spread.push(CurvePlace::from(&points[points.len() - 1]));
        Ok(spread)
    }

    /// The cycle of the curve next to an interpolated place.
    fn corrected(
        &mut self,
        pair: [&CurvePoint; 2],
        near: (f64, f64),
    ) -> Result<Option<CurvePlace>> {
        let [one, other] = pair;
        let (tangent, _) = Tangent::between(one, other, self.scale);
        let growth = [0, 1].map(|i| 0.5 * (one.closing.growth[i] + other.closing.growth[i]));
        let route = Route::steadiest(growth);
        self.probe_within((other.p - one.p).abs() / self.scale);
        let found = self.correct(near, tangent, route)?;
        let found = found.filter(|it| is_beside(pair, (it.u, it.p), self.scale));
        Ok(found.as_ref().map(CurvePlace::from))
    }
}

/// An interpolated place where the curve is a graph over the parameter: between two points that are not
/// a fold's neighbours, the one cycle at this parameter is what Newton's method finds from there.
fn between_steep([one, other]: [&CurvePoint; 2], (u, p): (f64, f64)) -> Option<CurvePlace> {
    /// Logarithm of a multiplier far enough from that of a fold.
    const STEEP: f64 = 0.3;
    let log_multiplier = 0.5 * (one.log_multiplier + other.log_multiplier);
    let steep = one.log_multiplier.abs().min(other.log_multiplier.abs()) >= STEEP
        && one.log_multiplier.signum() == other.log_multiplier.signum();
    let within = |from: f64, to: f64, at: f64| at > from.min(to) && at < from.max(to);
    let place = CurvePlace { p, u, log_multiplier };
    (steep && within(one.p, other.p, p) && within(one.u, other.u, u)).then_some(place)
}

/// Length along a curve as it looks on a diagram, from its first point to each.
fn arc_lengths(points: &[CurvePoint]) -> Vec<f64> {
    let place = |it: &CurvePoint| Vector3::new(it.p, it.u, it.closing.clearances[0].value);
    let places: Vec<Vector3<f64>> = points.iter().map(place).collect();
    let low = places.iter().fold(Vector3::repeat(f64::INFINITY), |low, it| low.inf(it));
    let high = places.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, it| high.sup(it));
    let spans = (high - low).sup(&Vector3::repeat(f64::MIN_POSITIVE));
    let mut lengths = vec![0.0];
    for pair in places.windows(2) {
        let apart = (pair[1] - pair[0]).component_div(&spans);
        lengths.push(lengths[lengths.len() - 1] + apart.norm());
    }
    lengths
}

/// `(u, p)` at arc length `s` on the polynomials through these points (Lagrange).
fn interpolate(points: &[CurvePoint], arc: &[f64], s: f64) -> (f64, f64) {
    let mut place = (0.0, 0.0);
    for (i, point) in points.iter().enumerate() {
        let others = arc.iter().enumerate().filter(|&(j, _)| j != i);
        let weight: f64 = others.map(|(_, &other)| (s - other) / (arc[i] - other)).product();
        place = (place.0 + weight * point.u, place.1 + weight * point.p);
    }
    place
}
