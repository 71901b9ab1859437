//! Section 6.2: stationary amplitudes, the fold, characteristic points and asymptotes.

use std::f64::consts::PI;

use super::harmonic::largest_amplitude;
use super::known::Known;
use super::measure::{
    amplitude, beside_proof, cycles, everywhere, extent, largest, last_cycle, missing, oscillator,
    over, place, smallest, towards,
};
use super::{Check, Evidence};
use crate::branch::fold::fold;
use crate::branch::special::FoldPoint;
use crate::closed_form::harmonic::{self, amplitudes};
use crate::flow::{Limits, Reason};
use crate::model::Parameters;
use crate::numerics::elementary::{cbrt, powi};
use crate::portrait::basin::cycle::cycles as cycles_of;

pub const CHECKS: &[Check] = &[
    ("unstable amplitude", |limits| {
        over(BRANCH.map(both_cycles), |parameters| {
            let cycle = smallest(parameters, limits)?;
            Ok(Evidence::near(amplitudes(parameters)[0].amplitude, amplitude(&cycle)))
        })
    }),
    ("stable amplitude", |limits| {
        over(BRANCH.map(both_cycles), |parameters| {
            let cycle = largest(parameters, limits)?;
            Ok(Evidence::near(largest_amplitude(parameters)?, amplitude(&cycle)))
        })
    }),
    ("discriminant", |_| {
        over(both_sides(), |parameters| {
            let Parameters { d, d3, r, .. } = *parameters;
            let (a, b) = (8.0 * d / (3.0 * d3), 16.0 * r / (3.0 * PI * d3));
            let (cube, square) = (-4.0 * a * a * a, 27.0 * b * b);
            // What is left of the difference of two terms is uncertain by their rounding.
            let error = 32.0 * f64::EPSILON * (cube.abs() + square);
            let computed = Known::new(cube - square, error);
            let scale = powi(16.0 / (3.0 * d3), 2) / 3.0;
            let formula = scale * (-8.0 * d * d * (d / d3) - powi(9.0 / PI, 2) * r * r);
            Ok(Evidence::equal(formula, computed))
        })
    }),
    ("number of roots", |_| {
        everywhere(both_sides(), |parameters| {
            let positive = harmonic::discriminant(parameters).is_some_and(|value| value > 0.0);
            Ok(real_roots(parameters) == if positive { 3 } else { 1 })
        })
    }),
    ("cycles for D3 > 0", |limits| {
        // Up to strong friction, and next to the border, where it matters: r^2 D3 = 1e-3 .. 0.25.
        const PARTS: [f64; 8] = [0.2, 0.8, 0.95, 1.0025, 1.05, 1.3, 2.0, 3.0];
        let cases = [0.1, 0.5, 2.0, 25.0].into_iter().flat_map(|d3| {
            let fold = printed_fold(d3, 0.1);
            PARTS.map(|part| oscillator(part * fold, 0.0, d3, 0.1))
        });
        let between = oscillator(-0.637, 0.0, 0.25, 1.0);
        let cases = std::iter::once(between).chain(cases).filter(|it| it.d.abs() <= 1.0);
        counted(limits, cases, |it| 2 * usize::from(it.d < printed_fold(it.d3, it.r)))
    }),
    ("cycles for D3 < 0", |limits| {
        const DAMPINGS: [f64; 9] = [-1.0, -0.99, -0.75, -0.2, -0.02, 0.0, 0.2, 0.75, 1.0];
        let cases = [-0.1, -0.5, -2.0].map(|d3| DAMPINGS.map(|d| oscillator(d, 0.0, d3, 0.1)));
        counted(limits, cases.into_iter().flatten(), |_| 1)
    }),
    ("cycles for D3 = 0", |limits| {
        let dampings = [-1.0, -0.9, -0.5, -0.1, -1e-3, 0.0, 0.1, 0.5];
        let cases = dampings.map(|d| oscillator(d, 0.0, 0.0, 0.1));
        counted(limits, cases, |it| usize::from(it.d <= 0.0))
    }),
    ("fold", |limits| {
        Evidence::worst(
            [1e-4, 1e-3, 0.01, 0.05, 0.1, 0.25].map(|d3| fold_against(limits, 0.0, d3, 1.0)),
        )
    }),
    ("fold with D2", |limits| {
        Evidence::worst([0.2, 0.5].map(|d2| fold_against(limits, d2, 0.01, 0.1)))
    }),
    ("basin about the fold", |limits| {
        let cases = [0.0, 0.2, 0.5, 1.0].into_iter().flat_map(|d2| [(d2, 0.9), (d2, 1.1)]);
        Evidence::always(cases.map(|(d2, part)| {
            let d = part * printed_fold(0.01, 0.1);
            let found = cycles(&oscillator(d, d2, 0.01, 0.1), limits)?;
            let finite = found.map(|found| !found.is_empty());
            let case = format!("D = {part} D_F, D2 = {d2}, D3 = 0.01, r = 0.1");
            Ok((case, finite.is(part > 1.0)))
        }))
    }),
    ("amplitude at the fold", |limits| {
        Evidence::worst([1e-4, 1e-3, 0.01, 0.05, 0.1, 0.25].map(|d3| {
            let parameters = oscillator(0.0, 0.0, d3, 1.0);
            let found = found_fold(&parameters, limits)?;
            let formula = cbrt(8.0 * parameters.r / (3.0 * PI * parameters.d3));
            // Next to a fold an amplitude is known to the root of what D is.
            let computed = Known::relative(found.q_max, 1e-7);
            Ok(Evidence::near(formula, computed).at(format!("D3 = {d3}, r = 1")))
        }))
    }),
    ("amplitude at D = 0", |limits| {
        let cases = [-0.01, -0.1, -1.0, -10.0, -25.0].map(|d3| oscillator(0.0, 0.0, d3, 0.1));
        over(cases, |parameters| {
            let cycle = smallest(parameters, limits)?;
            let formula = cbrt(-16.0 * parameters.r / (3.0 * PI * parameters.d3));
            Ok(Evidence::near(formula, amplitude(&cycle)))
        })
    }),
    ("A_1 as a root", |_| {
        over([-0.9, -0.4, -0.01].map(|d| oscillator(d, 0.0, 0.0, 0.1)), |parameters| {
            let (d, root) = (parameters.d, largest_amplitude(parameters)?);
            let left = 4.0 * parameters.r / PI + 2.0 * d * root;
            let computed = Known::new(root - left / (2.0 * d), f64::EPSILON * root);
            Ok(Evidence::equal(small(parameters), computed))
        })
    }),
    ("A_1 as an amplitude", |limits| {
        let cases = [-0.9, -0.7, -0.4, -0.1, -0.01].map(|d| oscillator(d, 0.0, 0.0, 0.1));
        over(cases, |parameters| {
            Ok(Evidence::equal(small(parameters), extent(&smallest(parameters, limits)?)))
        })
    }),
    ("A_1 with D3", |limits| {
        over(BRANCH.map(both_cycles), |parameters| {
            Ok(Evidence::near(small(parameters), amplitude(&smallest(parameters, limits)?)))
        })
    }),
    ("A_1 in short", |_| {
        let parameters = oscillator(-1.0, 0.0, 0.0, 1.0);
        Ok(Evidence::near(0.6, Known::relative(largest_amplitude(&parameters)?, 1e-15)))
    }),
    ("divided equation", |_| {
        let parameters = both_cycles(-0.3);
        let Parameters { d, d3, r, .. } = parameters;
        let root = largest_amplitude(&parameters)?;
        let computed = Known::relative(-2.0 * r / (PI * d), 1e-14);
        let terms = |factor: f64| root + factor * d3 / d * powi(root, 3);
        let evidence = Evidence::equal(terms(8.0 / 3.0), computed).corrected(terms(3.0 / 8.0));
        Ok(evidence.at(place(&parameters)))
    }),
    ("A_2", |limits| {
        over(BRANCH.map(both_cycles), |parameters| {
            Ok(Evidence::near(large(parameters), amplitude(&largest(parameters, limits)?)))
        })
    }),
    ("asymptotes for D3 > 0", |_| {
        let smallest = |it: &Parameters| amplitudes(it).first().map(|root| root.amplitude);
        Evidence::worst([
            approached(0.5, -1.0, smallest, small),
            approached(0.5, -1.0, |it| largest_amplitude(it).ok(), large),
        ])
    }),
    ("stability of branches", |limits| {
        everywhere([-0.9, -0.5, -0.3, -0.2].map(both_cycles), |parameters| {
            let found = cycles(parameters, limits)?;
            Ok(found.map(|found| found.iter().map(|cycle| cycle.stable).eq([false, true])))
        })
    }),
    ("stability for D3 < 0", |limits| {
        let cases = [-0.8, -0.3, 0.0, 0.3, 0.8].map(|d| oscillator(d, 0.0, -0.5, 0.1));
        everywhere(cases, |parameters| {
            Ok(cycles(parameters, limits)?.map(|found| found.iter().all(|it| !it.stable)))
        })
    }),
    ("asymptotes for D3 < 0", |_| {
        let solution = |it: &Parameters| largest_amplitude(it).ok();
        Evidence::worst([
            approached(-0.5, -1.0, solution, small),
            approached(-0.5, 1.0, solution, large),
        ])
    }),
];

