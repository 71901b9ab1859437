//! The belt of the machine on show: its speed, and whether the numbers on show are those of the machine.
//!
//! A speed of the belt stands for all of D, D2, D3 and r. To change one of these by hand leaves the
//! belt: the numbers are then those of no belt speed, until the speed is given again.

use crate::flow::Problem;
use crate::oscillator::belt::Quantity;
use crate::oscillator::{Belt, Parameters, State, Symbol};
use crate::question::Whole;
use crate::question::whole::{Course, Kinds};
use crate::scene::{Answer, Layer, Machine, Running, Setting, Topic};
use crate::session::state::doubt::{Doubt, symbol_of};
use crate::session::state::session::Session;
use crate::session::state::setup::Setup;

impl Session {
    /// The motion on show and the speed of the belt.
    pub fn setup(&self) -> Setup {
        let Session { problem, others, setting, doubt, .. } = *self;
        Setup { problem, others, setting, doubt }
    }

    /// The machine of the scene as it is set, at the present speed of its belt.
    pub fn running(&self) -> Option<Running<'_>> {
        let scaled = self.scene.machine.as_ref()?;
        let machine = self.rebuilt.as_deref().unwrap_or(&scaled.machine);
        let present = self.setting.and_then(|it| Running::at(machine, it.speed).ok());
        Some(present.unwrap_or_else(|| scaled.running()))
    }

    /// Whether the numbers on show are those of the machine at the speed of its belt; `None` without one.
    pub fn is_on_the_belt(&self) -> Option<bool> {
        Some(self.running()?.carries(&self.problem.parameters))
    }

    /// The machine on show, where the whole model can answer for it: D, D3 and r changed by hand stand for
    /// the dampers and the guide, D2 for nothing.
    pub fn machine(&self) -> Option<Belt> {
        let running = self.running()?;
        let mut belt = Belt { belt_speed: running.speed, ..running.machine.belt.clone() };
        if running.carries(&self.problem.parameters) {
            return Some(belt);
        }
        let own = Session::of_parameters(&running.reduced.parameters);
        if own(Symbol::D2) != self.value(Symbol::D2) {
            return None;
        }
        for (symbol, quantity) in [
            (Symbol::D, Quantity::Damping),
            (Symbol::D3, Quantity::CubicDamping),
            (Symbol::R, Quantity::Friction),
        ] {
            let value = self.value(symbol);
            if own(symbol) != value {
                belt.set(quantity, running.meaning(symbol, value)?.1);
            }
        }
        let moving = belt.friction;
        belt.static_guide = belt.static_guide.map(|at_rest| at_rest.max(moving));
        Some(belt)
    }

    /// Whether the whole model is drawn: the scene is of a machine for which it can answer, and it is wished.
    pub fn draws_whole(&self) -> bool {
        self.layers.contains(&Layer::Whole) && self.machine().is_some()
    }

    /// What the whole model says about the motion on show; `None` while it is not drawn or not known.
    pub fn course(&self) -> Option<&Course> {
        self.whole(Topic::Trajectory)?.motion.as_ref()
    }

    /// What the whole model says about the cycles; `None` while it is not known.
    pub fn kinds(&self) -> Option<&Kinds> {
        self.whole(Topic::Cycles)?.cycles.as_ref()
    }

    fn whole(&self, topic: Topic) -> Option<&Whole> {
        let found = self.standing(topic, self.plot).answered()?.result.as_ref().ok()?;
        let Answer::Whole(whole) = found else { return None };
        Some(whole)
    }

    /// Reads numbers out of some parameters.
    fn of_parameters(parameters: &Parameters) -> impl Fn(Symbol) -> f64 {
        let parameters = *parameters;
        move |symbol| symbol.get(&parameters, &State { q: 0.0, v: 0.0 })
    }

    /// A number of the machine as it is set, in SI units; 0 where there is none.
    pub fn quantity(&self, quantity: Quantity) -> f64 {
        self.running().map_or(0.0, |running| match quantity {
            Quantity::BeltSpeed => running.speed,
            other => running.machine.belt.get(other),
        })
    }

    /// What is not known exactly, with a tolerance of a number of the machine, in SI units. Fails with one line,
    /// where no parameter stands for that number.
    pub(in crate::session) fn with_tolerance(
        &self,
        setup: &Setup,
        quantity: Quantity,
        half_width: f64,
    ) -> Result<Doubt, String> {
        let name = quantity.spec().name;
        let symbol = symbol_of(quantity).ok_or_else(|| {
            format!(
                "{name} has no tolerance here; R, d1 and d3 have, all of them in a machine's file"
            )
        })?;
        let machine = self.set_machine(setup)?;
        let running = Running::at(&machine, machine.belt.belt_speed)?;
        setup.doubt.with_half_width(symbol, half_width / running.scale(symbol))
    }

    /// What 1 of r and w stands for, in newtons. Fails with one line, where the scene has no machine.
    pub(in crate::session) fn unit_of_force(&self, setup: &Setup) -> Result<f64, String> {
        let fitted = self.fitted().and_then(|fitted| fitted.fit.units());
        if let Some(units) = fitted {
            let known = Some(units.force).filter(|force| force.is_finite());
            return known.ok_or_else(|| {
                "no mass is known: :fit FILE mass=2 kg, or stiffness=800 N/m".to_owned()
            });
        }
        let machine = self.set_machine(setup)?;
        Ok(Running::at(&machine, machine.belt.belt_speed)?.reduced.units.force)
    }

    /// The machine of the scene as it is set.
    fn set_machine(&self, setup: &Setup) -> Result<Machine, String> {
        let scaled = self.scene.machine.as_ref().ok_or("the scene has no machine")?;
        Ok(setup
            .setting
            .map_or_else(|| scaled.machine.clone(), |setting| setting.on(&scaled.machine)))
    }

    /// A motion of the machine with another number: from the same place in metres, with the same doubt in newtons.
    /// Fails with one line, where there is no machine, or none with that number.
    pub(in crate::session) fn with_quantity(
        &self,
        setup: &Setup,
        quantity: Quantity,
        value: f64,
    ) -> Result<Setup, String> {
        let value = quantity.check(value).map_err(|refused| refused.to_string())?;
        let was = self.set_machine(setup)?;
        let setting = setup.setting.unwrap_or(Setting::of_speed(was.belt.belt_speed));
        let setting = setting.with(quantity, value);
        let is = setting.on(&was);
        let running = Running::at(&was, was.belt.belt_speed)?;
        let other = Running::at(&is, setting.speed)?;
        let Setup { problem, others, doubt, .. } = *setup;
        let brought = |initial| running.brought_to(&other, Problem { initial, ..problem }).initial;
        let others = others.map(brought);
        let problem = running.brought_to(&other, problem);
        let doubt = doubt.brought_to(&running, &other);
        Ok(Setup { problem, others, setting: Some(setting), doubt })
    }
}
