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

use super::Arc;
use crate::flow::{Limits, Motion, Powers, Reason, Result, powers};
use crate::model::{Ledger, Parameters, Side, State, energy};
use crate::numerics::GAUSS;
use crate::portrait::{Direction, HalfSwing, Length, SwingPair, first_side};

/// An orbit that parts the plane: an upper and a lower arc over the displacement.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// Above `v = 0`.
    pub upper: Arc,
    /// Below `v = 0`.
    pub lower: Arc,
    /// Whether it encloses a bounded part of the plane.
    pub closed: bool,
}

impl Orbit {
    /// The border of two arcs, the first of them on `side`; `closed` says whether it is a cycle.
    pub fn of(side: Side, [first, second]: [Arc; 2], closed: bool) -> Self {
        match side {
            Side::Upper => Orbit { upper: first, lower: second, closed },
            Side::Lower => Orbit { upper: second, lower: first, closed },
        }
    }

    /// The two arcs of a cycle with parameters of its own for each, the first of them on `side`; `repels` says in which
    /// direction in time they are tried first. Fails with the [`Reason`] why one could not be computed, or
    /// [`Reason::NoConvergence`] where an arc does not end at the beginning of the other one.
    pub fn of_closing(
        [own, other]: [&Parameters; 2],
        side: Side,
        closing: &SwingPair,
        repels: bool,
        limits: &Limits,
    ) -> Result<Self> {
        let [first, second] = closing.clearances;
        let arc = |of, side, start, next| attracting(of, side, (start, next), repels, limits);
        let arcs = [arc(own, side, first, second)?, arc(other, side.opposite(), second, first)?];
        Ok(Orbit::of(side, arcs, true))
    }

