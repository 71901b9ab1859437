//! Sections 6.3, 6.4 and 7: the mean shift, how friction changes the bifurcation, and what it does at small and at
//! large amplitude.

use std::f64::consts::PI;

use super::harmonic::{approached, found_fold, large, small};
use super::{Approximation, Check, ClaimCase, Conclusion, Evidence, always, at_rest, tends, worst};
use crate::closed_form::mean as harmonic_mean;
use crate::flow::Result;
use crate::model::Parameters;
use crate::numerics::{ln, log2};
use crate::portrait::{Border, cycles};

pub(super) const CHECKS: &[Check] = &[
    worst("exponent of the mean", |it| {
        let at = |d: f64| {
            let it = it.of(Parameters { d, ..**it });
            let cycle = it.smallest()?;
            Ok((it.mean(&cycle)?, cycle.amplitude()))
        };
        let ((small, size), (large, double)) = (at(-0.1)?, at(-0.05)?);
        let exponent = ln(large.value / small.value) / ln(double.value / size.value);
        let error = large.error / large.value.abs() + small.error / small.value.abs();
        Ok(Evidence::near(2.0, Approximation::new(exponent, 2.0 * error)))
    }),
    worst("A_01", |it| {
        let Parameters { d, d2, r, .. } = **it;
        let computed = Approximation::relative(harmonic_mean(d2, small(it)), 1e-15);
        let evidence = Evidence::equal(2.0 * r * r / PI * d2 / d, computed);
        Ok(evidence.corrected(asymptotes(it)[0]))
    }),
    worst("A_02", |it| {
        let computed = Approximation::relative(harmonic_mean(it.d2, large(it)), 1e-15);
        Ok(Evidence::equal(asymptotes(it)[1], computed))
    }),
    tends("asymptotes of the mean", |it| {
        let (formula, root) = approached(it, asymptotes(it))?;
        Ok((formula, Approximation::relative(harmonic_mean(it.d2, root), 1e-14)))
    }),
    // Of the dampings, those of Fig. 13 are -0.7 and -0.2; its friction with the D2 of Fig. 14, the only one that the paper
    // names.
    always("number of cycles with D2", |it| {
        let without = it.of(Parameters { d2: 0.0, ..**it }).cycles()?;
        let found = it.cycles()?;
        let value = found.value.len() == without.value.len();
        Ok(Conclusion { value, certain: found.certain && without.certain })
    }),
    always("border with D2", |it| Ok(it.edge()?.is(Border::None))),
    always("smooth bifurcation", |it| {
        // One that attracts where the steady state does not, and the other way round.
        let expected = (it.d * it.d3 < 0.0).then_some(it.d3 > 0.0);
        Ok(it.cycles()?.map(|found| found.iter().map(|cycle| cycle.stable).eq(expected)))
    }),
    always("smooth motion without D3", |it| {
        let found = it.beside_proof(cycles(it, &it.limits)?.cycles);
        Ok(found.map(Vec::is_empty))
    }),
    always("attraction of the set", |it| it.captured(at_rest(it.r + 1e-10), 100.0)),
    always("cycle as the border", |it| Ok(it.edge()?.is(Border::Separatrix).is(false))),
    tends("vanishing basin", |it| Ok((0.0, it.smallest()?.extent()))),
    worst("exponent of the fold", |it| {
        let place = |r: f64| found_fold(&it.of(Parameters { r, ..**it }));
        let exponent = ln(place(1e-3)?.d / place(1e-6)?.d) / ln(1e3);
        Ok(Evidence::near(2.0 / 3.0, Approximation::new(exponent, 1e-11)))
    }),
    worst("exponent of A_Z", |it| {
        let crossing = |r: f64| it.of(Parameters { r, ..**it }).smallest();
        let exponent = ln(crossing(1e-3)?.q_max / crossing(1e-6)?.q_max) / ln(1e3);
        Ok(Evidence::near(1.0 / 3.0, Approximation::new(exponent, 1e-12)))
    }),
    worst("work of damping", |it| Ok(Evidence::near(2.0, exponents(it)?[1]))),
    worst("work of friction", |it| Ok(Evidence::near(1.0, exponents(it)?[2]))),
    tends("large amplitudes", |it| Ok((smooth(it)?, it.largest()?.amplitude()))),
    tends("vanishing friction", |it| Ok((smooth(it)?, it.largest()?.extent()))),
    always("border for D > 0", |it| Ok(it.edge()?.is(Border::None).is(it.d3 >= 0.0))),
    tends("little friction", |it| {
        let Parameters { d, r, .. } = **it;
        let cycle = it.smallest()?;
        Ok((2.0 / PI, cycle.known(-d * cycle.q_max / r, |it| it.q_max * -d / r)))
    }),
];

/// (53), as it should read, and (54).
fn asymptotes(parameters: &Parameters) -> [f64; 2] {
    let Parameters { d, d2, d3, r } = *parameters;
    [-2.0 * r * r * d2 / (PI * PI * d * d), 4.0 * d2 * d / (3.0 * d3)]
}

/// The extent of the largest cycle without friction.
fn smooth(it: &ClaimCase) -> Result<f64> {
    Ok(it.of(Parameters { r: 0.0, ..**it }).largest()?.q_max)
}

/// Exponents with which the energy change and its parts grow when the amplitude is doubled.
fn exponents(it: &ClaimCase) -> Result<[Approximation; 3]> {
    let works = |q: f64| it.energy_change(q, 2.0 * PI);
    let (one, two) = (works(1.0)?, works(2.0)?);
    Ok(std::array::from_fn(|index| {
        let relative = |known: Approximation| known.error / known.value.abs();
        let error = relative(one[index]) + relative(two[index]);
        Approximation::new(log2(two[index].value / one[index].value), error)
    }))
}
