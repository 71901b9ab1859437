//! A motion at given times. Each is evaluated on the integration step within which it lies, by the dense output of the
//! method: that of Taylor series, of the closed form and of collocation is the solution of the step itself, and an explicit
//! method takes a shorter step to that time.

use super::machine::motion::follow_at;
use super::trajectory::evaluated;
use super::{Detail, Limits, Motion, MotionUnits, Problem, Sample};
use crate::model::Model;

impl Problem {
    /// The motion of the oscillator of the paper, or of a machine in SI units, and where it is at each of these times, in any
    /// order: at rest after its capture, and `None` before its start, after its end time, its escape or where it was given
    /// up. Of a machine only Taylor series are evaluated.
    ///
    /// The error is that of the motion itself, to which evaluating it adds no more than another step would.
    ///
    /// ```
    /// use hopfscope::flow::{Detail, Limits, Problem};
    /// use hopfscope::model::{Parameters, State};
    ///
    /// // Without damping the first half swing is q = r + (q0 - r) cos tau.
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
        let mut sorted = times.to_vec();
        sorted.retain(|tau| (0.0..=self.until).contains(tau));
        sorted.sort_by(f64::total_cmp);
        let asked = (Detail { samples_per_step: 0, ..detail }, sorted.as_slice());
        let motion = match model {
            Some(model) => follow_at(model, self, MotionUnits::physical(model), asked),
            None => evaluated(self, asked, limits),
        };
        let at = |&tau: &f64| {
            let ended = (motion.outcome.tau()..=self.until).contains(&tau);
            if let Some((q, v)) = motion.outcome.state().filter(|_| ended) {
                return Some(Sample { tau, q, v });
            }
            let known = &motion.samples;
            let place = known.binary_search_by(|sample| sample.tau.total_cmp(&tau)).ok()?;
            Some(known[place])
        };
        let samples = times.iter().map(at).collect();
        (motion, samples)
    }
}
