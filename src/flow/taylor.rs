//! Taylor series of the polynomial field; crossings are roots of the polynomial of their step.
//!
//! The field of a half plane is a cubic polynomial in `v`, so the coefficients of the solution obey a
//! recurrence of two Cauchy products. The radius of convergence rho is estimated from the last few
//! coefficients. With order N and tolerance e, the step `h = rho e^(1/N)` makes the last term about e times the
//! size of the state (Jorba and Zou, *A software package for the numerical integration of ODEs by means of
//! high-order Taylor methods*, Experimental Mathematics 14 (2005), section 3.2). Assumption: the last four
//! terms of the series have reached its asymptotic behaviour. Then the truncation error of a step is about
//! `e h/(rho - h)` of the state.

use super::{Cost, LONGEST, Powers, Step, StepPoint, Stepper, powers_over};
use crate::model::{HalfPlane, Reason, Result};
use crate::numerics::{
    Bracket, PlaceTolerance, Scalar, exponent, newton, real, rough_exp2, rough_log2, times_power,
    value_and_slope_in_two as value_and_slope, value_in_two as value,
};

/// Highest order.
const MOST: usize = 32;

/// Length of a coefficient array, at least `MOST + 1`.
const LENGTH: usize = 34;

/// The last term of a step is kept below the tolerance by this factor, so that the accumulated error of some
/// dozens of steps still stays near the tolerance.
const AIM: f64 = 0.125;

/// Number of trailing coefficients that determine the step length.
const TAIL: usize = 4;

/// Order for each tolerance: the largest bound not above the tolerance decides. The orders minimise the time
/// measured by the benchmark `flow` at these tolerances.
const ORDERS: [(f64, usize); 10] = [
    (1e-2, 8),
    (1e-3, 10),
    (1e-5, 12),
    (1e-6, 14),
    (1e-7, 16),
    (1e-9, 18),
    (1e-12, 20),
    (1e-13, 22),
    (1e-15, 24),
    (0.0, 26),
];

/// The Taylor stepper, in doubles or in numbers of twice the precision.
#[derive(Clone, Debug)]
pub struct Taylor<N = f64> {
    field: HalfPlane,
    order: usize,
    /// `log2` of the tolerance of a step.
    log_tolerance: f64,
    /// Coefficients of x and v in powers of `t / 2^time_exponent`.
    x: [N; LENGTH],
    v: [N; LENGTH],
    /// Coefficients of the integral of `v^2`; maintained only where the field is not linear.
    square_integral: [N; LENGTH],
    inner: InnerCoefficients<N>,
    time_exponent: i32,
    /// Unit of time for the next step, near the length of the last one.
    next_time_exponent: i32,
    duration: f64,
    cost: Cost,
}

impl<N: Scalar> Taylor<N> {
    /// A stepper with a relative truncation error per step of about `tolerance`.
    pub fn new(tolerance: f64) -> Self {
        let order = ORDERS.iter().find(|row| tolerance >= row.0).map_or(MOST, |row| row.1);
        Self::with_order(tolerance, order)
    }

    /// As [`Taylor::new`], with a given order of at most 32.
    pub fn with_order(tolerance: f64, order: usize) -> Self {
        Taylor {
            field: HalfPlane::default(),
            order: order.clamp(4, MOST),
            log_tolerance: rough_log2((AIM * tolerance).max(1e-300)),
            x: [N::default(); LENGTH],
            v: [N::default(); LENGTH],
            square_integral: [N::default(); LENGTH],
            inner: InnerCoefficients::empty(),
            time_exponent: 0,
            next_time_exponent: 0,
            duration: 0.0,
            cost: Cost::default(),
        }
    }

    pub fn order(&self) -> f64 {
        real(self.order)
    }

