use super::*;
use crate::flow::{Detail, Limits, Problem, trajectory};
use crate::model::belt::tests::force;
use crate::model::{Belt, FrictionLaw, ReducedBelt, TaylorError, Units};
use crate::numerics::elementary::{asin, pow, powi, tanh};
use crate::paper::model::machine as paper;
use crate::portrait::Portrait;

fn belt() -> Belt {
    Belt { belt_speed: 0.3, ..paper() }
}

/// The motion of the oscillator that the machine reduces to, and where it reaches the velocity of the belt.
fn motion(belt: &Belt, start: (f64, f64), until: f64) -> (Motion, Option<(f64, f64)>, Units) {
    let ReducedBelt { parameters, units, sticking_velocity, .. } = belt.reduce().unwrap();
    let problem = Problem {
        parameters,
        initial: State { q: start.0 / units.displacement, v: start.1 / units.velocity },
        until: until / units.time,
        ..Problem::default()
    };
    let detail = Detail { crossings: true, samples_per_step: 8, energy: false };
    let motion = trajectory(&problem, detail, &Limits::PATIENT);
    let sticks = first_at(&motion, sticking_velocity);
    (motion, sticks, units)
}

/// The largest velocity of a motion.
fn fastest(motion: &Motion) -> f64 {
    bisect(0.0, 1e3, TO_ROUNDING, |velocity| first_at(motion, velocity).is_none()).0
}

/// What the cubic leaves out of friction over the velocities of a motion.
fn left_out(belt: &Belt, start: (f64, f64), until: f64) -> TaylorError {
    let (motion, _, units) = motion(belt, start, until);
    let low = motion.samples.iter().map(|sample| sample.v).fold(0.0, f64::min);
    let high = fastest(&motion);
    belt.taylor_error((low * units.velocity, high * units.velocity)).unwrap()
}

/// The equation of motion itself, in kg, m and s, by classical Runge-Kutta steps; a half swing ends at
/// `v = 0` by halving the last step. Knows nothing of scaling, Taylor expansion or Taylor series.
fn turning_points(belt: &Belt, start: (f64, f64), until: f64) -> Vec<(f64, f64)> {
    let side = |x: f64| if belt.stiffness * x > 0.0 { -1.0 } else { 1.0 };
    let (mut t, mut x, mut v, mut sign) = (0.0, start.0, start.1, side(start.0));
    if v != 0.0 {
        sign = f64::signum(v);
    }
    let slope =
        |x: f64, v: f64, sign: f64| (v, (force(belt, x, v) - sign * belt.friction) / belt.mass);
    let step = |x: f64, v: f64, sign: f64, h: f64| {
        let k1 = slope(x, v, sign);
        let k2 = slope(x + 0.5 * h * k1.0, v + 0.5 * h * k1.1, sign);
        let k3 = slope(x + 0.5 * h * k2.0, v + 0.5 * h * k2.1, sign);
        let k4 = slope(x + h * k3.0, v + h * k3.1, sign);
        (
            x + h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0),
            v + h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1),
        )
    };
    let h = 2e-5;
    let mut found = Vec::new();
    while t < until {
        let next = step(x, v, sign, h);
        if sign * next.1 > 0.0 {
            (t, x, v) = (t + h, next.0, next.1);
            continue;
        }
        let (_, high) = bisect(0.0, h, TO_ROUNDING, |part| sign * step(x, v, sign, part).1 <= 0.0);
        (t, x, v) = (t + high, step(x, v, sign, high).0, 0.0);
        found.push((t, x));
        if belt.stiffness * x.abs() <= belt.friction {
            break;
        }
        sign = side(x);
    }
    found
}

/// The largest distance between the turning points of the equation of motion and of the scaled model, in
/// m and s.
fn apart(belt: &Belt, start: (f64, f64), until: f64) -> (usize, f64, f64) {
    let full = turning_points(belt, start, until);
    let (model, _, units) = motion(belt, start, until);
    let pairs = full.iter().zip(&model.crossings);
    let apart = pairs.map(|((t, x), turn)| {
        ((turn.q * units.displacement - x).abs(), (turn.tau * units.time - t).abs())
    });
    let (x, t) =
        apart.fold((0.0, 0.0), |worst, (x, t)| (f64::max(worst.0, x), f64::max(worst.1, t)));
    assert_eq!(full.len(), model.crossings.len());
    (full.len(), x, t)
}

