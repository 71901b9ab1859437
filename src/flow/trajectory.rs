//! Computes a motion, half swings joined end to end, until it is captured, escapes, reaches its end time or is given up.

use nalgebra::Vector3;

use super::motion::due;
pub use super::motion::{Cost, Crossing, Detail, Motion, Outcome, Problem, Sample};
use super::swing::swing;
use super::{
    ApproachToRest, AutoStepper, CLASSICAL, DOP853, DOPRI5, ExactStepper, ExplicitStepper, Limits,
    Method, Powers, SmoothField, Step, StepPoint, Stepper, StiffStepper, Taylor, TimeStepping,
};
use crate::model::{HalfPlane, Ledger, PlaneField, Reason, Result, Side, State, energy, rests};
use crate::numerics::{Scalar, Sum, real, times_power};

/// Computes a motion.
///
/// Guarantee: the result is one of the typed outcomes, and no number in it is NaN. With the methods that find
/// events, the place and time of every crossing carry the errors of the previous steps, each of relative size
/// `tolerance`.
pub fn trajectory(problem: &Problem, detail: Detail, limits: &Limits) -> Motion {
    evaluated(problem, (detail, &[]), limits)
}

/// The same with points at these times, in ascending order.
pub(crate) fn evaluated(
    problem: &Problem,
    (detail, times): (Detail, &[f64]),
    limits: &Limits,
) -> Motion {
    let Problem { parameters, tolerance, step, epsilon, .. } = *problem;
    let linear = parameters.is_piecewise_linear();
    let field = HalfPlane::new(&parameters, Side::Upper);
    let run = |method| MotionRun { times, ..MotionRun::new(problem, method, detail, limits) };
    let asked = run(problem.method);
    match problem.method {
        Method::Auto | Method::Exact if linear => run(Method::Exact).go(&mut ExactStepper::new()),
        Method::Exact => {
            let reason = Reason::NotApplicable { needs: "D2 = D3 = 0" };
            asked.close(Err(reason), Cost::default())
        }
        Method::Auto => {
            let mut stepper = AutoStepper::new(tolerance);
            let mut found = run(Method::Taylor).go(&mut stepper);
            found.implicit_steps = stepper.implicit_steps;
            if 2 * found.implicit_steps > found.cost.steps {
                found.method = Method::Stiff;
            }
            found
        }
        Method::Taylor => asked.go(&mut Taylor::new(tolerance)),
        Method::Dop853 => asked.go(&mut ExplicitStepper::new(&DOP853, field, tolerance)),
        Method::Dopri5 => asked.go(&mut ExplicitStepper::new(&DOPRI5, field, tolerance)),
        Method::Rk4 => asked.go(&mut ExplicitStepper::new(&CLASSICAL, field, step)),
        Method::Stiff => asked.go(&mut StiffStepper::new(field, tolerance)),
        Method::Smoothed => asked
            .walk(Some(epsilon), false, |field| ExplicitStepper::new(&DOP853, field, tolerance)),
        Method::SignRk4 => {
            asked.walk(None, false, |field| ExplicitStepper::new(&CLASSICAL, field, step))
        }
        Method::TimeStepping => asked.walk(None, true, |field| TimeStepping::new(field, step)),
    }
}

/// Why this method was chosen, in a short sentence; `None` where it was requested by name.
#[must_use]
pub fn choice(found: &Motion) -> Option<String> {
    if found.problem.method != Method::Auto {
        return None;
    }
    let (implicit, steps) = (found.implicit_steps, found.cost.steps);
    Some(match found.method {
        Method::Exact => "exact: D2 = D3 = 0 has a closed form".to_owned(),
        _ if steps == 0 => "nothing to integrate".to_owned(),
        _ if implicit == 0 => "taylor: accuracy limits its steps, stability none".to_owned(),
        _ => format!("stiff for {implicit} of {steps} steps, where stability would limit taylor"),
    })
}

/// Half swings of a motion whose ends are kept: what is written of these takes some hundred megabytes.
const MOST_CROSSINGS: usize = 2_000_000;

/// A motion in progress.
pub struct MotionRun<'a, N = f64> {
    detail: Detail,
    limits: &'a Limits<'a>,
    /// The times at which it is still to be evaluated.
    times: &'a [f64],
    /// The results so far.
    found: Motion<N>,
    time: Sum<N>,
    /// Work of the linear, the quadratic and the cubic damping.
    works: Vector3<f64>,
    /// Length of the path, half swing by half swing: a short way has digits that the places of its ends have not.
    path: f64,
}

impl<'a, N: Scalar> MotionRun<'a, N> {
    /// A run at its start.
    pub fn new(problem: &Problem, method: Method, detail: Detail, limits: &'a Limits) -> Self {
        let State { q, v } = problem.initial;
        let mut found = Motion::begun(problem, method);
        if detail.samples_per_step > 0 {
            found.samples.push(Sample { tau: 0.0, q, v });
        }
        MotionRun {
            detail,
            limits,
            times: &[],
            found,
            time: Sum::default(),
            works: Vector3::zeros(),
            path: 0.0,
        }
    }

