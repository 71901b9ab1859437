//! Random kicks: what fraction of them is lost.
//!
//! A kick displaces the mass from its rest at the origin and gives it a velocity; both are random, independent
//! and normal or uniform. What is lost is an integral of their density over the exact basin, whose border is a
//! graph over the displacement ([`super::basin::arc`]): no start is drawn or followed.

pub(crate) mod repeated;

pub use self::repeated::{Survival, repeated};

use std::f64::consts::{PI, SQRT_2};
use std::fmt;

use serde::{Deserialize, Serialize};

use super::{Edge, Portrait, Share, over_scales, support};
use crate::flow::{Reason, Result};
use crate::model::{Border, in_one_unit};
use crate::numerics::{Integral, erfc, exp, named};

/// How a random number is spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Distribution {
    /// Normal; the spread is the standard deviation.
    Normal,
    /// Evenly within the spread on either side.
    Uniform,
}

/// As far as kicks may reach: basins are still known well there.
const FARTHEST: f64 = 1e8;

/// Random kicks: a displacement and a velocity, independent of each other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct RandomKick {
    /// How both parts are spread.
    pub law: Distribution,
    /// Mean and spread of the displacement.
    pub q: (f64, f64),
    /// Mean and spread of the velocity.
    pub v: (f64, f64),
}

impl Default for RandomKick {
    /// Normal, with standard deviations of 1.
    fn default() -> Self {
        RandomKick { law: Distribution::Normal, q: (0.0, 1.0), v: (0.0, 1.0) }
    }
}

impl RandomKick {
    /// Reads `q=0+-0.1,v=0+-0.05`, with `uniform:` before it for a law that is not normal; displacements and
    /// velocities in these units, or with their own.
    ///
    /// # Errors
    /// One line that says what is wrong and what is allowed.
    pub fn read(text: &str, units: [&str; 2]) -> Result<Self, String> {
        const FORM: &str = "kicks such as q=0+-0.1,v=0+-0.05 or uniform:q=0+-0.1,v=0";
        let form = || format!("{text:?}: expected {FORM}");
        let (name, parts) = text.split_once(':').unwrap_or(("normal", text));
        let law = named(name).ok_or_else(form)?;
        let mut kicks = RandomKick { law, q: (0.0, 0.0), v: (0.0, 0.0) };
        for part in parts.split(',') {
            let (name, interval) = part.split_once('=').ok_or_else(form)?;
            let (place, unit) = match name.trim() {
                "q" => (&mut kicks.q, units[0]),
                "v" => (&mut kicks.v, units[1]),
                _ => return Err(form()),
            };
            let refused = |why| format!("{name}: {why}");
            let (mean, spread) = interval.split_once("+-").unwrap_or((interval, "0"));
            let (mean, spread) = in_one_unit(interval, mean, spread).map_err(refused)?;
            let mean = mean.in_unit(unit);
            let mean = mean.map_err(|why| refused(format!("{interval:?} {why}")))?;
            if spread < 0.0 {
                return Err(refused(format!("the spread {spread} is negative")));
            }
            *place = (mean, spread);
        }
        kicks.checked()
    }

    /// These kicks, if they are numbers and not too far away.
    ///
    /// # Errors
    /// One line that says what is allowed.
    pub fn checked(self) -> Result<Self, String> {
        let (mean, spread) = self.v;
        if self.reach() <= FARTHEST && mean.is_finite() && spread.is_finite() {
            return Ok(self);
        }
        Err(format!("kicks {self} reach too far; they stay within {FARTHEST:e}"))
    }

    /// The same kick in these units, which are given in its present ones.
    #[must_use]
    pub fn in_units(mut self, displacement: f64, velocity: f64) -> Self {
        for (part, unit) in [(&mut self.q, displacement), (&mut self.v, velocity)] {
            *part = (part.0 / unit, part.1 / unit);
        }
        self
    }

    /// The largest displacement that matters.
    pub fn reach(&self) -> f64 {
        self.q.0.abs() + self.law.reach() * self.q.1
    }

    /// The fraction of the kicks from the steady position that is lost.
    ///
    /// # Errors
    /// [`Reason::NotApplicable`] where the basin is not known, or if its border cannot be traced as far as
    /// [`RandomKick::reach`].
    pub fn lost(&self, portrait: &Portrait) -> Result<Share> {
        const NEEDS: Reason = Reason::NotApplicable {
            needs: "a basin of rest that is known, and no family of periodic motions",
        };
        if matches!(portrait.border, Border::Unknown(_)) || portrait.neutral {
            return Err(NEEDS);
        }
        if !portrait.has_basin() {
            return Ok(Share::exact(1.0));
        }
        let scaled = self.in_units(1.0, portrait.model.omega_0);
        let portrait = portrait.followed_to(self.reach())?;
        Ok(portrait.edge().map_or(Share::exact(0.0), |edge| scaled.lost_outside(edge)))
    }

