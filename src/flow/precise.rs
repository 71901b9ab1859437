//! A motion to more digits than a double holds, used to measure the error of all other methods.
//!
//! The Taylor series of [`super::taylor`] in twice the working precision. Order and steps are chosen so that
//! truncation stays below rounding, and a crossing is a root of the polynomial of its step. It shares no
//! arithmetic with the methods that it judges, and takes a hundred times as long.

use super::limits::{Limits, Reason};
use super::motion::{Cost, Problem};
use super::step::{LONGEST, StepPoint};
use super::swing::time_to_blow_up;
use crate::model::parameters::rests;
use crate::model::{HalfPlane, Side};
use crate::numerics::count::real;
use crate::numerics::elementary::{exp, ln};
use crate::numerics::scaling::{exponent, times_power};
use crate::numerics::twofold::Twofold;

/// An arrival at `v = 0`, or the end of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreciseArrival {
    /// Time.
    pub tau: Twofold,
    /// Displacement.
    pub q: Twofold,
    /// Velocity.
    pub v: Twofold,
}

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PreciseEnd {
    /// At rest: the last arrival, or the start.
    Captured(PreciseArrival),
    /// Still moving at the end time.
    Moving(PreciseArrival),
    /// The velocity becomes infinite in finite time.
    Escaped {
        /// Time of the blow-up.
        tau: Twofold,
    },
}

/// A motion in twice the working precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Precise {
    /// Every arrival at `v = 0` after the start, the last one included.
    pub turns: Vec<PreciseArrival>,
    /// How it ended.
    pub end: PreciseEnd,
    /// Cost; an evaluation takes a hundred times as long as one in doubles.
    pub cost: Cost,
}

/// How finely a motion is computed: order and tolerance of the series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Order of the series, at most 32.
    pub order: usize,
    /// Size of the last term, relative to the velocity.
    pub tolerance: f64,
}

/// Truncation below rounding.
pub const FINE: Grain = Grain { order: 32, tolerance: 1e-30 };

/// Three digits fewer, with other steps: the difference between the two bounds the error of the finer one.
pub const COARSE: Grain = Grain { order: 28, tolerance: 1e-27 };

/// Maximum number of coefficients.
const MOST: usize = 33;

/// Number of trailing coefficients that determine the step.
const TAIL: usize = 4;

/// Factor on the bound of [`super::swing::time_to_blow_up`] below which the time of a blow-up is taken from its
/// asymptotic form, so that the form holds far better than a double can resolve.
const SURE: f64 = 1e-8;

const ZERO: Twofold = Twofold { high: 0.0, low: 0.0 };

/// Computes the motion of a problem, ignoring its method and tolerance.
///
/// Guarantee: the error is that of some hundred operations of relative error `1e-31`, amplified as the motion
/// itself amplifies disturbances. Compare two grains to measure it.
///
/// # Errors
/// [`Reason`] where the budget does not suffice (stiff motions) or a number leaves the range of doubles.
pub fn precise(problem: &Problem, grain: Grain, limits: &Limits) -> Result<Precise, Reason> {
    let Problem { parameters, initial, until, .. } = *problem;
    let r = parameters.r;
    let (mut tau, mut turns, mut cost) = (ZERO, Vec::new(), Cost::default());
    let mark = |tau, q, v| PreciseArrival { tau, q, v };
    let start = mark(ZERO, Twofold::of(initial.q), Twofold::of(initial.v));
    let Some(mut side) = Side::entered_from(initial, r).filter(|_| !rests(initial, r)) else {
        return Ok(Precise { turns, end: PreciseEnd::Captured(start), cost });
    };
    let mut place = (Twofold::sum(side.sign() * initial.q, r), Twofold::of(initial.v.abs()));
    loop {
        let remaining = Twofold::of(until).minus(tau);
        if remaining.high <= 0.0 {
            let last = turns.last().copied().unwrap_or(start);
            return Ok(Precise { turns, end: PreciseEnd::Moving(mark(tau, last.q, last.v)), cost });
        }
        let mut swing = PreciseSwing::new(HalfPlane::new(&parameters, side), place, grain);
        let arrival = swing.run(tau.high, remaining, &mut cost, limits)?;
        tau = tau.plus(swing.time);
        let (x, v) = swing.place();
        let sign = side.sign();
        let q = x.minus(Twofold::of(r)).times(sign);
        match arrival {
            Arrival::Escape => {
                return Ok(Precise { turns, end: PreciseEnd::Escaped { tau }, cost });
            }
            Arrival::Time => {
                let end = PreciseEnd::Moving(mark(Twofold::of(until), q, v.times(sign)));
                return Ok(Precise { turns, end, cost });
            }
            Arrival::Standstill => turns.push(mark(tau, q, ZERO)),
        }
        let clearance = x.minus(Twofold::of(2.0 * r));
        if clearance.high <= 0.0 {
            return Ok(Precise { turns, end: PreciseEnd::Captured(mark(tau, q, ZERO)), cost });
        }
        side = side.opposite();
        place = (clearance.opposite(), ZERO);
    }
}

