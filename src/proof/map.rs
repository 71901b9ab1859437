//! The return map of the right turning point, bounded on both sides, and its inverse.
//!
//! Values are clearances `z > 0` from the sticking set, and two special values: `-inf` for a motion that has
//! come to rest, `+inf` for one that never turns again. With both the map remains increasing. It also increases
//! when damping or friction is reduced (lemma 8), so bounds over intervals of parameters follow from the ends
//! of these.

use std::cell::{Cell, OnceCell};
use std::rc::Rc;

use super::ball::MOST_STEPS;
use super::field::ParameterBox;
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
    /// The map itself.
    pub forward: HalfMaps,
    /// The inverse, which runs the second swing first.
    pub backward: HalfMaps,
    /// What was computed so far.
    pub effort: Rc<Effort>,
}

/// The map in one direction of time: both its halves, in the order in which it runs them.
#[derive(Clone, Debug)]
pub struct HalfMaps(pub [ProvedHalf; 2]);

/// Half of the map, or of its inverse: from the clearances before a swing to those after it.
#[derive(Clone, Debug)]
pub struct ProvedHalf {
    /// Its field.
    pub field: FieldBox,
    /// Whether it runs backward in time: half of the inverse.
    backward: bool,
    gap: Interval,
    /// Its funnel, once it has been computed.
    funnel: OnceCell<Option<Funnel>>,
    /// What all halves of the map have cost.
    effort: Rc<Effort>,
}

/// What half swings cost.
#[derive(Clone, Debug, Default)]
pub struct Effort {
    /// Number of half swings.
    pub swings: Cell<u32>,
    /// Approximate number of steps they took.
    pub steps: Cell<u32>,
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
        let (gap, effort) = (parameters.r.twice(), Rc::<Effort>::default());
        let half = |side, backward| {
            let forward = FieldBox::new(parameters, side);
            let field = if backward { forward.reversed() } else { forward };
            let (funnel, effort) = (OnceCell::new(), Rc::clone(&effort));
            ProvedHalf { field, backward, gap, funnel, effort }
        };
        ProvedMap {
            parameters: *parameters,
            gap,
            forward: HalfMaps([Side::Lower, Side::Upper].map(|side| half(side, false))),
            backward: HalfMaps([Side::Upper, Side::Lower].map(|side| half(side, true))),
            effort,
        }
    }
}

impl HalfMaps {
    /// A bound of the whole map at a clearance.
    pub fn image_bound(&self, from: f64, which: Bound) -> f64 {
        self.0.iter().fold(from, |at, half| half.bound(at, which))
    }

    /// The whole map.
    pub fn image(&self, from: Interval) -> Interval {
        self.0.iter().fold(from, |at, half| half.image(at))
    }

    /// The derivative of the map over an interval of clearances; `None` where a swing is not certain.
    pub fn slope(&self, over: Interval) -> Option<Interval> {
        self.image_and_slope(over).map(|(_, slope)| slope)
    }

    /// The images of an interval of clearances, and the derivative over it.
    pub fn image_and_slope(&self, over: Interval) -> Option<(Interval, Interval)> {
        let (mut at, mut product) = (over, Interval::point(1.0));
        for half in &self.0 {
            let (end, slope) = half.end_slope(half.start(at))?;
            product = product * slope;
            at = if half.backward { end } else { end - half.gap };
            if !(at > 0.0) {
                return None;
            }
        }
        Some((at, product))
    }
}

impl Effort {
    /// Runs one field from rest; with a funnel it stops as soon as every motion is faster than the ceiling of that.
    pub fn run(&self, field: &FieldBox, start: Interval, funnel: Option<&Funnel>) -> Passage {
        if self.steps.get() > MOST_WORK {
            return Passage::Unknown;
        }
        let ceiling = funnel.map_or(f64::INFINITY, |it| it.ceiling);
        let passage = swing_below(field, &StartBox::at_rest(start), ceiling, false);
        self.swings.update(|swings| swings + 1);
        let taken = match passage {
            Passage::Arrives(swing) | Passage::Exceeds(swing) => swing.steps,
            Passage::Never => MOST_STEPS / 8,
            Passage::Unknown => MOST_STEPS,
        };
        self.steps.update(|steps| steps + taken);
        passage
    }

    /// The swings from rest in an interval of starts that end lowest and highest (lemma 8).
    pub fn extremes(&self, field: &FieldBox, start: Interval) -> Option<[ProvedSwing; 2]> {
        let [first, last] = [start.lower(), start.upper()].map(Interval::point);
        let low = self.run(&field.strongest(), first, None).arrived()?;
        let high = self.run(&field.weakest(), last, None).arrived()?;
        Some([low, high])
    }
}

impl ProvedHalf {
    /// Where a swing with a clearance starts.
    pub fn start(&self, clearance: Interval) -> Interval {
        if self.backward {
            clearance + self.gap
        } else {
            clearance
        }
    }

    /// The clearances after swings that end at these positions; `-inf` where they end in the sticking set.
    fn after(&self, end: Interval) -> Interval {
        if self.backward {
            return Interval::new(end.lower().max(0.0), end.upper());
        }
        let rest = |bound: f64| if bound > 0.0 { bound } else { f64::NEG_INFINITY };
        let after = end - self.gap;
        Interval::new(rest(after.lower()), rest(after.upper()))
    }