    /// The fraction of the kicks that leads out of a border.
    /// Quadrature as in `part_within`.
    fn lost_outside(&self, edge: &Edge) -> Share {
        let (law, (mean, spread)) = (self.law, self.q);
        let lost_at = |q: f64| {
            let Some((low, high)) = edge.span_at(q) else { return 1.0 };
            law.above(high - self.v.0, self.v.1) + law.above(self.v.0 - low, self.v.1)
        };
        if spread == 0.0 {
            // A border and an erfc known to 1e-12 of themselves: a tail nine spreads out falls eighty times as fast.
            const KNOWN: f64 = 1e-10;
            let part = lost_at(mean).min(1.0);
            return Share { part, error: KNOWN * part };
        }
        let far = law.reach() * spread;
        let Some((left, right)) = support(edge, (mean - far, mean + far)) else {
            return Share::exact(1.0);
        };
        let beyond = law.above(right - mean, spread) + law.above(mean - left, spread);
        let lost = |q: f64| law.density(q - mean, spread) * lost_at(q);
        let Integral { value, error } = over_scales(lost, (left, right), edge);
        Share { part: (beyond + value).clamp(0.0, 1.0), error: error + f64::EPSILON }
    }
}

impl TryFrom<String> for RandomKick {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        RandomKick::read(&text, ["", ""])
    }
}

impl From<RandomKick> for String {
    fn from(kicks: RandomKick) -> Self {
        kicks.to_string()
    }
}

impl fmt::Display for RandomKick {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let law = if self.law == Distribution::Uniform {
            "uniform:"
        } else {
            ""
        };
        let (q, v) = (self.q, self.v);
        write!(out, "{law}q={}+-{},v={}+-{}", q.0, q.1, v.0, v.1)
    }
}

