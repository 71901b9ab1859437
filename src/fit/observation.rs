//! The model of a record, and its residuals.
//!
//! `x(t) = offset + q(omega0 (t - t0); D, D2, D3, r, q0, v0)` in the unit of the record. The mass is either
//! held until an unknown time of release, or in motion from the first sample on; the two cases differ only in
//! one of the unknowns. Of a velocity or an acceleration, `q` is replaced by `omega0 q'` or `omega0^2 q''`, and the
//! offset is that of the signal. It may drift along a parabola, whose two numbers are held at zero unless the
//! record shows a drift. Turning points, with or without times, are the same motion observed only where `v = 0`.

use super::{
    BEND, FittedTurn, LAST, LostMotion, MotionPoint, OFFSET, OMEGA0, Q0, R, Record, SLOPE,
    StartKind, Unknowns, Way, direction, follow, index_at, parameters, rate,
};
use crate::model::State;
use crate::numerics::real;

impl Record {
    /// Number of residuals: of samples, or of displacements and times of peaks.
    pub fn residuals(&self) -> usize {
        if self.has_peaks() {
            self.x.len() + self.t.len()
        } else {
            self.x.len()
        }
    }

    /// Whether turning points were measured.
    pub fn has_peaks(&self) -> bool {
        self.peaks.is_some()
    }

    /// Average number of measurements in a period of the motion.
    pub(crate) fn samples_per_period(&self, omega0: f64) -> f64 {
        if self.has_peaks() {
            2.0
        } else {
            rate(&self.t) * std::f64::consts::TAU / omega0
        }
    }

    /// The time from the first measurement to the last one; 0 without times.
    pub fn duration(&self) -> f64 {
        self.t.last().zip(self.t.first()).map_or(0.0, |(last, first)| last - first)
    }

    /// The unit of the signal; empty if unknown.
    pub fn signal_unit(&self) -> String {
        self.signal.unit(self.unit.as_deref().unwrap_or_default())
    }

    /// The offset at a time.
    pub fn zero(&self, p: &Unknowns, time: f64) -> f64 {
        zero(p, drift(&self.t, time))
    }
}

/// The derivatives of the offset by [`SLOPE`] and [`BEND`] at a time.
pub fn drift(t: &[f64], time: f64) -> [f64; 2] {
    let (first, last) = (t[0], t[t.len() - 1]);
    let part = if last > first {
        (time - first) / (last - first) - 0.5
    } else {
        0.0
    };
    [part, part * part - 1.0 / 12.0]
}

fn zero(p: &Unknowns, [slope, bend]: [f64; 2]) -> f64 {
    p[OFFSET] + p[SLOPE] * slope + p[BEND] * bend
}

/// A residual, with the derivatives of the computed value.
#[derive(Clone, Copy, Debug)]
pub struct Residual {
    /// Measured minus computed.
    pub value: f64,
    /// The state of the computed motion.
    pub at: State,
    /// Derivatives of the computed value.
    pub by: Unknowns,
}

/// The model compared with the whole record.
#[derive(Clone, Debug, Default)]
pub struct Misfit {
    /// One for each measured number.
    pub residuals: Vec<Residual>,
    /// The turning points within the record.
    pub turns: Vec<FittedTurn>,
    /// Whether the motion comes to rest within the record.
    pub rests: bool,
    /// Where in the space of the unknowns this is.
    pub region: Region,
}

/// A part of the space of the unknowns: the number of half swings after which the mass rests within the record, or
/// `None` if it moves until the end. The residuals are smooth within a region; where a turning point crosses the
/// rim of the sticking set they have a kink.
pub type Region = Option<usize>;

/// A condition that keeps a step within a region or range: its value, which must not become negative, and its
/// derivatives.
pub type Bound = (f64, Unknowns);

impl Misfit {
    /// The distances of the last turning points from the rims that bound the region.
    pub fn clearances(&self, p: &Unknowns, data: &Record, start: StartKind) -> Vec<Bound> {
        // What follows the last of a list of peaks is not seen, so that it may lie on either side of the rim.
        let unseen = usize::from(self.region.is_none() && data.has_peaks());
        let last = self.turns.iter().rev().skip(unseen);
        let last = last.take(if self.region.is_some() { 2 } else { 1 });
        let bound = |(index, turn): (usize, &FittedTurn)| {
            // A mass that rests has turned within the sticking set, and before that outside it.
            let side = if self.region.is_some() && index == 0 {
                -1.0
            } else {
                1.0
            };
            let mut by = side * (turn.q.signum() * turn.q_by - direction(R));
            if start == StartKind::Release {
                by[LAST] = 0.0;
            }
            (side * (turn.q.abs() - p[R]), by)
        };
        last.enumerate().map(bound).collect()
    }
}

