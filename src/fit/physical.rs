//! Forces and damping constants of a fitted motion whose mass or stiffness is known.

use serde::Serialize;

use super::fitted::Fitted;
use super::inertia::Inertia;
use super::observation::{D, D2, D3, OMEGA0, R, UNKNOWNS};
use crate::numerics::elementary::powi;

/// An estimated number in SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EstimatedNumber {
    /// Its symbol.
    #[serde(skip)]
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// A quantity as the mass times a factor, powers of `omega0` and of the unit of length, and one of the unknowns.
struct Law {
    name: &'static str,
    unit: &'static str,
    factor: f64,
    unknown: Option<usize>,
    omega0: i32,
    length: i32,
}

/// With `x = offset + q` and `tau = omega0 t`, the model multiplied by the stiffness is
/// `m x'' + d1 x' + d2 x'^2 + d3 x'^3 + c (x - offset) = friction within -R .. R`.
const LAWS: [Law; 6] = [
    Law { name: "m", unit: "kg", factor: 1.0, unknown: None, omega0: 0, length: 0 },
    Law { name: "c", unit: "N/m", factor: 1.0, unknown: None, omega0: 2, length: 0 },
    Law { name: "d1", unit: "N s/m", factor: 2.0, unknown: Some(D), omega0: 1, length: 0 },
    Law { name: "d2", unit: "N s^2/m^2", factor: 1.0, unknown: Some(D2), omega0: 0, length: -1 },
    Law { name: "d3", unit: "N s^3/m^3", factor: 1.0, unknown: Some(D3), omega0: -1, length: -2 },
    Law { name: "R", unit: "N", factor: 1.0, unknown: Some(R), omega0: 2, length: 1 },
];

/// The physical numbers with standard errors from the covariance of the fit; none if neither mass nor stiffness is
/// known.
pub fn rows(fitted: &Fitted) -> Vec<EstimatedNumber> {
    let Some((inertia, metres)) = fitted.inertia else { return Vec::new() };
    LAWS.iter().map(|law| row(fitted, law, inertia, metres)).collect()
}

fn row(fitted: &Fitted, law: &Law, inertia: Inertia, metres: f64) -> EstimatedNumber {
    let estimate = &fitted.estimate;
    let omega0 = estimate.p[OMEGA0];
    // If the stiffness is given, the mass is c/omega0^2.
    let (scale, power) = match inertia {
        Inertia::Mass(mass) => (mass, law.omega0),
        Inertia::Stiffness(stiffness) => (stiffness, law.omega0 - 2),
    };
    let constant = scale * law.factor * powi(omega0, power) * powi(metres, law.length);
    let number = law.unknown.map_or(1.0, |unknown| estimate.p[unknown]);
    let mut gradient = [0.0; UNKNOWNS];
    gradient[OMEGA0] = constant * number * f64::from(power) / omega0;
    if let Some(unknown) = law.unknown {
        gradient[unknown] = constant;
    }
    let variance: f64 = (0..UNKNOWNS)
        .flat_map(|i| (0..UNKNOWNS).map(move |j| (i, j)))
        .map(|(i, j)| gradient[i] * gradient[j] * estimate.covariance.of(i, j))
        .sum();
    let standard_error = variance.max(0.0).sqrt();
    EstimatedNumber { name: law.name, value: constant * number, standard_error, unit: law.unit }
}

/// Factors that convert a displacement of the record to metres, and a velocity over `omega0` to an impulse.
pub fn kicks(fitted: &Fitted) -> Option<(f64, f64)> {
    let (inertia, metres) = fitted.inertia?;
    Some((metres, metres * inertia.times(fitted.estimate.p[OMEGA0], 1)))
}
