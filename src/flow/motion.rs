//! A motion as data: the problem, what to keep of the solution, and the solution.

use serde::{Deserialize, Serialize};

use super::Method;
use crate::model::{ContactState, Knob, Ledger, Parameters, Reason, Result, State};
use crate::numerics::{Hermite, Scalar};

/// An initial value problem.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[must_use]
pub struct Problem {
    /// Parameters of the oscillator; a machine has its model in their place.
    pub parameters: Parameters,
    /// Where the motion starts, at `tau = 0`.
    pub initial: State,
    /// Time at which to stop.
    pub until: f64,
    /// How to integrate.
    pub method: Method,
    /// Largest relative error of a step.
    pub tolerance: f64,
    /// Step length of the methods with a fixed step.
    pub step: f64,
    /// Velocity over which the method `smoothed` smoothes friction.
    pub epsilon: f64,
}

impl Problem {
    /// A motion to ten digits.
    pub fn new(parameters: Parameters, initial: State, until: f64) -> Self {
        let [tolerance, step, epsilon] =
            [Knob::Tolerance, Knob::Step, Knob::Epsilon].map(Knob::usual);
        Problem { parameters, initial, until, method: Method::Auto, tolerance, step, epsilon }
    }

    /// A number of the motion, or of how it is computed; `None` if it is one of a machine.
    fn own(&mut self, knob: Knob) -> Option<&mut f64> {
        Some(match knob {
            Knob::Q0 => &mut self.initial.q,
            Knob::V0 => &mut self.initial.v,
            Knob::Until => &mut self.until,
            Knob::Tolerance => &mut self.tolerance,
            Knob::Step => &mut self.step,
            Knob::Epsilon => &mut self.epsilon,
            _ => return self.parameters.part(knob),
        })
    }

    /// Reads a number of the motion, or of how it is computed; not a number if it is one of a machine.
    #[must_use]
    pub fn get(mut self, knob: Knob) -> f64 {
        self.own(knob).map_or(f64::NAN, |own| *own)
    }

    /// Writes a number of the motion, or of how it is computed; one of a machine changes nothing.
    pub fn set(&mut self, knob: Knob, value: f64) {
        if let Some(own) = self.own(knob) {
            *own = value;
        }
    }
}

impl Default for Problem {
    /// A motion of the plain oscillator to the end time 60, to ten digits.
    fn default() -> Self {
        Problem::new(Parameters::default(), State::default(), Knob::Until.usual())
    }
}

/// What to keep of a motion besides its outcome. What is not requested costs nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Detail {
    /// Every arrival at `v = 0`. Without friction nothing happens there, so unless crossings are requested no
    /// method looks for them. With friction a motion cannot be followed without them.
    pub crossings: bool,
    /// Number of points for drawing on each integration step (0 for none).
    pub samples_per_step: usize,
    /// The energy ledger.
    pub energy: bool,
}

impl Default for Detail {
    /// The crossings only.
    fn default() -> Self {
        Detail { crossings: true, samples_per_step: 0, energy: false }
    }
}

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Outcome<N = f64> {
    /// At rest on the sticking set since `tau`.
    Captured {
        /// Time of the arrival.
        tau: N,
        /// Displacement at rest.
        q: N,
    },
    /// Still moving at the end time.
    Moving {
        /// The end time.
        tau: N,
        /// Displacement at the end time.
        q: N,
        /// Velocity at the end time.
        v: N,
    },
    /// The velocity runs to infinity in finite time.
    Escaped {
        /// Estimated time of the blow-up.
        tau: N,
    },
    /// No answer.
    GaveUp {
        /// The time reached.
        tau: N,
        /// Why the computation gave up.
        reason: Reason,
    },
}

impl<N> Outcome<N> {
    /// Nothing, unless the motion was given up.
    ///
    /// # Errors
    /// Why it was.
    pub fn answered(&self) -> Result<()> {
        if let Outcome::GaveUp { reason, .. } = self {
            Err(*reason)
        } else {
            Ok(())
        }
    }

    /// The word of files for it.
    pub fn word(&self) -> &'static str {
        match self {
            Outcome::Captured { .. } => "captured",
            Outcome::Moving { .. } => "moving",
            Outcome::Escaped { .. } => "escaped",
            Outcome::GaveUp { .. } => "gave-up",
        }
    }

    /// The outcome of a motion that escapes, or is given up, at this time.
    pub(crate) fn without_end(tau: N, reason: Reason) -> Self {
        if reason == Reason::Escapes {
            Outcome::Escaped { tau }
        } else {
            Outcome::GaveUp { tau, reason }
        }
    }

    /// The same outcome in other numbers.
    pub fn map<M>(self, number: impl Fn(N) -> M) -> Outcome<M> {
        match self {
            Outcome::Captured { tau, q } => Outcome::Captured { tau: number(tau), q: number(q) },
            Outcome::Moving { tau, q, v } => {
                Outcome::Moving { tau: number(tau), q: number(q), v: number(v) }
            }
            Outcome::Escaped { tau } => Outcome::Escaped { tau: number(tau) },
            Outcome::GaveUp { tau, reason } => Outcome::GaveUp { tau: number(tau), reason },
        }
    }
}

