//! A motion at given times. Each is evaluated on the integration step within which it lies, by the dense output of the
//! method: that of Taylor series, of the closed form and of collocation is the solution of the step itself, and an explicit
//! method takes a shorter step to that time.

use super::machine::motion::follow_at;
use super::trajectory::evaluated;
use super::{Detail, Limits, Motion, MotionUnits, Outcome, Problem, Sample};
use crate::model::Model;

/// The times at which a motion is evaluated, and where it was at those that it has passed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Instants<'a> {
    /// Those that are left, in ascending order.
    left: &'a [f64],
    passed: Vec<Sample>,
}

impl<'a> Instants<'a> {
    /// None of these times, in ascending order, is passed yet.
    pub fn new(left: &'a [f64]) -> Self {
        Instants { left, passed: Vec::new() }
    }

    /// Passes those up to a time; `at` has displacement and velocity. What is beyond the largest numbers is left out.
    pub fn pass(&mut self, until: f64, mut at: impl FnMut(f64) -> (f64, f64)) {
        let (now, later) = self.left.split_at(self.left.partition_point(|tau| *tau <= until));
        self.left = later;
        for &tau in now {
            let (q, v) = at(tau);
            if q.is_finite() && v.is_finite() {
                // Without negative zeros.
                self.passed.push(Sample { tau, q: q + 0.0, v: v + 0.0 });
            }
        }
    }

    /// Replaces the points of a motion that ended so by all that are known of it, if it was to be evaluated: after its
    /// capture it rests.
    pub fn tell(mut self, outcome: Outcome, samples: &mut Vec<Sample>) {
        if self.left.is_empty() && self.passed.is_empty() {
            return;
        }
        if let Some(end) = outcome.state() {
            let rests = matches!(outcome, Outcome::Captured { .. });
            self.pass(if rests { f64::INFINITY } else { outcome.tau() }, |_| end);
        }
        *samples = self.passed;
    }
}

impl Problem {
    /// The motion of the oscillator of the paper, or of a machine in SI units, and where it is at each of these times, in any
    /// order: at rest after its capture, and `None` before its start, after its end time, its escape or where it was given
    /// up. Of a machine only Taylor series are evaluated. The points of the motion are those at these times.
    ///
    /// The error is that of the motion itself, to which evaluating it adds no more than another step would.
    ///
    /// ```
    /// use hopfscope::flow::{Detail, Limits, Problem};
    /// use hopfscope::model::{Parameters, State};
    ///
    /// // Without damping the first half swing is q = -r + (q0 + r) cos tau.
    /// let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.1 };
    /// let problem = Problem::new(parameters, State { q: 1.0, v: 0.0 }, 60.0);
    /// let (_, samples) = problem.at_times(None, &[2.0, 50.0, 61.0], Detail::default(), &Limits::PATIENT);
    /// let first = samples[0].unwrap();
    /// assert!((first.q - (0.1 + 0.9 * 2.0_f64.cos())).abs() < 1e-14);
    /// assert!(samples[1].unwrap().v == 0.0 && samples[2].is_none());
    /// ```
    pub fn at_times(
        &self,
        model: Option<&Model>,
        times: &[f64],
        detail: Detail,
        limits: &Limits,
    ) -> (Motion, Vec<Option<Sample>>) {
        let within = |tau: &&f64| (0.0..=self.until).contains(*tau);
        let mut sorted: Vec<f64> = times.iter().filter(within).copied().collect();
        sorted.sort_by(f64::total_cmp);
        let motion = match model {
            Some(model) => follow_at(model, self, MotionUnits::physical(model), detail, &sorted),
            None => evaluated(self, detail, &sorted, limits),
        };
        let known = &motion.samples;
        let at = |tau: &f64| {
            let place = known.binary_search_by(|sample| sample.tau.total_cmp(tau)).ok()?;
            Some(known[place])
        };
        let samples = times.iter().map(at).collect();
        (motion, samples)
    }
}
