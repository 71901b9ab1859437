//! The rows of the parameter pane, and the step size of each.
//!
//! Step sizes are 1, 2 and 5 times a power of ten. A step of 0.01 from -0.1 should give -0.09, not
//! -0.09000000000000001: sums are rounded to the digits that both terms can have.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::flow::Problem;
use crate::model::{Group, KNOBS, Knob};
use crate::numerics::elementary::{ln, log10};
use crate::scene::{ScaledMachine, Scene};
use crate::session::state::setup::symbol_of;

/// A row of the parameter pane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Row {
    /// A number of the motion; or one of a machine, in SI units, which changes D, D2, D3 and r together.
    Number(Knob),
    Method,
    /// The number that sets the accuracy of the method: relative error of a step, step length, or width.
    Tolerance,
}

/// The numbers of a machine that are changed while it runs; they stand above the others.
const FIRST_OF_MACHINE: [Knob; 3] = [Knob::BeltSpeed, Knob::NormalForce, Knob::Friction];

impl Row {
    /// All rows, from top to bottom.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        let others = [Knob::Disturbance, Knob::Q0, Knob::V0, Knob::Until];
        let rest = Knob::of_machines().filter(|knob| !FIRST_OF_MACHINE.contains(knob));
        let machine = FIRST_OF_MACHINE.into_iter().chain(rest);
        let numbers = machine.chain(Knob::PARAMETERS).chain(others);
        numbers.map(Row::Number).chain([Row::Method, Row::Tolerance])
    }

    /// The row that is selected initially.
    pub const FIRST: Self = Row::Number(Knob::D);

    /// The speed of the belt. The name of its quantity, v0, already names the initial velocity of the motion.
    pub const BELT: Self = Row::Number(Knob::BeltSpeed);

    /// The number that it is; for the method and its accuracy, the number that sets the accuracy of `problem`.
    pub fn knob_in(self, problem: &Problem) -> Knob {
        match self {
            Row::Number(knob) => knob,
            Row::Method | Row::Tolerance => problem.method.dial(),
        }
    }

    /// The name on the screen.
    pub fn name(self) -> &'static str {
        self.name_in(&Problem::default())
    }

    /// The name on the screen; that of the tolerance depends on the method.
    pub fn name_in(self, problem: &Problem) -> &'static str {
        if self == Row::Method { "method" } else { self.knob_in(problem).spec().symbol }
    }

    /// The number, if keys change it by a step; not so the tolerance, whose step is a factor of ten.
    pub fn stepped(self) -> Option<Knob> {
        if let Row::Number(knob) = self { Some(knob) } else { None }
    }

    /// Whether it is a number of a machine or its friction law.
    pub fn is_of_machine(self) -> bool {
        self.stepped().is_some_and(Knob::is_of_machine)
    }
}

/// The step size of each number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "SavedSteps", into = "BTreeMap<&'static str, StepSize>")]
pub struct StepSizes([StepSize; KNOBS.len()]);

/// Steps as they are saved: by the names of rows. Sessions used to list them in the order of the table.
#[derive(Deserialize)]
#[serde(untagged)]
enum SavedSteps {
    Named(BTreeMap<String, StepSize>),
    Listed {
        parameters: Vec<StepSize>,
        until: StepSize,
        belt: Option<StepSize>,
        #[serde(default)]
        machine: Vec<StepSize>,
        disturbance: Option<StepSize>,
    },
}

impl From<StepSizes> for BTreeMap<&'static str, StepSize> {
    fn from(steps: StepSizes) -> Self {
        Row::all().filter_map(|row| Some((row.name(), steps.of_row(row)?))).collect()
    }
}

