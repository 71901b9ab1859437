//! Stiff half swings: between two fences they follow a slow manifold and lose memory of their start.
//!
//! Where the slope `f'(v) = a + 2 b v + 3 c v^2` of the damping is large, a motion drops onto the curve
//! `x = -f(v)` and then creeps along it, which would force any explicit method to short steps. But nothing
//! needs to be computed there. All motions that were faster than some `speed` fall through it within a short
//! piece of the line `v = speed` (lemma 11), and the motions from the two ends of this piece, which are no
//! longer stiff, arrive almost together.

use std::cell::Cell;

use super::swing::swing;
use super::{FieldBox, Passage, ProvedSwing, StartBox, scaled};
use crate::numerics::{Interval, cbrt, exponent};

/// The beginning of motions, until all of them are faster than the speed of the funnel.
#[derive(Clone, Copy, Debug)]
pub struct Climb {
    /// Upper bound of the position at that moment.
    position: f64,
    /// Upper bound of the integral of the divergence of the field up to that moment.
    divergence: f64,
}

/// Where motions that were faster than `speed` fall through it, and where they arrive.
#[derive(Clone, Copy, Debug)]
pub struct Funnel {
    /// The velocity at which the fences end.
    pub speed: f64,
    /// A velocity from which motions certainly reach `speed`.
    pub ceiling: f64,
    /// Starts at rest up to this distance from the centre stay between the fences; may be infinite.
    pub reach: f64,
    /// Positions at which motions fall through `speed`.
    entry: Interval,
    /// Lower bound of `f'(v)/v` between the fences, 0 if not positive.
    rate: f64,
    /// The motion from the left end of `entry`, for the field with the most damping.
    low: Option<ProvedSwing>,
    /// The motion from the right end, for the field with the least damping.
    high: Option<ProvedSwing>,
    /// Arrivals of motions that fall off a fold of the slow manifold.
    beyond_fold: Interval,
}

impl Funnel {
    /// The funnel of a field, if there is one: for `c > 0`, or `b > 0`.
    pub fn new(field: &FieldBox, swings: &Cell<u32>) -> Option<Self> {
        // In units in which b or c is about 1.
        let (b, c) = (field.b.magnitude(), field.c.magnitude());
        let unit = if b > 0.0 { -exponent(b) } else { -exponent(c) / 2 };
        let local = field.in_units_of(unit);
        let mut funnel = Self::in_units(&local)?;
        let follow = |field: &FieldBox, x: f64| {
            swings.update(|swings| swings + 1);
            let [x, v] = [x, funnel.speed].map(Interval::point);
            swing(field, &StartBox { x, v }).arrived().map(|it| it.times_power(unit))
        };
        funnel.low = follow(&local.strongest(), funnel.entry.lower());
        funnel.high = follow(&local.weakest(), funnel.entry.upper());
        let length = |it: f64| scaled(Interval::point(it), unit);
        Some(Funnel {
            speed: length(funnel.speed).upper(),
            ceiling: length(funnel.ceiling).upper(),
            reach: length(funnel.reach).lower(),
            entry: scaled(funnel.entry, unit),
            rate: scaled(Interval::point(funnel.rate), -unit).lower(),
            beyond_fold: scaled(funnel.beyond_fold, unit),
            ..funnel
        })
    }