/// The half swing from rest at `(-start, 0)`: its end and duration, or `None` where its velocity becomes infinite.
///
/// # Errors
/// Those of [`precise`].
pub fn half_swing(
    field: HalfPlane,
    start: Twofold,
    grain: Grain,
    cost: &mut Cost,
    limits: &Limits,
) -> Result<Option<(Twofold, Twofold)>, Reason> {
    /// Upper bound on the duration of any half swing that arrives.
    const PATIENCE: f64 = 1e100;
    let mut swing = PreciseSwing::new(field, (start.opposite(), ZERO), grain);
    Ok(match swing.run(0.0, Twofold::of(PATIENCE), cost, limits)? {
        Arrival::Standstill => Some((swing.place().0, swing.time)),
        Arrival::Escape | Arrival::Time => None,
    })
}

/// How a half swing ended.
enum Arrival {
    Standstill,
    Time,
    Escape,
}

/// One half swing, in units of a power of two that bring it near 1.
struct PreciseSwing {
    /// The field in the units of the problem, and in those of the half swing.
    plane: HalfPlane,
    field: HalfPlane,
    unit: i32,
    grain: Grain,
    x: [Twofold; MOST],
    v: [Twofold; MOST],
    time_exponent: i32,
    time: Twofold,
}

impl PreciseSwing {
    fn new(plane: HalfPlane, (x, v): (Twofold, Twofold), grain: Grain) -> Self {
        let unit = exponent(x.high.abs().max(v.high.abs()));
        let mut swing = PreciseSwing {
            plane,
            field: plane.in_units(unit),
            unit,
            grain,
            x: [ZERO; MOST],
            v: [ZERO; MOST],
            time_exponent: 0,
            time: ZERO,
        };
        (swing.x[0], swing.v[0]) = (scaled(x, -unit), scaled(v, -unit));
        swing
    }

    /// The point reached, in the units of the problem.
    fn place(&self) -> (Twofold, Twofold) {
        (scaled(self.x[0], self.unit), scaled(self.v[0], self.unit))
    }

    /// Steps until `v = 0`, the end of the time span, or certain escape.
    fn run(
        &mut self,
        elapsed: f64,
        longest: Twofold,
        cost: &mut Cost,
        limits: &Limits,
    ) -> Result<Arrival, Reason> {
        loop {
            if (limits.interrupted)() {
                return Err(Reason::Interrupted);
            }
            if cost.evaluations > limits.evaluations {
                return Err(Reason::Budget { evaluations: cost.evaluations });
            }
            let allowed = self.settle(cost)?;
            let remaining = longest.minus(self.time);
            let last = remaining.high <= allowed;
            let duration = if last { remaining } else { Twofold::of(allowed) };
            let (crossed, duration) = self.advance(duration, cost)?;
            self.time = self.time.plus(duration);
            if crossed {
                return Ok(Arrival::Standstill);
            }
            if last && longest.minus(self.time).high <= 0.0 {
                return Ok(Arrival::Time);
            }
            let point = StepPoint { x: self.x[0].high, v: self.v[0].high };
            let now = elapsed + self.time.high;
            if let Some(rest) = time_to_blow_up(&self.field, point, SURE * now)
                && rest <= longest.minus(self.time).high
            {
                self.time = self.time.plus(Twofold::of(rest));
                return Ok(Arrival::Escape);
            }
            if point.size() > FAR {
                let (place, time) = (self.place(), self.time);
                *self = PreciseSwing { time, ..PreciseSwing::new(self.plane, place, self.grain) };
            }
        }
    }

    /// Takes a step of at most this duration. Returns whether it ended at `v = 0`, and its length.
    fn advance(&mut self, duration: Twofold, cost: &mut Cost) -> Result<(bool, Twofold), Reason> {
        let from = self.x[0];
        let mut t = scaled(duration, -self.time_exponent);
        loop {
            if t.high == 0.0 {
                return Err(Reason::StepTooSmall { step: 0.0 });
            }
            let v = self.value(&self.v, t);
            let crossed = v.high <= 0.0;
            if crossed {
                t = self.root(t);
            }
            let x = self.value(&self.x, t);
            // A standstill lies at x >= 0, and above v = 0 the position grows; otherwise the step passed two
            // crossings.
            if (crossed && x.high >= 0.0) || (!crossed && x.minus(from).high >= 0.0) {
                (self.x[0], self.v[0]) = (x, if crossed { ZERO } else { v });
                cost.steps += 1;
                return Ok((crossed, scaled(t, self.time_exponent)));
            }
            cost.rejected += 1;
            t = t.times(0.5);
        }
    }

