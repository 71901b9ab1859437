//! Motions at the limits of floating point and of the equation: each has a typed answer within a budget, and
//! where the answer is also known otherwise, both agree.

use hopfscope::accuracy::extremes::verdict::{BUDGET, METHODS, TOLERANCE};
use hopfscope::accuracy::extremes::{Case, MethodAnswer, MethodsVerdict, cases, judge, named};
use hopfscope::flow::{Limits, Method, Outcome};
use rayon::prelude::*;

/// Cost of one step of any method after the budget is spent: a Taylor series, or a step of the implicit method
/// with all its attempts.
const LAST_STEP: u64 = 2_000;

/// Digits out of ten that a method of this kind may lose on a motion of sixty time units.
fn allowed_loss(method: Method) -> f64 {
    match method {
        // Rounding only, measured in units of the tolerance 1e-10.
        Method::Exact => 0.0,
        // Order 5 takes some thousand steps, each with its own error.
        Method::Dopri5 => 3.0,
        Method::Dop853 => 2.5,
        _ => 1.5,
    }
}

fn is_answer(outcome: &Outcome) -> bool {
    match outcome {
        Outcome::Captured { tau, q } => tau.is_finite() && q.is_finite(),
        Outcome::Moving { tau, q, v } => tau.is_finite() && q.is_finite() && v.is_finite(),
        Outcome::Escaped { tau } | Outcome::GaveUp { tau, .. } => tau.is_finite(),
    }
}

fn complaint(verdict: &MethodsVerdict, answer: &MethodAnswer, extra: f64) -> Option<String> {
    let gave_up = matches!(answer.outcome, Outcome::GaveUp { .. });
    let what = if !is_answer(&answer.outcome) {
        "not a number"
    } else if answer.cost.evaluations > BUDGET + LAST_STEP {
        "more than its budget"
    } else if answer.contradicts && verdict.sensitivity.is_finite() {
        "a contradiction"
    } else if answer
        .digits_lost
        .is_some_and(|lost| lost > allowed_loss(answer.method) + extra + verdict.sensitivity)
    {
        "too many digits lost"
    } else if gave_up && matches!(answer.method, Method::Auto | Method::Exact | Method::Stiff) {
        "gave up, and nothing is too stiff for it"
    } else {
        return None;
    };
    Some(format!(
        "{what}: {answer:?}\n    at {:?}, reference {:?}",
        verdict.case, verdict.reference
    ))
}

fn check(tolerance: f64, extra: f64) {
    let cases: Vec<Case> = cases(false).collect();
    let count = cases.len();
    let verdicts: Vec<MethodsVerdict> =
        cases.into_par_iter().map(|case| judge(&case, tolerance, &Limits::PATIENT)).collect();
    let complaints: Vec<String> = verdicts
        .iter()
        .flat_map(|verdict| {
            verdict.answers.iter().filter_map(|answer| complaint(verdict, answer, extra))
        })
        .collect();
    assert!(
        complaints.is_empty(),
        "{} of {count} motions:\n{}",
        complaints.len(),
        complaints.iter().take(20).cloned().collect::<Vec<_>>().join("\n")
    );
    assert!(verdicts.iter().all(|verdict| verdict.reference.is_some()));
    assert!(verdicts.iter().all(|verdict| verdict.answers.len() + 1 >= METHODS.len()));
}

#[test]
fn every_motion_of_the_lattice_is_answered() {
    check(TOLERANCE, 0.0);
}

#[test]
#[ignore = "long: the lattice at three more tolerances"]
fn every_motion_of_the_lattice_is_answered_to_any_tolerance() {
    for tolerance in [1e-4, 1e-7, 1e-13] {
        // At loose tolerances the error estimate of the implicit method is less reliable.
        check(tolerance, 1.0);
    }
}

#[test]
fn extremes_with_names_end_where_they_must() {
    let all = named(&Limits::PATIENT);
    assert_eq!(all.len(), 39, "six motions that run to infinity by five methods, and nine others");
    for case in all {
        assert!(case.measured <= case.allowed, "{case:?}");
    }
}