    /// Verifies the conditions of lemma 11 in intervals.
    fn in_units(field: &FieldBox) -> Option<Self> {
        /// Relative margin that keeps the fences on the safe side of the roots.
        const ROOM: f64 = 1e-9;
        let FieldBox { a, b, c } = field.weakest();
        let (speed, fastest) = fences([a, b, c].map(Interval::lower))?;
        let (speed, fastest) = (speed * (1.0 + ROOM), fastest * (1.0 - ROOM));
        let FieldBox { a, b, c } = *field;
        let v = Interval::point(speed);
        let (top, reach) = if c.lower() >= 0.0 {
            // The slope is convex and increases from the speed on.
            let convex = (b + c * 3.0 * v).lower() >= 0.0;
            (if convex { v } else { return None }, f64::INFINITY)
        } else if c < 0.0 && fastest > speed {
            let top = Interval::point(fastest);
            (top, field.force(top).lower())
        } else {
            return None;
        };
        // Done piece by piece, because the slope, which is smallest at an end of each piece, varies strongly.
        let mut from = v;
        loop {
            let to = Interval::point((2.0 * from.lower()).min(top.lower()));
            let least = Interval::point(field.slope(from).lower().min(field.slope(to).lower()));
            let excess = (a - c * 3.0 * to.square()) * 4.0;
            if !(least > 0.0 && excess.upper() <= (least * least.square()).lower()) {
                return None;
            }
            if to == top {
                break;
            }
            from = to;
        }
        let least = Interval::point(field.slope(v).lower());
        let force = field.force(v);
        let entry = Interval::new(-force.upper(), (v * 2.0 / least + -force.lower()).upper());
        let rate = Interval::point(a.lower().min(0.0)) / v + b.twice() + c * 3.0 * top;
        let rate = rate.lower().max(0.0);
        let known = entry.is_finite() && speed > 0.0 && reach > 0.0;
        let beyond_fold = beyond_fold(field, entry, v).unwrap_or(Interval::ALL);
        // At velocities beyond a thousand times their length scale, motions run away to the other branch.
        let ceiling = if beyond_fold.is_finite() {
            speed.min(1e3 * (1.0 + a.magnitude()) / b.magnitude())
        } else {
            speed
        };
        known.then_some(Funnel {
            speed,
            ceiling,
            reach,
            entry,
            rate,
            low: None,
            high: None,
            beyond_fold,
        })
    }

    /// Lower bound of the arrival of a motion with this passage below the ceiling.
    pub fn least_after(funnel: Option<&Self>, field: &FieldBox, passage: &Passage) -> f64 {
        match passage {
            Passage::Arrives(swing) => swing.end.lower(),
            Passage::Never => f64::INFINITY,
            Passage::Exceeds(swing) => funnel
                .filter(|it| it.climb_of(field, swing).is_some())
                .map_or(f64::NEG_INFINITY, |it| it.arrivals().lower()),
            Passage::Unknown => f64::NEG_INFINITY,
        }
    }

    /// The arrivals of motions that were faster than `speed`: none is lower, and none higher that starts at rest, up to
    /// `reach` away.
    pub fn arrivals(&self) -> Interval {
        let low = self.low.map_or(f64::NEG_INFINITY, |low| low.end.lower());
        let high = self.high.map_or(f64::INFINITY, |high| high.end.upper());
        Interval::new(low, high).intersection(self.beyond_fold).unwrap_or(self.beyond_fold)
    }

    /// The climb from rest far out, where nothing slows motions down yet (lemma 12).
    pub fn climb_from(&self, field: &FieldBox, start: Interval) -> Option<Climb> {
        let positive = |it: Interval| Interval::point(it.upper().max(0.0));
        let v = Interval::point(self.ceiling);
        let drag = field.map(positive).force(v);
        let half = Interval::point(start.lower()) / 2.0;
        let rate = Interval::point((half - drag).lower());
        let time = v / rate;
        let way = v * time;
        if !(rate > 0.0 && way.upper() <= half.lower()) {
            return None;
        }
        let FieldBox { a, b, c } = field.reversed().map(positive);
        let push = a + v * (b.twice() + v * c * 3.0);
        self.run_away(field, (way - start.lower()).upper(), (push * time).upper())
    }

    /// The climb of motions known to be faster than the ceiling.
    pub fn climb_of(&self, field: &FieldBox, swing: &ProvedSwing) -> Option<Climb> {
        self.run_away(field, swing.end.upper(), swing.divergence.upper())
    }

    /// The climb from the ceiling to the speed (lemma 12).
    fn run_away(&self, field: &FieldBox, position: f64, divergence: f64) -> Option<Climb> {
        let (speed, v) = (Interval::point(self.speed), Interval::point(self.ceiling));
        if speed == v {
            return Some(Climb { position, divergence });
        }
        let FieldBox { a, b, c } = *field;
        // Half of the excess of the square over the cube remains after all other terms.
        let half = (-b - c * speed) / 2.0;
        let half = Interval::point(half.lower());
        // At least the logarithm of the ratio of the two velocities.
        let doublings = f64::from(exponent((speed / v).upper()) + 1);
        let logarithm = Interval::point(doublings) * 0.7;
        let position = logarithm / half + position;
        let brake = v * a.upper().max(0.0) + position.upper().max(0.0);
        if !(half > 0.0 && brake.upper() <= (half * v.square()).lower()) {
            return None;
        }
        let push = Interval::point((-a).upper().max(0.0));
        let gained = push / (half * v) + (-b).twice() * logarithm / half;
        Some(Climb { position: position.upper(), divergence: (gained + divergence).upper() })
    }

