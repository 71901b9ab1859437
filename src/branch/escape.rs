//! Where the limit cycle goes to infinity: the escape point `D_c` of asymmetric damping.
//!
//! With `D3 = 0` and `D2 != 0`, on the side where D2 brakes, a swing from far out forgets where it began:
//! it ends at a finite `X` for every start beyond some clearance. Run backward, the swing on the other
//! side does the same. The cycle exists while the first reaches further out than the second asks for,
//! and at `D_c` the two motions from and to infinity close the cycle: `X(D_c) = 2 r + c1(D_c)`.
//!
//! ```
//! use hopfscope::flow::Limits;
//! use hopfscope::model::Parameters;
//! use hopfscope::branch::escape::escape_point;
//!
//! let parameters = Parameters { d: 0.0, d2: 0.5, d3: 0.0, r: 0.2 };
//! let found = escape_point(&parameters, &Limits::PATIENT)?.0.unwrap();
//! assert!((found + 0.079_769).abs() < 1e-6);
//! # Ok::<(), hopfscope::flow::Reason>(())
//! ```

use std::f64::consts::PI;

use crate::flow::{Cost, Limits, Result};
use crate::model::Parameters;
use crate::numerics::{PlaceTolerance, illinois};
use crate::portrait::{Equation, Route, forgotten, weighed_closing};

/// `D_c = -sqrt(2/pi) r abs(D2)`, to leading order in r D2.
pub fn leading_escape(d2: f64, r: f64) -> f64 {
    -(2.0 / PI).sqrt() * r * d2.abs()
}

/// `D_c` at these values of D2 and r, or `None` where no cycle escapes (`D3 != 0`, `D2 = 0` or `r = 0`); and what it
/// cost.
///
/// Bracketing secant (the Illinois rule) on the difference of the two swings from and to infinity, to
/// rounding, from [`leading_escape`] on.
///
/// # Errors
/// The [`Reason`](crate::model::Reason) why a swing failed.
pub fn escape_point(parameters: &Parameters, limits: &Limits) -> Result<(Option<f64>, Cost)> {
    let Parameters { d2, d3, r, .. } = *parameters;
    let leading = leading_escape(d2, r);
    let mut cost = Cost::default();
    if d3 != 0.0 || leading == 0.0 || 0.8 * leading < -1.0 {
        return Ok((None, cost));
    }
    let mut excess =
        |d: f64| excess_at_infinity(&Parameters { d, ..*parameters }, limits, &mut cost);
    // It falls from positive at D = -1 to negative at D = 0 (no cycle without self-excitation).
    let near = [f64::max(1.2 * leading, -1.0 + f64::EPSILON), 0.8 * leading];
    let mut found = where_it_falls(near, &mut excess)?;
    if found.is_none() {
        found = where_it_falls([-1.0 + 1e-9, 0.0], &mut excess)?;
    }
    Ok((found, cost))
}

/// The product `r abs(D2)` at which the cycle of a given damping goes to infinity, or `None` where none does: the
/// inverse of [`escape_point`] at `r = 1`.
///
/// # Errors
/// The [`Reason`](crate::model::Reason) why a swing failed.
pub fn escape_product(d: f64, limits: &Limits) -> Result<(Option<f64>, Cost)> {
    let mut cost = Cost::default();
    if !(d < 0.0 && d > -1.0) {
        return Ok((None, cost));
    }
    let leading = -d * (PI / 2.0).sqrt();
    let found = where_it_falls([0.25 * leading, 4.0 * leading], |product| {
        let unit = Parameters { d, d2: product, d3: 0.0, r: 1.0 };
        excess_at_infinity(&unit, limits, &mut cost)
    })?;
    Ok((found, cost))
}

/// Where an excess falls through 0, to rounding; `None` unless it is positive at the first end and negative at the other.
fn where_it_falls(
    ends: [f64; 2],
    mut excess: impl FnMut(f64) -> Result<f64>,
) -> Result<Option<f64>> {
    let ends = [(ends[0], excess(ends[0])?), (ends[1], excess(ends[1])?)];
    if !(ends[0].1 > 0.0 && ends[1].1 < 0.0) {
        return Ok(None);
    }
    let [(at, _), _] = illinois(ends, 0.0, PlaceTolerance::Relative(2.0 * f64::EPSILON), excess)?;
    Ok(Some(at))
}

/// By how much, as a logarithm, the swing from infinity passes the one to infinity; adds what it cost.
///
/// # Errors
/// The [`Reason`](crate::model::Reason) why a swing failed.
fn excess_at_infinity(parameters: &Parameters, limits: &Limits, cost: &mut Cost) -> Result<f64> {
    /// Excess below which a difference of logarithms has lost digits.
    const NEAR: f64 = 1e-2;
    // From where a swing has forgotten its start to rounding: what is left of it decays as `exp(-2 D2 c)`.
    let far = forgotten(parameters, 2.0 * parameters.r).log;
    let mut equation = Equation::new(parameters, f64::EPSILON, limits);
    let plain = equation.at(Route::Mixed, far).map(|found| found.node.value);
    // Weighed as energy, it keeps the digits that the difference loses near `D_c`.
    let weighed = match plain {
        Ok(plain) if plain.abs() < NEAR => weighed_closing(&mut equation, far),
        _ => Ok(None),
    };
    *cost += equation.cost();
    let (plain, weighed) = (plain?, weighed?);
    Ok(weighed
        .filter(|(_, (_, noise))| *noise < f64::EPSILON)
        .map_or(plain, |(_, (weighed, _))| weighed))
}
