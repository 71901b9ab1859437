//! How motions end.

use super::{counted, significant, with_unit};
use crate::flow::{Fate, Outcome, Trajectory};
use crate::model::belt::Units;
use crate::portrait::Cycle;

/// How the quantities of a motion are written: as numbers of the oscillator, or in the units of a machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Writing(pub Option<Units>);

impl Writing {
    /// `q = 0.027`, or `x = 0.147 mm`.
    pub fn position(self, q: f64, digits: usize) -> String {
        self.text(["q = ", "x = "], q, digits, |units| (units.displacement, "m"))
    }

    /// `q_max 0.65`, or `x_max 3.57 mm`.
    pub fn amplitude(self, q_max: f64, digits: usize) -> String {
        self.text(["q_max ", "x_max "], q_max, digits, |units| (units.displacement, "m"))
    }

    fn velocity(self, v: f64, digits: usize) -> String {
        self.text(["v = "; 2], v, digits, |units| (units.velocity, "m/s"))
    }

    /// `tau = 9.47`, or `t = 0.189 s`.
    pub fn time(self, tau: f64, digits: usize) -> String {
        self.text(["tau = ", "t = "], tau, digits, |units| (units.time, "s"))
    }

    fn text(
        self,
        [own, physical]: [&str; 2],
        value: f64,
        digits: usize,
        unit: fn(&Units) -> (f64, &'static str),
    ) -> String {
        match self.0.as_ref().map(unit) {
            None => format!("{own}{}", significant(value, digits)),
            Some((one, name)) => format!("{physical}{}", with_unit(value * one, digits, name)),
        }
    }
}

/// How a motion ended, in a sentence.
pub fn sentence(motion: &Trajectory, writing: Writing) -> String {
    let swings = swings(motion);
    let (place, time) = (|q| writing.position(q, 3), |tau| writing.time(tau, 3));
    match motion.outcome {
        Outcome::Captured { q, .. } if motion.crossings.is_empty() => {
            format!("at rest at {} from the start", place(q))
        }
        Outcome::Captured { tau, q } => {
            format!("comes to rest at {}{swings}, {}", place(q), time(tau))
        }
        Outcome::Moving { tau, q, v } => {
            let velocity = writing.velocity(v, 3);
            format!("moving at {}{swings}: {}, {velocity}", time(tau), place(q))
        }
        Outcome::Escaped { tau } => {
            format!("escapes at {}{swings}", writing.time(tau, 4))
        }
        Outcome::GaveUp { tau, reason } => {
            format!("gave up at {}{swings}: {reason}", time(tau))
        }
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
pub fn swings(motion: &Trajectory) -> String {
    match motion.crossings.len() {
        0 => String::new(),
        some => format!(" after {}", counted(some, "half swing")),
    }
}
