//! How the motion is played: where its head is, and how fast it moves.

/// How fast the motion is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// So many seconds for a period of the free oscillation.
    Period(f64),
    /// As fast as the machine itself; only a scene of one has that.
    Real,
}

/// The paces besides that of a machine itself.
pub(in crate::session) const PACES: [Pace; 4] =
    [Pace::Period(8.0), Pace::Period(4.0), Pace::Period(2.0), Pace::Period(1.0)];

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Playback {
    /// Dimensionless time of the head; `None` before anything was played.
    pub at: Option<f64>,
    /// Whether the head advances as time passes.
    pub playing: bool,
    pub pace: Pace,
}

impl Default for Playback {
    fn default() -> Self {
        Playback { at: None, playing: false, pace: PACES[1] }
    }
}
