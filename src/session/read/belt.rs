//! The belt of the machine on show: its speed, and whether the numbers on show are those of the machine.
//!
//! A speed of the belt stands for all of D, D2, D3 and r. To change one of these by hand leaves the
//! belt: the numbers are then those of no belt speed, until the speed is given again.

use crate::flow::Problem;
use crate::oscillator::belt::Quantity;
use crate::oscillator::{Belt, Parameters, State, Symbol};
use crate::question::Whole;
use crate::question::speeds::Speeds;
use crate::question::whole::{Course, Kinds};
use crate::scene::{Answer, Layer, Running, Topic};
use crate::session::state::session::Session;
use crate::session::state::setup::Setup;

impl Session {
    /// The motion on show and the speed of the belt.
    pub fn setup(&self) -> Setup {
        let Session { problem, others, belt_speed, doubt, .. } = *self;
        Setup { problem, others, belt_speed, doubt }
    }

    /// The machine of the scene at the present speed of its belt.
    pub fn running(&self) -> Option<Running<'_>> {
        let scaled = self.scene.machine.as_ref()?;
        let present = self.belt_speed.and_then(|speed| Running::at(&scaled.machine, speed).ok());
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
        match self.standing(topic, self.plot).answered()?.result.as_ref().ok()? {
            Answer::Whole(whole) => Some(whole),
            _ => None,
        }
    }

    /// The cycles over the speed of the belt that were computed last for a plot, stale or not.
    pub fn speeds(&self, plot: usize) -> Option<&Speeds> {
        match self.answer(Topic::Speeds, plot)? {
            Answer::Speeds(found) => Some(found),
            _ => None,
        }
    }

    /// Reads numbers out of some parameters.
    fn of_parameters(parameters: &Parameters) -> impl Fn(Symbol) -> f64 {
        let parameters = *parameters;
        move |symbol| symbol.get(&parameters, &State { q: 0.0, v: 0.0 })
    }

    /// A motion with the belt at another speed.
    ///
    /// # Errors
    /// One line, where there is no belt or no machine at that speed.
    pub(in crate::session) fn at_belt_speed(
        &self,
        setup: Setup,
        speed: f64,
    ) -> Result<Setup, String> {
        let running = self.running().ok_or("the scene is of no machine: it has no belt")?;
        let other = Running::at(running.machine, speed)?;
        let Setup { problem, others, doubt, .. } = setup;
        let brought = |initial| running.brought_to(&other, Problem { initial, ..problem }).initial;
        let others = others.map(brought);
        let problem = running.brought_to(&other, problem);
        let doubt = doubt.brought_to(&running, &other);
        Ok(Setup { problem, others, belt_speed: Some(speed), doubt })
    }
}
