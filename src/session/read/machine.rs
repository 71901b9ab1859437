//! The machine on show: the speed of its belt, its other numbers, and whether the parameters on show are its
//! own; and the questions about certainty, for all parameters within their half widths and all bounded disturbances.
//!
//! A speed of the belt determines all of D, D2, D3 and r. Changing one of these by hand leaves the belt: the
//! parameters then belong to no belt speed until a speed is set again.

use crate::fit::FitResult;
use crate::flow::{Problem, Subject};
use crate::model::{Belt, Body, Knob, Parameters, Source, State, Tolerances, Units};
use crate::portrait::Margin;
use crate::scene::machine::unlikely::unlikely;
use crate::scene::{Layer, ScaledMachine, Setting, Topic, View};
use crate::session::{Done, ON_A_MACHINE, Session, Setup};

/// The margins of a machine, without units.
#[derive(Clone, Copy, Debug)]
pub struct MachineMargins {
    /// By its whole model.
    pub whole: Margin,
    /// By its cubic expansion.
    pub cubic: Margin,
}

impl Session {
    /// The machine of the scene with its present setting.
    pub fn running(&self) -> Option<&ScaledMachine> {
        self.scaled.as_deref()
    }

    /// The motion on show and what moves, by the model that is drawn.
    pub fn subject(&self) -> Subject {
        let Problem { parameters, initial: State { q, v }, until, .. } = self.problem;
        let (source, units) = self.source(&parameters);
        let initial = State { q: q * units.displacement, v: v * units.velocity };
        let motion = Problem { initial, until: until * units.time, ..self.problem };
        Subject { source, tolerances: Tolerances::default(), motion }
    }

    /// One line about a number of the machine that is unlikely in its unit; `None` if there is none.
    pub fn unlikely_number(&self) -> Option<String> {
        let machine = &self.running()?.machine;
        let body = Body::Belt(Box::new(machine.belt.clone()));
        unlikely(&body, (machine.displacement, machine.velocity))
    }

    /// Whether the parameters on show are those of the machine at the speed of its belt, to the last bit; `None` without
    /// a machine.
    pub fn is_on_the_belt(&self) -> Option<bool> {
        Some(self.running()?.reduced.parameters == self.problem.parameters)
    }

    /// The machine on show, if the whole model can answer for it: D, D3 and r that were changed by hand
    /// correspond to the dampers and the guide, but D2 corresponds to no part.
    pub fn machine(&self) -> Option<Belt> {
        let running = self.running()?;
        let mut belt = running.machine.belt.clone();
        let (own, now) = (running.reduced.parameters, self.problem.parameters);
        if own == now {
            return Some(belt);
        }
        if own.d2 != now.d2 {
            return None;
        }
        for (symbol, quantity) in ON_A_MACHINE {
            let value = now.value(symbol);
            if own.value(symbol) != value {
                quantity.set_in_belt(&mut belt, running.meaning(symbol, value)?.1).ok()?;
            }
        }
        let moving = belt.friction;
        belt.static_guide = belt.static_guide.map(|at_rest| at_rest.max(moving));
        Some(belt)
    }

    /// What D, D3 and r that were changed by hand make of the dampers and the guide of the machine on show.
    pub(crate) fn changed_by_hand(&self) -> Vec<(Knob, f64)> {
        let now = self.running().zip(self.machine());
        let changed = |(_, knob): (Knob, Knob)| {
            let (running, now) = now.as_ref()?;
            let value = knob.of_belt(now)?;
            (knob.of_belt(&running.machine.belt) != Some(value)).then_some((knob, value))
        };
        ON_A_MACHINE.into_iter().filter_map(changed).collect()
    }

    /// Whether the whole model is drawn: the layer is on, and the model can answer for the machine of the
    /// scene.
    pub fn draws_whole(&self) -> bool {
        self.layers.contains(&Layer::Whole) && self.machine().is_some()
    }

    /// The margins of the machine; `None` while they are not known.
    pub fn machine_margins(&self) -> Option<MachineMargins> {
        let (found, other) = self.answer(Topic::Cycles, self.plot)?.try_as_cycles_ref()?;
        let (drawn, other) = (found.margin, (*other)?);
        let (whole, cubic) = if self.draws_whole() {
            (drawn, other)
        } else {
            (other, drawn)
        };
        Some(MachineMargins { whole, cubic })
    }

    /// The unit of r and w, in newtons. Fails with one line if there is no machine and no record with a known
    /// mass.
    pub(crate) fn unit_of_force(&self, setup: &Setup) -> Done<f64> {
        match self.fitted().and_then(FitResult::units) {
            Some(units) if units.force.is_finite() => Ok(units.force),
            Some(_) => {
                Err("no mass is known: :fit FILE mass=2 kg, or stiffness=800 N/m".to_owned())
            }
            None => Ok(self.machine_of(setup)?.reduced.units.force),
        }
    }

    /// The machine of the scene with the setting of `setup`. Fails with one line if the scene has no machine, or is
    /// none with that setting.
    pub(crate) fn machine_of(&self, setup: &Setup) -> Done<ScaledMachine> {
        let scaled = self.scene.machine.as_ref().ok_or("the scene has no machine")?;
        match &setup.setting {
            Some(setting) => setting.on(&scaled.machine),
            None => Ok(ScaledMachine::clone(scaled)),
        }
    }

    /// The setup with another value of a number; one of the machine leaves the start in metres and the
    /// disturbance in newtons. Fails with one line if the number is outside its range, or there is no machine.
    pub(crate) fn with(&self, setup: &Setup, knob: Knob, value: f64) -> Done<Setup> {
        let value = knob.check(value)?;
        let mut changed = setup.clone();
        match knob {
            Knob::Disturbance => changed.doubt.disturbance = value,
            _ if knob.is_of_machine() => return self.rebuilt(setup, knob, value),
            _ => changed.problem.set(knob, value),
        }
        Ok(changed)
    }

    fn rebuilt(&self, setup: &Setup, knob: Knob, value: f64) -> Done<Setup> {
        let from = self.machine_of(setup)?;
        let mut setup = setup.clone();
        let own = || Setting::of_speed(from.machine.belt.belt_speed);
        setup.setting = Some(setup.setting.unwrap_or_else(own).with(knob, value));
        let to = self.machine_of(&setup)?;
        let Setup { problem, others, doubt, .. } = &mut setup;
        for start in others {
            *start = from.brought_to(&to, Problem { initial: *start, ..*problem }).initial;
        }
        *problem = from.brought_to(&to, *problem);
        *doubt = doubt.brought_to(&from, &to);
        Ok(setup)
    }

    /// Whether something is uncertain, or a layer shows what is certain.
    pub(crate) fn asks_for_certainty(&self) -> bool {
        let asks = |layer| self.layers.contains(layer);
        !self.doubt.is_certain() || [Layer::Safe, Layer::Lost].iter().any(asks)
    }

    /// Whether a plot states guaranteed margins: something is uncertain, or a layer asks for them.
    pub fn tells_certain(&self, plot: usize) -> bool {
        self.plots[plot].view == View::Phase && self.asks_for_certainty()
    }

    /// What moves by the model that is drawn, at these parameters, and the units of its numbers.
    pub(crate) fn source(&self, parameters: &Parameters) -> (Source, Units) {
        match self.running().zip(self.machine()).filter(|_| self.draws_whole()) {
            Some((running, belt)) => (Source::from(&belt), running.reduced.units),
            None => (Body::Paper(*parameters).into(), Units::SI),
        }
    }
}
