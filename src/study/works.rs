//! Where the energy of a limit cycle comes from and where it goes, by source.
//!
//! Along a motion `V' = -2 D v^2 - D2 v^3 - D3 v^4 - r abs(v)`. Over one turn of a cycle the four works
//! cancel. They are integrals over the arcs with which the cycle is drawn anyway, each with its full
//! relative precision, so that their sum says how well the cycle is closed.

use super::basin::Border;
use crate::flow::step::Powers;
use crate::oscillator::energy::energy;
use crate::oscillator::{Ledger, Parameters, State};

/// The ledger of one turn of a cycle; `residual` is what the works fail to cancel by.
///
/// `None` for a border that is not closed.
#[must_use]
pub fn works(border: &Border, parameters: &Parameters) -> Option<Ledger> {
    let Parameters { d, d2, d3, r } = *parameters;
    let swings = [border.upper.swing.as_ref().ok()?, border.lower.swing.as_ref().ok()?];
    let path: f64 = swings.iter().map(|swing| swing.start.value + swing.end.value).sum();
    let [upper, lower]: [Powers; 2] = [border.upper.powers(), border.lower.powers()];
    let q_max = swings[0].end.value - r;
    let stored = energy(State { q: q_max, v: 0.0 });
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Limits;
    use crate::study::cycle::cycles;

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
