//! A motion with its derivatives with respect to all numbers on which it depends, half swing by half swing.
//!
//! A half swing from `(x, v)` ends at `(X, 0)` after T; friction enters only where this end becomes the next start
//! `x = 2 r - X`. So derivatives are chained from one half swing to the next without a jump matrix: with
//! `dX` and `dT` of the half swing, `dx = 2 dr - dX` and `dtau` grows by `dT = -dv/f`. This equals the result of a
//! saltation matrix at `v = 0`, and it is never singular: a moving mass always stops with `f = -X < 0`.
//! Inside a half swing a later start only delays the motion: `dq` contains `-v dtau`.
//!
//! Along with the motion `x' = v, v' = f(x, v)` in the frame of its half plane ([`HalfPlane`]), four solutions of the
//! variational equation `y' = w, w' = -y + (df/dv) w + g` are computed: a homogeneous one that starts across the flow, and
//! those for D, D2 and D3 with `g = -2 v, -v^2, -v^3`. Their Taylor coefficients follow from those of the motion.

use nalgebra::Vector4;

use super::{D, D2, D3, LAST, Q0, R, Signal, Unknowns, direction};
use crate::flow::{StepPoint, Stepper, Taylor};
use crate::model::{Field, HalfPlane, Parameters, Side, State};
use crate::numerics::{hypot, real};

/// Order of the Taylor series.
const ORDER: usize = 18;

/// Relative truncation error of a step, as [`Taylor`] understands it.
const TOLERANCE: f64 = 1e-13;

/// Solutions of the variational equation: across the flow, and by D, D2 (in the frame of the half plane) and D3.
type Ways = Vector4<f64>;

/// Maximum number of half swings of one motion.
const MOST: usize = 100_000;

/// Maximum number of steps in one half swing, a hundred times what any recorded motion takes.
const STEPS: u32 = 5_000;

/// A point of a motion.
#[derive(Clone, Copy, Debug, Default)]
pub struct MotionPoint {
    /// Displacement.
    pub q: f64,
    /// Velocity.
    pub v: f64,
    /// The signal: displacement, velocity or acceleration.
    pub signal: f64,
    /// Its derivative by the time.
    pub rate: f64,
    /// Its derivatives at a fixed time.
    pub by: Unknowns,
}

impl MotionPoint {
    /// A mass at rest.
    pub fn resting(q: f64, by: Unknowns, signal: Signal) -> Self {
        let point = MotionPoint { q, ..MotionPoint::default() };
        if signal.is_displacement() {
            MotionPoint { signal: q, by, ..point }
        } else {
            point
        }
    }
}

/// A turning point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FittedTurn {
    /// Dimensionless time.
    pub tau: f64,
    /// Displacement.
    pub q: f64,
    /// Derivatives of the time.
    pub tau_by: Unknowns,
    /// Derivatives of the displacement.
    pub q_by: Unknowns,
}

/// The turning points of a motion, as far as it was followed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FollowedMotion {
    /// Every arrival at `v = 0` within the time, including the one that is captured.
    pub turns: Vec<FittedTurn>,
    /// Whether the mass comes to rest: at the last turn or, without turns, from the start.
    pub rests: bool,
}

/// How a motion is followed.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// Whether derivatives are wanted.
    pub with_derivatives: bool,
    /// Displacement or velocity beyond which a motion counts as lost.
    pub reach: f64,
    /// Maximum number of turning points; no points are computed after that.
    pub turns: usize,
    /// What is measured.
    pub signal: Signal,
}

impl Default for Way {
    /// Every displacement, without derivatives.
    fn default() -> Self {
        let (reach, turns, signal) = (f64::MAX, usize::MAX, Signal::Displacement);
        Way { with_derivatives: false, reach, turns, signal }
    }
}

/// The motion grew beyond its reach, or took too many half swings or steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LostMotion;

