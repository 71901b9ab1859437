//! A recorded motion, and what it says about the oscillator: estimates of all its numbers with honest errors.
//!
//! [`record`] reads what instruments write. [`guess`] reads a first guess off the turning points, by the decrements
//! of averaging ([`decrements`]). [`motion`] follows a motion with its exact derivatives, half swing by half swing
//! ([`half_swing`]); [`observation`] compares it with the record; [`levenberg_marquardt`] descends, and [`search`]
//! makes sure that it descends into the right [`valley`]. [`samples`] and [`peaks`] put it together; [`mod@estimate`] judges:
//! covariance, also
//! for correlated noise ([`uncertainty`], [`residuals`]), intervals where the loss is not quadratic ([`profile`]),
//! what only combinations are known of ([`separable`]), and what all this leaves of the margin ([`margin`]).
//!
//! Nothing here touches a file: text goes in, estimates come out.

pub mod chance;
pub mod decrements;
pub mod estimate;
pub mod guess;
pub mod half_swing;
pub mod header;
pub mod levenberg_marquardt;
pub mod loss;
pub mod margin;
pub mod motion;
pub mod names;
pub mod noise;
pub mod observation;
pub mod peaks;
pub mod problem;
pub mod profile;
pub mod question;
pub mod record;
pub mod refit;
pub mod residuals;
pub mod samples;
pub mod search;
pub mod separable;
pub mod spectrum;
pub mod triangle;
pub mod turning_points;
pub mod uncertainty;
pub mod valley;

pub use estimate::Estimate;
pub use margin::{DRAWS, Margins, margins};
pub use question::{LossName, Question, Unfit};
pub use record::{BadRecord, Column, Reading, Record, parse};

use levenberg_marquardt::Effort;

/// Fits a record.
///
/// # Errors
/// [`Unfit`] says why there is no estimate.
pub fn estimate(
    record: &Record,
    question: &Question,
    interrupted: &dyn Fn() -> bool,
) -> Result<Estimate, Unfit> {
    let mut effort = Effort { with_derivatives: 0, plain: 0, interrupted };
    if question.peaks {
        peaks::peaks(record, question, &mut effort)
    } else {
        samples::samples(record, question, &mut effort)
    }
}
