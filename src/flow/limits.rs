//! What a computation may cost, and what becomes of a motion.

use crate::model::{Reason, Result};

/// Bounds on a computation: a budget of evaluations and a means of interruption.
#[derive(Clone, Copy)]
pub struct Limits<'a> {
    /// Maximum number of evaluations of the field (a Taylor series of order N counts as N).
    pub evaluations: u64,
    /// Called at every step; `true` ends the computation with [`Reason::Interrupted`].
    pub interrupted: &'a (dyn Fn() -> bool + Sync),
}

impl Limits<'static> {
    /// The budget of one question, without interruption: a few seconds of computing.
    pub const PATIENT: Limits<'static> =
        Limits { evaluations: 400_000_000, interrupted: &|| false };
}

impl Limits<'_> {
    /// The same with at most this many evaluations.
    #[must_use]
    pub fn up_to(&self, most: u64) -> Self {
        Limits { evaluations: self.evaluations.min(most), ..*self }
    }

    /// Nothing, unless the computation is to end. Fails with [`Reason::Interrupted`].
    pub(crate) fn go_on(&self) -> Result<()> {
        if (self.interrupted)() {
            Err(Reason::Interrupted)
        } else {
            Ok(())
        }
    }
}

/// What becomes of a motion: for good, or for as long as it was followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fate {
    /// It comes to rest; without friction at the steady state, in infinite time.
    Rest,
    /// It tends to the cycle with this index, counted by amplitude, or starts on it.
    Cycle(usize),
    /// It is periodic, one of a family.
    Neutral,
    /// It still moves when the time, or the number of half swings, for which it is followed is up.
    Moving,
    /// It grows without bound.
    Escapes,
    /// It could not be followed far enough.
    Unknown(Reason),
}