    /// Follows the motion until it ends.
    pub fn go<S: Stepper<HalfPlane, N>>(mut self, stepper: &mut S) -> Motion<N> {
        let outcome = self.half_swings(stepper);
        self.close(outcome, stepper.cost())
    }

    /// The motion with its outcome, cost and energy ledger.
    fn close(mut self, outcome: Result<Outcome<N>>, cost: Cost) -> Motion<N> {
        let Problem { parameters, initial, .. } = self.found.problem;
        let outcome =
            outcome.unwrap_or_else(|reason| Outcome::without_end(self.time.value(), reason));
        self.found.outcome = outcome;
        self.found.cost += cost;
        if self.detail.energy
            && let Some((q, v)) = outcome.state()
        {
            let end = State { q: q.value(), v: v.value() };
            let [linear, quadratic, cubic] = self.works.into();
            let works = [linear, quadratic, cubic, -parameters.r * self.path];
            let energies = (energy(initial), energy(end));
            let ledger = Ledger::of_terms(&parameters, energies, works);
            // Energies may overflow where states do not.
            self.found.ledger = ledger.residual.is_finite().then_some(ledger);
        }
        self.found
    }

    /// The outcome of a motion that rests at its start.
    fn rests(&self) -> Outcome<N> {
        Outcome::Captured { tau: N::from(0.0), q: N::from(self.found.problem.initial.q) }
    }

    /// Joins half swings until the motion ends. Without friction nothing happens at `v = 0`: unless crossings are requested,
    /// one smooth motion leads through all half swings.
    fn half_swings<S: Stepper<HalfPlane, N>>(&mut self, stepper: &mut S) -> Result<Outcome<N>> {
        let Problem { parameters, initial, until, .. } = self.found.problem;
        let (r, until, rest) = (parameters.r, N::from(until), N::from(0.0));
        let Some(mut side) = Side::entered_from(initial, r) else { return Ok(self.rests()) };
        let arrives = r > 0.0 || self.detail.crossings;
        let mut last = StepPoint { x: N::from(initial.q), v: N::from(initial.v) };
        let mut point = StepPoint { x: side.position(last.x, r), v: N::from(initial.v.abs()) };
        let mut unit = 0;
        loop {
            let remaining = self.time.until(until);
            if remaining <= rest {
                return Ok(Outcome::Moving { tau: until, q: last.x, v: last.v });
            }
            if self.found.crossings.len() >= MOST_CROSSINGS {
                return Err(Reason::HalfSwings { most: MOST_CROSSINGS });
            }
            let field = HalfPlane::new(&parameters, side);
            let sign = N::from(side.sign());
            let stop = ApproachToRest::of(&field, point.rounded(), N::NEGLIGIBLE);
            let in_time = |stop: &ApproachToRest| arrives && N::from(stop.duration) < remaining;
            let q;
            if let Some(stop) = stop.filter(in_time) {
                self.time.add(N::from(stop.duration));
                self.path += stop.way();
                q = last.x + sign * N::from(stop.way());
                let (beyond, of) = stop.beyond((sign * last.x - N::from(r)).value());
                (point.x, unit) = (N::from(-beyond), of);
            } else {
                let (from, bound) = ((point, unit), (remaining, arrives));
                let (StepPoint { x, v }, crossed) =
                    self.piece(stepper, &field, (side, r), from, bound, |_, _, _| true)?;
                self.path += (x - point.x).value();
                q = side.displacement(x, r);
                if !crossed {
                    return self.stopped(StepPoint { x: q, v: sign * v });
                }
                // The next half swing starts from its clearance, which is known more accurately than q - r.
                (point.x, unit) = (N::from(2.0 * r) - x, 0);
            }
            if !q.value().is_finite() {
                return Err(Reason::OutOfRange);
            }
            let tau = self.time.value();
            self.found.crossings.push(Crossing { tau, q });
            if point.x >= rest {
                return Ok(Outcome::Captured { tau, q });
            }
            (last, point.v, side) = (StepPoint { x: q, v: rest }, rest, side.opposite());
        }
    }

