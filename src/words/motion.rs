//! How motions end.

use super::{counted, significant, with_unit};
use crate::flow::{Fate, Motion, Outcome};
use crate::model::Units;
use crate::portrait::Cycle;

/// How the quantities of a motion are written: as numbers of the oscillator, or in the units of a machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Notation(pub Option<Units>);

impl Notation {
    /// `q = 0.027`, or `x = 0.147 mm`.
    pub fn position(self, q: f64, digits: usize) -> String {
        format!("{} = {}", self.name("q", "x"), self.length(q, digits))
    }

    /// `q_max 0.65`, or `x_max 3.57 mm`.
    pub fn amplitude(self, q_max: f64, digits: usize) -> String {
        format!("{} {}", self.name("q_max", "x_max"), self.length(q_max, digits))
    }

    /// `tau = 9.47`, or `t = 0.189 s`.
    pub fn moment(self, tau: f64, digits: usize) -> String {
        format!("{} = {}", self.name("tau", "t"), self.time(tau, digits))
    }

    /// The name of a quantity: as a number of the oscillator, or with a unit.
    pub fn name(self, own: &'static str, physical: &'static str) -> &'static str {
        if self.0.is_some() { physical } else { own }
    }

    /// `0.027`, or `0.147 mm`.
    pub fn length(self, q: f64, digits: usize) -> String {
        self.quantity(q, digits, |units| (units.displacement, "m"))
    }

    /// `0.65`, or `34 mm/s`.
    pub fn velocity(self, v: f64, digits: usize) -> String {
        self.quantity(v, digits, |units| (units.velocity, "m/s"))
    }

    /// `9.47`, or `0.189 s`.
    pub fn time(self, tau: f64, digits: usize) -> String {
        self.quantity(tau, digits, |units| (units.time, "s"))
    }

    fn quantity(self, value: f64, digits: usize, unit: fn(&Units) -> (f64, &str)) -> String {
        match self.0.as_ref().map(unit) {
            None => significant(value, digits),
            Some((one, name)) => with_unit(value * one, digits, name),
        }
    }
}

/// How a motion ended, in a sentence.
pub fn sentence(motion: &Motion, notation: Notation) -> String {
    ended(&motion.outcome, motion.crossings.len(), notation, 3)
}

/// How a motion of so many half swings ended, in a sentence with numbers of so many digits, one more where it escapes.
pub fn ended(outcome: &Outcome, count: usize, notation: Notation, digits: usize) -> String {
    let (swings, time) = (swings(count), notation.moment(outcome.tau(), digits));
    let place = outcome.state().map(|(q, _)| notation.position(q, digits)).unwrap_or_default();
    match *outcome {
        Outcome::Captured { .. } if count == 0 => format!("at rest at {place} from the start"),
        Outcome::Captured { .. } => format!("comes to rest at {place}{swings}, {time}"),
        Outcome::Moving { v, .. } => {
            let velocity = notation.velocity(v, digits);
            format!("moving at {time}{swings}: {place}, v = {velocity}")
        }
        Outcome::Escaped { tau } => {
            format!("escapes at {}{swings}", notation.moment(tau, digits + 1))
        }
        Outcome::GaveUp { reason, .. } => format!("gave up at {time}{swings}: {reason}"),
    }
}

/// What becomes of a motion of a machine, by its whole model in SI units: where and after what time it comes to rest, as
/// far as that is known, `within` which border; or the cycle to which it tends.
pub fn of_machine(
    fate: Fate,
    [place, time]: [Option<f64>; 2],
    cycle: Option<&Cycle>,
    within: &str,
    digits: usize,
) -> String {
    let told = |before: &str, number: Option<f64>, unit| {
        number.map_or_else(String::new, |it| format!("{before}{}", with_unit(it, digits, unit)))
    };
    match fate {
        Fate::Rest => {
            let place = told(" at x = ", place, "m");
            format!("comes to rest{place}{}{within}", told(", after ", time, "s"))
        }
        Fate::Cycle(_) => {
            let Some(cycle) = cycle else { return String::new() };
            let over = if cycle.overtakes { "overtaking " } else { "" };
            let size = told("x up to ", Some(cycle.q_max), "m");
            if !cycle.sticks() {
                return format!("tends to the {over}slip cycle, {size}");
            }
            let part = significant(100.0 * cycle.stick_duration() / cycle.period, 3);
            format!("tends to {over}stick-slip, {size}; it sticks for {part} % of the time")
        }
        Fate::Neutral => "is periodic, one of a family".to_owned(),
        Fate::Moving => "still moves".to_owned(),
        Fate::Escapes => "grows without bound".to_owned(),
        Fate::Unknown(stop) => format!("ends in a way that is not known: {stop}"),
    }
}

/// ` after 3 half swings`; empty if there were none.
pub fn swings(count: usize) -> String {
    match count {
        0 => String::new(),
        some => format!(" after {}", counted(some, "half swing")),
    }
}
