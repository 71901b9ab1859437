//! One curve of limit cycles in the plane of `u = ln c0` and a parameter p, followed through folds.
//!
//! Pseudo-arclength continuation: from a point with a tangent, predict along the tangent and correct by
//! Newton's method on the closing equation together with the demand to stay on the line through the
//! prediction across the tangent. The slope in u is exact (the multiplier), the slope in p a difference
//! quotient that is renewed only when the correction converges slowly. Lengths are measured with p in
//! units of the range and u in units of 4.

mod point;
mod spread;

use point::UNIT_OF_U;
pub use point::{CurvePoint, Tangent, covers, is_beside, passes};
pub use spread::CurvePlace;

use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::{Knob, Parameters, Side};
use crate::numerics::{hypot, ln, try_bisect};
use crate::portrait::{Equation, Route, SwingPair, first_side};

/// Tolerance of the integration steps, in units of that of the points.
const STEP: f64 = 1e-2;

/// Maximum number of evaluations of one swing, a hundred times the usual: beyond, a curve is not followed.
const SWING_BUDGET: u64 = 60_000;

/// Smallest relative error of the clearance at a fold.
const FOLD_TOLERANCE: f64 = 1e-13;

/// Smallest logarithm of the multiplier that counts as zero at a fold.
const LEAST_LOG: f64 = 1e-10;

/// Smallest and largest stride of a difference quotient in p, as fractions of the range: rounding stays behind.
const PROBES: (f64, f64) = (1e-11, 1e-5);

/// Newton steps of a correction before it counts as failed.
const CORRECTIONS: usize = 8;

/// A family of closing equations along a parameter.
#[derive(Clone, Copy)]
pub struct CycleCurve<'a> {
    parameters: Parameters,
    symbol: Knob,
    /// The side of the first swing, the same all along the curve.
    pub side: Side,
    /// Unit of the parameter.
    pub scale: f64,
    /// Relative error accepted in the clearance.
    pub tolerance: f64,
    /// Length of the longest stride of [`CycleCurve::follow`], in units of the usual one.
    pub strides: f64,
    /// Evaluations after which [`CycleCurve::follow`] stops where it is.
    pub budget: u64,
    /// The limits under which it computes.
    pub limits: &'a Limits<'a>,
    /// Stride of a difference quotient in p, as a fraction of the range.
    probe: f64,
    /// Difference quotient in p of the residual of a route, kept from point to point.
    slope_in_p: Option<(Route, f64)>,
    /// What it cost so far.
    pub cost: Cost,
}

impl<'a> CycleCurve<'a> {
    /// The curve along `symbol` with p measured in units of `scale`.
    pub fn new(
        parameters: &Parameters,
        symbol: Knob,
        scale: f64,
        tolerance: f64,
        limits: &'a Limits<'a>,
    ) -> Self {
        CycleCurve {
            parameters: *parameters,
            symbol,
            side: first_side(parameters),
            scale,
            tolerance,
            strides: 1.0,
            budget: u64::MAX,
            limits,
            probe: PROBES.1,
            slope_in_p: None,
            cost: Cost::default(),
        }
    }

    /// The parameters with the varying one at `p`.
    pub fn parameters_at(&self, p: f64) -> Parameters {
        self.parameters.with(self.symbol, p)
    }

    /// Relative error of a swing that tells cycles apart which differ by the tolerance: where two are
    /// about to meet, the residual between them is as small as the square of their distance.
    pub fn fineness(&self) -> f64 {
        (self.tolerance * self.tolerance).max(f64::EPSILON)
    }

    /// The pair of swings at a point that need not close; `None` where they are too costly or too large to
    /// be computed, which ends a curve.
    fn closing(&mut self, route: Route, u: f64, p: f64) -> Result<Option<SwingPair>> {
        let step = STEP * self.tolerance;
        let limits = Limits { evaluations: SWING_BUDGET, ..*self.limits };
        let mut equation = Equation::on_side(&self.parameters_at(p), self.side, step, &limits);
        equation.want_fastest();
        let closing = equation.at(route, u);
        self.cost += equation.cost();
        match closing {
            Err(Reason::Budget { .. } | Reason::OutOfRange) => Ok(None),
            closing => Ok(Some(closing?).filter(|it| it.node.value.is_finite())),
        }
    }

    /// Takes difference quotients over a small part of `stride`: next to an escape the curve bends within less
    /// than a part of the range.
    fn probe_within(&mut self, stride: f64) {
        /// Small enough for two digits of the quotient.
        const PART: f64 = 1e-2;
        self.probe = (PART * stride).clamp(PROBES.0, PROBES.1);
    }

    /// Renews the difference quotient in p.
    fn renew_slope(&mut self, route: Route, u: f64, p: f64, value: f64) -> Result<f64> {
        let stride = self.probe * self.scale;
        let beside = self.closing(route, u, p + stride)?;
        let slope = beside.map_or(f64::NAN, |beside| (beside.node.value - value) / stride);
        self.slope_in_p = slope.is_finite().then_some((route, slope));
        Ok(slope)
    }

