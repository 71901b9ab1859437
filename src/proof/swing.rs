//! The certified half swing: from `(x, v)`, `v >= 0`, to the next `v = 0`, or the proof that there is none.

use std::convert::Infallible;

use super::field::{Field, scaled};
use super::norm::Norm;
use super::rounding::{INFLATE, UNIT};
use super::sensitivity::WeightedIntegrals;
use super::series::Series;
use super::step::{StepEnd, StepField};
use crate::numerics::Interval;
use crate::numerics::elementary::powi;
use crate::numerics::root::{Bracket, PlaceTolerance, illinois, newton};
use crate::numerics::scaling::exponent;

/// The start of a half swing: any point of a box. On `v = 0` it starts left of the centre, `x < 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartBox {
    /// Position in the frame of the half plane.
    pub x: Interval,
    /// Velocity in that frame, not negative.
    pub v: Interval,
}

impl StartBox {
    /// A start at rest with this clearance from the sticking set.
    pub fn at_rest(clearance: Interval) -> Self {
        StartBox { x: -clearance, v: Interval::point(0.0) }
    }
}

/// A half swing that arrives at `v = 0`; each interval holds the values of all starts and fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// Position of the arrival.
    pub end: Interval,
    /// Velocity at the arrival: 0, unless the swing was stopped early.
    pub speed: Interval,
    /// Duration.
    pub duration: Interval,
    /// Integral of the divergence of the field along the swing.
    pub divergence: Interval,
    /// Integral of `v^2`, in units of `2^(2 unit)`.
    pub square: Interval,
    /// Exponent of the unit of `square`.
    pub unit: i32,
    /// Largest velocity, if requested.
    pub fastest: Option<Interval>,
    /// Derivatives of `end` with respect to the coefficients a, b and c of the field, if requested.
    pub derivatives: Option<[Interval; 3]>,
    /// Steps taken.
    pub steps: u32,
}

/// What is certain about a half swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passage {
    /// Every motion arrives at `v = 0`.
    Arrives(Swing),
    /// No motion arrives: the velocity never falls again.
    Never,
    /// Every motion becomes faster than the ceiling; the swing ends where that is certain.
    Exceeds(Swing),
    /// Nothing is certain.
    Unknown,
}

impl Swing {
    /// The integral of `v^2` in units of `2^(2 unit)`.
    pub fn square_in(&self, unit: i32) -> Interval {
        let k = self.unit - unit;
        scaled(scaled(self.square, k), k)
    }

    /// The same swing with lengths multiplied by `2^k`.
    pub fn times_power(self, k: i32) -> Self {
        let fastest = self.fastest.map(|it| scaled(it, k));
        let derivatives = self.derivatives.map(|it| by_units(it, k));
        let [end, speed] = [self.end, self.speed].map(|it| scaled(it, k));
        Swing { end, speed, unit: self.unit + k, fastest, derivatives, ..self }
    }
}

impl Passage {
    /// The swing, if it certainly arrives.
    pub fn arrived(self) -> Option<Swing> {
        if let Passage::Arrives(swing) = self { Some(swing) } else { None }
    }
}

/// Size of the last term of a step, relative to the state: below rounding.
const TOLERANCE: f64 = 2e-17;

/// Steps after which a swing is abandoned: a smooth one takes ten, a stiff one any number.
pub const MOST_STEPS: u32 = 250;

/// Attempts with successively shorter steps before giving up.
const ATTEMPTS: usize = 12;

/// Computes a half swing of every field in `field` from every point of `start`.
///
/// Guarantee: the bounds hold for the exact motions, whatever the rounding. The result is `Unknown` where there
/// are no bounds: for a stiff or a wide motion, or one that arrives within its own error of the centre.
pub fn swing(field: &Field, start: &StartBox, wants_fastest: bool) -> Passage {
    run(field, start, f64::INFINITY, wants_fastest, None)
}

/// As [`swing`], but stops as soon as every motion is certainly faster than `ceiling`.
pub fn swing_below(field: &Field, start: &StartBox, ceiling: f64) -> Passage {
    run(field, start, ceiling, false, None)
}

/// As [`swing_below`] with the largest velocity; it stops only after that was reached.
pub fn swing_past_peak(field: &Field, start: &StartBox, ceiling: f64) -> Passage {
    run(field, start, ceiling, true, None)
}

