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

use super::half_map::{HalfMap, HalfSwing, Length, NoEnd};
use super::roundoff::{Errors, UNIT};
use super::search::Node;
use crate::flow::{Cost, Limits, Reason};
use crate::oscillator::{HalfPlane, Parameters, Side};

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
    #[must_use]
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
    #[must_use]
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

/// The two swings at one value of the unknown, and how far they are from closing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    /// The unknown, and the residual as a difference of two increasing functions of it.
    pub node: Node,
    /// Clearance at which the first swing starts.
    pub first: Length,
    /// Clearance at which the second swing starts.
    pub second: Length,
    /// Duration of both swings.
    pub duration: f64,
    /// Integral of `v^2` over both swings.
    pub square: f64,
    /// Largest speed in the first and in the second swing, if asked for.
    pub fastest: [f64; 2],
    /// Logarithms of what each swing, run forward, makes of a relative error of its clearance.
    pub growth: [f64; 2],
    /// Bounds on the error of the residual and, relative, of the first clearance, if asked for.
    pub noise: f64,
    /// See `noise`.
    pub uncertainty: f64,
    /// Errors of the other numbers at exactly this unknown, and those that a relative error 1 of it makes.
    errors: [Spread; 2],
}

/// Errors of what a closing gives: of the clearances relative, of all others absolute.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Of the clearances at which the swings start.
    pub clearance: [f64; 2],
    /// Of the duration.
    pub duration: f64,
    /// Of the integral of `v^2`.
    pub square: f64,
    /// Of the largest speeds.
    pub fastest: [f64; 2],
}

impl Spread {
    /// From the relative errors of the clearances and the errors of the two swings.
    fn new(clearance: [f64; 2], [first, second]: [Errors; 2]) -> Self {
        Spread {
            clearance,
            duration: first.duration + second.duration,
            square: first.square + second.square,
            fastest: [first.fastest, second.fastest],
        }
    }
}

/// The half maps of both swings in both directions.
#[derive(Clone, Debug)]
pub struct Equation {
    /// The parameters.
    pub parameters: Parameters,
    /// The side of the first swing.
    pub side: Side,
    forward: [HalfMap; 2],
    backward: [HalfMap; 2],
    charged: Cost,
}

/// The side in whose frame `D2 >= 0`.
#[must_use]
pub fn first_side(parameters: &Parameters) -> Side {
    if parameters.d2 < 0.0 { Side::Lower } else { Side::Upper }
}

impl Equation {
    /// The equation at these parameters, each integration step within the relative `tolerance`.
    #[must_use]
    pub fn new(parameters: &Parameters, tolerance: f64) -> Self {
        Self::on_side(parameters, first_side(parameters), tolerance)
    }

    /// The same with the first swing on a given side.
    #[must_use]
    pub fn on_side(parameters: &Parameters, side: Side, tolerance: f64) -> Self {
        Self::with(parameters, side, |field| HalfMap::new(field, tolerance))
    }

    /// The same with half maps made by `map`.
    #[must_use]
    pub fn with(parameters: &Parameters, side: Side, map: impl Fn(HalfPlane) -> HalfMap) -> Self {
        let fields = [side, side.opposite()].map(|side| HalfPlane::new(parameters, side));
        Self::on_fields(parameters, side, fields, map)
    }

    /// The same with damping that differs by side: the fields of the first and of the second swing.
    ///
    /// Only the search for brackets and [`Self::at`] serve such an equation; whatever else takes D2 from its
    /// parameters does not.
    #[must_use]
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
    #[must_use]
    pub fn again(&self, tolerance: f64) -> Self {
        let fields = [&self.forward[0], &self.forward[1]].map(|map| *map.field());
        Self::on_fields(&self.parameters, self.side, fields, |field| HalfMap::new(field, tolerance))
    }

