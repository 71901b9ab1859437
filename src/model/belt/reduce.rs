//! The dimensionless oscillator that a mass on a belt is, and what the cubic Taylor polynomial of its friction law leaves
//! out, measured.

use serde::Serialize;

use super::Belt;
use super::friction::Derivatives;
use crate::model::knob::Knob;
use crate::model::{Parameters, Reason, Result};
use crate::numerics::{by_number, maximum};

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

impl Units {
    /// Of numbers that have SI units themselves.
    pub const SI: Units = Units::of((1.0, 1.0), 1.0, 1.0);

    /// Those of a mass on a spring of this stiffness and natural frequency, whose unit of length is given.
    const fn of((mass, stiffness): (f64, f64), omega_0: f64, displacement: f64) -> Self {
        let velocity = omega_0 * displacement;
        let (time, impulse, force) = (1.0 / omega_0, mass * velocity, stiffness * displacement);
        Units { omega_0, displacement, velocity, time, impulse, force }
    }
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
    pub fn reduce(&self) -> Result<ReducedBelt> {
        self.reduce_at(self.belt_speed)
    }

    /// The same with the belt running at `v0` m/s, all else as it is.
    ///
    /// # Errors
    /// Those of [`Self::reduce`].
    pub fn reduce_at(&self, v0: f64) -> Result<ReducedBelt> {
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
            knob.check(parameters.value(knob)).map_err(Reason::Refused)?;
        }
        let units = Units::of((mass, stiffness), omega_0, x0);
        Ok(ReducedBelt { parameters, units, mu, sticking_velocity: v0 / units.velocity })
    }
}

/// The largest difference between friction and its cubic Taylor polynomial over the velocities that a
/// motion reaches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TaylorError {
    /// Velocities of the mass over which it was measured, in m/s: those asked for, as far as the friction
    /// law reaches and the mass does not overtake the belt.
    pub range: (f64, f64),
    /// Whether that is all that was asked for.
    pub complete: bool,
    /// The smallest coefficient of friction there; one below 0 means no friction.
    pub least_mu: f64,
    /// The largest difference, in N.
    pub force: f64,
    /// The velocity of the mass at which it occurs, in m/s.
    pub at: f64,
    /// The same as a fraction of the friction of the belt at rest, `F mu(v0)`.
    pub of_friction: f64,
    /// The same as a fraction of the largest change of friction over the range; `None` where it does not
    /// change.
    pub of_change: Option<f64>,
}

impl Belt {
    /// Compares friction with its cubic Taylor polynomial over velocities `low .. high` of the mass, in m/s.
    ///
    /// The law is evaluated at 513 velocities, and the largest difference polished by golden section.
    /// `None` where the law has no derivatives at the belt speed, or where the range is empty.
    #[must_use]
    pub fn taylor_error(&self, (low, high): (f64, f64)) -> Option<TaylorError> {
        /// Intervals of the range.
        const INTERVALS: u32 = 512;
        /// Part of two intervals over which a maximum is flat.
        const FLAT: f64 = 1e-8;
        /// Rounding of a law and of its cubic, relative to them.
        const ROUNDING: f64 = 16.0 * f64::EPSILON;
        let v0 = self.belt_speed;
        let mu = self.law.at(v0).filter(Derivatives::is_finite)?;
        let (slowest, fastest) = self.law.range();
        let range = (low.max(v0 - fastest), high.min(v0 - slowest).min(v0));
        if range.0 > range.1 || !(range.0.is_finite() && range.1.is_finite()) {
            return None;
        }
        // Rounding may leave the end of the law by an ulp.
        let law = |v: f64| self.law.mu((v0 - v).clamp(slowest, fastest)).unwrap_or(f64::NAN);
        let difference = |v: f64| {
            let (exact, cubic) = (law(v), mu.cubic(-v));
            let difference = (exact - cubic).abs();
            // What rounding leaves of a law that is its own cubic is not an error of the expansion.
            if difference <= ROUNDING * (exact.abs() + cubic.abs()) {
                0.0
            } else {
                difference
            }
        };
        let change = |v: f64| (law(v) - mu.value).abs();
        let step = (range.1 - range.0) / f64::from(INTERVALS);
        let place = |index: u32| {
            if index == INTERVALS {
                range.1
            } else {
                range.0 + f64::from(index) * step
            }
        };
        let places = (0..=INTERVALS).map(place);
        let worst = places.clone().max_by(by_number(|v: &f64| difference(*v)));
        let worst = worst.unwrap_or(range.0);
        let [from, to] = [worst - step, worst + step].map(|v| v.clamp(range.0, range.1));
        let (from, to) = maximum(from, to, FLAT * (to - from), difference);
        let polished = f64::midpoint(from, to);
        let at = if difference(polished) > difference(worst) {
            polished
        } else {
            worst
        };
        let force = self.normal_force * difference(at);
        let least_mu = places.clone().map(law).fold(mu.value, f64::min);
        let largest = places.map(change).fold(0.0, f64::max);
        Some(TaylorError {
            range,
            complete: range == (low, high),
            least_mu,
            force,
            at,
            of_friction: difference(at) / mu.value,
            of_change: (largest > 0.0).then(|| difference(at) / largest),
        })
    }
}
