//! Kicks that are survived for certain, whatever is not known exactly and whatever disturbs.

use thiserror::Error;

pub mod certain;
pub mod machine;
pub mod oscillator;

pub(crate) use self::oscillator::*;
use super::{Margin, Portrait};

/// The portrait whose basin lies within those of all others, and the margin that holds for certain; or why there is none.
pub type Guarantee = Result<(Portrait, Margin), NoGuarantee>;

/// Why no kick is survived for certain.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum NoGuarantee {
    /// The disturbance moves the mass from its rest by itself.
    #[error(
        "the disturbance of {disturbance}{unit} is not below the smallest friction of {friction}{unit}"
    )]
    Disturbance {
        /// The disturbance.
        disturbance: f64,
        /// The smallest friction.
        friction: f64,
        /// The unit of both with a blank before it, if they have one.
        unit: &'static str,
    },
    /// The end of the sticking set repels.
    #[error("at the smallest D = {d} the ends of the sticking set repel")]
    Repels {
        /// The smallest D.
        d: f64,
    },
    /// The tolerances leave no friction to count on.
    #[error("the uncertainties change the forces by more than the friction holds")]
    Tolerances,
    /// More numbers are uncertain than are looked at together.
    #[error(
        "uncertainties of more than {} numbers beside R, R_static, d1 and d3 are not looked at together",
        machine::MOST
    )]
    TooMany,
    /// No border below the belts' lines bounds all machines.
    #[error(
        "no motion slower than the belt bounds the basins of all machines within the uncertainties"
    )]
    Unbounded,
    /// The border leaves the friction law of one of the machines.
    #[error("within the uncertainties the border leaves the friction law")]
    OutsideLaw,
}
