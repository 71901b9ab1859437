//! Section 7 and the end of 6.4: what friction does at small and at large amplitude.

use super::measure::{
    Known, amplitude, at_rest, edge, energy_change, largest, of_cycle, oscillator, place, smallest,
};
use super::{Claim, Finding};
use crate::flow::{Limits, Reason};
use crate::model::Parameters;
use crate::numerics::Interval;
use crate::numerics::elementary::log2;
use crate::portrait::Border;

pub const CLAIMS: &[Claim] = &[
    Claim {
        equation: "after Fig. 17",
        section: "6.4",
        statement: "what viscous damping dissipates goes as the square of the amplitude: exponent",
        basis: "motion",
        scene: None,
        check: |limits| {
            let [_, linear, _] = exponents(limits)?;
            Ok(Finding::near(2.0, linear).at("D = 1e-3, r = 1e-3, from q = 1 and 2"))
        },
    },
    Claim {
        equation: "after Fig. 17",
        section: "6.4",
        statement: "what Coulomb friction dissipates is proportional to the amplitude: exponent",
        basis: "motion",
        scene: None,
        check: |limits| {
            let [_, _, friction] = exponents(limits)?;
            Ok(Finding::near(1.0, friction).at("D = 1e-3, r = 1e-3, from q = 1 and 2"))
        },
    },
    Claim {
        equation: "7",
        section: "7",
        statement: "friction mainly affects small amplitudes: that of the stable cycle tends to what it is for \
                    r = 0 as it grows",
        basis: "cycle",
        scene: Some("supercritical"),
        check: |limits| {
            let at = |d: f64| {
                let parameters = oscillator(d, 0.0, 0.5, 0.1);
                let smooth = largest(&Parameters { r: 0.0, ..parameters }, limits)?;
                Ok((smooth.q_max, amplitude(&largest(&parameters, limits)?)))
            };
            Ok(Finding::tends(at(-0.3)?, at(-0.9)?).at("D = -0.9, D3 = 0.5, r = 0.1"))
        },
    },
    Claim {
        equation: "7",
        section: "7",
        statement: "as r goes to 0 the scenario of the smooth system returns: amplitude of the stable cycle",
        basis: "cycle",
        scene: Some("supercritical"),
        check: |limits| {
            let parameters = oscillator(-0.3, 0.0, 0.5, 1e-3);
            let smooth = largest(&Parameters { r: 0.0, ..parameters }, limits)?.q_max;
            let with = |r: f64| {
                let cycle = largest(&Parameters { r, ..parameters }, limits)?;
                Ok((smooth, of_cycle(&cycle, cycle.q_max, |it| it.q_max)))
            };
            Ok(Finding::tends(with(0.1)?, with(1e-3)?).at(place(&parameters)))
        },
    },
    Claim {
        equation: "7",
        section: "7",
        statement: "for D > 0 the basin is finite or infinite, as nonlinear damping has it: D3 decides",
        basis: "border",
        scene: Some("subcritical"),
        check: |limits| {
            let mut cases = Vec::new();
            for d3 in [-0.5, 0.0, 0.5] {
                for d in [0.01, 0.1, 0.5] {
                    let parameters = oscillator(d, 0.0, d3, 0.1);
                    let infinite = edge(&parameters, limits)?.is(Border::None);
                    cases.push((place(&parameters), infinite.is(d3 >= 0.0)));
                }
            }
            Ok(Finding::always(cases))
        },
    },
    Claim {
        equation: "6.2.2",
        section: "6.2.2",
        statement: "for small D < 0 very little friction stabilises the rest: size of the basin over r",
        basis: "cycle",
        scene: Some("marginal"),
        check: |limits| {
            let size = |d: f64| {
                let parameters = oscillator(d, 0.0, 0.0, 1e-6);
                let cycle = smallest(&parameters, limits)?;
                let size = of_cycle(&cycle, -d * cycle.q_max / parameters.r, |it| {
                    Interval::point(-d) * it.q_max / Interval::point(parameters.r)
                });
                Ok((2.0 / std::f64::consts::PI, size))
            };
            let finding = Finding::tends(size(-1e-2)?, size(-1e-4)?);
            Ok(finding.at("times abs(D), which makes it 2/pi, at D = -1e-4"))
        },
    },
];

/// Exponents with which the energy change and its parts grow when the amplitude is doubled.
fn exponents(limits: &Limits) -> Result<[Known; 3], Reason> {
    let parameters = oscillator(1e-3, 0.0, 0.0, 1e-3);
    let works = |q: f64| energy_change(&parameters, at_rest(q), 2.0 * std::f64::consts::PI, limits);
    let (one, two) = (works(1.0)?, works(2.0)?);
    Ok(std::array::from_fn(|index| {
        let relative = |known: Known| known.error / known.value.abs();
        let error = relative(one[index]) + relative(two[index]);
        Known::new(log2(two[index].value / one[index].value), error)
    }))
}
