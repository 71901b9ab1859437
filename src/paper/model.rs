//! Sections 2 and 3: from the mass on its belt to the equation, how long the mass stays slower than the belt, and the smooth
//! steady state.
//!
//! That the mass stays slower, the paper assumes; nothing in the equation keeps a motion to it. It is tested on the belt
//! that comes with the program: friction that falls exponentially with the relative velocity.

use super::{Approximation, Check, ClaimCase, Conclusion, Evidence, always, at_rest, worst};
use crate::closed_form::{LinearFlow, amplitudes};
use crate::flow::{Detail, Problem, Reason, Result, trajectory};
use crate::model::{Belt, FrictionLaw, Parameters, ReducedBelt};
use crate::numerics::interval::PI;
use crate::numerics::{exp, ln, powi, try_bisect};
use crate::portrait::first_at;

pub(super) const CHECKS: &[Check] = &[
    always("slower than the belt", stays_slower),
    worst("undamped frequency", |_| {
        let stiffness = derivatives(|x| -acceleration(x, 0.0, 0.0))[0];
        let value = stiffness.value.sqrt();
        let computed = Approximation::new(value, 0.5 * stiffness.error / value);
        Ok(Evidence::equal(C / M, computed).corrected(omega()))
    }),
    worst("linear damping", |_| {
        let computed = coefficient(0, -0.5);
        let form = |mu: f64| (D1 + NORMAL * mu) / (2.0 * M * omega());
        Ok(Evidence::equal(form(falling()), computed).corrected(form(-falling())))
    }),
    worst("quadratic damping", |_| {
        let computed = coefficient(1, -0.5);
        let form = NORMAL * falling() * shift() / (2.0 * M);
        Ok(Evidence::equal(form, computed).corrected(-form))
    }),
    worst("cubic damping", |_| {
        let computed = coefficient(2, -1.0 / 6.0);
        let unit = omega() * shift() * shift() / M;
        let form = |mu: f64| (D3 + NORMAL * mu / 6.0) * unit;
        Ok(Evidence::equal(form(falling()), computed).corrected(form(-falling())))
    }),
    worst("friction", |_| {
        let jump = dimensionless(0.0, JOINT) - dimensionless(0.0, -JOINT);
        let printed = JOINT / (M * powi(omega(), 2));
        let computed = Approximation::relative(0.5 * jump, 1e-14);
        Ok(Evidence::equal(printed, computed).corrected(printed / shift()))
    }),
    always("oscillation", |it| {
        Ok(LinearFlow::new(it.d).first_standstill(-1.0, 0.0).is_some().into())
    }),
    worst("sign of friction", |it| {
        let [end, _] = it.half_swing(it.more)?;
        let gained = end.times(-1.0).plus(-it.more);
        let fed = 2.0 * it.r;
        Ok(Evidence::equal(fed, gained).corrected(-fed))
    }),
    worst("rate of growth", |it| Ok(Evidence::equal(-it.d, growth(it)?[0]))),
    worst("frequency of growth", |it| {
        let printed = Evidence::equal(1.0, growth(it)?[1]);
        Ok(printed.corrected((1.0 - it.d * it.d).sqrt()))
    }),
    always("smooth stability", |it| {
        let [end, _] = it.half_swing(-1e-6)?;
        Ok(end.exceeds(1e-6).is(it.d < 0.0))
    }),
];

/// Rate and frequency of small motions.
fn growth(it: &ClaimCase) -> Result<[Approximation; 2]> {
    let [end, duration] = it.half_swing(-1.0)?;
    let relative = end.error / end.value + duration.error / duration.value;
    let growth = ln(end.value) / duration.value;
    let frequency = Approximation::relative(std::f64::consts::PI / duration.value, relative)
        .within(duration.bounds.map(|it| PI / it));
    Ok([Approximation::new(growth, relative * (1.0 + growth.abs())), frequency])
}

// A mass on a belt, in SI units, whose friction falls exponentially with the relative velocity; the table of claims names
// these numbers. No two of them make a factor 1.

const M: f64 = 2.0;
const C: f64 = 8.0;
const D1: f64 = 0.1;
const D3: f64 = 0.02;
/// Normal force F.
const NORMAL: f64 = 5.0;
/// Velocity of the belt.
const BELT: f64 = 0.8;
/// Friction R of the joint.
const JOINT: f64 = 0.6;

/// Coefficient of friction at a relative velocity.
fn friction(velocity: f64) -> f64 {
    0.2 + 0.3 * exp(-velocity)
}

