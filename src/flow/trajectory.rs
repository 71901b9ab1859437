//! A motion: swings until it is captured, escapes, reaches its end or is given up.

use std::ops::ControlFlow;

use serde::Serialize;

use super::exact::Exact;
use super::explicit::Dop853;
use super::scaling::{field_in_units, times_power};
use super::step::{Point, Powers, Step, Stepper};
use super::swing::{End, swing};
use super::taylor::Taylor;
use super::{Limits, Method, Reason};
use crate::oscillator::energy::energy;
use crate::oscillator::{HalfPlane, Ledger, Parameters, Side, State};

/// An initial value problem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Problem {
    /// Parameters of the oscillator.
    pub parameters: Parameters,
    /// Where the motion starts, at `tau = 0`.
    pub initial: State,
    /// Time at which to stop.
    pub until: f64,
    /// How to integrate.
    pub method: Method,
    /// Largest relative error of a step.
    pub tolerance: f64,
}

/// What to keep of a motion besides its outcome and its crossings; what is not asked for costs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Detail {
    /// Points for drawing: how many on each integration step (0 for none).
    pub samples_per_step: usize,
    /// The energy ledger.
    pub energy: bool,
}

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Outcome {
    /// At rest on the sticking set since `tau`.
    Captured {
        /// Time of the arrival.
        tau: f64,
        /// Place of rest.
        q: f64,
    },
    /// Still moving at the end time.
    Moving {
        /// The end time.
        tau: f64,
        /// Displacement then.
        q: f64,
        /// Velocity then.
        v: f64,
    },
    /// The velocity runs to infinity in finite time.
    Escaped {
        /// Estimated time of the blow-up.
        tau: f64,
    },
    /// No answer.
    GaveUp {
        /// How far it came.
        tau: f64,
        /// Why.
        #[serde(serialize_with = "reason_as_text")]
        reason: Reason,
    },
}

fn reason_as_text<S: serde::Serializer>(reason: &Reason, out: S) -> Result<S::Ok, S::Error> {
    out.collect_str(reason)
}

/// An arrival at `v = 0`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Crossing {
    /// Time.
    pub tau: f64,
    /// Displacement.
    pub q: f64,
}

/// A point of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time.
    pub tau: f64,
    /// Displacement.
    pub q: f64,
    /// Velocity.
    pub v: f64,
}

/// What a computation cost, counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Cost {
    /// Evaluations of the field; a Taylor series of order N counts as N.
    pub evaluations: u64,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
}

impl std::ops::AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.evaluations += other.evaluations;
        self.steps += other.steps;
        self.rejected += other.rejected;
    }
}

/// A computed motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// The question.
    pub problem: Problem,
    /// The method that answered it (never `Auto`).
    pub method: Method,
    /// How the motion ended.
    pub outcome: Outcome,
    /// Every arrival at `v = 0` after the start, the last one included.
    pub crossings: Vec<Crossing>,
    /// Where the energy went, if asked for.
    pub ledger: Option<Ledger>,
    /// Points for drawing, if asked for; the first is the start.
    pub samples: Vec<Sample>,
    /// What it cost.
    pub cost: Cost,
}

/// Computes a motion.
///
/// Guarantee: the answer is one of the typed outcomes; no number in it is NaN. The place and time of
/// every crossing carry the error of the steps before it, of relative size `tolerance` each.
#[must_use]
pub fn trajectory(problem: &Problem, detail: Detail, limits: &Limits) -> Trajectory {
    let parameters = &problem.parameters;
    match problem.method {
        Method::Auto | Method::Exact if parameters.is_piecewise_linear() => {
            Run::new(problem, Method::Exact, detail).go(&mut Exact::new(), limits)
        }
        Method::Exact => Run::new(problem, Method::Exact, detail)
            .give_up(Reason::NotApplicable { needs: "D2 = D3 = 0" }),
        Method::Auto | Method::Taylor => Run::new(problem, Method::Taylor, detail)
            .go(&mut Taylor::new(problem.tolerance), limits),
        Method::Dop853 => Run::new(problem, Method::Dop853, detail)
            .go(&mut Dop853::new(problem.tolerance), limits),
    }
}

/// A motion in the making.
struct Run {
    detail: Detail,
    /// What is known so far.
    found: Trajectory,
    time: Time,
    powers: Works,
}

/// Works of the damping terms and the path length, in the units of the problem.
#[derive(Default)]
struct Works {
    linear: f64,
    quadratic: f64,
    cubic: f64,
    path: f64,
}

