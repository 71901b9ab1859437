//! The rows of the parameter pane, and the step size of each.

use serde::{Deserialize, Serialize};

use crate::flow::Problem;
use crate::oscillator::belt::{QUANTITIES, Quantity};
use crate::oscillator::{PARAMETERS, Symbol};
use crate::scene::{ScaledMachine, Scene};
use crate::session::state::step_size::StepSize;

/// A row of the parameter pane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Row {
    /// A number of a machine, in SI units, which changes D, D2, D3 and r together.
    Quantity(Quantity),
    /// One of the six numbers that define a motion.
    Parameter(Symbol),
    /// Bound w on the disturbance, a force that varies in any way.
    Disturbance,
    /// Time at which the motion stops.
    Until,
    Method,
    /// The number that sets the accuracy of the method: relative error of a step, step length, or width.
    Tolerance,
}

/// All rows, from top to bottom.
pub const ROWS: [Row; 17] = [
    Row::BELT,
    Row::Quantity(Quantity::NormalForce),
    Row::Quantity(Quantity::Friction),
    Row::Quantity(Quantity::Mass),
    Row::Quantity(Quantity::Stiffness),
    Row::Quantity(Quantity::Damping),
    Row::Quantity(Quantity::CubicDamping),
    Row::Parameter(Symbol::D),
    Row::Parameter(Symbol::D2),
    Row::Parameter(Symbol::D3),
    Row::Parameter(Symbol::R),
    Row::Disturbance,
    Row::Parameter(Symbol::Q0),
    Row::Parameter(Symbol::V0),
    Row::Until,
    Row::Method,
    Row::Tolerance,
];

impl Row {
    /// The row that is selected initially.
    pub const FIRST: Self = Row::Parameter(Symbol::D);

    /// The speed of the belt. The name of its quantity, v0, already names the initial velocity of the motion.
    pub const BELT: Self = Row::Quantity(Quantity::BeltSpeed);

    /// The name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Row::BELT => "belt",
            Row::Quantity(quantity) => quantity.spec().name,
            Row::Parameter(symbol) => symbol.spec().name,
            Row::Disturbance => "w",
            Row::Until => "until",
            Row::Method => "method",
            Row::Tolerance => "tolerance",
        }
    }

    /// The name on the screen; that of the tolerance depends on the method.
    pub fn name_in(self, problem: &Problem) -> &'static str {
        match self {
            Row::Tolerance => problem.method.spec().dial.name(),
            row => row.name(),
        }
    }
}

/// The step sizes of the six numbers, of the end time, of the belt and of the disturbance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Steps {
    /// Step of each parameter, in the order of the table.
    pub parameters: [StepSize; 6],
    /// Step of the end time.
    pub until: StepSize,
    /// Step of the speed of the belt, in m/s.
    #[serde(default = "usual_belt_step")]
    pub belt: StepSize,
    /// Steps of the other numbers of a machine, in the order of the table.
    #[serde(default = "usual_machine_steps")]
    pub machine: [StepSize; QUANTITIES.len() - 1],
    /// Step of the bound on the disturbance.
    #[serde(default = "usual_disturbance_step")]
    pub disturbance: StepSize,
}

/// First step of the speed of a belt, as a fraction of that speed.
const BELT_STEP: f64 = 1.0 / 30.0;

fn usual_belt_step() -> StepSize {
    StepSize::near(BELT_STEP)
}

fn usual_machine_steps() -> [StepSize; QUANTITIES.len() - 1] {
    [StepSize::near(1.0); QUANTITIES.len() - 1]
}

/// First step of a number of a machine, as a fraction of that number; for a damper or a friction that is zero,
/// as a fraction of the unit of D, D3 or r.
const MACHINE_STEP: f64 = 0.05;

fn machine_steps(scaled: &ScaledMachine) -> [StepSize; QUANTITIES.len() - 1] {
    let running = scaled.running();
    std::array::from_fn(|place| {
        let quantity = QUANTITIES[place].quantity;
        let value = scaled.machine.belt.get(quantity).abs();
        let unit = match quantity {
            Quantity::Damping => running.scale(Symbol::D),
            Quantity::CubicDamping => running.scale(Symbol::D3),
            Quantity::Friction => running.scale(Symbol::R),
            _ => value,
        };
        StepSize::near(MACHINE_STEP * if value > 0.0 { value } else { unit })
    })
}

/// First step of the disturbance.
const DISTURBANCE_STEP: f64 = 0.01;

fn usual_disturbance_step() -> StepSize {
    StepSize::near(DISTURBANCE_STEP)
}

/// First step of the end time: somewhat more than one and a half periods.
const UNTIL_STEP: f64 = 10.0;

impl Steps {
    /// The step of a row; `None` for the method, which is no number, and for the tolerance, whose step is a
    /// factor of ten.
    pub fn of(&self, row: Row) -> Option<StepSize> {
        { *self }.of_mut(row).copied()
    }

    /// The step of a row, mutable.
    pub fn of_mut(&mut self, row: Row) -> Option<&mut StepSize> {
        match row {
            Row::BELT => Some(&mut self.belt),
            Row::Quantity(quantity) => Some(&mut self.machine[quantity as usize]),
            Row::Parameter(symbol) => Some(&mut self.parameters[symbol as usize]),
            Row::Disturbance => Some(&mut self.disturbance),
            Row::Until => Some(&mut self.until),
            Row::Method | Row::Tolerance => None,
        }
    }

    /// The steps with which a scene opens.
    pub fn of_scene(scene: &Scene) -> Self {
        let step = |symbol: Symbol| {
            StepSize::near(scene.steps.get(&symbol).copied().unwrap_or(symbol.spec().step))
        };
        Steps {
            parameters: PARAMETERS.each_ref().map(|row| step(row.symbol)),
            disturbance: step_of_disturbance(scene),
            until: StepSize::near(UNTIL_STEP),
            machine: scene.machine.as_deref().map_or_else(usual_machine_steps, machine_steps),
            belt: scene.machine.as_ref().map_or_else(usual_belt_step, |scaled| {
                StepSize::near(BELT_STEP * scaled.machine.belt.belt_speed)
            }),
        }
    }
}

/// First step of the disturbance: a tenth of the friction, rounded to a step size.
fn step_of_disturbance(scene: &Scene) -> StepSize {
    let r = scene.problem.parameters.r;
    if r > 0.0 { StepSize::near(0.1 * r) } else { usual_disturbance_step() }
}
