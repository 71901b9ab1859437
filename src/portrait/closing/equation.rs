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

use super::{
    Direction, Errors, HalfMap, HalfSwing, Length, Node, SwingPair, natural_size, rounding, share,
};
use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::{HalfPlane, Parameters, Side};
use crate::numerics::{exp, ln, log10, pow};

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

    /// The directions of time of the first and of the second swing.
    fn senses(self) -> [f64; 2] {
        match self {
            Route::Mixed => [1.0, -1.0],
            Route::Forward => [1.0; 2],
            Route::Backward => [-1.0; 2],
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
pub struct Equation<'a> {
    pub parameters: Parameters,
    /// What the answer to its question may cost.
    pub(crate) limits: Limits<'a>,
    /// The side of the first swing.
    pub side: Side,
    /// Those run forward and those run backward, each that of the first swing first.
    pub maps: [[HalfMap; 2]; 2],
    charged: Cost,
}

/// The side in whose frame `D2 >= 0`.
pub fn first_side(parameters: &Parameters) -> Side {
    if parameters.d2 < 0.0 {
        Side::Lower
    } else {
        Side::Upper
    }
}

impl<'a> Equation<'a> {
    /// The equation at these parameters, each integration step within the relative `tolerance`.
    pub fn new(parameters: &Parameters, tolerance: f64, limits: &Limits<'a>) -> Self {
        Self::on_side(parameters, first_side(parameters), tolerance, limits)
    }

    /// The same with the first swing on a given side.
    pub fn on_side(
        parameters: &Parameters,
        side: Side,
        tolerance: f64,
        limits: &Limits<'a>,
    ) -> Self {
        let fields = [side, side.opposite()].map(|side| HalfPlane::new(parameters, side));
        Self::on_fields(parameters, side, fields, tolerance, limits)
    }

    /// The same with damping that may differ by side: the fields of the first and of the second swing.
    ///
    /// Only the search for brackets, the polish and [`Self::at`] serve an equation whose damping differs; whatever else
    /// takes D2 from its parameters does not.
    pub fn on_fields(
        parameters: &Parameters,
        side: Side,
        fields: [HalfPlane; 2],
        tolerance: f64,
        limits: &Limits<'a>,
    ) -> Self {
        let map = |field| HalfMap::new(field, tolerance);
        Equation {
            parameters: *parameters,
            limits: *limits,
            side,
            maps: [fields, fields.map(|field| field.reversed())].map(|fields| fields.map(map)),
            charged: Cost::default(),
        }
    }

    /// The same equation, each integration step within another relative tolerance.
    pub fn again(&self, tolerance: f64) -> Self {
        let fields = [0, 1].map(|index| self.maps[0][index].field);
        Self::on_fields(&self.parameters, self.side, fields, tolerance, &self.limits)
    }

    /// Whether both fields are those of its parameters.
    pub fn is_of_one_motion(&self) -> bool {
        let sides = [self.side, self.side.opposite()];
        let own = sides.map(|side| HalfPlane::new(&self.parameters, side));
        own.iter().zip(&self.maps[0]).all(|(own, map)| *own == map.field)
    }

    /// From now on finds the largest speeds, too.
    pub fn want_fastest(&mut self) {
        self.maps.iter_mut().flatten().for_each(|map| map.fastest = true);
    }

    /// The map of the first swing, or of the second one, in a direction.
    pub(crate) fn map(&mut self, index: usize, direction: Direction) -> &mut HalfMap {
        &mut self.maps[usize::from(direction == Direction::Backward)][index]
    }

    /// Relative error of an integration step.
    pub fn tolerance(&self) -> f64 {
        self.maps[0][0].tolerance
    }

    /// What all swings so far cost.
    pub fn cost(&self) -> Cost {
        let mut cost = self.charged;
        self.maps.iter().flatten().for_each(|map| cost += map.cost());
        cost
    }

    /// Adds what was computed elsewhere for the same question.
    pub fn charge(&mut self, cost: Cost) {
        self.charged += cost;
    }

    /// A swing of one of the maps. From nowhere, and from beyond all lengths, it leads to the same again.
    pub(crate) fn swing(
        &mut self,
        index: usize,
        direction: Direction,
        start: Length,
    ) -> Result<HalfSwing> {
        if start.log.is_infinite() {
            return Ok(HalfSwing::between(start, start));
        }
        let limits = self.limits;
        self.map(index, direction).swing(start, &limits)
    }

    /// The two swings for `u = ln c0`.
    pub fn at(&mut self, route: Route, u: f64) -> Result<SwingPair> {
        self.from(route, Length::from_log(u))
    }

    /// The two swings for `c0`. Where one of them has no end, one of both functions of the node is infinite, and the
    /// other still bounds what lies further in or out.
    pub fn from(&mut self, route: Route, start: Length) -> Result<SwingPair> {
        use Direction::{Backward, Forward};
        let (here, gap) = (Place::start(start), 2.0 * self.parameters.r);
        match route {
            Route::Mixed => {
                // The second swing first: with D3 > 0 it is the one that escapes, and quickly, where the first
                // one would be stiff.
                let second = self.swing(1, Backward, start.plus(gap))?;
                let first = if second.end == Length::INFINITE {
                    self.reach(start)?
                } else {
                    self.swing(0, Forward, start)?
                };
                Ok(self.pair(start, first, second))
            }
            Route::Forward => {
                let (first, end) = here.through(self.swing(0, Forward, start)?);
                let between = end.minus(gap);
                let (second, end) = between.through(self.swing(1, Forward, between.length)?);
                let (ends, clearances) = ([end.minus(gap), here], [here.rounded(), between]);
                Ok(self.closing(route, ends, clearances, [first, second]))
            }
            Route::Backward => {
                let target = here.plus(gap);
                let (second, between) = target.through(self.swing(1, Backward, target.length)?);
                let target = between.plus(gap);
                let (first, back) = target.through(self.swing(0, Backward, target.length)?);
                Ok(self.closing(route, [here, back], [back, between], [first, second]))
            }
        }
    }

    /// The pair of a first swing, run forward from `start`, and a second one, run backward.
    pub(crate) fn pair(&self, start: Length, first: HalfSwing, second: HalfSwing) -> SwingPair {
        let (here, gap) = (Place::start(start), 2.0 * self.parameters.r);
        let (first, end) = here.through(first);
        let (second, between) = here.plus(gap).through(second);
        let ends = [end, between.plus(gap)];
        self.closing(Route::Mixed, ends, [here.rounded(), between], [first, second])
    }

    /// The closing of two swings that start with these clearances; `rise` and `fall` are equal where it closes.
    fn closing(
        &self,
        route: Route,
        [rise, fall]: [Place; 2],
        clearances: [Place; 2],
        swings: [HalfSwing; 2],
    ) -> SwingPair {
        let gap = 2.0 * self.parameters.r;
        let start = if route == Route::Backward {
            rise
        } else {
            clearances[0]
        };
        let slope = exp(rise.log_gain) - exp(fall.log_gain);
        let node = Node::new(start.length.log, rise.length.log, fall.length.log, slope);
        let noise = [rise, fall].map(|end| end.error + rounding(end.length));
        let noise = noise[0] + noise[1];
        // What a swing, run forward, makes of a relative error of its clearance.
        let growth = [0, 1].map(|index| {
            let next = share(clearances[1 - index].length, gap);
            route.senses()[index] * swings[index].log_elasticity - ln(next)
        });
        let errors = [0, 1].map(|index| {
            let [own, gain] = swings[index].errors;
            let Place { error, log_gain, .. } = clearances[index];
            [Errors { length: error, ..own }, Errors { length: exp(log_gain), ..gain }]
        });
        SwingPair {
            node,
            clearances: clearances.map(|it| it.length),
            duration: swings[0].duration + swings[1].duration,
            square: swings[0].square + swings[1].square,
            fastest: swings.map(|swing| swing.fastest),
            growth,
            noise,
            uncertainty: (node.value.abs() + noise) / node.slope.abs(),
            errors,
        }
    }

    /// The first swing from `start`, or a bound on where it ends: the largest number where that is not known at
    /// little cost.
    fn reach(&mut self, start: Length) -> Result<HalfSwing> {
        /// Evaluations that this is worth.
        const LITTLE: u64 = 1_000;
        let map = &mut self.maps[0][0];
        let limits = self.limits.up_to(map.cost().evaluations + map.swings + LITTLE);
        let swing = Reason::tolerated(map.swing(start, &limits))?.ok();
        let far = HalfSwing::between(start, Length { log: f64::MAX, ..Length::INFINITE });
        Ok(swing.filter(HalfSwing::arrives).unwrap_or(far))
    }
}

/// A length on the way along both swings.
#[derive(Clone, Copy)]
struct Place {
    length: Length,
    /// Logarithm of what a relative error 1 of the first clearance makes of it.
    log_gain: f64,
    /// Its own relative error.
    error: f64,
}

impl Place {
    fn start(length: Length) -> Self {
        Place { length, log_gain: 0.0, error: 0.0 }
    }

    /// The same with the error of its rounded logarithm.
    fn rounded(self) -> Self {
        Place { error: rounding(self.length), ..self }
    }

    /// A swing from here with its errors at exactly this first clearance, and those that a relative error 1 of that
    /// makes; and its end.
    fn through(self, swing: HalfSwing) -> (HalfSwing, Place) {
        let [own, gain] = swing.errors;
        let own = own.plus(gain, self.error);
        let errors = [own, Errors::default().plus(gain, exp(self.log_gain))];
        let log_gain = self.log_gain + swing.log_elasticity;
        let end = Place { length: swing.end, log_gain, error: own.length };
        (HalfSwing { errors, ..swing }, end)
    }

    fn plus(self, gap: f64) -> Self {
        let share = share(self.length, gap);
        let error = share * self.error + f64::EPSILON;
        Place { length: self.length.plus(gap), log_gain: self.log_gain + ln(share), error }
    }

    /// What is left beyond the sticking set; nothing where it ends within.
    fn minus(self, gap: f64) -> Self {
        let left = (self.length.value - gap).max(0.0);
        let length = if gap == 0.0 { self.length } else { Length::new(left) };
        let share = share(length, gap);
        // A difference of two lengths keeps their absolute errors.
        let error = (self.error + f64::EPSILON) / share;
        Place { length, log_gain: self.log_gain - ln(share), error }
    }
}

// Where motions go that leave the end of the sticking set, a node that repels (`D < -1`).

/// How motions from the end of the sticking set come back.
pub struct WayFromRim {
    /// By how much, as a logarithm, they come back beyond the sticking set; negative where they are captured.
    pub excess: f64,
    /// Their right turning point.
    pub q_max: f64,
}

impl Equation<'_> {
    /// Logarithm of the clearance below which no first swing of a cycle starts where the end of the sticking set
    /// is a node that repels (`D <= -1`); infinite where no swing from there comes back.
    ///
    /// Every second swing, however close to the sticking set it starts, ends beyond the one that creeps out
    /// from its rim, and the next first swing starts there.
    pub fn rim(&mut self) -> Result<f64> {
        let [first, second] = self.ends_from_rim()?;
        let beyond = |end: f64| ln((end - 2.0 * self.parameters.r).max(0.0));
        Ok(if first.is_finite() {
            beyond(second)
        } else {
            f64::INFINITY
        })
    }

    /// Where the first and the second swing end that leave the end of the sticking set.
    fn ends_from_rim(&mut self) -> Result<[f64; 2]> {
        let rim = self.rim_start();
        let first = self.swing(0, Direction::Forward, rim)?;
        let second = self.swing(1, Direction::Forward, rim)?;
        Ok([first, second].map(|swing| swing.end.value))
    }

    /// The way of motions that leave the end of the sticking set, a node that repels (`D < -1`), on the side on which
    /// they come further.
    pub fn way_from_rim(&mut self) -> Result<WayFromRim> {
        let r = self.parameters.r;
        let gap = 2.0 * r;
        let ends = self.ends_from_rim()?;
        let mut best = WayFromRim { excess: f64::NEG_INFINITY, q_max: r };
        for (index, side) in [self.side, self.side.opposite()].into_iter().enumerate() {
            let end = ends[index];
            let mut excess = ln(end / gap);
            if end > gap && end.is_finite() {
                let start = Length::new(end - gap);
                let next = self.swing(1 - index, Direction::Forward, start)?.end.value;
                excess = excess.min(ln(next / gap));
            }
            if excess > best.excess {
                // Above `v = 0` the first swing ends on the right, below it starts there.
                let q_max = if side == Side::Upper { end.max(gap) - r } else { r };
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
        let root = (d * d - 1.0).max(0.0).sqrt();
        let unlike = 2.0 * root / (root - d);
        let exponent = (log10(LEFT) / unlike).max(FAR);
        Length::new(pow(10.0, exponent) * natural_size(d2, d3).min(r))
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
            let mut equation = Equation::new(&parameters, 1e-10, limits);
            let beyond = equation.at(Route::Mixed, 3.0).unwrap().node;
            let within = equation.at(Route::Mixed, 0.0).unwrap().node;
            let (known, escaped) = if finite {
                (beyond.rise, beyond.fall)
            } else {
                (beyond.fall, beyond.rise)
            };
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
        assert_eq!(map.swing(start, &Limits::PATIENT).unwrap().end, Length::INFINITE);
        let short = map.cost().evaluations;
        let whole = map.swing_watched(start, true, &Limits::PATIENT, |_, _, _| {}).unwrap();
        assert_eq!(whole.end, Length::INFINITE);
        assert!(3 * short < map.cost().evaluations, "{short} {:?}", map.cost());
    }
}
