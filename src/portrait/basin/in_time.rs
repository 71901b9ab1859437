//! A limit cycle in time: where it is at evenly spaced times over one period, from its right turning point on.
//!
//! Like the border of a basin it is followed in the direction in which it attracts, so that its last digits are those of the
//! cycle, not what is left of an error of its first.

use super::{Arc, ArcStep, Orbit};
use crate::closed_form::LinearFlow;
use crate::flow::{Flow, Limits, MachineCurve, Reason, Result, Sample, StepPoint};
use crate::model::{Parameters, Side, State};
use crate::portrait::{Cycle, Direction, Edge, Length, Portrait, evenly};

/// Where a cycle of the oscillator of the paper is at `count` evenly spaced times over one period, both ends included: the
/// last point is the first again.
///
/// ```
/// use hopfscope::flow::Limits;
/// use hopfscope::model::Parameters;
/// use hopfscope::portrait::{cycles, orbit};
///
/// let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
/// let found = cycles(&parameters, &Limits::PATIENT)?;
/// let points = orbit(&parameters, &found.cycles[0], 101, &Limits::PATIENT)?;
/// let (first, last) = (points[0], points[100]);
/// assert!((first.q - found.cycles[0].q_max).abs() < 1e-12 && (last.q - first.q).abs() < 1e-11);
/// assert_eq!(last.tau, found.cycles[0].period);
/// # Ok::<(), hopfscope::flow::Reason>(())
/// ```
///
/// # Errors
/// [`Reason`] where it cannot be followed, or does not close.
pub fn orbit(
    parameters: &Parameters,
    cycle: &Cycle,
    count: usize,
    limits: &Limits,
) -> Result<Vec<Sample>> {
    let orbit = Orbit::of_cycle(parameters, cycle, limits)?;
    Ok(samples(cycle.period, count, |tau| orbit.at(tau)))
}

impl Portrait {
    /// The same for one of its cycles, in s, m and m/s.
    ///
    /// # Errors
    /// [`Reason`] where it cannot be followed once more.
    pub fn orbit(&self, index: usize, count: usize) -> Result<Vec<Sample>> {
        let (cycle, omega_0) = (&self.cycles[index], self.model.omega_0);
        let scaled = |State { q, v }| State { q, v: v * omega_0 };
        let first = self.borders.len().saturating_sub(self.cycles.len());
        if let Some(Edge::Orbit(orbit)) = self.borders.get(first + index)
            && !self.fates.is_empty()
        {
            return Ok(samples(cycle.period, count, |t| scaled(orbit.at(t * omega_0))));
        }
        let backward = cycle.is_followed_backward();
        let mut flow = Flow::new(&self.model);
        flow.follows = true;
        let (curve, _) = flow.around(cycle.q_max, backward)?;
        let at = |t: f64| if backward { cycle.period - t } else { t };
        Ok(samples(cycle.period, count, |t| scaled(curve.at(at(t) * omega_0))))
    }
}

/// Evenly spaced points of one period.
fn samples(period: f64, count: usize, at: impl Fn(f64) -> State) -> Vec<Sample> {
    let sample = |tau| {
        let State { q, v } = at(tau);
        // Without negative zeros.
        Sample { tau, q: q + 0.0, v: v + 0.0 }
    };
    evenly((0.0, period), count).map(sample).collect()
}

impl Orbit {
    /// The orbit of a cycle, each arc from where the one before it ends. Fails with the [`Reason`] why one could not be
    /// computed, or [`Reason::NoConvergence`] where it does not close.
    fn of_cycle(parameters: &Parameters, cycle: &Cycle, limits: &Limits) -> Result<Self> {
        /// Difference between the logarithms of the clearances at both ends of a period.
        const CLOSES: f64 = 1e-8;
        let start = Length { value: cycle.clearance, log: cycle.log_clearance };
        let arc = |side, direction, from| Arc::new(parameters, side, direction, from, limits);
        let gap = 2.0 * parameters.r;
        let (lower, upper, end);
        if cycle.stable {
            lower = arc(Side::Lower, Direction::Forward, start)?;
            upper = arc(Side::Upper, Direction::Forward, lower.swing.end.plus(-gap))?;
            end = upper.swing.end.plus(-gap);
        } else {
            upper = arc(Side::Upper, Direction::Backward, start)?;
            lower = arc(Side::Lower, Direction::Backward, upper.clearance())?;
            end = lower.clearance();
        }
        let change = end.apart(start);
        if change <= CLOSES {
            return Ok(Orbit::of(Side::Upper, [upper, lower], true));
        }
        Err(Reason::NoConvergence { sought: "the orbit of the cycle", change })
    }

    /// The state of a closed orbit this long after its right turning point.
    fn at(&self, time: f64) -> State {
        let half = self.lower.swing.duration;
        if time <= half {
            self.lower.at(time)
        } else {
            self.upper.at(time - half)
        }
    }
}

impl Arc {
    /// The state at a time from its start, and at its end after that.
    fn at(&self, time: f64) -> State {
        let whole = self.swing.duration;
        let mut left = match self.direction {
            Direction::Forward => time,
            Direction::Backward => whole - time,
        };
        let followed: f64 = self.steps().map(|piece| piece.duration).sum();
        // Next to where it begins, the motion is linear and was not followed.
        let skipped = whole - followed;
        left = left.clamp(0.0, whole) - skipped;
        let point = if left < 0.0 {
            let (x, v) =
                LinearFlow::new(self.field.d).state(-self.swing.start.value, 0.0, left + skipped);
            StepPoint { x, v }
        } else {
            self.point(left)
        };
        let q = self.side.displacement(self.direction.sense() * point.x, self.r);
        State { q, v: self.side.sign() * point.v }
    }

    fn steps(&self) -> impl Iterator<Item = &ArcStep> {
        self.pieces.iter().chain(&self.rest)
    }

    /// The point of its steps at a time from where they begin.
    fn point(&self, mut left: f64) -> StepPoint {
        let mut steps = self.steps().peekable();
        while let Some(ArcStep { step, unit, duration, .. }) = steps.next() {
            if left <= *duration || steps.peek().is_none() {
                return step.at(left.min(*duration)).times_power(*unit);
            }
            left -= duration;
        }
        StepPoint { x: -self.swing.start.value, v: 0.0 }
    }
}

impl MachineCurve {
    /// The state at a time from its start in the direction in which it was computed, in `1/omega_0`, and at its end after
    /// that; velocities divided by the natural frequency.
    pub fn at(&self, mut left: f64) -> State {
        let mut steps = self.steps.iter().peekable();
        while let Some(step) = steps.next() {
            if left <= step.duration || steps.peek().is_none() {
                let (q, v) = step.at(left.clamp(0.0, step.duration));
                return State { q, v };
            }
            left -= step.duration;
        }
        State::default()
    }
}
