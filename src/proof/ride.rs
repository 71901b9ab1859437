//! Within a half swing: the state of a motion at a time, and the blow-up of a motion that never turns.

use super::field::{Field, scaled};
use super::norm::Norm;
use super::rounding::INFLATE;
use super::series::Series;
use super::step::StepField;
use super::swing::{MOST_STEPS, StartBox, never_returns};
use crate::numerics::Interval;
use crate::numerics::elementary::cbrt;
use crate::numerics::scaling::exponent;

/// Size of the last term of a step, relative to the state: below rounding.
const TOLERANCE: f64 = 2e-17;

/// Attempts with successively shorter steps before giving up.
const ATTEMPTS: usize = 12;

/// A ball of motions in progress, in units in which its start is near 1.
struct Ride {
    local: StepField,
    norm: Norm,
    x: f64,
    v: f64,
    radius: f64,
    elapsed: Interval,
    series: Series,
    unit: i32,
}

impl Ride {
    fn new(field: &Field, start: &StartBox) -> Option<Self> {
        let size = start.x.magnitude().max(start.v.magnitude());
        if !(size > 0.0 && size.is_finite() && start.v.lower() >= 0.0) {
            return None;
        }
        let unit = exponent(size);
        let local = StepField::new(&field.in_units_of(unit));
        let [x, v] = [start.x, start.v].map(|it| scaled(it, -unit));
        Some(Ride {
            norm: Norm::fitting(local.field().a.middle()),
            local,
            x: x.middle(),
            v: v.middle(),
            radius: (x.radius() + v.radius()) * INFLATE,
            elapsed: Interval::point(0.0),
            series: Series::EMPTY,
            unit,
        })
    }

    /// One step, at most `most` long. The velocity vanishes neither during the step nor at its end (lemma 5).
    fn step(&mut self, most: f64) -> Option<()> {
        self.series.expand(self.local.middles(), self.x, self.v);
        let mut h = self.series.step(TOLERANCE).min(most);
        let ahead = self.series.at(h).1;
        (self.norm, self.radius) = self.local.ball((self.norm, self.radius), [self.v, ahead], h);
        for _ in 0..ATTEMPTS {
            if let Some(reached) =
                self.local.carry(self.norm, &self.series, (h, self.series.at(h)), self.radius)
            {
                (self.x, self.v, self.radius) = (reached.x, reached.v, reached.radius);
                self.elapsed = self.elapsed + Interval::point(h);
                return (self.state().1.lower() > 0.0).then_some(());
            }
            h *= 0.75;
        }
        None
    }

    /// Position and velocity.
    fn state(&self) -> (Interval, Interval) {
        let off = self.norm.stretch * self.radius * INFLATE;
        (Interval::around(self.x, off), Interval::around(self.v, off))
    }

    /// Upper bound of the time until the velocity is infinite; `None` where that is not certain.
    ///
    /// Above the line `v = x + m` the velocity grows at least at the rate `k0 + k1 u + k2 u^2 + k3 u^3`, where
    /// u is its gain (lemma 7). For every U, the constant term bounds the time until `u = U` by `U/k0`, and
    /// `k u^n` bounds the time from there on by `1/((n - 1) k U^(n - 1))`.
    fn remaining(&self) -> Option<f64> {
        let (x, v) = self.state();
        let (x, v) = (x.upper(), v.lower());
        if !never_returns(self.local.field(), x, v) {
            return None;
        }
        let Field { a, b, c } = *self.local.field();
        let [a, b, c] = [a, b, c].map(|it| Interval::point(it.upper()));
        let (at, two, three) = (Interval::point(v), Interval::point(2.0), Interval::point(3.0));
        let k0 = -Interval::point(x) - at * (a + at * (b + at * c));
        let k1 = -(a + Interval::point(1.0) + at * (b * two + at * c * three));
        let k2 = -(b + at * c * three);
        let k3 = -c;
        if !(k0.lower() > 0.0 && [k1, k2, k3].iter().all(|it| it.lower() >= 0.0)) {
            return None;
        }
        let up_to = |u: f64| Interval::point(u) / k0;
        let square = (k0.lower() / k2.lower()).sqrt();
        let cube = cbrt(k0.lower() / k3.lower());
        let by_square = up_to(square) + Interval::point(1.0) / (k2 * Interval::point(square));
        let by_cube =
            up_to(cube) + Interval::point(1.0) / (two * k3 * Interval::point(cube).square());
        let least = by_square.upper().min(by_cube.upper());
        least.is_finite().then_some(least)
    }
}

/// Position and velocity at a time after the start, for all motions of a box of starts and fields.
///
/// `None` where they are not known, or where the velocity may have reached 0 before.
pub fn state_at(field: &Field, start: &StartBox, time: Interval) -> Option<(Interval, Interval)> {
    let mut ride = Ride::new(field, start)?;
    let target = time.middle();
    for _ in 0..MOST_STEPS {
        let left = target - ride.elapsed.middle();
        if !(left > 4.0 * f64::EPSILON * target) {
            let off = (time - ride.elapsed).magnitude();
            let (x, v) = about(ride.local.field(), ride.state(), off)?;
            let (x, v) = (scaled(x, ride.unit), scaled(v, ride.unit));
            return (v.lower() >= 0.0).then_some((x, v));
        }
        ride.step(left)?;
    }
    None
}

/// A larger box that motions do not leave within the time `off` before and after they are in a box.
fn about(field: &Field, (x, v): (Interval, Interval), off: f64) -> Option<(Interval, Interval)> {
    let time = Interval::new(-off, off);
    let (mut wide_x, mut wide_v) = (x, v);
    for _ in 0..6 {
        let next_x = x + time * wide_v;
        let next_v = v + time * field.acceleration(wide_x, wide_v);
        if next_x.is_within(wide_x) && next_v.is_within(wide_v) {
            return Some((next_x, next_v));
        }
        let wider = |it: Interval| Interval::around(it.middle(), 1.1 * it.radius());
        (wide_x, wide_v) = (wider(wide_x.hull(next_x)), wider(wide_v.hull(next_v)));
    }
    None
}

/// The time at which the velocity of motions that never turn becomes infinite; `None` where it has no bound.
pub fn blow_up(field: &Field, start: &StartBox) -> Option<Interval> {
    /// Relative uncertainty of the time at which the bound is good enough.
    const GOOD: f64 = 1e-12;
    let mut ride = Ride::new(field, start)?;
    let mut best: Option<Interval> = None;
    for _ in 0..2 * MOST_STEPS {
        if let Some(remaining) = ride.remaining() {
            let over = ride.elapsed + Interval::new(0.0, remaining);
            best = Some(best.and_then(|best| best.intersection(over)).unwrap_or(over));
            if remaining < GOOD * over.upper() {
                break;
            }
        }
        if ride.step(f64::INFINITY).is_none() {
            break;
        }
    }
    best
}
