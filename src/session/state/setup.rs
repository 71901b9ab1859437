//! What a change of a number can affect: the motions on show, the setting of the machine, and what is not known
//! exactly, such as the half widths of the parameters; the rows of the parameter pane, and the step size of each.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::flow::Problem;
use crate::model::{Belt, Group, KNOBS, Knob, State, Tolerances};
use crate::numerics::StepSize;
use crate::scene::{ScaledMachine, Scene, Setting};
use crate::session::Done;

/// Maximum number of motions on show, including the present one.
pub const MOST_MOTIONS: usize = 8;

/// Everything that a change of a number can affect: the motions, the machine that determines their units, and
/// what is not known exactly. Sessions are saved with it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setup {
    /// The present motion: parameters, start, end time, method and tolerance.
    #[serde(rename = "motion")]
    pub problem: Problem,
    /// Starts of the other motions, the oldest first.
    #[serde(rename = "beside", default, skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<State>,
    /// The setting of the machine; `None` if the scene has no machine.
    #[serde(rename = "belt", skip_serializing_if = "Option::is_none")]
    pub setting: Option<Setting>,
    /// Half widths of the parameters, held numbers, and the disturbance.
    #[serde(default, skip_serializing_if = "Uncertainty::is_none")]
    pub doubt: Uncertainty,
}

impl Setup {
    /// The setup with which a scene opens.
    pub fn of_scene(scene: &Scene) -> Self {
        let alone = Setup { others: scene.beside.clone(), ..Setup::alone(scene.problem) };
        let Some(scaled) = &scene.machine else { return alone };
        let setting = Some(Setting::of_speed(scaled.machine.belt.belt_speed));
        Setup { setting, doubt: Uncertainty::of_machine(scaled), ..alone }
    }

    /// A single motion without a machine, known exactly.
    pub fn alone(problem: Problem) -> Self {
        Setup { problem, others: Vec::new(), setting: None, doubt: Uncertainty::default() }
    }

    /// A number; `None` for one of a machine that is as in its file.
    pub fn get(&self, knob: Knob) -> Option<f64> {
        match knob {
            Knob::Disturbance => Some(self.doubt.disturbance),
            _ if knob.is_of_machine() => self.setting.as_ref()?.get(knob),
            _ => Some(self.problem.get(knob)),
        }
    }

    /// Fails with one line that names the first number that is not within its range.
    pub fn check(&self) -> Done {
        let accuracy = [Knob::Until, Knob::Tolerance, Knob::Step, Knob::Epsilon];
        for knob in Knob::MOTION.into_iter().chain(accuracy) {
            knob.check(self.problem.get(knob))?;
        }
        self.setting.as_ref().map_or(Ok(()), Setting::check)?;
        let (count, most) = (self.others.len(), MOST_MOTIONS - 1);
        if count > most {
            return Err(format!("{count} motions beside another; there can be {most}"));
        }
        for start in &self.others {
            Knob::Q0.check(start.q)?;
            Knob::V0.check(start.v)?;
        }
        self.doubt.check()
    }
}

/// The largest deviations of the parameters from their values, and the bound on a force that varies in any way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Uncertainty {
    /// Half widths of D, D2, D3 and r.
    pub half_widths: [f64; 4],
    /// Bound w on the disturbance, in the unit of r.
    pub disturbance: f64,
    /// Which of D, D2, D3, r, q0 and v0 are held at their values in a fit.
    #[serde(default)]
    pub held: [bool; 6],
}

/// The parameters that correspond to one number of a machine each.
pub const ON_A_MACHINE: [(Knob, Knob); 3] =
    [(Knob::D, Knob::Damping), (Knob::D3, Knob::CubicDamping), (Knob::R, Knob::Friction)];

/// The parameter that corresponds to a number of a machine, if one does.
pub fn symbol_of(quantity: Knob) -> Option<Knob> {
    ON_A_MACHINE.iter().find(|row| row.1 == quantity).map(|row| row.0)
}

impl Uncertainty {
    /// Whether nothing is uncertain, disturbed or held.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Whether everything is known exactly and there is no disturbance.
    pub fn is_certain(&self) -> bool {
        self.disturbance == 0.0 && self.half_widths == [0.0; 4]
    }

    /// Whether a number is held by hand.
    pub fn holds(&self, symbol: Knob) -> bool {
        self.held[symbol as usize]
    }

    /// Checks that no number is negative or infinite. Fails with one line that names the number.
    fn check(&self) -> Done {
        let mut all = self.half_widths.into_iter().chain([self.disturbance]);
        all.find(|value| !(0.0..=f64::MAX).contains(value)).map_or(Ok(()), |value| {
            Err(format!("doubt: {value:?}; uncertainties and disturbance are 0 or more"))
        })
    }

    /// The half width of a number; 0 for a number that has none.
    pub fn half_width(&self, symbol: Knob) -> f64 {
        if symbol.is_parameter() {
            self.half_widths[symbol.place()]
        } else {
            0.0
        }
    }

    /// This doubt with another half width of a parameter. Fails with one line if `symbol` is none.
    pub fn with_half_width(mut self, symbol: Knob, half: f64) -> Done<Self> {
        if !symbol.is_parameter() {
            return Err(format!("{symbol} has no uncertainty; only D, D2, D3 and r have one"));
        }
        self.half_widths[symbol.place()] = half;
        Ok(self)
    }