    /// The border between capture and the rest where no cycle is one; `reach` is the largest displacement
    /// of interest. Fails with the [`Reason`] why an arc could not be computed, or [`Reason::NoConvergence`].
    ///
    /// With `D <= -1` the end points of the sticking set are nodes that repel, and on one side at least the border
    /// comes out of one.
    pub fn separatrix(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<Self> {
        let reach = reach + 2.0 * parameters.r;
        if parameters.d <= -1.0 {
            return Self::around_nodes(parameters, forgotten(parameters, reach), limits);
        }
        Self::from_infinity([parameters; 2], first_side(parameters), reach, limits)
    }

    /// The border between capture and escape where rest attracts and cubic damping is none, with parameters of its own
    /// for each of the two arcs, the first on the side in whose frame D2 brakes.
    ///
    /// On the other side the border goes out along the parabola `v^2 = 1/(2 D2^2) - q/D2` forever, and before it came
    /// from infinity on the first. Fails with the [`Reason`] why an arc could not be computed.
    pub fn from_infinity(
        [braking, other]: [&Parameters; 2],
        side: Side,
        reach: f64,
        limits: &Limits,
    ) -> Result<Self> {
        let arc = |of, side, next| Arc::new(of, side, Direction::Backward, next, limits);
        let out = arc(other, side.opposite(), forgotten(other, reach))?;
        let before = arc(braking, side, out.clearance().or(Length::ZERO))?;
        Ok(Orbit::of(side, [before, out], false))
    }

    /// The border where the end points of the sticking set repel: from the clearances 0 outwards, until
    /// nothing changes. A captured clearance that is infinite stands for one `far` out.
    fn around_nodes(parameters: &Parameters, far: Length, limits: &Limits) -> Result<Self> {
        /// Turns before giving up. As long as no cycle is near, two do.
        const TURNS: usize = 100;
        /// Relative change of a clearance that counts as none.
        const SAME: f64 = 1e-13;
        let mut captured = [Length::ZERO; 2];
        let mut change = f64::INFINITY;
        for _ in 0..TURNS {
            let mut turn = |index: usize, side| -> Result<(Arc, f64)> {
                let next = captured[1 - index].or(far);
                let arc = Arc::new(parameters, side, Direction::Backward, next, limits)?;
                let change = arc.clearance().apart(captured[index]);
                captured[index] = arc.clearance();
                Ok((arc, change))
            };
            let (upper, of_upper) = turn(0, Side::Upper)?;
            let (lower, of_lower) = turn(1, Side::Lower)?;
            change = f64::max(of_upper, of_lower);
            if change <= SAME {
                let closed = captured.iter().all(|it| *it != Length::INFINITE);
                return Ok(Orbit { upper, lower, closed });
            }
        }
        Err(Reason::NoConvergence { sought: "the border of the basin", change })
    }

    /// The border as a polyline in the order of time, `count` points on each integration step, beginning
    /// with the arc that comes from infinity if one does; a closed one ends with its first point.
    pub fn curve(&self, count: u16) -> Vec<State> {
        let mut arcs = [&self.upper, &self.lower];
        if self.lower.clearance() == Length::INFINITE {
            arcs.reverse();
        }
        let mut points: Vec<State> = arcs.iter().flat_map(|arc| arc.points(count)).collect();
        if self.closed {
            points.extend(points.first().copied());
        }
        points
    }

    /// How far outside of the sticking set it turns on the nearer side; infinite where it comes from infinity on both.
    pub fn clearance(&self) -> f64 {
        self.upper.clearance().value.min(self.lower.clearance().value)
    }

    /// The velocities at displacement `q` between which a start lies inside; `None` where none does.
    pub fn span_at(&self, q: f64) -> Option<(f64, f64)> {
        let lower = self.lower.speed_at(q)?;
        let upper = self.upper.speed_at(q)?;
        Some((-lower, upper))
    }
}

/// A clearance so far beyond a reach that a motion has forgotten there where it came from: run backward, the one that
/// goes out along the parabola forever attracts.
pub fn forgotten(parameters: &Parameters, reach: f64) -> Length {
    /// Such a clearance in units of `1/abs(D2)`.
    const FORGETS: f64 = 40.0;
    Length::new(reach + FORGETS / parameters.d2.abs())
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
) -> Result<Arc> {
    /// Difference between the logarithms of two lengths that are the same: what is left of the digits where
    /// the time next to a nearly critical node takes its share.
    const MEETS: f64 = 1e-8;
    /// Log elasticity up to which rounding does not grow.
    const ATTRACTS: f64 = 2.0;
    let directions = [Direction::Backward, Direction::Forward];
    let mut best = None;
    let mut change = f64::INFINITY;
    for direction in if backward {
        directions
    } else {
        [directions[1], directions[0]]
    } {
        let (from, to) = match direction {
            Direction::Forward => (start, next.plus(2.0 * parameters.r)),
            Direction::Backward => (next, start),
        };
        let arc = Arc::new(parameters, side, direction, from, limits)?;
        // Traced the wrong way, a border may be left for good.
        if !arc.swing.arrives() {
            continue;
        }
        let HalfSwing { end, log_elasticity, .. } = arc.swing;
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

// Where the energy of a limit cycle comes from and where it goes, by source.
//
// Along a motion `V' = -2 D v^2 - D2 v^3 - D3 v^4 - r abs(v)`. Over one turn of a cycle the four works
// cancel. They are integrals over the arcs with which the cycle is drawn anyway, each with its full
// relative precision, so that their sum says how well the cycle is closed.

/// The ledger of one turn of a cycle, whose border is closed; `residual` is what the works fail to cancel by.
pub fn works(border: &Orbit, parameters: &Parameters) -> Ledger {
    let r = parameters.r;
    let [left, right] = [&border.upper, &border.lower].map(|arc| arc.clearance().value);
    let path = 2.0 * (left + right + 2.0 * r);
    // Below `v = 0` the speed is that of the mirror image.
    let lower = border.lower.powers().component_mul(&Powers::new(1.0, -1.0, 1.0));
    let stored = energy(State { q: r + right, v: 0.0 });
    ledger(parameters, (stored, stored), border.upper.powers() + lower, path)
}

/// The ledger between these energies, from the integrals of the powers of the velocity and the length of the path.
fn ledger(parameters: &Parameters, energies: (f64, f64), powers: Powers, path: f64) -> Ledger {
    let Parameters { d, d2, d3, r } = *parameters;
    let [second, third, fourth] = powers.into();
    let works = [-2.0 * d * second, -d2 * third, -d3 * fourth, -r * path];
    Ledger::of_terms(parameters, energies, works)
}

/// The ledger of a motion from its start until a time, by quadrature over its samples.
///
/// Between two samples the motion is the cubic through both ([`Motion::at`]); what its works fail to
/// account for is the residual, as in the ledger of the whole motion, which is exact.
pub fn works_until(motion: &Motion, until: f64) -> Option<Ledger> {
    let now = motion.at(until)?;
    let mut sum = Powers::zeros();
    let mut path = 0.0;
    let mut before = *motion.samples.first()?;
    for sample in motion.samples.iter().skip(1).chain([&now]) {
        if before.tau >= until {
            break;
        }
        let end = if sample.tau < until { *sample } else { now };
        let h = end.tau - before.tau;
        for (node, weight) in GAUSS {
            sum += weight * h * powers(before.between(&end, before.tau + node * h).v);
        }
        path += (end.q - before.q).abs();
        before = end;
    }
    let energies = (energy(motion.problem.initial), energy(now.state()));
    Some(ledger(&motion.problem.parameters, energies, sum, path))
}

#[cfg(test)]
mod works_tests {
    use super::*;

    #[test]
    fn works_until_a_time_close_and_end_at_those_of_the_whole_motion() {
        for (d, d2, d3, r, q) in
            [(0.02, 0.1, 0.05, 0.125, 1.5), (-0.3, 0.2, 0.5, 0.1, 0.4), (0.1, 0.0, 0.0, 0.0, 1.0)]
        {
            let problem = Problem {
                parameters: Parameters { d, d2, d3, r },
                initial: State { q, v: 0.0 },
                until: 30.0,
                ..Problem::default()
            };
            let detail = Detail { crossings: r > 0.0, samples_per_step: 16, energy: true };
            let motion = trajectory(&problem, detail, &Limits::PATIENT);
            let whole = motion.ledger.clone().unwrap();
            let sizes = whole.works.iter().map(|work| work.amount.abs());
            let largest = sizes.fold(0.0, f64::max);
            let mut last = 0.0;
            for part in 0..=40 {
                let found = works_until(&motion, 30.0 * f64::from(part) / 40.0).unwrap();
                assert!(found.residual.abs() < 1e-6 * largest, "{found:?}");
                assert!(found.work("friction") <= last, "friction only takes");
                last = found.work("friction");
            }
            let end = works_until(&motion, 30.0).unwrap();
            let works = |of: &Ledger| of.works.iter().map(|work| work.amount).collect::<Vec<_>>();
            let pairs = works(&end).into_iter().zip(works(&whole));
            for (found, exact) in pairs.chain([(end.end, whole.end)]) {
                assert!((found - exact).abs() < 1e-6 * largest, "{found} {exact}");
            }
            let start = works_until(&motion, 0.0).unwrap();
            let works = ["linear", "friction"].map(|source| start.work(source));
            assert_eq!((works, start.end), ([0.0; 2], start.start));
        }
    }
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Limits, Problem};
    use crate::portrait::Portrait;

    #[test]
    fn the_works_over_a_cycle_cancel_to_ten_digits_and_more() {
        for (d, d2, d3, r) in [
            (-0.3, 0.0, 0.5, 0.1),
            (-0.3, 0.2, 0.5, 0.1),
            (-0.2, 0.2, 0.0, 0.5),
            (-0.1, 0.0, -0.5, 0.1),
            (-0.1, 0.0, 0.5, 0.0),
            (-0.4, 0.0, 0.0, 1.0),
            (-0.999, 0.0, 0.0, 1.0),
            (-1e-6, 0.0, 0.0, 0.1),
            (-0.9, -0.3, 2.0, 1e-3),
        ] {
            let parameters = Parameters { d, d2, d3, r };
            let found = Portrait::of_oscillator(&parameters, 1e3, &Limits::PATIENT).unwrap();
            let found = found.drawn(&parameters, 12).unwrap();
            let ledgers = found.works;
            assert_eq!(ledgers.len(), found.cycles.len());
            assert!(!ledgers.is_empty());
            for (cycle, ledger) in found.cycles.iter().zip(ledgers) {
                let [linear, quadratic, cubic, friction] =
                    ["linear", "quadratic", "cubic", "friction"].map(|source| ledger.work(source));
                let turned = linear.abs().max(cubic.abs()).max(friction.abs());
                assert!((ledger.residual / turned).abs() < 1e-12, "{parameters:?}: {ledger:?}");
                assert!(linear > 0.0 || cubic > 0.0, "something feeds the cycle");
                let path = 2.0 * (cycle.q_max - cycle.q_min);
                assert!((friction + r * path).abs() <= 1e-12 * turned);
                let q_max = (2.0 * ledger.start).sqrt();
                assert!((q_max / cycle.q_max - 1.0).abs() < 1e-12);
                // D2 takes on one side what it gives on the other, if the cycle is symmetric.
                assert!(d2 != 0.0 || quadratic == 0.0);
            }
        }
    }
}
