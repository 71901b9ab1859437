//! The phase that follows at a switching line, and the motion up to its next turning point.
//!
//! Where the inclusion leaves a choice, the mass is held: by the belt wherever static friction suffices, and
//! likewise by the guide. An orbit that touches the belt's line tangentially sticks.

use super::{ArcEnd, Flow, MachineStep, PhaseSeries};
use crate::model::{ContactState, Phase, Reason, Result};

/// A turning point, and the motion that led there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turn {
    /// Its displacement.
    pub x: f64,
    /// Whether the mass comes to rest.
    pub rests: bool,
    /// Logarithm of the product of (acceleration in/acceleration out) over the arcs that led there; together with the
    /// integral of the divergence, it is that of the derivative of the map. Minus infinity after sticking.
    pub log_ratio: f64,
    /// Displacement at which the mass began to ride on the belt.
    pub sticks_from: Option<f64>,
    /// Displacement at which it left the belt's line upwards.
    pub overtakes_from: Option<f64>,
}

impl Flow<'_> {
    /// Follows a motion to its next turning point: the left one from `y < 0`, the right one otherwise. Fails with
    /// [`Reason`] if it does not turn.
    pub fn turn(
        &mut self,
        mut place: ContactState,
        (x, mut y): (f64, f64),
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<Turn> {
        /// Maximum number of legs: three contacts with the belt's line and one more by rounding, and a ride.
        const LEGS: usize = 8;
        let mut turn = Turn { x, rests: true, ..Turn::default() };
        for _ in 0..LEGS {
            let Some((next, leg)) = self.leg(place, (turn.x, y), watch)? else {
                return Ok(turn);
            };
            if place == ContactState::Sticks {
                turn.sticks_from = turn.sticks_from.or(Some(turn.x));
            }
            turn.log_ratio += leg.log_ratio;
            (place, turn.x, y) = (next, leg.x, leg.y);
            if y == 0.0 {
                return Ok(Turn { rests: place == ContactState::Rests, ..turn });
            }
            if place == ContactState::Slips(Phase::Above) {
                turn.overtakes_from = Some(turn.x);
            }
        }
        Err(Reason::Steps)
    }

    /// Follows one leg up to what the mass does next, and where; `None` at rest.
    pub(crate) fn leg(
        &mut self,
        place: ContactState,
        (x, y): (f64, f64),
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<Option<(ContactState, ArcEnd)>> {
        let model = self.model;
        let phase = match place {
            ContactState::Rests => return Ok(None),
            ContactState::Sticks => {
                let release = model.lines.map_or(x, |lines| lines.release);
                let mut ride = MachineStep::ride(x, release, model.speed);
                ride.duration = ride.duration.min(self.series.left);
                self.passes(ride, watch);
                let released = ArcEnd { x: release, y, log_ratio: f64::NEG_INFINITY };
                return Ok(Some((ContactState::Slips(Phase::Between), released)));
            }
            ContactState::Slips(phase) => phase,
        };
        let mut end = self.arc(phase, (x, y), false, watch)?;
        // Only by rounding does a motion arrive where its own side pushes it away.
        end.x = match (end.is_on_belt(), phase, model.lines) {
            (false, Phase::Below, _) => end.x.min(model.guide),
            (false, ..) => end.x.max(-model.guide),
            (true, Phase::Above, Some(lines)) => end.x.max(lines.low),
            (true, _, Some(lines)) => end.x.min(lines.fold),
            (true, _, None) => end.x,
        };
        Ok(Some((model.place(end.x, end.y), end)))
    }
}
