//! The certified half swing: from `(x, v)`, `v >= 0`, to the next `v = 0`, or the proof that there is none.

use std::convert::Infallible;

use super::ball::MOST_STEPS;
use super::{Ahead, Ball, FieldBox, INFLATE, StartBox, StepEnd, UNIT, never_returns, scaled};
use crate::numerics::{Bracket, Interval, PlaceTolerance, illinois, newton, powi};

/// A half swing that arrives at `v = 0`; each interval holds the values of all starts and fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvedSwing {
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
    /// Steps taken.
    pub steps: u32,
}

/// What is certain about a half swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passage {
    /// Every motion arrives at `v = 0`.
    Arrives(ProvedSwing),
    /// No motion arrives: the velocity never falls again.
    Never,
    /// Every motion becomes faster than the ceiling; the swing ends where that is certain.
    Exceeds(ProvedSwing),
    /// Nothing is certain.
    Unknown,
}

impl ProvedSwing {
    /// The integral of `v^2` in units of `2^(2 unit)`.
    pub fn square_in(&self, unit: i32) -> Interval {
        let k = self.unit - unit;
        scaled(scaled(self.square, k), k)
    }

    /// The same swing with lengths multiplied by `2^k`.
    pub fn times_power(self, k: i32) -> Self {
        let fastest = self.fastest.map(|it| scaled(it, k));
        let [end, speed] = [self.end, self.speed].map(|it| scaled(it, k));
        ProvedSwing { end, speed, unit: self.unit + k, fastest, ..self }
    }
}

impl Passage {
    /// The swing, if it certainly arrives.
    pub fn arrived(self) -> Option<ProvedSwing> {
        if let Passage::Arrives(swing) = self {
            Some(swing)
        } else {
            None
        }
    }
}

/// Computes a half swing of every field in `field` from every point of `start`.
///
/// Guarantee: the bounds hold for the exact motions, whatever the rounding. The result is `Unknown` where there
/// are no bounds: for a stiff or a wide motion, or one that arrives within its own error of the centre.
pub fn swing(field: &FieldBox, start: &StartBox) -> Passage {
    swing_below(field, start, f64::INFINITY, false)
}

/// As [`swing`], but stops as soon as every motion is certainly faster than `ceiling`; where the largest velocity is
/// wanted, only after that was reached.
pub fn swing_below(
    field: &FieldBox,
    start: &StartBox,
    ceiling: f64,
    wants_fastest: bool,
) -> Passage {
    if start.v.lower() == 0.0 && (start.v.upper() > 0.0 || start.x.upper() >= 0.0) {
        return Passage::Unknown;
    }
    let Some(ball) = Ball::new(field, start) else { return Passage::Unknown };
    let [x, v, ceiling] =
        [start.x, start.v, Interval::point(ceiling)].map(|it| scaled(it, -ball.unit));
    if never_returns(&ball.local.field, x.upper(), v.lower()) {
        return Passage::Never;
    }
    let mut run = SwingRun {
        start: x,
        ball,
        square: 0.0,
        square_error: 0.0,
        wants_fastest,
        fastest: None,
        ceiling: ceiling.upper(),
        steps: 0,
    };
    run.passage().unwrap_or(Passage::Unknown)
}

/// A half swing in progress.
struct SwingRun {
    /// Position at its start.
    start: Interval,
    ball: Ball,
    square: f64,
    square_error: f64,
    /// Whether the largest velocity is requested, and that velocity once it was reached.
    wants_fastest: bool,
    fastest: Option<Interval>,
    /// Velocity above which the computation stops.
    ceiling: f64,
    /// Steps taken.
    steps: u32,
}

impl SwingRun {
    /// Takes steps until the swing ends; `None` where nothing is certain about it.
    fn passage(&mut self) -> Option<Passage> {
        while self.steps < MOST_STEPS {
            self.steps += 1;
            let ball = &mut self.ball;
            let (mut ahead, mut last) = (ball.prepare(f64::INFINITY)?, false);
            if !(ahead.1.1 > 4.0 * ball.norm.stretch * ball.radius) {
                (ahead, last) = arrival(ball, ahead)?;
            }
            let (h, reached) = ball.reach(ahead)?;
            let last = last && h == ahead.0;
            if self.wants_fastest && self.fastest.is_none() {
                self.turn_of_speed(h, &reached)?;
            }
            self.square += reached.square;
            self.square_error += reached.square_error + UNIT * self.square;
            self.ball.advance(h, &reached);
            let ball = &self.ball;
            let (off, field) = (ball.off(), ball.local.field);
            if last {
                return self.arrive(off).map(Passage::Arrives);
            }
            // The sign of v at the end of a step must be certain.
            if !(ball.v > off) {
                return None;
            }
            if ball.v - off > self.ceiling && (!self.wants_fastest || self.fastest.is_some()) {
                return self.finish(ball.state(), 0.0).map(Passage::Exceeds);
            }
            if never_returns(&field, (ball.x + off).next_up(), (ball.v - off).next_down()) {
                return Some(Passage::Never);
            }
        }
        None
    }

