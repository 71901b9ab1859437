//! At the extremes of the parameters a margin is that of motions, or there is no answer.

use hopfscope::flow::trajectory::trajectory;
use hopfscope::flow::{Detail, Limits, Outcome, Problem};
use hopfscope::model::{Parameters, State};
use hopfscope::portrait::Border;
use hopfscope::portrait::{Edge, Portrait};
use rayon::prelude::*;

const SIZES: [f64; 11] = [0.0, 1e-150, -1e-150, 1e-12, -1e-12, 1.0, -1.0, 1e6, -1e6, 1e150, -1e150];
const DAMPING: [f64; 9] = [-1.5, -0.9, -0.1, -1e-12, 0.0, 0.148_715_249_821_969_04, 0.5, 1.0, 2.0];
const FRICTION: [f64; 5] = [0.0, 1e-150, 1e-12, 1.0, 1e150];

/// Evaluations of a basin, and of a motion.
const BUDGET: (u64, u64) = (300_000, 20_000);

/// Where a motion from rest ends: `Some(true)` if on the sticking set, `None` if that cannot be told.
fn is_captured(parameters: &Parameters, q: f64) -> Option<bool> {
    let initial = State { q, v: 0.0 };
    let until = f64::MAX;
    let problem = Problem { parameters: *parameters, initial, until, ..Problem::default() };
    let limits = Limits { evaluations: BUDGET.1, ..Limits::PATIENT };
    match trajectory(&problem, Detail::default(), &limits).outcome {
        Outcome::Captured { .. } => Some(true),
        // Positive cubic damping bounds every motion, if by more than there are numbers for.
        Outcome::Escaped { .. } if parameters.d3 > 0.0 => None,
        Outcome::Escaped { .. } => Some(false),
        Outcome::Moving { .. } | Outcome::GaveUp { .. } => None,
    }
}

/// Starts just inside and outside of the border, by how far on each side it is from the end of the sticking set.
fn starts(r: f64, clearance: f64) -> [(f64, bool); 2] {
    /// How near, as a part of the clearance.
    const NEAR: f64 = 1e-6;
    let at = r + clearance;
    let inside = (r + clearance * (1.0 - NEAR)).min(at.next_down());
    let outside = (r + clearance * (1.0 + NEAR)).max(at.next_up());
    [(inside, true), (outside, false)]
}

/// What is wrong with the border at these parameters, if anything; `None` where there is no answer.
fn judged(parameters: &Parameters) -> Option<Result<(), String>> {
    let limits = Limits { evaluations: BUDGET.0, ..Limits::PATIENT };
    let found = Portrait::of_oscillator(parameters, parameters.r, &limits).ok()?;
    let r = parameters.r;
    let mut tried = Vec::new();
    match (found.border, found.borders.first()) {
        (Border::None, _) if r > 0.0 => {
            tried.extend([3.0, 1e3, 1e100, 1e200].map(|far| (r * far, true)));
            tried.extend([1e-100, 1.0, 1e10, 1e100, 1e200, 1e290].map(|far| (r + far, true)));
            tried.extend(tried.clone().iter().map(|(q, inside)| (-q, *inside)));
        }
        (Border::Cycle | Border::Separatrix, Some(Edge::Orbit(border))) => {
            let [left, right] = [&border.upper, &border.lower].map(|arc| arc.clearance().value);
            if left.is_finite() {
                tried.extend(starts(r, left).map(|(q, inside)| (-q, inside)));
            }
            if right.is_finite() {
                tried.extend(starts(r, right));
            }
        }
        _ => {}
    }
    let wrong = tried.into_iter().find(|(q, inside)| {
        q.is_finite() && q.abs() > r && is_captured(parameters, *q).is_some_and(|it| it != *inside)
    });
    Some(match wrong {
        None => Ok(()),
        Some((q, inside)) => {
            let margin = found.margin;
            Err(format!("{parameters:?}: {:?} {margin:?}, from {q:e}: {inside}", found.border))
        }
    })
}

/// Where cycles and separatrices were once passed over, or put elsewhere.
const KNOWN: [[f64; 4]; 5] = [
    [0.148_715_249_821_969_04, 0.0, -1.0, 1e150],
    [-0.1, 0.0, -1.0, 1e150],
    [-0.9, -1e-12, -1.0, 1e150],
    [0.0, -1e-150, -1.0, 1e-150],
    [-0.9, 1.0, 0.0, 1e150],
];

#[test]
fn margins_are_those_of_motions_or_there_is_no_answer() {
    /// Every how many sets one is taken, and the least share of them that has an answer.
    const EVERY: usize = 13;
    const ANSWERED: f64 = 0.6;
    let sets = DAMPING.iter().flat_map(|&d| {
        FRICTION.iter().flat_map(move |&r| {
            SIZES.iter().flat_map(move |&d2| SIZES.map(|d3| Parameters { d, d2, d3, r }))
        })
    });
    let mut sets: Vec<Parameters> = sets.step_by(EVERY).collect();
    sets.extend(KNOWN.map(|[d, d2, d3, r]| Parameters { d, d2, d3, r }));
    let answers: Vec<_> = sets.par_iter().filter_map(judged).collect();
    assert!(answers.len() as f64 >= ANSWERED * sets.len() as f64, "{} answers", answers.len());
    let complaints: Vec<String> = answers.into_iter().filter_map(Result::err).collect();
    assert!(
        complaints.is_empty(),
        "{} of {}:\n{}",
        complaints.len(),
        sets.len(),
        complaints.join("\n")
    );
}

/// Where friction dwarfs all else, quadratic damping drives a kick away once it exceeds friction: `D2 v^2 = r`. No other
/// start that is lost lies nearer to the origin.
#[test]
fn with_huge_friction_the_largest_circle_of_the_basin_ends_where_quadratic_damping_exceeds_it() {
    for r in [1e20_f64, 1e60, 1e100] {
        let parameters = Parameters { d: -0.3, d2: 0.5, d3: 0.0, r };
        let found = Portrait::of_oscillator(&parameters, r, &Limits::PATIENT).unwrap();
        let (radius, kick) = (found.inner_radius().unwrap(), found.margin.impulse.unwrap());
        let exact = (r / parameters.d2).sqrt();
        assert!(radius <= kick, "r = {r:e}: {radius:e} > {kick:e}");
        assert!((radius / exact - 1.0).abs() < 1e-8, "r = {r:e}: {radius:e}, exactly {exact:e}");
    }
}
