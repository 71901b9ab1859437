//! Fitting the oscillator to a recorded motion: estimates of all its numbers, with honest errors.
//!
//! [`record`] reads the files of instruments. [`mod@guess`] makes a first guess from the [`mod@turning_points`], by the
//! decrements of averaging. [`motion`] follows a motion with its exact derivatives, half swing by half swing;
//! [`observation`] compares it with the record. [`task`] says which of the unknowns ([`question`]) are estimated, and
//! minimizes the loss; [`search`] finds the right [`valley`] for it, [`mod@drift`] one with a drift of the zero. [`mod@samples`]
//! combines these steps, for samples and for peaks. [`mod@estimate`] assesses the result: covariance, also for
//! correlated noise ([`residuals`]), and intervals where the loss is not quadratic ([`uncertainty`]); numbers
//! of which only a combination is known ([`result`]); and the resulting uncertainty of the margin ([`margin`]). What
//! all of this rests on is tested by the record itself ([`mod@conditions`]).
//!
//! Nothing here reads or writes files: text goes in, estimates come out.
//!
//! ```
//! use hopfscope::fit::{Question, RecordFormat, estimate, parse};
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
//! let record = parse(text.as_bytes(), &RecordFormat::default()).unwrap();
//! let found = estimate(&record, &Question::default(), &|| false).unwrap();
//! assert!(found.rests && found.half_swings > 5);
//! ```

mod cells;
mod conditions;
mod curves;
mod descent;
mod drift;
mod estimate;
mod guess;
mod margin;
mod motion;
mod noise;
mod observation;
mod posterior;
mod question;
mod record;
mod residuals;
mod result;
mod samples;
mod search;
mod signal;
mod task;
mod turning_points;
mod uncertainty;
mod valley;

pub use estimate::Estimate;
pub use margin::{AllowedLoss, DRAWS, MarginQuestion, Margins, margins};
pub use question::{Inertia, LossName, NoEstimate, Question, parameters};
pub use record::{BadRecord, Record, RecordFormat, parse};
pub use result::{FitResult, RecordPoint};
pub use signal::{LENGTHS, Signal, length_in_metres};

#[doc(hidden)]
pub use {
    conditions::{Condition, conditions},
    estimate::{Rival, following},
    motion::Way,
    observation::Residual,
    question::{
        BEND, Choice, D, D2, D3, LAST, NAMES, NameSpec, OFFSET, OMEGA0, Q0, R, SLOPE, StartKind,
        UNKNOWNS, Unknowns, named,
    },
    task::{DropReason, Runs, Task},
};

// What other rings use of it, and its files of each other.
pub(crate) use {
    curves::*, drift::*, estimate::*, guess::*, margin::*, motion::*, noise::*, observation::*,
    posterior::*, question::*, record::*, residuals::*, result::*, samples::*, search::*,
    signal::*, task::*, turning_points::*, uncertainty::*, valley::*,
};

/// Number of motions after which a fit gives up. A record of this oscillator takes about a hundred, one with a
/// drift about a thousand.
const MOST_MOTIONS: u64 = 6000;

/// Fits a record.
///
/// # Errors
/// [`NoEstimate`] says why there is no estimate.
pub fn estimate(
    record: &Record,
    question: &Question,
    interrupted: &dyn Fn() -> bool,
) -> Result<Estimate, NoEstimate> {
    let runs = Runs { most: MOST_MOTIONS, ..Runs::new(interrupted) };
    let found = of_kind(record, question, &runs)?;
    // What is known to be wrong need not be tested again.
    if found.whiteness.systematic {
        return Ok(found);
    }
    let repeated = Some(conditions::repeated(&found, question, &Runs::new(interrupted))?);
    Ok(Estimate { repeated, ..found })
}
