//! The equation that a closed pair of half swings obeys.
//!
//! A cycle starts its first swing with clearance `c0`, ends it at `X1`, starts the second with
//! `c1 = X1 - 2 r` and ends it at `X0 = c0 + 2 r`. The unknown is `u = ln c0`. Three routes lead to the
//! same roots, and near a root one of them contracts:
//!
//! - `Mixed`: the first swing forward to `X1`, the second backward from `X0`; both increase with u.
//! - `Forward`: both forward; contracts at stable cycles.
//! - `Backward`: both backward; contracts at unstable cycles, and needs `c0` only through `X0`, so that
//!   a `c0` that underflows does no harm.
//!
//! The first swing is the one in whose frame `D2 >= 0`, so that with `D3 = 0` neither it nor the
//! second swing run backward can escape.

use super::half_map::{HalfMap, HalfSwing, Length};
use super::pair::{Closing, Spread, rounding, share};
use super::roundoff::Errors;
use super::search::Node;
use crate::flow::{Cost, Limits, Reason};
use crate::model::{HalfPlane, Parameters, Side};
use crate::numerics::elementary::{exp, ln, log10, pow};

/// Which way the two swings of a cycle are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Route {
    /// First forward, second backward.
    Mixed,
    /// Both forward.
    Forward,
    /// Both backward.
    Backward,
}

impl Route {
    /// The route on which rounding grows least, by the logarithms of what each swing makes of a relative
    /// error of its clearance.
    pub fn steadiest([first, second]: [f64; 2]) -> Self {
        if first > 0.0 && second > 0.0 || first < 0.0 && second < 0.0 {
            Route::contracting(first + second)
        } else if first.is_nan() || second.is_nan() {
            // The first swing ends, or the second one starts, at the very end of the sticking set.
            Route::Forward
        } else {
            Route::Mixed
        }
    }

    /// The route that contracts at a cycle of this multiplier.
    pub fn contracting(log_multiplier: f64) -> Self {
        /// Within this of 0 all routes converge alike.
        const STEEP: f64 = 1.5;
        if log_multiplier > STEEP {
            Route::Backward
        } else if log_multiplier < -STEEP {
            Route::Forward
        } else {
            Route::Mixed
        }
    }
}

/// The half maps of both swings in both directions.
#[derive(Clone, Debug)]
pub struct Equation {
    pub parameters: Parameters,
    /// The side of the first swing.
    pub side: Side,
    pub(crate) forward: [HalfMap; 2],
    backward: [HalfMap; 2],
    charged: Cost,
}

/// The side in whose frame `D2 >= 0`.
pub fn first_side(parameters: &Parameters) -> Side {
    if parameters.d2 < 0.0 { Side::Lower } else { Side::Upper }
}

impl Equation {
    /// The equation at these parameters, each integration step within the relative `tolerance`.
    pub fn new(parameters: &Parameters, tolerance: f64) -> Self {
        Self::on_side(parameters, first_side(parameters), tolerance)
    }

    /// The same with the first swing on a given side.
    pub fn on_side(parameters: &Parameters, side: Side, tolerance: f64) -> Self {
        Self::with(parameters, side, |field| HalfMap::new(field, tolerance))
    }

    /// The same with half maps made by `map`.
    pub fn with(parameters: &Parameters, side: Side, map: impl Fn(HalfPlane) -> HalfMap) -> Self {
        let fields = [side, side.opposite()].map(|side| HalfPlane::new(parameters, side));
        Self::on_fields(parameters, side, fields, map)
    }

    /// The same with damping that differs by side: the fields of the first and of the second swing.
    ///
    /// Only the search for brackets and [`Self::at`] serve such an equation; whatever else takes D2 from its
    /// parameters does not.
    pub fn on_fields(
        parameters: &Parameters,
        side: Side,
        fields: [HalfPlane; 2],
        map: impl Fn(HalfPlane) -> HalfMap,
    ) -> Self {
        Equation {
            parameters: *parameters,
            side,
            forward: fields.map(&map),
            backward: fields.map(|field| map(field.reversed())),
            charged: Cost::default(),
        }
    }

