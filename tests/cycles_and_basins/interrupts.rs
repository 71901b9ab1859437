//! A superseded computation stops at once: it polls often, and stops when told to.
//!
//! This is counted, not timed: the number of evaluations between two polls is bounded. An evaluation of the
//! field takes about twenty nanoseconds, so ten thousand are well below a millisecond.

use std::sync::atomic::{AtomicU64, Ordering};

use hopfscope::accuracy::harmonic_error::harmonic_balance;
use hopfscope::branch::along::{Points, branch};
use hopfscope::branch::fold::{border, fold};
use hopfscope::flow::trajectory::trajectory;
use hopfscope::flow::{Cost, Detail, Limits, METHODS, Outcome, Problem, Reason};
use hopfscope::model::{Knob, Parameters, State};
use hopfscope::portrait::Portrait;
use hopfscope::portrait::basin::StartWindow;
use hopfscope::portrait::basin::capture::bands;

/// Maximum number of evaluations between two polls.
const BETWEEN: u64 = 10_000;

/// Runs a computation to its end, counting polls, and then repeatedly, interrupted after an increasing number
/// of polls: each time it must stop at that poll.
fn check(what: &str, compute: impl Fn(&Limits) -> (Option<Reason>, Option<Cost>)) {
    let polls = AtomicU64::new(0);
    let count = || {
        polls.fetch_add(1, Ordering::Relaxed);
        false
    };
    // Cases too expensive for a test are cut short.
    let limits = Limits { evaluations: 2_000_000, interrupted: &count };
    let (_, cost) = compute(&limits);
    let whole = polls.load(Ordering::Relaxed);
    assert!(whole > 0, "{what} never asks");
    if let Some(cost) = cost {
        assert!(cost.evaluations <= whole * BETWEEN, "{what}: {whole} polls for {cost:?}");
    }
    let mut after = 1;
    while after <= whole {
        let polls = AtomicU64::new(0);
        let superseded = || polls.fetch_add(1, Ordering::Relaxed) + 1 >= after;
        let limits = Limits { evaluations: 2_000_000, interrupted: &superseded };
        let (reason, cost) = compute(&limits);
        let asked = polls.load(Ordering::Relaxed);
        assert_eq!(reason, Some(Reason::Interrupted), "{what} after {after} of {whole} polls");
        assert!(asked <= after + 2, "{what} goes on after poll {after}: {asked} polls");
        if let Some(cost) = cost {
            assert!(cost.evaluations <= after * BETWEEN, "{what}: {after} polls for {cost:?}");
        }
        after = 3 * after + 1;
    }
}

fn stiff() -> Parameters {
    Parameters { d: -0.1, d2: 0.0, d3: 1e6, r: 0.1 }
}

/// Ordinary, relaxing, escaping, nearly critical and far too stiff parameters.
fn parameters() -> [Parameters; 6] {
    [
        Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 },
        Parameters { d: -3.0, d2: 0.0, d3: 0.5, r: 0.1 },
        Parameters { d: -0.1, d2: 0.5, d3: 0.0, r: 0.1 },
        Parameters { d: -0.999_999, d2: 0.1, d3: 0.1, r: 0.1 },
        Parameters { d: 0.5, d2: 1e6, d3: -1e6, r: 1.0 },
        Parameters { r: 1e-5, ..stiff() },
    ]
}

#[test]
fn motions_stop_by_every_method() {
    for row in METHODS.iter() {
        for (parameters, q) in [(stiff(), 1e6), (parameters()[0], 3.0)] {
            let problem = Problem {
                parameters,
                initial: State { q, v: 0.0 },
                until: 1e5,
                method: row.method,
                step: 1e-5,
                ..Problem::default()
            };
            if row.name == "exact" {
                continue;
            }
            check(row.name, |limits| {
                let limits = Limits { evaluations: 200_000, ..*limits };
                let motion = trajectory(&problem, Detail::default(), &limits);
                let reason = match motion.outcome {
                    Outcome::GaveUp { reason, .. } => Some(reason),
                    _ => None,
                };
                (reason, Some(motion.cost))
            });
        }
    }
}

#[test]
fn cycles_stop() {
    for parameters in parameters() {
        check(&format!("cycles at {parameters:?}"), |limits| {
            match Portrait::of_oscillator(&parameters, 1e3, limits)
                .and_then(|found| found.drawn(&parameters, 12))
            {
                Ok(found) => (None, Some(found.portrait.cost)),
                Err(reason) => (Some(reason), None),
            }
        });
    }
}

#[test]
fn branches_and_borders_stop() {
    for parameters in [parameters()[0], parameters()[2]] {
        check("branch", |limits| {
            match branch(&parameters, Knob::D, (-0.5, -0.05), Points::Even(20), 1e-6, limits) {
                Ok(found) => (None, Some(found.cost)),
                Err(reason) => (Some(reason), None),
            }
        });
        check("border", |limits| match border(&parameters, Knob::D2, (0.0, 0.4), 3, limits) {
            Ok(found) => (None, Some(found.cost)),
            Err(reason) => (Some(reason), None),
        });
    }
}

#[test]
fn a_fold_stops() {
    check("fold", |limits| match fold(&parameters()[0], limits) {
        Ok((_, cost)) => (None, Some(cost)),
        Err(reason) => (Some(reason), None),
    });
}

#[test]
fn basins_stop_however_fine_the_grid() {
    let parameters = parameters()[0];
    let window = StartWindow { q: (-2.0, 2.0), v: (-2.0, 2.0) };
    let counted = |limits: &Limits| {
        let found = Portrait::of_oscillator(&parameters, 2.0, limits)?;
        found.count(&window, (2_000, 50), limits)?;
        Ok(found.cost)
    };
    check("basin", |limits| match counted(limits) {
        Ok(cost) => (None, Some(cost)),
        Err(reason) => (Some(reason), None),
    });
    check("bands of capture", |limits| match bands(&parameters, 10.0, 8, limits) {
        Ok(found) => (None, Some(found.cost)),
        Err(reason) => (Some(reason), None),
    });
    // Every column of the grid polls.
    let polls = AtomicU64::new(0);
    let count = || {
        polls.fetch_add(1, Ordering::Relaxed);
        false
    };
    let limits = Limits { interrupted: &count, ..Limits::PATIENT };
    counted(&limits).unwrap();
    assert!(polls.load(Ordering::Relaxed) >= 2_000);
}

#[test]
fn harmonic_balance_stops() {
    let parameters = parameters()[0];
    check("harmonic balance", |limits| match harmonic_balance(&parameters, 31, 64, limits) {
        Ok(_) => (None, None),
        Err(reason) => (Some(reason), None),
    });
}
