//! Fitting the oscillator to a recorded motion: estimates of all its numbers, with honest errors.
//!
//! [`record`] reads the files of instruments. [`guess`] makes a first guess from the turning points, by the
//! decrements of averaging ([`decrements`]). [`motion`] follows a motion with its exact derivatives, half swing by
//! half swing ([`half_swing`]); [`observation`] compares it with the record. [`levenberg_marquardt`] minimizes the
//! loss, and [`search`] finds the right [`valley`] for it. [`samples`] and [`peaks`] combine these steps.
//! [`mod@estimate`] assesses the result: covariance, also for correlated noise ([`uncertainty`], [`residuals`]);
//! intervals where the loss is not quadratic ([`profile`]); numbers of which only combinations are known
//! ([`separable`]); and the resulting uncertainty of the margin ([`margin`]). What all of this rests on is tested by the
//! record itself ([`conditions`]).
//!
//! Nothing here reads or writes files: text goes in, estimates come out.
//!
//! ```
//! use hopfscope::fit::{Question, Reading, estimate, parse};
//! use hopfscope::flow::{Detail, Limits, Problem, trajectory::trajectory};
//! use hopfscope::model::{Parameters, State};
//!
//! // A free decay, as an instrument would record it: time and displacement, a row each.
//! let problem = Problem {
//!     parameters: Parameters { d: 0.02, d2: 0.0, d3: 0.0, r: 0.05 },
//!     initial: State { q: 1.0, v: 0.0 },
//!     ..Problem::default()
//! };
//! let detail = Detail { samples_per_step: 8, ..Detail::default() };
//! let motion = trajectory(&problem, detail, &Limits::PATIENT);
//! let text: String = (0..400)
//!     .filter_map(|index| motion.at(0.1 * f64::from(index)))
//!     .map(|sample| format!("{} {}\n", sample.tau, sample.q))
//!     .collect();
//! let record = parse(text.as_bytes(), &Reading::default()).unwrap();
//! let found = estimate(&record, &Question::default(), &|| false).unwrap();
//! assert!(found.rests && found.half_swings > 5);
//! ```

pub(crate) mod cells;
pub(crate) mod clock;
#[doc(hidden)]
pub mod conditions;
pub(crate) mod contour;
pub(crate) mod curves;
pub(crate) mod decrements;
#[doc(hidden)]
pub mod drift;
pub(crate) mod drifting;
#[doc(hidden)]
pub mod dropped;
#[doc(hidden)]
pub mod estimate;
pub(crate) mod fitted;
pub(crate) mod guess;
pub(crate) mod half_swing;
pub(crate) mod header;
pub(crate) mod inertia;
pub(crate) mod jumps;
pub(crate) mod left_out;
#[doc(hidden)]
pub mod levenberg_marquardt;
pub(crate) mod loss;
pub(crate) mod margin;
pub(crate) mod motion;
#[doc(hidden)]
pub mod names;
pub(crate) mod noise;
#[doc(hidden)]
pub mod observation;
pub(crate) mod peaks;
pub(crate) mod physical;
pub(crate) mod posterior;
pub(crate) mod problem;
pub(crate) mod profile;
pub(crate) mod question;
pub(crate) mod record;
#[doc(hidden)]
pub mod refit;
pub(crate) mod release;
pub(crate) mod residuals;
pub(crate) mod sampled;
pub(crate) mod samples;
pub(crate) mod search;
pub(crate) mod separable;
pub(crate) mod signal;
pub(crate) mod spectrum;
pub(crate) mod triangle;
pub(crate) mod turning_points;
pub(crate) mod uncertainty;
pub(crate) mod valley;

pub use estimate::Estimate;
pub use fitted::Fitted;
pub use inertia::Inertia;
pub use margin::{DRAWS, MarginQuestion, Margins, margins};
pub use observation::parameters;
pub use question::{LOSSES, LossName, Question, Unfit};
pub use record::{BadRecord, Column, Reading, Record, parse};
pub use signal::{LENGTHS, Signal, length_in_metres};

use std::cell::Cell;

use levenberg_marquardt::Runs;

/// Number of motions after which a fit gives up. A record of this oscillator takes about a hundred, one with a
/// drift about a thousand.
const MOST_MOTIONS: u64 = 6000;

/// Fits a record.
///
/// # Errors
/// [`Unfit`] says why there is no estimate.
pub fn estimate(
    record: &Record,
    question: &Question,
    interrupted: &dyn Fn() -> bool,
) -> Result<Estimate, Unfit> {
    let motions = Cell::new(0);
    let stops = || {
        motions.set(motions.get() + 1);
        motions.get() > MOST_MOTIONS || interrupted()
    };
    let mut runs = Runs::new(&stops);
    let fit = if question.peaks { peaks::peaks } else { samples::samples };
    match fit(record, question, &mut runs) {
        // What is known to be wrong need not be tested again.
        Ok(found) if !found.whiteness.systematic && motions.get() <= MOST_MOTIONS => {
            let mut runs = Runs::new(interrupted);
            let repeated = Some(conditions::repeated(&found, question, &mut runs)?);
            Ok(Estimate { repeated, ..found })
        }
        Err(Unfit::Interrupted) if motions.get() > MOST_MOTIONS => {
            Err(Unfit::GaveUp { motions: MOST_MOTIONS, closest: runs.closest })
        }
        other => other,
    }
}