    /// The half widths by name, and the disturbance.
    pub fn tolerances(&self) -> Tolerances {
        let named = Knob::PARAMETERS.into_iter().zip(self.half_widths);
        let half_widths = named.map(|(knob, half)| (knob.to_string(), half)).collect();
        Tolerances { half_widths, disturbance: self.disturbance }
    }

    /// The tolerances from a machine's file, in the units of its oscillator.
    pub fn of_machine(scaled: &ScaledMachine) -> Self {
        let Tolerances { half_widths, disturbance } = &scaled.machine.tolerances;
        let mut doubt = Uncertainty::default();
        for (symbol, quantity) in ON_A_MACHINE {
            let half = half_widths.get(quantity.spec().name).copied().unwrap_or(0.0);
            doubt.half_widths[symbol.place()] = half / scaled.scale(symbol);
        }
        Uncertainty { disturbance: disturbance / scaled.reduced.units.force, ..doubt }
    }

    /// The tolerances of the machine on show that correspond to this; those of its other numbers are from its
    /// file. Fails with one line if D2, which no single part of the machine determines, has a half width.
    pub fn on_machine(&self, scaled: &ScaledMachine, belt: &Belt) -> Done<Tolerances> {
        if self.half_width(Knob::D2) > 0.0 {
            return Err("no part of the machine sets D2 alone: it has no uncertainty".to_owned());
        }
        let mut half_widths = scaled.machine.tolerances.half_widths.clone();
        for (symbol, quantity) in ON_A_MACHINE {
            let value = quantity.of_belt(belt).unwrap_or(0.0);
            let half = self.half_width(symbol) * scaled.scale(symbol);
            // Friction and dampers are never negative, so a half width is limited.
            let half = half.min((value - quantity.spec().min).abs());
            half_widths.insert(quantity.spec().name.to_owned(), half);
        }
        Ok(Tolerances { half_widths, disturbance: self.disturbance * scaled.reduced.units.force })
    }

    /// Converts this to the units of the machine at another speed of its belt.
    pub fn brought_to(mut self, from: &ScaledMachine, to: &ScaledMachine) -> Self {
        if self == Self::of_machine(from) {
            return Self::of_machine(to);
        }
        for (symbol, _) in ON_A_MACHINE {
            self.half_widths[symbol.place()] *= from.scale(symbol) / to.scale(symbol);
        }
        self.disturbance *= from.reduced.units.force / to.reduced.units.force;
        self
    }
}

/// A row of the parameter pane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// A number of the motion; or one of a machine, in SI units, which changes D, D2, D3 and r together.
    Number(Knob),
    Method,
    /// The number that sets the accuracy of the method: relative error of a step, step length, or width.
    Tolerance,
}

impl Default for Row {
    /// The row that is selected initially.
    fn default() -> Self {
        Row::Number(Knob::D)
    }
}

impl Row {
    /// All rows, from top to bottom: a machine's own numbers, that which is changed most next to those that follow.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        let others = [Knob::Disturbance, Knob::Q0, Knob::V0, Knob::Until];
        let machine = Group::Machine.knobs().filter(|knob| *knob != Knob::BeltSpeed);
        let machine = machine.chain(Group::Law.knobs()).chain([Knob::BeltSpeed]);
        let numbers = machine.chain(Knob::PARAMETERS).chain(others);
        numbers.map(Row::Number).chain([Row::Method, Row::Tolerance])
    }

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
        if self == Row::Method {
            "method"
        } else {
            self.knob_in(problem).spec().symbol
        }
    }

    /// The number, if keys change it by a step; not so the tolerance, whose step is a factor of ten.
    pub fn stepped(self) -> Option<Knob> {
        if let Row::Number(knob) = self {
            Some(knob)
        } else {
            None
        }
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
        Row::all().filter_map(|row| Some((row.name(), steps.of(row.stepped()?)))).collect()
    }
}

impl From<SavedSteps> for StepSizes {
    fn from(saved: SavedSteps) -> Self {
        let mut steps = StepSizes::default();
        let mut put = |knob: Knob, step: Option<StepSize>| {
            *steps.of_mut(knob) = step.unwrap_or(steps.of(knob));
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

impl Default for StepSizes {
    fn default() -> Self {
        StepSizes::from_each(|knob| knob.spec().step)
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

    /// The step of a number, mutable.
    pub fn of_mut(&mut self, knob: Knob) -> &mut StepSize {
        &mut self.0[knob as usize]
    }

    /// The steps with which a scene opens.
    pub fn of_scene(scene: &Scene) -> Self {
        let r = scene.problem.parameters.r;
        StepSizes::from_each(|knob| {
            let usual = scene.steps.get(&knob).copied().unwrap_or(knob.spec().step);
            match (knob, &scene.machine) {
                // A tenth of the friction, rounded to a step size.
                (Knob::Disturbance, _) if r > 0.0 => 0.1 * r,
                (knob, Some(scaled)) if knob.is_of_machine() => usual * size(scaled, knob),
                _ => usual,
            }
        })
    }
}

/// The size of a number of a machine; of a damper or a friction that is zero, the unit of D, D3 or r; of another one
/// that is zero, 1 in its SI unit.
pub(crate) fn size(scaled: &ScaledMachine, knob: Knob) -> f64 {
    let size = knob.of_belt(&scaled.machine.belt).map_or(0.0, f64::abs);
    let unit = symbol_of(knob).map(|symbol| scaled.scale(symbol));
    if size > 0.0 { size } else { unit.unwrap_or(1.0) }
}
