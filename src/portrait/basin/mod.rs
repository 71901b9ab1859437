//! Where starts end: the plane ordered by the orbits that part it.
//!
//! Limit cycles and the escape separatrix are nested orbits around the sticking set. The region between
//! two of them has one fate. So the basin over a window needs no motion from any of its points: for each
//! column of starts the orbits' speeds at that displacement ([`self::arc`]) sort all of them.

pub(crate) mod arc;
#[doc(hidden)]
pub mod capture;
pub mod cycle;
pub(crate) mod orbit;
#[doc(hidden)]
pub mod stability;

use serde::Serialize;

use crate::flow::Fate;

/// A rectangle of starts, both ends included.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StartWindow {
    /// Smallest and largest displacement.
    pub q: (f64, f64),
    /// Smallest and largest velocity.
    pub v: (f64, f64),
}

/// How many starts end where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// On the sticking set.
    pub captured: u64,
    /// On a stable limit cycle.
    pub cycle: u64,
    /// Beyond all bounds.
    pub escaped: u64,
    /// On none of these.
    pub undecided: u64,
}

impl StartWindow {
    /// The largest displacement of a start.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.q.0.abs().max(self.q.1.abs())
    }
}

impl Counts {
    /// Basin stability: the fraction of the starts that is captured.
    #[must_use]
    pub fn captured_part(&self) -> f64 {
        let all = self.captured + self.cycle + self.escaped + self.undecided;
        #[expect(clippy::cast_precision_loss, reason = "at most 1e10 starts")]
        let part = self.captured as f64 / all as f64;
        part
    }

    /// Both together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Counts {
            captured: self.captured + other.captured,
            cycle: self.cycle + other.cycle,
            escaped: self.escaped + other.escaped,
            undecided: self.undecided + other.undecided,
        }
    }

    /// Counts starts with one fate.
    pub fn add(&mut self, fate: Fate, starts: u64) {
        match fate {
            Fate::Rest => self.captured += starts,
            Fate::Cycle(_) => self.cycle += starts,
            Fate::Escapes => self.escaped += starts,
            Fate::Neutral | Fate::Moving | Fate::Unknown(_) => self.undecided += starts,
        }
    }
}

/// Value number `index` of `count` evenly spaced over a range, both ends included.
pub(crate) fn between(range: (f64, f64), index: usize, count: usize) -> f64 {
    if index + 1 == count && count > 1 {
        return range.1;
    }
    #[expect(clippy::cast_precision_loss, reason = "grids of starts are small")]
    let fraction = if count > 1 { index as f64 / (count - 1) as f64 } else { 0.5 };
    range.0 + fraction * (range.1 - range.0)
}
