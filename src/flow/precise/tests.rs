//! The precise method against closed forms and against itself.

use super::super::{Method, Outcome};
use super::*;
use crate::model::{Parameters, State};
use crate::numerics::twofold::PI;

fn problem([d, d2, d3, r]: [f64; 4], q: f64, until: f64) -> Problem {
    Problem {
        parameters: Parameters { d, d2, d3, r },
        initial: State { q, v: 0.0 },
        until,
        method: Method::Auto,
        ..Problem::default()
    }
}

fn apart(one: Twofold, other: Twofold) -> f64 {
    (one - other).value().abs()
}

#[test]
fn without_damping_each_half_swing_takes_pi_and_two_r_to_thirty_digits() {
    let found = precise(&problem([0.0, 0.0, 0.0, 0.125], 3.0, 60.0), FINE, &Limits::PATIENT);
    let found = found.unwrap();
    assert_eq!(found.crossings.len(), 12);
    for (index, turn) in (0_i32..).zip(&found.crossings) {
        let place = (2.75 - 0.25 * f64::from(index)) * if index % 2 == 0 { -1.0 } else { 1.0 };
        assert!(apart(turn.q, Twofold::from(place)) < 1e-28, "{turn:?}");
        assert!(apart(turn.tau, PI.times(f64::from(index + 1))) < 1e-28, "{turn:?}");
    }
    let last = found.crossings[11];
    assert_eq!(found.outcome, Outcome::Captured { tau: last.tau, q: last.q });
}

/// `D = 2 sqrt(2)/3` would make `omega = 1/3` but is not a double. The test therefore uses the ratio of two
/// successive half swings about the shifted centre, which is the same each time.
#[test]
fn linear_half_swings_shrink_by_one_and_the_same_factor() {
    let r = 0.25;
    let found = precise(&problem([-0.3, 0.0, 0.0, r], 1.0, 40.0), FINE, &Limits::PATIENT);
    let found = found.unwrap();
    let ratio = |before: Twofold, after: Twofold| {
        // From q0 > r to q1: q1 - r = -(q0 - r) e^x in magnitudes, mirrored each time.
        let size = |q: Twofold| if q.high < 0.0 { -q } else { q };
        let r = Twofold::from(r);
        (size(after) + r) / (size(before) - r)
    };
    let ratios: Vec<_> =
        found.crossings.windows(2).map(|pair| ratio(pair[0].q, pair[1].q)).collect();
    assert!(ratios.len() > 8);
    for other in &ratios[1..] {
        assert!(apart(*other, ratios[0]) < 1e-27, "{other:?} {:?}", ratios[0]);
    }
}

#[test]
fn two_grains_agree_to_many_more_digits_than_a_double_has() {
    for (parameters, q, until) in [
        ([-0.1, 0.0, 0.05, 0.1], 3.0, 200.0),
        ([-0.2, 0.2, 0.5, 0.1], 0.5, 100.0),
        ([0.3, -0.4, 2.0, 0.01], 50.0, 30.0),
        ([-0.1, 0.0, 0.05, 1e-200], 3e-200, 20.0),
    ] {
        let question = problem(parameters, q, until);
        let [fine, coarse] =
            [FINE, COARSE].map(|grain| precise(&question, grain, &Limits::PATIENT).unwrap());
        assert_eq!(fine.crossings.len(), coarse.crossings.len());
        assert!(!fine.crossings.is_empty() && fine.cost.steps < coarse.cost.steps);
        for (one, other) in fine.crossings.iter().zip(&coarse.crossings) {
            assert!(apart(one.q, other.q) < 1e-24 * q.max(1e-200), "{one:?} {other:?}");
        }
    }
}

/// `v' = v^3` from v0 blows up after `1/(2 v0^2)` where all else is small.
#[test]
fn an_escape_has_its_time() {
    let start = State { q: 0.0, v: 1e9 };
    let question = Problem { initial: start, ..problem([0.0, 0.0, -1.0, 0.0], 0.0, 1.0) };
    let found = precise(&question, FINE, &Limits::PATIENT).unwrap();
    let Outcome::Escaped { tau } = found.outcome else { panic!("{found:?}") };
    assert!((tau.value() / 5e-19 - 1.0).abs() < 1e-15, "{tau:?}");
}

#[test]
fn a_rest_stays_and_a_budget_is_kept() {
    let rest = precise(&problem([-0.1, 0.0, 0.0, 0.5], 0.5, 9.0), FINE, &Limits::PATIENT);
    assert!(
        matches!(rest.unwrap().outcome, Outcome::Captured { q, .. } if q == Twofold::from(0.5))
    );
    let limits = Limits { evaluations: 1000, ..Limits::PATIENT };
    let stiff = precise(&problem([0.0, 0.0, 1.0, 0.1], 1e6, 1e4), FINE, &limits);
    assert!(matches!(stiff, Err(Reason::Budget { .. })));
}
