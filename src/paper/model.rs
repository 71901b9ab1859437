//! Sections 2 and 3: from the mass on its belt to the equation, and the smooth steady state.

use super::measure::{Known, at_rest, half_swing, oscillator};
use super::{Claim, Finding, belt};
use crate::closed_form::linear::first_standstill;
use crate::flow::{Limits, Reason};
use crate::model::Parameters;
use crate::numerics::elementary::{exp, ln, powi};
use crate::numerics::interval::PI;

pub const CLAIMS: &[Claim] = &[
    Claim {
        equation: "after (2)",
        section: "2",
        statement: "x' < v0, so that the mass does not stick to the belt: its vibrations stay slower",
        basis: "motion",
        scene: Some("belt-speed"),
        check: belt::stays_slower,
    },
    Claim {
        equation: "after (3)",
        section: "2",
        statement: "the frequency of the undamped mass is c/m",
        basis: "law",
        scene: None,
        check: |_| {
            let stiffness = derivatives(|x| -MASS.acceleration(x, 0.0, 0.0))[0];
            let value = stiffness.value.sqrt();
            let computed = Known::new(value, 0.5 * stiffness.error / value);
            let (c, m) = (MASS.c, MASS.m);
            Ok(Finding::equal(c / m, computed).corrected((c / m).sqrt()).at(MASS_PLACE))
        },
    },
    Claim {
        equation: "(6)",
        section: "2",
        statement: "2 D = (d1 + F mu_1)/(m omega_0), with mu_1 of (3): the derivative by x', so that a \
                    falling friction characteristic damps",
        basis: "law",
        scene: None,
        check: |_| {
            let computed = coefficient(0, -0.5);
            let [slope, ..] = MASS.friction_derivatives();
            let form = |mu: f64| (MASS.d1 + MASS.normal * mu) / (2.0 * MASS.m * MASS.omega());
            Ok(Finding::equal(form(-slope), computed).corrected(form(slope)).at(MASS_PLACE))
        },
    },
    Claim {
        equation: "(6)",
        section: "2",
        statement: "D2 = F mu_2 x_0/(2 m)",
        basis: "law",
        scene: None,
        check: |_| {
            let computed = coefficient(1, -0.5);
            let [_, curvature, _] = MASS.friction_derivatives();
            let form = MASS.normal * curvature * MASS.shift() / (2.0 * MASS.m);
            Ok(Finding::equal(form, computed).corrected(-form).at(MASS_PLACE))
        },
    },
    Claim {
        equation: "(7)",
        section: "2",
        statement: "D3 = (d3 + F mu_3/6) omega_0 x_0^2/m, with mu_3 the derivative by x'",
        basis: "law",
        scene: None,
        check: |_| {
            let computed = coefficient(2, -1.0 / 6.0);
            let [.., third] = MASS.friction_derivatives();
            let unit = MASS.omega() * MASS.shift() * MASS.shift() / MASS.m;
            let form = |mu: f64| (MASS.d3 + MASS.normal * mu / 6.0) * unit;
            Ok(Finding::equal(form(-third), computed).corrected(form(third)).at(MASS_PLACE))
        },
    },
    Claim {
        equation: "(7)",
        section: "2",
        statement: "r = R/(m omega_0^2): half the jump of the acceleration at v = 0",
        basis: "law",
        scene: None,
        check: |_| {
            let jump = MASS.dimensionless(0.0, -0.0) - MASS.dimensionless(0.0, 0.0);
            let printed = MASS.joint / (MASS.m * powi(MASS.omega(), 2));
            let computed = Known::relative(0.5 * jump, 1e-14);
            Ok(Finding::equal(printed, computed).corrected(printed / MASS.shift()).at(MASS_PLACE))
        },
    },
    Claim {
        equation: "after (7)",
        section: "2",
        statement: "for abs(D) <= 1 the linear system oscillates",
        basis: "motion",
        scene: None,
        check: |_| {
            let cases = [-1.0, -0.999_999, -0.5, 0.0, 0.5, 0.999_999, 1.0];
            let returns = |d: f64| first_standstill(d, -1.0, 0.0).is_some();
            Ok(Finding::always(cases.map(|d| (format!("D = {d}"), returns(d)))))
        },
    },
    Claim {
        equation: "(8)",
        section: "2",
        statement: "v' contains - f_R: friction as in (5) would feed the motion, by 2 r in a half swing at \
                    D = 0",
        basis: "motion",
        scene: Some("capture"),
        check: |limits| {
            let parameters = oscillator(0.0, 0.0, 0.0, 0.1);
            let [end, _] = half_swing(&parameters, at_rest(1.0), limits)?;
            let gained = (-end).plus(-1.0);
            let fed = 2.0 * parameters.r;
            Ok(Finding::equal(fed, gained).corrected(-fed).at("D = 0, r = 0.1, from q = 1"))
        },
    },
    Claim {
        equation: "(9)",
        section: "3",
        statement: "without friction small motions grow as e^(-D tau)",
        basis: "motion",
        scene: Some("fig02"),
        check: |limits| over_damping(limits, |d, growth, _| Finding::equal(-d, growth)),
    },
    Claim {
        equation: "(9)",
        section: "3",
        statement: "without friction small motions have the frequency 1",
        basis: "motion",
        scene: Some("fig02"),
        check: |limits| {
            over_damping(limits, |d, _, frequency| {
                Finding::equal(1.0, frequency).corrected((1.0 - d * d).sqrt())
            })
        },
    },
    Claim {
        equation: "Fig. 2",
        section: "3",
        statement: "without friction the steady state is unstable for D < 0 and attracts for D > 0",
        basis: "motion",
        scene: Some("fig02"),
        check: |limits| {
            let mut cases = Vec::new();
            for d in [-0.9, -0.1, -1e-3, 1e-3, 0.1, 0.9] {
                let parameters = oscillator(d, 0.2, 0.5, 0.0);
                let [end, _] = half_swing(&parameters, at_rest(-1e-6), limits)?;
                let grows = end.exceeds(1e-6);
                cases.push((format!("D = {d}"), grows.is(d < 0.0)));
            }
            Ok(Finding::always(cases))
        },
    },
];

