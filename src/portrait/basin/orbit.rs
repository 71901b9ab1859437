//! The orbits that part the plane: limit cycles and separatrices, each traced in the direction in which it
//! attracts.
//!
//! A motion beside an unstable cycle of log multiplier 35 has lost all sixteen digits after one turn; run
//! backward in time it gains as many. So each half swing of a border is followed in the direction in which it
//! forgets where it began, and has to end where the other half begins: this is checked for every cycle.
//!
//! The basin of the sticking set is bounded by the least solution of two equations. Let `B(X)` be the
//! clearance from which a swing arrives at the position X: 0 where the motion leaves a node that repels
//! (`D <= -1`), infinite where it comes from infinity. A swing is captured at once if it arrives at
//! `X <= 2 r`, and in the end if it arrives within `2 r` and the captured clearance of the other side. So
//! the captured clearances are `c0 = B0(2 r + c1)` and `c1 = B1(2 r + c0)`: a cycle where both are positive
//! and finite, a separatrix where not.

use super::arc::{Arc, Direction};
use crate::flow::{Limits, Reason};
use crate::model::{Parameters, Side, State};
use crate::portrait::closing::equation::first_side;
use crate::portrait::closing::half_map::{HalfSwing, Length};
use crate::portrait::closing::pair::Closing;

/// An orbit that parts the plane: an upper and a lower arc over the displacement.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// Above `v = 0`.
    pub upper: Arc,
    /// Below `v = 0`.
    pub lower: Arc,
    closed: bool,
}

impl Orbit {
    /// The border of two arcs, the first of them on `side`; `closed` says whether it is a cycle.
    pub fn of(side: Side, [first, second]: [Arc; 2], closed: bool) -> Self {
        match side {
            Side::Upper => Orbit { upper: first, lower: second, closed },
            Side::Lower => Orbit { upper: second, lower: first, closed },
        }
    }

    /// The two arcs of a cycle, the first of them on `side`. Fails with the [`Reason`] why one could not be
    /// computed, or [`Reason::NoConvergence`] where an arc does not end at the beginning of the other one.
    pub fn of_cycle(
        parameters: &Parameters,
        side: Side,
        closing: &Closing,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let repels = closing.log_multiplier(parameters) > 0.0;
        Self::of_closing([parameters; 2], side, closing, repels, limits)
    }

    /// The same with parameters of its own for each of the two arcs; `repels` is the direction in time that is tried first.
    pub fn of_closing(
        parameters: [&Parameters; 2],
        side: Side,
        closing: &Closing,
        repels: bool,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let Closing { first, second, .. } = *closing;
        let arc = |of, side, start, next| attracting(of, side, (start, next), repels, limits);
        let [own, other] = parameters;
        let arcs = [arc(own, side, first, second)?, arc(other, side.opposite(), second, first)?];
        Ok(Orbit::of(side, arcs, true))
    }

    /// The border between capture and the rest where no cycle is one; `reach` is the largest displacement
    /// of interest.
    ///
    /// With `D > -1` escape is the alternative, on the side in whose frame `D2 < 0` (`D3 = 0`): there the
    /// border goes out along the parabola `v^2 = 1/(2 D2^2) - q/D2` forever, and before it came from
    /// infinity on the other side. With `D <= -1` the end points of the sticking set are nodes that repel,
    /// and on one side at least the border comes out of one. Fails with the [`Reason`] why an arc could not be
    /// computed, or [`Reason::NoConvergence`].
    pub fn separatrix(
        parameters: &Parameters,
        reach: f64,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        /// Clearance, in units of `1/abs(D2)`, within which a motion has forgotten where it came from.
        const FORGETS: f64 = 40.0;
        let far = Length::new(reach + 2.0 * parameters.r + FORGETS / parameters.d2.abs());
        let braking = first_side(parameters);
        let arc = |side, next| Arc::new(parameters, side, Direction::Backward, next, limits);
        if parameters.d <= -1.0 {
            return Self::around_nodes(parameters, far, limits);
        }
        let out = arc(braking.opposite(), far)?;
        let before = arc(braking, out.clearance().unwrap_or(Length::ZERO))?;
        Ok(Orbit::of(braking, [before, out], false))
    }

