//! A machine whose numbers are known to tolerances only, on a floor that shakes.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::model::{Belt, Group, Interval, KNOBS, Knob};

/// By how much the numbers of a machine may differ from their values, and the force that disturbs it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tolerances {
    /// Half widths in SI units, by the name of the number.
    pub half_widths: BTreeMap<String, f64>,
    /// Bound on a force that varies in any way, in N.
    pub disturbance: f64,
}

impl Tolerances {
    /// Whether everything is known exactly and nothing disturbs.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.disturbance == 0.0 && self.half_widths.values().all(|half| *half == 0.0)
    }

    /// Where a number lies; `None` where the machine has no such number.
    #[must_use]
    pub fn interval(&self, varied: Knob, belt: &Belt) -> Option<Interval> {
        let half = self.half_widths.get(varied.spec().name).copied().unwrap_or(0.0);
        Some(Interval::around(varied.of_belt(belt)?, half))
    }

    /// The numbers that are not known exactly, with their ends.
    #[must_use]
    pub fn intervals(&self, belt: &Belt) -> Vec<(Knob, Interval)> {
        let known = |varied: Knob| Some((varied, self.interval(varied, belt)?));
        let all = KNOBS.iter().filter_map(|row| known(row.knob));
        all.filter(|(_, interval)| !interval.is_point()).collect()
    }

    /// The machine with the largest friction and damping; `None` where other numbers are uncertain, of which
    /// no end is the best at every velocity.
    #[must_use]
    pub fn best(&self, belt: &Belt) -> Option<Belt> {
        let mut best = belt.clone();
        for (varied, interval) in self.intervals(belt) {
            if !MONOTONE.contains(&varied) {
                return None;
            }
            set(&mut best, varied, interval.upper());
        }
        if self.disturbance > 0.0 {
            let stronger = |force: f64| (force + self.disturbance).next_up();
            best.static_guide = best.static_guide.map(stronger);
            best.friction = stronger(best.friction);
        }
        best.static_guide = best.static_guide.map(|at_rest| at_rest.max(best.friction));
        Some(best)
    }

    /// Checks that every number has its tolerance within its range.
    ///
    /// # Errors
    /// One line that says what is allowed.
    pub fn check(&self, belt: &Belt) -> Result<(), String> {
        for (name, half) in &self.half_widths {
            let knob = Knob::named(name, Group::SOURCE)?;
            for end in knob.of_belt(belt).into_iter().flat_map(|value| [value - half, value + half])
            {
                knob.check(end).map_err(|refused| refused.to_string())?;
            }
        }
        Ok(())
    }
}

/// Numbers of which the smallest value is the worst at every velocity: friction and damping.
pub const MONOTONE: [Knob; 4] =
    [Knob::Friction, Knob::Damping, Knob::CubicDamping, Knob::StaticGuide];

/// Gives a machine the value of a number that it has.
pub fn set(belt: &mut Belt, varied: Knob, value: f64) {
    let set = varied.set_in_belt(belt, value);
    debug_assert!(set.is_ok(), "only numbers of the machine have intervals: {set:?}");
}
