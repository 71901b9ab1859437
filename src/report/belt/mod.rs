//! The motions of a mass on a belt or of a vibration mode, in physical units; for a belt also by the oscillator of
//! the paper.

mod cycle;
mod document;
mod expansion;
mod page;
mod table;

pub(super) use cycle::{described, number_columns};
pub use document::json;
pub use page::page;
pub(super) use table::{border, gaps};
pub use table::{csv, table};

use crate::model::{Belt, Body, Group, Interval, Knob, Modal, Tolerances};
use crate::portrait::design::{FrictionNeeded, Kick};
use crate::portrait::guarantee::machine::MachineUncertain;
use crate::portrait::{Course, CubicExpansion, Margin};
use crate::words::number::significant;
use crate::words::quantity::with_unit;

/// The fraction of the starts in a window from which the mass comes to rest.
#[derive(Clone, Copy)]
pub enum RestShare {
    NotAsked,
    /// Motions from the window leave the range that is known.
    Unknown,
    Is(f64),
}

impl RestShare {
    /// Whether answers leave it out.
    fn is_not_asked(&self) -> bool {
        matches!(self, RestShare::NotAsked)
    }

    fn known(self) -> Option<f64> {
        if let RestShare::Is(share) = self { Some(share) } else { None }
    }

    /// A line of text; empty if it was not asked for.
    fn line(self) -> String {
        match self {
            RestShare::NotAsked => String::new(),
            RestShare::Unknown => {
                "of the window, the part that comes to rest is not known: motions from its corners leave what \
                 is known\n"
                    .to_owned()
            }
            RestShare::Is(share) => {
                format!("of the window, {} comes to rest\n", significant(share, 10))
            }
        }
    }
}

/// The whole answer about a mass on a belt or a vibration mode.
pub struct MachineAnswer<'a> {
    pub head: &'a Head<'a>,
    /// Displacement (m) and velocity (m/s) at the start.
    pub start: (f64, f64),
    pub course: Course,
    pub rest_share: RestShare,
    /// The friction needed for a margin, if asked for.
    pub design: Option<DesignAnswer>,
    /// `None` for a mode.
    pub on_belt: Option<OnBelt<'a>>,
    pub seconds: f64,
}

/// The part of the answer that only a mass on a belt has.
pub struct OnBelt<'a> {
    pub expansion: CubicExpansion,
    pub tolerances: &'a Tolerances,
    /// The kicks that are survived for certain, or why none is; `None` if not asked for.
    pub certain: Option<Result<Margin, MachineUncertain>>,
}

impl OnBelt<'_> {
    /// The numbers that are not known exactly, each with its interval in SI units.
    fn uncertain(&self) -> Vec<(Knob, Interval)> {
        self.tolerances.intervals(&self.expansion.belt)
    }
}

/// The friction needed for a margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignAnswer {
    /// The kick that is to be survived.
    pub kick: Kick,
    /// Its size: m for a displacement, N s for an impulse.
    pub wanted: f64,
    /// The friction needed, in N.
    pub needed: FrictionNeeded,
    /// Speed of the belt in m/s; `None` for a mode.
    pub at: Option<f64>,
    /// The friction that the machine has, in N.
    pub has: f64,
}

/// The heading of an answer: which machine, and its numbers.
pub struct Head<'a> {
    /// The name by which the machine is opened.
    pub name: &'a str,
    pub title: &'a str,
    /// Name and value of each number.
    numbers: Vec<(String, String)>,
}

impl<'a> Head<'a> {
    pub fn new(name: &'a str, title: &'a str, body: &Body) -> Self {
        let numbers = match body {
            Body::Belt(belt) => numbers_of_belt(belt),
            Body::Mode(mode) => numbers_of_mode(mode),
        };
        Head { name, title, numbers }
    }

    /// The numbers in one line, without those that are `omitted`.
    pub(super) fn numbers_without(&self, omitted: &[&str]) -> String {
        let shown = self.numbers.iter().filter(|(name, _)| !omitted.contains(&name.as_str()));
        let shown = shown.map(|(name, value)| format!("{name} = {value}"));
        shown.collect::<Vec<_>>().join(", ")
    }
}

/// Significant digits of a physical quantity in text.
pub(super) const PLACES: usize = 5;

impl DesignAnswer {
    /// The friction needed, in N; `None` if any suffices.
    fn force(&self) -> Option<f64> {
        match self.needed {
            FrictionNeeded::Any => None,
            FrictionNeeded::Friction { r } | FrictionNeeded::Fold { r, .. } => Some(r),
        }
    }

    /// The answer in a sentence.
    fn sentence(&self) -> String {
        let (name, unit) = match self.kick {
            Kick::Displacement => ("displacement", "m"),
            Kick::Impulse => ("impulse", "N s"),
        };
        let wanted = with_unit(self.wanted, PLACES, unit);
        let at = self.at.map(|v0| format!(" at v0 = {}", with_unit(v0, PLACES, "m/s")));
        let has = with_unit(self.has, PLACES, "N");
        let lead = format!("for a margin of {wanted} ({name}){}: ", at.unwrap_or_default());
        let force = self.force().map(|force| with_unit(force, 10, "N")).unwrap_or_default();
        lead + &match self.needed {
            FrictionNeeded::Any => {
                "any R suffices, however small; damping alone keeps it".to_owned()
            }
            FrictionNeeded::Friction { .. } => {
                format!("R = {force} is needed (the machine has {has})")
            }
            FrictionNeeded::Fold { below, .. } => format!(
                "R above {force} is needed (the machine has {has}); every kick is survived then, while just \
                 below the margin is {}",
                with_unit(below, PLACES, unit)
            ),
        }
    }
}

fn numbers_of_belt(belt: &Belt) -> Vec<(String, String)> {
    let told =
        |(knob, value): (Knob, f64)| (knob.to_string(), with_unit(value, 12, knob.spec().unit));
    let own = Group::Machine.knobs().filter_map(|knob| Some((knob, knob.of_belt(belt)?)));
    let mu_s = belt.static_coefficient.map(|mu| (Knob::StaticCoefficient, mu));
    let held = belt.static_guide.map(|force| (Knob::StaticGuide, force));
    own.chain(mu_s).chain(held).map(told).collect()
}

fn numbers_of_mode(mode: &Modal) -> Vec<(String, String)> {
    let Modal { frequency, mass, damping_ratio, friction, static_guide } = mode;
    let named = |name: &str, value, unit| (name.to_owned(), with_unit(value, 12, unit));
    let one = [
        named("frequency", *frequency, "Hz"),
        named("modal_mass", *mass, "kg"),
        named("R", *friction, "N"),
    ];
    let held = static_guide.map(|force| named("R_static", force, "N"));
    let ratio = |(power, value): (usize, &f64)| {
        let unit = if power == 0 { String::new() } else { format!(" s^{power}/m^{power}") };
        (format!("ratio{power}"), format!("{}{unit}", significant(*value, 12)))
    };
    one.into_iter().chain(held).chain(damping_ratio.iter().enumerate().map(ratio)).collect()
}
