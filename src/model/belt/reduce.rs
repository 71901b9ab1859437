//! The dimensionless oscillator that a mass on a belt is.

use serde::Serialize;

use super::friction::Belt;
use super::friction::Derivatives;
use crate::model::Reason;
use crate::model::knob::Knob;
use crate::model::parameters::{Parameters, State};

/// The units of the dimensionless oscillator: what 1 of each stands for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Units {
    /// Frequency `omega_0 = sqrt(c/m)`, in 1/s.
    pub omega_0: f64,
    /// Displacement `x0 = F mu(v0)/c`, in m.
    pub displacement: f64,
    /// Velocity `omega_0 x0`, in m/s.
    pub velocity: f64,
    /// Time `1/omega_0`, in s.
    pub time: f64,
    /// Impulse `m omega_0 x0`, in N s.
    pub impulse: f64,
    /// Force `c x0 = F mu(v0)`, in N.
    pub force: f64,
}

/// The dimensionless oscillator that a belt is, with its units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedBelt {
    /// D, D2, D3 and r.
    pub parameters: Parameters,
    /// What 1 stands for.
    pub units: Units,
    /// The coefficient of friction and its derivatives at the belt speed.
    pub mu: Derivatives,
    /// Velocity at which the mass sticks to the belt, `v0/(omega_0 x0)`: the model ends there.
    pub sticking_velocity: f64,
}

impl Belt {
    /// The dimensionless oscillator, by equations (1) to (7) with their signs, `omega_0` and the scale of
    /// `r` put right:
    ///
    /// `2 D = (d1 + F mu')/(m omega_0)`, `D2 = -F mu'' x0/(2 m)`, `D3 = (d3 + F mu'''/6) omega_0 x0^2/m`,
    /// `r = R/(m omega_0^2 x0)`, with derivatives with respect to the relative velocity, at `v0`.
    ///
    /// Friction is represented by its cubic Taylor polynomial; [`Self::taylor_error`] measures what that
    /// leaves out.
    ///
    /// # Errors
    /// [`Reason`] where the law does not reach, where it has no derivatives, where friction does not
    /// pull, or where a parameter is beyond the range of numbers.
    pub fn reduce(&self) -> Result<ReducedBelt, Reason> {
        self.reduce_at(self.belt_speed)
    }

    /// The same with the belt running at `v0` m/s, all else as it is.
    ///
    /// # Errors
    /// Those of [`Self::reduce`].
    pub fn reduce_at(&self, v0: f64) -> Result<ReducedBelt, Reason> {
        let Belt { mass, stiffness, normal_force, .. } = *self;
        let mu = self.law.at(v0);
        let mu = mu.ok_or(Reason::OutsideLaw { v0, range: self.law.range() })?;
        if !(mu.is_finite() && mu.value > 0.0) {
            return Err(Reason::NoFriction { v0, mu: mu.value });
        }
        let omega_0 = (stiffness / mass).sqrt();
        let x0 = normal_force * mu.value / stiffness;
        let cubic = self.cubic_damping + normal_force * mu.third / 6.0;
        let parameters = Parameters {
            d: (self.damping + normal_force * mu.first) / (2.0 * mass * omega_0),
            // Without curvature no asymmetry, and no negative zero either.
            d2: 0.0 - normal_force * mu.second * x0 / (2.0 * mass),
            d3: cubic * omega_0 * x0 * x0 / mass,
            r: self.friction / (mass * omega_0 * omega_0 * x0),
        };
        for knob in Knob::PARAMETERS {
            knob.check(knob.get(&parameters, &State::default())).map_err(Reason::Refused)?;
        }
        let velocity = omega_0 * x0;
        Ok(ReducedBelt {
            parameters,
            units: Units {
                omega_0,
                displacement: x0,
                velocity,
                time: 1.0 / omega_0,
                impulse: mass * velocity,
                force: stiffness * x0,
            },
            mu,
            sticking_velocity: v0 / velocity,
        })
    }
}