    /// Fills the coefficient arrays at a point.
    ///
    /// With `force = D2 v + D3 v^2`, coefficient k of the damping is a sum over products of earlier
    /// coefficients. The newest two enter it linearly and are kept in registers, so that each coefficient waits
    /// for only one product of its predecessor. The sums over the others run over memory written at least two
    /// iterations ago.
    fn expand(&mut self, from: StepPoint<N>) {
        let [d, d2, d3] = [2.0 * self.field.d, self.field.d2, self.field.d3].map(N::from);
        let two = N::from(2.0);
        let unit = N::from(times_power(1.0, self.time_exponent));
        let order = self.order.min(MOST);
        self.cost.evaluations += order as u64;
        let v0 = from.v;
        let force0 = v0 * (d2 + d3 * v0);
        let v1 = unit * (-from.x - v0 * (d + force0));
        (self.x[0], self.x[1]) = (from.x, unit * v0);
        (self.v[0], self.v[1]) = (v0, v1);
        let mut newest = v1;
        if self.field.is_linear() {
            for k in 1..order {
                let factor = unit.over_count(k + 1);
                let acceleration = -self.x[k] - d * newest;
                self.x[k + 1] = newest * factor;
                newest = acceleration * factor;
                self.v[k + 1] = newest;
            }
            return;
        }
        // With `square_k = sum of v_i v_(k-i)` over 0 < i < k, coefficient k of v^2 is `2 v0 v_k + square_k`
        // and that of the force is `slope v_k + d3 square_k`. The damping contains
        // `damping v_k + neighbour v_(k-1)` besides terms in earlier coefficients only.
        let slope = d2 + two * d3 * v0;
        let damping = d + force0 + v0 * slope;
        let (cubic, cubic1) = (d3 * v0, d3 * v1);
        let (twice0, twice1) = (two * v0, two * v1);
        let neighbour = twice1 * (slope + cubic);
        self.square_integral[1] = unit * v0 * v0;
        let zero = N::default();
        let (mut before, mut force_before, mut square_before) = (zero, zero, zero);
        for k in 1..order {
            let (inner, product) = if k < 4 { (zero, zero) } else { self.inner.sums(k) };
            let earlier = cubic * inner + (cubic1 * square_before + product);
            // In `square_2` and its product, v1 is paired with itself, so it counts once instead of twice.
            let next = if k == 2 { N::from(0.5) * before } else { before };
            let acceleration = -(self.x[k] + (neighbour * next + earlier)) - damping * newest;
            let square = twice1 * next + inner;
            let force = slope * newest + d3 * square;
            self.inner.keep(k, [before, newest], [force_before, force]);
            let factor = unit.over_count(k + 1);
            self.square_integral[k + 1] = (twice0 * newest + square) * factor;
            self.x[k + 1] = newest * factor;
            (before, force_before, square_before) = (newest, force, square);
            newest = acceleration * factor;
            self.v[k + 1] = newest;
        }
    }

    /// The step length for this tolerance, or `None` where coefficients overflowed.
    ///
    /// The error of v is relative to the velocities of the step, the larger of `abs(v_0)` and `abs(v_1) h`: far
    /// out they are much smaller than the position. The radius of convergence is the least of the estimates
    /// `(size / abs(v_k))^(1/k)` from the last [`TAIL`] coefficients. Near a turning point every other
    /// coefficient almost vanishes, and those of a pair of complex poles pass through zero now and then, so
    /// fewer would sometimes miss the trend.
    fn allowed(&self) -> Option<f64> {
        let log2 = |size: f64| {
            if size == 0.0 {
                f64::NEG_INFINITY
            } else {
                rough_log2(size)
            }
        };
        let (size, slope) = (log2(self.v[0].value().abs()), log2(self.v[1].value().abs()));
        let (mut by_size, mut by_slope) = (f64::INFINITY, f64::INFINITY);
        for k in self.order + 1 - TAIL..=self.order {
            let coefficient = self.v[k].value().abs();
            if !coefficient.is_finite() {
                return None;
            }
            if coefficient > 0.0 {
                let coefficient = rough_log2(coefficient);
                by_size = by_size.min((size - coefficient).over_count(k));
                by_slope = by_slope.min((slope - coefficient).over_count(k - 1));
            }
        }
        by_size += self.log_tolerance.over_count(self.order);
        by_slope += self.log_tolerance.over_count(self.order - 1);
        Some(rough_exp2(by_size.max(by_slope).min(60.0)))
    }

