//! How wrong a computed motion is, measured against one that is known better.
//!
//! The better one is the same motion in numbers of twice the working precision
//! ([`crate::flow::precise`]), computed twice with different orders and steps: how far these two differ is
//! its own error, typically `1e-26`, and it is always reported. Where that would take too long (stiff motions,
//! millions of swings) the closed form takes its place, or else an implicit run near rounding; then the
//! difference of a further method from it is taken as its own error, and no smaller error can be measured.

use crate::flow::precise::{self, COARSE, FINE, Precise, precise};
use crate::flow::trajectory::trajectory;
use crate::flow::{Cost, Crossing, Detail, Limits, Method, Outcome, Problem, Reason, Trajectory};
use crate::numerics::twofold::Twofold;

/// Maximum number of evaluations in twice the working precision: about a second.
const MOST: u64 = 1_000_000;

/// Tolerances of the two methods where the motion is too long or too stiff for twice the precision.
const TIGHT: (f64, f64) = (1e-14, 1e-13);

/// A turning point: an arrival at `v = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreciseTurn {
    /// Time.
    pub tau: Twofold,
    /// Displacement.
    pub q: Twofold,
}

/// Where a motion ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// At rest forever.
    Rest {
        /// Displacement.
        q: Twofold,
    },
    /// Still moving at the end time.
    Moving {
        /// Displacement.
        q: Twofold,
        /// Velocity.
        v: Twofold,
    },
    /// The velocity becomes infinite.
    Escape {
        /// The time of it.
        tau: Twofold,
    },
}

/// Where the reference comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Taylor series in twice the working precision, of two orders.
    TwicePrecision,
    /// The closed form for `D2 = D3 = 0`, and a Taylor series beside it.
    ClosedForm,
    /// The implicit method near rounding, and a Taylor series beside it.
    Implicit,
}

/// A motion known better than what is compared with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Every arrival at `v = 0` after the start, the last one included.
    pub turns: Vec<PreciseTurn>,
    /// How it ended.
    pub end: Ending,
    /// Where it comes from.
    pub source: Source,
    /// Its own error: how far two independent computations of it differ.
    pub error: f64,
    /// The largest displacement of a turning point, the start and the end included.
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
    /// Where one motion has more turning points than the other, they are compared with the other's end.
    pub error: f64,
    /// The largest difference of the times of turning points that both have.
    pub time: f64,
    /// Whether the outcome is of the right kind, after the right number of turning points.
    pub agrees: bool,
}

/// Why a motion cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoComparison {
    /// It was given up.
    GaveUp(Reason),
    /// It escapes where the reference does not, or the other way round.
    OtherFate,
}

impl std::fmt::Display for NoComparison {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoComparison::GaveUp(reason) => write!(out, "gave up: {reason}"),
            NoComparison::OtherFate => {
                write!(out, "escapes where the motion does not, or misses it")
            }
        }
    }
}

impl std::error::Error for NoComparison {}

impl Reference {
    /// The reference for a motion; method and tolerance of the problem are not looked at. Fails with [`Reason`]
    /// where no two ways of computing it come to an end.
    pub fn of(problem: &Problem, limits: &Limits) -> Result<Self, Reason> {
        let tight = Limits { evaluations: limits.evaluations.min(MOST), ..*limits };
        let both = precise(problem, FINE, &tight)
            .and_then(|fine| Ok((fine, precise(problem, COARSE, &tight)?)));
        match both {
            Ok((fine, coarse)) => Ok(Self::agreed(problem, &fine, &coarse)),
            Err(Reason::Interrupted) => Err(Reason::Interrupted),
            Err(_) => Self::by_two_methods(problem, limits),
        }
    }

    fn agreed(problem: &Problem, fine: &Precise, coarse: &Precise) -> Self {
        let reference = |found: &Precise| {
            let turns =
                found.turns.iter().map(|mark| PreciseTurn { tau: mark.tau, q: mark.q }).collect();
            let end = match found.end {
                precise::PreciseEnd::Captured(mark) => Ending::Rest { q: mark.q },
                precise::PreciseEnd::Moving(mark) => Ending::Moving { q: mark.q, v: mark.v },
                precise::PreciseEnd::Escaped { tau } => Ending::Escape { tau },
            };
            Self::new(problem, turns, end, Source::TwicePrecision, found.cost)
        };
        reference(fine).checked_by(&reference(coarse))
    }

    fn by_two_methods(problem: &Problem, limits: &Limits) -> Result<Self, Reason> {
        let linear = problem.parameters.is_piecewise_linear();
        let (source, first, second) = if linear {
            (Source::ClosedForm, Method::Exact, Method::Taylor)
        } else {
            (Source::Implicit, Method::Stiff, Method::Auto)
        };
        let run = |method, tolerance| {
            let question = Problem { method, tolerance, ..*problem };
            let found = trajectory(&question, Detail::default(), limits);
            Self::from_doubles(&found, source)
        };
        Ok(run(first, TIGHT.0)?.checked_by(&run(second, TIGHT.1)?))
    }