impl Record {
    /// Compares them with the model of a motion that begins in this way.
    ///
    /// # Errors
    /// [`LostMotion`] if the motion of the model escapes before the record ends.
    pub fn compare(&self, start: StartKind, p: &Unknowns, way: Way) -> Result<Misfit, LostMotion> {
        if !(p[OMEGA0] > 0.0 && p.iter().all(|value| value.is_finite())) {
            return Err(LostMotion);
        }
        let way = Way { signal: self.signal, ..way };
        match self.peaks {
            None => self.samples(start, p, way),
            Some(ratio) => peaks(p, self, ratio, way),
        }
    }

    fn samples(&self, begin: StartKind, p: &Unknowns, way: Way) -> Result<Misfit, LostMotion> {
        let Record { t, x, .. } = self;
        // Before the motion begins the mass is held.
        let (origin, start) = begin.beginning(p, t);
        let held = index_at(t, origin);
        let times: Vec<f64> = t.iter().map(|t| p[OMEGA0] * (t - origin)).collect();
        let order = way.signal.order();
        let scale = way.signal.scale(p[OMEGA0]);
        let mut residuals = Vec::with_capacity(x.len());
        let mut see = |index: usize, point: MotionPoint| {
            let drift = drift(t, t[index]);
            let mut by = scale * point.by;
            (by[OFFSET], by[SLOPE], by[BEND]) = (1.0, drift[0], drift[1]);
            let passed = times[index] / p[OMEGA0];
            by[OMEGA0] = scale * (point.rate * passed + real(order) * point.signal / p[OMEGA0]);
            if begin == StartKind::Release {
                by[LAST] = -scale * p[OMEGA0] * point.rate;
            }
            let at = State { q: point.q, v: point.v };
            let value = x[index] - zero(p, drift) - scale * point.signal;
            residuals.push(Residual { value, at, by });
        };
        let still = MotionPoint::resting(p[Q0], direction(Q0), way.signal);
        (0..held).for_each(|index| see(index, still));
        let followed =
            follow(&parameters(p), start, &times[held..], way, |index, at| see(held + index, at))?;
        let region = followed.rests.then_some(followed.turns.len());
        Ok(Misfit { residuals, turns: followed.turns, rests: followed.rests, region })
    }
}

/// Compares turning points; residuals of times are divided by `ratio`.
fn peaks(p: &Unknowns, data: &Record, ratio: f64, way: Way) -> Result<Misfit, LostMotion> {
    /// Upper bound of the duration of a half swing, in a motion that keeps oscillating.
    const SLOWEST: f64 = 50.0;
    let x = &data.x;
    let patience = [SLOWEST * real(x.len())];
    let way = Way { turns: x.len() - 1, ..way };
    let start = State { q: p[Q0], v: 0.0 };
    let followed = follow(&parameters(p), start, &patience, way, |_, _| {})?;
    let first = FittedTurn { q: p[Q0], q_by: direction(Q0), ..Default::default() };
    let mut turns: Vec<_> = std::iter::once(first).chain(followed.turns.iter().copied()).collect();
    // After the mass has come to rest the motion continues with amplitude zero. So nothing jumps when the last
    // turning point crosses the rim of the sticking set.
    while followed.rests && turns.len() < x.len() {
        let last = turns[turns.len() - 1];
        turns.push(FittedTurn { tau: last.tau + std::f64::consts::PI, ..last });
    }
    if turns.len() < x.len() {
        return Err(LostMotion);
    }
    let mut residuals = Vec::with_capacity(2 * x.len());
    for (turn, x) in turns.iter().zip(x) {
        let mut by = turn.q_by;
        // The motion begins at a turning point, without a velocity that could vary.
        (by[OFFSET], by[LAST]) = (1.0, 0.0);
        let at = State { q: turn.q, v: 0.0 };
        residuals.push(Residual { value: x - p[OFFSET] - turn.q, at, by });
    }
    for (turn, t) in turns.iter().zip(&data.t) {
        let mut by = turn.tau_by / (p[OMEGA0] * ratio);
        by[OMEGA0] = -turn.tau / (p[OMEGA0] * p[OMEGA0] * ratio);
        by[LAST] = 1.0 / ratio;
        let at = State { q: turn.q, v: 0.0 };
        let value = (t - p[LAST] - turn.tau / p[OMEGA0]) / ratio;
        residuals.push(Residual { value, at, by });
    }
    // What follows the last peak is not seen.
    let rests = followed.rests && followed.turns.len() + 1 < x.len();
    let region = rests.then_some(followed.turns.len());
    Ok(Misfit { residuals, turns: followed.turns, rests: followed.rests, region })
}
