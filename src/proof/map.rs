//! The return map of the right turning point, bounded on both sides, and its inverse.
//!
//! Values are clearances `z > 0` from the sticking set, and two special values: `-inf` for a motion that has
//! come to rest, `+inf` for one that never turns again. With both the map remains increasing. It also increases
//! when damping or friction is reduced (lemma 8), so bounds over intervals of parameters follow from the ends
//! of these.

use std::cell::OnceCell;

use super::ball::{MOST_STEPS, StartBox};
use super::field::{FieldBox, ParameterBox, scaled};
use super::funnel::Funnel;
use super::swing::{Passage, ProvedSwing, swing, swing_below};
use crate::model::Side;
use crate::numerics::Interval;

/// The map from one right turning point to the next.
///
/// The first half swing runs below `v = 0`, from the right turning point to the left one; the second runs above.
#[derive(Clone, Debug)]
pub struct ProvedMap {
    /// The parameters.
    pub parameters: ParameterBox,
    /// The fields of the two half maps, in the order of the forward map.
    fields: [FieldBox; 2],
    /// The funnel of each half and direction, once it has been computed.
    funnels: [[OnceCell<Option<Funnel>>; 2]; 2],
    /// `2 r`.
    pub gap: Interval,
    /// Number of half swings computed so far.
    pub swings: u32,
    /// Approximate number of steps they took.
    pub steps: u32,
}

/// The direction in which a map is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapDirection {
    /// Forward in time.
    Forward,
    /// Backward in time: the inverse.
    Backward,
}

/// Integration steps after which nothing more is computed: about 50 milliseconds.
const MOST_WORK: u32 = 30_000;

/// Relative distance below which starts form one ball for the derivative.
const NARROW: f64 = 1e-9;

/// Relative distance, at rounding level, below which starts form one ball for the end.
const ROUNDED: f64 = 1e-15;

/// A derivative below this need not be known more accurately.
const SUPERSTABLE: f64 = 1e-6;

/// Which bound is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// From below.
    Lower,
    /// From above.
    Upper,
}

impl ProvedMap {
    /// The map for these parameters.
    pub fn new(parameters: &ParameterBox) -> Self {
        ProvedMap {
            parameters: *parameters,
            fields: [Side::Lower, Side::Upper].map(|side| FieldBox::new(parameters, side)),
            funnels: Default::default(),
            gap: parameters.r.twice(),
            swings: 0,
            steps: 0,
        }
    }

    /// The field of a half in a direction.
    pub fn field(&self, index: usize, direction: MapDirection) -> FieldBox {
        match direction {
            MapDirection::Forward => self.fields[index],
            MapDirection::Backward => self.fields[index].reversed(),
        }
    }

    /// Runs one field from rest.
    pub fn run(&mut self, field: &FieldBox, start: Interval) -> Passage {
        self.run_below(field, start, None)
    }

    /// As [`Self::run`], but stops as soon as every motion is faster than the ceiling of a funnel.
    fn run_below(&mut self, field: &FieldBox, start: Interval, funnel: Option<&Funnel>) -> Passage {
        if self.steps > MOST_WORK {
            return Passage::Unknown;
        }
        let ceiling = funnel.map_or(f64::INFINITY, |it| it.ceiling);
        let passage = swing_below(field, &StartBox::at_rest(start), ceiling, false);
        self.swings += 1;
        self.steps += match passage {
            Passage::Arrives(swing) | Passage::Exceeds(swing) => swing.steps,
            Passage::Never => MOST_STEPS / 8,
            Passage::Unknown => MOST_STEPS,
        };
        passage
    }

    /// A swing from rest with all its results; where it is stiff, between the fences.
    pub fn whole_swing(
        &mut self,
        index: usize,
        direction: MapDirection,
        start: Interval,
    ) -> Option<ProvedSwing> {
        let field = self.field(index, direction);
        self.swings += 1;
        if let Some(swing) = swing(&field, &StartBox::at_rest(start), true).arrived() {
            return Some(swing);
        }
        let funnel = self.funnel(index, direction)?;
        let fallen = swing_below(&field, &StartBox::at_rest(start), funnel.speed, true);
        let Passage::Exceeds(fallen) = fallen else { return None };
        funnel.swing_after(&field, start, &fallen)
    }