#[test]
fn a_cubic_characteristic_is_the_physical_motion_itself() {
    let law = FrictionLaw::Polynomial { coefficients: vec![0.5, -0.9, 0.8, -0.2] };
    let belt = Belt { law, damping: 45.0, friction: 0.1, ..belt() };
    let (turns, x, t) = apart(&belt, (0.001, 0.0), 1.0);
    assert!(turns > 10 && x < 1e-11 && t < 1e-9, "{turns} turns, {x} m, {t} s");
}

#[test]
fn the_physical_motion_is_as_far_off_as_the_taylor_error_allows() {
    let belt = belt();
    let start = (0.0012, 0.0);
    let (turns, x, _) = apart(&belt, start, 0.5);
    let error = left_out(&belt, start, 0.5);
    // A force that is wrong by e displaces by e/c at rest, and at most 2 e/c a half swing at resonance,
    // each grown by the self-excitation since.
    let growth = powi(1.4, i32::try_from(turns).unwrap());
    let allowed = 2.0 * growth * error.force / belt.stiffness;
    assert!(turns >= 7 && x > 1e-9 && x < allowed, "{turns} turns, {x} of {allowed} m");
    // And the remainder is of fourth order: half the motion, a sixteenth of the force.
    let half = left_out(&belt, (0.0006, 0.0), 0.05);
    let whole = left_out(&belt, start, 0.05);
    assert!(whole.force / half.force > pow(2.0, 3.5));
}

#[test]
fn a_motion_that_overtakes_the_belt_is_told_with_its_time() {
    // An undamped oscillator without friction, x = a cos(omega t): it is fastest at 3/4 of a period.
    let law = FrictionLaw::Constant { mu: 0.25 };
    let free = Belt { damping: 0.0, cubic_damping: 0.0, friction: 0.0, law, ..belt() };
    let amplitude = |speed: f64| speed / 50.0;
    let (slow, never, units) = motion(&free, (amplitude(0.2999), 0.0), 1.0);
    assert_eq!(never, None);
    assert!((fastest(&slow) * units.velocity / 0.2999 - 1.0).abs() < 1e-7, "{slow:?}");
    let (_, fast, _) = motion(&free, (amplitude(0.6), 0.0), 1.0);
    let contact = (std::f64::consts::PI + asin(0.5)) / 50.0;
    assert!((fast.unwrap().0 * units.time - contact).abs() < 1e-6, "{fast:?}");
    let (_, at_once, _) = motion(&free, (0.0, 0.3), 1.0);
    assert_eq!(at_once, Some((0.0, 0.0)));
}

#[test]
fn cycles_and_margins_come_back_in_physical_units() {
    let law = FrictionLaw::Polynomial { coefficients: vec![0.5, -0.4] };
    let linear = Belt { law, cubic_damping: 0.0, ..belt() };
    let ReducedBelt { parameters, units, .. } = linear.reduce().unwrap();
    let found = Portrait::of_oscillator(&parameters, 1e3, &Limits::PATIENT).unwrap();
    let found = found.drawn(&parameters, 12).unwrap();
    let margin = found.margin;
    let margin = margin.map(|q| q * units.displacement, |speed| speed * units.impulse);
    // A_q = r coth(x/2), x = -pi D/omega (equation 32); in metres R/c takes the place of r.
    let x = -std::f64::consts::PI * parameters.d / parameters.omega().unwrap();
    let expected = linear.friction / linear.stiffness / tanh(0.5 * x);
    assert!((margin.displacement.unwrap() / expected - 1.0).abs() < 1e-12);
    let speed = margin.impulse.unwrap() / linear.mass;
    assert!((found.cycles[0].v_max * units.velocity / speed - 1.0).abs() < 0.1);
}