impl Distribution {
    /// One word.
    pub fn name(self) -> &'static str {
        match self {
            Distribution::Normal => "normal",
            Distribution::Uniform => "uniform",
        }
    }

    /// Probability that a number of mean 0 and this spread is larger than `x`.
    fn above(self, x: f64, spread: f64) -> f64 {
        if spread == 0.0 {
            return f64::from(x <= 0.0);
        }
        match self {
            Distribution::Normal => 0.5 * erfc(x / spread / SQRT_2),
            Distribution::Uniform => (0.5 - 0.5 * x / spread).clamp(0.0, 1.0),
        }
    }

    /// Density of a number of mean 0 and this spread.
    pub(crate) fn density(self, x: f64, spread: f64) -> f64 {
        let scaled = x / spread;
        match self {
            Distribution::Normal => exp(-0.5 * scaled * scaled) / (spread * (2.0 * PI).sqrt()),
            Distribution::Uniform => f64::from(scaled.abs() <= 1.0) / (2.0 * spread),
        }
    }

    /// How many times the spread a number can be away from its mean, to 1e-18.
    pub(crate) fn reach(self) -> f64 {
        if self == Distribution::Normal { 9.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::{Fate, Limits};
    use crate::model::Parameters;
    use crate::numerics::root::bisect;

    #[test]
    fn erfc_has_the_digits_of_the_tables() {
        // NIST Digital Library, table 7.23, and 30-digit arithmetic.
        for (x, expected) in [
            (0.0, 1.0),
            (0.5, 0.479_500_122_186_953_5),
            (1.0, 0.157_299_207_050_285_13),
            (1.999, 0.004_698_443_348_628_49),
            (2.5, 4.069_520_174_449_589e-4),
            (5.0, 1.537_459_794_428_035e-12),
            (-1.0, 1.842_700_792_949_715),
        ] {
            assert!((erfc(x) / expected - 1.0_f64).abs() < 1e-11, "{x}: {:e}", erfc(x));
        }
    }

    #[test]
    fn kicks_are_read_and_written() {
        let read = |text: &str| RandomKick::read(text, ["", ""]);
        let kicks = read("q=0+-0.1,v=0.2+-0.05").unwrap();
        assert_eq!(kicks.law, Distribution::Normal);
        assert_eq!((kicks.q, kicks.v), ((0.0, 0.1), (0.2, 0.05)));
        assert_eq!(kicks.to_string(), "q=0+-0.1,v=0.2+-0.05");
        assert_eq!(read("uniform:v=1+-1").unwrap().law, Distribution::Uniform);
        for text in ["q", "x=1", "cauchy:q=1", "q=1+-", "q=1+--1", "q=inf", "q=-1..1", "q=1+-5%"] {
            assert!(read(text).is_err(), "{text}");
        }
        let measured = |text: &str| RandomKick::read(text, ["m", "m/s"]);
        assert_eq!(measured("q=1 mm+-0.25 mm,v=0+-5 mm/s").unwrap().q, (1e-3, 0.25e-3));
        assert_eq!(
            measured("q=1 mm+-0.25"),
            Err("q: \"1 mm+-0.25\": both numbers take the same unit, or none (SI units)".to_owned())
        );
    }

    #[test]
    fn uniform_kicks_over_a_window_lose_what_the_window_does_not_hold() {
        for (d, d2, d3) in [(-0.2, 0.0, 0.0), (-0.3, 0.4, 0.2), (-0.05, 0.5, 0.0)] {
            let parameters = Parameters { d, d2, d3, r: 0.1 };
            let found = Portrait::of_oscillator(&parameters, 2.0, &Limits::PATIENT).unwrap();
            let kicks = RandomKick { law: Distribution::Uniform, q: (0.1, 0.6), v: (-0.1, 0.5) };
            let lost = kicks.lost(&found).unwrap();
            let held = found.rest_share((-0.5, 0.7), (-0.6, 0.4)).unwrap();
            assert!((lost.part + held.part - 1.0).abs() <= lost.error + held.error + 1e-12);
        }
    }

    #[test]
    fn normal_kicks_are_lost_as_often_as_a_monte_carlo_loses_them() {
        let parameters = Parameters { d: -0.3, d2: 0.2, d3: 0.5, r: 0.1 };
        let found = Portrait::of_oscillator(&parameters, 3.0, &Limits::PATIENT).unwrap();
        let kicks = RandomKick { law: Distribution::Normal, q: (0.02, 0.08), v: (0.0, 0.1) };
        let lost = kicks.lost(&found).unwrap();
        // Points of a lattice in the unit square, made normal by the inverse of the distribution.
        let inverse =
            |part: f64| bisect(-9.0, 9.0, 40, |at| Distribution::Normal.above(at, 1.0) <= part).0;
        let draws = 20_000;
        let mut out = 0;
        for index in 0..draws {
            let spread = |ratio: f64| (0.5 + ratio * f64::from(index)).fract();
            let (a, b) = (spread(0.754_877_666_246_693), spread(0.569_840_290_998_053));
            let fate = found.fate(0.02 + 0.08 * inverse(a), 0.1 * inverse(b));
            out += u32::from(fate != Ok(Fate::Rest));
        }
        let counted = f64::from(out) / f64::from(draws);
        assert!(lost.part > 0.02 && lost.part < 0.5 && lost.error < 1e-8, "{lost:?}");
        assert!((counted - lost.part).abs() < 1e-3, "{lost:?} {counted}");
    }

    #[test]
    fn kicks_spread_far_beyond_the_sticking_set_are_not_overlooked_next_to_it() {
        // From far on one side of a separatrix every kick is lost, from far on the other none: what is not half
        // comes from next to the sticking set and falls as the spread grows.
        let parameters = Parameters { d: -0.05, d2: 0.5, d3: 0.0, r: 0.2 };
        let short_of_half = |spread: f64| {
            let kicks = RandomKick { law: Distribution::Normal, q: (0.0, spread), v: (0.0, 1.0) };
            let found =
                Portrait::of_oscillator(&parameters, kicks.reach(), &Limits::PATIENT).unwrap();
            0.5 - kicks.lost(&found).unwrap().part
        };
        let at_thousand = 1e3 * short_of_half(1e3);
        for spread in [1e4, 1e6] {
            let short = short_of_half(spread);
            assert!((short - at_thousand / spread).abs() < 1e-8, "{spread:e}: {short:e}");
        }
    }

    #[test]
    fn impulses_of_one_margin_as_spread_are_lost_beyond_one_standard_deviation() {
        // Without D2 both sides are alike: erfc(1/sqrt(2)) lie beyond.
        for (d, d3) in [(-0.3, 0.0), (-0.3, 0.5), (0.1, -0.2)] {
            let parameters = Parameters { d, d2: 0.0, d3, r: 0.1 };
            let found = Portrait::of_oscillator(&parameters, 3.0, &Limits::PATIENT).unwrap();
            let v = (0.0, found.margin.impulse.unwrap());
            let lost =
                RandomKick { law: Distribution::Normal, q: (0.0, 0.0), v }.lost(&found).unwrap();
            assert!((lost.part - 0.317_310_507_862_914_15).abs() <= lost.error, "{lost:?}");
            assert!(lost.error < 1e-10, "{lost:?}");
        }
    }

    #[test]
    fn kicks_without_spread_are_lost_or_not() {
        let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.0, r: 0.1 };
        let found = Portrait::of_oscillator(&parameters, 3.0, &Limits::PATIENT).unwrap();
        let margin = found.margin.impulse.unwrap();
        let lost = |v: f64| {
            RandomKick { law: Distribution::Normal, q: (0.0, 0.0), v: (v, 0.0) }
                .lost(&found)
                .unwrap()
                .part
        };
        assert_eq!([lost(0.999 * margin), lost(1.001 * margin)], [0.0, 1.0]);
    }
}
