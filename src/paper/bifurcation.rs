//! Sections 6.3, 6.4 and 7: the mean shift, how friction changes the bifurcation, and what it does at small and at
//! large amplitude.

use std::f64::consts::PI;

use super::amplitudes::found_fold;
use super::known::{Certain, Known};
use super::measure::{
    amplitude, at_rest, beside_proof, captured, cycles, edge, energy_change, everywhere, extent,
    largest, mean, missing, of_cycle, oscillator, over, smallest, towards,
};
use super::{Check, Evidence};
use crate::closed_form::harmonic::{amplitudes, mean as harmonic_mean};
use crate::flow::{Limits, Reason};
use crate::model::Parameters;
use crate::numerics::elementary::{ln, log2};
use crate::portrait::Border;
use crate::portrait::basin::cycle::cycles as all;

pub const CHECKS: &[Check] = &[
    ("exponent of the mean", |limits| {
        let at = |d: f64| {
            let parameters = oscillator(d, 0.2, 0.0, 0.01);
            let cycle = smallest(&parameters, limits)?;
            Ok((mean(&parameters, &cycle, limits)?, amplitude(&cycle)))
        };
        let ((small, size), (large, double)) = (at(-0.1)?, at(-0.05)?);
        let exponent = ln(large.value / small.value) / ln(double.value / size.value);
        let error = large.error / large.value.abs() + small.error / small.value.abs();
        let computed = Known::new(exponent, 2.0 * error);
        Ok(Evidence::near(2.0, computed).at("D = -0.1 .. -0.05, D2 = 0.2, r = 0.01"))
    }),
    ("A_01", |_| {
        over([-0.9, -0.3, -0.01].map(shifted), |parameters| {
            let Parameters { d, d2, r, .. } = *parameters;
            let computed = Known::relative(harmonic_mean(d2, -2.0 * r / (PI * d)), 1e-15);
            let evidence = Evidence::equal(2.0 * r * r / PI * d2 / d, computed);
            Ok(evidence.corrected(asymptotes(parameters)[0]))
        })
    }),
    ("A_02", |_| {
        over([-0.9, -0.3, -0.01].map(shifted), |parameters| {
            let amplitude = (-8.0 * parameters.d / (3.0 * parameters.d3)).sqrt();
            let computed = Known::relative(harmonic_mean(parameters.d2, amplitude), 1e-15);
            Ok(Evidence::equal(asymptotes(parameters)[1], computed))
        })
    }),
    ("asymptotes of the mean", |_| {
        Evidence::worst([0, 1].map(|which| {
            towards([-0.1, -0.9].map(shifted), |parameters| {
                let found = amplitudes(parameters);
                let solution = [found.first(), found.last()][which];
                let shift = solution.map(|it| harmonic_mean(parameters.d2, it.amplitude));
                let shift = shift.ok_or(missing("a stationary amplitude"))?;
                Ok((asymptotes(parameters)[which], Known::relative(shift, 1e-14)))
            })
        }))
    }),
    ("number of cycles with D2", |limits| {
        // Those of Fig. 13 are -0.7 and -0.2; its friction with the D2 of Fig. 14, the only one that the paper names.
        let dampings = [-0.9, -0.7, -0.4, -0.2, -0.1, -0.07, -0.02];
        everywhere(dampings.map(|d| oscillator(d, 0.2, 0.0, 0.5)), |with| {
            let without = cycles(&Parameters { d2: 0.0, ..*with }, limits)?;
            let found = cycles(with, limits)?;
            let value = found.value.len() == without.value.len();
            Ok(Certain { value, certain: found.certain && without.certain })
        })
    }),
    ("border with D2", |limits| {
        let cases = [0.2, 1.0].map(|d2| [0.01, 0.1, 0.5].map(|d| oscillator(d, d2, 0.0, 0.1)));
        everywhere(cases.into_iter().flatten(), |parameters| {
            Ok(edge(parameters, limits)?.is(Border::None))
        })
    }),
    ("smooth bifurcation", |limits| {
        let cases = [(-0.1, 0.5), (0.1, 0.5), (-0.1, -0.5), (0.1, -0.5)];
        everywhere(cases.map(|(d, d3)| oscillator(d, 0.0, d3, 0.0)), |parameters| {
            // One that attracts where the steady state does not, and the other way round.
            let Parameters { d, d3, .. } = *parameters;
            let expected = (d * d3 < 0.0).then_some(d3 > 0.0);
            let found = cycles(parameters, limits)?;
            Ok(found.map(|found| found.iter().map(|cycle| cycle.stable).eq(expected)))
        })
    }),
    ("smooth motion without D3", |limits| {
        let cases = [(-0.5, 0.0), (-0.1, 0.0), (-0.5, 0.3), (-0.1, 0.3), (-0.01, 1.0)];
        everywhere(cases.map(|(d, d2)| oscillator(d, d2, 0.0, 0.0)), |parameters| {
            let found = beside_proof(parameters, all(parameters, limits)?.cycles);
            Ok(found.map(Vec::is_empty))
        })
    }),
    ("attraction of the set", |limits| {
        Evidence::always([0.5, 0.1, 0.0, -0.5, -0.9, -0.99, -1.0].map(|d| {
            let parameters = oscillator(d, 0.0, 0.0, 1.0);
            let rests = captured(&parameters, at_rest(1.0 + 1e-10), 100.0, limits)?;
            Ok((format!("D = {d}"), rests))
        }))
    }),
    ("cycle as the border", |limits| {
        let nonlinear = [0.0, 1.0].map(|d2| [-0.5, 0.0, 0.5].map(|d3| (d2, d3)));
        let cases = nonlinear
            .into_iter()
            .flatten()
            .flat_map(|(d2, d3)| [-0.8, -0.4, -0.05, -0.01].map(|d| oscillator(d, d2, d3, 0.1)));
        everywhere(cases, |it| Ok(edge(it, limits)?.is(Border::Separatrix).is(false)))
    }),
    ("vanishing basin", |limits| {
        let cases = [1e-2, 1e-6].map(|r| oscillator(-0.3, 0.0, 0.5, r));
        let extents = |it: &Parameters| Ok((0.0, extent(&smallest(it, limits)?)));
        Ok(towards(cases, extents)?.at("q_max at D = -0.3, D3 = 0.5, r = 1e-6"))
    }),
    ("exponent of the fold", |limits| {
        let place = |r: f64| found_fold(&oscillator(0.0, 0.0, 0.5, r), limits);
        let (far, near) = (place(1e-3)?.d, place(1e-6)?.d);
        let exponent = ln(far / near) / ln(1e3);
        Ok(Evidence::near(2.0 / 3.0, Known::new(exponent, 1e-11)).at("D3 = 0.5, r = 1e-6 .. 1e-3"))
    }),
    ("exponent of A_Z", |limits| {
        let crossing = |r: f64| smallest(&oscillator(0.0, 0.0, -0.5, r), limits);
        let (far, near) = (crossing(1e-3)?.q_max, crossing(1e-6)?.q_max);
        let exponent = ln(far / near) / ln(1e3);
        Ok(Evidence::near(1.0 / 3.0, Known::new(exponent, 1e-12)).at("D3 = -0.5, r = 1e-6 .. 1e-3"))
    }),
    ("work of damping", |limits| {
        let [_, linear, _] = exponents(limits)?;
        Ok(Evidence::near(2.0, linear).at("D = 1e-3, r = 1e-3, from q = 1 and 2"))
    }),
    ("work of friction", |limits| {
        let [_, _, friction] = exponents(limits)?;
        Ok(Evidence::near(1.0, friction).at("D = 1e-3, r = 1e-3, from q = 1 and 2"))
    }),
    ("large amplitudes", |limits| {
        towards([-0.3, -0.9].map(|d| oscillator(d, 0.0, 0.5, 0.1)), |parameters| {
            let smooth = largest(&Parameters { r: 0.0, ..*parameters }, limits)?;
            Ok((smooth.q_max, amplitude(&largest(parameters, limits)?)))
        })
    }),
    ("vanishing friction", |limits| {
        towards([0.1, 1e-3].map(|r| oscillator(-0.3, 0.0, 0.5, r)), |parameters| {
            let smooth = largest(&Parameters { r: 0.0, ..*parameters }, limits)?;
            Ok((smooth.q_max, extent(&largest(parameters, limits)?)))
        })
    }),
    ("border for D > 0", |limits| {
        let cases =
            [-0.5, 0.0, 0.5].map(|d3| [0.01, 0.1, 0.5].map(|d| oscillator(d, 0.0, d3, 0.1)));
        everywhere(cases.into_iter().flatten(), |parameters| {
            Ok(edge(parameters, limits)?.is(Border::None).is(parameters.d3 >= 0.0))
        })
    }),
    ("little friction", |limits| {
        let cases = [-1e-2, -1e-4].map(|d| oscillator(d, 0.0, 0.0, 1e-6));
        let evidence = towards(cases, |parameters| {
            let Parameters { d, r, .. } = *parameters;
            let cycle = smallest(parameters, limits)?;
            Ok((2.0 / PI, of_cycle(&cycle, -d * cycle.q_max / r, |it| it.q_max * -d / r)))
        })?;
        Ok(evidence.at("times abs(D), which makes it 2/pi, at D = -1e-4"))
    }),
];

/// An oscillator whose cycles are shifted.
fn shifted(d: f64) -> Parameters {
    oscillator(d, 0.2, 0.5, 0.01)
}

/// (53), as it should read, and (54).
fn asymptotes(parameters: &Parameters) -> [f64; 2] {
    let Parameters { d, d2, d3, r } = *parameters;
    [-2.0 * r * r * d2 / (PI * PI * d * d), 4.0 * d2 * d / (3.0 * d3)]
}

/// Exponents with which the energy change and its parts grow when the amplitude is doubled.
fn exponents(limits: &Limits) -> Result<[Known; 3], Reason> {
    let parameters = oscillator(1e-3, 0.0, 0.0, 1e-3);
    let works = |q: f64| energy_change(&parameters, at_rest(q), 2.0 * PI, limits);
    let (one, two) = (works(1.0)?, works(2.0)?);
    Ok(std::array::from_fn(|index| {
        let relative = |known: Known| known.error / known.value.abs();
        let error = relative(one[index]) + relative(two[index]);
        Known::new(log2(two[index].value / one[index].value), error)
    }))
}
