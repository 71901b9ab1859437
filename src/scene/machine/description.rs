//! What a file describes: a machine or a vibration mode; the dimensionless form of a machine, and what the numbers
//! of a motion mean at some speed of its belt; and its setting, that speed and the numbers that differ from its file.
//!
//! The speed of the belt changes D, D2, D3 and r together, along a path through the parameters that the
//! friction law determines. It also changes the units of length, velocity and force. The start, in metres and
//! metres per second, stays.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::flow::{Problem, Reason, Result, Subject};
use crate::model::{Belt, Body, Group, Knob, Model, RangeError, ReducedBelt, State, Tolerances};
use crate::numerics::powi;

/// What a file describes: a machine or a vibration mode, and one motion of it.
#[derive(Clone, Debug)]
pub struct Description {
    /// The name by which it is opened.
    pub name: String,
    pub title: String,
    /// What it is, and what to look at, in a sentence or two.
    pub watch: String,
    pub subject: Subject,
}

/// Why a mode cannot be drawn.
pub const NO_BELT: &str =
    "a vibration mode has no belt to be drawn; `hopfscope belt FILE` answers about it";

/// A machine: a mass on a belt, and the start of the motion on show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// The name by which it is opened.
    pub name: String,
    pub title: String,
    /// What it is, and what to look at, in a sentence or two.
    #[serde(rename = "look")]
    pub watch: String,
    pub belt: Belt,
    /// How exactly its numbers are known, and what disturbs it.
    #[serde(default, skip_serializing_if = "Tolerances::is_none")]
    pub tolerances: Tolerances,
    /// Displacement from the static one at which the motion starts, in m.
    pub displacement: f64,
    /// Velocity at which it starts, in m/s.
    pub velocity: f64,
    /// How long the motion is followed, in s.
    pub until: f64,
}

impl Machine {
    /// Its description.
    pub fn described(&self) -> Description {
        let Machine { name, title, watch, belt, tolerances, .. } = self.clone();
        let start = (self.displacement, self.velocity);
        let subject = Subject::moving((&belt).into(), tolerances, start, self.until);
        Description { name, title, watch, subject }
    }
}

impl TryFrom<Description> for Machine {
    type Error = &'static str;

    /// Fails for a vibration mode.
    fn try_from(described: Description) -> Result<Self, &'static str> {
        let Description { name, title, watch, subject } = described;
        let (displacement, velocity) = subject.start();
        let Subject { source, tolerances, motion: Problem { until, .. } } = subject;
        let Body::Belt(belt) = source.body else { return Err(NO_BELT) };
        Ok(Machine { name, title, watch, belt: *belt, tolerances, displacement, velocity, until })
    }
}

/// A machine with its dimensionless form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Machine", into = "Machine")]
pub struct ScaledMachine {
    pub machine: Machine,
    pub reduced: ReducedBelt,
}

impl TryFrom<Machine> for ScaledMachine {
    type Error = Reason;

    /// Computes the dimensionless form of a machine. Fails with [`Reason`] where there is none.
    fn try_from(machine: Machine) -> Result<Self> {
        let reduced = machine.belt.reduce()?;
        Ok(ScaledMachine { machine, reduced })
    }
}

impl From<ScaledMachine> for Machine {
    fn from(scaled: ScaledMachine) -> Self {
        scaled.machine
    }
}

impl ScaledMachine {
    /// The motion of the machine at its own belt speed.
    pub fn problem(&self) -> Problem {
        Problem {
            parameters: self.reduced.parameters,
            initial: self.start(),
            until: self.machine.until / self.reduced.units.time,
            ..Problem::default()
        }
    }

    /// The terms of the model that the machine needs: D and r always, D2 and D3 where they are not zero.
    pub fn terms(&self) -> BTreeSet<Knob> {
        let parameters = &self.reduced.parameters;
        let needs =
            |symbol: &Knob| matches!(symbol, Knob::D | Knob::R) || parameters.value(*symbol) != 0.0;
        Knob::PARAMETERS.into_iter().filter(needs).collect()
    }

    /// The start of the machine's motion, in the units at this speed.
    pub fn start(&self) -> State {
        let units = &self.reduced.units;
        let Machine { displacement, velocity, .. } = self.machine;
        State { q: displacement / units.displacement, v: velocity / units.velocity }
    }

    /// Converts a motion of this machine to one at another speed: with the parameters of the machine there, and
    /// from the same start in metres and metres per second.
    pub fn brought_to(&self, other: &Self, problem: Problem) -> Problem {
        let (own, others) = (self.start(), other.start());
        let (from, to) = (&self.reduced.units, &other.reduced.units);
        // The machine's own start is not rescaled, so no rounding accumulates from speed to speed.
        let moved = |value: f64, own: f64, others: f64, scale: f64| {
            if value == own { others } else { value * scale }
        };
        let State { q, v } = problem.initial;
        let initial = State {
            q: moved(q, own.q, others.q, from.displacement / to.displacement),
            v: moved(v, own.v, others.v, from.velocity / to.velocity),
        };
        Problem { parameters: other.reduced.parameters, initial, ..problem }
    }

