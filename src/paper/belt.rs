//! How long the mass stays slower than its belt: the condition under which the equation holds.
//!
//! The paper assumes it; nothing in the equation keeps a motion to it. It is tested on the belt
//! that comes with the program: friction that falls exponentially with the relative velocity.

use super::Evidence;
use super::known::{Certain, Known};
use super::measure::{Case, at_rest};
use crate::closed_form::harmonic::amplitudes;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Problem, Reason};
use crate::model::Belt;
use crate::model::belt::{FrictionLaw, ReducedBelt};
use crate::numerics::root::try_bisect;
use crate::portrait::on_belt::first_at;

/// Speeds of the belt between which a stable cycle exists, in m/s.
const SPEEDS: [f64; 2] = [0.05, 0.33];

/// Times the swing of the unstable cycle from which a motion leaves it.
const OUTSIDE: f64 = 1.05;

/// Time until a motion that has left the unstable cycle has come to the stable one, in several times the
/// largest of `1/abs(D)`.
const UNTIL: f64 = 300.0;

/// A mass of 2 kg on a spring of 5 N/mm.
pub(crate) fn machine() -> Belt {
    Belt {
        mass: 2.0,
        stiffness: 5e3,
        damping: 5.0,
        cubic_damping: 600.0,
        normal_force: 100.0,
        friction: 1.0,
        belt_speed: 0.3,
        law: FrictionLaw::Stribeck {
            rest: 0.4,
            kinetic: 0.2,
            velocity: 0.3,
            exponent: 1.0,
            viscous: 0.0,
        },
        static_coefficient: None,
        static_guide: None,
    }
}

/// The machine at a speed of its belt.
fn at(speed: f64) -> Result<ReducedBelt, Reason> {
    let lost = |_| Reason::NotApplicable { needs: "a machine at this speed of its belt" };
    machine().reduce_at(speed).map_err(lost)
}

/// Whether the vibrations at a speed of the belt stay below it: the stable cycle, and a motion that
/// comes to it from just outside of the unstable one. Fails with the [`Reason`] why a cycle was not found.
pub fn stays_slower(case: &Case) -> Result<Certain<bool>, Reason> {
    let ReducedBelt { parameters, sticking_velocity, .. } = at(case.more)?;
    let case = case.of(parameters);
    let below = case.largest()?.v_max < sticking_velocity;
    let initial = at_rest(OUTSIDE * case.smallest()?.q_max);
    let problem = Problem { parameters, initial, until: UNTIL, ..Problem::default() };
    let detail = Detail { crossings: true, samples_per_step: 8, energy: false };
    let motion = trajectory(&problem, detail, &case.limits);
    Ok((below && first_at(&motion, sticking_velocity).is_none()).into())
}

/// The speed of the belt at which the stable cycle just reaches it, by one harmonic and computed. Fails with the
/// [`Reason`] why a cycle was not found.
pub fn contact(case: &Case) -> Result<Evidence, Reason> {
    let harmonic = root(|speed| {
        let ReducedBelt { parameters, sticking_velocity, .. } = at(speed)?;
        let found = amplitudes(&parameters).into_iter().rfind(|answer| answer.stable);
        Ok(found.map_or(0.0, |answer| answer.amplitude) - sticking_velocity)
    })?;
    let computed = root(|speed| {
        let ReducedBelt { parameters, sticking_velocity, .. } = at(speed)?;
        Ok(case.of(parameters).largest()?.v_max - sticking_velocity)
    })?;
    let place = "m = 2 kg, c = 5 kN/m, F = 100 N, R = 1 N; in m/s";
    // The cycle's velocity is known to more digits than the speeds between which its sign changes.
    Ok(Evidence::near(harmonic, Known::relative(computed, 1e-10)).at(place))
}

/// Where a function that falls over the speeds is zero, by bisection.
fn root(mut function: impl FnMut(f64) -> Result<f64, Reason>) -> Result<f64, Reason> {
    /// Halvings: to the eleventh digit.
    const HALVINGS: u32 = 36;
    let [from, to] = SPEEDS;
    let (low, high) = try_bisect(from, to, HALVINGS, |v| Ok(function(v)? <= 0.0))?;
    Ok(f64::midpoint(low, high))
}
