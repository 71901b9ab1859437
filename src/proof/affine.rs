//! The cycle of the piecewise linear oscillator, enclosed from its closed form (lemma 15).

use super::enclose::Enclosure;
use super::field::ParameterBox;
use crate::numerics::Interval;
use crate::numerics::interval::PI;

/// The only cycle for `D2 = D3 = 0`, `-1 < D < 0`, `r > 0`.
///
/// With `x = pi abs(D)/omega` a half swing ends at the mirror image of its start at the clearance
/// `2 r/(exp(x) - 1)`. Clearance and velocity are written with `exp(-x)`, which does not overflow.
pub fn affine_cycle(parameters: &ParameterBox) -> Option<Enclosure> {
    let ParameterBox { d, r, .. } = *parameters;
    let one = Interval::point(1.0);
    let omega = ((one + d) * (one - d)).sqrt();
    let steepness = -d / omega;
    let x = PI * steepness;
    let rest = -((-x).exp_m1());
    let clearance = r.twice() * (-x).exp() / rest;
    let clearance = clearance.intersection(Interval::new(0.0, f64::INFINITY))?;
    let q_max = clearance + r;
    // The velocity is largest at the angle pi/2 + atan(abs(D)/omega) of the spiral.
    let angle = PI / Interval::point(2.0) + steepness.atan();
    let v_max = r.twice() * (steepness * angle - x).exp() / rest;
    let period = PI.twice() / omega;
    let multiplier = x.twice().exp();
    let known = [q_max, v_max, period].iter().all(|it| it.is_finite());
    known.then(|| Enclosure {
        q_max,
        q_min: -q_max,
        v_max,
        v_min: -v_max,
        period,
        multiplier,
        clearance,
    })
}
