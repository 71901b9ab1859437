//! The automatic method: Taylor series; implicit steps while stability rather than accuracy limits the series;
//! and the closed form of a linear oscillation.
//!
//! On a slow manifold the length of an explicit step is a fixed multiple of the damping time, however smooth
//! the motion is. The product of step and damping rate therefore tells the two cases apart. It is below 1 where
//! accuracy limits the step. Where stability does, noise of the fast motion in coefficient N keeps it near
//! `(N!)^(1/N)`, about 0.4 N. Both factors come from the state in its own units, so the choice scales and
//! mirrors as the motion does, and the same question always gets the same answer. At loose tolerances this
//! noise may exceed the velocity and hide the sign, so a half swing of very many steps is suspect too.

use std::sync::Arc;

use super::{Cost, ExactStepper, Powers, Step, StepPoint, Stepper, StiffStepper, Taylor};
use crate::model::{Field, HalfPlane, Result};
use crate::numerics::{Bracket, PlaceTolerance, newton};

/// Length of a series step, in damping times and as a fraction of the order, beyond which stability limits it.
const LIMITED: f64 = 1.0 / 3.0;

/// Length of an implicit step, in damping times, below which the series is cheaper. Measured by
/// `hopfscope trade`: with a fifth of this value a stiff relaxation oscillation would cost half as much again.
const WORTHWHILE: f64 = 120.0;

/// Growth from one implicit step to the next that shows that the step length is still building up.
const GROWING: f64 = 1.5;

/// Short implicit steps that did not grow, after which the series takes over. A rejected step alone causes one.
const STALLED: u32 = 3;

/// Length of the first implicit step, as a multiple of the limited step before it.
const FIRST: f64 = 4.0;

/// Series steps in one half swing after which implicit steps are tried, whatever limits the series (an
/// oscillation needs a dozen), and the factor by which this number grows if they were not worthwhile.
const MANY: (u64, u64) = (100, 4);

/// Longest step in closed form. It could span a whole half swing; the limit keeps its curvature moderate.
const CLOSED: f64 = 1.0;

/// Consecutive limited steps before implicit ones are tried: initially, and at most, after implicit steps that
/// were not worthwhile. A motion that is stiff for only a dozen steps is over before implicit steps pay.
const PATIENCE: (u32, u32) = (12, 320);

/// The stepper that chooses the method of each step.
#[derive(Clone, Debug)]
pub struct AutoStepper {
    field: HalfPlane,
    taylor: Taylor,
    tolerance: f64,
    /// Created when first needed: most motions are never stiff.
    stiff: Option<Box<StiffStepper>>,
    exact: ExactStepper,
    /// Whether the last step was implicit, and whether the next one is to be.
    was_implicit: bool,
    implicit: bool,
    /// Length of the last implicit step in the current run, and whether any step of the run was worthwhile.
    reached: f64,
    worthwhile: bool,
    /// Short implicit steps that did not grow since the last worthwhile one.
    stalled: u32,
    /// Consecutive limited steps, and series steps in this half swing.
    limited: u32,
    series_steps: u64,
    /// How often implicit steps were not worthwhile since they last were.
    in_vain: u32,
    /// Number of implicit steps.
    pub(super) implicit_steps: u64,
}

/// One step of a motion, kept for later evaluation.
pub type KeptStep = Arc<dyn Stepper + Send + Sync>;

impl AutoStepper {
    /// A stepper with a relative error per step of about `tolerance`.
    pub fn new(tolerance: f64) -> Self {
        AutoStepper {
            field: HalfPlane::default(),
            taylor: Taylor::new(tolerance),
            tolerance,
            stiff: None,
            exact: ExactStepper::new(),
            was_implicit: false,
            implicit: false,
            reached: 0.0,
            worthwhile: false,
            stalled: 0,
            limited: 0,
            series_steps: 0,
            in_vain: 0,
            implicit_steps: 0,
        }
    }

    /// Whether the field is a linear oscillation, so that steps are those of the closed form.
    fn is_closed(&self) -> bool {
        self.field.is_linear() && self.field.d.abs() < 1.0
    }

