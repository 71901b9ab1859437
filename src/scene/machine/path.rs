//! The path of a machine through the parameters as the speed of its belt increases.
//!
//! Everything here is a formula of the friction law: a path costs a few hundred evaluations and no motion.

use super::ScaledMachine;
use crate::model::{Knob, Parameters};
use crate::numerics::{decade, exp, ln};

/// Slowest speed of a path, relative to the machine's own speed; the fastest is its reciprocal. The range of
/// the friction law may limit both.
const SLOWEST: f64 = 1.0 / 32.0;

/// Number of chords of a path: enough that they cannot be seen on a page some thousand pixels wide.
const POINTS: u32 = 600;

/// First digits of the speeds that get a mark, the roundest first.
const DIGITS: [&[u32]; 3] = [&[1], &[2, 5], &[3, 4, 7]];

/// A speed of the belt, in m/s, and the parameters there; `None` where the machine has none.
pub type Station = (f64, Option<Parameters>);

impl ScaledMachine {
    /// Points of the path at geometrically spaced speeds, from slow to fast.
    pub fn path(&self) -> Vec<Station> {
        let (slow, fast) = self.speeds();
        let ratio = ln(fast / slow);
        let speed = |point: u32| slow * exp(f64::from(point) / f64::from(POINTS) * ratio);
        let inner = (1..POINTS).map(speed);
        std::iter::once(slow).chain(inner).chain([fast]).map(|speed| self.station(speed)).collect()
    }

    /// Points of the path at round speeds, the roundest first.
    pub fn milestones(&self) -> Vec<Station> {
        let (slow, fast) = self.speeds();
        let exponents = decade(slow)..=decade(fast) + 1;
        let mut found = Vec::new();
        for digits in DIGITS {
            for exponent in exponents.clone() {
                // Parsed from decimal, so that it equals the typed number to the last bit.
                let round = digits.iter().filter_map(|it| format!("{it}e{exponent}").parse().ok());
                let inside = round.filter(|speed| (slow..=fast).contains(speed));
                found.extend(inside.map(|speed| self.station(speed)));
            }
        }
        found
    }

    /// The slowest and the fastest speed of the path.
    fn speeds(&self) -> (f64, f64) {
        let own = self.machine.belt.belt_speed;
        let (low, high) = self.machine.belt.law.range();
        // Only a table limits the speeds; all other laws hold from 0 to `f64::MAX`.
        ((SLOWEST * own).max(low), (own / SLOWEST).min(high))
    }

    fn station(&self, speed: f64) -> Station {
        let allowed = Knob::BeltSpeed.check(speed).ok();
        let reduced = allowed.and_then(|speed| self.machine.belt.reduce_at(speed).ok());
        (speed, reduced.map(|reduced| reduced.parameters))
    }
}

#[cfg(test)]
mod tests {
    use crate::numerics::elementary::ln;
    use crate::scene::ScaledMachine;
    use crate::scene::machine::library::machines;

    #[test]
    fn a_path_leads_through_the_machine_as_it_is_and_within_its_law() {
        for machine in machines() {
            let scaled = ScaledMachine::try_from(machine.clone()).unwrap();
            let (path, own) = (scaled.path(), machine.belt.belt_speed);
            assert!(path.windows(2).all(|pair| pair[0].0 < pair[1].0), "{}", machine.name);
            let (low, high) = machine.belt.law.range();
            assert!(path.iter().all(|(speed, _)| (low..=high).contains(speed)), "{}", machine.name);
            let near = path
                .iter()
                .min_by(|one, other| ln(one.0 / own).abs().total_cmp(&ln(other.0 / own).abs()));
            let (speed, parameters) = near.unwrap();
            let (d, exact) = (parameters.unwrap().d, scaled.reduced.parameters.d);
            assert!((speed / own - 1.0).abs() < 0.01 && (d - exact).abs() < 0.01);
        }
    }

    #[test]
    fn a_path_ends_where_friction_does() {
        let machine = machines().iter().find(|machine| machine.name == "straight").unwrap();
        let path = ScaledMachine::try_from(machine.clone()).unwrap();
        let path = path.path();
        // mu = 0.5 - 0.4 v
        assert!(path.iter().all(|(speed, parameters)| parameters.is_some() == (*speed < 1.25)));
        assert!(path.iter().any(|(speed, _)| *speed > 1.25));
    }

    #[test]
    fn milestones_are_the_numbers_that_one_would_type() {
        let machine = machines().iter().find(|machine| machine.name == "textbook").unwrap();
        let scaled = ScaledMachine::try_from(machine.clone()).unwrap();
        let speeds: Vec<f64> = scaled.milestones().into_iter().map(|(speed, _)| speed).collect();
        assert_eq!(speeds[..5], [0.01, 0.1, 1.0, 0.02, 0.05]);
        assert!(
            speeds.contains(&0.3) && speeds.iter().all(|speed| (0.3 / 32.0..=9.6).contains(speed))
        );
    }
}
