//! The friction law as forces on the mass: on either side of the belt's speed, with the damper's.

use super::force::{Fall, ForceBranch, ForcePiece, shifted};
use crate::model::belt::FrictionLaw;
use crate::numerics::elementary::{pow, powi};

/// A piece of a law: from which slip to which, and the coefficients of powers of the distance from its lower
/// end.
type Stretch = (f64, f64, Vec<f64>);

/// Beyond this power the exponential part is lost in rounding. It is left out there, because a series cannot
/// see from far what comes up so steeply; where it ends a step ends too.
const LOST: f64 = 42.0;

/// The law as pieces of polynomials in the slip, and its exponential part.
pub(crate) struct ScaledLaw {
    pieces: Vec<Stretch>,
    /// Drop, velocity and exponent.
    fall: Option<(f64, f64, f64)>,
}

impl ScaledLaw {
    /// The law as a force: coefficients times `force`, velocities divided by `omega_0`.
    pub fn new(law: &FrictionLaw, force: f64, omega_0: f64) -> Self {
        let scaled = |coefficients: &[f64]| -> Vec<f64> {
            let power = |power| powi(omega_0, i32::try_from(power).unwrap_or(i32::MAX));
            coefficients.iter().enumerate().map(|(k, number)| force * number * power(k)).collect()
        };
        let whole = |coefficients: &[f64]| vec![(0.0, f64::INFINITY, scaled(coefficients))];
        let straight = |from: f64, to: f64, kinetic: f64, viscous: f64| {
            let coefficients = scaled(&[kinetic + viscous * from, viscous]);
            (from / omega_0, to / omega_0, coefficients)
        };
        match law {
            FrictionLaw::Constant { mu } => ScaledLaw { pieces: whole(&[*mu]), fall: None },
            FrictionLaw::Polynomial { coefficients } => {
                ScaledLaw { pieces: whole(coefficients), fall: None }
            }
            FrictionLaw::Stribeck { rest, kinetic, velocity, exponent, viscous } => {
                let end = velocity * pow(LOST, 1.0 / exponent);
                let drop = force * (rest - kinetic);
                ScaledLaw {
                    pieces: vec![
                        straight(0.0, end, *kinetic, *viscous),
                        straight(end, f64::INFINITY, *kinetic, *viscous),
                    ],
                    fall: (drop != 0.0).then_some((drop, velocity / omega_0, *exponent)),
                }
            }
            FrictionLaw::Table(spline) => ScaledLaw {
                pieces: spline
                    .polynomials()
                    .map(|(from, to, c)| (from / omega_0, to / omega_0, scaled(&c)))
                    .collect(),
                fall: None,
            },
        }
    }
}

/// The damper's part of the force, in powers of `y - center`.
fn damper_about(damper: &[f64], center: f64) -> Vec<f64> {
    shifted(damper, center).into_iter().map(|number| 0.0 - number).collect()
}

fn added(mut one: Vec<f64>, other: impl Iterator<Item = f64>) -> Vec<f64> {
    for (k, number) in other.enumerate() {
        if k < one.len() { one[k] += number } else { one.push(number) }
    }
    while one.len() > 1 && one.last() == Some(&0.0) {
        one.pop();
    }
    one
}

/// The force at velocities up to the belt's: `T - x0` less the damper's.
pub(crate) fn slower(
    law: &ScaledLaw,
    damper: &[f64],
    speed: f64,
    pull: f64,
    reach: f64,
) -> ForceBranch {
    let alternating = |(k, number): (usize, f64)| if k % 2 == 0 { number } else { 0.0 - number };
    let piece = |(from, to, coefficients): &Stretch| {
        let to = to.min(reach);
        if from > &to {
            return None;
        }
        let steady = (*from..=to).contains(&speed);
        // The slip falls where the velocity rises.
        let (center, about) = if steady { (0.0, speed) } else { (speed - from, *from) };
        let pull_of = shifted(coefficients, about - from).into_iter().enumerate().map(alternating);
        let mut coefficients = added(damper_about(damper, center), pull_of);
        coefficients[0] = if steady { 0.0 } else { coefficients[0] - pull };
        Some(ForcePiece {
            low: speed - to,
            high: speed - from,
            center,
            coefficients,
            falls: *from == 0.0,
        })
    };
    let mut pieces: Vec<ForcePiece> = law.pieces.iter().filter_map(piece).collect();
    pieces.reverse();
    let fall = |(drop, velocity, exponent)| Fall { drop, velocity, exponent, speed, above: false };
    ForceBranch { pieces, fall: law.fall.map(fall) }
}

/// The force at velocities above the belt's: `-T` less the damper's.
pub(crate) fn faster(law: &ScaledLaw, damper: &[f64], speed: f64, reach: f64) -> ForceBranch {
    let piece = |(from, to, coefficients): &Stretch| {
        let to = to.min(reach);
        let center = speed + from;
        let pull = coefficients.iter().map(|number| 0.0 - number);
        let coefficients = added(damper_about(damper, center), pull);
        let falls = *from == 0.0;
        (from <= &to).then_some(ForcePiece {
            low: center,
            high: speed + to,
            center,
            coefficients,
            falls,
        })
    };
    let fall = |(drop, velocity, exponent)| Fall { drop, velocity, exponent, speed, above: true };
    ForceBranch { pieces: law.pieces.iter().filter_map(piece).collect(), fall: law.fall.map(fall) }
}