/// Follows the motion from `start` through the ascending `times` and passes each point to `see`.
///
/// # Errors
/// [`LostMotion`] if the motion escapes before the last time.
pub fn follow(
    parameters: &Parameters,
    start: State,
    times: &[f64],
    way: Way,
    mut see: impl FnMut(usize, MotionPoint),
) -> Result<FollowedMotion, LostMotion> {
    let mut followed = FollowedMotion::default();
    let mut stepper = Taylor::with_order(TOLERANCE, ORDER);
    let mut next = 0;
    let mut swing = FittedSwing::first(parameters, start);
    let mut rest = MotionPoint::resting(start.q, direction(Q0), way.signal);
    for _ in 0..MOST {
        let Some(moving) = swing else {
            (next..times.len()).for_each(|index| see(index, rest));
            followed.rests = true;
            return Ok(followed);
        };
        if next >= times.len() || followed.turns.len() >= way.turns {
            return Ok(followed);
        }
        let Some(turn) = moving.follow(&mut stepper, times, &mut next, way, &mut see)? else {
            return Ok(followed);
        };
        followed.turns.push(turn);
        rest = MotionPoint::resting(turn.q, turn.q_by, way.signal);
        swing = moving.after(parameters, &turn);
    }
    Err(LostMotion)
}

/// A point of a half swing with its derivatives.
#[derive(Clone, Copy, Debug)]
struct Jet {
    at: StepPoint,
    /// Derivatives of the position.
    y: Ways,
    /// Derivatives of the velocity.
    w: Ways,
}

/// A half swing: its start, with the derivatives of the start.
struct FittedSwing {
    side: Side,
    r: f64,
    field: HalfPlane,
    start: Jet,
    tau: f64,
    /// Derivatives of the start in the direction that the jet takes, for each number.
    across: Unknowns,
    /// Derivatives of the time of the start, for each number.
    tau_by: Unknowns,
}

impl FittedSwing {
    /// The half swing of a motion from `start`; `None` if it rests there. A shift of the start along the flow only
    /// delays the motion; the rest of it is across.
    fn first(parameters: &Parameters, start: State) -> Option<Self> {
        let side = Side::entered_from(start, parameters.r)?;
        let mut swing = Self::new(parameters, side, start.q);
        // A velocity of -0 would stand for a motion that has just arrived.
        let Jet { at: StepPoint { x, v }, y, w } = &mut swing.start;
        *v = start.v.abs();
        let force = swing.field.acceleration(*x, *v);
        let norm = hypot(*v, force);
        let (ux, uv) = (*v / norm, force / norm);
        (y[0], w[0]) = (-uv, ux);
        let sign = side.sign();
        for (number, dx, dv) in [(R, 1.0, 0.0), (Q0, sign, 0.0), (LAST, 0.0, sign)] {
            swing.across[number] = ux * dv - uv * dx;
            swing.tau_by[number] = -(ux * dx + uv * dv) / norm;
        }
        Some(swing)
    }

    /// The half swing that follows this one after its turn; `None` if the mass rests there.
    fn after(&self, parameters: &Parameters, turn: &FittedTurn) -> Option<Self> {
        let side = self.side.opposite();
        let mut swing = Self::new(parameters, side, turn.q);
        swing.across = side.sign() * turn.q_by + direction(R);
        (swing.tau, swing.tau_by) = (turn.tau, turn.tau_by);
        (swing.start.at.x < 0.0).then_some(swing)
    }

    /// The half swing from a displacement at time 0, without velocity.
    fn new(parameters: &Parameters, side: Side, q: f64) -> Self {
        let r = parameters.r;
        let at = StepPoint { x: side.position(q, r), v: 0.0 };
        let start = Jet { at, y: Ways::x(), w: Ways::zeros() };
        let [across, tau_by] = [Unknowns::zeros(); 2];
        let field = HalfPlane::new(parameters, side);
        FittedSwing { side, r, field, start, tau: 0.0, across, tau_by }
    }

    /// The derivatives with respect to all numbers from the solutions of the variational equation.
    #[inline]
    fn combined(&self, ways: &Ways) -> Unknowns {
        let [across, d, d2, d3] = (*ways).into();
        let mut by = across * self.across;
        by[D] += d;
        by[D2] += self.side.sign() * d2;
        by[D3] += d3;
        by
    }

