//! The phase that follows at a switching line, and the motion up to its next turning point.
//!
//! Where the inclusion leaves a choice, the mass is held: by the belt wherever static friction suffices, and
//! likewise by the guide. An orbit that touches the belt's line tangentially sticks.

use super::arc::{ArcEnd, Flow};
use super::curve::MachineStep;
use super::series::PhaseSeries;
use super::stepped::PhaseStepper;
use crate::model::{ContactState, Phase, Reason};

/// A turning point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Its displacement.
    pub x: f64,
    /// Whether the mass comes to rest.
    pub rests: bool,
    /// The motion that led there.
    pub way: WayToTurn,
}

/// Properties of the motion to a turning point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WayToTurn {
    /// Logarithm of the product of (acceleration in/acceleration out) over the arcs; together with the integral of
    /// the divergence, it is that of the derivative of the map. Minus infinity after sticking.
    pub log_ratio: f64,
    /// Displacement at which the mass began to ride on the belt.
    pub sticks_from: Option<f64>,
    /// Displacement at which it left the belt's line upwards.
    pub overtakes_from: Option<f64>,
}

/// Where a leg ends: where the next begins.
pub(crate) struct LegEnd {
    /// What the mass does next.
    pub place: ContactState,
    /// Displacement.
    pub x: f64,
    /// Velocity.
    pub y: f64,
    /// Logarithm of (acceleration in/acceleration out); minus infinity after sticking.
    pub log_ratio: f64,
}

impl<'a> Flow<'a> {
    /// Follows a motion to its next turning point: the left one from `y < 0`, the right one otherwise. Fails with
    /// [`Reason`] if it does not turn.
    pub fn turn(
        &mut self,
        mut place: ContactState,
        (mut x, mut y): (f64, f64),
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<Turn, Reason> {
        /// Maximum number of legs: three contacts with the belt's line and one more by rounding, and a ride.
        const LEGS: usize = 8;
        let mut way = WayToTurn::default();
        for _ in 0..LEGS {
            let Some(leg) = self.leg(None, place, (x, y), watch)? else {
                return Ok(Turn { x, rests: true, way });
            };
            if place == ContactState::Sticks {
                way.sticks_from = way.sticks_from.or(Some(x));
            }
            way.log_ratio += leg.log_ratio;
            (place, x, y) = (leg.place, leg.x, leg.y);
            if y == 0.0 {
                return Ok(Turn { x, rests: place == ContactState::Rests, way });
            }
            if place == ContactState::Slips(Phase::Above) {
                way.overtakes_from = Some(x);
            }
        }
        Err(Reason::Steps)
    }

    /// Follows one leg, by Taylor series where there is no other stepper; `None` at rest.
    pub(crate) fn leg(
        &mut self,
        stepper: Option<&mut PhaseStepper<'a>>,
        place: ContactState,
        (x, y): (f64, f64),
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<Option<LegEnd>, Reason> {
        let model = self.model;
        let phase = match place {
            ContactState::Rests => return Ok(None),
            ContactState::Sticks => {
                let release = model.lines.map_or(x, |lines| lines.release);
                let mut ride = MachineStep::ride(x, release, model.speed);
                ride.duration = ride.duration.min(self.series.left);
                self.passes(ride, watch);
                let place = ContactState::Slips(Phase::Between);
                return Ok(Some(LegEnd { place, x: release, y, log_ratio: f64::NEG_INFINITY }));
            }
            ContactState::Slips(phase) => phase,
        };
        let end = match stepper {
            None => self.arc(phase, (x, y), false, watch)?,
            Some(stepper) => self.stepped(stepper, phase, (x, y), watch)?,
        };
        let (place, x) = self.after(phase, &end);
        let y = if end.on_belt { model.speed } else { 0.0 };
        Ok(Some(LegEnd { place, x, y, log_ratio: end.log_ratio() }))
    }

    /// The phase that follows an arc, and its start. Only by rounding does a motion arrive where its own side
    /// pushes it away.
    pub(crate) fn after(&self, phase: Phase, end: &ArcEnd) -> (ContactState, f64) {
        let model = self.model;
        let x = match (end.on_belt, phase, model.lines) {
            (false, Phase::Below, _) => end.x.min(model.guide),
            (false, ..) => end.x.max(-model.guide),
            (true, Phase::Above, Some(lines)) => end.x.max(lines.low),
            (true, _, Some(lines)) => end.x.min(lines.fold),
            (true, _, None) => end.x,
        };
        (model.place(x, if end.on_belt { model.speed } else { 0.0 }), x)
    }
}