    /// The arrivals, and an upper bound of their derivative with respect to the start; `climb` is the part
    /// until all motions were faster than `speed` (lemma 12).
    pub fn contraction(
        &self,
        field: &FieldBox,
        start: Interval,
        climb: Climb,
    ) -> Option<(Interval, Interval)> {
        if !(start.upper() <= self.reach) {
            return None;
        }
        let end = self.arrivals();
        let after = self.damping_after(field, end).or_else(|| self.damping_beyond_fold(field))?;
        let creep = Interval::point(self.entry.lower()) - climb.position;
        let creep = Interval::point(self.rate) * creep.lower().max(0.0);
        let exponent = Interval::point(climb.divergence) - creep - after;
        let slope = (start / end * exponent.exp()).upper();
        (slope < f64::INFINITY).then(|| (end, Interval::new(0.0, slope)))
    }

    /// The whole swing of motions known to fall from their largest velocity. The duration and the integral of
    /// `v^2` between the fences follow from the bound on their distance from the slow manifold (lemma 12).
    pub fn swing_after(
        &self,
        field: &FieldBox,
        start: Interval,
        fallen: &ProvedSwing,
    ) -> Option<ProvedSwing> {
        if !(start.upper() <= self.reach && self.rate > 0.0) {
            return None;
        }
        let unit = exponent(self.speed);
        let end = self.arrivals();
        let [late, squares] = self.after(field, end, unit)?;
        let field = field.in_units_of(unit);
        let FieldBox { a, b, c } = field;
        let [x, v, entry, e] = [fallen.end, fallen.speed, self.entry, Interval::point(self.speed)]
            .map(|it| scaled(it, -unit));
        // Between the fences `x + f` is at least 0 and at most `2 v/f'`, which is at most this.
        let beside = Interval::point(2.0) / scaled(Interval::point(self.rate), unit);
        let beside = Interval::new(0.0, beside.upper());
        let one = Interval::point(1.0);
        let time = entry / e - x / v + a * (v / e).ln() + (v - e) * (b + c * (v + e) / 2.0)
            - beside * (one / e - one / v);
        let work = |v: Interval| v.square() * (a / 2.0 + v * (b / 3.0 + v * c / 4.0));
        let square = e * entry - v * x - (work(v) - work(e)) + beside * (v - e);
        let positive = |it: Interval| it.intersection(Interval::new(0.0, f64::INFINITY));
        let duration = fallen.duration + positive(time)? + late;
        let square = fallen.square_in(unit) + positive(square)? + squares;
        let path = scaled(end + start, -unit);
        let divergence = -field.integrated_slope(duration, path, square);
        let speed = Interval::point(0.0);
        Some(ProvedSwing { end, speed, duration, divergence, square, unit, ..*fallen })
    }

    /// The integral of the slope of the damping over time from the line `v = speed` on.
    fn damping_after(&self, field: &FieldBox, end: Interval) -> Option<Interval> {
        let unit = exponent(self.speed);
        let [duration, squares] = self.after(field, end, unit)?;
        let way = scaled(end, -unit) - scaled(self.entry, -unit);
        Some(field.in_units_of(unit).integrated_slope(duration, way, squares))
    }

    /// The time from the line `v = speed` on, and the integral of `v^2` in units of `2^(2 unit)`.
    fn after(&self, field: &FieldBox, end: Interval, unit: i32) -> Option<[Interval; 2]> {
        let (low, high) = (self.low?, self.high?);
        let [end, entry, speed] =
            [end, self.entry, Interval::point(self.speed)].map(|it| scaled(it, -unit));
        // How fast a motion can still be when it has reached the first of the two ends, and for how long.
        let speed_left = (Interval::point(3.0 * end.upper()) * end.width()).sqrt().upper();
        let left = Interval::new(0.0, speed_left);
        let drag = field.in_units_of(unit).force(left).magnitude();
        let rate = Interval::point(end.lower()) - drag;
        if !(rate > 0.0 && drag <= 0.49 * end.upper()) {
            return None;
        }
        let late = (Interval::point(speed_left) / rate.lower()).upper();
        let (first, last) = (high.duration.lower(), low.duration.upper());
        let duration = Interval::new(first, last.max(first)).widened(late);
        let rim = (speed * entry.width()).upper();
        let squares = low.square_in(unit).hull(high.square_in(unit));
        Some([duration, squares.widened(rim)])
    }

