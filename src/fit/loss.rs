//! Loss functions: the square of a residual, or less if the residual is large.

use crate::numerics::elementary::{ln_1p, powi};

/// A loss function; `scale` is the size beyond which a residual is large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loss {
    /// `e^2`.
    Linear,
    /// `2 s^2 (sqrt(1 + (e/s)^2) - 1)`: linear in large residuals.
    SoftL1 {
        /// See [`Loss`].
        scale: f64,
    },
    /// `s^2 ln(1 + (e/s)^2)`: large residuals count little more than moderate ones.
    Cauchy {
        /// See [`Loss`].
        scale: f64,
    },
}

impl Loss {
    /// Whether large residuals count less than their square.
    pub fn is_robust(self) -> bool {
        self != Loss::Linear
    }

    /// The loss of a residual.
    pub fn of(self, residual: f64) -> f64 {
        match self {
            Loss::Linear => residual * residual,
            Loss::SoftL1 { scale } => {
                let part = powi(residual / scale, 2);
                // sqrt(1 + z) - 1 without cancellation.
                2.0 * scale * scale * part / (1.0 + (1.0 + part).sqrt())
            }
            Loss::Cauchy { scale } => scale * scale * ln_1p(powi(residual / scale, 2)),
        }
    }

    /// The weight of a residual in the equivalent weighted least-squares problem: the derivative of the loss with
    /// respect to `e^2`.
    pub fn weight(self, residual: f64) -> f64 {
        match self {
            Loss::Linear => 1.0,
            Loss::SoftL1 { scale } => 1.0 / (1.0 + powi(residual / scale, 2)).sqrt(),
            Loss::Cauchy { scale } => 1.0 / (1.0 + powi(residual / scale, 2)),
        }
    }
}
