//! Friction laws: the coefficient of friction over the relative velocity, with three derivatives.
//!
//! The oscillator of the paper knows a friction characteristic only by its value and its first three
//! derivatives at the belt speed (equation 3); how well these represent it is measured against the law
//! itself ([`Belt::taylor_error`]).

use serde::{Deserialize, Serialize};

use crate::numerics::{SmoothingSpline, derivatives, exp, pow, powi};

pub use crate::numerics::polynomial::Derivatives;

/// The coefficient of friction `mu` over the relative velocity `v >= 0`, in m/s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FrictionLaw {
    /// The same at every velocity.
    Constant {
        /// The coefficient.
        mu: f64,
    },
    /// A polynomial in v.
    Polynomial {
        /// Coefficients of 1, v, v^2, ...: without unit, s/m, s^2/m^2, ...
        coefficients: Vec<f64>,
    },
    /// Stribeck's characteristic, `mu = kinetic + (rest - kinetic) exp(-(v/velocity)^exponent) + viscous v`.
    Stribeck {
        /// Coefficient at v = 0.
        rest: f64,
        /// The lower coefficient to which it falls.
        kinetic: f64,
        /// Velocity over which it falls, in m/s.
        velocity: f64,
        /// 1 for the exponential, 2 for the Gaussian form.
        exponent: f64,
        /// Rise by lubrication, in s/m.
        viscous: f64,
    },
    /// Measured points, through or near which runs the smoothest curve.
    Table(SmoothingSpline),
}

impl Default for FrictionLaw {
    /// No friction.
    fn default() -> Self {
        FrictionLaw::Constant { mu: 0.0 }
    }
}

impl FrictionLaw {
    /// What it is made of: all that is computed of a law follows from these, or from the spline of a table.
    #[must_use]
    pub fn parts(&self) -> LawParts {
        let whole = |coefficients: &[f64]| vec![(0.0, f64::INFINITY, coefficients.to_vec())];
        let (pieces, fall) = match self {
            FrictionLaw::Constant { mu } => (whole(&[*mu]), None),
            FrictionLaw::Polynomial { coefficients } => (whole(coefficients), None),
            FrictionLaw::Stribeck { rest, kinetic, velocity, exponent, viscous } => {
                let fall = (rest - kinetic, *velocity, *exponent);
                (whole(&[*kinetic, *viscous]), Some(fall))
            }
            FrictionLaw::Table(spline) => {
                let pieces = spline.polynomials().map(|(from, to, c)| (from, to, c.to_vec()));
                (pieces.collect(), None)
            }
        };
        LawParts { pieces, fall }
    }

    /// The coefficient and its derivatives with respect to the relative velocity, at `v`.
    ///
    /// `None` outside of the [range](Self::range) of the law. Derivatives that do not exist (a Stribeck
    /// law with a fractional exponent, at v = 0) are infinite or not numbers.
    #[must_use]
    pub fn at(&self, v: f64) -> Option<Derivatives> {
        let (low, high) = self.range();
        let inside = (low..=high).contains(&v);
        inside.then(|| match self {
            FrictionLaw::Table(spline) => spline.at(v),
            _ => self.parts().at(v),
        })
    }

    /// The coefficient at `v`, where the law reaches.
    #[must_use]
    pub fn mu(&self, v: f64) -> Option<f64> {
        self.at(v).map(|mu| mu.value)
    }

    /// Smallest and largest relative velocity for which the law says something, in m/s.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        match self {
            FrictionLaw::Table(spline) => spline.range(),
            _ => (0.0, f64::MAX),
        }
    }

    /// The names of all laws in files.
    pub const NAMES: [&str; 4] = ["constant", "polynomial", "stribeck", "table"];

    /// The law of this name with all its numbers 0; `None` where it has not a number each in the table of them all, but a
    /// list.
    #[must_use]
    pub fn blank(name: &str) -> Option<Self> {
        let (rest, kinetic, velocity, exponent, viscous) = (0.0, 0.0, 0.0, 0.0, 0.0);
        match name {
            "constant" => Some(FrictionLaw::default()),
            "stribeck" => {
                Some(FrictionLaw::Stribeck { rest, kinetic, velocity, exponent, viscous })
            }
            _ => None,
        }
    }

    /// The name in files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            FrictionLaw::Constant { .. } => "constant",
            FrictionLaw::Polynomial { .. } => "polynomial",
            FrictionLaw::Stribeck { .. } => "stribeck",
            FrictionLaw::Table(_) => "table",
        }
    }
}

/// From which slip to which, and the coefficients of powers of the distance from the lower end.
pub type LawPiece = (f64, f64, Vec<f64>);

/// A friction law as pieces of polynomials in the slip, and one falling exponential.
#[derive(Clone, Debug, PartialEq)]
pub struct LawParts {
    /// The polynomials, by slip.
    pub pieces: Vec<LawPiece>,
    /// Drop, velocity and exponent of `drop exp(-(slip/velocity)^exponent)`.
    pub fall: Option<(f64, f64, f64)>,
}