/// Dampings from a strong one to next to the fold.
const BRANCH: [f64; 6] = [-0.9, -0.7, -0.5, -0.3, -0.2, -0.18];

/// An oscillator with two cycles.
fn both_cycles(d: f64) -> Parameters {
    oscillator(d, 0.0, 0.5, 0.1)
}

/// Linear and cubic dampings on both sides of the fold.
fn both_sides() -> impl Iterator<Item = Parameters> {
    let cubic = [-2.0, -0.5, -0.1, 0.1, 0.5, 2.0];
    let linear = [-0.9, -0.3, -0.1, -0.01, 0.1, 0.5].into_iter();
    linear.flat_map(move |d| cubic.map(|d3| oscillator(d, 0.0, d3, 0.1)))
}

/// How many real roots (42) has: changes of its sign between the places where it turns.
fn real_roots(parameters: &Parameters) -> usize {
    let Parameters { d, d3, r, .. } = *parameters;
    let cubic = |a: f64| 4.0 * r / PI + a * (2.0 * d + 0.75 * d3 * a * a);
    let square = -8.0 * d / (9.0 * d3);
    let turns = if square > 0.0 { vec![-square.sqrt(), square.sqrt()] } else { Vec::new() };
    let far = 1e6;
    let places = [vec![-far], turns, vec![far]].concat();
    places.windows(2).filter(|pair| (cubic(pair[0]) > 0.0) != (cubic(pair[1]) > 0.0)).count()
}

