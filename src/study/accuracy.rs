//! What accuracy costs: the same motion by every method and setting, each against a reference.
//!
//! The error of a motion is its largest distance in q from the reference at the reference's arrivals at
//! `v = 0` and at the end time. A method that finds its arrivals is compared arrival by arrival; one that
//! does not is read off at the reference's times. There q is stationary, so that an error of time counts
//! only in the second order, while a swing more or less, or a rest in the wrong place, counts in full.
//! The error of an escape is that of its time.

use crate::flow::method::Dial;
use crate::flow::trajectory::trajectory;
use crate::flow::{
    Cost, Crossing, Detail, Limits, METHODS, Method, Outcome, Problem, Reason, Trajectory,
};

/// Evaluations after which a setting is given up: about a second.
const BUDGET: u64 = 20_000_000;

/// Tolerance of the reference: the smallest there is.
const FINEST: f64 = 1e-15;

/// Methods that confirm a reference: two independent ones that agree are both that good.
const CONFIRMING: [Method; 3] = [Method::Dop853, Method::Dopri5, Method::Stiff];

/// Tolerance of the steps of `smoothed`, so that its error is that of the smoothing.
const SMOOTHED_TOLERANCE: f64 = 1e-8;

/// Tolerances from loose to tight.
const TOLERANCES: [f64; 13] =
    [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15];

/// Lengths of a fixed step from long to short.
const STEPS: [f64; 7] = [0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001];

/// Velocities over which friction is smoothed, from wide to narrow.
const EPSILONS: [f64; 4] = [1e-1, 1e-2, 1e-3, 1e-4];

/// A motion to compare with.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The motion.
    pub motion: Trajectory,
    /// Its own error: rounding for the closed form, else its distance from the nearest of some
    /// independent computations. No error is known better than that.
    pub error: f64,
    /// The method of the nearest.
    pub confirmed_by: Option<Method>,
}

/// One method at one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The motion with this method and setting.
    pub problem: Problem,
    /// How the motion ended.
    pub outcome: Outcome,
    /// Arrivals at `v = 0`, or what the method takes for such.
    pub arrivals: usize,
    /// Its error; `None` where it gave up or ends in another way than the reference.
    pub error: Option<f64>,
    /// What it cost, counted.
    pub cost: Cost,
}

/// Every method over its settings, on one motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// What they are compared with.
    pub reference: Reference,
    /// One row for each, in the order of [`settings`].
    pub rows: Vec<Row>,
}

/// Every method over its settings, on the motion of `problem`.
///
/// # Errors
/// The [`Reason`] why there is no reference, or that the computation was interrupted.
pub fn trade(problem: &Problem, limits: &Limits) -> Result<Trade, Reason> {
    let reference = reference(problem, limits)?;
    let rows = settings(problem).into_iter().map(|setting| row(&reference, &setting, limits));
    Ok(Trade { rows: rows.collect::<Result<_, _>>()?, reference })
}

/// One method at one setting, against the reference.
///
/// # Errors
/// [`Reason::Interrupted`]; all other reasons are in the row.
pub fn row(reference: &Reference, setting: &Problem, limits: &Limits) -> Result<Row, Reason> {
    let motion = trajectory(setting, detail(setting.method), &affordable(limits));
    if let Outcome::GaveUp { reason: Reason::Interrupted, .. } = motion.outcome {
        return Err(Reason::Interrupted);
    }
    Ok(Row {
        problem: *setting,
        outcome: motion.outcome,
        arrivals: motion.crossings.len(),
        error: error(&reference.motion, &motion).map(|error| error.max(reference.error)),
        cost: motion.cost,
    })
}

/// What must be known of a motion by a method for its error: its steps, where no arrivals are found.
#[must_use]
pub fn detail(method: Method) -> Detail {
    Detail { samples_per_step: usize::from(!method.spec().events), ..Detail::default() }
}

/// The limits of one setting.
#[must_use]
pub fn affordable<'a>(limits: &Limits<'a>) -> Limits<'a> {
    Limits { evaluations: limits.evaluations.min(BUDGET), ..*limits }
}

