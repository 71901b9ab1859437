//! Explicit Runge-Kutta: the pair DOP853 of Dormand and Prince.
//!
//! Order 8 with the combined error estimate of orders 5 and 3 and the step size rule of Hairer, Norsett
//! and Wanner (section II.10 of their book). A step that passes `v = 0` is taken again, shorter, until
//! it ends there: Newton's method on the step length, so a crossing is as good as a step.

use super::limits::Reason;
use super::scaling::{rough_exp2, rough_log2};
use super::step::{Point, Powers, Step, Stepper};
use super::tableau::{A, DENSE, ERROR3, ERROR5, STAGES, STAGES_DENSE, WEIGHTS};
use crate::oscillator::HalfPlane;

/// Longest step, well below the shortest half swing of a linear oscillator (pi).
const LONGEST: f64 = 2.0;

/// Newton steps on the length of the last step of a swing; it settles in about four.
const POLISHING: usize = 30;

/// The stepper.
#[derive(Clone, Debug)]
pub struct Dop853 {
    field: HalfPlane,
    tolerance: f64,
    /// Length to try next; 0 before the first step.
    next: f64,
    start: Point,
    end: Point,
    duration: f64,
    /// Slopes of x (the velocities of the stages) and of v.
    velocity: [f64; STAGES_DENSE],
    acceleration: [f64; STAGES_DENSE],
    /// Coefficients of the dense output of x and v.
    dense: [[f64; 7]; 2],
    evaluations: u64,
    rejected: u64,
}

impl Dop853 {
    /// A stepper whose estimated relative error a step is below `tolerance`.
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        Dop853 {
            field: HalfPlane { d: 0.0, d2: 0.0, d3: 0.0 },
            tolerance,
            next: 0.0,
            start: Point { x: 0.0, v: 0.0 },
            end: Point { x: 0.0, v: 0.0 },
            duration: 0.0,
            velocity: [0.0; STAGES_DENSE],
            acceleration: [0.0; STAGES_DENSE],
            dense: [[0.0; 7]; 2],
            evaluations: 0,
            rejected: 0,
        }
    }

    /// Stage `index` from those before it, over a step of length `h`.
    fn stage(&mut self, index: usize, h: f64) {
        let row = &A[index - 1];
        let (mut x, mut v) = (0.0, 0.0);
        for (j, &a) in row.iter().enumerate().take(index) {
            x += a * self.velocity[j];
            v += a * self.acceleration[j];
        }
        let point = Point { x: self.start.x + h * x, v: self.start.v + h * v };
        self.velocity[index] = point.v;
        self.acceleration[index] = self.field.acceleration(point.x, point.v);
        self.evaluations += 1;
    }

    /// One step of order 8 and length `h` from `self.start`, whose first stage stands.
    fn attempt(&mut self, h: f64) -> Point {
        for index in 1..STAGES {
            self.stage(index, h);
        }
        let sum = |slopes: &[f64; STAGES_DENSE]| {
            WEIGHTS.iter().zip(slopes).map(|(weight, slope)| weight * slope).sum::<f64>()
        };
        Point {
            x: self.start.x + h * sum(&self.velocity),
            v: self.start.v + h * sum(&self.acceleration),
        }
    }

    /// Error of the attempt in units of the tolerance: below 1 is accepted.
    fn error(&self, h: f64, end: Point) -> f64 {
        let scale = self.tolerance * self.start.size().max(end.size());
        let norm = |weights: &[f64; STAGES]| {
            let sum = |slopes: &[f64; STAGES_DENSE]| {
                weights.iter().zip(slopes).map(|(weight, slope)| weight * slope).sum::<f64>()
            };
            let (x, v) = (sum(&self.velocity) / scale, sum(&self.acceleration) / scale);
            x * x + v * v
        };
        let (fifth, third) = (norm(&ERROR5), norm(&ERROR3));
        if fifth == 0.0 && third == 0.0 {
            return 0.0;
        }
        // Two components; 0.01 is the published weight of the third-order estimate.
        h * fifth / (2.0 * (fifth + 0.01 * third)).sqrt()
    }

    /// Shortens the step until it ends at `v = 0`.
    fn arrive(&mut self, h: f64) -> Step {
        let (mut low, mut high, mut length) = (0.0, h, h);
        let mut end = self.end;
        for _ in 0..POLISHING {
            let newton = length - end.v / self.field.acceleration(end.x, end.v);
            // The change after this one would be its square: below rounding.
            if (newton - length).abs() <= 1e-9 * length {
                break;
            }
            if end.v > 0.0 {
                low = length;
            } else {
                high = length;
            }
            length = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            end = self.attempt(length);
        }
        let slope = self.field.acceleration(end.x, end.v);
        let rest = if slope == 0.0 { 0.0 } else { -end.v / slope };
        self.duration = length + rest;
        self.end = Point { x: end.x + rest * end.v + 0.5 * rest * rest * slope, v: 0.0 };
        Step { duration: self.duration, end: self.end, crossed: true }
    }

    /// A first step: the state may change by a hundredth of its size (Hairer, Norsett and Wanner II.4).
    fn first_step(&self) -> f64 {
        let slope = self.velocity[0].abs().max(self.acceleration[0].abs());
        if slope > 0.0 { (0.01 * self.start.size() / slope).min(LONGEST) } else { LONGEST }
    }
}