    /// The number of the machine that a number of the motion determines while all else is fixed, and its value in
    /// SI units. D determines the damper d1, D3 determines d3, and r determines R.
    ///
    /// `None` for D2, which no single part of the machine determines.
    pub fn meaning(&self, symbol: Knob, value: f64) -> Option<(Knob, f64)> {
        let (mu, force) = (&self.reduced.mu, self.machine.belt.normal_force);
        let total = value * self.scale(symbol);
        Some(match symbol {
            Knob::D => (Knob::Damping, rest_of(total, force * mu.first)),
            Knob::D3 => (Knob::CubicDamping, rest_of(total, force * mu.third / 6.0)),
            Knob::R => (Knob::Friction, total),
            Knob::Q0 => (Knob::X, total),
            Knob::V0 => (Knob::V, total),
            _ => return None,
        })
    }

    /// The unit of a number of the motion, in SI units; for D2, that of damping per velocity. A number of the machine
    /// is in SI units itself.
    pub fn scale(&self, symbol: Knob) -> f64 {
        let units = &self.reduced.units;
        let mass = self.machine.belt.mass;
        match symbol {
            Knob::D => 2.0 * mass * units.omega_0,
            Knob::D2 => mass / units.displacement,
            Knob::D3 => mass / (units.omega_0 * powi(units.displacement, 2)),
            Knob::R => units.force,
            Knob::Q0 => units.displacement,
            Knob::V0 => units.velocity,
            _ => 1.0,
        }
    }

    /// The pull of the belt on the mass at a dimensionless velocity, as a fraction of the pull at rest; `None`
    /// outside the range of the friction law.
    pub fn pull(&self, v: f64) -> Option<f64> {
        let relative = self.machine.belt.belt_speed - v * self.reduced.units.velocity;
        Some(self.machine.belt.law.mu(relative)? / self.reduced.mu.value)
    }
}

/// `whole - part`, or zero where the difference is no more than the rounding errors of both.
fn rest_of(total: f64, part: f64) -> f64 {
    const ROUNDINGS: f64 = 8.0 * f64::EPSILON;
    let rest = total - part;
    if rest.abs() <= ROUNDINGS * (total.abs() + part.abs()) {
        0.0
    } else {
        rest
    }
}

/// The speed of a belt and the other numbers of a machine that were changed, in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SavedSetting", into = "SavedSetting")]
pub struct Setting(BTreeMap<Knob, f64>);

/// A setting as it is saved: a speed alone, or all changed numbers by name.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum SavedSetting {
    Speed(f64),
    Numbers(BTreeMap<String, f64>),
}

impl From<Setting> for SavedSetting {
    fn from(setting: Setting) -> Self {
        if let (1, Some(speed)) = (setting.0.len(), setting.get(Knob::BeltSpeed)) {
            return SavedSetting::Speed(speed);
        }
        let named = setting.0.into_iter().map(|(knob, value)| (knob.to_string(), value));
        SavedSetting::Numbers(named.collect())
    }
}

impl TryFrom<SavedSetting> for Setting {
    type Error = String;

    fn try_from(saved: SavedSetting) -> Result<Self, String> {
        let numbers = match saved {
            SavedSetting::Speed(speed) => return Ok(Setting::of_speed(speed)),
            SavedSetting::Numbers(numbers) => numbers,
        };
        numbers.get("v0").ok_or("a machine without the speed v0 of its belt")?;
        let knob = |name: &str| Knob::named(name, &[Group::Machine, Group::Law]);
        let numbers = numbers.into_iter().map(|(name, value)| Ok((knob(&name)?, value)));
        numbers.collect::<Result<_, _>>().map(Setting)
    }
}

impl Setting {
    /// The setting with this belt speed and all other numbers from the file.
    pub fn of_speed(speed: f64) -> Self {
        Setting(BTreeMap::from([(Knob::BeltSpeed, speed)]))
    }

    /// A number that is set; `None` where the file's value holds.
    pub fn get(&self, knob: Knob) -> Option<f64> {
        self.0.get(&knob).copied()
    }

    /// This setting with another value of one number.
    pub fn with(mut self, knob: Knob, value: f64) -> Self {
        self.0.insert(knob, value);
        self
    }

    /// Checks all numbers against their ranges. Fails with the first one that is outside.
    pub fn check(&self) -> Result<(), RangeError> {
        self.0.iter().try_for_each(|(knob, value)| knob.check(*value).map(drop))
    }

