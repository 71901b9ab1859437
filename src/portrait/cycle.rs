//! A limit cycle.

use serde::Serialize;

use super::evenly;
use crate::flow::{Detail, Limits, Method, Problem, Sample};
use crate::model::{Model, State};
use crate::numerics::{exp_m1, ln};

/// A limit cycle: of the paper's oscillator without units, of a machine in SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Cycle {
    /// Whether it attracts.
    pub stable: bool,
    /// Left turning point.
    pub q_min: f64,
    /// Right turning point.
    pub q_max: f64,
    /// Smallest velocity.
    pub v_min: f64,
    /// Largest velocity.
    pub v_max: f64,
    /// Period.
    pub period: f64,
    /// Floquet multiplier; `None` where it overflows.
    pub multiplier: Option<f64>,
    /// Natural logarithm of the multiplier.
    pub log_multiplier: f64,
    /// `q_max - r`, to full relative precision; 0 where it underflows.
    pub clearance: f64,
    /// Natural logarithm of the clearance.
    pub log_clearance: f64,
    /// Largest relative error of these numbers, where one is known. A multiplier that under- or overflows counts by
    /// its logarithm.
    pub error: Option<f64>,
    /// The error of each.
    pub errors: Option<CycleErrors>,
    /// Where and how long the mass rides on the belt; `None` of a cycle that only slips.
    #[serde(skip)]
    pub ride: Option<Ride>,
    /// Whether it overtakes the belt.
    #[serde(skip)]
    pub overtakes: bool,
}

/// A ride on the belt, once a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ride {
    /// Displacement at which it begins.
    pub from: f64,
    /// Displacement at which it ends.
    pub to: f64,
    /// Its duration.
    pub duration: f64,
}

/// Bounds on the absolute errors of the numbers of a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CycleErrors {
    /// Of the left turning point.
    pub q_min: f64,
    /// Of the right turning point.
    pub q_max: f64,
    /// Of the smallest velocity.
    pub v_min: f64,
    /// Of the largest velocity.
    pub v_max: f64,
    /// Of the period.
    pub period: f64,
    /// Of the logarithm of the multiplier: a relative error of the multiplier.
    pub log_multiplier: f64,
    /// Of the logarithm of the clearance: a relative error of the clearance.
    pub log_clearance: f64,
}

impl Cycle {
    /// Whether the mass sticks to the belt for part of the time.
    #[must_use]
    pub fn sticks(&self) -> bool {
        self.ride.is_some()
    }