    /// The border where the end points of the sticking set repel: from the clearances 0 outwards, until
    /// nothing changes. A captured clearance that is infinite stands for one `far` out.
    fn around_nodes(parameters: &Parameters, far: Length, limits: &Limits) -> Result<Self, Reason> {
        /// Turns before giving up. As long as no cycle is near, two do.
        const TURNS: usize = 100;
        /// Relative change of a clearance that counts as none.
        const SAME: f64 = 1e-13;
        let mut captured = [Some(Length::ZERO); 2];
        let mut change = f64::INFINITY;
        for _ in 0..TURNS {
            let mut turn = |index: usize, side| -> Result<(Arc, f64), Reason> {
                let next = captured[1 - index].unwrap_or(far);
                let arc = Arc::new(parameters, side, Direction::Backward, next, limits)?;
                let change = match (captured[index], arc.clearance()) {
                    (Some(before), Some(now)) => now.apart(before),
                    (None, None) => 0.0,
                    (_, _) => f64::INFINITY,
                };
                captured[index] = arc.clearance();
                Ok((arc, change))
            };
            let (upper, of_upper) = turn(0, Side::Upper)?;
            let (lower, of_lower) = turn(1, Side::Lower)?;
            change = f64::max(of_upper, of_lower);
            if change <= SAME {
                let closed = captured.iter().all(Option::is_some);
                return Ok(Orbit { upper, lower, closed });
            }
        }
        Err(Reason::NoConvergence { sought: "the border of the basin", change })
    }

    /// The border as a polyline in the order of time, `count` points on each integration step, beginning
    /// with the arc that comes from infinity if one does; a closed one ends with its first point.
    pub fn curve(&self, count: u16) -> Vec<State> {
        let [upper, lower] = [&self.upper, &self.lower];
        let arcs = if lower.clearance().is_none() { [lower, upper] } else { [upper, lower] };
        let mut points: Vec<State> = arcs.iter().flat_map(|arc| arc.points(count)).collect();
        if self.is_closed() {
            points.extend(points.first().copied());
        }
        points
    }

    /// Whether it encloses a bounded part of the plane.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// The velocities at displacement `q` between which a start lies inside; `None` where none does.
    pub fn span_at(&self, q: f64) -> Option<(f64, f64)> {
        let lower = self.lower.speed_at(q)?;
        let upper = self.upper.speed_at(q)?;
        Some((-lower, upper))
    }
}

/// The half swing from the clearance `start` to that of the next one, `next`, followed in the direction in
/// which it attracts; `backward` is tried first. Fails with the [`Reason`] why it could not be computed, or
/// [`Reason::NoConvergence`] where it ends elsewhere.
fn attracting(
    parameters: &Parameters,
    side: Side,
    (start, next): (Length, Length),
    backward: bool,
    limits: &Limits,
) -> Result<Arc, Reason> {
    /// Difference between the logarithms of two lengths that are the same: what is left of the digits where
    /// the time next to a nearly critical node takes its share.
    const MEETS: f64 = 1e-8;
    /// Log elasticity up to which rounding does not grow.
    const ATTRACTS: f64 = 2.0;
    let directions = [Direction::Backward, Direction::Forward];
    let mut best: Option<Arc> = None;
    let mut change = f64::INFINITY;
    for direction in if backward { directions } else { [directions[1], directions[0]] } {
        let (from, to) = match direction {
            Direction::Forward => (start, next.plus(2.0 * parameters.r)),
            Direction::Backward => (next, start),
        };
        let arc = Arc::new(parameters, side, direction, from, limits)?;
        // Traced the wrong way, a border may be left for good.
        let Ok(HalfSwing { end, log_elasticity, .. }) = arc.swing else { continue };
        let apart = end.apart(to);
        if apart < change {
            (best, change) = (Some(arc), apart);
        }
        if change <= MEETS && log_elasticity <= ATTRACTS {
            break;
        }
    }
    best.filter(|_| change <= MEETS)
        .ok_or(Reason::NoConvergence { sought: "the border of the basin", change })
}