/// A sum that remembers what rounding took: a million swings later the time is still right.
#[derive(Clone, Copy, Default)]
struct Time {
    sum: f64,
    lost: f64,
}

impl Time {
    fn plus(self, duration: f64) -> f64 {
        self.sum + (self.lost + duration)
    }

    fn advance(&mut self, duration: f64) {
        // Neumaier's compensated summation.
        let sum = self.sum + duration;
        self.lost += if self.sum >= duration {
            (self.sum - sum) + duration
        } else {
            (duration - sum) + self.sum
        };
        self.sum = sum;
    }
}

impl Run {
    fn new(problem: &Problem, method: Method, detail: Detail) -> Self {
        let moving = Outcome::Moving { tau: 0.0, q: problem.initial.q, v: problem.initial.v };
        let mut samples = Vec::new();
        if detail.samples_per_step > 0 {
            samples.push(Sample { tau: 0.0, q: problem.initial.q, v: problem.initial.v });
        }
        Run {
            detail,
            found: Trajectory {
                problem: *problem,
                method,
                outcome: moving,
                crossings: Vec::new(),
                ledger: None,
                samples,
                cost: Cost::default(),
            },
            time: Time::default(),
            powers: Works::default(),
        }
    }

    fn give_up(mut self, reason: Reason) -> Trajectory {
        self.found.outcome = Outcome::GaveUp { tau: self.time.plus(0.0), reason };
        self.found
    }

    /// Glues half swings until the motion ends.
    fn go<S: Stepper>(mut self, stepper: &mut S, limits: &Limits) -> Trajectory {
        let Problem { parameters, initial, until, .. } = self.found.problem;
        let r = parameters.r;
        let mut side = Side::entered_from(initial, r);
        let mut point = side.map_or(Point { x: 0.0, v: 0.0 }, |side| Point {
            x: side.position(initial.q, r),
            v: initial.v.abs(),
        });
        let mut last = initial;
        let outcome = loop {
            let Some(here) = side else {
                break Outcome::Captured { tau: self.time.plus(0.0), q: last.q };
            };
            let remaining = until - self.time.plus(0.0);
            if remaining <= 0.0 {
                break Outcome::Moving { tau: until, q: last.q, v: last.v };
            }
            let field = HalfPlane::new(&parameters, here);
            let (detail, time) = (self.detail, self.time);
            let (samples, works) = (&mut self.found.samples, &mut self.powers);
            let result =
                swing(stepper, &field, point, remaining, limits, |stepper, at, unit, step| {
                    if detail.samples_per_step > 0 {
                        sample(stepper, step, detail.samples_per_step, |offset, point| {
                            samples.push(Sample {
                                tau: time.plus(at + offset),
                                q: here.displacement(times_power(point.x, unit), r),
                                v: here.sign() * times_power(point.v, unit),
                            });
                        });
                    }
                    if detail.energy {
                        works.add(&stepper.powers(), &field, unit);
                    }
                    ControlFlow::Continue(())
                });
            let (duration, steps) = match &result {
                Ok(swing) => (swing.duration, swing.steps),
                Err(failed) => (failed.duration, failed.steps),
            };
            self.found.cost.steps += steps;
            self.time.advance(duration);
            let tau = self.time.plus(0.0);
            match result.map(|swing| swing.end) {
                Err(failed) => break Outcome::GaveUp { tau, reason: failed.reason },
                Ok(End::Escape) => break Outcome::Escaped { tau },
                Ok(End::Stopped { point: end }) => {
                    self.powers.path += end.x - point.x;
                    let (q, v) = (here.displacement(end.x, r), here.sign() * end.v);
                    last = State { q, v };
                    break if q.is_finite() && v.is_finite() {
                        Outcome::Moving { tau: until, q, v }
                    } else {
                        Outcome::GaveUp { tau, reason: Reason::OutOfRange }
                    };
                }
                Ok(End::Crossing { x }) => {
                    let q = here.displacement(x, r);
                    if !q.is_finite() {
                        break Outcome::GaveUp { tau, reason: Reason::OutOfRange };
                    }
                    self.found.crossings.push(Crossing { tau, q });
                    self.powers.path += x - point.x;
                    last = State { q, v: 0.0 };
                    // The next half swing starts from its clearance, known better than from q - r.
                    let clearance = x - 2.0 * r;
                    side = (clearance > 0.0).then(|| here.opposite());
                    point = Point { x: -clearance, v: 0.0 };
                }
            }
        };
        self.found.outcome = outcome;
        self.found.cost.evaluations = stepper.evaluations();
        self.found.cost.rejected = stepper.rejected();
        if self.detail.energy
            && !matches!(outcome, Outcome::Escaped { .. } | Outcome::GaveUp { .. })
        {
            self.found.ledger = Some(self.powers.balance(initial, last, r));
        }
        self.found
    }
}

