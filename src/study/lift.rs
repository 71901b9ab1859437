//! Sticking sets too small for full precision: the question is asked in larger units.
//!
//! Next to the smallest numbers there are no digits left between a clearance and the friction it is measured
//! by, and differences of them are noise. Motions scale (equation 4), and scaling by a power of two is
//! exact, so the same cycles are found where numbers have all their digits, and brought back.

use super::limit_cycle::{BasinPicture, Cycle, CycleErrors, Cycles};
use crate::closed_form::harmonic::Harmonic;
use crate::numerics::scaling::{exponent, times_power};
use crate::oscillator::{Ledger, Parameters, State};

/// Exponents of r below which it is lifted, and to which: a clearance may be `1e-31 r` or less.
const TOO_SMALL: i32 = -900;
const LIFTED: i32 = -800;

/// The parameters in units in which r has room below it, and the exponent of that unit; `None` where r is
/// large enough, or where other parameters would lose digits in exchange.
pub fn lifted(parameters: &Parameters) -> Option<(Parameters, i32)> {
    if parameters.r == 0.0 || exponent(parameters.r) >= TOO_SMALL {
        return None;
    }
    let unit = LIFTED - exponent(parameters.r);
    let lifted = parameters.times_power(unit);
    (lifted.times_power(-unit) == *parameters).then_some((lifted, unit))
}

impl Cycles {
    /// The same cycles, every length multiplied by `2^unit`.
    pub fn times_power(self, unit: i32) -> Self {
        let harmonic = |it: Harmonic| Harmonic {
            amplitude: times_power(it.amplitude, unit),
            mean: times_power(it.mean, unit),
            ..it
        };
        Cycles {
            parameters: self.parameters.times_power(unit),
            cycles: self.cycles.into_iter().map(|cycle| cycle.times_power(unit)).collect(),
            harmonic: self.harmonic.into_iter().map(harmonic).collect(),
            picture: self.picture.map(|picture| picture.times_power(unit)),
            ..self
        }
    }
}

impl Cycle {
    /// The same cycle, every length multiplied by `2^unit`.
    pub fn times_power(self, unit: i32) -> Self {
        let length = |value| times_power(value, unit);
        Cycle {
            q_min: length(self.q_min),
            q_max: length(self.q_max),
            v_min: length(self.v_min),
            v_max: length(self.v_max),
            clearance: length(self.clearance),
            errors: CycleErrors {
                q_min: length(self.errors.q_min),
                q_max: length(self.errors.q_max),
                v_min: length(self.errors.v_min),
                v_max: length(self.errors.v_max),
                ..self.errors
            },
            log_clearance: self.log_clearance + f64::from(unit) * std::f64::consts::LN_2,
            ..self
        }
    }
}

impl BasinPicture {
    fn times_power(self, unit: i32) -> Self {
        let length = |value| times_power(value, unit);
        let square = |value| length(length(value));
        let point = |state: State| State { q: length(state.q), v: length(state.v) };
        let curve = |curve: Vec<State>| curve.into_iter().map(point).collect();
        let works = |it: Ledger| Ledger {
            start: square(it.start),
            end: square(it.end),
            linear: square(it.linear),
            quadratic: square(it.quadratic),
            cubic: square(it.cubic),
            friction: square(it.friction),
            residual: square(it.residual),
        };
        BasinPicture {
            curves: self.curves.into_iter().map(curve).collect(),
            works: self.works.into_iter().map(works).collect(),
            edge: curve(self.edge),
            margin: self.margin.map(length, length),
            area: self.area.map(square),
            lyapunov_share: self.lyapunov_share,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::cycle::cycles;
    use super::*;
    use crate::flow::Limits;
    use crate::numerics::elementary::{exp_m1, ln};

    /// With r next to nothing the cycles are those of r = 1e-200, scaled.
    #[test]
    fn cycles_around_the_smallest_sticking_sets_are_found_once() {
        for (d, d2, d3) in
            [(-0.1, 0.0, -1.0), (-1e-12, 0.0, 1e6), (-0.1, 0.5, 0.0), (-0.5, 0.3, 1.0)]
        {
            for r in [5e-324, 3e-310, 1e-300, 1e-280] {
                let found = cycles(&Parameters { d, d2, d3, r }, false, &Limits::PATIENT).unwrap();
                // The linear cycle around the sticking set and, with D3 > 0, that of r = 0.
                let expected = if d3 > 0.0 { 2 } else { 1 };
                assert_eq!(found.cycles.len(), expected, "D = {d}, D3 = {d3}, r = {r}");
                let clearance = 2.0 / exp_m1(std::f64::consts::PI * d.abs() / (1.0 - d * d).sqrt());
                let error = found.cycles[0].log_clearance - (ln(r) + ln(clearance));
                assert!(error.abs() < 1e-9, "D = {d}, D3 = {d3}, r = {r}: {error:e}");
            }
        }
    }
}