impl<N: Scalar> Outcome<N> {
    /// When the motion ended.
    pub fn tau(self) -> N {
        match self {
            Outcome::Captured { tau, .. }
            | Outcome::Moving { tau, .. }
            | Outcome::Escaped { tau }
            | Outcome::GaveUp { tau, .. } => tau,
        }
    }

    /// When the motion came to rest, if it did.
    ///
    /// # Errors
    /// Why it was given up.
    pub fn rest(self) -> Result<Option<N>> {
        self.answered()?;
        Ok(if let Outcome::Captured { tau, .. } = self {
            Some(tau)
        } else {
            None
        })
    }

    /// Displacement and velocity at the end, where these are known.
    pub fn state(self) -> Option<(N, N)> {
        match self {
            Outcome::Captured { q, .. } => Some((q, N::from(0.0))),
            Outcome::Moving { q, v, .. } => Some((q, v)),
            Outcome::Escaped { .. } | Outcome::GaveUp { .. } => None,
        }
    }
}

/// An arrival at `v = 0`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Crossing<N = f64> {
    /// Time.
    pub tau: N,
    /// Displacement.
    pub q: N,
}

/// A point of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sample {
    /// Time.
    pub tau: f64,
    /// Displacement.
    pub q: f64,
    /// Velocity.
    pub v: f64,
}

impl Sample {
    /// The point of the phase plane.
    pub fn state(&self) -> State {
        State { q: self.q, v: self.v }
    }

    /// A time between this sample and a later one, on the cubic through the displacements and velocities of both.
    pub fn between(&self, later: &Sample, tau: f64) -> Sample {
        let h = later.tau - self.tau;
        let t = (tau - self.tau) / h;
        let q = Hermite { values: (self.q, later.q), slopes: (h * self.v, h * later.v) };
        Sample { tau, q: q.at(t), v: q.slope(t) / h }
    }
}

/// The first of ascending times, up to this one; they are taken off the others.
pub(crate) fn due<'a>(times: &mut &'a [f64], until: f64) -> &'a [f64] {
    let (now, later) = times.split_at(times.partition_point(|tau| *tau <= until));
    *times = later;
    now
}

/// A stretch of the motion of a machine in one phase, on the belt, or at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// What the mass does.
    pub place: ContactState,
    /// Where it begins.
    pub start: Sample,
}

/// Operation counts of a computation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Cost {
    /// Evaluations of the field; a Taylor series of order N counts as N.
    pub evaluations: u64,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
}

impl Cost {
    /// Adds what something took, and returns what it found.
    pub fn spend<T>(&mut self, (found, spent): (T, Cost)) -> T {
        *self += spent;
        found
    }
}

impl std::ops::AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.evaluations += other.evaluations;
        self.steps += other.steps;
        self.rejected += other.rejected;
    }
}

/// A computed motion, in doubles or in numbers of twice the precision.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Motion<N = f64> {
    /// The problem that was solved.
    pub problem: Problem,
    /// The method that took most of the steps; never `Auto`.
    pub method: Method,
    /// Steps that `Auto` took with the implicit method.
    pub implicit_steps: u64,
    /// How the motion ended.
    pub outcome: Outcome<N>,
    /// Every arrival at `v = 0` after the start, the last one included.
    pub crossings: Vec<Crossing<N>>,
    /// What the mass does one after the other, if it belongs to a machine.
    pub legs: Vec<Leg>,
    /// The smallest and the largest displacement, and those of the velocity, of a machine.
    pub extremes: Option<[(f64, f64); 2]>,
    /// The energy balance, if requested; of a machine only Taylor series count it.
    pub ledger: Option<Ledger>,
    /// Points for drawing, if requested; the first is the start. Of a machine there are always its start and its end. Of
    /// one that is evaluated at given times, those are among them.
    pub samples: Vec<Sample>,
    /// Cost of the computation.
    pub cost: Cost,
}

impl<N: Scalar> Motion<N> {
    /// A motion of which nothing is known yet but its start.
    pub(crate) fn begun(problem: &Problem, method: Method) -> Self {
        let State { q, v } = problem.initial;
        Motion {
            problem: *problem,
            method,
            implicit_steps: 0,
            outcome: Outcome::Moving { tau: N::from(0.0), q: N::from(q), v: N::from(v) },
            crossings: Vec::new(),
            legs: Vec::new(),
            extremes: None,
            ledger: None,
            samples: Vec::new(),
            cost: Cost::default(),
        }
    }
}