    /// Passes the points at the times within this half swing to `see`; returns the turn that ends it, if it comes
    /// before the last time.
    fn follow(
        &self,
        stepper: &mut Taylor,
        times: &[f64],
        next: &mut usize,
        way: Way,
        see: &mut impl FnMut(usize, MotionPoint),
    ) -> Result<Option<FittedTurn>, LostMotion> {
        let Way { with_derivatives, reach, signal, .. } = way;
        let (mut start, mut from) = (self.start, self.tau);
        let mut derivatives = Sensitivities::default();
        stepper.begin(&self.field);
        for _ in 0..STEPS {
            let step = stepper.advance(start.at, f64::INFINITY, true).map_err(|_| LostMotion)?;
            if with_derivatives {
                derivatives.expand(&self.field, &start, stepper.velocity());
            }
            let until = from + step.duration;
            while let Some(&time) = times.get(*next)
                && time <= until
            {
                let (t, mut jet) = (time - from, start);
                jet.at = stepper.at(t);
                if with_derivatives {
                    jet.y = derivatives.of_position(t);
                    if !signal.is_displacement() {
                        jet.w = derivatives.of_velocity(t);
                    }
                }
                see(*next, self.point(&jet, way));
                *next += 1;
            }
            if *next >= times.len() {
                return Ok(None);
            }
            start.at = step.end;
            if with_derivatives {
                start.y = derivatives.of_position(step.duration);
                start.w = derivatives.of_velocity(step.duration);
            }
            if step.crossed {
                return Ok(Some(self.turn(until, &start)));
            }
            // A motion that escapes, or whose steps no longer advance the time, never ends.
            if !(start.at.size() <= reach && until > from) {
                return Err(LostMotion);
            }
            from = until;
        }
        Err(LostMotion)
    }

    /// A point of the motion. The derivatives of the acceleration follow from the equation of motion.
    fn point(&self, jet: &Jet, way: Way) -> MotionPoint {
        let (sign, StepPoint { x, v }) = (self.side.sign(), jet.at);
        let force = self.field.acceleration(x, v);
        let slope = self.field.divergence(v);
        let (signal, rate) = match way.signal {
            Signal::Displacement => (x - self.r, v),
            Signal::Velocity => (v, force),
            Signal::Acceleration => (force, slope * force - v),
        };
        let mut by = Unknowns::zeros();
        if way.with_derivatives {
            by = match way.signal {
                Signal::Displacement => self.combined(&jet.y) - direction(R),
                Signal::Velocity => self.combined(&jet.w),
                Signal::Acceleration => {
                    let mut by = slope * self.combined(&jet.w) - self.combined(&jet.y);
                    by[D] -= 2.0 * v;
                    by[D2] -= sign * v * v;
                    by[D3] -= v * v * v;
                    by
                }
            };
            by = sign * (by - rate * self.tau_by);
        }
        let q = self.side.displacement(x, self.r);
        MotionPoint { q, v: sign * v, signal: sign * signal, rate: sign * rate, by }
    }

    fn turn(&self, tau: f64, end: &Jet) -> FittedTurn {
        let sign = self.side.sign();
        let force = self.field.acceleration(end.at.x, 0.0);
        let q_by = sign * (self.combined(&end.y) - direction(R));
        let tau_by = self.tau_by - self.combined(&end.w) / force;
        FittedTurn { tau, q: self.side.displacement(end.at.x, self.r), tau_by, q_by }
    }
}

/// The derivatives along one step.
#[derive(Default)]
struct Sensitivities {
    /// The Taylor coefficients of those of the position, in powers of a unit of time.
    terms: [Ways; ORDER + 1],
    unit: f64,
}

