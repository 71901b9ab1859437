//! The reduction against the equation of motion itself.

use proptest::prelude::*;

use super::*;
use crate::model::unit::dimension_of;
use crate::model::{Field, Group, HalfPlane, Knob, Reason, Side};
use crate::numerics::{SmoothingSpline, exp, log10, powi};

/// Value and derivatives by central differences of `mu` with Richardson's extrapolation: they know
/// nothing of the formulas.
pub(crate) fn differences(mu: impl Fn(f64) -> f64, v: f64, scale: f64) -> Derivatives {
    let stencil = |h: f64| {
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|steps| mu(v + steps * h));
        let m = mu(v);
        [
            (c - b) / (2.0 * h),
            (c - 2.0 * m + b) / (h * h),
            (d - 2.0 * (c - b) - a) / (2.0 * powi(h, 3)),
        ]
    };
    let h = scale / 16.0;
    let levels: Vec<[f64; 3]> = (0..4).map(|level| stencil(h / f64::from(1 << level))).collect();
    let [first, second, third] = std::array::from_fn(|order| {
        let mut row: Vec<f64> = levels.iter().map(|level| level[order]).collect();
        let mut power = 4.0;
        while row.len() > 1 {
            row = row.windows(2).map(|pair| (power * pair[1] - pair[0]) / (power - 1.0)).collect();
            power *= 4.0;
        }
        row[0]
    });
    Derivatives { value: mu(v), first, second, third }
}

fn stribeck() -> Belt {
    Belt {
        mass: 2.0,
        stiffness: 800.0,
        damping: 3.0,
        cubic_damping: 40.0,
        normal_force: 60.0,
        friction: 1.5,
        belt_speed: 0.25,
        law: FrictionLaw::Stribeck {
            rest: 0.5,
            kinetic: 0.2,
            velocity: 0.3,
            exponent: 1.0,
            viscous: 0.02,
        },
        static_coefficient: None,
        static_guide: None,
    }
}

/// The force on the mass at displacement `x` (from the static one) and velocity `v`, in N and SI units, without the
/// friction element.
pub(crate) fn force(belt: &Belt, x: f64, v: f64) -> f64 {
    let mu = |slip| belt.law.mu(slip).unwrap();
    let damping = v * (belt.damping + v * v * belt.cubic_damping);
    let drag = mu(belt.belt_speed - v) - mu(belt.belt_speed);
    belt.normal_force * drag - damping - belt.stiffness * x
}

/// The dimensionless acceleration that the physical force means, at dimensionless q and v.
fn acceleration(belt: &Belt, units: &Units, q: f64, v: f64) -> f64 {
    force(belt, units.displacement * q, units.velocity * v) / units.force
}

#[test]
fn the_parameters_are_the_derivatives_of_the_equation_of_motion() {
    let belt = stribeck();
    let ReducedBelt { parameters, units, .. } = belt.reduce().unwrap();
    // q'' = -q - 2 D v - D2 v^2 - D3 v^3 - ..., differentiated numerically.
    let damping = differences(|v| acceleration(&belt, &units, 0.0, v), 0.0, 0.2);
    assert!((damping.value).abs() < 1e-15);
    assert!((damping.first / -(2.0 * parameters.d) - 1.0).abs() < 1e-9);
    assert!((damping.second / -(2.0 * parameters.d2) - 1.0).abs() < 1e-7);
    assert!((damping.third / -(6.0 * parameters.d3) - 1.0).abs() < 1e-5);
    let spring = differences(|q| acceleration(&belt, &units, q, 0.0), 0.0, 0.2);
    assert!((spring.first + 1.0).abs() < 1e-12);
    // The friction element, measured in the same unit of force.
    assert!((parameters.r * units.force / belt.friction - 1.0).abs() < 1e-15);
    assert!((units.time * units.time * belt.stiffness / belt.mass - 1.0).abs() < 1e-15);
}