impl LawParts {
    /// The coefficient and its derivatives at a slip.
    pub fn at(&self, v: f64) -> Derivatives {
        let piece = self.pieces.iter().rfind(|(from, ..)| *from <= v);
        let mut mu = piece.map_or(Derivatives::default(), |(from, _, c)| derivatives(c, v - from));
        if let Some((drop, velocity, exponent)) = self.fall {
            let fall = stretched_exponential(v / velocity, exponent);
            mu.value += drop * fall.value;
            mu.first += drop * fall.first / velocity;
            mu.second += drop * fall.second / powi(velocity, 2);
            mu.third += drop * fall.third / powi(velocity, 3);
        }
        mu
    }
}

/// `exp(-u^exponent)` for `u >= 0` with its derivatives.
fn stretched_exponential(u: f64, exponent: f64) -> Derivatives {
    // Derivatives of the power; a factor of 0 wins over an infinite power (whole exponents at u = 0).
    let power = |factor: f64, order: f64| {
        if factor == 0.0 {
            0.0
        } else {
            factor * pow(u, exponent - order)
        }
    };
    let n = exponent;
    let p = Derivatives {
        value: power(1.0, 0.0),
        first: power(n, 1.0),
        second: power(n * (n - 1.0), 2.0),
        third: power(n * (n - 1.0) * (n - 2.0), 3.0),
    };
    let value = exp(-p.value);
    Derivatives {
        value,
        first: -p.first * value,
        second: (p.first * p.first - p.second) * value,
        third: (p.first * (3.0 * p.second - p.first * p.first) - p.third) * value,
    }
}

/// A mass on a moving belt.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Belt {
    /// Mass m, in kg.
    pub mass: f64,
    /// Stiffness c, in N/m.
    pub stiffness: f64,
    /// Linear damping d1, in N s/m.
    pub damping: f64,
    /// Cubic damping d3, in N s^3/m^3.
    pub cubic_damping: f64,
    /// Force F onto the belt, in N.
    pub normal_force: f64,
    /// Intensity R of the friction element, in N.
    pub friction: f64,
    /// Belt speed v0, in m/s.
    pub belt_speed: f64,
    /// Coefficient of friction between mass and belt.
    pub law: FrictionLaw,
    /// Coefficient up to which the belt holds the mass; that of the law at rest where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_coefficient: Option<f64>,
    /// Force up to which the friction element holds the mass, in N; R where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_guide: Option<f64>,
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::model::belt::tests::differences;
    use crate::numerics::elementary::powi;

    fn laws() -> [FrictionLaw; 5] {
        let stribeck = |exponent, viscous| FrictionLaw::Stribeck {
            rest: 0.5,
            kinetic: 0.2,
            velocity: 0.3,
            exponent,
            viscous,
        };
        [
            FrictionLaw::Constant { mu: 0.3 },
            FrictionLaw::Polynomial { coefficients: vec![0.5, -0.3, 0.0, 0.4, 0.1] },
            stribeck(1.0, 0.0),
            stribeck(2.0, 0.05),
            stribeck(1.5, 0.05),
        ]
    }

    proptest! {
        #[test]
        fn derivatives_are_those_of_the_law(v in 0.2_f64..1.5) {
            for law in laws() {
                let found = law.at(v).unwrap();
                let measured = differences(|v| law.mu(v).unwrap(), v, 0.2);
                for (found, measured, tolerance) in [
                    (found.value, measured.value, 1e-15),
                    (found.first, measured.first, 1e-9),
                    (found.second, measured.second, 1e-7),
                    (found.third, measured.third, 1e-4),
                ] {
                    prop_assert!((found - measured).abs() <= tolerance * (1.0 + found.abs()), "{law:?}");
                }
            }
        }
    }

    #[test]
    fn whole_exponents_have_derivatives_at_rest() {
        let [.., exponential, gaussian, fractional] = laws();
        let at_rest = exponential.at(0.0).unwrap();
        assert!((at_rest.third + 0.3 / powi(0.3, 3)).abs() < 1e-12);
        assert_eq!(gaussian.at(0.0).unwrap().first, 0.05);
        assert!(!fractional.at(0.0).unwrap().is_finite() && fractional.mu(0.0) == Some(0.5));
        assert_eq!(exponential.at(-1e-9), None, "no law for a belt that runs backward");
    }

    #[test]
    fn the_cubic_repeats_a_cubic() {
        let law = FrictionLaw::Polynomial { coefficients: vec![0.5, -0.3, 0.2, 0.4] };
        let cubic = law.at(0.7).unwrap();
        for v in [0.0, 0.3, 0.7, 2.0] {
            assert!((cubic.cubic(v - 0.7) - law.mu(v).unwrap()).abs() < 1e-14);
        }
    }
}