/// Second derivative of the friction by the relative velocity, at the belt's; the first and the third are its
/// negative.
fn falling() -> f64 {
    0.3 * exp(-BELT)
}

fn omega() -> f64 {
    (C / M).sqrt()
}

/// The static displacement, at which the spring balances the belt.
fn shift() -> f64 {
    NORMAL * friction(BELT) / C
}

/// Acceleration at the displacement `x` from the static one; `joint` is the force of the joint.
fn acceleration(x: f64, velocity: f64, joint: f64) -> f64 {
    let pull = NORMAL * friction(BELT - velocity);
    (pull - C * (x + shift()) - velocity * (D1 + D3 * velocity * velocity) + joint) / M
}

/// `q''` at `q = 0` over q'.
fn dimensionless(v: f64, joint: f64) -> f64 {
    let (length, omega) = (shift(), omega());
    acceleration(0.0, v * length * omega, joint) / (length * omega * omega)
}

/// A factor times a derivative of the dimensionless acceleration by the velocity, without the joint.
fn coefficient(order: usize, factor: f64) -> Approximation {
    derivatives(|v| dimensionless(v, 0.0))[order].times(factor)
}

/// First, second and third derivative at 0: central differences, extrapolated to step 0.
///
/// The error is what the last extrapolation changed, and the rounding of the differences.
fn derivatives(function: impl Fn(f64) -> f64) -> [Approximation; 3] {
    /// Steps, each half of the one before.
    const LEVELS: i32 = 6;
    /// The first.
    const STEP: f64 = 0.5;
    [1, 2, 3].map(|order: i32| {
        let f = &function;
        let difference = |h: f64| match order {
            1 => (f(h) - f(-h)) / (2.0 * h),
            2 => (f(h) - 2.0 * f(0.0) + f(-h)) / (h * h),
            _ => (f(2.0 * h) - 2.0 * f(h) + 2.0 * f(-h) - f(-2.0 * h)) / (2.0 * h * h * h),
        };
        let step = |level: i32| STEP * powi(0.5, level);
        let mut row: Vec<f64> = (0..LEVELS).map(|level| difference(step(level))).collect();
        let mut last = f64::INFINITY;
        let mut power = 4.0;
        while row.len() > 1 {
            last = (row[row.len() - 1] - row[row.len() - 2]).abs();
            row =
                row.windows(2).map(|pair| pair[1] + (pair[1] - pair[0]) / (power - 1.0)).collect();
            power *= 4.0;
        }
        let size = f(STEP).abs() + f(-STEP).abs() + f(0.0).abs();
        let rounding = 8.0 * f64::EPSILON * size / powi(step(LEVELS - 1), order);
        Approximation::new(row[0], last + rounding)
    })
}

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
fn at(speed: f64) -> Result<ReducedBelt> {
    let lost = |_| Reason::NotApplicable { needs: "a machine at this speed of its belt" };
    machine().reduce_at(speed).map_err(lost)
}

/// Whether the vibrations at a speed of the belt stay below it: the stable cycle, and a motion that
/// comes to it from just outside of the unstable one. Fails with the [`Reason`] why a cycle was not found.
fn stays_slower(case: &ClaimCase) -> Result<Conclusion<bool>> {
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
pub fn contact(case: &ClaimCase) -> Result<Evidence> {
    let harmonic = reached(|parameters| {
        let found = amplitudes(parameters).into_iter().rfind(|answer| answer.stable);
        Ok(found.map_or(0.0, |answer| answer.amplitude))
    })?;
    let computed = reached(|parameters| Ok(case.of(*parameters).largest()?.v_max))?;
    // The cycle's velocity is known to more digits than the speeds between which its sign changes.
    Ok(Evidence::near(harmonic, Approximation::relative(computed, 1e-10)))
}

/// The speed of the belt that is just reached by cycles with this largest velocity, by bisection.
fn reached(velocity: impl Fn(&Parameters) -> Result<f64>) -> Result<f64> {
    /// Halvings: to the eleventh digit.
    const HALVINGS: u32 = 36;
    let [from, to] = SPEEDS;
    let is_slower = |speed| {
        let ReducedBelt { parameters, sticking_velocity, .. } = at(speed)?;
        Ok(velocity(&parameters)? <= sticking_velocity)
    };
    let (low, high) = try_bisect(from, to, HALVINGS, is_slower)?;
    Ok(f64::midpoint(low, high))
}