    /// First root of v in `(0, end]`, in units of the coefficients, given `v(end) <= 0`.
    ///
    /// Newton's method on the polynomial, from the root of the parabola through both ends with the initial
    /// slope. `v > 0` just after 0 is known from the side entered, whatever `v(0)` is.
    fn root(&self, end: N, v_end: N) -> N {
        const SETTLED: PlaceTolerance = PlaceTolerance::Relative(1e-9);
        let (end, v_end) = (end.value(), v_end.value());
        let (v, slope) = (self.v[0].value(), self.v[1].value());
        let bend = ((v_end - v) / end - slope) / end;
        let span = (slope * slope - 4.0 * bend * v).sqrt();
        let guess = if slope > 0.0 {
            (slope + span) / (-2.0 * bend)
        } else {
            2.0 * v / (span - slope)
        };
        let start = if guess > 0.0 && guess < end { guess } else { end };
        let rounded = self.v.map(N::value);
        let v = |t: f64| value_and_slope(&rounded[..=self.order], t);
        let root = N::from(newton(Bracket::falling(0.0, end), start, SETTLED, v));
        (0..N::POLISHING).fold(root, |root, _| {
            let (v, slope) = value_and_slope(&self.v[..=self.order], root);
            root - v / slope
        })
    }

    /// Expands at a point; returns the step length that the tolerance allows, at most `longest`, in units of the
    /// coefficients.
    fn settle(&mut self, from: StepPoint<N>, longest: N, bound: f64) -> Result<N> {
        /// Length of a step, in units of time as a power of two, up to which no coefficient underflows.
        const WIDE: i32 = 32;
        self.time_exponent = self.next_time_exponent;
        loop {
            self.expand(from);
            if let Some(allowed) = self.allowed() {
                let longest = longest.times_power(-self.time_exponent);
                let allowed = allowed.min(times_power(bound, -self.time_exponent));
                let is_wide = allowed.min(longest.value()) > times_power(1.0, WIDE);
                // Coefficients that underflow tell nothing: use a larger unit, unless all is at rest.
                if is_wide && self.v[1] != N::default() && self.time_exponent < 1000 {
                    self.time_exponent += WIDE;
                    continue;
                }
                let allowed = N::from(allowed);
                return Ok(if longest < allowed { longest } else { allowed });
            }
            // Coefficients that overflow belong to a time scale far below 1: use a smaller unit.
            if self.time_exponent < -1000 {
                return Err(Reason::OutOfRange);
            }
            self.time_exponent -= 40;
            self.inner = InnerCoefficients::empty();
        }
    }
}

impl Taylor {
    /// The integral of `v^2` over the last step, from its series; nonlinear fields only.
    pub fn square_integral(&self) -> f64 {
        let t = times_power(self.duration, -self.time_exponent);
        value(&self.square_integral[..=self.order], t)
    }

    /// The coefficients of the velocity along the last step, in powers of the time over a unit; and that unit.
    pub fn velocity(&self) -> (&[f64], f64) {
        (&self.v[..=self.order], times_power(1.0, self.time_exponent))
    }
}

/// The coefficients from the second on, laid out for sums of products whose indices add up to k.
///
/// Each is stored in a pair with its neighbour and read as it was written: a processor forwards what it has
/// just stored at once, but not if it is read together with other memory.
#[derive(Clone, Debug)]
struct InnerCoefficients<N> {
    /// Element i holds coefficients i and i + 1, of v and of the force.
    v: [[N; 2]; LENGTH],
    force: [[N; 2]; LENGTH],
    /// Element i holds coefficients i and i - 1 of v; zero replaces coefficient 1 to end a sum.
    reversed: [[N; 2]; LENGTH],
}

impl<N: Scalar> InnerCoefficients<N> {
    fn empty() -> Self {
        let zeros = [[N::default(); 2]; LENGTH];
        InnerCoefficients { v: zeros, force: zeros, reversed: zeros }
    }