    /// The same equation, each integration step within another relative tolerance.
    pub fn again(&self, tolerance: f64) -> Self {
        let fields = [&self.forward[0], &self.forward[1]].map(|map| *map.field());
        Self::on_fields(&self.parameters, self.side, fields, |field| HalfMap::new(field, tolerance))
    }

    /// Whether both fields are those of its parameters.
    pub fn is_of_one_motion(&self) -> bool {
        let sides = [self.side, self.side.opposite()];
        let own = sides.map(|side| HalfPlane::new(&self.parameters, side));
        own.iter().zip(&self.forward).all(|(own, map)| own == map.field())
    }

    /// Whether to find the largest speeds.
    pub fn want_fastest(&mut self, wanted: bool) {
        for map in self.forward.iter_mut().chain(&mut self.backward) {
            map.fastest = wanted;
        }
    }

    /// The maps of the first and the second swing along a route.
    pub fn maps(&mut self, route: Route) -> [&mut HalfMap; 2] {
        let ([forward0, forward1], [backward0, backward1]) =
            (&mut self.forward, &mut self.backward);
        match route {
            Route::Mixed => [forward0, backward1],
            Route::Forward => [forward0, forward1],
            Route::Backward => [backward0, backward1],
        }
    }

    /// Relative error of an integration step.
    pub fn tolerance(&self) -> f64 {
        self.forward[0].tolerance()
    }

    /// What all swings so far cost.
    pub fn cost(&self) -> Cost {
        let mut cost = self.charged;
        for map in self.forward.iter().chain(&self.backward) {
            cost += map.cost();
        }
        cost
    }

    /// Adds what was computed elsewhere for the same question.
    pub fn charge(&mut self, cost: Cost) {
        self.charged += cost;
    }

    /// How many half swings were computed so far.
    pub fn swings(&self) -> u64 {
        self.forward.iter().chain(&self.backward).map(|map| map.swings).sum()
    }

    /// The smallest clearance whose first swing passes the sticking set: the preimage of its far end.
    ///
    /// No cycle starts with less. `None` where no swing of any clearance passes it: every motion is
    /// captured.
    pub fn smallest_clearance(&mut self, limits: &Limits) -> Result<Option<Length>, Reason> {
        let end = Length::new(2.0 * self.parameters.r);
        match self.backward[0].swing(end, limits) {
            Ok(swing) => Ok(Some(swing.end)),
            Err(Reason::Settles) => Ok(Some(Length { value: 0.0, log: f64::NEG_INFINITY })),
            Err(Reason::Escapes) => Ok(None),
            Err(reason) => Err(reason),
        }
    }

    /// The two swings for `u = ln c0`.
    pub fn at(&mut self, route: Route, u: f64, limits: &Limits) -> Result<Closing, Reason> {
        self.from(route, Length::from_log(u), limits)
    }

    /// The two swings for `c0`.
    pub fn from(
        &mut self,
        route: Route,
        start: Length,
        limits: &Limits,
    ) -> Result<Closing, Reason> {
        match route {
            Route::Mixed => self.mixed(start, limits),
            Route::Forward => self.both_forward(start, limits),
            Route::Backward => self.both_backward(start, limits),
        }
    }

    fn mixed(&mut self, start: Length, limits: &Limits) -> Result<Closing, Reason> {
        let gap = 2.0 * self.parameters.r;
        // The second swing first: with D3 > 0 it is the one that escapes, and quickly, where the first
        // one would be stiff.
        let second = match self.backward[1].swing(start.plus(gap), limits) {
            Err(Reason::Escapes) => {
                return Ok(Closing::beyond(start, self.reach(start, limits)?, f64::INFINITY));
            }
            Err(Reason::Settles) => HalfSwing::collapsed(start.plus(gap)),
            Err(reason) => return Err(reason),
            Ok(swing) => swing,
        };
        let target = second.end.plus(gap);
        let first = match self.forward[0].swing(start, limits) {
            Err(Reason::Escapes) => return Ok(Closing::beyond(start, f64::INFINITY, target.log)),
            Err(Reason::Settles) => {
                return Ok(Closing::beyond(start, f64::NEG_INFINITY, target.log));
            }
            Err(reason) => return Err(reason),
            Ok(swing) => swing,
        };
        Ok(self.pair(start, first, second))
    }

