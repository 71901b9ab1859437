//! What is known about the number of limit cycles without computing a motion.

use serde::Serialize;

use super::field::ParameterBox;
use crate::numerics::Interval;

/// Why there are no cycles, or only one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Theorem {
    /// The first integral for D2 alone changes monotonically on every motion (lemma 13): no cycle.
    OneWay,
    /// Beyond critical damping nothing holds back a motion that has left the sticking set (lemma 14): no cycle.
    Overdamped,
    /// Half swings are affine maps (lemma 15): one cycle, for `-1 < D < 0` and `r > 0`.
    Affine,
    /// Without friction the field is a single cubic (Lins, de Melo and Pugh 1977): one cycle for `D D3 < 0`.
    Frictionless,
}

/// The theorem that decides the number of cycles, if there is one.
pub fn theorem(parameters: &ParameterBox) -> Option<Theorem> {
    let ParameterBox { d, d2, d3, r } = *parameters;
    let zero = |it: Interval| it == Interval::point(0.0);
    if one_way(d, d3, r) {
        return Some(Theorem::OneWay);
    }
    if d.upper() <= -1.0 && d3.upper() <= 0.0 {
        return Some(Theorem::Overdamped);
    }
    if zero(d2) && zero(d3) {
        return (d.lower() > -1.0 && d.upper() < 0.0 && r.lower() > 0.0).then_some(Theorem::Affine);
    }
    let opposite = d.upper() < 0.0 && d3.lower() > 0.0 || d.lower() > 0.0 && d3.upper() < 0.0;
    (zero(r) && opposite).then_some(Theorem::Frictionless)
}

/// Whether `r + 2 D w + D3 w^3` has one sign for all speeds w (lemma 13).
fn one_way(d: Interval, d3: Interval, r: Interval) -> bool {
    let loses = d.lower() >= 0.0 && d3.lower() >= 0.0;
    let gains = r.upper() == 0.0 && d.upper() <= 0.0 && d3.upper() <= 0.0;
    // Its minimum (at w = 3 r/(4 abs(D)) when it is zero) is positive where 32 abs(D)^3 < 27 r^2 D3.
    let cube = Interval::point(32.0) * (-d) * d.square();
    let loses_yet = d3.lower() > 0.0
        && d.upper() < 0.0
        && (Interval::point(27.0) * r * r * d3 - cube).lower() > 0.0;
    loses || gains || loses_yet
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `r + 2 D w + D3 w^3` for `D = -3/8`, `D3 = 1/4` has its minimum at `w = 1`: `r - 1/2`.
    #[test]
    fn the_first_integral_falls_where_its_rate_has_one_sign() {
        let [d, d2, d3] = [-0.375, 0.2, 0.25].map(Interval::point);
        for (off, decided) in [(1e-12, Some(Theorem::OneWay)), (-1e-12, None)] {
            let r = Interval::point(0.5 * (1.0 + off));
            assert_eq!(theorem(&ParameterBox { d, d2, d3, r }), decided, "{off}");
        }
    }

    /// Each undecided set meets all conditions of a theorem but one.
    #[test]
    fn a_theorem_needs_each_of_its_conditions() {
        for ([d, d2, d3, r], decided) in [
            ([-1.0, 0.3, -1.0, 0.1], Some(Theorem::Overdamped)),
            ([-1.0, 0.3, 0.0, 0.1], Some(Theorem::Overdamped)),
            ([-0.999, 0.3, -1.0, 0.1], None),
            ([-1.0, 0.3, 1e-9, 0.1], None),
            ([-0.2, 0.0, 0.0, 0.1], Some(Theorem::Affine)),
            ([-0.2, 1e-9, 0.0, 0.1], None),
            ([-0.2, 0.0, 1e-9, 0.1], None),
            ([-0.2, 0.3, 0.5, 0.0], Some(Theorem::Frictionless)),
            ([0.2, 0.3, -0.5, 0.0], Some(Theorem::Frictionless)),
            ([-0.2, 0.3, 0.5, 1e-9], None),
            ([0.2, 0.3, -0.5, 1e-9], None),
            // One way: the energy only grows.
            ([-0.2, 0.3, -0.5, 0.0], Some(Theorem::OneWay)),
            ([-0.2, 0.3, -0.5, 1e-9], None),
        ] {
            let [d, d2, d3, r] = [d, d2, d3, r].map(Interval::point);
            assert_eq!(theorem(&ParameterBox { d, d2, d3, r }), decided, "{d} {d2} {d3} {r}");
        }
    }
}