    /// Corrects a prediction along the line across `tangent`; `None` where it does not settle.
    pub fn correct(
        &mut self,
        near: (f64, f64),
        tangent: Tangent,
        route: Route,
    ) -> Result<Option<CurvePoint>> {
        let scale = self.scale;
        let per_s = UNIT_OF_U * tangent.p.abs().max(tangent.u.abs());
        let (mut s, mut before) = (0.0, None::<(f64, f64)>);
        for _ in 0..CORRECTIONS {
            // Along the line.
            let (u, p) = (near.0 + UNIT_OF_U * tangent.p * s, near.1 - scale * tangent.u * s);
            let Some(closing) = self.closing(route, u, p)? else { return Ok(None) };
            let value = closing.node.value;
            // Where a swing begins at the very end of the sticking set the slope in u does not exist,
            // and across u it does not matter.
            let in_u = if tangent.p == 0.0 {
                0.0
            } else {
                closing.node.slope * UNIT_OF_U * tangent.p
            };
            let along = match (before, self.slope_in_p) {
                // A secant along the line, which renews the quotient on the way.
                (Some((s_before, value_before)), _) => {
                    let along = (value - value_before) / (s - s_before);
                    if tangent.u.abs() > 0.01 {
                        let slope = (in_u - along) / (scale * tangent.u);
                        self.slope_in_p = slope.is_finite().then_some((route, slope));
                    }
                    along
                }
                (None, _) if tangent.u == 0.0 => in_u,
                (None, Some((of, slope))) if of == route => in_u - slope * scale * tangent.u,
                (None, _) => in_u - self.renew_slope(route, u, p, value)? * scale * tangent.u,
            };
            let change = -value / along;
            if !change.is_finite() || per_s * change.abs() > 1.0 {
                return Ok(None);
            }
            if per_s * change.abs() <= self.tolerance {
                return Ok(Some(CurvePoint::of(closing, p, &self.parameters_at(p))));
            }
            before = Some((s, value));
            s += change;
        }
        Ok(None)
    }