/// As [`swing`] with the derivatives by the coefficients of the field (lemma 21), at four times the cost.
pub fn swing_with_derivatives(field: &Field, start: &StartBox) -> Passage {
    run(field, start, f64::INFINITY, false, Some(WeightedIntegrals::default()))
}

fn run(
    field: &Field,
    start: &StartBox,
    ceiling: f64,
    wants_fastest: bool,
    weighted: Option<WeightedIntegrals>,
) -> Passage {
    let size = start.x.magnitude().max(start.v.magnitude());
    if !(size > 0.0 && size.is_finite() && start.v.lower() >= 0.0) {
        return Passage::Unknown;
    }
    if start.v.lower() == 0.0 && (start.v.upper() > 0.0 || start.x.upper() >= 0.0) {
        return Passage::Unknown;
    }
    let unit = exponent(size);
    let local = StepField::new(&field.in_units_of(unit));
    let start = StartBox { x: scaled(start.x, -unit), v: scaled(start.v, -unit) };
    let (x, v) = (start.x.middle(), start.v.middle());
    // The norm of a vector is at most the sum of the magnitudes of its components.
    let radius = (start.x.radius() + start.v.radius()) * INFLATE;
    if never_returns(local.field(), start.x.upper(), start.v.lower()) {
        return Passage::Never;
    }
    let norm = Norm::fitting(local.field().a.middle());
    let mut run = SwingRun {
        local,
        norm,
        x,
        v,
        radius,
        time: 0.0,
        time_error: 0.0,
        square: 0.0,
        square_error: 0.0,
        fastest: None,
        weighted,
        ceiling: scaled(Interval::point(ceiling), -unit).upper(),
    };
    let mut series = Series::EMPTY;
    for steps in 1..=MOST_STEPS {
        match run.advance(&mut series, wants_fastest) {
            Some(Arrival::Later) => {}
            Some(Arrival::Now { end, lag }) => {
                let swing = run.finish(&start, (end, Interval::point(0.0)), lag, unit, steps);
                return swing.map_or(Passage::Unknown, Passage::Arrives);
            }
            Some(Arrival::Above(end, speed)) => {
                let swing = run.finish(&start, (end, speed), 0.0, unit, steps);
                return swing.map_or(Passage::Unknown, Passage::Exceeds);
            }
            Some(Arrival::Never) => return Passage::Never,
            None => return Passage::Unknown,
        }
    }
    Passage::Unknown
}

/// The derivatives of a length by a, b and c, in units `2^k` times as large.
fn by_units([a, b, c]: [Interval; 3], k: i32) -> [Interval; 3] {
    let two = |it| scaled(scaled(it, k), k);
    [scaled(a, k), two(b), scaled(two(c), k)]
}

/// Whether no motion from positions up to `x` and velocities from `v` on ever returns to `v = 0` (lemma 7).
///
/// Motions cross the line `v = x + m` to the left where `P(v) = m - (a + 2) v - b v^2 - c v^3 >= 0`, and above
/// it the acceleration is at least `P(v) + v`. So if P is not negative from v on, motions above the line and
/// faster than v stay so.
pub fn never_returns(field: &Field, x: f64, v: f64) -> bool {
    let m = Interval::point(v) - Interval::point(x);
    if !(field.c.upper() <= 0.0 && m.lower() > 0.0 && v >= 0.0) {
        return false;
    }
    let [a, b, c] = [field.a, field.b, field.c].map(|it| Interval::point(it.upper()));
    let (at, two, three) = (Interval::point(v), Interval::point(2.0), Interval::point(3.0));
    let linear = a + two;
    // Coefficients of P in powers of the velocity in excess of v.
    let p0 = m - at * (linear + at * (b + at * c));
    let p1 = -(linear + at * (b * two + at * c * three));
    let p2 = -(b + at * c * three);
    let p3 = -c;
    let holds = |it: Interval| it.lower() >= 0.0;
    if holds(p1) && holds(p2) {
        return holds(p0);
    }
    if p2.lower() > 0.0 && holds(Interval::point(4.0) * p0 * p2 - p1.square()) {
        return true;
    }
    if !(p3.lower() > 0.0) {
        return false;
    }
    // Half of the cubic term compensates the square by u^3 >= 2 t u^2 - t^2 u, the other half the remaining
    // linear term by u^3 >= 3 t^2 u - 2 t^3; both hold for all u, t >= 0.
    let half = p3 / two;
    let linear = if holds(p2) { p1 } else { p1 - p2.square() / (p3 * two) };
    if holds(linear) {
        return holds(p0);
    }
    let t = Interval::point((-linear / (half * three)).sqrt().upper());
    holds(p0 - half * two * t * t * t) && holds(linear + half * three * t * t)
}