impl Works {
    /// Books the work of the damping terms over one step measured in units of `2^unit`.
    fn add(&mut self, powers: &Powers, field: &HalfPlane, unit: i32) {
        let field = field_in_units(field, unit);
        let energy = |work: f64| times_power(times_power(work, unit), unit);
        self.linear += energy(-2.0 * field.d * powers.second);
        self.quadratic += energy(-field.d2 * powers.third);
        self.cubic += energy(-field.d3 * powers.fourth);
    }

    fn balance(&self, start: State, end: State, r: f64) -> Ledger {
        let (start, end) = (energy(start), energy(end));
        let friction = -r * self.path;
        let works = self.linear + self.quadratic + self.cubic + friction;
        Ledger {
            start,
            end,
            linear: self.linear,
            quadratic: self.quadratic,
            cubic: self.cubic,
            friction,
            residual: (end - start) - works,
        }
    }
}

/// Hands evenly spaced points of a step to `keep`, its end included, its start not.
fn sample<S: Stepper>(
    stepper: &mut S,
    step: &Step,
    count: usize,
    mut keep: impl FnMut(f64, Point),
) {
    let count = count * stepper.pieces();
    stepper.prepare_dense();
    for index in 1..count {
        #[expect(clippy::cast_precision_loss, reason = "a few hundred points")]
        let offset = step.duration * (index as f64 / count as f64);
        keep(offset, stepper.at(offset));
    }
    keep(step.duration, step.end);
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn problem(parameters: [f64; 4], initial: (f64, f64), method: Method) -> Problem {
        let [d, d2, d3, r] = parameters;
        Problem {
            parameters: Parameters { d, d2, d3, r },
            initial: State { q: initial.0, v: initial.1 },
            until: 60.0,
            method,
            tolerance: 1e-12,
        }
    }

    fn run(problem: &Problem) -> Trajectory {
        let detail = Detail { samples_per_step: 4, energy: true };
        trajectory(problem, detail, &Limits::PATIENT)
    }

    const METHODS_UNDER_TEST: [Method; 2] = [Method::Taylor, Method::Dop853];

    #[test]
    fn undamped_motion_loses_two_r_a_half_swing_and_rests() {
        for method in METHODS_UNDER_TEST {
            let motion = run(&problem([0.0, 0.0, 0.0, 0.125], (3.0, 0.0), method));
            let places: Vec<f64> = motion.crossings.iter().map(|crossing| crossing.q).collect();
            assert_eq!(places.len(), 12);
            for (index, place) in places.iter().enumerate() {
                let index = f64::from(u32::try_from(index).unwrap());
                let expected = (2.75 - 0.25 * index) * if index % 2.0 == 0.0 { -1.0 } else { 1.0 };
                assert!((place - expected).abs() < 1e-11, "{method}: {place} for {expected}");
            }
            assert!(matches!(motion.outcome, Outcome::Captured { .. }));
        }
    }

    #[test]
    fn methods_agree_with_the_closed_form() {
        for d in [-0.999, -0.1, -1e-12, -0.0, 0.05, 0.7, 1.0, 2.0] {
            for start in [(2.0, 0.0), (-0.4, 1.5), (0.1, -1e-3)] {
                let exact = run(&problem([d, 0.0, 0.0, 0.1], start, Method::Exact));
                for method in METHODS_UNDER_TEST {
                    let motion = run(&problem([d, 0.0, 0.0, 0.1], start, method));
                    assert_eq!(motion.crossings.len(), exact.crossings.len(), "{method} D = {d}");
                    for (one, other) in motion.crossings.iter().zip(&exact.crossings) {
                        let scale = other.q.abs().max(1.0) / (1.0 - d.abs()).abs().clamp(1e-3, 1.0);
                        assert!((one.q - other.q).abs() < 1e-9 * scale, "{method} D = {d}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_start_in_the_sticking_set_stays_there() {
        for q in [-0.5, -0.0, 0.3, 0.5] {
            let motion = run(&problem([-0.1, 0.3, 1.0, 0.5], (q, 0.0), Method::Taylor));
            assert_eq!(motion.outcome, Outcome::Captured { tau: 0.0, q });
            assert!(motion.crossings.is_empty() && motion.cost.evaluations == 0);
        }
    }

    #[test]
    fn one_ulp_outside_the_sticking_set_the_motion_swings_once_and_is_captured() {
        for method in METHODS_UNDER_TEST {
            let motion = run(&problem([-0.1, 0.3, 1.0, 0.5], (0.5_f64.next_up(), 0.0), method));
            assert_eq!(motion.crossings.len(), 1);
            assert!(matches!(motion.outcome, Outcome::Captured { q, .. } if q < 0.5 && q > 0.49));
        }
    }

    /// Far out the cubic term alone acts: `v' = v^3` from v0 blows up after `1/(2 v0^2)`.
    #[test]
    fn blow_up_time_of_a_cubic_tends_to_the_elementary_one() {
        let start = (0.0, 1e4);
        for method in METHODS_UNDER_TEST {
            let motion = run(&problem([0.0, 0.0, -1.0, 0.0], start, method));
            let Outcome::Escaped { tau } = motion.outcome else { panic!("{:?}", motion.outcome) };
            assert!((tau / 5e-9 - 1.0).abs() < 1e-10, "{method}: {tau:e}");
        }
    }

    #[test]
    fn an_interrupted_motion_says_so() {
        let limits = Limits { evaluations: 1_000_000, interrupted: &|| true };
        let question = problem([0.1, 0.2, 0.3, 0.1], (3.0, 0.0), Method::Taylor);
        let motion = trajectory(&question, Detail::default(), &limits);
        assert_eq!(motion.outcome, Outcome::GaveUp { tau: 0.0, reason: Reason::Interrupted });
    }

    fn parameters() -> impl Strategy<Value = [f64; 4]> {
        [-0.9..0.9, -1.0..1.0, -1.0..2.0, 0.0..0.5]
    }

    fn start() -> impl Strategy<Value = (f64, f64)> {
        (-3.0..3.0, prop_oneof![Just(0.0), -3.0..3.0])
    }

    proptest! {
        #[test]
        fn scaling_by_a_power_of_two_changes_no_bit(
            parameters in parameters(), start in start(), k in -400_i32..=400,
        ) {
            let unit = f64::from(k).exp2();
            for method in METHODS_UNDER_TEST {
                let plain = run(&problem(parameters, start, method));
                let [d, d2, d3, r] = parameters;
                let scaled = [d, d2 / unit, d3 / unit / unit, r * unit];
                let big = run(&problem(scaled, (start.0 * unit, start.1 * unit), method));
                prop_assert_eq!(plain.crossings.len(), big.crossings.len());
                for (plain, big) in plain.crossings.iter().zip(&big.crossings) {
                    prop_assert_eq!((plain.q * unit).to_bits(), big.q.to_bits());
                    prop_assert_eq!(plain.tau.to_bits(), big.tau.to_bits());
                }
                for (plain, big) in plain.samples.iter().zip(&big.samples) {
                    prop_assert_eq!((plain.q * unit, plain.v * unit), (big.q, big.v));
                }
            }
        }

        #[test]
        fn a_mirrored_motion_is_the_mirror_image(parameters in parameters(), start in start()) {
            for method in METHODS_UNDER_TEST {
                let plain = problem(parameters, start, method);
                let mirrored = Problem {
                    parameters: plain.parameters.mirrored(),
                    initial: plain.initial.mirrored(),
                    ..plain
                };
                let (plain, mirrored) = (run(&plain), run(&mirrored));
                prop_assert_eq!(plain.samples.len(), mirrored.samples.len());
                for (one, other) in plain.samples.iter().zip(&mirrored.samples) {
                    prop_assert_eq!((one.tau, one.q, one.v), (other.tau, -other.q, -other.v));
                }
            }
        }

        #[test]
        fn the_energy_ledger_closes(parameters in parameters(), start in start()) {
            for method in METHODS_UNDER_TEST {
                if let Some(ledger) = run(&problem(parameters, start, method)).ledger {
                    let turnover = ledger.start + ledger.end + ledger.linear.abs()
                        + ledger.quadratic.abs() + ledger.cubic.abs() + ledger.friction.abs();
                    prop_assert!(ledger.residual.abs() <= 2e-11 * turnover, "{method} {ledger:?}");
                }
            }
        }

        #[test]
        fn friction_never_gains_and_time_never_runs_back(
            parameters in parameters(), start in start(),
        ) {
            let motion = run(&problem(parameters, start, Method::Taylor));
            prop_assert!(motion.samples.windows(2).all(|pair| pair[0].tau <= pair[1].tau));
            if let Some(ledger) = motion.ledger {
                prop_assert!(ledger.friction <= 0.0);
            }
        }
    }
}
