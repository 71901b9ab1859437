//! How well each method answers a motion of the lattice.

use serde::Serialize;

use super::{Case, UNTIL};
use crate::flow::{Cost, Detail, Limits, Method, Motion, Outcome, Problem, trajectory};
use crate::model::{Parameters, State};
use crate::numerics::log10;

/// Tolerance of the motions where none is given.
pub const TOLERANCE: f64 = 1e-10;

/// Tolerance of the motion with which others are compared, as a fraction of theirs, and at least.
const TIGHTER: (f64, f64) = (1e-4, 1e-15);

/// Maximum number of evaluations that a motion may take.
pub const BUDGET: u64 = 40_000;

/// Maximum number of evaluations that the reference may take.
const REFERENCE_BUDGET: u64 = 200_000;

/// The methods that find events and control their error, `auto` first.
pub const METHODS: [Method; 6] = {
    use Method::{Auto, Dop853, Dopri5, Exact, Stiff, Taylor};
    [Auto, Exact, Taylor, Dop853, Dopri5, Stiff]
};

/// Those of them that serve a motion: `exact` only a piecewise linear one.
pub(super) fn methods(linear: bool) -> impl Iterator<Item = Method> {
    METHODS.into_iter().filter(move |method| linear || *method != Method::Exact)
}

#[derive(Clone, Copy, Debug, Serialize)]
pub struct MethodAnswer {
    /// The method that was asked.
    pub method: Method,
    /// Its answer.
    pub outcome: Outcome,
    /// Digits lost of those that the tolerance asks for; `None` where there is nothing to compare, or
    /// where the answer is of another kind than that of the reference.
    pub digits_lost: Option<f64>,
    /// Whether the answer contradicts the reference.
    pub contradicts: bool,
    pub cost: Cost,
}

/// A motion of the lattice and what the methods answered.
#[derive(Clone, Debug, Serialize)]
pub struct MethodsVerdict {
    /// The motion.
    pub case: Case,
    /// The method of the reference; `None` where no method answered within its budget.
    pub reference: Option<Method>,
    /// Digits by which a relative change of the damping is magnified in the answer: nobody who knows the
    /// damping to the tolerance can ask for these. Infinite where it changes the kind of the answer.
    /// Computed only where some method lost a digit.
    pub sensitivity: f64,
    /// The answers, in the order of [`METHODS`], of the methods that serve these parameters.
    pub answers: Vec<MethodAnswer>,
}

impl MethodsVerdict {
    /// What a method answered, where it serves these parameters.
    pub fn answer(&self, method: Method) -> Option<&MethodAnswer> {
        self.answers.iter().find(|answer| answer.method == method)
    }
}

/// Follows a motion by every method that serves its parameters, to a relative `tolerance`.
pub fn judge(case: &Case, tolerance: f64, limits: &Limits) -> MethodsVerdict {
    let reference = reference(case, tolerance, limits);
    let digits = |distance: f64| log10(distance / tolerance).max(0.0);
    let answers = methods(case.parameters.is_piecewise_linear()).map(|method| {
        let motion = follow(case, method, tolerance, BUDGET, limits);
        let distance = reference.as_ref().and_then(|reference| distance(&motion, reference));
        MethodAnswer {
            method,
            outcome: motion.outcome,
            digits_lost: distance.filter(|distance| distance.is_finite()).map(digits),
            contradicts: distance == Some(f64::INFINITY),
            cost: motion.cost,
        }
    });
    let answers: Vec<MethodAnswer> = answers.collect();
    let worst = answers.iter().filter_map(|answer| answer.digits_lost).fold(0.0, f64::max);
    let sensitivity = match &reference {
        Some(motion) if worst >= 1.0 || answers.iter().any(|answer| answer.contradicts) => {
            let changed = changed(motion, tolerance, limits);
            distance(&changed, motion).map_or(0.0, digits)
        }
        _ => 0.0,
    };
    MethodsVerdict {
        case: *case,
        answers,
        reference: reference.map(|motion| motion.problem.method),
        sensitivity,
    }
}

/// The same motion with all damping changed by this relative amount.
fn changed(motion: &Motion, part: f64, limits: &Limits) -> Motion {
    let Parameters { d, d2, d3, r } = motion.problem.parameters;
    let change = 1.0 + part;
    let parameters = Parameters { d: d * change, d2: d2 * change, d3: d3 * change, r };
    trajectory(&Problem { parameters, ..motion.problem }, Detail::default(), limits)
}

fn follow(case: &Case, method: Method, tolerance: f64, budget: u64, limits: &Limits) -> Motion {
    let problem =
        Problem { method, tolerance, ..Problem::new(case.parameters, case.initial, UNTIL) };
    trajectory(&problem, Detail::default(), &limits.up_to(budget))
}

/// The motion to compare with: the closed form, else a tight motion by the series, else, where that is
/// too stiff, by the implicit method.
fn reference(case: &Case, tolerance: f64, limits: &Limits) -> Option<Motion> {
    let methods: &[Method] = if case.parameters.is_piecewise_linear() {
        &[Method::Exact]
    } else {
        &[Method::Taylor, Method::Stiff]
    };
    let tighter = (TIGHTER.0 * tolerance).max(TIGHTER.1);
    let mut tight =
        methods.iter().map(|&method| follow(case, method, tighter, REFERENCE_BUDGET, limits));
    tight.find(|motion| !matches!(motion.outcome, Outcome::GaveUp { .. }))
}

/// Relative distance of two answers: of places as a fraction of the largest displacement of the last swing, of
/// times relative to themselves. Infinite where they contradict each other, `None` where one gave up.
fn distance(one: &Motion, other: &Motion) -> Option<f64> {
    one.outcome.answered().and(other.outcome.answered()).ok()?;
    if one.outcome.word() != other.outcome.word() {
        return Some(f64::INFINITY);
    }
    let relative = |a: f64, b: f64, unit: f64| if a == b { 0.0 } else { (a - b).abs() / unit };
    let at = other.outcome.tau();
    let time = relative(one.outcome.tau(), at, at);
    let ends = one.outcome.state().zip(other.outcome.state());
    let Some(((q, v), (place, speed))) = ends else { return Some(time) };
    let mut size = place.abs().max(speed.abs());
    if let Outcome::Captured { .. } = other.outcome {
        let before = other.crossings.len().checked_sub(2);
        let State { q, v } = other.problem.initial;
        let last_turn = before.map_or(q, |index| other.crossings[index].q);
        size = size.max(last_turn.abs()).max(v.abs());
    }
    Some(time.max(relative(q, place, size)).max(relative(v, speed, size)))
}
