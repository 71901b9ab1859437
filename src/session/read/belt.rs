//! The machine on show: the speed of its belt, its other numbers, and whether the parameters on show are its
//! own.
//!
//! A speed of the belt determines all of D, D2, D3 and r. Changing one of these by hand leaves the belt: the
//! parameters then belong to no belt speed until a speed is set again.

use crate::flow::Problem;
use crate::model::{Belt, Body, Knob, Parameters, State};
use crate::question::Whole;
use crate::question::whole::{Course, WholeCycles};
use crate::scene::machine::unlikely::unlikely;
use crate::scene::{Answer, Layer, Machine, Running, Setting, Topic};
use crate::session::state::uncertainty::{ON_A_MACHINE, symbol_of};
use crate::session::state::{Session, Setup, Uncertainty};

impl Session {
    /// The machine of the scene with its present setting.
    pub fn running(&self) -> Option<Running<'_>> {
        let scaled = self.scene.machine.as_ref()?;
        let machine = self.rebuilt.as_deref().unwrap_or(&scaled.machine);
        let present = self.setting.and_then(|it| Running::at(machine, it.speed).ok());
        Some(present.unwrap_or_else(|| scaled.running()))
    }

    /// One line about a number of the machine that is unlikely in its unit; `None` if there is none.
    pub fn unlikely_number(&self) -> Option<String> {
        let Running { machine, speed, .. } = self.running()?;
        let belt = Belt { belt_speed: speed, ..machine.belt.clone() };
        unlikely(&Body::Belt(Box::new(belt)), (machine.displacement, machine.velocity))
    }

    /// Whether the parameters on show are those of the machine at the speed of its belt; `None` without a
    /// machine.
    pub fn is_on_the_belt(&self) -> Option<bool> {
        Some(self.running()?.carries(&self.problem.parameters))
    }

    /// The machine on show, if the whole model can answer for it: D, D3 and r that were changed by hand
    /// correspond to the dampers and the guide, but D2 corresponds to no part.
    pub fn machine(&self) -> Option<Belt> {
        let running = self.running()?;
        let mut belt = Belt { belt_speed: running.speed, ..running.machine.belt.clone() };
        if running.carries(&self.problem.parameters) {
            return Some(belt);
        }
        let own = Session::of_parameters(&running.reduced.parameters);
        if own(Knob::D2) != self.value(Knob::D2) {
            return None;
        }
        for (symbol, quantity) in ON_A_MACHINE {
            let value = self.value(symbol);
            if own(symbol) != value {
                quantity.set_in_belt(&mut belt, running.meaning(symbol, value)?.1).ok()?;
            }
        }
        let moving = belt.friction;
        belt.static_guide = belt.static_guide.map(|at_rest| at_rest.max(moving));
        Some(belt)
    }

    /// Whether the whole model is drawn: the layer is on, and the model can answer for the machine of the
    /// scene.
    pub fn draws_whole(&self) -> bool {
        self.layers.contains(&Layer::Whole) && self.machine().is_some()
    }

    /// The whole model's answer about the motion on show; `None` while it is not drawn or not known.
    pub fn course(&self) -> Option<&Course> {
        self.whole(Topic::Trajectory)?.motion.as_ref()
    }

    /// The whole model's answer about the cycles; `None` while it is not known.
    pub fn kinds(&self) -> Option<&WholeCycles> {
        self.whole(Topic::Cycles)?.cycles.as_ref()
    }

    fn whole(&self, topic: Topic) -> Option<&Whole> {
        let found = self.standing(topic, self.plot).answered()?.result.as_ref().ok()?;
        let Answer::Whole(whole) = found else { return None };
        Some(whole)
    }

    /// A function that reads these parameters.
    fn of_parameters(parameters: &Parameters) -> impl Fn(Knob) -> f64 {
        let parameters = *parameters;
        move |symbol| symbol.get(&parameters, &State { q: 0.0, v: 0.0 })
    }

    /// The uncertainty of `setup` with another half width of a parameter, or tolerance of a number of the
    /// machine, in SI units. Fails with one line if no parameter corresponds to that number.
    pub(in crate::session) fn with_tolerance(
        &self,
        setup: &Setup,
        knob: Knob,
        half_width: f64,
    ) -> Result<Uncertainty, String> {
        if !knob.is_of_machine() {
            return setup.doubt.with_half_width(knob, half_width);
        }
        let symbol = symbol_of(knob).ok_or_else(|| {
            format!(
                "{knob} has no tolerance here; R, d1 and d3 have, all of them in a machine's file"
            )
        })?;
        let machine = self.set_machine(setup)?;
        let running = Running::at(&machine, machine.belt.belt_speed)?;
        setup.doubt.with_half_width(symbol, half_width / running.scale(symbol))
    }

    /// The unit of r and w, in newtons. Fails with one line if there is no machine and no record with a known
    /// mass.
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

    /// The machine of the scene with the setting of `setup`. Fails with one line if the scene has no machine.
    fn set_machine(&self, setup: &Setup) -> Result<Machine, String> {
        let scaled = self.scene.machine.as_ref().ok_or("the scene has no machine")?;
        let own = || Ok(scaled.machine.clone());
        setup.setting.map_or_else(own, |setting| setting.on(&scaled.machine))
    }

    /// The setup with another value of a number; one of the machine leaves the start in metres and the
    /// disturbance in newtons. Fails with one line if the number is outside its range, or there is no machine.
    pub(in crate::session) fn with(
        &self,
        setup: &Setup,
        knob: Knob,
        value: f64,
    ) -> Result<Setup, String> {
        let value = knob.check(value)?;
        let mut changed = *setup;
        match knob {
            Knob::Disturbance => changed.doubt.disturbance = value,
            _ if knob.is_of_machine() => return self.rebuilt(setup, knob, value),
            _ => changed.problem.set(knob, value),
        }
        Ok(changed)
    }

    fn rebuilt(&self, setup: &Setup, knob: Knob, value: f64) -> Result<Setup, String> {
        let was = self.set_machine(setup)?;
        let setting = setup.setting.unwrap_or(Setting::of_speed(was.belt.belt_speed));
        let setting = setting.with(knob, value);
        let is = self.set_machine(&Setup { setting: Some(setting), ..*setup })?;
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
