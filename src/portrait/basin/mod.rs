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
pub mod stability;

pub(crate) use self::{arc::*, cycle::*, orbit::*, stability::*};

use serde::Serialize;

use crate::flow::Fate;
use crate::numerics::real;

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
    pub captured: usize,
    /// On a stable limit cycle.
    pub cycle: usize,
    /// Beyond all bounds.
    pub escaped: usize,
    /// On none of these.
    pub undecided: usize,
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
        real(self.captured) / real(all)
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

    /// What starts are counted as, by label.
    pub const LABELS: [&str; 4] = ["captured", "cycle", "escaped", "undecided"];

    /// As what a start with this fate is counted, an index of [`Self::LABELS`].
    #[must_use]
    pub fn label(fate: Fate) -> u8 {
        match fate {
            Fate::Rest => 0,
            Fate::Cycle(_) => 1,
            Fate::Escapes => 2,
            Fate::Neutral | Fate::Moving | Fate::Unknown(_) => 3,
        }
    }

    /// The starts with these labels.
    #[must_use]
    pub fn of(labels: &[u8]) -> Self {
        let mut counts = [0; 4];
        for label in labels {
            counts[usize::from(*label)] += 1;
        }
        let [captured, cycle, escaped, undecided] = counts;
        Counts { captured, cycle, escaped, undecided }
    }
}

/// So many values evenly spaced over a range, both ends included.
pub(crate) fn evenly((from, to): (f64, f64), count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |index| {
        if index + 1 == count && count > 1 {
            return to;
        }
        let fraction = if count > 1 {
            real(index) / real(count - 1)
        } else {
            0.5
        };
        from + fraction * (to - from)
    })
}