#[test]
fn at_rest_the_spring_holds_the_pull_of_the_belt() {
    let belt = stribeck();
    let ReducedBelt { units, mu, .. } = belt.reduce().unwrap();
    let pull = belt.normal_force * belt.law.mu(belt.belt_speed).unwrap();
    assert!((belt.stiffness * units.displacement / pull - 1.0).abs() < 1e-15);
    assert!((units.force / pull - 1.0).abs() < 1e-15 && mu.value > 0.0);
}

#[test]
fn where_friction_falls_it_feeds_the_motion() {
    let mut belt = Belt { damping: 0.0, cubic_damping: 0.0, ..stribeck() };
    assert!(belt.law.at(belt.belt_speed).unwrap().first < 0.0);
    let falling = belt.reduce().unwrap().parameters;
    assert!(falling.d < 0.0);
    // The force along the motion, from the equation itself: positive work in both directions.
    for v in [1e-3, -1e-3] {
        assert!(force(&belt, 0.0, v) * v > 0.0);
    }
    belt.law = FrictionLaw::Polynomial { coefficients: vec![0.2, 0.3] };
    let rising = belt.reduce().unwrap().parameters;
    assert!(rising.d > 0.0);
}

#[test]
fn a_straight_characteristic_has_neither_asymmetry_nor_cubic_damping() {
    let law = FrictionLaw::Polynomial { coefficients: vec![0.5, -0.4] };
    let straight = Belt { law, cubic_damping: 0.0, ..stribeck() }.reduce().unwrap().parameters;
    assert_eq!((straight.d2.to_bits(), straight.d3), (0.0_f64.to_bits(), 0.0));
    let law = FrictionLaw::Constant { mu: 0.3 };
    let flat = Belt { law, cubic_damping: 0.0, ..stribeck() };
    let parameters = flat.reduce().unwrap().parameters;
    assert_eq!((parameters.d2, parameters.d3), (0.0, 0.0));
    // Nothing is left but the damper: 2 D = d1/sqrt(c m).
    assert!((2.0 * parameters.d - 3.0 / (800.0_f64 * 2.0).sqrt()).abs() < 1e-16);
    let error = flat.taylor_error((-0.2, 0.2)).unwrap();
    assert_eq!((error.force, error.of_change), (0.0, None));
}

#[test]
fn a_cubic_characteristic_is_the_scaled_field_itself() {
    let law = FrictionLaw::Polynomial { coefficients: vec![0.5, -0.4, 0.3, 0.7] };
    let belt = Belt { law, ..stribeck() };
    let ReducedBelt { parameters, units, sticking_velocity, .. } = belt.reduce().unwrap();
    let field = HalfPlane::new(&parameters, Side::Upper);
    for q in [-1.5, 0.0, 0.3] {
        for part in [-2.0, -0.5, 0.0, 0.5, 1.0] {
            let v = part * sticking_velocity;
            let expected = acceleration(&belt, &units, q, v);
            assert!((field.acceleration(q, v) - expected).abs() < 1e-13 * (1.0 + expected.abs()));
        }
    }
    let range = (-0.5, belt.belt_speed);
    assert!(belt.taylor_error(range).unwrap().force < 1e-13 * units.force);
}

#[test]
fn the_fields_differ_by_no_more_than_the_taylor_error() {
    let belt = stribeck();
    let ReducedBelt { parameters, units, .. } = belt.reduce().unwrap();
    let field = HalfPlane::new(&parameters, Side::Upper);
    let range = (-0.4, 0.25);
    let error = belt.taylor_error(range).unwrap();
    let difference = |v: f64| {
        let scaled = field.acceleration(0.0, v / units.velocity) * units.force;
        (scaled - force(&belt, 0.0, v)).abs()
    };
    let velocities = (0..=1300).map(|index| (-0.4 + 0.0005 * f64::from(index)).min(range.1));
    let largest = velocities.map(difference).fold(0.0, f64::max);
    assert!((largest / error.force - 1.0).abs() < 1e-9, "{largest} {error:?}");
    assert!(error.complete && error.at == -0.4 && error.force > 0.1);
    // The remainder is of fourth order.
    let narrow = belt.taylor_error((-0.04, 0.025)).unwrap();
    assert!(log10(error.force / narrow.force) > 3.5);
}