    /// The funnel of a half, if it has one.
    pub fn funnel(&mut self, index: usize, direction: MapDirection) -> Option<Funnel> {
        let place = &self.funnels[index][usize::from(direction == MapDirection::Backward)];
        let mut swings = 0;
        let funnel = *place.get_or_init(|| Funnel::new(&self.field(index, direction), &mut swings));
        self.swings += swings;
        funnel
    }

    /// Upper bound of the ends of the swings of a half that start up to this far out.
    pub fn greatest(&mut self, index: usize, direction: MapDirection, from: f64) -> f64 {
        let funnel = self.funnel(index, direction);
        funnel.filter(|it| from <= it.reach).map_or(f64::INFINITY, |it| it.greatest())
    }

    /// Lower bound of the end of a swing. Where none can be computed, the bound for a start further in is used:
    /// that swing ends below.
    fn least(&mut self, index: usize, direction: MapDirection, start: f64) -> f64 {
        /// Times that a start is quartered in search of one that is not stiff.
        const SHORTENINGS: i32 = 6;
        let funnel = self.funnel(index, direction);
        let field = self.field(index, direction).strongest();
        if let Some(far) = funnel
            && far.climb_from(&field, Interval::point(start)).is_some()
        {
            return far.least();
        }
        let mut from = start;
        for _ in 0..SHORTENINGS {
            match self.run_below(&field, Interval::point(from), funnel.as_ref()) {
                Passage::Unknown => from *= 0.25,
                known => return Funnel::least_after(funnel.as_ref(), &field, &known),
            }
        }
        f64::NEG_INFINITY
    }

    /// Upper bound of the end of a swing.
    fn most(&mut self, index: usize, direction: MapDirection, start: f64) -> f64 {
        let funnel = self.funnel(index, direction);
        let field = self.field(index, direction).weakest();
        let far = funnel.and_then(|it| it.climb_from(&field, Interval::point(start)));
        if start < f64::INFINITY && far.is_none() {
            let passage = self.run_below(&field, Interval::point(start), funnel.as_ref());
            if let Passage::Arrives(swing) = passage {
                return swing.end.upper();
            }
        }
        self.greatest(index, direction, start)
    }

    /// One half of the map: from the clearances before a swing to those after it.
    pub fn half(&mut self, index: usize, direction: MapDirection, from: Interval) -> Interval {
        let start = match direction {
            MapDirection::Forward => from,
            MapDirection::Backward => from + self.gap,
        };
        let field = self.field(index, direction);
        if field.is_point()
            && from.lower() > 0.0
            && from.radius() <= ROUNDED * from.lower()
            && let Some(swing) = self.run(&field, start).arrived()
        {
            return self.after(direction, swing.end);
        }
        let lower = self.bound(index, direction, from.lower(), Bound::Lower);
        let upper = self.bound(index, direction, from.upper(), Bound::Upper);
        Interval::new(lower, upper.max(lower))
    }

    /// A bound of one half of the map at a clearance.
    fn bound(&mut self, index: usize, direction: MapDirection, from: f64, which: Bound) -> f64 {
        if from == f64::INFINITY || (direction == MapDirection::Forward && from <= 0.0) {
            return if from > 0.0 { from } else { f64::NEG_INFINITY };
        }
        let start = match direction {
            MapDirection::Forward => Interval::point(from),
            MapDirection::Backward => Interval::point(from) + self.gap,
        };
        let end = match which {
            Bound::Lower => self.least(index, direction, start.lower()),
            Bound::Upper => self.most(index, direction, start.upper()),
        };
        if end.is_infinite() {
            return if direction == MapDirection::Backward { end.max(0.0) } else { end };
        }
        let after = self.after(direction, Interval::point(end));
        match which {
            Bound::Lower => after.lower(),
            Bound::Upper => after.upper(),
        }
    }

    /// The clearances after swings that end at these positions; `-inf` where they end in the sticking set.
    fn after(&self, direction: MapDirection, end: Interval) -> Interval {
        match direction {
            MapDirection::Forward => {
                let rest = |bound: f64| if bound > 0.0 { bound } else { f64::NEG_INFINITY };
                let after = end - self.gap;
                Interval::new(rest(after.lower()), rest(after.upper()))
            }
            MapDirection::Backward => Interval::new(end.lower().max(0.0), end.upper()),
        }
    }