impl From<SavedSteps> for StepSizes {
    fn from(saved: SavedSteps) -> Self {
        let mut steps = StepSizes::from_each(|knob| knob.spec().step);
        let mut put = |knob: Knob, step: Option<StepSize>| {
            steps.0[knob as usize] = step.unwrap_or(steps.0[knob as usize]);
        };
        match saved {
            SavedSteps::Named(named) => Row::all()
                .filter_map(|row| Some((row.stepped()?, row.name())))
                .for_each(|(knob, name)| put(knob, named.get(name).copied())),
            SavedSteps::Listed { parameters, until, belt, machine, disturbance } => {
                let motion = Knob::MOTION.into_iter().zip(parameters);
                let all = motion.chain(Group::Machine.knobs().zip(machine));
                all.for_each(|(knob, step)| put(knob, Some(step)));
                put(Knob::Until, Some(until));
                put(Knob::BeltSpeed, belt);
                put(Knob::Disturbance, disturbance);
            }
        }
        steps
    }
}

impl StepSizes {
    fn from_each(step: impl Fn(Knob) -> f64) -> Self {
        StepSizes(std::array::from_fn(|row| StepSize::near(step(KNOBS[row].knob))))
    }

    /// The step of a number.
    pub fn of(&self, knob: Knob) -> StepSize {
        self.0[knob as usize]
    }

    /// The step of a row; `None` for the method, which is no number, and for the tolerance.
    pub fn of_row(&self, row: Row) -> Option<StepSize> {
        row.stepped().map(|knob| self.of(knob))
    }

    /// The step of a row, mutable.
    pub fn of_row_mut(&mut self, row: Row) -> Option<&mut StepSize> {
        row.stepped().map(|knob| &mut self.0[knob as usize])
    }

    /// The steps with which a scene opens.
    pub fn of_scene(scene: &Scene) -> Self {
        StepSizes::from_each(|knob| {
            let usual = scene.steps.get(&knob).copied().unwrap_or(knob.spec().step);
            match (knob, &scene.machine) {
                (Knob::Disturbance, _) => step_of_disturbance(scene),
                (knob, Some(scaled)) if knob.is_of_machine() => usual * size(scaled, knob),
                _ => usual,
            }
        })
    }
}

/// The size of a number of a machine; of a damper or a friction that is zero, the unit of D, D3 or r; of another one
/// that is zero, 1 in its SI unit.
fn size(scaled: &ScaledMachine, knob: Knob) -> f64 {
    let size = knob.of_belt(&scaled.machine.belt).map_or(0.0, f64::abs);
    let unit = symbol_of(knob).map(|symbol| scaled.scale(symbol));
    if size > 0.0 { size } else { unit.unwrap_or(1.0) }
}

/// First step of the disturbance: a tenth of the friction, rounded to a step size.
fn step_of_disturbance(scene: &Scene) -> f64 {
    let r = scene.problem.parameters.r;
    if r > 0.0 { 0.1 * r } else { Knob::Disturbance.spec().step }
}

/// A step size: 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "f64", into = "f64")]
pub struct StepSize {
    /// Its place among all step sizes, three in each decade; that of 1 is 0.
    place: i32,
}

impl From<f64> for StepSize {
    fn from(value: f64) -> Self {
        StepSize::near(value)
    }
}

impl From<StepSize> for f64 {
    fn from(step: StepSize) -> Self {
        step.value()
    }
}

/// Places of the smallest and the largest step: well within the range of floating-point numbers.
const PLACES: std::ops::RangeInclusive<i32> = -870..=872;

/// Significant decimal digits that a double always preserves.
const DIGITS: i32 = 15;

impl StepSize {
    /// The step size nearest to a positive number, by ratio; 1 for anything else.
    pub fn near(value: f64) -> Self {
        if !(value > 0.0 && value.is_finite()) {
            return StepSize { place: 0 };
        }
        let below = StepSize { place: 0 }.moved(3 * decade(value));
        let distance = |step: &StepSize| ln(step.value() / value).abs();
        let candidates = (0..=3).map(|places| below.moved(places));
        candidates.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(below)
    }

    pub fn value(self) -> f64 {
        let mantissa = [1, 2, 5][self.place.rem_euclid(3).unsigned_abs() as usize];
        decimal(&format!("{mantissa}e{}", self.place.div_euclid(3)))
    }

    /// The step size that is some places larger, or the one at the end of the range.
    fn moved(self, places: i32) -> Self {
        StepSize { place: (self.place + places).clamp(*PLACES.start(), *PLACES.end()) }
    }