/// Rate and frequency of small motions without friction, at some values of D.
fn over_damping(
    limits: &Limits,
    compare: impl Fn(f64, Known, Known) -> Finding,
) -> Result<Finding, Reason> {
    Finding::worst([-0.7, -0.4, -0.1, 0.3].map(|d| {
        let parameters = Parameters { d, d2: 0.0, d3: 0.0, r: 0.0 };
        let [end, duration] = half_swing(&parameters, at_rest(-1.0), limits)?;
        let relative = end.error / end.value + duration.error / duration.value;
        let growth = ln(end.value) / duration.value;
        let growth = Known::new(growth, relative * (1.0 + growth.abs()));
        let frequency = Known::relative(std::f64::consts::PI / duration.value, relative)
            .within(duration.bounds.map(|it| PI / it));
        Ok(compare(d, growth, frequency).at(format!("D = {d}, r = 0")))
    }))
}

/// A mass on a belt, in SI units, whose friction falls exponentially with the relative velocity.
struct Mass {
    m: f64,
    c: f64,
    d1: f64,
    d3: f64,
    /// Normal force F.
    normal: f64,
    /// Velocity of the belt.
    belt: f64,
    /// Friction R of the joint.
    joint: f64,
}

/// The example: no two of its numbers make a factor 1.
const MASS: Mass = Mass { m: 2.0, c: 8.0, d1: 0.1, d3: 0.02, normal: 5.0, belt: 0.8, joint: 0.6 };

const MASS_PLACE: &str =
    "m = 2, c = 8, d1 = 0.1, d3 = 0.02, F = 5, v0 = 0.8, R = 0.6, mu = 0.2 + 0.3 exp(-v)";

impl Mass {
    fn friction(velocity: f64) -> f64 {
        0.2 + 0.3 * exp(-velocity)
    }

    /// First, second and third derivative of the friction by the relative velocity, at the belt's.
    fn friction_derivatives(&self) -> [f64; 3] {
        let falling = 0.3 * exp(-self.belt);
        [-falling, falling, -falling]
    }

    fn omega(&self) -> f64 {
        (self.c / self.m).sqrt()
    }

    /// The static displacement, at which the spring balances the belt.
    fn shift(&self) -> f64 {
        self.normal * Self::friction(self.belt) / self.c
    }

    /// Acceleration at the displacement `x` from the static one; `joint` is the force of the joint.
    fn acceleration(&self, x: f64, velocity: f64, joint: f64) -> f64 {
        let spring = self.c * (x + self.shift());
        let pull = self.normal * Self::friction(self.belt - velocity);
        (pull - spring - velocity * (self.d1 + self.d3 * velocity * velocity) + joint) / self.m
    }

    /// `q''` over q and q', friction of the joint included; the sign of a zero velocity is its side.
    fn dimensionless(&self, q: f64, v: f64) -> f64 {
        let (length, omega) = (self.shift(), self.omega());
        let joint = -self.joint * 1.0_f64.copysign(v);
        self.acceleration(q * length, v * length * omega, joint) / (length * omega * omega)
    }
}

/// A factor times a derivative of the dimensionless acceleration by the velocity; the side above.
fn coefficient(order: usize, factor: f64) -> Known {
    let (length, omega) = (MASS.shift(), MASS.omega());
    let smooth =
        |v: f64| MASS.acceleration(0.0, v * length * omega, 0.0) / (length * omega * omega);
    let derivative = derivatives(smooth)[order];
    Known::new(factor * derivative.value, (factor * derivative.error).abs())
}

/// First, second and third derivative at 0: central differences, extrapolated to step 0.
///
/// The error is what the last extrapolation changed, and the rounding of the differences.
fn derivatives(function: impl Fn(f64) -> f64) -> [Known; 3] {
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
        Known::new(row[0], last + rounding)
    })
}