    /// The order of the halves in a direction.
    fn order(direction: MapDirection) -> [usize; 2] {
        match direction {
            MapDirection::Forward => [0, 1],
            MapDirection::Backward => [1, 0],
        }
    }

    /// A bound of the whole map at a clearance.
    pub fn image_bound(&mut self, direction: MapDirection, from: f64, which: Bound) -> f64 {
        let [first, second] = Self::order(direction);
        let between = self.bound(first, direction, from, which);
        self.bound(second, direction, between, which)
    }

    /// The whole map.
    pub fn image(&mut self, direction: MapDirection, from: Interval) -> Interval {
        let [first, second] = Self::order(direction);
        let between = self.half(first, direction, from);
        self.half(second, direction, between)
    }

    /// The derivative of the map over an interval of clearances; `None` where a swing is not certain.
    pub fn slope(&mut self, direction: MapDirection, over: Interval) -> Option<Interval> {
        self.image_and_slope(direction, over).map(|(_, slope)| slope)
    }

    /// The images of an interval of clearances, and the derivative over it.
    pub fn image_and_slope(
        &mut self,
        direction: MapDirection,
        over: Interval,
    ) -> Option<(Interval, Interval)> {
        let mut product = Interval::point(1.0);
        let mut from = over;
        for index in Self::order(direction) {
            let start = if direction == MapDirection::Backward { from + self.gap } else { from };
            let (end, slope) = self.half_slope(index, direction, start)?;
            product = product * slope;
            from = if direction == MapDirection::Forward { end - self.gap } else { end };
            if !(from.lower() > 0.0) {
                return None;
            }
        }
        Some((from, product))
    }

    /// The end of a half swing from an interval of starts, and its derivative with respect to the start.
    fn half_slope(
        &mut self,
        index: usize,
        direction: MapDirection,
        start: Interval,
    ) -> Option<(Interval, Interval)> {
        let field = self.field(index, direction);
        let funnel = self.funnel(index, direction);
        let stiff = |climb| funnel.and_then(|it| it.contraction(&field, start, climb));
        let far = funnel.and_then(|it| it.climb_from(&field, start)).and_then(stiff);
        let settled = |(_, slope): &(Interval, Interval)| slope.upper() < SUPERSTABLE;
        if far.as_ref().is_some_and(settled) {
            return far;
        }
        let whole = match self.run_below(&field, start, funnel.as_ref()) {
            Passage::Arrives(swing) => swing,
            Passage::Exceeds(swing) => {
                let near = funnel.and_then(|it| it.climb_of(&field, &swing)).and_then(stiff);
                if near.as_ref().is_some_and(settled) {
                    return near;
                }
                match self.run(&field, start) {
                    Passage::Arrives(swing) => swing,
                    _ => return near,
                }
            }
            _ => return None,
        };
        let (swing, slope) = self.swing_over(&field, start, whole)?;
        Some((swing.end, slope))
    }

    /// A swing from an interval of starts at rest, and the derivative of its end with respect to the start:
    /// `z/X exp(integral of the divergence)` (lemma 9).
    ///
    /// The end and the integral of `v^2` increase with the start and decrease with the damping. For wide
    /// intervals they are taken from two motions, and only the duration from the ball.
    fn swing_over(
        &mut self,
        field: &FieldBox,
        start: Interval,
        mut whole: ProvedSwing,
    ) -> Option<(ProvedSwing, Interval)> {
        if !(field.is_point() && start.radius() <= NARROW * start.lower()) {
            let low = self.run(&field.strongest(), Interval::point(start.lower())).arrived()?;
            let high = self.run(&field.weakest(), Interval::point(start.upper())).arrived()?;
            whole.end = Interval::new(low.end.lower(), high.end.upper());
            let least = low.square_in(whole.unit).lower();
            let most = high.square_in(whole.unit).upper();
            whole.square = Interval::new(least, most).intersection(whole.square)?;
            let FieldBox { a, b, c } = field.in_units_of(whole.unit);
            let path = scaled(whole.end + start, -whole.unit);
            whole.divergence = -(a * whole.duration + (b * path).twice() + c * whole.square * 3.0);
        }
        let slope = start / whole.end * whole.divergence.exp();
        slope.is_finite().then_some((whole, slope))
    }
}