/// The number of cycles at some parameters against what it should be.
fn counted(
    limits: &Limits,
    cases: impl IntoIterator<Item = Parameters>,
    expected: fn(&Parameters) -> usize,
) -> Result<Evidence, Reason> {
    everywhere(cases, |parameters| {
        // The search has nothing to go by where the motion is linear and no swing ends.
        let found = if parameters.omega().is_none() && parameters.is_piecewise_linear() {
            beside_proof(parameters, cycles_of(parameters, limits)?.cycles)
        } else {
            cycles(parameters, limits)?
        };
        Ok(found.map(Vec::len).is(expected(parameters)))
    })
}

fn printed_fold(d3: f64, r: f64) -> f64 {
    -0.5 * cbrt(powi(9.0 / PI, 2) * r * r * d3)
}

/// The fold of the cycles.
pub(crate) fn found_fold(parameters: &Parameters, limits: &Limits) -> Result<FoldPoint, Reason> {
    fold(parameters, limits)?.0.ok_or(missing("the fold"))
}

/// (48) against the fold of the cycles.
fn fold_against(limits: &Limits, d2: f64, d3: f64, r: f64) -> Result<Evidence, Reason> {
    let parameters = oscillator(0.0, d2, d3, r);
    let found = found_fold(&parameters, limits)?;
    let asymmetry = if d2 == 0.0 { String::new() } else { format!("D2 = {d2}, ") };
    let at = format!("{asymmetry}D3 = {d3}, r = {r}");
    Ok(Evidence::near(printed_fold(d3, r), last_cycle(&parameters, found.d, 1e-12)).at(at))
}

/// (51).
fn small(parameters: &Parameters) -> f64 {
    -2.0 * parameters.r / (PI * parameters.d)
}

/// (52).
fn large(parameters: &Parameters) -> f64 {
    (-8.0 * parameters.d / (3.0 * parameters.d3)).sqrt()
}

/// How a solution of (42) approaches a formula as abs(D) grows to 1.
fn approached(
    d3: f64,
    direction: f64,
    solution: impl Fn(&Parameters) -> Option<f64>,
    formula: fn(&Parameters) -> f64,
) -> Result<Evidence, Reason> {
    towards([0.3, 0.95].map(|size| oscillator(direction * size, 0.0, d3, 0.1)), |parameters| {
        let root = solution(parameters).ok_or(missing("a stationary amplitude"))?;
        Ok((formula(parameters), Known::relative(root, 1e-14)))
    })
}