impl Motion {
    /// When and where it ended; where that is not known, the last sample.
    pub fn end(&self) -> Sample {
        let last = self.samples.last();
        let State { q, v } = last.map_or(self.problem.initial, Sample::state);
        let (q, v) = self.outcome.state().unwrap_or((q, v));
        Sample { tau: self.outcome.tau(), q, v }
    }

    /// The same, where it is known.
    ///
    /// # Errors
    /// Why it is not: the motion escapes, or was given up.
    pub fn known_end(&self) -> Result<Sample> {
        self.outcome.answered()?;
        self.outcome.state().map(|_| self.end()).ok_or(Reason::Escapes)
    }

    /// The stretches on which the mass rides on a belt, each from its first to its last point.
    pub fn rides(&self) -> impl Iterator<Item = [Sample; 2]> {
        let ends = self.legs.iter().skip(1).map(|leg| leg.start).chain([self.end()]);
        let legs = self.legs.iter().zip(ends);
        let rides = legs.filter(|(leg, _)| leg.place == ContactState::Sticks);
        rides.map(|(leg, end)| [leg.start, end])
    }

    /// The stretches on which friction holds the mass: on a belt and, from capture until a time, at rest.
    pub fn sticks(&self, until: f64) -> impl Iterator<Item = [Sample; 2]> {
        let rest = self.outcome.rest().ok().flatten().map(|since| {
            let begin = Sample { tau: since, v: 0.0, ..self.end() };
            [begin, Sample { tau: until.max(since), ..begin }]
        });
        self.rides().chain(rest)
    }

    /// The motion at any time from its start: between two samples on the cubic through their displacements and
    /// velocities, and at rest after capture. `None` without samples.
    pub fn at(&self, tau: f64) -> Option<Sample> {
        let last = *self.samples.last()?;
        if let Outcome::Captured { tau: since, q } = self.outcome
            && tau >= since
        {
            return Some(Sample { tau, q, v: 0.0 });
        }
        let (before, after) =
            self.samples.split_at(self.samples.partition_point(|sample| sample.tau <= tau));
        Some(match (before.last(), after.first()) {
            (Some(from), Some(to)) => from.between(to, tau),
            (None, Some(first)) => *first,
            (_, None) => last,
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Limits, Problem};
    use crate::model::{Knob, Parameters, State};

    #[test]
    fn what_is_set_is_read_back() {
        let mut problem = Problem::default();
        let all = Knob::MOTION.into_iter().chain([
            Knob::Until,
            Knob::Tolerance,
            Knob::Step,
            Knob::Epsilon,
        ]);
        for (knob, place) in all.clone().zip(0..) {
            let value = 0.5 + f64::from(place);
            problem.set(knob, value);
            assert_eq!(problem.get(knob), value);
        }
        assert!(all.zip(0..).all(|(knob, place)| problem.get(knob) == 0.5 + f64::from(place)));
        assert!(problem.get(Knob::Mass).is_nan());
    }

    #[test]
    fn between_samples_a_motion_is_where_it_is_computed_to_be() {
        let parameters = Parameters { d: -0.1, d2: 0.1, d3: 0.4, r: 0.1 };
        let problem =
            Problem { parameters, initial: State { q: 1.0, v: 0.2 }, ..Problem::default() };
        let detail = Detail { samples_per_step: 16, ..Detail::default() };
        let motion = trajectory(&problem, detail, &Limits::PATIENT);
        for tau in [0.0, 0.013, 1.0, 3.3, 7.77] {
            let end = trajectory(&Problem { until: tau, ..problem }, detail, &Limits::PATIENT);
            let (found, exact) = (motion.at(tau).unwrap(), *end.samples.last().unwrap());
            assert!((found.q - exact.q).abs() < 1e-6, "tau = {tau}: {found:?} {exact:?}");
            assert!((found.v - exact.v).abs() < 1e-4, "tau = {tau}: {found:?} {exact:?}");
        }
    }

    #[test]
    fn after_its_capture_it_rests() {
        let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.25 };
        let problem = Problem { parameters, ..Problem::default() };
        let detail = Detail { samples_per_step: 4, ..Detail::default() };
        let motion = trajectory(&problem, detail, &Limits::PATIENT);
        let end = motion.outcome.tau();
        let (one, other) = (motion.at(end).unwrap(), motion.at(end + 9.0).unwrap());
        assert_eq!((one.q, one.v, other.v), (other.q, 0.0, 0.0));
    }
}