    /// Whether both fields are those of its parameters.
    #[must_use]
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
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.forward[0].tolerance()
    }

    /// What all swings so far cost.
    #[must_use]
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
    #[must_use]
    pub fn swings(&self) -> u64 {
        self.forward.iter().chain(&self.backward).map(|map| map.swings).sum()
    }

    /// The smallest clearance whose first swing passes the sticking set: the preimage of its far end.
    ///
    /// No cycle starts with less. `None` where no swing of any clearance passes it: every motion is
    /// captured.
    ///
    /// # Errors
    /// The [`Reason`] why a swing failed.
    pub fn smallest_clearance(&mut self, limits: &Limits) -> Result<Option<Length>, Reason> {
        let end = Length::new(2.0 * self.parameters.r);
        match self.backward[0].swing(end, limits) {
            Ok(swing) => Ok(Some(swing.end)),
            Err(NoEnd::Never) => Ok(Some(Length { value: 0.0, log: f64::NEG_INFINITY })),
            Err(NoEnd::Escapes) => Ok(None),
            Err(NoEnd::Failed(reason)) => Err(reason),
        }
    }

    /// Logarithm of the clearance below which no first swing of a cycle starts where the end of the sticking set
    /// is a node that repels (`D <= -1`); `None` where no swing from there comes back.
    ///
    /// Every second swing, however close to the sticking set it starts, ends beyond the one that creeps out
    /// from its rim, and the next first swing starts there.
    ///
    /// # Errors
    /// The [`Reason`] why a swing failed.
    pub fn rim(&mut self, limits: &Limits) -> Result<Option<f64>, Reason> {
        let r = self.parameters.r;
        let rim = self.rim_start();
        let mut bound = f64::NEG_INFINITY;
        for map in &mut self.forward {
            match map.swing(rim, limits) {
                Ok(swing) => bound = (swing.end.value - 2.0 * r).ln(),
                Err(NoEnd::Escapes) => return Ok(None),
                Err(NoEnd::Never) => bound = f64::NEG_INFINITY,
                Err(NoEnd::Failed(reason)) => return Err(reason),
            }
        }
        Ok(Some(if bound.is_nan() { f64::NEG_INFINITY } else { bound }))
    }

    /// Whether motions that leave the end of the sticking set, a node that repels (`D < -1`), come back beyond
    /// it, on one side at least.
    ///
    /// # Errors
    /// The [`Reason`] why a swing failed.
    pub fn leaves_rim(&mut self, limits: &Limits) -> Result<bool, Reason> {
        let gap = 2.0 * self.parameters.r;
        let rim = self.rim_start();
        for side in [0, 1] {
            let mut length = rim;
            let mut turns = 0;
            for map in [side, 1 - side] {
                match self.forward[map].swing(length, limits) {
                    Ok(swing) if swing.end.value > gap => {
                        length = Length::new(swing.end.value - gap);
                    }
                    Ok(_) | Err(NoEnd::Never) => break,
                    Err(NoEnd::Escapes) => return Ok(true),
                    Err(NoEnd::Failed(reason)) => return Err(reason),
                }
                turns += 1;
            }
            if turns == 2 {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// A start at the end of the sticking set.
    fn rim_start(&self) -> Length {
        /// As a part of the smallest length there is.
        const RIM: f64 = 1e-60;
        let Parameters { d2, d3, r, .. } = self.parameters;
        let natural = (1.0 / d2.abs()).min(1.0 / d3.abs().sqrt());
        Length::new(RIM * natural.min(r))
    }

    /// Clearance at which the first swing of a cycle starts whose right turning point is `q_max`.
    ///
    /// On the upper side the first swing ends there and is followed back; on the lower it starts there.
    ///
    /// # Errors
    /// The [`Reason`] why a swing failed.
    pub fn first_clearance(
        &mut self,
        q_max: f64,
        limits: &Limits,
    ) -> Result<Option<Length>, Reason> {
        let r = self.parameters.r;
        if self.side == Side::Lower {
            return Ok((q_max > r).then(|| Length::new(q_max - r)));
        }
        match self.backward[0].swing(Length::new(q_max + r), limits) {
            Ok(swing) => Ok(Some(swing.end)),
            Err(NoEnd::Escapes | NoEnd::Never) => Ok(None),
            Err(NoEnd::Failed(reason)) => Err(reason),
        }
    }

    /// The two swings for `u = ln c0`.
    ///
    /// # Errors
    /// The [`Reason`] why a swing failed.
    pub fn at(&mut self, route: Route, u: f64, limits: &Limits) -> Result<Closing, Reason> {
        self.from(route, Length::from_log(u), limits)
    }

    /// The two swings for `c0`.
    ///
    /// # Errors
    /// The [`Reason`] why a swing failed.
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
            Err(NoEnd::Escapes) => return Ok(Closing::beyond(start, f64::MAX, f64::INFINITY)),
            Err(NoEnd::Never) => HalfSwing::collapsed(start.plus(gap)),
            Err(NoEnd::Failed(reason)) => return Err(reason),
            Ok(swing) => swing,
        };
        let first = match self.forward[0].swing(start, limits) {
            Err(NoEnd::Escapes) => return Ok(Closing::beyond(start, f64::INFINITY, f64::MAX)),
            Err(NoEnd::Never) => return Ok(Closing::beyond(start, f64::NEG_INFINITY, f64::MIN)),
            Err(NoEnd::Failed(reason)) => return Err(reason),
            Ok(swing) => swing,
        };
        let target = second.end.plus(gap);
        let pull = second.log_elasticity.exp() * share(second.end, gap) * share(start, gap);
        let slope = first.log_elasticity.exp() - pull;
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
            [first.log_elasticity - shares[1].ln(), -(second.log_elasticity + shares[0].ln())];
        let closing = Closing::of(node, [start, second.end], [first, second]);
        Ok(closing.with_errors(growth, noise, errors))
    }

    fn both_forward(&mut self, start: Length, limits: &Limits) -> Result<Closing, Reason> {
        let gap = 2.0 * self.parameters.r;
        let (mut clearance, mut swings) = (start, [HalfSwing::collapsed(start); 2]);
        let mut seconds = start;
        for (index, map) in self.forward.iter_mut().enumerate() {
            let swing = match map.swing(clearance, limits) {
                Err(NoEnd::Escapes) => return Ok(Closing::beyond(start, f64::INFINITY, f64::MAX)),
                Err(NoEnd::Never) => {
                    return Ok(Closing::beyond(start, f64::NEG_INFINITY, f64::MIN));
                }
                Err(NoEnd::Failed(reason)) => return Err(reason),
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
        let stretch = (swings[0].log_elasticity + swings[1].log_elasticity).exp()
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
            [swings[0].log_elasticity - shares[1].ln(), swings[1].log_elasticity - shares[0].ln()];
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
                Err(NoEnd::Escapes) => return Ok(Closing::beyond(start, f64::MAX, f64::INFINITY)),
                Err(NoEnd::Never) => HalfSwing::collapsed(length.plus(gap)),
                Err(NoEnd::Failed(reason)) => return Err(reason),
                Ok(swing) => swing,
            };
            shrink *= swing.log_elasticity.exp();
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
            -(swings[0].log_elasticity + shares[1].ln()),
            -(swings[1].log_elasticity + shares[0].ln()),
        ];
        Ok(Closing::of(node, [back, second], swings).with_errors(growth, noise, errors))
    }
}