    /// A swing from rest with all its results; where it is stiff, between the fences.
    pub fn whole_swing(&self, start: Interval) -> Option<ProvedSwing> {
        let rest = StartBox::at_rest(start);
        self.effort.swings.update(|swings| swings + 1);
        if let Some(swing) = swing_below(&self.field, &rest, f64::INFINITY, true).arrived() {
            return Some(swing);
        }
        let funnel = self.funnel()?;
        let fallen = swing_below(&self.field, &rest, funnel.speed, true);
        let Passage::Exceeds(fallen) = fallen else { return None };
        funnel.swing_after(&self.field, start, &fallen)
    }

    /// Its funnel, if it has one.
    pub fn funnel(&self) -> Option<&Funnel> {
        self.funnel.get_or_init(|| Funnel::new(&self.field, &self.effort.swings)).as_ref()
    }

    /// Upper bound of the ends of the swings that start up to this far out.
    pub fn greatest(&self, from: f64) -> f64 {
        let funnel = self.funnel().filter(|it| from <= it.reach);
        funnel.map_or(f64::INFINITY, |it| it.arrivals().upper())
    }

    /// Lower bound of the end of a swing. Where none can be computed, the bound for a start further in is used:
    /// that swing ends below.
    fn least(&self, start: f64) -> f64 {
        /// Times that a start is quartered in search of one that is not stiff.
        const SHORTENINGS: i32 = 6;
        let (funnel, field) = (self.funnel(), self.field.strongest());
        if let Some(far) = funnel
            && far.climb_from(&field, Interval::point(start)).is_some()
        {
            return far.arrivals().lower();
        }
        let mut from = start;
        for _ in 0..SHORTENINGS {
            match self.effort.run(&field, Interval::point(from), funnel) {
                Passage::Unknown => from *= 0.25,
                known => return Funnel::least_after(funnel, &field, &known),
            }
        }
        f64::NEG_INFINITY
    }

    /// Upper bound of the end of a swing.
    fn most(&self, start: f64) -> f64 {
        let (funnel, field) = (self.funnel(), self.field.weakest());
        let far = funnel.and_then(|it| it.climb_from(&field, Interval::point(start)));
        if start < f64::INFINITY && far.is_none() {
            let passage = self.effort.run(&field, Interval::point(start), funnel);
            if let Passage::Arrives(swing) = passage {
                return swing.end.upper();
            }
        }
        self.greatest(start)
    }

    /// The clearances after swings, from those before.
    pub fn image(&self, from: Interval) -> Interval {
        if self.field.is_point()
            && from > 0.0
            && from.radius() <= ROUNDED * from.lower()
            && let Some(swing) = self.effort.run(&self.field, self.start(from), None).arrived()
        {
            return self.after(swing.end);
        }
        let lower = self.bound(from.lower(), Bound::Lower);
        let upper = self.bound(from.upper(), Bound::Upper);
        Interval::new(lower, upper.max(lower))
    }

    /// A bound of the clearance after a swing.
    fn bound(&self, from: f64, which: Bound) -> f64 {
        if from == f64::INFINITY || (!self.backward && from <= 0.0) {
            return if from > 0.0 { from } else { f64::NEG_INFINITY };
        }
        let start = self.start(Interval::point(from));
        let end = match which {
            Bound::Lower => self.least(start.lower()),
            Bound::Upper => self.most(start.upper()),
        };
        if end.is_infinite() {
            return if self.backward { end.max(0.0) } else { end };
        }
        let after = self.after(Interval::point(end));
        match which {
            Bound::Lower => after.lower(),
            Bound::Upper => after.upper(),
        }
    }

    /// The end of a swing from an interval of starts, and its derivative with respect to the start.
    fn end_slope(&self, from: Interval) -> Option<(Interval, Interval)> {
        let (field, funnel) = (&self.field, self.funnel());
        let stiff = |climb| funnel.and_then(|it| it.contraction(field, from, climb));
        let far = funnel.and_then(|it| it.climb_from(field, from)).and_then(stiff);
        let settled = |(_, slope): &(Interval, Interval)| *slope < SUPERSTABLE;
        if far.as_ref().is_some_and(settled) {
            return far;
        }
        let whole = match self.effort.run(field, from, funnel) {
            Passage::Arrives(swing) => swing,
            Passage::Exceeds(swing) => {
                let near = funnel.and_then(|it| it.climb_of(field, &swing)).and_then(stiff);
                if near.as_ref().is_some_and(settled) {
                    return near;
                }
                let whole = self.effort.run(field, from, None).arrived();
                let Some(swing) = whole else { return near };
                swing
            }
            _ => return None,
        };
        let swing = self.swing_over(from, whole)?;
        // Lemma 9.
        let slope = from / swing.end * swing.divergence.exp();
        slope.is_finite().then_some((swing.end, slope))
    }

    /// A swing from an interval of starts at rest, from that of the ball of its motions.
    ///
    /// The end and the integral of `v^2` increase with the start and decrease with the damping. For wide
    /// intervals they are taken from two motions, and only the duration from the ball.
    fn swing_over(&self, start: Interval, whole: ProvedSwing) -> Option<ProvedSwing> {
        let (field, unit) = (&self.field, whole.unit);
        if field.is_point() && start.radius() <= NARROW * start.lower() {
            return Some(whole);
        }
        let [low, high] = self.effort.extremes(field, start)?;
        let end = Interval::new(low.end.lower(), high.end.upper());
        let squares = [low, high].map(|it| it.square_in(unit));
        let square = Interval::new(squares[0].lower(), squares[1].upper());
        let square = square.intersection(whole.square)?;
        let path = scaled(end + start, -unit);
        let divergence = -field.in_units_of(unit).integrated_slope(whole.duration, path, square);
        Some(ProvedSwing { end, divergence, square, ..whole })
    }
}
