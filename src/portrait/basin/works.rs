//! Where the energy of a limit cycle comes from and where it goes, by source.
//!
//! Along a motion `V' = -2 D v^2 - D2 v^3 - D3 v^4 - r abs(v)`. Over one turn of a cycle the four works
//! cancel. They are integrals over the arcs with which the cycle is drawn anyway, each with its full
//! relative precision, so that their sum says how well the cycle is closed.

use super::orbit::Orbit;
use crate::flow::Trajectory;
use crate::flow::step::Powers;
use crate::model::energy::energy;
use crate::model::{Ledger, Parameters, State};

/// The ledger of one turn of a cycle; `residual` is what the works fail to cancel by.
///
/// `None` for a border that is not closed.
pub fn works(border: &Orbit, parameters: &Parameters) -> Option<Ledger> {
    let Parameters { d, d2, d3, r } = *parameters;
    let [left, right] = [border.upper.clearance()?.value, border.lower.clearance()?.value];
    let path = 2.0 * (left + right + 2.0 * r);
    let [upper, lower]: [Powers; 2] = [border.upper.powers(), border.lower.powers()];
    let stored = energy(State { q: r + right, v: 0.0 });
    let linear = -2.0 * d * (upper.second + lower.second);
    let quadratic = -d2 * (upper.third - lower.third);
    let cubic = -d3 * (upper.fourth + lower.fourth);
    let friction = -r * path;
    Some(Ledger {
        start: stored,
        end: stored,
        linear,
        quadratic,
        cubic,
        friction,
        residual: -(linear + quadratic + cubic + friction),
    })
}

/// The ledger of a motion from its start until a time, by quadrature over its samples.
///
/// Between two samples the motion is the cubic through both ([`Trajectory::at`]); what its works fail to
/// account for is the residual, as in the ledger of the whole motion, which is exact.
pub fn works_until(motion: &Trajectory, until: f64) -> Option<Ledger> {
    /// Abscissae and weights of Gauss and Legendre's rule on 0 .. 1, exact to degree 5.
    const NODES: [(f64, f64); 3] = [
        (0.112_701_665_379_258_31, 5.0 / 18.0),
        (0.5, 8.0 / 18.0),
        (0.887_298_334_620_741_7, 5.0 / 18.0),
    ];
    let Parameters { d, d2, d3, r } = motion.problem.parameters;
    let now = motion.at(until)?;
    let mut powers = Powers::default();
    let mut path = 0.0;
    let mut before = *motion.samples.first()?;
    for sample in motion.samples.iter().skip(1).chain([&now]) {
        if before.tau >= until {
            break;
        }
        let end = if sample.tau < until { *sample } else { now };
        let h = end.tau - before.tau;
        for (node, weight) in NODES {
            let v = motion.at(before.tau + node * h)?.v;
            let share = weight * h;
            powers.second += share * v * v;
            powers.third += share * v * v * v;
            powers.fourth += share * v * v * v * v;
        }
        path += (end.q - before.q).abs();
        before = end;
    }
    let (start, end) = (energy(motion.problem.initial), energy(State { q: now.q, v: now.v }));
    let (linear, quadratic) = (-2.0 * d * powers.second, -d2 * powers.third);
    let (cubic, friction) = (-d3 * powers.fourth, -r * path);
    let residual = (end - start) - (linear + quadratic + cubic + friction);
    Some(Ledger { start, end, linear, quadratic, cubic, friction, residual })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn works_until_a_time_close_and_end_at_those_of_the_whole_motion() {
        for (d, d2, d3, r, q) in
            [(0.02, 0.1, 0.05, 0.125, 1.5), (-0.3, 0.2, 0.5, 0.1, 0.4), (0.1, 0.0, 0.0, 0.0, 1.0)]
        {
            let problem = Problem {
                parameters: Parameters { d, d2, d3, r },
                initial: State { q, v: 0.0 },
                until: 30.0,
                ..Problem::default()
            };
            let detail = Detail { crossings: r > 0.0, samples_per_step: 16, energy: true };
            let motion = trajectory(&problem, detail, &Limits::PATIENT);
            let whole = motion.ledger.unwrap();
            let largest = [whole.linear, whole.quadratic, whole.cubic, whole.friction]
                .into_iter()
                .fold(0.0, |largest: f64, work| largest.max(work.abs()));
            let mut last = 0.0;
            for part in 0..=40 {
                let found = works_until(&motion, 30.0 * f64::from(part) / 40.0).unwrap();
                assert!(found.residual.abs() < 1e-6 * largest, "{found:?}");
                assert!(found.friction <= last, "friction only takes");
                last = found.friction;
            }
            let end = works_until(&motion, 30.0).unwrap();
            for (found, exact) in [
                (end.linear, whole.linear),
                (end.quadratic, whole.quadratic),
                (end.cubic, whole.cubic),
                (end.friction, whole.friction),
                (end.end, whole.end),
            ] {
                assert!((found - exact).abs() < 1e-6 * largest, "{found} {exact}");
            }
            let start = works_until(&motion, 0.0).unwrap();
            assert_eq!((start.linear, start.friction, start.end), (0.0, 0.0, start.start));
        }
    }
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Limits, Problem};
    use crate::portrait::basin::cycle::cycles;

    #[test]
    fn the_works_over_a_cycle_cancel_to_ten_digits_and_more() {
        for (d, d2, d3, r) in [
            (-0.3, 0.0, 0.5, 0.1),
            (-0.3, 0.2, 0.5, 0.1),
            (-0.2, 0.2, 0.0, 0.5),
            (-0.1, 0.0, -0.5, 0.1),
            (-0.1, 0.0, 0.5, 0.0),
            (-0.4, 0.0, 0.0, 1.0),
            (-0.999, 0.0, 0.0, 1.0),
            (-1e-6, 0.0, 0.0, 0.1),
            (-0.9, -0.3, 2.0, 1e-3),
        ] {
            let parameters = Parameters { d, d2, d3, r };
            let found = cycles(&parameters, true, &Limits::PATIENT).unwrap();
            let ledgers = found.picture.unwrap().works;
            assert_eq!(ledgers.len(), found.cycles.len());
            assert!(!ledgers.is_empty());
            for (cycle, ledger) in found.cycles.iter().zip(ledgers) {
                let Ledger { linear, quadratic, cubic, friction, residual, .. } = ledger;
                let turned = linear.abs().max(cubic.abs()).max(friction.abs());
                assert!((residual / turned).abs() < 1e-12, "{parameters:?}: {ledger:?}");
                assert!(linear > 0.0 || cubic > 0.0, "something feeds the cycle");
                let path = 2.0 * (cycle.q_max - cycle.q_min);
                assert!((friction + r * path).abs() <= 1e-12 * turned);
                let q_max = (2.0 * ledger.start).sqrt();
                assert!((q_max / cycle.q_max - 1.0).abs() < 1e-12);
                // D2 takes on one side what it gives on the other, if the cycle is symmetric.
                assert!(d2 != 0.0 || quadratic == 0.0);
            }
        }
    }
}