    /// Lower bound of this integral for motions that fall off a fold.
    ///
    /// The slope is never below `a - b^2/(3 c)`. A motion faster than half the velocity of the fold has only
    /// the distance to the end to cover, and a slower one falls at least at a certain rate.
    fn damping_beyond_fold(&self, field: &FieldBox) -> Option<Interval> {
        if !self.beyond_fold.is_finite() {
            return None;
        }
        let unit = exponent(self.speed);
        let FieldBox { a, b, c } = field.in_units_of(unit);
        let [entry, end] = [self.entry, self.beyond_fold].map(|it| scaled(it, -unit));
        let least = (a - b.square() / (c * 3.0)).lower().min(0.0);
        let turning = -b / (c * 3.0);
        let half = Interval::point(turning.upper());
        // The force decreases up to the fold, so at up to half of the velocity there it is not below this.
        let force = half.square() * (b + c * half) + half * a.lower().min(0.0);
        let rate = force + entry.lower();
        let way = Interval::point((end - entry).upper());
        let within = half.upper() <= turning.twice().lower()
            && half < scaled(Interval::point(self.speed), -unit).lower();
        if !(rate > 0.0 && within) {
            return None;
        }
        let time = way / half + half / rate.lower();
        Some(Interval::new(0.0, time.upper()) * least)
    }
}

/// The arrivals of motions that fall through `speed` at `entry`, right of the centre, for `b < 0 < c` (lemma 12).
fn beyond_fold(field: &FieldBox, entry: Interval, speed: Interval) -> Option<Interval> {
    let FieldBox { a, b, c } = *field;
    if !(b < 0.0 && c > 0.0 && entry > 0.0) {
        return None;
    }
    let pull = speed * a.lower().min(0.0);
    // The minimum of b v^2 + c v^3.
    let least = b * 4.0 * b.square() / (c.square() * 27.0);
    let fold = -(least + pull);
    let last = speed.twice() + fold.upper().max(entry.upper());
    Some(Interval::new(entry.lower(), last.upper()))
}

/// The velocities between which the fences run for these coefficients, chosen in plain numbers and not verified: where
/// the slope of the damping is large enough to make motions meet. The larger one is infinite unless `c < 0`.
pub fn fences([a, b, c]: [f64; 3]) -> Option<(f64, f64)> {
    /// The slope at which a motion is no longer stiff.
    const SLOPE: f64 = 8.0;
    /// The same next to a fold of the slow manifold, per cube root of its stiffness.
    const AT_FOLD: f64 = 6.0;
    let gentle = SLOPE.max(4.0 * a);
    let at_fold = gentle.max(AT_FOLD * cbrt(b * b / c.abs()));
    // The roots of f' = slope: the larger one for c > 0, both for c < 0.
    let root = |slope: f64| (b * b + 3.0 * c * (slope - a)).sqrt();
    let beyond_fold = || (root(at_fold) - b) / (3.0 * c);
    let speed = if b >= 0.0 {
        (gentle - a) / (b + root(gentle))
    } else {
        beyond_fold()
    };
    let fastest = if c < 0.0 {
        (b + root(at_fold)) / (-3.0 * c)
    } else {
        f64::INFINITY
    };
    (speed > 0.0 && speed.is_finite()).then_some((speed, fastest))
}

#[cfg(test)]
mod tests {
    //! Time and area of stiff swings: compared with a first integral, with swings enclosed by steps, in other
    //! units, and for intervals of coefficients and starts.

    use super::*;
    use crate::numerics::elementary::exp;
    use crate::proof::swing::swing_below;

    /// The swing from rest, followed to its fall and then continued between the fences.
    fn between_fences(field: &FieldBox, start: Interval) -> ProvedSwing {
        let funnel = Funnel::new(field, &Cell::new(0)).unwrap();
        let fallen = swing_below(field, &StartBox::at_rest(start), funnel.speed, true);
        let Passage::Exceeds(fallen) = fallen else { panic!("{field:?}: {fallen:?}") };
        funnel.swing_after(field, start, &fallen).unwrap()
    }

    fn field(coefficients: [f64; 3]) -> FieldBox {
        let [a, b, c] = coefficients.map(Interval::point);
        FieldBox { a, b, c }
    }

