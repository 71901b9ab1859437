//! What becomes of a motion.

use super::limits::Reason;

/// What becomes of a motion: for good, or for as long as it was followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fate<Why = Reason> {
    /// It comes to rest; without friction at the steady state, in infinite time.
    Rest,
    /// It tends to the cycle with this index, counted by amplitude, or starts on it.
    Cycle(usize),
    /// It is periodic, one of a family.
    Neutral,
    /// It still moves when time is up.
    Moving,
    /// It grows without bound.
    Escapes,
    /// It could not be followed far enough.
    Unknown(Why),
}

impl<W> Fate<W> {
    /// The word of files for how a motion ended that was followed for a time.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Fate::Rest => "captured",
            Fate::Escapes => "escaped",
            Fate::Unknown(_) => "gave-up",
            Fate::Cycle(_) | Fate::Neutral | Fate::Moving => "moving",
        }
    }
}