    /// The implicit method, if it took the last step.
    fn implicit(&self) -> Option<&StiffStepper> {
        self.stiff.as_deref().filter(|_| self.was_implicit)
    }

    /// The method that took the last step.
    fn taken(&self) -> &dyn Stepper {
        match self.implicit() {
            Some(stiff) => stiff,
            None if self.is_closed() => &self.exact,
            None => &self.taylor,
        }
    }

    /// A copy of the method that took the last step, to be kept without the others.
    pub fn last_step(&self) -> KeptStep {
        match self.implicit() {
            Some(stiff) => Arc::new(stiff.clone()),
            None if self.is_closed() => Arc::new(self.exact.clone()),
            None => Arc::new(self.taylor.clone()),
        }
    }

    /// The integral of `v^2` over the last step; nonlinear fields only.
    pub fn square_integral(&self) -> f64 {
        self.implicit().map_or_else(|| self.taylor.square_integral(), |stiff| stiff.powers().x)
    }

    /// The largest v in the last step, which took this long, if the acceleration changes sign there.
    ///
    /// Newton's method on the acceleration. Since v is flat there, an error e in time costs only e^2 in v.
    pub fn fastest(&self, duration: f64) -> Option<f64> {
        let acceleration = |time: f64| {
            let StepPoint { x, v } = self.at(time);
            let acceleration = self.field.acceleration(x, v);
            (acceleration, self.field.divergence(v) * acceleration - v)
        };
        if acceleration(0.0).0 <= 0.0 || acceleration(duration).0 > 0.0 {
            return None;
        }
        let settled = PlaceTolerance::Absolute(1e-9 * duration);
        let bracket = Bracket::falling(0.0, duration);
        let peak = newton(bracket, 0.5 * duration, settled, acceleration);
        Some(self.at(peak).v)
    }

    /// The length of a step in units of the damping time at its end.
    fn damping_times(&self, step: &Step) -> f64 {
        -self.field.divergence(step.end.v) * step.duration
    }
}

impl Stepper for AutoStepper {
    fn begin(&mut self, field: &HalfPlane) {
        (self.field, self.series_steps) = (*field, 0);
        if self.is_closed() {
            self.exact.begin(field);
        }
        self.taylor.begin(field);
        if let Some(stiff) = &mut self.stiff {
            stiff.begin(field);
        }
    }

    /// Takes a step by the current method, then chooses the method of the next one.
    fn advance(&mut self, from: StepPoint, longest: f64, arrives: bool) -> Result<Step> {
        self.was_implicit = false;
        if self.is_closed() {
            return self.exact.advance(from, longest.min(CLOSED), arrives);
        }
        if self.implicit
            && let Some(stiff) = self.stiff.as_deref_mut()
            && let Ok(step) = stiff.advance(from, longest, arrives)
        {
            self.was_implicit = true;
            self.implicit_steps += 1;
            if self.damping_times(&step) >= WORTHWHILE {
                (self.worthwhile, self.stalled) = (true, 0);
            } else if step.duration < GROWING * self.reached {
                self.stalled += 1;
            }
            if self.stalled == STALLED {
                self.implicit = false;
                self.in_vain = if self.worthwhile {
                    0
                } else {
                    self.in_vain.saturating_add(1)
                };
            }
            self.reached = step.duration;
            return Ok(step);
        }
        self.implicit = false;
        let step = self.taylor.advance(from, longest, arrives)?;
        let limited = self.damping_times(&step) > LIMITED * self.taylor.order();
        self.limited = if limited { self.limited + 1 } else { 0 };
        self.series_steps += 1;
        let patience = PATIENCE.0.saturating_mul(2_u32.saturating_pow(self.in_vain));
        let many = MANY.0.saturating_mul(MANY.1.saturating_pow(self.in_vain));
        if self.limited >= patience.min(PATIENCE.1) || self.series_steps >= many {
            (self.limited, self.series_steps, self.reached) = (0, 0, 0.0);
            (self.implicit, self.worthwhile, self.stalled) = (true, false, 0);
            let (field, tolerance) = (self.field, self.tolerance);
            let stiff =
                self.stiff.get_or_insert_with(|| Box::new(StiffStepper::new(field, tolerance)));
            stiff.next = FIRST * step.duration;
        }
        Ok(step)
    }