    /// Expands at the current point; returns the longest step that the tolerance allows.
    fn settle(&mut self, cost: &mut Cost) -> Result<f64, Reason> {
        loop {
            self.expand();
            cost.evaluations += self.grain.order as u64;
            if let Some(allowed) = self.allowed() {
                let duration = times_power(allowed, self.time_exponent).min(LONGEST);
                // With a time unit near the step length, coefficients neither overflow nor underflow.
                self.time_exponent = if (exponent(duration) - self.time_exponent).abs() > 8 {
                    let (from, to) = (self.time_exponent, exponent(duration));
                    self.change_unit(to - from);
                    to
                } else {
                    self.time_exponent
                };
                return Ok(duration);
            }
            if self.time_exponent < -1000 {
                return Err(Reason::OutOfRange);
            }
            self.time_exponent -= 20;
        }
    }

    /// Rescales the coefficients to a unit of time that is `2^shift` times the previous one.
    fn change_unit(&mut self, shift: i32) {
        let mut power = 0;
        for k in 0..=self.grain.order {
            self.x[k] = scaled(self.x[k], power);
            self.v[k] = scaled(self.v[k], power);
            power += shift;
        }
    }

    /// Fills the coefficients by the recurrence of the field.
    fn expand(&mut self) {
        let HalfPlane { d, d2, d3 } = self.field;
        let linear = self.field.is_linear();
        let mut force = [ZERO; MOST];
        for k in 0..self.grain.order {
            let mut damping = ZERO;
            if !linear {
                let square = product(&self.v, &self.v, k);
                force[k] = self.v[k].times(d2).plus(square.times(d3));
                damping = product(&force, &self.v, k);
            }
            let acceleration = self.x[k].plus(self.v[k].times(2.0 * d)).plus(damping).opposite();
            let divisor = Twofold::of(real(k + 1));
            self.x[k + 1] = scaled(self.v[k], self.time_exponent).over(divisor);
            self.v[k + 1] = scaled(acceleration, self.time_exponent).over(divisor);
        }
    }

    /// The longest step in units of the coefficients, or `None` where they overflow.
    fn allowed(&self) -> Option<f64> {
        let order = self.grain.order;
        let mut steps = [f64::INFINITY; 2];
        let size = self.v[0].high.abs();
        let slope = self.v[1].high.abs();
        for k in order + 1 - TAIL..=order {
            let coefficient = self.v[k].high.abs();
            if !coefficient.is_finite() {
                return None;
            }
            let power = real(k);
            let part = |scale: f64| ln(scale / coefficient * self.grain.tolerance);
            steps[0] = steps[0].min(part(size) / power);
            steps[1] = steps[1].min(part(slope) / (power - 1.0));
        }
        Some(exp(steps[0].max(steps[1]).min(600.0))).filter(|step| *step > 0.0)
    }

    /// The value of a series at `t`.
    fn value(&self, coefficients: &[Twofold; MOST], t: Twofold) -> Twofold {
        let terms = coefficients[..=self.grain.order].iter().rev();
        terms.fold(ZERO, |sum, coefficient| sum.by(t).plus(*coefficient))
    }

    /// First root of v in `(0, end]`: Newton's method in a bracket.
    fn root(&self, end: Twofold) -> Twofold {
        /// After a Newton step of this relative length the error, its square, is below rounding.
        const SETTLED: f64 = 1e-17;
        let (mut low, mut high, mut t) = (ZERO, end, end);
        for _ in 0..300 {
            let (mut value, mut slope) = (ZERO, ZERO);
            for coefficient in self.v[..=self.grain.order].iter().rev() {
                slope = slope.by(t).plus(value);
                value = value.by(t).plus(*coefficient);
            }
            let change = value.over(slope);
            let newton = t.minus(change);
            if change.high.abs() <= SETTLED * t.high {
                return newton;
            }
            if value.high > 0.0 {
                low = t;
            } else {
                high = t;
            }
            let inside = newton.minus(low).high > 0.0 && high.minus(newton).high > 0.0;
            t = if inside { newton } else { low.plus(high).times(0.5) };
        }
        t
    }
}

/// Size at which the unit is chosen anew.
const FAR: f64 = 1e60;

/// A number times a power of two.
fn scaled(number: Twofold, power: i32) -> Twofold {
    Twofold { high: times_power(number.high, power), low: times_power(number.low, power) }
}

/// Coefficient k of the product of two series.
fn product(a: &[Twofold; MOST], b: &[Twofold; MOST], k: usize) -> Twofold {
    (0..=k).fold(ZERO, |sum, i| sum.plus(a[i].by(b[k - i])))
}

#[cfg(test)]
mod tests;
