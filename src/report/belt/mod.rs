//! What a mass on a belt does, in physical units; beside it the oscillator of the paper.

pub mod branch;
mod document;
mod expansion;
pub mod mode;
mod sweep;
mod table;

pub use document::json;
pub use sweep::{Sweep, SweepPoint, csv as sweep_csv, json as sweep_json, table as sweep_table};
pub use table::{csv, table};

use crate::machine::Portrait;
use crate::machine::guarantee::{Kicks, Uncertain};
use crate::machine::survey::Survey;
use crate::machine::varied::Varied;
use crate::oscillator::belt::QUANTITIES;
use crate::oscillator::{Belt, Interval};
use crate::scene::Machine;
use crate::study::design::{Kick, Needed};
use crate::words::quantity::with_unit;

/// Everything that is said about a machine.
pub struct Answer<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// What it does.
    pub survey: &'a Survey,
    /// The part of a window from which it comes to rest, if asked for.
    pub rest_share: Option<f64>,
    /// The friction for a margin, if asked for.
    pub design: Option<Designed>,
    /// The kicks that are survived for certain, or why none is; `None` if not asked for.
    pub certain: Option<Result<Kicks, Uncertain>>,
    /// What it took.
    pub seconds: f64,
}

impl Answer<'_> {
    /// The numbers that are not known exactly, each between its ends in SI units.
    fn uncertain(&self) -> Vec<(Varied, Interval)> {
        self.machine.tolerances.intervals(&self.machine.belt)
    }
}

/// A number that may be infinite as one that may be missing.
fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|value| value.is_finite())
}

/// The friction for a margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Designed {
    /// The kick that is to be survived.
    pub kick: Kick,
    /// Its size: m for a displacement, N s for an impulse.
    pub wanted: f64,
    /// The friction, in N.
    pub needed: Needed,
}

/// Digits of a physical quantity in a text.
const PLACES: usize = 5;

/// Margins in SI units; `None` where every kick is survived.
fn margins(portrait: &Portrait) -> [Option<f64>; 2] {
    let impulse = |velocity: f64| portrait.model.mass * velocity;
    let margin = portrait.margin;
    [
        margin.map(|margin| margin.least_displacement()),
        margin.map(|margin| impulse(margin.least_velocity())),
    ]
}

impl Designed {
    /// The friction for it, in N.
    fn force(&self) -> Option<f64> {
        match self.needed {
            Needed::Any => None,
            Needed::Friction { r } | Needed::Fold { r, .. } => Some(r),
        }
    }

    /// The answer in a sentence.
    fn sentence(&self, belt: &Belt) -> String {
        let (name, unit) = match self.kick {
            Kick::Displacement => ("displacement", "m"),
            Kick::Impulse => ("impulse", "N s"),
        };
        let wanted = with_unit(self.wanted, PLACES, unit);
        let speed = with_unit(belt.belt_speed, PLACES, "m/s");
        let has = with_unit(belt.friction, PLACES, "N");
        let lead = format!("for a margin of {wanted} ({name}) at v0 = {speed}: ");
        let force = self.force().map(|force| with_unit(force, 10, "N")).unwrap_or_default();
        lead + &match self.needed {
            Needed::Any => "any R suffices, however small; damping alone keeps it".to_owned(),
            Needed::Friction { .. } => format!("R = {force} is needed (the machine has {has})"),
            Needed::Fold { below, .. } => format!(
                "R above {force} is needed (the machine has {has}); every kick is survived then, while just \
                 below the margin is {}",
                with_unit(below, PLACES, unit)
            ),
        }
    }
}

/// The quantities of a belt in one line, but for one of them.
fn quantities(belt: &Belt, but: Option<&str>) -> String {
    let shown = QUANTITIES.iter().filter(|row| Some(row.name) != but);
    let one = shown
        .map(|row| format!("{} = {}", row.name, with_unit(belt.get(row.quantity), 12, row.unit)));
    let mu_s = belt.static_coefficient.map(|mu| format!("mu_s = {}", with_unit(mu, 12, "")));
    let held = belt.static_guide.map(|force| format!("R_static = {}", with_unit(force, 12, "N")));
    one.chain(mu_s).chain(held).collect::<Vec<_>>().join(", ")
}
