//! All limit cycles for given parameters, proved: their number, and bounds of their characteristics.

pub use super::count::ProvedCycle;
use super::enclose::enclose;
use super::field::ParameterBox;
use super::{Count, ProvedMap, affine_cycle, scaled};
use crate::numerics::{Interval, exponent};

/// Why there are no cycles, or only one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// What is proved about the limit cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// The parameters for all of which it holds.
    pub parameters: ParameterBox,
    /// The theorem that gave the number of cycles without computing motions.
    pub theorem: Option<Theorem>,
    /// The cycles, by amplitude.
    pub cycles: Vec<ProvedCycle>,
    /// Clearances for which nothing is proved. If there are none, there are these cycles and no others.
    pub open: Vec<Interval>,
    /// Number of certified half swings computed.
    pub swings: u32,
}

impl Proof {
    /// Whether the number of cycles is proved.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.open.is_empty()
    }

    /// Why clearances of [`Self::open`] are so.
    #[must_use]
    pub fn why_open(&self, gap: Interval) -> &'static str {
        if gap.upper() == f64::INFINITY {
            "a half swing is too stiff to be enclosed"
        } else if self.parameters.is_point() {
            "the return map comes closer to its diagonal than it can be bounded"
        } else {
            "the number of cycles differs, or may differ, within the parameters' intervals"
        }
    }
}

/// Proves the number of cycles and encloses them; `hints` are clearances near which cycles may lie.
#[must_use]
pub fn prove(parameters: &ParameterBox, hints: &[f64]) -> Proof {
    let (local, unit) = in_own_units(parameters);
    let theorem = theorem(&local);
    let map = ProvedMap::new(&local);
    let Count { mut cycles, open } = counted(theorem, &map);
    for cycle in &mut cycles {
        let ProvedCycle { within, stable, .. } = *cycle;
        let middle = if within.is_finite() { within.middle() } else { 1.0 };
        let mut hints = hints.iter().map(|hint| scaled(Interval::point(*hint), -unit).middle());
        let guess = hints.find(|hint| within.contains(*hint)).unwrap_or(middle);
        let enclosure = match theorem {
            Some(Theorem::Affine) => affine_cycle(&local),
            _ => enclose(&map, guess, within, stable),
        };
        let enclosure = enclosure.filter(|it| it.clearance.intersection(within).is_some());
        cycle.within = scaled(within, unit);
        cycle.enclosure = enclosure.map(|it| it.times_power(unit));
    }
    let open = open.iter().map(|gap| scaled(*gap, unit)).collect();
    Proof { parameters: *parameters, theorem, cycles, open, swings: map.effort.swings.get() }
}

/// Whether each cycle attracts, smallest cycle first, or `None` where their number is not proved; and the
/// integration steps that it took. This costs a part of [`prove`], as no cycle is enclosed.
pub(crate) fn stabilities(parameters: &ParameterBox) -> (Option<Vec<bool>>, u32) {
    let (local, _) = in_own_units(parameters);
    let map = ProvedMap::new(&local);
    let count = counted(theorem(&local), &map);
    let stable = || count.cycles.iter().map(|cycle| cycle.stable).collect();
    (count.open.is_empty().then(stable), map.effort.steps.get())
}

/// The parameters in units of `2^k`, and k: near the limits of the range of doubles, r is scaled to about 1,
/// exactly or as an interval.
fn in_own_units(parameters: &ParameterBox) -> (ParameterBox, i32) {
    let unit = if parameters.r > 0.0 {
        exponent(parameters.r.middle())
    } else {
        0
    };
    let unit = if unit.abs() > 300 { unit } else { 0 };
    (parameters.in_units_of(unit), unit)
}

/// Counts cycles by the theorem, or by the return map.
fn counted(theorem: Option<Theorem>, map: &ProvedMap) -> Count {
    let within = Interval::new(0.0, f64::INFINITY);
    let cycles = |stable| vec![ProvedCycle { within, stable, enclosure: None }];
    let one = |stable| Count { cycles: cycles(stable), open: Vec::new() };
    match theorem {
        Some(Theorem::OneWay | Theorem::Overdamped) => Count::default(),
        Some(Theorem::Affine) => one(false),
        Some(Theorem::Frictionless) => one(map.parameters.d < 0.0),
        None => Count::of(map),
    }
}

/// The theorem that decides the number of cycles, if there is one.
fn theorem(parameters: &ParameterBox) -> Option<Theorem> {
    let ParameterBox { d, d2, d3, r } = *parameters;
    if one_way(d, d3, r) {
        return Some(Theorem::OneWay);
    }
    if d.upper() <= -1.0 && d3.upper() <= 0.0 {
        return Some(Theorem::Overdamped);
    }
    if d2 == 0.0 && d3 == 0.0 {
        return (d > -1.0 && d < 0.0 && r > 0.0).then_some(Theorem::Affine);
    }
    let opposite = d < 0.0 && d3 > 0.0 || d > 0.0 && d3 < 0.0;
    (r == 0.0 && opposite).then_some(Theorem::Frictionless)
}

/// Whether `r + 2 D w + D3 w^3` has one sign for all speeds w (lemma 13).
fn one_way(d: Interval, d3: Interval, r: Interval) -> bool {
    let loses = d.lower() >= 0.0 && d3.lower() >= 0.0;
    let gains = r.upper() == 0.0 && d.upper() <= 0.0 && d3.upper() <= 0.0;
    // Its minimum (at w = 3 r/(4 abs(D)) when it is zero) is positive where 32 abs(D)^3 < 27 r^2 D3.
    let cube = -d * 32.0 * d.square();
    let loses_yet = d3 > 0.0 && d < 0.0 && r * 27.0 * r * d3 - cube > 0.0;
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
