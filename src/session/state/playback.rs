//! Playback of the motion: the position of its head, and its pace.

/// The pace at which the motion is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// Seconds per period of the free oscillation.
    Period(f64),
    /// The real pace of the machine; only a scene of a machine has it.
    Real,
}

/// All paces other than that of a machine.
pub(in crate::session) const PACES: [Pace; 4] =
    [Pace::Period(8.0), Pace::Period(4.0), Pace::Period(2.0), Pace::Period(1.0)];

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Playback {
    /// Dimensionless time of the head; `None` before the first playback.
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