    /// The pair of a first swing, run forward from `start`, and a second one, run backward.
    pub(crate) fn pair(&self, start: Length, first: HalfSwing, second: HalfSwing) -> Closing {
        let gap = 2.0 * self.parameters.r;
        let target = second.end.plus(gap);
        let pull = exp(second.log_elasticity) * share(second.end, gap) * share(start, gap);
        let slope = exp(first.log_elasticity) - pull;
        let node = Node::new(start.log, first.end.log, target.log, slope);
        let shares = [share(start, gap), share(second.end, gap)];
        let [(own, gain), (late, late_gain)] =
            [first, second].map(|it| (it.errors[0], it.errors[1]));
        let late = late.plus(late_gain, f64::EPSILON);
        let errors = [
            Spread::new([rounding(start), late.end], [own, late]),
            Spread::new(
                [1.0, shares[0] * late_gain.end],
                [gain, Errors::default().plus(late_gain, shares[0])],
            ),
        ];
        let noise = own.end + shares[1] * late.end + rounding(first.end) + rounding(target);
        let growth =
            [first.log_elasticity - ln(shares[1]), -(second.log_elasticity + ln(shares[0]))];
        let closing = Closing::of(node, [start, second.end], [first, second]);
        closing.with_errors(growth, noise, errors)
    }

    /// Logarithm of where the first swing from `start` ends, or a bound on it: the largest number where that
    /// is not known at little cost.
    fn reach(&mut self, start: Length, limits: &Limits) -> Result<f64, Reason> {
        /// Evaluations that this is worth.
        const LITTLE: u64 = 1_000;
        let map = &mut self.forward[0];
        let evaluations = limits.evaluations.min(map.cost().evaluations + map.swings + LITTLE);
        match map.swing(start, &Limits { evaluations, interrupted: limits.interrupted }) {
            Ok(swing) => Ok(swing.end.log),
            Err(Reason::Interrupted) => Err(Reason::Interrupted),
            Err(_) => Ok(f64::MAX),
        }
    }

    fn both_forward(&mut self, start: Length, limits: &Limits) -> Result<Closing, Reason> {
        let gap = 2.0 * self.parameters.r;
        let (mut clearance, mut swings) = (start, [HalfSwing::collapsed(start); 2]);
        let mut seconds = start;
        for (index, map) in self.forward.iter_mut().enumerate() {
            let swing = match map.swing(clearance, limits) {
                Err(Reason::Escapes) => return Ok(Closing::beyond(start, f64::INFINITY, f64::MAX)),
                Err(Reason::Settles) => {
                    return Ok(Closing::beyond(start, f64::NEG_INFINITY, f64::MIN));
                }
                Err(reason) => return Err(reason),
                Ok(swing) => swing,
            };
            let passed = swing.end.value - gap;
            if passed <= 0.0 {
                return Ok(Closing::beyond(start, f64::NEG_INFINITY, f64::MIN));
            }
            clearance = if gap == 0.0 { swing.end } else { Length::new(passed) };
            swings[index] = swing;
            if index == 0 {
                seconds = clearance;
            }
        }
        let stretch = exp(swings[0].log_elasticity + swings[1].log_elasticity)
            / (share(seconds, gap) * share(clearance, gap));
        let node = Node::new(start.log, clearance.log, start.log, stretch - 1.0);
        let shares = [share(clearance, gap), share(seconds, gap)];
        let [(own, gain), (late, late_gain)] = swings.map(|it| (it.errors[0], it.errors[1]));
        // A difference of two lengths keeps their absolute errors.
        let passed = [own.end + f64::EPSILON, gain.end].map(|error| error / shares[1]);
        let late = late.plus(late_gain, passed[0]);
        let errors = [
            Spread::new([rounding(start), passed[0]], [own, late]),
            Spread::new([1.0, passed[1]], [gain, Errors::default().plus(late_gain, passed[1])]),
        ];
        let noise = (late.end + f64::EPSILON) / shares[0] + rounding(clearance) + rounding(start);
        let growth =
            [swings[0].log_elasticity - ln(shares[1]), swings[1].log_elasticity - ln(shares[0])];
        Ok(Closing::of(node, [start, seconds], swings).with_errors(growth, noise, errors))
    }