    /// The cycle at exactly `u`, where the residual falls from positive to negative within `range` of p.
    ///
    /// Bisection until Newton's method takes over. In D, D3 and r the residual falls everywhere, because
    /// each of them takes energy from every swing: then it is the only cycle of this clearance.
    pub fn bracketed(&mut self, u: f64, range: (f64, f64)) -> Result<Option<CurvePoint>> {
        /// Newton's method is tried after this many halvings.
        const HALVINGS: u32 = 4;
        /// After so many rounds the bracket is as fine as the parameter.
        const ROUNDS: usize = 15;
        let (mut low, mut high) = range;
        for _ in 0..ROUNDS {
            let falls = |p| Ok(self.value(u, p)? <= 0.0);
            (low, high) = try_bisect(low, high, HALVINGS, falls)?;
            let near = (u, f64::midpoint(low, high));
            let found = self.correct(near, Tangent::ACROSS_P, Route::Mixed)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// The residual of the mixed route, infinite with its sign where a swing does not end.
    fn value(&mut self, u: f64, p: f64) -> Result<f64> {
        let mut equation =
            Equation::on_side(&self.parameters_at(p), self.side, self.tolerance, self.limits);
        let closing = equation.at(Route::Mixed, u);
        self.cost += equation.cost();
        Ok(closing?.node.value)
    }

    /// Where the line between or beyond two points leads after `length` from the second one.
    pub fn ahead(&self, point: &CurvePoint, tangent: Tangent, length: f64) -> (f64, f64) {
        (point.u + UNIT_OF_U * tangent.u * length, point.p + self.scale * tangent.p * length)
    }

    /// Follows the curve from `start` in the direction of growing or falling p until `leaves` says so.
    ///
    /// `leaves` sees each new point; the point that leaves is the last one. Steps adapt to the bend of
    /// the curve and to the convergence of the corrections.
    pub fn follow(
        &mut self,
        start: CurvePoint,
        direction: f64,
        leaves: &dyn Fn(&CurvePoint) -> bool,
    ) -> Result<Vec<CurvePoint>> {
        /// First and smallest stride, as fractions of the range.
        const STRIDES: (f64, f64) = (2e-3, 1e-9);
        /// Maximum number of points of a curve; a closed or endless one stops here.
        const MOST: usize = 4000;
        let mut points = vec![start];
        let Some(mut tangent) = self.first_tangent(&start, direction)? else {
            return Ok(points);
        };
        let mut stride = STRIDES.0;
        while points.len() < MOST && self.cost.evaluations < self.budget {
            let here = points[points.len() - 1];
            let near = self.ahead(&here, tangent, stride);
            self.probe_within(stride);
            let corrected = self.correct(near, tangent, here.route())?;
            // A bend of more than about 15 degrees a step is taken in smaller steps.
            let next = corrected.map(|next| (next, Tangent::between(&here, &next, self.scale)));
            match next {
                Some((next, (chord, _))) if chord.dot(tangent) > 0.97 || stride < 1e-6 => {
                    let bend = (1.0 - chord.dot(tangent)).max(0.0);
                    tangent = self.tangent_at(&next, chord).unwrap_or(chord);
                    // Where the parameter stands still, or a swing starts at the very end of the sticking set,
                    // the branch ends; it may stand still on the way to another size.
                    if !next.closing.duration.is_finite() || !next.log_multiplier.is_finite() {
                        break;
                    }
                    points.push(next);
                    if leaves(&next) {
                        break;
                    }
                    stride *= if bend < 1e-3 {
                        1.7
                    } else if bend < 6e-3 {
                        1.2
                    } else {
                        0.8
                    };
                    stride = stride.min(self.longest_stride(&next, tangent));
                }
                _ => {
                    stride *= 0.4;
                    self.slope_in_p = None;
                    if stride < STRIDES.1 {
                        break;
                    }
                }
            }
        }
        Ok(points)
    }

    /// The longest stride from a point in the direction of `tangent`.
    ///
    /// Swings that begin next to the sticking set are those of the linearised field, whose closing
    /// depends on u almost linearly: there u may change by a fraction of how far it is below `ln r`. This is
    /// where cycles go as D goes to -1, and u to minus infinity.
    fn longest_stride(&self, point: &CurvePoint, tangent: Tangent) -> f64 {
        /// As a fraction of the range, and of the unit of u or the depth.
        const LONGEST: f64 = 0.06;
        let friction = self.parameters_at(point.p).r;
        let depth = if friction > 0.0 {
            (ln(friction) - point.u) / UNIT_OF_U
        } else {
            0.0
        };
        LONGEST * self.strides / tangent.p.abs().max(tangent.u.abs() / depth.max(1.0))
    }

    /// The tangent from the slopes of the residual, turned the way of `along`.
    fn tangent_at(&self, point: &CurvePoint, along: Tangent) -> Option<Tangent> {
        let tangent = self.across_slopes(point.closing.node.slope, self.slope_in_p?.1);
        let turned = tangent.times(tangent.dot(along).signum());
        (turned.dot(along) > 0.9).then_some(turned)
    }

    fn first_tangent(&mut self, start: &CurvePoint, direction: f64) -> Result<Option<Tangent>> {
        let route = start.route();
        let Some(closing) = self.closing(route, start.u, start.p)? else { return Ok(None) };
        let in_p = self.renew_slope(route, start.u, start.p, closing.node.value)?;
        let tangent = self.across_slopes(closing.node.slope, in_p);
        let turned = tangent.times((tangent.p * direction).signum());
        Ok((turned.u.is_finite() && turned.p.is_finite()).then_some(turned))
    }

    /// Along the curve, on which the residual with these slopes in u and p stays the same.
    fn across_slopes(&self, in_u: f64, in_p: f64) -> Tangent {
        let (slope_u, slope_p) = (in_u * UNIT_OF_U, in_p * self.scale);
        let length = hypot(slope_u, slope_p);
        Tangent { u: -slope_p / length, p: slope_u / length }
    }

    /// The point between two neighbours of the curve where the multiplier is 1: a fold.
    ///
    /// Bracketing secant (the Illinois rule) on the logarithm of the multiplier along the chord. The
    /// parameter is stationary there: an error e of the place costs e^2 of the parameter.
    pub fn fold_between(
        &mut self,
        one: &CurvePoint,
        other: &CurvePoint,
    ) -> Result<Option<CurvePoint>> {
        let (tangent, chord) = Tangent::between(one, other, self.scale);
        let (tolerance, zero) =
            (self.fineness().max(FOLD_TOLERANCE), self.tolerance.max(LEAST_LOG));
        let mut fine = CycleCurve { tolerance, slope_in_p: None, ..*self };
        let (mut low, mut high) = ((0.0, one.log_multiplier), (chord, other.log_multiplier));
        let mut best = None;
        for _ in 0..60 {
            let s = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            let corrected = fine.correct(self.ahead(one, tangent, s), tangent, Route::Mixed);
            (self.cost, self.slope_in_p) = (fine.cost, fine.slope_in_p);
            let Some(point) = corrected? else { return Ok(best) };
            best = Some(point);
            let here = (s, point.log_multiplier);
            if here.1.abs() < zero || (high.0 - low.0).abs() < 1e-13 {
                break;
            }
            if (here.1 > 0.0) == (low.1 > 0.0) {
                (low, high.1) = (here, 0.5 * high.1);
            } else {
                (high, low.1) = (here, 0.5 * low.1);
            }
        }
        Ok(best)
    }
}