impl Stepper for Dop853 {
    fn begin(&mut self, field: &HalfPlane) {
        self.field = *field;
    }

    fn advance(&mut self, from: Point, longest: f64) -> Result<Step, Reason> {
        self.start = from;
        self.velocity[0] = from.v;
        self.acceleration[0] = self.field.acceleration(from.x, from.v);
        self.evaluations += 1;
        if self.next == 0.0 {
            self.next = self.first_step();
        }
        let mut grow = 10.0;
        let mut length = self.next.min(longest);
        loop {
            if length < f64::MIN_POSITIVE {
                return Err(Reason::StepTooSmall { step: length });
            }
            let end = self.attempt(length);
            let error = self.error(length, end);
            // A step that turned around passed two crossings and is taken again, shorter.
            if error <= 1.0 && (end.v <= 0.0 || end.x >= from.x) {
                let factor = if error == 0.0 {
                    grow
                } else {
                    (0.9 * rough_exp2(-0.125 * rough_log2(error))).clamp(0.2, grow)
                };
                let next = (length * factor).min(LONGEST);
                // A step cut short by the end time says nothing about the next one.
                self.next = if length < self.next { self.next.max(next) } else { next };
                (self.end, self.duration) = (end, length);
                if end.v <= 0.0 {
                    return Ok(self.arrive(length));
                }
                return Ok(Step { duration: length, end, crossed: false });
            }
            self.rejected += 1;
            grow = 1.0;
            let factor = if error.is_finite() {
                (0.9 * rough_exp2(-0.125 * rough_log2(error.max(1.0)))).clamp(0.2, 0.9)
            } else {
                1e-3
            };
            length *= factor;
            self.next = length;
        }
    }

    fn prepare_dense(&mut self) {
        let h = self.duration;
        self.velocity[STAGES] = self.end.v;
        self.acceleration[STAGES] = self.field.acceleration(self.end.x, self.end.v);
        self.evaluations += 1;
        for index in STAGES + 1..STAGES_DENSE {
            self.stage(index, h);
        }
        let ends = [(self.start.x, self.end.x), (self.start.v, self.end.v)];
        for (component, (from, to)) in ends.into_iter().enumerate() {
            let slopes = if component == 0 { &self.velocity } else { &self.acceleration };
            let change = to - from;
            let dense = &mut self.dense[component];
            dense[0] = change;
            dense[1] = h * slopes[0] - change;
            dense[2] = 2.0 * change - h * (slopes[STAGES] + slopes[0]);
            for (coefficient, row) in dense[3..].iter_mut().zip(&DENSE) {
                *coefficient = h * row.iter().zip(slopes).map(|(d, slope)| d * slope).sum::<f64>();
            }
        }
    }

    fn at(&self, time: f64) -> Point {
        let s = time / self.duration;
        let value = |from: f64, dense: &[f64; 7]| {
            // Nested alternately in s and 1 - s, as published.
            let nested = dense.iter().enumerate().rev().fold(0.0, |sum, (index, coefficient)| {
                (sum + coefficient) * if index % 2 == 0 { s } else { 1.0 - s }
            });
            from + nested
        };
        Point { x: value(self.start.x, &self.dense[0]), v: value(self.start.v, &self.dense[1]) }
    }

    /// The quadrature of the method itself: its stages are its nodes, of order 8.
    fn powers(&self) -> Powers {
        let mut powers = Powers::default();
        for (weight, &v) in WEIGHTS.iter().zip(&self.velocity) {
            powers.add_node(weight * self.duration, v);
        }
        powers
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    fn rejected(&self) -> u64 {
        self.rejected
    }
}
