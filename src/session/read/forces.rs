//! The forces on the mass at a moment of its motion: they say why it holds or lets go.

use crate::flow::{Method, Outcome, Problem, Sample};
use crate::model::Parameters;
use crate::numerics::tanh;
use crate::session::Session;

/// The forces on the mass, each divided by the stiffness of the spring: displacements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forces {
    pub spring: f64,
    /// Of the damping; of a machine by its whole model, of its dampers and the belt, whose pull at rest is left out.
    /// `None` where the law of friction does not reach.
    pub damping: Option<f64>,
    /// Of dry friction.
    pub friction: f64,
    /// The most that dry friction can be.
    pub limit: f64,
}

impl Session {
    /// Whether friction holds the mass at a moment of the present motion: on the belt, or at rest.
    pub fn sticks(&self, moment: &Sample) -> bool {
        let Some(motion) = self.trajectory() else { return false };
        let rests = matches!(motion.outcome, Outcome::Captured { tau, .. } if moment.tau >= tau);
        let rides = |[from, to]: [Sample; 2]| (from.tau..=to.tau).contains(&moment.tau);
        rests || motion.rides().any(rides)
    }

    /// The forces at a moment of the present motion; `None` while that is not known.
    pub fn forces(&self, moment: &Sample) -> Option<Forces> {
        let motion = self.trajectory()?;
        let Problem { parameters: Parameters { r, .. }, epsilon, .. } = motion.problem;
        let Sample { q, v, .. } = *moment;
        let limit = self.friction_at_rest().filter(|_| v == 0.0).unwrap_or(r);
        let friction = match motion.method {
            Method::Smoothed => -r * tanh(v / epsilon),
            _ if v == 0.0 => q.clamp(-limit, limit),
            _ => -r * v.signum(),
        };
        // On the belt, which moves steadily, all forces balance.
        let rides = v != 0.0 && self.sticks(moment);
        let damping = if rides { Some(q - friction) } else { self.damping(v) };
        Some(Forces { spring: -q, damping, friction, limit })
    }

    /// What a guide that holds more at rest than in motion can hold there.
    fn friction_at_rest(&self) -> Option<f64> {
        let belt = self.machine().filter(|_| self.draws_whole())?;
        Some(belt.static_guide? / self.running()?.reduced.units.force)
    }

    /// The force that depends on the velocity, by the law that is drawn.
    fn damping(&self, v: f64) -> Option<f64> {
        let Some((running, belt)) =
            self.running().zip(self.machine()).filter(|_| self.draws_whole())
        else {
            let Parameters { d, d2, d3, .. } = self.problem.parameters;
            return Some(-v * (2.0 * d + v * (d2 + v * d3)));
        };
        let units = running.reduced.units;
        let velocity = v * units.velocity;
        let slip = belt.belt_speed - velocity;
        let pull = belt.law.mu(slip.abs())?.copysign(slip) / running.reduced.mu.value;
        let cubic = belt.cubic_damping * velocity * velocity;
        Some(pull - 1.0 - velocity * (belt.damping + cubic) / units.force)
    }
}