    fn both_backward(&mut self, start: Length, limits: &Limits) -> Result<Closing, Reason> {
        let gap = 2.0 * self.parameters.r;
        let (mut length, mut swings) = (start, [HalfSwing::collapsed(start); 2]);
        let mut ends = [start; 2];
        let mut shrink = 1.0;
        for index in [1, 0] {
            shrink *= share(length, gap);
            let swing = match self.backward[index].swing(length.plus(gap), limits) {
                Err(Reason::Escapes) => return Ok(Closing::beyond(start, f64::MAX, f64::INFINITY)),
                Err(Reason::Settles) => HalfSwing::collapsed(length.plus(gap)),
                Err(reason) => return Err(reason),
                Ok(swing) => swing,
            };
            shrink *= exp(swing.log_elasticity);
            (length, ends[index], swings[index]) = (swing.end, swing.end, swing);
        }
        let [back, second] = ends;
        let node = Node::new(start.log, start.log, back.log, 1.0 - shrink);
        let shares = [share(start, gap), share(second, gap)];
        let [(last, last_gain), (own, gain)] = swings.map(|it| (it.errors[0], it.errors[1]));
        let own = own.plus(gain, f64::EPSILON);
        let last = last.plus(last_gain, shares[1] * own.end + f64::EPSILON);
        let carried = shares[0] * gain.end * shares[1];
        let errors = [
            Spread::new([last.end, own.end], [last, own]),
            Spread::new(
                [shrink, shares[0] * gain.end],
                [
                    Errors::default().plus(last_gain, carried),
                    Errors::default().plus(gain, shares[0]),
                ],
            ),
        ];
        let noise = last.end + rounding(start) + rounding(back);
        // Where the way back contracts, its end is known better than its start.
        let growth = [
            -(swings[0].log_elasticity + ln(shares[1])),
            -(swings[1].log_elasticity + ln(shares[0])),
        ];
        Ok(Closing::of(node, [back, second], swings).with_errors(growth, noise, errors))
    }
}

// Where motions go that leave the end of the sticking set, a node that repels (`D < -1`).

/// How motions from the end of the sticking set come back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WayFromRim {
    /// By how much, as a logarithm, they come back beyond the sticking set; negative where they are captured.
    pub excess: f64,
    /// Their right turning point.
    pub q_max: f64,
}

impl Equation {
    /// Logarithm of the clearance below which no first swing of a cycle starts where the end of the sticking set
    /// is a node that repels (`D <= -1`); `None` where no swing from there comes back.
    ///
    /// Every second swing, however close to the sticking set it starts, ends beyond the one that creeps out
    /// from its rim, and the next first swing starts there.
    pub fn rim(&mut self, limits: &Limits) -> Result<Option<f64>, Reason> {
        let r = self.parameters.r;
        let rim = self.rim_start();
        let mut bound = f64::NEG_INFINITY;
        for map in &mut self.forward {
            match map.swing(rim, limits) {
                Ok(swing) => bound = ln(swing.end.value - 2.0 * r),
                Err(Reason::Escapes) => return Ok(None),
                Err(Reason::Settles) => bound = f64::NEG_INFINITY,
                Err(reason) => return Err(reason),
            }
        }
        Ok(Some(if bound.is_nan() { f64::NEG_INFINITY } else { bound }))
    }

