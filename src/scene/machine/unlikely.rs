//! Numbers that hardly any machine has. They are read, but probably a unit was left out or mistaken.

use std::f64::consts::TAU;

use crate::model::Body;
use crate::numerics::shortest;
use crate::words::significant;

/// What is looked at: name, meaning, SI unit, and the smallest and largest likely size.
type Likely = (&'static str, &'static str, &'static str, [f64; 2]);

/// `F mu(v0)/c`, by which the belt deflects the spring.
const DEFLECTION: Likely = ("x0", "spring's deflection", "m", [1e-9, 1.0]);
const FREQUENCY: Likely = ("f", "natural frequency", "Hz", [0.05, 1e6]);
const BELT_SPEED: Likely = ("v0", "belt speed", "m/s", [1e-6, 100.0]);
const NORMAL_FORCE: Likely = ("F", "force onto the belt", "N", [1e-6, 1e7]);
const DISPLACEMENT: Likely = ("x", "displacement at the start", "m", [0.0, 2.0]);
const VELOCITY: Likely = ("v", "velocity at the start", "m/s", [0.0, 100.0]);

/// One line about the first number that is unlikely, with displacement (m) and velocity (m/s) at the start.
pub fn unlikely(body: &Body, (x, v): (f64, f64)) -> Option<String> {
    let mut sizes = match body {
        Body::Belt(belt) => {
            let units = belt.reduce().ok()?.units;
            vec![
                (DEFLECTION, units.displacement),
                (FREQUENCY, units.omega_0 / TAU),
                (BELT_SPEED, belt.belt_speed),
                (NORMAL_FORCE, belt.normal_force),
            ]
        }
        Body::Paper(_) => return None,
        Body::Mode(mode) => vec![(FREQUENCY, mode.frequency)],
    };
    sizes.extend([(DISPLACEMENT, x.abs()), (VELOCITY, v.abs())]);
    let ((name, meaning, unit, [least, most]), size) =
        sizes.into_iter().find(|((.., [least, most]), size)| !(*least..=*most).contains(size))?;
    let (side, bound) = if size > most {
        ("above", most)
    } else {
        ("below", least)
    };
    let [size, bound] = [significant(size, 2), shortest(bound)];
    Some(format!(
        "{name} = {size} {unit}, the {meaning}, is {side} {bound} {unit}: is a unit missing?"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::machine::library::machines;

    /// What is unlikely about the textbook's machine after a change.
    fn after(change: impl FnOnce(&mut crate::model::Belt)) -> Option<String> {
        let mut belt = machines()[0].belt.clone();
        change(&mut belt);
        unlikely(&Body::Belt(Box::new(belt)), (0.0, 0.0))
    }

    #[test]
    fn a_stiffness_in_the_wrong_unit_is_unlikely() {
        let line = after(|belt| belt.stiffness = 5.0).unwrap();
        assert!(
            line.starts_with("x0 = 5.5 m, the spring's deflection") && line.contains("above 1"),
            "{line}"
        );
        let line = after(|belt| belt.belt_speed = 300.0).unwrap();
        assert!(line.starts_with("v0 = 300 m/s"), "{line}");
        let line = after(|belt| belt.mass = 2e6).unwrap();
        assert!(line.starts_with("f = 0.008 Hz") && line.contains("below 0.05 Hz"), "{line}");
    }

    #[test]
    fn the_machines_of_the_program_are_likely() {
        for machine in machines() {
            let body = Body::Belt(Box::new(machine.belt.clone()));
            let start = (machine.displacement, machine.velocity);
            assert_eq!(unlikely(&body, start), None, "{}", machine.name);
        }
    }
}