/// `d ln(c + gap) / d ln(c)`.
#[must_use]
pub fn share(clearance: Length, gap: f64) -> f64 {
    if gap == 0.0 { 1.0 } else { clearance.value / (clearance.value + gap) }
}

impl HalfSwing {
    /// The swing that creeps back to the centre for ever: its end is 0.
    fn collapsed(start: Length) -> Self {
        HalfSwing { duration: f64::INFINITY, ..HalfSwing::nothing(start) }
    }

    /// No swing at all.
    fn nothing(start: Length) -> Self {
        HalfSwing {
            start,
            end: Length { value: 0.0, log: f64::NEG_INFINITY },
            duration: 0.0,
            square: 0.0,
            fastest: 0.0,
            log_elasticity: f64::NEG_INFINITY,
            errors: [Errors::default(); 2],
        }
    }
}

/// Relative error that a rounded logarithm leaves of a length.
fn rounding(length: Length) -> f64 {
    f64::EPSILON * length.log.abs().max(1.0)
}

impl Closing {
    fn of(node: Node, [first, second]: [Length; 2], swings: [HalfSwing; 2]) -> Self {
        Closing {
            node,
            first,
            second,
            duration: swings[0].duration + swings[1].duration,
            square: swings[0].square + swings[1].square,
            fastest: [swings[0].fastest, swings[1].fastest],
            growth: [f64::NAN; 2],
            noise: 0.0,
            uncertainty: 0.0,
            errors: [Spread::default(); 2],
        }
    }

    fn with_errors(self, growth: [f64; 2], noise: f64, errors: [Spread; 2]) -> Self {
        let uncertainty = (self.node.value().abs() + noise) / self.node.slope.abs();
        Closing { growth, noise, uncertainty, errors, ..self }
    }