impl Sensitivities {
    /// Those along the step from `start`, from the coefficients of its velocity in powers of a unit of time.
    fn expand(&mut self, field: &HalfPlane, start: &Jet, (v, unit): (&[f64], f64)) {
        let HalfPlane { d, d2, d3 } = *field;
        let terms = &mut self.terms;
        let mut square = [0.0; ORDER];
        let mut slope = [0.0; ORDER];
        let mut w = [Ways::zeros(); ORDER + 1];
        (terms[0], w[0], self.unit) = (start.y, start.w, unit);
        for k in 0..ORDER {
            let backward = || v[..=k].iter().rev();
            square[k] = v[..=k].iter().zip(backward()).map(|(one, other)| one * other).sum();
            let cube: f64 = square[..=k].iter().zip(backward()).map(|(one, v)| one * v).sum();
            let linear = if k == 0 { -2.0 * d } else { 0.0 };
            slope[k] = linear - 2.0 * d2 * v[k] - 3.0 * d3 * square[k];
            let mut sum = Ways::new(0.0, -2.0 * v[k], -square[k], -cube);
            for (slope, w) in slope[..=k].iter().zip(w[..=k].iter().rev()) {
                sum += *slope * w;
            }
            let part = unit / real(k + 1);
            w[k + 1] = part * (sum - terms[k]);
            terms[k + 1] = part * w[k];
        }
    }

    /// The derivatives of the position `t` after the start of the step.
    fn of_position(&self, t: f64) -> Ways {
        let t = t / self.unit;
        self.terms.iter().rev().fold(Ways::zeros(), |sum, term| sum * t + term)
    }

    /// Those of the velocity.
    fn of_velocity(&self, t: f64) -> Ways {
        let t = t / self.unit;
        let terms = self.terms.iter().enumerate().skip(1).rev();
        let sum = terms.fold(Ways::zeros(), |sum, (order, term)| sum * t + real(order) * term);
        sum / self.unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Limits, Outcome, Problem};

    /// Onto a stable cycle, to rest near a fold, to rest over asymmetric damping, with linear damping; from
    /// rest and moving.
    const MOTIONS: [(Parameters, State); 4] = [
        (Parameters { d: -0.05, d2: 0.01, d3: 0.004, r: 0.1 }, State { q: 9.0, v: 0.5 }),
        (Parameters { d: -0.08, d2: 0.02, d3: 0.003, r: 0.4 }, State { q: 3.9, v: 0.0 }),
        (Parameters { d: 0.1, d2: 0.3, d3: 0.05, r: 0.2 }, State { q: -4.0, v: 1.0 }),
        (Parameters { d: 0.02, d2: 0.0, d3: 0.0, r: 0.1 }, State { q: 4.0, v: 3.0 }),
    ];

    fn way(with_derivatives: bool) -> Way {
        Way { with_derivatives, reach: 1e4, ..Way::default() }
    }

    fn points(parameters: &Parameters, start: State, times: &[f64], way: Way) -> Vec<MotionPoint> {
        let mut points = Vec::new();
        follow(parameters, start, times, way, |_, point| points.push(point)).unwrap();
        points
    }

    fn times() -> Vec<f64> {
        (0..120).map(|index| 0.25 * f64::from(index)).collect()
    }

    #[test]
    fn motions_are_those_of_the_integrators() {
        for (parameters, initial) in MOTIONS {
            let found = points(&parameters, initial, &[0.7, 5.0, 29.0], way(false));
            for (point, until) in found.iter().zip([0.7, 5.0, 29.0]) {
                let problem =
                    Problem { parameters, initial, until, tolerance: 1e-13, ..Problem::default() };
                let motion = trajectory(&problem, Detail::default(), &Limits::PATIENT);
                let q = match motion.outcome {
                    Outcome::Moving { q, .. } | Outcome::Captured { q, .. } => q,
                    other => panic!("{other:?}"),
                };
                assert!((point.q - q).abs() < 1e-9 * initial.q.abs(), "{parameters:?} {until}");
            }
        }
    }

    const SIGNALS: [Signal; 3] = [Signal::Displacement, Signal::Velocity, Signal::Acceleration];

