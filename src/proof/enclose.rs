//! Enclosure of a limit cycle: existence and uniqueness near a guess by the interval Newton method, then all
//! its characteristics; or all of them from a closed form.

use super::field::ParameterBox;
use super::{HalfMaps, ProvedMap, ProvedSwing, scaled};
use crate::numerics::Interval;
use crate::numerics::interval::PI;
use serde::Serialize;

/// Bounds of the characteristics of one limit cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Enclosure {
    /// Right turning point.
    pub q_max: Interval,
    /// Left turning point.
    pub q_min: Interval,
    /// Largest velocity.
    pub v_max: Interval,
    /// Smallest velocity.
    pub v_min: Interval,
    /// Period.
    pub period: Interval,
    /// Floquet multiplier.
    pub multiplier: Interval,
    /// Clearance `q_max - r`.
    pub clearance: Interval,
}

impl Enclosure {
    /// Every length multiplied by `2^k`.
    #[must_use]
    pub fn times_power(self, k: i32) -> Self {
        let length = |it| scaled(it, k);
        Enclosure {
            q_max: length(self.q_max),
            q_min: length(self.q_min),
            v_max: length(self.v_max),
            v_min: length(self.v_min),
            clearance: length(self.clearance),
            ..self
        }
    }
}

/// Encloses the only cycle with a clearance in `within`, which must exist; `guess` is near it.
///
/// The map is run in the direction in which it contracts: backward for a repelling cycle.
pub fn enclose(map: &ProvedMap, guess: f64, within: Interval, stable: bool) -> Option<Enclosure> {
    /// Radii of the interval Newton method, relative to the guess.
    const RADII: [f64; 6] = [1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2];
    /// Steps of the plain Newton method before it, and the relative change after which the next error is at
    /// rounding level.
    const STEPS: usize = 8;
    const SMALL: f64 = 1e-8;
    let way = if stable { &map.forward } else { &map.backward };
    let mut near = guess;
    for _ in 0..STEPS {
        let next = polished(way, near);
        let change = (next - near).abs();
        near = next;
        if change <= SMALL * near {
            break;
        }
    }
    let around = RADII.into_iter().find_map(|radius| {
        let wide = Interval::around(near, radius * near);
        let inner = newton(way, wide)?;
        let is_inside = inner > wide.lower() && inner < wide.upper();
        is_inside.then_some((inner, radius))
    });
    // The only cycle in an interval lies in each Newton step from there, whether in its interior or not.
    let only = || newton(way, within)?.intersection(within);
    let known = around.map(|(inner, _)| inner);
    let mut clearance = known.or_else(|| only().or(within.is_finite().then_some(within)))?;
    // Over the smallest radius the derivative is as accurate as at a point.
    if !around.is_some_and(|(_, radius)| radius <= RADII[0])
        && let Some(better) = newton(way, clearance)
    {
        clearance = better.intersection(clearance)?;
    }
    describe(map, clearance, stable)
}

/// One step of the interval Newton method. All fixed points in `over` lie in the result; if the result lies in
/// the interior of `over`, there is exactly one.
fn newton(way: &HalfMaps, over: Interval) -> Option<Interval> {
    let middle = Interval::point(over.middle());
    let off = way.image(middle) - middle;
    let slope = way.slope(over)? - 1.0;
    let step = off / slope;
    (step.is_finite() && !slope.contains(0.0)).then(|| middle - step)
}

/// A step of Newton's method in plain numbers.
fn polished(way: &HalfMaps, near: f64) -> f64 {
    let Some((image, slope)) = way.image_and_slope(Interval::point(near)) else { return near };
    let next = near - (image.middle() - near) / (slope.middle() - 1.0);
    if next > 0.5 * near && next < 2.0 * near {
        next
    } else {
        near
    }
}

