//! What the paper gives in formulas, corrected and numerically safe.
//!
//! Nothing here is integrated. [`linear`] and [`piecewise_linear`] are exact for `D2 = D3 = 0`;
//! [`harmonic`] approximates cycles by one harmonic, [`harmonics`] by any number of
//! them, which takes linear algebra and Newton's method; [`lyapunov`] bounds the basin by a circle.
//! The numbers of [`crate::numerics`] keep the digits and the range which the formulas as printed lose.
//!
//! ```
//! use hopfscope::closed_form::piecewise_linear::LinearCycle;
//!
//! // Without D2 and D3 the cycle grows in proportion to the friction, and it is unstable.
//! let [one, twice] = [0.5, 1.0].map(|r| LinearCycle::new(-0.1, r).unwrap());
//! assert!((twice.q_max / one.q_max - 2.0).abs() < 1e-14);
//! assert!(one.log_multiplier > 0.0);
//! ```

#[doc(hidden)]
pub mod harmonic;
#[doc(hidden)]
pub mod harmonics;
pub(crate) mod linear;
pub(crate) mod lyapunov;
pub mod piecewise_linear;

pub(crate) use self::{harmonic::*, harmonics::*, linear::*, piecewise_linear::*};

#[cfg(test)]
mod reference {
    //! Tables of reference values in `tests/data`, computed with 60 digits (mpmath) and rounded.

    /// The numbers of each row; a cell without one is left out.
    pub fn rows(table: &str) -> Vec<Vec<f64>> {
        assert!(table.lines().count() > 5, "rows below a heading");
        let numbers = |row: &str| {
            let cells = row.split(',').filter(|cell| !cell.is_empty());
            cells.map(|cell| cell.parse().expect("a number")).collect()
        };
        table.lines().skip(1).map(numbers).collect()
    }
}