    /// Runs one smooth piece on a side whose centre is displaced by some shift, from a point in units of a power of two,
    /// for some time or up to `v = 0`; keeps evenly spaced points of each step for drawing, its end but not its start,
    /// and adds up the work. `see` says whether it goes on after a step. Returns its end, and whether that is at `v = 0`.
    fn piece<F: PlaneField, S: Stepper<F, N>>(
        &mut self,
        stepper: &mut S,
        field: &F,
        (side, shift): (Side, f64),
        from: (StepPoint<N>, i32),
        bound: (N, bool),
        mut see: impl FnMut(f64, i32, &Step<N>) -> bool,
    ) -> Result<(StepPoint<N>, bool)> {
        let (detail, time) = (self.detail, self.time);
        let (samples, sum) = (&mut self.found.samples, &mut self.works);
        let times = &mut self.times;
        let watch = |stepper: &mut S, at: f64, unit: i32, step: &Step<N>| {
            let count = detail.samples_per_step * stepper.pieces();
            let (begun, lasts) = (time.plus(N::from(at)).value(), step.duration.value());
            let even = (1..=count).map(|index| {
                let offset = lasts * (real(index) / real(count));
                (time.plus(N::from(at + offset)).value(), offset)
            });
            let asked = due(times, begun + lasts).iter().map(|tau| (*tau, tau - begun));
            for (tau, offset) in even.chain(asked) {
                let StepPoint { x, v } = if offset >= lasts {
                    step.end.rounded()
                } else {
                    stepper.at(offset.max(0.0))
                };
                // Near the largest numbers, a position measured from the centre of its spiral may overflow, and so may
                // the polynomial of a step between two finite points.
                if x.is_finite() && v.is_finite() {
                    samples.push(Sample {
                        tau,
                        q: side.displacement(times_power(x, unit), shift),
                        v: side.sign() * times_power(v, unit),
                    });
                }
            }
            if detail.energy {
                *sum += works(stepper.powers(), &field.frictionless(), unit);
            }
            see(at, unit, step)
        };
        let piece = swing(stepper, field, from, bound, self.limits, watch);
        self.found.cost.steps += piece.steps;
        self.time.add(piece.duration);
        Ok((piece.end?, piece.crossed))
    }

    /// The motion at its end time.
    fn stopped(&self, StepPoint { x: q, v }: StepPoint<N>) -> Result<Outcome<N>> {
        let is_finite = q.value().is_finite() && v.value().is_finite();
        let tau = N::from(self.found.problem.until);
        if is_finite {
            Ok(Outcome::Moving { tau, q, v })
        } else {
            Err(Reason::OutOfRange)
        }
    }
}

impl MotionRun<'_> {
    /// Takes steps that ignore `v = 0`, as the methods do that are included for comparison, and counts sign changes
    /// of the velocity as crossings.
    ///
    /// `sticks` says whether a motion that this method, a stepper of the field with friction over `epsilon`, brings to
    /// `v = 0` inside the sticking set stays there. Positions at crossings assume a velocity that is linear within the step.
    pub fn walk<S: Stepper<SmoothField>>(
        mut self,
        epsilon: Option<f64>,
        sticks: bool,
        stepper: impl FnOnce(SmoothField) -> S,
    ) -> Motion {
        let Problem { parameters, initial, until, .. } = self.found.problem;
        let smooth = HalfPlane::new(&parameters, Side::Upper);
        let field = SmoothField { smooth, r: parameters.r, epsilon };
        let mut stepper = stepper(field);
        let (mut crossings, mut path) = (Vec::new(), 0.0);
        let start = StepPoint { x: initial.q, v: initial.v };
        let mut from = start;
        let mut ended = None;
        let see = |at: f64, unit: i32, step: &Step| {
            let end = step.end.times_power(unit);
            let (tau, start) = (at + step.duration, std::mem::replace(&mut from, end));
            let mut turn = start.x;
            if start.v != 0.0 && start.v.signum() * end.v <= 0.0 {
                let part = start.v / (start.v - end.v);
                turn = start.x + 0.5 * part * step.duration * start.v;
                if turn.is_finite() {
                    crossings.push(Crossing { tau: at + part * step.duration, q: turn });
                }
            }
            // The path within the step, out and back where the velocity changes sign.
            path += (turn - start.x).abs() + (end.x - turn).abs();
            ended = if !turn.is_finite() {
                Some(Err(Reason::OutOfRange))
            } else if tau == at {
                Some(Err(Reason::StepTooSmall { step: step.duration }))
            } else if crossings.len() >= MOST_CROSSINGS {
                Some(Err(Reason::HalfSwings { most: MOST_CROSSINGS }))
            } else {
                let stays = sticks && rests(State { q: end.x, v: end.v }, parameters.r);
                stays.then_some(Ok(Outcome::Captured { tau, q: end.x }))
            };
            ended.is_none()
        };
        let outcome = if sticks && rests(initial, parameters.r) {
            Ok(self.rests())
        } else if until <= 0.0 {
            Ok(Outcome::Moving { tau: until, q: start.x, v: start.v })
        } else {
            let bound = (until, false);
            let side = (Side::Upper, 0.0);
            let piece = self.piece(&mut stepper, &field, side, (start, 0), bound, see);
            piece.and_then(|(point, _)| ended.unwrap_or_else(|| self.stopped(point)))
        };
        (self.found.crossings, self.path) = (crossings, path);
        self.close(outcome, stepper.cost())
    }
}

/// The work of the damping terms over one step measured in units of `2^unit`.
fn works(powers: Powers, field: &HalfPlane, unit: i32) -> Vector3<f64> {
    let HalfPlane { d, d2, d3 } = field.in_units(unit);
    let works = powers.component_mul(&Vector3::new(-2.0 * d, -d2, -d3));
    works.map(|work| times_power(times_power(work, unit), unit))
}

#[cfg(test)]
mod tests;