/// The motion to compare with: the closed form where there is one, else the series at the finest
/// tolerance, confirmed by methods of other kinds at their finest.
///
/// # Errors
/// The [`Reason`] why it gave up, or that no other method agrees with it.
pub fn reference(problem: &Problem, limits: &Limits) -> Result<Reference, Reason> {
    let run = |method| {
        let question = Problem { method, tolerance: FINEST, ..*problem };
        let motion = trajectory(&question, Detail::default(), &affordable(limits));
        match motion.outcome {
            Outcome::GaveUp { reason, .. } => Err(reason),
            _ => Ok(motion),
        }
    };
    if problem.parameters.is_piecewise_linear() {
        let motion = run(Method::Exact)?;
        let places = motion.crossings.iter().map(|crossing| crossing.q.abs());
        let error = f64::EPSILON * places.fold(problem.initial.q.abs(), f64::max);
        return Ok(Reference { motion, error, confirmed_by: None });
    }
    let motion = run(Method::Auto)?;
    let mut nearest = None;
    for method in CONFIRMING {
        match run(method) {
            Ok(other) => {
                let apart = error(&motion, &other);
                nearest = [nearest, apart.map(|apart| (apart, method))]
                    .into_iter()
                    .flatten()
                    .min_by(|a, b| a.0.total_cmp(&b.0));
            }
            Err(Reason::Interrupted) => return Err(Reason::Interrupted),
            // Where stability limits explicit methods, the implicit one is left to confirm.
            Err(_) => {}
        }
    }
    match nearest {
        Some((error, method)) => Ok(Reference { motion, error, confirmed_by: Some(method) }),
        None => Err(Reason::NoConvergence { sought: "a reference motion", change: 1.0 }),
    }
}

/// Every method with each of its settings that applies to a motion.
#[must_use]
pub fn settings(problem: &Problem) -> Vec<Problem> {
    let linear = problem.parameters.is_piecewise_linear();
    let mut settings = Vec::new();
    for spec in METHODS {
        let of = Problem { method: spec.method, ..*problem };
        let exact = linear && spec.method == Method::Auto;
        match spec.dial {
            Dial::Nothing if !linear => {}
            Dial::Nothing => settings.push(of),
            Dial::Tolerance if exact => settings.push(of),
            Dial::Tolerance => {
                settings.extend(TOLERANCES.map(|tolerance| Problem { tolerance, ..of }));
            }
            Dial::Step => settings.extend(STEPS.map(|step| Problem { step, ..of })),
            Dial::Epsilon => settings.extend(EPSILONS.map(|epsilon| Problem {
                epsilon,
                tolerance: SMOOTHED_TOLERANCE,
                ..of
            })),
        }
    }
    settings
}

/// The error of a motion; `None` where it gave up or ends in another way than the reference.
///
/// A motion that never rests is compared where the reference rests all the same: in creeping on, it
/// ends in the wrong place, and that is its error.
#[must_use]
pub fn error(reference: &Trajectory, motion: &Trajectory) -> Option<f64> {
    let end = match (reference.outcome, motion.outcome) {
        (Outcome::Escaped { tau: truth }, Outcome::Escaped { tau }) => (tau - truth).abs(),
        (truth, end) => (resting_or_moving(truth)? - resting_or_moving(end)?).abs(),
    };
    let found =
        motion.problem.method.spec().events && motion.crossings.len() == reference.crossings.len();
    let arrivals = reference.crossings.iter().enumerate().map(|(index, truth)| {
        let q = if found { motion.crossings[index].q } else { place(motion, truth.tau) };
        (q - truth.q).abs()
    });
    Some(arrivals.fold(end, f64::max))
}

/// Where a motion is in the end, if it is somewhere.
fn resting_or_moving(outcome: Outcome) -> Option<f64> {
    match outcome {
        Outcome::Captured { q, .. } | Outcome::Moving { q, .. } => Some(q),
        Outcome::Escaped { .. } | Outcome::GaveUp { .. } => None,
    }
}

/// Where a motion is at a time: between its points on the cubic through places and velocities, after
/// its last one where that was.
fn place(motion: &Trajectory, tau: f64) -> f64 {
    let samples = &motion.samples;
    let after = samples.partition_point(|sample| sample.tau < tau);
    let (Some(a), Some(b)) =
        (after.checked_sub(1).and_then(|at| samples.get(at)), samples.get(after))
    else {
        return place_among_arrivals(motion, tau);
    };
    let (h, s) = (b.tau - a.tau, (tau - a.tau) / (b.tau - a.tau));
    let (rise, u) = (b.q - a.q, 1.0 - s);
    a.q + s * (rise + u * (u * (h * a.v - rise) - s * (h * b.v - rise)))
}

/// Where a motion of which only the arrivals are known was last: they differ in number from those of
/// the reference, so that the distance is of the size of the motion.
fn place_among_arrivals(motion: &Trajectory, tau: f64) -> f64 {
    let after = motion.crossings.partition_point(|crossing| crossing.tau <= tau);
    let start = Crossing { tau: 0.0, q: motion.problem.initial.q };
    let last = motion.samples.last().map(|sample| sample.q);
    let arrival = after.checked_sub(1).map_or(start, |at| motion.crossings[at]);
    last.or(resting_or_moving(motion.outcome))
        .filter(|_| after == motion.crossings.len())
        .unwrap_or(arrival.q)
}