    /// Stores coefficients `k - 1` and k.
    fn keep(&mut self, k: usize, v: [N; 2], force: [N; 2]) {
        (self.v[k - 1], self.force[k - 1]) = (v, force);
        self.reversed[k] = [v[1], if k > 2 { v[0] } else { N::default() }];
    }

    /// The sums over `2 <= i <= k - 2` of `v_i v_(k-i)` and of `force_i v_(k-i)`.
    fn sums(&self, k: usize) -> (N, N) {
        let pairs = (k - 2) / 2;
        let (mut squares, mut products) = ([N::default(); 2], [N::default(); 2]);
        for pair in 0..pairs {
            let (i, partner) = (2 + 2 * pair, self.reversed[k - 2 - 2 * pair]);
            for lane in 0..2 {
                squares[lane] = squares[lane] + self.v[i][lane] * partner[lane];
                products[lane] = products[lane] + self.force[i][lane] * partner[lane];
            }
        }
        (squares[0] + squares[1], products[0] + products[1])
    }
}

impl<N: Scalar> Stepper<HalfPlane, N> for Taylor<N> {
    fn begin(&mut self, field: &HalfPlane) {
        self.field = *field;
    }

    fn advance(&mut self, from: StepPoint<N>, longest: N, arrives: bool) -> Result<Step<N>> {
        let bound = if arrives { LONGEST } else { f64::INFINITY };
        let mut scaled = self.settle(from, longest, bound)?;
        let order = self.order;
        loop {
            let duration = scaled.times_power(self.time_exponent);
            if duration == N::default() {
                return Err(Reason::StepTooSmall { step: 0.0 });
            }
            let v = value(&self.v[..=order], scaled);
            if arrives && v <= N::default() {
                let root = self.root(scaled, v);
                let end = StepPoint { x: value(&self.x[..=order], root), v: N::default() };
                let duration = root.times_power(self.time_exponent);
                let step = Step { duration, end, crossed: true };
                if step.is_possible() {
                    self.duration = duration.value();
                    return Ok(step);
                }
                scaled = root;
            } else {
                let x = value(&self.x[..=order], scaled);
                // Above v = 0 the position grows; if it did not, the step passed two crossings.
                if !arrives || x >= from.x {
                    self.duration = duration.value();
                    // Keep the unit of time near the step length, so that coefficients neither overflow nor underflow.
                    let drift = exponent(self.duration);
                    if (drift - self.time_exponent).abs() > 20 {
                        self.next_time_exponent = drift;
                    }
                    return Ok(Step { duration, end: StepPoint { x, v }, crossed: false });
                }
            }
            self.cost.rejected += 1;
            scaled = scaled.times_power(-1);
        }
    }

    fn at(&self, time: f64) -> StepPoint {
        let (order, t) = (self.order, N::from(times_power(time, -self.time_exponent)));
        let [x, v] = [&self.x, &self.v].map(|series| value(&series[..=order], t));
        StepPoint { x, v }.rounded()
    }

    fn powers(&self) -> Powers {
        powers_over(self.duration, 1, |time| self.at(time).v)
    }

    fn cost(&self) -> Cost {
        self.cost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In the unit of a much faster motion before, all late coefficients underflow; in that of a slower one they
    /// overflow.
    #[test]
    fn a_step_does_not_depend_on_the_time_scale_of_the_motion_before() {
        let from = StepPoint { x: -1.0, v: 0.0 };
        let step = |left: i32| {
            let mut stepper = Taylor::<f64>::new(1e-16);
            stepper.begin(&HalfPlane { d: -0.1, d2: 0.3, d3: 0.5 });
            stepper.next_time_exponent = left;
            stepper.advance(from, f64::INFINITY, true).unwrap().duration
        };
        for left in [-900, -203, -63, -45, 30, 63, 203] {
            let part = step(left) / step(0);
            assert!((0.9..1.1).contains(&part), "2^{left}: {part}");
        }
    }
}
