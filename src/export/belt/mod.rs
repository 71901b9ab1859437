//! What a mass on a belt does, in physical units beside the dimensionless ones.

mod document;
mod sweep;
mod table;

pub use document::json;
pub use sweep::{Sweep, csv as sweep_csv, json as sweep_json, table as sweep_table};
pub use table::{csv, table};

use crate::oscillator::Belt;
use crate::oscillator::belt::QUANTITIES;
use crate::oscillator::belt::Units;
use crate::scene::Machine;
use crate::study::belt::{Alarm, Survey};
use crate::study::design::{Design, Kick, Needed};
use crate::view::number::significant;
use crate::view::quantity::with_unit;

/// Everything that is said about a machine.
pub struct Answer<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// What it does.
    pub survey: &'a Survey,
    /// The friction for a margin, if asked for.
    pub design: Option<Designed>,
    /// What it took.
    pub seconds: f64,
}

/// The friction for a margin.
#[derive(Clone, Copy, Debug)]
pub struct Designed {
    /// The kick that is to be survived.
    pub kick: Kick,
    /// Its size: m for a displacement, N s for an impulse.
    pub wanted: f64,
    /// The friction, dimensionless.
    pub design: Design,
}

/// Digits of a physical quantity in a text.
const PLACES: usize = 5;

impl Designed {
    /// The friction for it, in N.
    fn force(&self, units: &Units) -> Option<f64> {
        match self.design.needed {
            Needed::Any => None,
            Needed::Friction { r } | Needed::Fold { r, .. } => Some(r * units.force),
        }
    }

    /// Size of the kick that is 1, and its unit.
    fn unit(&self, units: &Units) -> (f64, &'static str) {
        match self.kick {
            Kick::Displacement => (units.displacement, "m"),
            Kick::Impulse => (units.impulse, "N s"),
        }
    }

    /// The answer in a sentence.
    fn sentence(&self, belt: &Belt, units: &Units) -> String {
        let (size, unit) = self.unit(units);
        let wanted = with_unit(self.wanted, PLACES, unit);
        let speed = with_unit(belt.belt_speed, PLACES, "m/s");
        let has = with_unit(belt.friction, PLACES, "N");
        let name = match self.kick {
            Kick::Displacement => "displacement",
            Kick::Impulse => "impulse",
        };
        let lead = format!("for a margin of {wanted} ({name}) at v0 = {speed}: ");
        let force = self.force(units).map(|force| with_unit(force, 10, "N")).unwrap_or_default();
        lead + &match self.design.needed {
            Needed::Any => "any R suffices, however small; damping alone keeps it".to_owned(),
            Needed::Friction { .. } => format!("R = {force} is needed (the machine has {has})"),
            Needed::Fold { below, .. } => format!(
                "R above {force} is needed (the machine has {has}); every kick is survived then, while just \
                 below the margin is {}",
                with_unit(below * size, PLACES, unit)
            ),
        }
    }
}

/// An alarm as a sentence.
#[must_use]
pub fn alarm(alarm: &Alarm, belt: &Belt) -> String {
    let speed = with_unit(belt.belt_speed, PLACES, "m/s");
    match alarm {
        Alarm::Motion { at } => format!(
            "the motion reaches the belt's speed of {speed} at t = {}; the mass sticks to the belt there, and \
             the model ends",
            with_unit(at.t, PLACES, "s")
        ),
        Alarm::Cycle { stable, v_max } => format!(
            "the {} cycle reaches {}, the belt's speed is {speed}; the mass would stick to the belt",
            if *stable { "stable" } else { "unstable" },
            with_unit(*v_max, PLACES, "m/s")
        ),
        Alarm::Law { mu } => format!(
            "the friction law falls to mu = {} at velocities that occur: friction does not push",
            significant(*mu, 3)
        ),
        Alarm::Kick { velocity } => format!(
            "the smallest kick that is not survived has {}, the belt's speed is {speed}: it is beyond the model",
            with_unit(*velocity, PLACES, "m/s")
        ),
    }
}

/// The quantities of a belt in one line, but for one of them.
fn quantities(belt: &Belt, but: Option<&str>) -> String {
    let shown = QUANTITIES.iter().filter(|row| Some(row.name) != but);
    let one = shown
        .map(|row| format!("{} = {}", row.name, with_unit(belt.get(row.quantity), 12, row.unit)));
    one.collect::<Vec<_>>().join(", ")
}
