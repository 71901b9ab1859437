//! How wrong a computed motion is, measured against one that is known better.
//!
//! The better one is the same motion in numbers of twice the working precision
//! ([`crate::flow::precise`]), computed twice with different orders and steps: how far these two differ is
//! its own error, typically `1e-26`, and it is always reported. Where that would take too long (stiff motions,
//! millions of swings) the closed form takes its place, or else an implicit run near rounding; then the
//! difference of a further method from it is taken as its own error, and no smaller error can be measured.

use thiserror::Error;

use crate::flow::{
    COARSE, Cost, Crossing, Detail, FINE, Limits, Method, Motion, Outcome, Problem, Reason, Result,
    precise, trajectory,
};
use crate::model::{FINEST, Model};
use crate::numerics::{Scalar, Twofold};

/// Maximum number of evaluations in twice the working precision: about a second.
const MOST: u64 = 1_000_000;

/// Tolerances of the two methods where the motion is too long or too stiff for twice the precision.
const TIGHT: (f64, f64) = (1e-14, 1e-13);

/// Where the reference comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReferenceSource {
    /// Taylor series in twice the working precision, of two orders.
    TwicePrecision,
    /// The closed form for `D2 = D3 = 0`, and a Taylor series beside it.
    ClosedForm,
    /// The implicit method near rounding, and a Taylor series beside it.
    Implicit,
    /// Taylor series of a machine whose last terms are below rounding, with nothing beside them.
    Machine,
}

/// A motion known better than what is compared with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Every arrival at `v = 0` after the start, the last one included.
    pub turns: Vec<Crossing<Twofold>>,
    /// How it ended.
    pub end: Outcome<Twofold>,
    /// Where it comes from.
    pub source: ReferenceSource,
    /// Its own error: how far two independent computations of it differ; not a number if there is only one.
    pub error: f64,
    /// The largest displacement of a turning point, the end and, unless it is of a machine, the start included.
    pub scale: f64,
    /// What both computations cost, counted as the methods count.
    pub cost: Cost,
}

/// How far a computed motion is from the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The error: the largest difference of `q` at the turning points, first with first, and of `q` and
    /// `v` at the end time; for a motion that escapes also that of the time at which it does.
    ///
    /// Where one motion has more turning points than the other, they are compared with the other's end. Of a machine
    /// only displacements count, as fractions of the largest one: those at its standstills alone if it escapes.
    pub error: f64,
    /// The largest difference of the times of turning points that both have.
    pub time: f64,
    /// Whether the outcome is of the right kind, after the right number of turning points.
    pub agrees: bool,
}

/// Why a motion cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum NoComparison {
    /// It was given up.
    #[error("gave up: {0}")]
    GaveUp(Reason),
    /// It escapes where the reference does not, or the other way round.
    #[error("escapes where the motion does not, or misses it")]
    OtherFate,
    /// The motion of a machine stands still more or less often than the reference.
    #[error("not the same standstills")]
    OtherTurns,
    /// The motion of a machine escapes as the reference does, and neither has a standstill before that.
    #[error("escapes with no standstill to compare")]
    NoTurns,
}

impl Reference {
    /// The reference for a motion, that of a `machine` in SI units; method and tolerance of the problem are not looked at.
    /// Fails with [`Reason`] where no two ways of computing it come to an end, or where the machine cannot be followed.
    pub fn of(machine: Option<&Model>, problem: &Problem, limits: &Limits) -> Result<Self> {
        if machine.is_some() {
            let best = Problem { method: Method::Taylor, tolerance: FINEST, ..*problem };
            let found = best.followed(machine, Detail::default(), limits);
            let alone = Self::new(&found, ReferenceSource::Machine)?;
            return Ok(Reference { error: f64::NAN, ..alone });
        }
        let tight = limits.up_to(MOST);
        let run =
            |grain| Self::new(&precise(problem, grain, &tight)?, ReferenceSource::TwicePrecision);
        match run(FINE).and_then(|fine| Ok(fine.checked_by(&run(COARSE)?))) {
            Err(why) if why != Reason::Interrupted => Self::by_two_methods(problem, limits),
            answer => answer,
        }
    }

