//! Enclosures of the derivatives of the return map with respect to the clearance and each parameter.

use super::field::{Field, ParameterBox};
use super::swing::{StartBox, swing_with_derivatives};
use crate::model::Side;
use crate::numerics::Interval;

/// Derivatives of the next clearance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// The next clearance.
    pub image: Interval,
    /// With respect to the clearance.
    pub clearance: Interval,
    /// With respect to D.
    pub d: Interval,
    /// With respect to D2.
    pub d2: Interval,
    /// With respect to D3.
    pub d3: Interval,
    /// With respect to r.
    pub r: Interval,
}

/// The return map and its derivatives for all clearances of an interval and all parameters of a box; `None`
/// where a swing is not certain or does not return.
///
/// With the half maps `h` and `H`, `G(z) = H(h(z) - 2 r) - 2 r`. Their derivatives with respect to the
/// coefficients of the field are those of lemma 21, with `a = 2 D`, `b = D2` above `v = 0` and `-D2` below, `c = D3`.
pub fn derivatives(parameters: &ParameterBox, clearance: Interval) -> Option<Derivatives> {
    let gap = parameters.r.twice();
    let zero = Interval::point(0.0);
    let (mut from, mut by) = (clearance, [Interval::point(1.0), zero, zero, zero, zero]);
    for side in [Side::Lower, Side::Upper] {
        let field = Field::new(parameters, side);
        let found = swing_with_derivatives(&field, &StartBox::at_rest(from)).arrived()?;
        let slope = from / found.end * found.divergence.exp();
        let [a, b, c] = found.derivatives?;
        let b = if side == Side::Upper { b } else { -b };
        let own = [zero, a.twice(), b, c, Interval::point(-2.0)];
        for (by, own) in by.iter_mut().zip(own) {
            *by = slope * *by + own;
        }
        from = found.end - gap;
        if !(from.lower() > 0.0) {
            return None;
        }
    }
    let [clearance, d, d2, d3, r] = by;
    let known = by.iter().all(|it| it.is_finite());
    known.then_some(Derivatives { image: from, clearance, d, d2, d3, r })
}

/// The derivatives of a cycle's clearance with respect to D, D2, D3 and r, by the implicit function theorem;
/// `None` where the derivative of the map may be 1.
pub fn cycle_derivatives(parameters: &ParameterBox, clearance: Interval) -> Option<[Interval; 4]> {
    let Derivatives { clearance: slope, d, d2, d3, r, .. } = derivatives(parameters, clearance)?;
    let off = Interval::point(1.0) - slope;
    (!off.contains(0.0)).then(|| [d, d2, d3, r].map(|it| it / off))
}
