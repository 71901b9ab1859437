//! The return map of the right turning point, bounded on both sides, and its inverse.
//!
//! Values are clearances `z > 0` from the sticking set, and two special values: `-inf` for a motion that has
//! come to rest, `+inf` for one that never turns again. With both the map remains increasing. It also increases
//! when damping or friction is reduced (lemma 8), so bounds over intervals of parameters follow from the ends
//! of these.

use std::cell::OnceCell;

use super::ball::MOST_STEPS;
use super::field::ParameterBox;
use super::swing::swing;
use super::{FieldBox, Funnel, Passage, ProvedSwing, StartBox, scaled, swing_below};
use crate::model::Side;
use crate::numerics::Interval;

/// The map from one right turning point to the next.
///
/// The first half swing runs below `v = 0`, from the right turning point to the left one; the second runs above.
#[derive(Clone, Debug)]
pub struct ProvedMap {
    /// The parameters.
    pub parameters: ParameterBox,
    /// `2 r`.
    pub gap: Interval,
    /// Both half maps, in the order in which the map runs them.
    pub forward: [ProvedHalf; 2],
    /// Both half maps of the inverse, in the order in which that runs them: the second swing first.
    pub backward: [ProvedHalf; 2],
    /// What was computed so far.
    pub effort: Effort,
}

/// Half of the map, or of its inverse: from the clearances before a swing to those after it.
#[derive(Clone, Debug)]
pub struct ProvedHalf {
    /// Its field.
    pub field: FieldBox,
    direction: MapDirection,
    gap: Interval,
    /// Its funnel, once it has been computed.
    funnel: OnceCell<Option<Funnel>>,
}

/// What half swings cost.
#[derive(Clone, Copy, Debug, Default)]
pub struct Effort {
    /// Number of half swings.
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
        let gap = parameters.r.twice();
        let half = |field, direction| ProvedHalf { field, direction, gap, funnel: OnceCell::new() };
        let [first, second] =
            [Side::Lower, Side::Upper].map(|side| FieldBox::new(parameters, side));
        ProvedMap {
            parameters: *parameters,
            gap,
            forward: [first, second].map(|field| half(field, MapDirection::Forward)),
            backward: [second, first].map(|field| half(field.reversed(), MapDirection::Backward)),
            effort: Effort::default(),
        }
    }

    /// The half maps in a direction, and what counts their cost.
    pub fn halves(&mut self, direction: MapDirection) -> (&[ProvedHalf; 2], &mut Effort) {
        let halves = match direction {
            MapDirection::Forward => &self.forward,
            MapDirection::Backward => &self.backward,
        };
        (halves, &mut self.effort)
    }

    /// A bound of the whole map at a clearance.
    pub fn image_bound(&mut self, direction: MapDirection, from: f64, which: Bound) -> f64 {
        let (halves, effort) = self.halves(direction);
        halves.iter().fold(from, |at, half| half.bound(at, which, effort))
    }

    /// The whole map.
    pub fn image(&mut self, direction: MapDirection, from: Interval) -> Interval {
        let (halves, effort) = self.halves(direction);
        halves.iter().fold(from, |at, half| half.image(at, effort))
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
        let (halves, effort) = self.halves(direction);
        let (mut at, mut product) = (over, Interval::point(1.0));
        for half in halves {
            let (end, slope) = half.end_slope(half.start(at), effort)?;
            product = product * slope;
            at = if direction == MapDirection::Forward { end - half.gap } else { end };
            if !(at.lower() > 0.0) {
                return None;
            }
        }
        Some((at, product))
    }
}

impl Effort {
    /// Runs one field from rest; with a funnel it stops as soon as every motion is faster than the ceiling of that.
    pub fn run(&mut self, field: &FieldBox, start: Interval, funnel: Option<&Funnel>) -> Passage {
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

    /// The swings from rest in an interval of starts that end lowest and highest (lemma 8).
    pub fn extremes(&mut self, field: &FieldBox, start: Interval) -> Option<[ProvedSwing; 2]> {
        let [first, last] = [start.lower(), start.upper()].map(Interval::point);
        let low = self.run(&field.strongest(), first, None).arrived()?;
        let high = self.run(&field.weakest(), last, None).arrived()?;
        Some([low, high])
    }
}

impl ProvedHalf {
    /// Where a swing with a clearance starts.
    pub fn start(&self, clearance: Interval) -> Interval {
        match self.direction {
            MapDirection::Forward => clearance,
            MapDirection::Backward => clearance + self.gap,
        }
    }

    /// The clearances after swings that end at these positions; `-inf` where they end in the sticking set.
    fn after(&self, end: Interval) -> Interval {
        match self.direction {
            MapDirection::Forward => {
                let rest = |bound: f64| if bound > 0.0 { bound } else { f64::NEG_INFINITY };
                let after = end - self.gap;
                Interval::new(rest(after.lower()), rest(after.upper()))
            }
            MapDirection::Backward => Interval::new(end.lower().max(0.0), end.upper()),
        }
    }

    /// A swing from rest with all its results; where it is stiff, between the fences.
    pub fn whole_swing(&self, start: Interval, effort: &mut Effort) -> Option<ProvedSwing> {
        let rest = StartBox::at_rest(start);
        effort.swings += 1;
        if let Some(swing) = swing(&self.field, &rest, true).arrived() {
            return Some(swing);
        }
        let funnel = self.funnel(effort)?;
        let fallen = swing_below(&self.field, &rest, funnel.speed, true);
        let Passage::Exceeds(fallen) = fallen else { return None };
        funnel.swing_after(&self.field, start, &fallen)
    }

