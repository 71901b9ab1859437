//! Sections 6.3 and 6.4: the mean shift, and how friction changes the bifurcation.

use std::f64::consts::PI;

use super::certain::BoundedCycle;
use super::harmonic::NO_AMPLITUDE;
use super::known::KnownAnswer;
use super::measure::{
    Known, amplitude, at_rest, beside_proof, captured, cycles, edge, mean, of_cycle, oscillator,
    place, smallest,
};
use super::{Claim, Finding};
use crate::branch::fold::fold;
use crate::closed_form::harmonic::{Harmonic, amplitudes, mean as harmonic_mean};
use crate::flow::Reason;
use crate::model::Parameters;
use crate::numerics::elementary::ln;
use crate::portrait::Border;
use crate::portrait::basin::cycle::cycles as all;

pub const CLAIMS: &[Claim] = &[
    Claim {
        equation: "6.3",
        section: "6.3",
        statement: "the mean displacement goes as the square of the amplitude: exponent",
        basis: "cycle",
        scene: Some("fig14"),
        check: |limits| {
            let at = |d: f64| {
                let parameters = oscillator(d, 0.2, 0.0, 0.01);
                let cycle = smallest(&parameters, limits)?;
                Ok((mean(&parameters, &cycle, limits)?, amplitude(&cycle)))
            };
            let ((small, size), (large, double)) = (at(-0.1)?, at(-0.05)?);
            let exponent = ln(large.value / small.value) / ln(double.value / size.value);
            let error = large.error / large.value.abs() + small.error / small.value.abs();
            let computed = Known::new(exponent, 2.0 * error);
            Ok(Finding::near(2.0, computed).at("D = -0.1 .. -0.05, D2 = 0.2, r = 0.01"))
        },
    },
    Claim {
        equation: "(53)",
        section: "6.3",
        statement: "A_01 = (2 r^2/pi) D2/D, the mean displacement (40) with the amplitude A_1 of (51)",
        basis: "(40, 51)",
        scene: Some("fig14"),
        check: |_| {
            Finding::worst([-0.9, -0.3, -0.01].map(|d| {
                let parameters = oscillator(d, 0.2, 0.5, 0.01);
                let Parameters { d2, r, .. } = parameters;
                let computed = Known::relative(harmonic_mean(d2, -2.0 * r / (PI * d)), 1e-15);
                let finding = Finding::equal(2.0 * r * r / PI * d2 / d, computed);
                Ok(finding.corrected(asymptotes(&parameters)[0]).at(place(&parameters)))
            }))
        },
    },
    Claim {
        equation: "(54)",
        section: "6.3",
        statement: "A_02 = 4 D2 D/(3 D3), the mean displacement (40) with the amplitude A_2 of (52)",
        basis: "(40, 52)",
        scene: Some("fig14"),
        check: |_| {
            Finding::worst([-0.9, -0.3, -0.01].map(|d| {
                let parameters = oscillator(d, 0.2, 0.5, 0.01);
                let amplitude = (-8.0 * d / (3.0 * parameters.d3)).sqrt();
                let computed = Known::relative(harmonic_mean(parameters.d2, amplitude), 1e-15);
                Ok(Finding::equal(asymptotes(&parameters)[1], computed).at(place(&parameters)))
            }))
        },
    },
    Claim {
        equation: "Fig. 14",
        section: "6.3",
        statement: "the shifts by (40) and (42) approach A_01, as it should read, and A_02 as D goes to -1",
        basis: "(40, 42)",
        scene: Some("fig14"),
        check: |_| {
            let shifts = |d: f64| {
                let parameters = oscillator(d, 0.2, 0.5, 0.01);
                let shift = |it: &Harmonic| harmonic_mean(parameters.d2, it.amplitude);
                let [small, large] = asymptotes(&parameters);
                let found = amplitudes(&parameters);
                let by = |it: Option<&Harmonic>| {
                    let shift = it.map(shift).ok_or(NO_AMPLITUDE)?;
                    Ok(Known::relative(shift, 1e-14))
                };
                Ok([(small, by(found.first())?), (large, by(found.last())?)])
            };
            let [far, near] = [shifts(-0.1)?, shifts(-0.9)?];
            let both = [0, 1].map(|which| Ok(Finding::tends(far[which], near[which])));
            Ok(Finding::worst(both)?.at("D = -0.9, D2 = 0.2, D3 = 0.5, r = 0.01"))
        },
    },
    Claim {
        equation: "6.4, Fig. 13",
        section: "6.4",
        statement: "D2 merely distorts the phase portrait: number of cycles, as for D2 = 0, over D",
        basis: "cycle",
        scene: Some("fig13"),
        check: |limits| {
            // Those of Fig. 13 are -0.7 and -0.2.
            let mut cases = Vec::new();
            for d in [-0.9, -0.7, -0.4, -0.2, -0.1, -0.07, -0.02] {
                // The friction of Fig. 13 with the D2 of Fig. 14, the only one that the paper names.
                let with = oscillator(d, 0.2, 0.0, 0.5);
                let without = cycles(&Parameters { d2: 0.0, ..with }, limits)?;
                let found = cycles(&with, limits)?;
                let certain = found.certain && without.certain;
                let same = found.are(without.cycles.len());
                cases.push((place(&with), KnownAnswer { certain, ..same }));
            }
            Ok(Finding::always(cases))
        },
    },
    Claim {
        equation: "6.4",
        section: "6.4",
        statement: "D and D3 decide whether the basin is finite: with D2 as without, for D > 0, D3 = 0",
        basis: "border",
        scene: Some("escape"),
        check: |limits| {
            let mut cases = Vec::new();
            for d2 in [0.2, 1.0] {
                for d in [0.01, 0.1, 0.5] {
                    let parameters = oscillator(d, d2, 0.0, 0.1);
                    cases.push((place(&parameters), edge(&parameters, limits)?.is(Border::None)));
                }
            }
            Ok(Finding::always(cases))
        },
    },
    Claim {
        equation: "6.4",
        section: "6.4",
        statement: "without friction D3 > 0 makes the bifurcation supercritical, D3 < 0 subcritical",
        basis: "cycle",
        scene: Some("hopf"),
        check: |limits| {
            let mut cases = Vec::new();
            for (d, d3, expected) in [
                (-0.1, 0.5, vec![true]),
                (0.1, 0.5, vec![]),
                (-0.1, -0.5, vec![]),
                (0.1, -0.5, vec![false]),
            ] {
                let parameters = oscillator(d, 0.0, d3, 0.0);
                let found = cycles(&parameters, limits)?;
                let as_expected = |found: &[BoundedCycle]| {
                    found.iter().map(|cycle| cycle.stable).eq(expected.iter().copied())
                };
                cases.push((place(&parameters), found.answer(as_expected)));
            }
            Ok(Finding::always(cases))
        },
    },
    Claim {
        equation: "6.4",
        section: "6.4",
        statement: "without friction and D3 there are no cycles, whatever D2",
        basis: "cycle",
        scene: Some("hopf"),
        check: |limits| {
            let mut cases = Vec::new();
            for (d, d2) in [(-0.5, 0.0), (-0.1, 0.0), (-0.5, 0.3), (-0.1, 0.3), (-0.01, 1.0)] {
                let parameters = oscillator(d, d2, 0.0, 0.0);
                let found = beside_proof(&parameters, all(&parameters, false, limits)?.cycles);
                cases.push((place(&parameters), found.are(0)));
            }
            Ok(Finding::always(cases))
        },
    },
    Claim {
        equation: "6.4",
        section: "6.4",
        statement: "with friction the set attracts for all values of D",
        basis: "motion",
        scene: Some("linear"),
        check: |limits| {
            let mut cases = Vec::new();
            for d in [0.5, 0.1, 0.0, -0.5, -0.9, -0.99, -1.0] {
                let parameters = oscillator(d, 0.0, 0.0, 1.0);
                let rests = captured(&parameters, at_rest(1.0 + 1e-10), 100.0, limits)?;
                cases.push((format!("D = {d}"), rests));
            }
            Ok(Finding::always(cases))
        },
    },
    Claim {
        equation: "Fig. 16",
        section: "6.4",
        statement: "the new unstable cycle at D < 0 borders the basin, whatever D2",
        basis: "border",
        scene: Some("fig16"),
        check: |limits| {
            let mut cases = Vec::new();
            for d2 in [0.0, 1.0] {
                for d3 in [-0.5, 0.0, 0.5] {
                    for d in [-0.8, -0.4, -0.05, -0.01] {
                        let parameters = oscillator(d, d2, d3, 0.1);
                        let separatrix = edge(&parameters, limits)?.is(Border::Separatrix);
                        cases.push((place(&parameters), separatrix.is(false)));
                    }
                }
            }
            Ok(Finding::always(cases))
        },
    },
    Claim {
        equation: "Fig. 15",
        section: "6.4",
        statement: "as r goes to 0 the basin shrinks to nothing: its extent",
        basis: "cycle",
        scene: Some("fig15"),
        check: |limits| {
            let extent = |r: f64| {
                let cycle = smallest(&oscillator(-0.3, 0.0, 0.5, r), limits)?;
                Ok((0.0, of_cycle(&cycle, cycle.q_max, |it| it.q_max)))
            };
            Ok(Finding::tends(extent(1e-2)?, extent(1e-6)?)
                .at("q_max at D = -0.3, D3 = 0.5, r = 1e-6"))
        },
    },
    Claim {
        equation: "Fig. 17",
        section: "6.4",
        statement: "as r goes to 0 the fold goes to (0, 0) as r^(2/3): exponent of D_F",
        basis: "cycle",
        scene: Some("fig17"),
        check: |limits| {
            let lost = Reason::NoConvergence { sought: "the fold", change: f64::NAN };
            let place = |r: f64| fold(&oscillator(0.0, 0.0, 0.5, r), limits)?.0.ok_or(lost);
            let (far, near) = (place(1e-3)?.d, place(1e-6)?.d);
            let exponent = ln(far / near) / ln(1e3);
            Ok(Finding::near(2.0 / 3.0, Known::new(exponent, 1e-11))
                .at("D3 = 0.5, r = 1e-6 .. 1e-3"))
        },
    },
    Claim {
        equation: "Fig. 17",
        section: "6.4",
        statement: "as r goes to 0 the crossing Z goes to (0, 0) as r^(1/3): exponent of A_Z",
        basis: "cycle",
        scene: Some("fig17"),
        check: |limits| {
            let size = |r: f64| {
                let cycle = smallest(&oscillator(0.0, 0.0, -0.5, r), limits)?;
                Ok(cycle.q_max)
            };
            let (far, near) = (size(1e-3)?, size(1e-6)?);
            let exponent = ln(far / near) / ln(1e3);
            Ok(Finding::near(1.0 / 3.0, Known::new(exponent, 1e-12))
                .at("D3 = -0.5, r = 1e-6 .. 1e-3"))
        },
    },
];

/// (53), as it should read, and (54).
fn asymptotes(parameters: &Parameters) -> [f64; 2] {
    let Parameters { d, d2, d3, r } = *parameters;
    [-2.0 * r * r * d2 / (PI * PI * d * d), 4.0 * d2 * d / (3.0 * d3)]
}