/// A half swing in progress, in units in which its start is near 1.
struct SwingRun {
    local: StepField,
    norm: Norm,
    x: f64,
    v: f64,
    /// Norm of the distance to the motion.
    radius: f64,
    time: f64,
    time_error: f64,
    square: f64,
    square_error: f64,
    fastest: Option<Interval>,
    /// Weighted integrals for the derivatives by the coefficients, if requested.
    weighted: Option<WeightedIntegrals>,
    /// Velocity above which the computation stops.
    ceiling: f64,
}

/// What a step tells about the largest velocity.
enum Speed {
    /// It is reached later.
    StillRising,
    /// It was reached.
    Largest(Interval),
    /// It was reached, but its bounds are not certain enough.
    Uncertain,
}

enum Arrival {
    Later,
    Now {
        /// Position of the arrival.
        end: Interval,
        /// Largest time between the arrival and the end of the last step.
        lag: f64,
    },
    /// Faster than the ceiling, at this position and velocity.
    Above(Interval, Interval),
    Never,
}

impl SwingRun {
    fn advance(&mut self, series: &mut Series, wants_fastest: bool) -> Option<Arrival> {
        series.expand(self.local.middles(), self.x, self.v);
        let mut h = series.step(TOLERANCE);
        if !(h > 0.0) {
            return None;
        }
        let mut end = series.at(h);
        let mut last = false;
        (self.norm, self.radius) = self.local.ball((self.norm, self.radius), [self.v, end.1], h);
        if !(end.1 > 4.0 * self.norm.stretch * self.radius) {
            (h, last) = arrival(series, h, end.1)?;
            end = series.at(h);
        }
        let mut reached = None;
        for _ in 0..ATTEMPTS {
            reached = self.local.carry(self.norm, series, (h, end), self.radius);
            if reached.is_some() {
                break;
            }
            (h, last) = (0.75 * h, false);
            end = series.at(h);
        }
        let reached = reached?;
        if wants_fastest && self.fastest.is_none() {
            match self.turn_of_speed(series, h, &reached) {
                Speed::StillRising => {}
                Speed::Largest(fastest) => self.fastest = Some(fastest),
                Speed::Uncertain => return None,
            }
        }
        if let Some(weighted) = self.weighted {
            self.weighted = Some(weighted.after(self.local.field(), series, h, reached.off)?);
        }
        self.time += h;
        self.time_error += UNIT * self.time;
        self.square += reached.square;
        self.square_error += reached.square_error + UNIT * self.square;
        (self.x, self.v, self.radius) = (reached.x, reached.v, reached.radius);
        let off = self.norm.stretch * self.radius * INFLATE;
        if last {
            return self.arrive(off);
        }
        // The sign of v at the end of a step must be certain.
        if !(self.v > off) {
            return None;
        }
        if self.v - off > self.ceiling && (!wants_fastest || self.fastest.is_some()) {
            let [x, v] = [self.x, self.v].map(|it| Interval::around(it, off));
            return Some(Arrival::Above(x, v));
        }
        let escapes =
            never_returns(self.local.field(), (self.x + off).next_up(), (self.v - off).next_down());
        Some(if escapes { Arrival::Never } else { Arrival::Later })
    }

    /// The arrival at `v = 0` near the end of the last step (lemma 6).
    ///
    /// There `abs(v) <= most`, and as long as this holds, v falls at a rate of at least
    /// `x - most (abs(a) + ..)`. The time of arrival is therefore within `most/rate`, and the position within
    /// `most` times that.
    fn arrive(&self, off: f64) -> Option<Arrival> {
        let most = (self.v.abs() + off) * INFLATE;
        let x = Interval::around(self.x, off);
        let field = self.local.field();
        let speed = Interval::new(-most, most);
        let damping = speed * (field.a + speed * (field.b + speed * field.c));
        // Whether the motion continues or is followed back, x only grows.
        let rate = Interval::point(x.lower()) - Interval::point(damping.magnitude());
        if !(rate.lower() > 0.0) {
            return None;
        }
        let lag = (Interval::point(most) / Interval::point(rate.lower())).upper();
        let along = (Interval::point(most) * Interval::point(lag)).upper();
        let end =
            Interval::new(x.lower(), (Interval::point(x.upper()) + Interval::point(along)).upper());
        let end = if end.lower() > 0.0 { end } else { return None };
        Some(Arrival::Now { end, lag })
    }