    /// What a method found, as a reference with an error unknown yet; or why it gave up.
    fn from_doubles(found: &Trajectory, source: Source) -> Result<Self, Reason> {
        let of = Twofold::of;
        let end = match found.outcome {
            Outcome::Captured { q, .. } => Ending::Rest { q: of(q) },
            Outcome::Moving { q, v, .. } => Ending::Moving { q: of(q), v: of(v) },
            Outcome::Escaped { tau } => Ending::Escape { tau: of(tau) },
            Outcome::GaveUp { reason, .. } => return Err(reason),
        };
        let turn = |at: &Crossing| PreciseTurn { tau: of(at.tau), q: of(at.q) };
        let turns = found.crossings.iter().map(turn).collect();
        Ok(Self::new(&found.problem, turns, end, source, found.cost))
    }

    fn new(
        problem: &Problem,
        turns: Vec<PreciseTurn>,
        end: Ending,
        source: Source,
        cost: Cost,
    ) -> Self {
        let last = match end {
            Ending::Rest { q } | Ending::Moving { q, .. } => q.high,
            Ending::Escape { .. } => 0.0,
        };
        let ends = [problem.initial.q, last];
        let places = turns.iter().map(|turn| turn.q.high).chain(ends);
        let scale = places.map(f64::abs).fold(0.0, f64::max);
        Reference { turns, end, source, error: 0.0, scale, cost }
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
    pub fn compare(&self, found: &Trajectory) -> Result<Deviation, NoComparison> {
        let mut other = Self::from_doubles(found, self.source).map_err(NoComparison::GaveUp)?;
        if found.problem.parameters.r == 0.0 && found.crossings.is_empty() {
            // Where nothing happens at turning points they are not located: the ends are compared.
            other.turns.clone_from(&self.turns);
        }
        self.deviation(&other).ok_or(NoComparison::OtherFate)
    }

    /// How far another motion is from this one, where both escape or neither does.
    fn deviation(&self, other: &Self) -> Option<Deviation> {
        let apart = |one: Twofold, other: Twofold| one.minus(other).value().abs();
        let same_end = match (self.end, other.end) {
            (Ending::Escape { tau: one }, Ending::Escape { tau: other }) => Some(apart(one, other)),
            _ => None,
        };
        let at_end = |end| match end {
            Ending::Rest { q } => Some((q, Twofold::of(0.0))),
            Ending::Moving { q, v } => Some((q, v)),
            Ending::Escape { .. } => None,
        };
        let (mut error, rest) = match (at_end(self.end), at_end(other.end)) {
            (Some(one), Some(other)) => {
                (apart(one.0, other.0).max(apart(one.1, other.1)), Some((one.0, other.0)))
            }
            _ => (same_end?, None),
        };
        let mut time: f64 = 0.0;
        for index in 0..self.turns.len().max(other.turns.len()) {
            let (one, other) = (self.turns.get(index), other.turns.get(index));
            if let (Some(one), Some(other)) = (one, other) {
                time = time.max(apart(one.tau, other.tau));
            }
            let place = |turn: Option<&PreciseTurn>, end| turn.map(|turn| turn.q).or(end);
            let one = place(one, rest.map(|rest| rest.0));
            let other = place(other, rest.map(|rest| rest.1));
            error = error.max(apart(one?, other?));
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

    fn run(problem: &Problem) -> Trajectory {
        trajectory(problem, Detail::default(), &Limits::PATIENT)
    }

    #[test]
    fn the_closed_form_is_right_to_rounding_and_the_reference_knows_it() {
        let question = problem([-0.1, 0.0, 0.0, 0.5], 2.0, 50.0);
        let reference = Reference::of(&question, &Limits::PATIENT).unwrap();
        assert_eq!(reference.source, Source::TwicePrecision);
        assert!(reference.error < 1e-28 && reference.turns.len() == 3);
        let deviation = reference.compare(&run(&question)).unwrap();
        assert!(deviation.agrees && deviation.error < 1e-15, "{deviation:?}");
        assert!(deviation.error > 0.0, "rounding is seen");
    }

    #[test]
    fn an_error_is_that_of_the_turning_points_and_of_the_end() {
        let question = problem([-0.1, 0.0, 0.05, 0.1], 3.0, 50.0);
        let reference = Reference::of(&question, &Limits::PATIENT).unwrap();
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
        let reference = Reference::of(&question, &Limits::PATIENT).unwrap();
        let found = run(&question);
        let deviation = reference.compare(&found).unwrap();
        assert!(deviation.agrees && deviation.error < 1e-9, "{deviation:?}");
        let Outcome::Escaped { tau } = found.outcome else { panic!("{:?}", found.outcome) };
        let late = Trajectory { outcome: Outcome::Escaped { tau: tau + 0.25 }, ..found };
        assert!((reference.compare(&late).unwrap().error - 0.25).abs() < 1e-9);
    }

    /// Far out cubic damping is stiff: series of any precision would need a hundred million steps.
    #[test]
    fn where_series_take_too_long_two_other_methods_stand_for_them() {
        let question = problem([-0.1, 0.0, 1.0, 0.1], 1e6, 100.0);
        let limits = Limits { evaluations: 100_000, ..Limits::PATIENT };
        let reference = Reference::of(&question, &limits).unwrap();
        assert_eq!(reference.source, Source::Implicit);
        assert!(reference.error < 1e-5, "of a million: {:e}", reference.error);
        let never = Limits { interrupted: &|| true, ..Limits::PATIENT };
        assert_eq!(Reference::of(&question, &never), Err(Reason::Interrupted));
    }
}