    /// Velocity and acceleration are differentiated in the same way as the displacement. Where a turning point lies
    /// between the two sides of a difference the acceleration jumps, and there is none.
    #[test]
    fn derivatives_are_those_of_differences_through_every_event() {
        const STEP: f64 = 1e-6;
        for ((parameters, start), signal) in
            MOTIONS.into_iter().flat_map(|motion| SIGNALS.map(|signal| (motion, signal)))
        {
            let numbers =
                [parameters.d, parameters.d2, parameters.d3, parameters.r, start.q, start.v];
            let at = |numbers: [f64; 6], with_derivatives: bool| {
                let [d, d2, d3, r, q, v] = numbers;
                let parameters = Parameters { d, d2, d3, r };
                let way = Way { signal, ..way(with_derivatives) };
                points(&parameters, State { q, v }, &times(), way)
            };
            let exact = at(numbers, true);
            let places = [D, D2, D3, R, Q0, LAST].into_iter().enumerate();
            for (p, place) in places.filter(|&(_, place)| place != LAST || start.v != 0.0) {
                let moved = |step: f64| {
                    let mut numbers = numbers;
                    numbers[p] += step;
                    at(numbers, false)
                };
                let (above, below) = (moved(STEP), moved(-STEP));
                let largest = exact.iter().map(|point| point.by[place].abs()).fold(0.0, f64::max);
                for ((exact, above), below) in exact.iter().zip(&above).zip(&below) {
                    if above.v.signum() != below.v.signum() {
                        continue;
                    }
                    let difference = (above.signal - below.signal) / (2.0 * STEP);
                    let off = (exact.by[place] - difference).abs();
                    assert!(
                        off < 1e-6 * largest,
                        "{signal}, {parameters:?}: number {place}: {off} of {largest}"
                    );
                }
            }
        }
    }

    #[test]
    fn each_signal_is_the_rate_of_the_one_before_and_a_mass_at_rest_shows_none() {
        for (parameters, start) in MOTIONS {
            let [q, v, a] = SIGNALS
                .map(|signal| points(&parameters, start, &times(), Way { signal, ..way(true) }));
            // A mass that is released is in motion from the first moment on, without velocity.
            for ((q, v), a) in q.iter().zip(&v).zip(&a).skip(1) {
                assert_eq!((q.signal, q.rate, v.rate), (q.q, v.signal, a.signal));
                let friction = if v.v == 0.0 { 0.0 } else { parameters.r * v.v.signum() };
                let Parameters { d, d2, d3, .. } = parameters;
                let force = 2.0 * d * v.v + d2 * v.v * v.v + d3 * v.v * v.v * v.v;
                let moves = v.v != 0.0;
                let is = if moves { -force - q.q - friction } else { 0.0 };
                assert!((a.signal - is).abs() < 1e-12 * start.q.abs(), "{parameters:?} {a:?}");
                let none = Unknowns::zeros();
                assert!(moves || (v.signal, a.by, v.by) == (0.0, none, none));
            }
        }
    }

    #[test]
    fn without_derivatives_the_motion_is_the_same_to_the_last_bit() {
        for (parameters, start) in MOTIONS {
            let with = points(&parameters, start, &times(), way(true));
            let without = points(&parameters, start, &times(), way(false));
            let same =
                |(one, other): (&MotionPoint, &MotionPoint)| (one.q, one.v) == (other.q, other.v);
            assert!(with.iter().zip(&without).all(same));
        }
    }

    #[test]
    fn a_motion_that_escapes_is_lost_and_one_at_rest_stays() {
        let parameters = Parameters { d: -0.1, d2: 0.0, d3: -1.0, r: 0.1 };
        let start = State { q: 10.0, v: 0.0 };
        let found = follow(&parameters, start, &[50.0], way(true), |_, _| {});
        assert_eq!(found, Err(LostMotion));
        let rest = State { q: 0.05, v: 0.0 };
        let found = points(&parameters, rest, &[0.0, 50.0], way(true));
        assert!(found.iter().all(|point| (point.q, point.v, point.by[Q0]) == (0.05, 0.0, 1.0)));
    }
}
