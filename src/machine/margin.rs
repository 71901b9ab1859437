//! How large a kick a machine survives.

use crate::study::margin::{Margin, RestMargin};

/// The largest kicks out of the steady position after which the mass comes back to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MachineMargin {
    /// Displacements to the right and to the left, in m.
    pub displacement: (f64, f64),
    /// Velocities with and against the belt, in m/s.
    pub velocity: (f64, f64),
    /// Change of position, in m, from where the mass rests nearest to the border.
    pub rest_displacement: f64,
    /// Velocity, in m/s, from where the mass can rest and the smallest one is lost.
    pub rest_velocity: f64,
}

impl MachineMargin {
    /// No kick is survived.
    pub const ZERO: MachineMargin = MachineMargin {
        displacement: (0.0, 0.0),
        velocity: (0.0, 0.0),
        rest_displacement: 0.0,
        rest_velocity: 0.0,
    };

    /// The smallest kicks of a mass in kg that are not survived, in m and N s.
    #[must_use]
    pub fn least(&self, mass: f64) -> Margin {
        Margin {
            displacement: Some(self.least_displacement()),
            impulse: Some(mass * self.least_velocity()),
            from_rest: RestMargin {
                displacement: Some(self.rest_displacement),
                impulse: Some(mass * self.rest_velocity),
            },
        }
    }

    /// The smaller displacement, in m.
    #[must_use]
    pub fn least_displacement(&self) -> f64 {
        self.displacement.0.min(self.displacement.1)
    }

    /// The smaller velocity, in m/s.
    #[must_use]
    pub fn least_velocity(&self) -> f64 {
        self.velocity.0.min(self.velocity.1)
    }
}