    fn area(swing: &ProvedSwing) -> Interval {
        swing.square_in(0)
    }

    /// With `v^2` alone, and the distance `y` from the start, `v^2 = (l - y - l exp(-2 b y))/b`, `l = z + 1/(2 b)`,
    /// once `exp(-2 b l)` is below rounding; the swing ends at `1/(2 b)`. Time and area are integrals of `1/v` and
    /// `v` over y.
    #[test]
    fn a_swing_with_a_first_integral_is_held() {
        const PIECES: u32 = 20_000;
        for (b, z) in [(1.0, 100.0), (3.0, 1000.0), (0.25, 2000.0)] {
            let way: f64 = z + 0.5 / b;
            let (mut time, mut below) = (0.0, 0.0);
            for piece in 0..PIECES {
                // `y = l u^2 (3 - 2 u)` removes the square roots at both ends.
                let u = (f64::from(piece) + 0.5) / f64::from(PIECES);
                let y = way * u * u * (3.0 - 2.0 * u);
                let left = way * (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u);
                let v = ((left - way * exp(-2.0 * b * y)) / b).sqrt();
                let dy = 6.0 * way * u * (1.0 - u) / f64::from(PIECES);
                (time, below) = (time + dy / v, below + dy * v);
            }
            let found = between_fences(&field([0.0, b, 0.0]), Interval::point(z));
            assert!(found.end.contains(0.5 / b), "{}", found.end);
            assert!(found.end.width() < 1e-3 / b, "{}", found.end);
            for (held, value) in [(found.duration, time), (area(&found), below)] {
                assert!(held.contains(value), "{b} {z}: {held} {value}");
                assert!(held.width() < 0.05 * value, "{b} {z}: {held} {value}");
            }
        }
    }

    #[test]
    fn steps_that_still_get_through_agree_with_the_fences() {
        for (coefficients, z) in [
            ([0.0, 1.0, 0.0], 100.0),
            ([-0.2, 0.3, 0.1], 300.0),
            ([0.5, 0.0, 1.0], 60.0),
            ([-1.0, -0.1, 0.5], 100.0),
        ] {
            let (field, start) = (field(coefficients), Interval::point(z));
            let steps = swing(&field, &StartBox::at_rest(start)).arrived().unwrap();
            let fences = between_fences(&field, start);
            for (narrow, wide) in [
                (steps.end, fences.end),
                (steps.duration, fences.duration),
                (area(&steps), area(&fences)),
                (steps.divergence, fences.divergence),
            ] {
                assert!(wide.contains(narrow.middle()), "{field:?} {z}: {wide} {narrow}");
            }
        }
    }

    /// `(v, b, c) -> (v 2^k, b 2^-k, c 2^-2k)` leaves time unchanged to the last bit.
    #[test]
    fn other_units_change_nothing_but_lengths() {
        let (one, start) = (field([-0.2, 0.3, 0.1]), Interval::point(300.0));
        let here = between_fences(&one, start);
        for k in [-60, 14, 200] {
            let there = between_fences(&one.in_units_of(k), scaled(start, -k));
            assert_eq!(there.duration, here.duration);
            assert_eq!(there.end, scaled(here.end, -k));
            assert_eq!(there.square_in(-k), area(&here));
        }
    }

    /// Each corner of the box is followed by steps, and its end known to thirteen digits.
    #[test]
    fn an_interval_of_swings_holds_each_of_them() {
        let around = |value: f64| Interval::around(value, 1e-7 * value.abs());
        let (middle, z) = ([-0.2, 0.3, 0.1], 300.0);
        let [a, b, c] = middle.map(around);
        let all = between_fences(&FieldBox { a, b, c }, around(z));
        let ends = |it: Interval| [it.lower(), it.upper()];
        for a in ends(a) {
            for b in ends(b) {
                for c in ends(c) {
                    for z in ends(around(z)) {
                        let start = StartBox::at_rest(Interval::point(z));
                        let one = swing(&field([a, b, c]), &start).arrived().unwrap();
                        for (one, all) in [
                            (one.end, all.end),
                            (one.duration, all.duration),
                            (area(&one), area(&all)),
                        ] {
                            assert!(all.contains(one.middle()), "{a} {b} {c} {z}: {one} {all}");
                        }
                    }
                }
            }
        }
    }
}