#[test]
fn the_error_is_measured_only_where_the_model_holds() {
    let belt = stribeck();
    let beyond = belt.taylor_error((-0.1, 0.4)).unwrap();
    assert_eq!((beyond.range, beyond.complete), ((-0.1, 0.25), false));
    let points: Vec<_> = (1..9).map(|index| (0.05 * f64::from(index), 0.3)).collect();
    let table = FrictionLaw::Table(SmoothingSpline::new(&points, 0.0).unwrap());
    let belt = Belt { law: table, ..belt };
    let inside = belt.taylor_error((-1.0, 0.4)).unwrap();
    assert!((inside.range.0 + 0.15).abs() < 1e-15 && (inside.range.1 - 0.2).abs() < 1e-15);
    assert_eq!(belt.taylor_error((0.3, 0.4)), None, "wholly beyond the belt");
}

#[test]
fn what_has_no_dimensionless_form_says_why() {
    let with = |law, belt_speed| Belt { belt_speed, law, ..stribeck() }.reduce().unwrap_err();
    let none = with(FrictionLaw::Constant { mu: 0.0 }, 0.2).to_string();
    assert!(none.contains("mu = 0 at v0 = 0.2 m/s; it must be positive"), "{none}");
    let points: Vec<_> = (1..9).map(|index| (0.05 * f64::from(index), 0.3)).collect();
    let table = FrictionLaw::Table(SmoothingSpline::new(&points, 0.0).unwrap());
    let outside = with(table, 0.5).to_string();
    assert!(
        outside.contains("outside the friction law; it reaches from 0.05 to 0.4 m/s"),
        "{outside}"
    );
    let huge = Belt { cubic_damping: 1e12, normal_force: 1e12, stiffness: 1e-12, ..stribeck() };
    assert!(matches!(huge.reduce(), Ok(_) | Err(Reason::Refused(_))));
}

/// The same machine in units `kg`, `m`, `s` times as large.
fn in_other_units(belt: &Belt, kg: f64, m: f64, s: f64) -> Belt {
    let FrictionLaw::Stribeck { rest, kinetic, velocity, exponent, viscous } = belt.law else {
        unreachable!("the machine of these tests")
    };
    let scale = |knob: Knob| {
        let [a, b, c] = dimension_of(knob.spec().unit);
        knob.of_belt(belt).unwrap()
            / (powi(kg, i32::from(a)) * powi(m, i32::from(b)) * powi(s, i32::from(c)))
    };
    let mut other = belt.clone();
    for knob in Group::Machine.knobs() {
        knob.set_in_belt(&mut other, scale(knob)).unwrap();
    }
    let speed = m / s;
    other.law = FrictionLaw::Stribeck {
        rest,
        kinetic,
        velocity: velocity / speed,
        exponent,
        viscous: viscous * speed,
    };
    other
}

proptest! {
    #[test]
    fn dimensionless_numbers_know_no_units(
        kg in -3.0_f64..3.0, m in -3.0_f64..3.0, s in -3.0_f64..3.0, v0 in 0.01_f64..1.0,
    ) {
        let belt = Belt { belt_speed: v0, ..stribeck() };
        let other = in_other_units(&belt, exp(kg), exp(m), exp(s));
        let (one, two) = (belt.reduce().unwrap(), other.reduce().unwrap());
        // The sums in D and D3 may cancel; what they are made of does not.
        let close = |one: f64, two: f64| (one - two).abs() < 1e-12 * (0.1 + one.abs());
        prop_assert!(close(one.parameters.d, two.parameters.d));
        prop_assert!(close(one.parameters.d2, two.parameters.d2));
        prop_assert!(close(one.parameters.d3, two.parameters.d3));
        prop_assert!(close(one.parameters.r, two.parameters.r));
        prop_assert!(close(one.sticking_velocity, two.sticking_velocity));
    }
}