    /// A machine with these numbers. The static friction of its guide, where it is not set, is raised to the sliding
    /// friction where it would be less. Fails with one line if a number is outside its range, or the machine lacks it or is
    /// none with it, such as at a speed that its friction law does not reach.
    pub fn on(&self, machine: &Machine) -> Result<ScaledMachine, String> {
        self.check()?;
        let mut set = machine.clone();
        for (knob, value) in &self.0 {
            knob.set_in_belt(&mut set.belt, *value)?;
        }
        if self.get(Knob::StaticGuide).is_none() {
            let moving = set.belt.friction;
            set.belt.static_guide = set.belt.static_guide.map(|at_rest| at_rest.max(moving));
        }
        Model::new(&set.belt).map_err(|refused| refused.to_string())?;
        ScaledMachine::try_from(set).map_err(|refused| refused.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::machine::library::machines;

    #[test]
    fn a_machine_written_down_comes_back_as_it_was() {
        for machine in machines() {
            let scaled = ScaledMachine::try_from(machine.clone()).unwrap();
            let text = serde_json::to_string(&scaled).unwrap();
            assert_eq!(
                serde_json::from_str::<ScaledMachine>(&text).unwrap(),
                scaled,
                "{}",
                machine.name
            );
            let broken = text.replacen("\"mass\":", "\"mass\":-", 1);
            assert!(serde_json::from_str::<ScaledMachine>(&broken).is_err());
        }
    }

    #[test]
    fn numbers_mean_the_quantities_of_the_machine() {
        for machine in machines() {
            let scaled = ScaledMachine::try_from(machine.clone()).unwrap();
            let problem = scaled.problem();
            for (symbol, expected) in [
                (Knob::D, machine.belt.damping),
                (Knob::D3, machine.belt.cubic_damping),
                (Knob::R, machine.belt.friction),
                (Knob::Q0, machine.displacement),
                (Knob::V0, machine.velocity),
            ] {
                let value = problem.get(symbol);
                let (name, found) = scaled.meaning(symbol, value).unwrap();
                let size = match symbol {
                    Knob::D => machine.belt.normal_force * scaled.reduced.mu.first,
                    Knob::D3 => machine.belt.normal_force * scaled.reduced.mu.third,
                    _ => 0.0,
                };
                let scale = expected.abs() + size.abs();
                assert!(
                    (found - expected).abs() <= 1e-12 * scale,
                    "{}: {name} {found}",
                    machine.name
                );
            }
        }
    }

    #[test]
    fn a_damper_that_a_machine_does_not_have_is_zero_at_every_speed() {
        let mut looked = 0;
        for machine in machines().iter().filter(|it| it.belt.cubic_damping == 0.0) {
            for percent in 50..150_u8 {
                let speed = f64::from(percent) / 100.0 * machine.belt.belt_speed;
                let Ok(running) = Setting::of_speed(speed).on(machine) else { continue };
                let value = running.reduced.parameters.d3;
                let (_, found) = running.meaning(Knob::D3, value).unwrap();
                assert_eq!(found, 0.0, "{} at {speed} m/s", machine.name);
                looked += 1;
            }
        }
        assert!(looked > 100, "{looked}");
    }

    #[test]
    fn another_speed_is_another_machine_with_the_same_start_in_metres() {
        for machine in machines() {
            let own = ScaledMachine::try_from(machine.clone()).unwrap();
            let speed = 1.25 * machine.belt.belt_speed;
            let mut faster = machine.clone();
            faster.belt.belt_speed = speed;
            let faster = ScaledMachine::try_from(faster).unwrap();
            let running = Setting::of_speed(speed).on(machine).unwrap();
            let moved = own.brought_to(&running, own.problem());
            assert_eq!(moved, faster.problem(), "{}", machine.name);
            assert_eq!(running.brought_to(&own, moved), own.problem());
            assert_eq!(running.reduced.parameters, moved.parameters);
            // A start chosen by the user keeps its place in metres, up to rounding.
            let initial = State { q: 0.7, v: -0.3 };
            let moved = own.brought_to(&running, Problem { initial, ..own.problem() });
            for (symbol, value) in [(Knob::Q0, 0.7), (Knob::V0, -0.3)] {
                let before = own.meaning(symbol, value).unwrap().1;
                let after = moved.get(symbol);
                let after = running.meaning(symbol, after).unwrap().1;
                assert!((after / before - 1.0).abs() < 1e-15, "{}", machine.name);
            }
        }
    }

    #[test]
    fn speeds_at_which_there_is_no_machine_are_refused_in_one_line() {
        let find = |name: &str| machines().iter().find(|machine| machine.name == name).unwrap();
        for (machine, speed, words) in [
            ("textbook", 0.0, "v0 = 0 m/s is outside its range"),
            ("textbook", -0.3, "v0 = -0.3 m/s is outside its range"),
            ("textbook", f64::NAN, "v0 = NaN m/s is outside its range"),
            ("slideway", 10.0, "v0 = 10 m/s is outside the friction law; it reaches from"),
            ("straight", 1.25, "mu = 0 at v0 = 1.25 m/s; it must be positive"),
        ] {
            let refused = Setting::of_speed(speed).on(find(machine)).unwrap_err();
            assert!(refused.contains(words) && !refused.contains('\n'), "{machine}: {refused}");
        }
    }
}
