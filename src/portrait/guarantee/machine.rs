//! Kicks that a machine survives for certain: at all values of its numbers within their tolerances, whatever a
//! bounded force does.
//!
//! In `y dy/dx = h(y) - x - (friction) + u` with lengths for forces, every machine of the tolerances has its own
//! h and friction. A *worst* machine is one that drives the mass harder at every velocity: `h + e` along the
//! motion at least as large as that of any other, and friction less by the disturbance. An addition e along the
//! motion is friction less by e. So where the border of its basin lies below the belts' lines it bounds all
//! others, by the comparison that proves [`crate::portrait::guarantee::oscillator`]. Smaller damping and friction are worst at
//! every velocity, and need no addition; with these alone the border may touch the belt's line, where the worst
//! machine is held longest.

use std::fmt;

use super::corners::{Corners, MOST, TooMany};
use crate::model::Belt;
use crate::model::Tolerances;
use crate::numerics::root::try_bisect;
use crate::portrait::Margin;
use crate::portrait::Portrait;
use crate::portrait::survey::{Trouble, portrait};

/// Why no kick is survived for certain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MachineUncertain {
    /// The disturbance moves the mass from its rest by itself.
    Disturbance {
        /// The disturbance, in N.
        disturbance: f64,
        /// The smallest friction, in N.
        friction: f64,
    },
    /// The tolerances leave no friction to count on.
    Tolerances,
    /// More numbers are uncertain than are looked at together.
    TooMany,
    /// No border below the belts' lines bounds all machines.
    Unbounded,
    /// The border leaves the friction law of one of the machines.
    OutsideLaw,
}

impl fmt::Display for MachineUncertain {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MachineUncertain::Disturbance { disturbance, friction } => write!(
                out,
                "the disturbance of {disturbance} N is not below the smallest friction R = {friction} N"
            ),
            MachineUncertain::Tolerances => {
                write!(out, "the tolerances change the forces by more than the friction holds")
            }
            MachineUncertain::TooMany => write!(
                out,
                "tolerances of more than {MOST} numbers beside R, R_static, d1 and d3 are not looked at together"
            ),
            MachineUncertain::Unbounded => write!(
                out,
                "no motion slower than the belt bounds the basins of all machines within the tolerances"
            ),
            MachineUncertain::OutsideLaw => {
                write!(out, "within the tolerances the border leaves the friction law")
            }
        }
    }
}

/// The kicks that a machine survives for certain, or why none is. Fails with [`Trouble`] where a machine within the
/// tolerances has no model, or one that bounds them has no portrait.
pub fn guaranteed(
    belt: &Belt,
    known: &Tolerances,
) -> Result<Result<Margin, MachineUncertain>, Trouble> {
    Ok(worst(belt, known)?.map(|(corners, portrait)| kicks(&corners, &portrait)))
}

/// The machine whose basin lies within those of all others, or why there is none.
pub fn worst(
    belt: &Belt,
    known: &Tolerances,
) -> Result<Result<(Corners, Portrait), MachineUncertain>, Trouble> {
    let corners = match Corners::new(belt, known)? {
        Ok(corners) => corners,
        Err(TooMany) => return Ok(Err(MachineUncertain::TooMany)),
    };
    let least = corners.friction;
    if least < 0.0 || known.disturbance > 0.0 && least == 0.0 {
        let friction = corners.belts[0].friction;
        return Ok(Err(MachineUncertain::Disturbance { disturbance: known.disturbance, friction }));
    }
    let found = if corners.numbers == 0 {
        Ok(portrait(&corners.worst(0, 0.0))?)
    } else {
        corners.bounded(belt)?
    };
    Ok(found.map(|portrait| (corners, portrait)))
}

/// The machine outside of whose basin nothing comes to rest: with the largest friction and damping. `None` where
/// other numbers are uncertain.
pub fn best(belt: &Belt, known: &Tolerances) -> Result<Option<Portrait>, Trouble> {
    known.best(belt).map(|best| portrait(&best)).transpose()
}

/// The kicks within the basin of a machine that bounds those of all others, in m and N s.
pub fn kicks(corners: &Corners, portrait: &Portrait) -> Margin {
    let lightest = corners.lightest() / portrait.model.omega_0;
    portrait.margin_within(corners.farthest_rest, lightest)
}

/// A portrait whose basin of rest is bordered by a cycle of slip.
struct SlipBorder {
    portrait: Portrait,
    /// The velocities along the border, divided by the natural frequency.
    velocities: (f64, f64),
}

/// The velocities along the border of the basin, if it is a cycle of slip; divided by the natural frequency.
fn slip_border(portrait: &Portrait) -> Option<(f64, f64)> {
    let cycle = portrait.bordering_cycle()?;
    let omega_0 = portrait.model.omega_0;
    (!cycle.sticks() && !cycle.overtakes).then_some((cycle.v_min / omega_0, cycle.v_max / omega_0))
}

impl Corners {
    /// A machine whose border bounds all others at its own velocities.
    fn bounded(&self, belt: &Belt) -> Result<Result<Portrait, MachineUncertain>, Trouble> {
        /// Ranges of velocities that are tried, each larger than the border of the one before.
        const ROUNDS: usize = 8;
        const ROOM: f64 = 1.2;
        let slowest = self.slowest();
        let middle = slip_border(&portrait(belt)?).unwrap_or((-slowest, slowest));
        let mut range = (ROOM * middle.0, (ROOM * middle.1).min(slowest));
        for _ in 0..ROUNDS {
            if self.models.iter().any(|model| model.least_velocity() > range.0) {
                return Ok(Err(MachineUncertain::OutsideLaw));
            }
            let (corner, less) = self.bound(range.0, range.1);
            if less * self.stiffest >= self.friction {
                return Ok(Err(MachineUncertain::Tolerances));
            }
            let Some(found) = self.below_the_line(corner, less)? else {
                return Ok(Err(MachineUncertain::Unbounded));
            };
            let (low, high) = found.velocities;
            if low >= range.0 && high <= range.1 {
                return Ok(Ok(found.portrait));
            }
            range = (range.0.min(ROOM * low), range.1.max(ROOM * high).min(slowest));
        }
        Ok(Err(MachineUncertain::Unbounded))
    }

    /// The portrait of a worst machine whose border stays below the line of every belt, with as much friction
    /// as that allows, and the velocities along the border.
    fn below_the_line(&self, corner: usize, less: f64) -> Result<Option<SlipBorder>, Trouble> {
        const HALVINGS: u32 = 24;
        let slowest = self.slowest();
        let at = |less: f64| -> Result<Option<SlipBorder>, Trouble> {
            let portrait = portrait(&self.worst(corner, less))?;
            let border = slip_border(&portrait).filter(|(_, high)| *high < slowest);
            Ok(border.map(|velocities| SlipBorder { portrait, velocities }))
        };
        if let Some(found) = at(less)? {
            return Ok(Some(found));
        }
        let mut best = None;
        try_bisect(less, self.friction / self.stiffest, HALVINGS, |less| {
            let found = at(less)?;
            let holds = found.is_some();
            best = found.or_else(|| best.take());
            Ok::<_, Trouble>(holds)
        })?;
        Ok(best)
    }
}