    /// The largest velocity, if it is reached within this step.
    ///
    /// Where the acceleration vanishes its derivative is `-v < 0`, so there is one such moment in a half swing.
    /// Near it, with acceleration at most `d` in magnitude at velocity v, the remaining rise is at most
    /// `d^2/(v - d f)`, where f bounds the slope of the damping.
    fn turn_of_speed(&self, series: &Series, h: f64, end: &StepEnd) -> Speed {
        /// An error in the moment costs only its square.
        const NEAR: f64 = 1e-10;
        let field = self.local.field();
        let rough =
            |x: f64, v: f64| field.acceleration(Interval::point(x), Interval::point(v)).middle();
        if rough(end.x, end.v) > 0.0 {
            return Speed::StillRising;
        }
        let ends = [0.0, h].map(|at| (at, series.velocity(at).1));
        let Ok([near, _]) = illinois(ends, 0.0, PlaceTolerance::Absolute(NEAR * h), |at| {
            Ok::<_, Infallible>(series.velocity(at).1)
        });
        let near = (near.0, series.at(near.0));
        let Some(near) = self.local.carry(self.norm, series, near, self.radius) else {
            return Speed::Uncertain;
        };
        let off = self.norm.stretch * near.radius * INFLATE;
        let (x, v) = (Interval::around(near.x, off), Interval::around(near.v, off));
        let unbalanced = Interval::point(field.acceleration(x, v).magnitude());
        let cap = v.upper() * 1.01;
        let slope = field.slope(Interval::new(v.lower(), cap)).magnitude();
        let bend = Interval::point(v.lower()) - unbalanced * Interval::point(slope);
        if !(bend.lower() > 0.0) {
            return Speed::Uncertain;
        }
        let rise = (unbalanced.square() / bend).upper();
        let top = (Interval::point(v.upper()) + Interval::point(rise)).upper();
        if top <= cap { Speed::Largest(Interval::new(v.lower(), top)) } else { Speed::Uncertain }
    }

    fn finish(
        &self,
        start: &StartBox,
        (end, velocity): (Interval, Interval),
        lag: f64,
        unit: i32,
        steps: u32,
    ) -> Option<Swing> {
        let Field { a, b, c } = *self.local.field();
        let duration = Interval::around(self.time, (self.time_error + lag) * INFLATE);
        // Beyond the end of the step v stays below its bound there, whose square times the lag bounds the integral.
        let speed = self.v.abs() + self.norm.stretch * self.radius * INFLATE;
        let beyond = lag * powi(speed, 2);
        let square = Interval::around(self.square, (self.square_error + beyond) * INFLATE);
        let divergence =
            -(a * duration + (b * (end - start.x)).twice() + c * square * Interval::point(3.0));
        let known = duration.is_finite() && divergence.is_finite() && duration.lower() > 0.0;
        known.then(|| Swing {
            end: scaled(end, unit),
            speed: scaled(velocity, unit),
            duration,
            divergence,
            square,
            unit,
            fastest: self.fastest.map(|fastest| scaled(fastest, unit)),
            derivatives: self.weighted.map(|weighted| {
                let arrived = weighted.within(self.local.field(), lag, speed * INFLATE);
                by_units(arrived.derivatives(end), unit)
            }),
            steps,
        })
    }
}

/// Where the polynomial of v vanishes at or just beyond `h`, by Newton's method inside a bracket; otherwise a
/// shorter step. The flag tells which. No bound depends on the accuracy of the root.
fn arrival(series: &Series, h: f64, ahead: f64) -> Option<(f64, bool)> {
    /// How far beyond the step its polynomial is used, as a multiple of the step.
    const BEYOND: f64 = 1.02;
    let bracket = Bracket::falling(0.0, if ahead > 0.0 { BEYOND * h } else { h });
    let at = newton(bracket, h, PlaceTolerance::Relative(1e-9), |at| series.velocity(at)).at;
    if at > 0.0 && at < BEYOND * h * (1.0 - 1e-9) {
        Some((at, true))
    } else if ahead > 0.0 {
        Some((0.8 * h, false))
    } else {
        None
    }
}

#[cfg(test)]
mod tests;