    /// `stick-slip` or `slip`.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        if self.sticks() { "stick-slip" } else { "slip" }
    }

    /// Time per period on the belt.
    #[must_use]
    pub fn stick_duration(&self) -> f64 {
        self.ride.map_or(0.0, |ride| ride.duration)
    }

    /// Where it is at `count` evenly spaced times over one period, both ends included, from its right turning point on: the
    /// last point is the first again. It is a cycle of the oscillator of this problem or, in SI units, of a model.
    ///
    /// Each half swing is followed from its own turning point. `None` where it repels so strongly that it does not close to
    /// eleven digits all the same.
    ///
    /// ```
    /// use hopfscope::flow::{Limits, Problem};
    /// use hopfscope::model::{Parameters, State};
    /// use hopfscope::portrait::cycles;
    ///
    /// let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
    /// let cycle = cycles(&parameters, &Limits::PATIENT)?.cycles[0];
    /// let problem = Problem { parameters, ..Problem::default() };
    /// let points = cycle.orbit(&problem, None, 101, &Limits::PATIENT).unwrap();
    /// assert_eq!((points[0].q, points[100].tau), (cycle.q_max, cycle.period));
    /// assert!((points[50].q - cycle.q_min).abs() < 1e-11);
    /// # Ok::<(), hopfscope::flow::Reason>(())
    /// ```
    pub fn orbit(
        &self,
        problem: &Problem,
        model: Option<&Model>,
        count: usize,
        limits: &Limits,
    ) -> Option<Vec<Sample>> {
        const CLOSES: f64 = 1e-11;
        let times: Vec<f64> = evenly((0.0, self.period), count).collect();
        let tolerance = model.map_or(1e-14, |model| model.tolerance);
        let half = |q: f64, begun: f64| {
            let (initial, until) = (State { q, v: 0.0 }, self.period);
            let half = Problem { initial, until, method: Method::Auto, tolerance, ..*problem };
            let times: Vec<f64> = times.iter().map(|tau| tau - begun).collect();
            let (motion, samples) = half.at_times(model, &times, Detail::default(), limits);
            Some((*motion.crossings.first()?, samples))
        };
        let (left, below) = half(self.q_max, 0.0)?;
        let (right, above) = half(self.q_min, left.tau)?;
        let apart = (left.q - self.q_min).abs().max((right.q - self.q_max).abs());
        let point = |(&tau, (below, above)): (&f64, (Option<Sample>, Option<Sample>))| {
            let sample = if tau <= left.tau { below } else { above };
            Some(Sample { tau, ..sample? })
        };
        let points: Option<Vec<_>> =
            times.iter().zip(below.into_iter().zip(above)).map(point).collect();
        points.filter(|_| apart <= CLOSES * (self.q_max - self.q_min))
    }

    /// The same with lengths multiplied by one number, and times divided by another.
    #[must_use]
    pub fn scaled(&self, length: f64, rate: f64) -> Cycle {
        let speed = length * rate;
        let errors = self.errors.map(|errors| CycleErrors {
            q_min: errors.q_min * length,
            q_max: errors.q_max * length,
            v_min: errors.v_min * speed,
            v_max: errors.v_max * speed,
            period: errors.period / rate,
            ..errors
        });
        let ride = self.ride.map(|Ride { from, to, duration }| Ride {
            from: from * length,
            to: to * length,
            duration: duration / rate,
        });
        Cycle {
            q_min: self.q_min * length,
            q_max: self.q_max * length,
            v_min: self.v_min * speed,
            v_max: self.v_max * speed,
            period: self.period / rate,
            clearance: self.clearance * length,
            log_clearance: self.log_clearance + ln(length),
            errors,
            ride,
            ..*self
        }
    }

    /// Whether it is followed backward in time, in which direction it attracts.
    #[must_use]
    pub fn is_followed_backward(&self) -> bool {
        !self.stable && !self.sticks() && !self.overtakes
    }

    /// Whether its multiplier is far below the 1 at which two cycles meet.
    pub fn is_stable_beyond_doubt(&self) -> bool {
        /// Where two cycles meet, the logarithm vanishes to about half of the digits.
        const FAR: f64 = -1.0;
        self.log_multiplier < FAR
    }

    /// With these errors, the rounding of each number itself added, and the largest relative one.
    pub(crate) fn rounded(self, mut errors: CycleErrors) -> Self {
        let rounded = |value: f64| 2.0 * f64::EPSILON * value.abs();
        let lengths = [
            (&mut errors.q_min, self.q_min),
            (&mut errors.q_max, self.q_max),
            (&mut errors.v_min, self.v_min),
            (&mut errors.v_max, self.v_max),
            (&mut errors.period, self.period),
        ];
        let mut largest = 0.0_f64;
        for (error, value) in lengths {
            *error += rounded(value);
            largest = largest.max(*error / value.abs());
        }
        errors.log_multiplier += rounded(self.log_multiplier);
        errors.log_clearance += rounded(self.log_clearance.abs().max(1.0));
        let multiplier = match self.multiplier {
            Some(multiplier) if multiplier.is_normal() => exp_m1(errors.log_multiplier),
            _ => errors.log_multiplier / self.log_multiplier.abs(),
        };
        let error = largest.max(errors.log_clearance).max(multiplier);
        Cycle { error: Some(error), errors: Some(errors), ..self }
    }
}