    /// The next larger step size, or this one at the end of the range.
    pub fn larger(self) -> Self {
        self.moved(1)
    }

    /// The next smaller step size, or this one at the end of the range.
    pub fn smaller(self) -> Self {
        self.moved(-1)
    }

    /// `value` moved by `count` steps, rounded to its own decimals and those of the step.
    pub fn from(self, value: f64, count: i32) -> f64 {
        decimal_sum(value, f64::from(count) * self.value())
    }

    /// The multiple of the step that is `count` multiples from `value`. If `value` lies between two multiples,
    /// the first step leads to the next multiple in that direction.
    pub fn multiple_from(self, value: f64, count: i32) -> f64 {
        let steps = value / self.value();
        // A value within rounding of a multiple counts as that multiple.
        let near = steps.round();
        let on = (steps - near).abs() <= 1e-9;
        let base = match (on, count > 0) {
            (true, _) => near,
            (false, true) => steps.floor(),
            (false, false) => steps.ceil(),
        };
        decimal_sum(0.0, (base + f64::from(count)) * self.value())
    }
}

/// The power of ten at or below a positive number.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of a double has three digits")]
fn decade(value: f64) -> i32 {
    log10(value).floor() as i32
}

/// Parses digits that this module has written itself.
fn decimal(text: &str) -> f64 {
    text.parse().unwrap_or(0.0)
}

/// The sum of two decimal numbers, rounded to the decimals that the larger one can have; never `-0.0`.
pub fn decimal_sum(value: f64, by: f64) -> f64 {
    let largest = value.abs().max(by.abs());
    let sum = value + by;
    if !(largest > 0.0 && sum.is_finite()) {
        return sum;
    }
    let decimals = DIGITS - 1 - decade(largest);
    let rounded = match usize::try_from(decimals) {
        Ok(decimals) => decimal(&format!("{sum:.decimals$}")),
        Err(_) => decimal(&format!("{sum:.14e}")),
    };
    rounded + 0.0
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn sums_of_decimals_are_decimals() {
        let hundredth = StepSize::near(0.01);
        assert_eq!(hundredth.from(-0.1, 1), -0.09);
        assert_eq!(hundredth.from(-0.03, 3), 0.0);
        assert!(hundredth.from(-0.01, 1).is_sign_positive());
        assert_eq!(hundredth.from(0.1234, 1), 0.1334);
        assert_eq!(StepSize::near(1.0).from(1.1, -1), 0.1);
        assert_eq!(StepSize::near(1e20).from(3e20, 1), 4e20);
        assert_eq!(StepSize::near(1e-12).from(-1e-12, 1), 0.0);
    }

    #[test]
    fn sizes_go_one_two_five() {
        let mut step = StepSize::near(0.01);
        for wanted in [0.02, 0.05, 0.1, 0.2] {
            step = step.larger();
            assert_eq!(step.value(), wanted);
        }
        for wanted in [0.1, 0.05, 0.02, 0.01, 0.005] {
            step = step.smaller();
            assert_eq!(step.value(), wanted);
        }
    }

    #[test]
    fn multiples_are_met_from_between_and_left_from_on_them() {
        let tenth = StepSize::near(0.1);
        assert_eq!(tenth.multiple_from(0.3, 1), 0.4);
        assert_eq!(tenth.multiple_from(0.34, 1), 0.4);
        assert_eq!(tenth.multiple_from(0.34, -1), 0.3);
        assert_eq!(tenth.multiple_from(-0.1, 1), 0.0);
    }

    proptest! {
        #[test]
        fn a_step_back_undoes_a_step(digits in -99_999..99_999_i32, decimals in 0..6_i32, size in -8..3_i32) {
            let value = decimal(&format!("{digits}e-{decimals}"));
            let step = StepSize { place: 3 * size };
            prop_assert_eq!(step.from(step.from(value, 1), -1), value);
        }

        #[test]
        fn every_number_has_a_step(value in proptest::num::f64::ANY) {
            let step = StepSize::near(value);
            prop_assert!(step.value() > 0.0 && step.value().is_finite());
            prop_assert!(!step.from(value, 1).is_nan() || value.is_nan());
        }
    }
}