    fn at(&self, time: f64) -> StepPoint {
        self.taken().at(time)
    }

    fn powers(&self) -> Powers {
        self.taken().powers()
    }

    fn cost(&self) -> Cost {
        let mut cost = self.taylor.cost();
        cost += self.exact.cost();
        cost += self.stiff.as_ref().map(|stiff| stiff.cost()).unwrap_or_default();
        cost
    }
}

#[cfg(test)]
mod tests {
    use super::super::trajectory::{choice, trajectory};
    use super::super::{Detail, Limits, Method, Motion, Outcome, Problem};
    use crate::model::{Parameters, State};

    fn problem(
        [d, d2, d3, r]: [f64; 4],
        q: f64,
        until: f64,
        method: Method,
        tolerance: f64,
    ) -> Problem {
        Problem {
            parameters: Parameters { d, d2, d3, r },
            initial: State { q, v: 0.0 },
            until,
            method,
            tolerance,
            ..Problem::default()
        }
    }

    fn run(parameters: [f64; 4], q: f64, until: f64, method: Method, tolerance: f64) -> Motion {
        let problem = problem(parameters, q, until, method, tolerance);
        trajectory(&problem, Detail::default(), &Limits::PATIENT)
    }

    #[test]
    fn closed_form_series_and_implicit_steps_each_where_they_belong() {
        let linear = run([-0.1, 0.0, 0.0, 0.1], 3.0, 60.0, Method::Auto, 1e-10);
        assert_eq!((linear.method, linear.implicit_steps), (Method::Exact, 0));
        assert!(choice(&linear).unwrap().starts_with("exact"));
        let smooth = run([-0.1, 0.0, 0.05, 0.1], 3.0, 200.0, Method::Auto, 1e-10);
        assert_eq!((smooth.method, smooth.implicit_steps), (Method::Taylor, 0));
        assert!(choice(&smooth).unwrap().starts_with("taylor"));
        let stiff = run([-0.1, 0.0, 1.0, 0.1], 1e6, 2e4, Method::Auto, 1e-10);
        assert!(stiff.implicit_steps > 10);
        assert!(choice(&stiff).unwrap().starts_with("stiff"));
        assert_eq!(choice(&run([0.0; 4], 1.0, 1.0, Method::Exact, 1e-10)), None);
    }

    /// Cost is measured in evaluations and compared with the series and the implicit method, one of which may
    /// give up.
    #[test]
    fn it_is_as_good_as_the_better_of_both() {
        for parameters in [[-0.1, 0.0, 1.0, 0.1], [0.1, 0.0, 1e6, 0.1], [20.0, 0.1, 0.0, 0.0]] {
            for q in [1.0, 10.0, 1e3, 1e5] {
                for tolerance in [1e-4, 1e-8, 1e-12] {
                    let auto = run(parameters, q, 1e4, Method::Auto, tolerance);
                    assert!(!matches!(auto.outcome, Outcome::GaveUp { .. }), "{auto:?}");
                    // With less than half of this cost neither of the two reaches the end.
                    let evaluations = auto.cost.evaluations.saturating_sub(400) / 2;
                    let limits = Limits { evaluations, ..Limits::PATIENT };
                    for method in [Method::Taylor, Method::Stiff] {
                        let problem = problem(parameters, q, 1e4, method, tolerance);
                        let one = trajectory(&problem, Detail::default(), &limits);
                        assert!(
                            matches!(one.outcome, Outcome::GaveUp { .. }),
                            "{parameters:?} from {q}, {method:?}: {} for {}",
                            one.cost.evaluations,
                            auto.cost.evaluations
                        );
                    }
                }
            }
        }
    }
}
