//! What is certain of the oscillator of the paper, of a machine or of a mode, whose numbers are known to tolerances.

use super::{TwoSidedOscillator, machine, oscillator};
use crate::flow::{Limits, Result};
use crate::model::{Body, Source, Tolerances};
use crate::portrait::{Guarantee, Portrait};

/// That whose basin lies within all others, and the margin that holds for certain, or why there is none; a border that
/// is not closed is followed as far as `reach`. A mode is known exactly.
///
/// # Errors
/// The [`Reason`](crate::model::Reason) why the border could not be computed.
pub fn guaranteed(
    source: &Source,
    known: &Tolerances,
    reach: f64,
    limits: &Limits,
) -> Result<Guarantee> {
    match &source.body {
        Body::Paper(parameters) => {
            oscillator::guaranteed(&known.around(parameters), known.disturbance, reach, limits)
        }
        Body::Belt(belt) => machine::guaranteed(belt, known),
        Body::Mode(_) => {
            let portrait = source.portrait()?;
            let margin = portrait.margin;
            Ok(Ok((portrait, margin)))
        }
    }
}

/// That whose basin all others lie within, where it is known.
///
/// # Errors
/// The [`Reason`](crate::model::Reason) why the border could not be computed.
pub fn hopeful(
    source: &Source,
    known: &Tolerances,
    reach: f64,
    limits: &Limits,
) -> Result<Option<Portrait>> {
    match &source.body {
        Body::Paper(parameters) => {
            let best = TwoSidedOscillator::best(&known.around(parameters), known.disturbance);
            let found = (best.upper.d > -1.0).then(|| best.portrait(reach, limits)).transpose()?;
            Ok(found.map(|(best, _)| best))
        }
        // With the largest friction and damping, if no other number is uncertain.
        Body::Belt(belt) => known.best(belt).map(|best| Portrait::of_belt(&best)).transpose(),
        Body::Mode(_) => source.portrait().map(Some),
    }
}