/// All characteristics of the cycle with this clearance.
fn describe(map: &ProvedMap, clearance: Interval, stable: bool) -> Option<Enclosure> {
    let ProvedMap { parameters: ParameterBox { r, .. }, gap, .. } = *map;
    let way = if stable { &map.forward } else { &map.backward };
    // The clearance of the left turning point.
    let left = way.0[0].image(clearance);
    if !(left > 0.0 && left.is_finite()) {
        return None;
    }
    let [from_right, from_left] = [(&way.0[0], clearance), (&way.0[1], left)]
        .map(|(half, clearance)| half.whole_swing(half.start(clearance)));
    let [below, above] = if stable {
        [from_right, from_left]
    } else {
        [from_left, from_right]
    };
    // The contribution of D2 to the divergence vanishes around a closed curve.
    let cubic = |swing: &ProvedSwing| {
        let c = scaled(scaled(map.parameters.d3, swing.unit), swing.unit);
        c * swing.square * 3.0
    };
    let positive = Interval::new(0.0, f64::INFINITY);
    let (period, multiplier) = match (&below, &above) {
        (Some(below), Some(above)) => {
            let period = below.duration + above.duration;
            let damping = map.parameters.d.twice() * period + cubic(below) + cubic(above);
            let share = |z: Interval| z / (z + gap);
            (period, share(clearance) * share(left) * (-damping).exp())
        }
        _ => (positive, positive),
    };
    let mut multiplier = multiplier.intersection(positive)?;
    // For a stiff cycle it is known more accurately from the map, which contracts.
    if multiplier.contains(1.0)
        && let Some(slope) = way.slope(clearance)
    {
        let over = |bound: f64| Interval::point(1.0) / bound;
        let repelling = Interval::new(over(slope.upper()).lower(), over(slope.lower()).upper());
        let forward = if stable { slope } else { repelling };
        multiplier = multiplier.intersection(forward)?;
    }
    let fastest = |of: Option<ProvedSwing>| of.and_then(|it| it.fastest).unwrap_or(positive);
    Some(Enclosure {
        q_max: clearance + r,
        q_min: -(left + r),
        v_max: fastest(above),
        v_min: -fastest(below),
        period,
        multiplier,
        clearance,
    })
}

/// The only cycle for `D2 = D3 = 0`, `-1 < D < 0`, `r > 0`, from its closed form (lemma 15).
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
    let angle = PI / 2.0 + steepness.atan();
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

#[cfg(test)]
mod tests {
    use super::*;

    fn map(parameters: [f64; 4]) -> ProvedMap {
        let [d, d2, d3, r] = parameters.map(Interval::point);
        ProvedMap::new(&ParameterBox { d, d2, d3, r })
    }

    /// Linear half swings are multiplied by `m = exp(-pi D/sqrt(1 - D^2))`: the cycle is at `2 r/(m - 1)`, its
    /// multiplier is `m^2`.
    #[test]
    fn the_cycle_of_linear_swings_is_held() {
        let one = Interval::point(1.0);
        for (d, r) in [(-0.2, 0.1), (-0.01, 3.0), (-0.6, 1e-3)] {
            let damping = Interval::point(d);
            let m = (-PI * damping / ((one + damping) * (one - damping)).sqrt()).exp();
            let exact = Interval::point(2.0 * r) / (m - one);
            let (at, map) = (exact.middle(), map([d, 0.0, 0.0, r]));
            // For an affine map one step of Newton's method leads there from anywhere.
            let aside = Interval::new(1.02 * at, 1.03 * at);
            for way in [&map.forward, &map.backward] {
                let found = newton(way, aside).unwrap();
                assert!(found.intersection(exact).is_some(), "{d} {r}: {found} {exact}");
            }
            let found = enclose(&map, at, Interval::new(0.9 * at, 1.1 * at), false).unwrap();
            assert!(found.multiplier.intersection(m.square()).is_some(), "{}", found.multiplier);
            assert!(found.multiplier.width() < 1e-9 && found.multiplier.lower() > 1.0);
        }
    }

    /// A guess far off does no harm: Newton's method leaves its neighbourhood, and its result there is rejected.
    #[test]
    fn what_lies_outside_of_the_interval_is_not_believed() {
        let within = Interval::new(0.6, 0.65);
        let found = enclose(&map([-0.2, 0.2, 0.5, 0.1]), 6.2, within, true).unwrap();
        assert!(found.clearance.contains(0.622_333_333_030_272_5), "{}", found.clearance);
    }
}