    /// The way of motions that leave the end of the sticking set, a node that repels (`D < -1`), on the side on which
    /// they come further.
    pub fn way_from_rim(&mut self, limits: &Limits) -> Result<WayFromRim, Reason> {
        let Parameters { r, .. } = self.parameters;
        let gap = 2.0 * r;
        let rim = self.rim_start();
        let mut best = WayFromRim { excess: f64::NEG_INFINITY, q_max: r };
        for (side, index) in [(self.side, 0), (self.side.opposite(), 1)] {
            let (mut start, mut excess) = (rim, f64::INFINITY);
            let mut turning = 0.0;
            for map in [index, 1 - index] {
                let end = match self.forward[map].swing(start, limits) {
                    Ok(swing) => swing.end.value,
                    Err(Reason::Settles) => 0.0,
                    Err(Reason::Escapes) => f64::INFINITY,
                    Err(reason) => return Err(reason),
                };
                excess = excess.min(ln(end / gap));
                if map == index {
                    turning = end - gap;
                }
                if excess <= 0.0 || end.is_infinite() {
                    break;
                }
                start = Length::new(end - gap);
            }
            if excess > best.excess {
                // Above `v = 0` the first swing ends on the right, below it starts there.
                let q_max = if side == Side::Upper { r + turning.max(0.0) } else { r };
                best = WayFromRim { excess, q_max };
            }
        }
        Ok(best)
    }

    /// A start so near the end of the sticking set, a node that repels, that starting nearer changes nothing.
    ///
    /// Motions leave it along its faster direction; what is left of the slower one is the start to the power of one
    /// less the ratio of both rates.
    fn rim_start(&self) -> Length {
        /// What may be left, and the decimal exponent that is far enough where both rates are alike.
        const LEFT: f64 = 1e-17;
        const FAR: f64 = -60.0;
        let Parameters { d, d2, d3, r } = self.parameters;
        let natural = (1.0 / d2.abs()).min(1.0 / d3.abs().sqrt());
        let root = (d * d - 1.0).max(0.0).sqrt();
        let unlike = 2.0 * root / (root - d);
        let exponent = (log10(LEFT) / unlike).max(FAR);
        Length::new(pow(10.0, exponent) * natural.min(r))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_one_swing_escapes_the_other_one_still_bounds_what_lies_further_in() {
        let limits = &Limits::PATIENT;
        for (d3, finite) in [(0.5, true), (-0.5, false)] {
            let parameters = Parameters { d: -0.2, d2: 0.2, d3, r: 0.1 };
            let mut equation = Equation::new(&parameters, 1e-10);
            let beyond = equation.at(Route::Mixed, 3.0, limits).unwrap().node;
            let within = equation.at(Route::Mixed, 0.0, limits).unwrap().node;
            let (known, escaped) =
                if finite { (beyond.rise, beyond.fall) } else { (beyond.fall, beyond.rise) };
            assert_eq!(escaped, f64::INFINITY);
            let inner = if finite { within.rise } else { within.fall };
            assert!(known > inner && known < 3.0, "{beyond:?} {within:?}");
        }
    }

    #[test]
    fn an_escape_is_followed_no_further_than_to_where_it_is_certain() {
        let field = HalfPlane { d: 0.2, d2: 0.2, d3: -0.5 };
        let mut map = HalfMap::new(field, 1e-16);
        let start = Length::new(10.0);
        assert_eq!(map.swing(start, &Limits::PATIENT), Err(Reason::Escapes));
        let short = map.cost().evaluations;
        assert_eq!(map.swing_watched(start, &Limits::PATIENT, |_, _, _| {}), Err(Reason::Escapes));
        assert!(3 * short < map.cost().evaluations, "{short} {:?}", map.cost());
    }
}