    /// Its funnel, if it has one.
    pub fn funnel(&self, effort: &mut Effort) -> Option<Funnel> {
        *self.funnel.get_or_init(|| Funnel::new(&self.field, &mut effort.swings))
    }

    /// Upper bound of the ends of the swings that start up to this far out.
    pub fn greatest(&self, from: f64, effort: &mut Effort) -> f64 {
        let funnel = self.funnel(effort).filter(|it| from <= it.reach);
        funnel.map_or(f64::INFINITY, |it| it.greatest())
    }

    /// Lower bound of the end of a swing. Where none can be computed, the bound for a start further in is used:
    /// that swing ends below.
    fn least(&self, start: f64, effort: &mut Effort) -> f64 {
        /// Times that a start is quartered in search of one that is not stiff.
        const SHORTENINGS: i32 = 6;
        let (funnel, field) = (self.funnel(effort), self.field.strongest());
        if let Some(far) = funnel
            && far.climb_from(&field, Interval::point(start)).is_some()
        {
            return far.least();
        }
        let mut from = start;
        for _ in 0..SHORTENINGS {
            match effort.run(&field, Interval::point(from), funnel.as_ref()) {
                Passage::Unknown => from *= 0.25,
                known => return Funnel::least_after(funnel.as_ref(), &field, &known),
            }
        }
        f64::NEG_INFINITY
    }

    /// Upper bound of the end of a swing.
    fn most(&self, start: f64, effort: &mut Effort) -> f64 {
        let (funnel, field) = (self.funnel(effort), self.field.weakest());
        let far = funnel.and_then(|it| it.climb_from(&field, Interval::point(start)));
        if start < f64::INFINITY && far.is_none() {
            let passage = effort.run(&field, Interval::point(start), funnel.as_ref());
            if let Passage::Arrives(swing) = passage {
                return swing.end.upper();
            }
        }
        self.greatest(start, effort)
    }

    /// The clearances after swings, from those before.
    pub fn image(&self, from: Interval, effort: &mut Effort) -> Interval {
        if self.field.is_point()
            && from.lower() > 0.0
            && from.radius() <= ROUNDED * from.lower()
            && let Some(swing) = effort.run(&self.field, self.start(from), None).arrived()
        {
            return self.after(swing.end);
        }
        let lower = self.bound(from.lower(), Bound::Lower, effort);
        let upper = self.bound(from.upper(), Bound::Upper, effort);
        Interval::new(lower, upper.max(lower))
    }

    /// A bound of the clearance after a swing.
    fn bound(&self, from: f64, which: Bound, effort: &mut Effort) -> f64 {
        let is_backward = self.direction == MapDirection::Backward;
        if from == f64::INFINITY || (!is_backward && from <= 0.0) {
            return if from > 0.0 { from } else { f64::NEG_INFINITY };
        }
        let start = self.start(Interval::point(from));
        let end = match which {
            Bound::Lower => self.least(start.lower(), effort),
            Bound::Upper => self.most(start.upper(), effort),
        };
        if end.is_infinite() {
            return if is_backward { end.max(0.0) } else { end };
        }
        let after = self.after(Interval::point(end));
        match which {
            Bound::Lower => after.lower(),
            Bound::Upper => after.upper(),
        }
    }

    /// The end of a swing from an interval of starts, and its derivative with respect to the start.
    fn end_slope(&self, from: Interval, effort: &mut Effort) -> Option<(Interval, Interval)> {
        let (field, funnel) = (&self.field, self.funnel(effort));
        let stiff = |climb| funnel.and_then(|it| it.contraction(field, from, climb));
        let far = funnel.and_then(|it| it.climb_from(field, from)).and_then(stiff);
        let settled = |(_, slope): &(Interval, Interval)| slope.upper() < SUPERSTABLE;
        if far.as_ref().is_some_and(settled) {
            return far;
        }
        let whole = match effort.run(field, from, funnel.as_ref()) {
            Passage::Arrives(swing) => swing,
            Passage::Exceeds(swing) => {
                let near = funnel.and_then(|it| it.climb_of(field, &swing)).and_then(stiff);
                if near.as_ref().is_some_and(settled) {
                    return near;
                }
                match effort.run(field, from, None) {
                    Passage::Arrives(swing) => swing,
                    _ => return near,
                }
            }
            _ => return None,
        };
        let swing = self.swing_over(from, whole, effort)?;
        // Lemma 9.
        let slope = from / swing.end * swing.divergence.exp();
        slope.is_finite().then_some((swing.end, slope))
    }

    /// A swing from an interval of starts at rest, from that of the ball of its motions.
    ///
    /// The end and the integral of `v^2` increase with the start and decrease with the damping. For wide
    /// intervals they are taken from two motions, and only the duration from the ball.
    fn swing_over(
        &self,
        start: Interval,
        whole: ProvedSwing,
        effort: &mut Effort,
    ) -> Option<ProvedSwing> {
        let (field, unit) = (&self.field, whole.unit);
        if field.is_point() && start.radius() <= NARROW * start.lower() {
            return Some(whole);
        }
        let [low, high] = effort.extremes(field, start)?;
        let end = Interval::new(low.end.lower(), high.end.upper());
        let squares = [low, high].map(|it| it.square_in(unit));
        let square = Interval::new(squares[0].lower(), squares[1].upper());
        let square = square.intersection(whole.square)?;
        let FieldBox { a, b, c } = field.in_units_of(unit);
        let path = scaled(end + start, -unit);
        let divergence = -(a * whole.duration + (b * path).twice() + c * square * 3.0);
        Some(ProvedSwing { end, divergence, square, ..whole })
    }
}