    fn by_two_methods(problem: &Problem, limits: &Limits) -> Result<Self> {
        let (source, first, second) = if problem.parameters.is_piecewise_linear() {
            (ReferenceSource::ClosedForm, Method::Exact, Method::Taylor)
        } else {
            (ReferenceSource::Implicit, Method::Stiff, Method::Auto)
        };
        let run = |method, tolerance| {
            let question = Problem { method, tolerance, ..*problem };
            Self::new(&trajectory(&question, Detail::default(), limits), source)
        };
        Ok(run(first, TIGHT.0)?.checked_by(&run(second, TIGHT.1)?))
    }

    /// What a method found, as a reference with an error unknown yet; or why it gave up.
    fn new<N>(found: &Motion<N>, source: ReferenceSource) -> Result<Self>
    where
        N: Scalar + Into<Twofold>,
    {
        found.outcome.answered()?;
        let turn = |at: &Crossing<N>| Crossing { tau: at.tau.into(), q: at.q.into() };
        let last = found.outcome.state().map_or(0.0, |(q, _)| q.value());
        let places = found.crossings.iter().map(|turn| turn.q.value());
        let start = Some(found.problem.initial.q).filter(|_| source != ReferenceSource::Machine);
        let places = places.chain(start).chain([last]);
        Ok(Reference {
            turns: found.crossings.iter().map(turn).collect(),
            end: found.outcome.map(N::into),
            source,
            error: 0.0,
            scale: places.map(f64::abs).fold(0.0, f64::max),
            cost: found.cost,
        })
    }

    /// This reference, its own error being how far another computation of it differs.
    fn checked_by(mut self, other: &Self) -> Self {
        self.error = match self.deviation(other) {
            Some(deviation) if deviation.agrees => deviation.error,
            _ => f64::INFINITY,
        };
        self.cost += other.cost;
        self
    }

    /// How far a computed motion is from this one. Fails with [`NoComparison`] where there is no distance.
    pub fn compare(&self, found: &Motion) -> Result<Deviation, NoComparison> {
        let mut other = Self::new(found, self.source).map_err(NoComparison::GaveUp)?;
        // The parameters are those of an oscillator; a motion of a machine has none.
        let without_friction = !self.is_of_machine() && found.problem.parameters.r == 0.0;
        if without_friction && found.crossings.is_empty() {
            // Where nothing happens at turning points they are not located: the ends are compared.
            other.turns.clone_from(&self.turns);
        }
        if self.is_of_machine() && self.turns.len() != other.turns.len() {
            return Err(NoComparison::OtherTurns);
        }
        let escape =
            matches!((self.end, other.end), (Outcome::Escaped { .. }, Outcome::Escaped { .. }));
        if self.is_of_machine() && escape && self.turns.is_empty() {
            // Only displacements count, and there are none.
            return Err(NoComparison::NoTurns);
        }
        self.deviation(&other).ok_or(NoComparison::OtherFate)
    }

    fn is_of_machine(&self) -> bool {
        self.source == ReferenceSource::Machine
    }

    /// How far another motion is from this one, where both escape or neither does.
    fn deviation(&self, other: &Self) -> Option<Deviation> {
        let apart = |one: Twofold, other: Twofold| (one - other).value().abs();
        let ends = self.end.state().zip(other.end.state());
        let besides = match (self.end, other.end) {
            (Outcome::Escaped { tau }, Outcome::Escaped { tau: other }) => apart(tau, other),
            _ => ends.map(|(one, other)| apart(one.1, other.1))?,
        };
        let mut error = ends.map_or(0.0, |(one, other)| apart(one.0, other.0));
        // Of a machine only displacements count.
        if !self.is_of_machine() {
            error = error.max(besides);
        }
        let mut time: f64 = 0.0;
        for index in 0..self.turns.len().max(other.turns.len()) {
            let turns = (self.turns.get(index), other.turns.get(index));
            if let (Some(one), Some(other)) = turns {
                time = time.max(apart(one.tau, other.tau));
            }
            let one = turns.0.map(|turn| turn.q).or(ends.map(|(one, _)| one.0));
            let other = turns.1.map(|turn| turn.q).or(ends.map(|(_, other)| other.0));
            error = error.max(apart(one?, other?));
        }
        if self.is_of_machine() {
            error /= self.scale.max(f64::MIN_POSITIVE);
        }
        let same_kind = std::mem::discriminant(&self.end) == std::mem::discriminant(&other.end);
        let agrees = same_kind && self.turns.len() == other.turns.len();
        Some(Deviation { error, time, agrees })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, State};

