//! The rows of the parameter pane, and the step size of each.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::flow::Problem;
use crate::model::{Group, KNOBS, Knob};
use crate::numerics::decimal::StepSize;
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