    /// The same with clearances and duration known to all digits of a double, beyond the relative errors given.
    #[must_use]
    pub fn sharpened(
        self,
        (first, second, duration): (f64, f64, f64),
        [uncertainty, passed]: [f64; 2],
    ) -> Self {
        let [mut own, mut gain] = self.errors;
        (own.clearance, own.duration) = ([0.0, passed], f64::EPSILON * duration);
        // A plain relative error of the first clearance.
        gain.clearance[0] = 1.0;
        let (first, second) = (Length::new(first), Length::new(second));
        Closing { first, second, duration, uncertainty, errors: [own, gain], ..self }
    }

    /// How errors of rounding and of the first clearance reach the others.
    #[must_use]
    pub fn errors(&self) -> &[Spread; 2] {
        &self.errors
    }

    /// Bounds on the errors of its numbers.
    #[must_use]
    pub fn spread(&self) -> Spread {
        let [own, gain] = &self.errors;
        let sum =
            |own: f64, gain: f64| own + if gain == 0.0 { 0.0 } else { gain * self.uncertainty };
        let pair =
            |of: fn(&Spread) -> [f64; 2]| [0, 1].map(|index| sum(of(own)[index], of(gain)[index]));
        Spread {
            clearance: pair(|it| it.clearance),
            duration: sum(own.duration, gain.duration),
            square: sum(own.square, gain.square),
            fastest: pair(|it| it.fastest),
        }
    }

    /// The cycle of two swings equally fast, known in closed form to a few units in the last place.
    #[must_use]
    pub fn in_closed_form(
        clearances: [Length; 2],
        duration: f64,
        square: f64,
        fastest: f64,
    ) -> Self {
        let [first, second] = clearances;
        let node = Node::new(first.log, 0.0, 0.0, f64::NAN);
        let own = Spread {
            clearance: clearances.map(|clearance| UNIT + rounding(clearance)),
            duration: UNIT * duration,
            square: UNIT * square,
            fastest: [UNIT * fastest; 2],
        };
        Closing {
            node,
            first,
            second,
            duration,
            square,
            fastest: [fastest; 2],
            growth: [f64::NAN; 2],
            noise: 0.0,
            uncertainty: own.clearance[0],
            errors: [own, Spread::default()],
        }
    }

    /// Outside the domain of one of the two functions: it is infinite, the other a bound that says
    /// nothing.
    fn beyond(start: Length, rise: f64, fall: f64) -> Self {
        let node = Node::new(start.log, rise, fall, f64::NAN);
        let nothing = HalfSwing::nothing(start);
        Closing::of(node, [start, nothing.end], [nothing; 2])
    }

    /// Logarithm of the Floquet multiplier if this closing is a cycle.
    ///
    /// `mu = c0/(c0 + 2 r) c1/(c1 + 2 r) exp(-integral of (2 D + 3 D3 v^2))`: the divergence with the
    /// turning points built in. The D2 part of the integral vanishes on a closed curve.
    #[must_use]
    pub fn log_multiplier(&self, parameters: &Parameters) -> f64 {
        let gap = 2.0 * parameters.r;
        let past_friction: f64 =
            [self.first, self.second].iter().map(|&clearance| log_share(clearance, gap)).sum();
        // Three times a damping can be too large a number; times the square, which is then small, it is not.
        let cubic = 3.0 * (parameters.d3 * self.square);
        past_friction - 2.0 * parameters.d * self.duration - cubic
    }
}

impl Closing {
    /// Sum of the magnitudes of the terms of [`Closing::log_multiplier`].
    #[must_use]
    pub fn log_terms(&self, parameters: &Parameters) -> f64 {
        let Parameters { d, d3, r, .. } = *parameters;
        let shares = [self.first, self.second].map(|it| log_share(it, 2.0 * r).abs());
        shares[0] + shares[1] + 2.0 * d.abs() * self.duration + 3.0 * (d3.abs() * self.square)
    }
}

/// `ln(c/(c + gap))`, with all digits for large and for underflowing c.
fn log_share(clearance: Length, gap: f64) -> f64 {
    if gap == 0.0 {
        0.0
    } else if gap / clearance.value < 1e10 {
        -(gap / clearance.value).ln_1p()
    } else {
        clearance.log - (gap + clearance.value).ln()
    }
}