    fn problem([d, d2, d3, r]: [f64; 4], q: f64, until: f64) -> Problem {
        Problem {
            parameters: Parameters { d, d2, d3, r },
            initial: State { q, v: 0.0 },
            until,
            ..Problem::default()
        }
    }

    fn run(problem: &Problem) -> Motion {
        trajectory(problem, Detail::default(), &Limits::PATIENT)
    }

    #[test]
    fn the_closed_form_is_right_to_rounding_and_the_reference_knows_it() {
        let question = problem([-0.1, 0.0, 0.0, 0.5], 2.0, 50.0);
        let reference = Reference::of(None, &question, &Limits::PATIENT).unwrap();
        assert_eq!(reference.source, ReferenceSource::TwicePrecision);
        assert!(reference.error < 1e-28 && reference.turns.len() == 3);
        let deviation = reference.compare(&run(&question)).unwrap();
        assert!(deviation.agrees && deviation.error < 1e-15, "{deviation:?}");
        assert!(deviation.error > 0.0, "rounding is seen");
    }

    #[test]
    fn an_error_is_that_of_the_turning_points_and_of_the_end() {
        let question = problem([-0.1, 0.0, 0.05, 0.1], 3.0, 50.0);
        let reference = Reference::of(None, &question, &Limits::PATIENT).unwrap();
        let exact = run(&Problem { tolerance: 1e-14, ..question });
        let mut wrong = exact.clone();
        wrong.crossings[4].q += 1e-3;
        let deviation = reference.compare(&wrong).unwrap();
        assert!((deviation.error - 1e-3).abs() < 1e-12 && deviation.agrees);
        let mut wrong = exact.clone();
        let Outcome::Moving { tau, q, v } = wrong.outcome else { panic!("{:?}", wrong.outcome) };
        wrong.outcome = Outcome::Moving { tau, q, v: v - 1e-3 };
        assert!((reference.compare(&wrong).unwrap().error - 1e-3).abs() < 1e-12);
        // A half swing too many or too few is not a small error.
        let mut wrong = exact.clone();
        wrong.crossings.pop();
        let deviation = reference.compare(&wrong).unwrap();
        assert!(!deviation.agrees && deviation.error > 0.1);
        wrong.outcome = Outcome::Escaped { tau: 20.0 };
        assert_eq!(reference.compare(&wrong), Err(NoComparison::OtherFate));
    }

    #[test]
    fn an_escape_is_compared_by_its_time() {
        let question = problem([0.1, 0.0, -1.0, 0.1], 5.0, 100.0);
        let reference = Reference::of(None, &question, &Limits::PATIENT).unwrap();
        let found = run(&question);
        let deviation = reference.compare(&found).unwrap();
        assert!(deviation.agrees && deviation.error < 1e-9, "{deviation:?}");
        let Outcome::Escaped { tau } = found.outcome else { panic!("{:?}", found.outcome) };
        let late = Motion { outcome: Outcome::Escaped { tau: tau + 0.25 }, ..found };
        assert!((reference.compare(&late).unwrap().error - 0.25).abs() < 1e-9);
    }

    /// Far out cubic damping is stiff: series of any precision would need a hundred million steps.
    #[test]
    fn where_series_take_too_long_two_other_methods_stand_for_them() {
        let question = problem([-0.1, 0.0, 1.0, 0.1], 1e6, 100.0);
        let limits = Limits { evaluations: 100_000, ..Limits::PATIENT };
        let reference = Reference::of(None, &question, &limits).unwrap();
        assert_eq!(reference.source, ReferenceSource::Implicit);
        assert!(reference.error < 1e-5, "of a million: {:e}", reference.error);
        let never = Limits { interrupted: &|| true, ..Limits::PATIENT };
        assert_eq!(Reference::of(None, &question, &never), Err(Reason::Interrupted));
    }
}