/// Which of some choices, given as cost and error, no other beats in both: the front of best choices.
#[must_use]
pub fn front(choices: &[(f64, Option<f64>)]) -> Vec<bool> {
    let best = |&(cost, error): &(f64, Option<f64>)| {
        error.is_some_and(|error| {
            !choices.iter().any(|&(other, theirs)| {
                theirs.is_some_and(|theirs| {
                    other <= cost && theirs <= error && (other < cost || theirs < error)
                })
            })
        })
    };
    choices.iter().map(best).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oscillator::{Parameters, State};

    /// D = -0.1, D3 = 0.05, r = 0.1 from (3, 0) until tau = 200.
    fn w1() -> Problem {
        Problem {
            parameters: Parameters { d: -0.1, d2: 0.0, d3: 0.05, r: 0.1 },
            initial: State { q: 3.0, v: 0.0 },
            until: 200.0,
            ..Problem::default()
        }
    }

    /// D = -0.1, r = 0.5: from (2, 0) it rests at -0.116144 after three half swings.
    fn resting() -> Problem {
        Problem {
            parameters: Parameters { d: -0.1, d2: 0.0, d3: 0.0, r: 0.5 },
            initial: State { q: 2.0, v: 0.0 },
            until: 50.0,
            ..Problem::default()
        }
    }

    fn best(trade: &Trade, method: Method) -> &Row {
        let rows = trade.rows.iter().filter(|row| row.problem.method == method);
        rows.filter(|row| row.error.is_some())
            .min_by(|a, b| a.error.partial_cmp(&b.error).unwrap())
            .unwrap()
    }

    #[test]
    fn the_table_spans_errors_from_a_thousandth_to_rounding() {
        let trade = trade(&w1(), &Limits::default()).unwrap();
        assert!(trade.reference.error < 2e-14, "{:e}", trade.reference.error);
        assert!(trade.rows.iter().any(|row| row.error.is_some_and(|error| error > 1e-3)));
        for method in [Method::Taylor, Method::Auto] {
            assert!(best(&trade, method).error.unwrap() < 1e-13, "{:?}", best(&trade, method));
        }
        // A tenth of the tolerance is never a much larger error.
        for method in [Method::Taylor, Method::Dop853, Method::Dopri5, Method::Stiff] {
            let rows = trade.rows.iter().filter(|row| row.problem.method == method);
            let errors: Vec<f64> = rows.filter_map(|row| row.error).collect();
            assert!(
                errors.windows(2).all(|pair| pair[1] < 2.0 * pair[0] + 1e-13),
                "{method}: {errors:?}"
            );
        }
    }

    #[test]
    fn what_knows_no_events_rests_in_the_wrong_place_or_never() {
        let trade = trade(&resting(), &Limits::default()).unwrap();
        assert!(trade.reference.error < 1e-15);
        let rests = |row: &Row| matches!(row.outcome, Outcome::Captured { .. });
        for row in &trade.rows {
            match row.problem.method {
                Method::Smoothed | Method::SignRk4 => {
                    assert!(!rests(row) && row.error.is_none_or(|error| error > 1e-4), "{row:?}");
                }
                _ => assert!(rests(row) || row.error.is_none(), "{row:?}"),
            }
        }
        assert_eq!(best(&trade, Method::Auto).error, Some(trade.reference.error));
        // Halving epsilon costs twice as much; a digit costs a method of order 20 a few percent.
        let evaluations = |method| {
            let rows = trade.rows.iter().filter(move |row| row.problem.method == method);
            rows.map(|row| row.cost.evaluations).collect::<Vec<_>>()
        };
        let [smoothed, taylor] = [Method::Smoothed, Method::Taylor].map(evaluations);
        assert!(smoothed[3] > 5 * smoothed[2], "{smoothed:?}");
        assert!(taylor[12] < 4 * taylor[2], "{taylor:?}");
    }

    #[test]
    fn an_escape_is_compared_by_its_time() {
        let escaping = Problem {
            parameters: Parameters { d: -0.02, d2: 0.5, d3: 0.0, r: 0.1 },
            initial: State { q: 0.0, v: -3.0 },
            ..Problem::default()
        };
        let trade = trade(&escaping, &Limits::default()).unwrap();
        assert!(matches!(trade.reference.motion.outcome, Outcome::Escaped { .. }));
        assert!(best(&trade, Method::Dop853).error.unwrap() < 1e-10);
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let choices = [
            (1.0, Some(1e-3)),
            (2.0, Some(1e-6)),
            (2.0, Some(1e-5)),
            (3.0, None),
            (4.0, Some(1e-6)),
        ];
        assert_eq!(front(&choices), [true, true, false, false, false]);
    }

    #[test]
    fn an_interrupted_table_says_so() {
        let limits = Limits { interrupted: &|| true, ..Limits::PATIENT };
        assert_eq!(trade(&w1(), &limits), Err(Reason::Interrupted));
    }
}