    /// The arrival at `v = 0` near the end of the last step (lemma 6).
    ///
    /// There `abs(v) <= most`, and as long as this holds, v falls at a rate of at least
    /// `x - most (abs(a) + ..)`. The time of arrival is therefore within `most/rate`, and the position within
    /// `most` times that.
    fn arrive(&self, off: f64) -> Option<ProvedSwing> {
        let most = (self.ball.v.abs() + off) * INFLATE;
        let x = Interval::around(self.ball.x, off);
        let field = self.ball.local.field;
        let speed = Interval::new(-most, most);
        // Whether the motion continues or is followed back, x only grows.
        let rate = Interval::point(x.lower()) - field.force(speed).magnitude();
        let lag = (Interval::point(most) / rate.lower()).upper();
        let along = (Interval::point(most) * lag).upper();
        let end = Interval::new(x.lower(), (Interval::point(x.upper()) + along).upper());
        if !(rate > 0.0 && end > 0.0) {
            return None;
        }
        self.finish((end, Interval::point(0.0)), lag)
    }

    /// Notes the largest velocity if it is reached within this step; `None` where its bounds are not certain enough.
    ///
    /// Where the acceleration vanishes its derivative is `-v < 0`, so there is one such moment in a half swing.
    /// Near it, with acceleration at most `d` in magnitude at velocity v, the remaining rise is at most
    /// `d^2/(v - d f)`, where f bounds the slope of the damping.
    fn turn_of_speed(&mut self, h: f64, end: &StepEnd) -> Option<()> {
        /// An error in the moment costs only its square.
        const NEAR: f64 = 1e-10;
        let (ball, field) = (&self.ball, self.ball.local.field);
        let [x, v] = [end.x, end.v].map(Interval::point);
        if field.acceleration(x, v).middle() > 0.0 {
            return Some(());
        }
        let acceleration = |at: f64| ball.series.velocity(at).1;
        let ends = [0.0, h].map(|at| (at, acceleration(at)));
        let Ok([near, _]) = illinois(ends, 0.0, PlaceTolerance::Absolute(NEAR * h), |at| {
            Ok::<_, Infallible>(acceleration(at))
        });
        let near = ball.carried((near.0, ball.series.at(near.0)))?;
        let (x, v) = ball.around(near.x, near.v, near.radius);
        let unbalanced = Interval::point(field.acceleration(x, v).magnitude());
        let cap = v.upper() * 1.01;
        let slope = field.slope(Interval::new(v.lower(), cap)).magnitude();
        let bend = Interval::point(v.lower()) - unbalanced * slope;
        if !(bend > 0.0) {
            return None;
        }
        let rise = (unbalanced.square() / bend).upper();
        let top = (Interval::point(v.upper()) + rise).upper();
        self.fastest = (top <= cap).then_some(Interval::new(v.lower(), top));
        self.fastest.map(|_| ())
    }

    /// The swing to its end, which is at most `lag` away from that of the last step, in the units of the question.
    fn finish(&self, (end, velocity): (Interval, Interval), lag: f64) -> Option<ProvedSwing> {
        let ball = &self.ball;
        let duration = ball.elapsed(lag);
        // Beyond the end of the step v stays below its bound there, whose square times the lag bounds the integral.
        let beyond = lag * powi(ball.v.abs() + ball.off(), 2);
        let square = Interval::around(self.square, (self.square_error + beyond) * INFLATE);
        let divergence = -ball.local.field.integrated_slope(duration, end - self.start, square);
        let known = duration.is_finite() && divergence.is_finite() && duration > 0.0;
        let length = |it| scaled(it, ball.unit);
        known.then(|| ProvedSwing {
            end: length(end),
            speed: length(velocity),
            duration,
            divergence,
            square,
            unit: ball.unit,
            fastest: self.fastest.map(length),
            steps: self.steps,
        })
    }
}

/// Where the polynomial of v vanishes at or just beyond `h`, by Newton's method inside a bracket; otherwise a
/// shorter step. The flag tells which. No bound depends on the accuracy of the root.
fn arrival(ball: &Ball, (h, (_, ahead)): Ahead) -> Option<(Ahead, bool)> {
    /// How far beyond the step its polynomial is used, as a multiple of the step.
    const BEYOND: f64 = 1.02;
    let series = &ball.series;
    let bracket = Bracket::falling(0.0, if ahead > 0.0 { BEYOND * h } else { h });
    let at = newton(bracket, h, PlaceTolerance::Relative(1e-9), |at| series.velocity(at));
    let to = |h: f64| (h, series.at(h));
    if at > 0.0 && at < BEYOND * h * (1.0 - 1e-9) {
        Some((to(at), true))
    } else if ahead > 0.0 {
        Some((to(0.8 * h), false))
    } else {
        None
    }
}
