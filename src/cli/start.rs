//! The options that define a motion: scene, parameters, method, and what sets its accuracy.

use std::sync::Arc;

use clap::Args;

use super::failure::Failure;
use super::input::{self, read};
use crate::flow::{METHODS, Method, Problem};
use crate::model::{Interval, Knob, ParameterBox};
use crate::runtime::standard::tell;
use crate::scene::library::PLAIN;
use crate::scene::{Scene, find};

/// Which motion is meant.
#[derive(Clone, Debug, Args)]
pub struct StartOptions {
    /// Scene that sets what the other options leave open
    #[arg(long = "scene", value_name = "NAME")]
    pub scene: Option<String>,

    /// What is set is read when it is known of what.
    #[arg(long, value_name = "NAME=VALUE", help = parameters_help(), allow_hyphen_values = true)]
    pub set: Vec<String>,

    #[arg(long, value_name = "NAME", value_parser = input::method, help = methods_help())]
    pub method: Option<Method>,

    /// Relative error per step, 1e-15 .. 0.01
    #[arg(long, value_name = "X", value_parser = input::tolerance, allow_hyphen_values = true)]
    pub tol: Option<f64>,

    /// Step length of the fixed-step methods, 1e-7 .. 1
    #[arg(long, value_name = "H", value_parser = |text: &str| Knob::Step.parse(text), allow_hyphen_values = true)]
    step: Option<f64>,

    /// Velocity scale over which the method `smoothed` smooths friction, 1e-12 .. 1e6
    #[arg(long, value_name = "E", value_parser = |text: &str| Knob::Epsilon.parse(text), allow_hyphen_values = true)]
    epsilon: Option<f64>,
}

fn parameters_help() -> String {
    let names = Knob::MOTION.map(|knob| format!("{knob} ({})", knob.spec().meaning));
    format!("Sets a parameter or start value; repeatable: {}", names.join(", "))
}

fn methods_help() -> String {
    let names: Vec<_> = METHODS.iter().map(|row| row.name).collect();
    format!("Integration method: {}", names.join(", "))
}

impl StartOptions {
    /// The scene with the values set on the command line; a parameter set there is part of the scene.
    pub fn scene(&self) -> Result<Arc<Scene>, Failure> {
        self.scene_named(self.scene.as_deref().unwrap_or(PLAIN))
    }

    /// The same for the scene with this name.
    pub fn scene_named(&self, name: &str) -> Result<Arc<Scene>, Failure> {
        let scene = find(name).map_err(Failure::Usage)?;
        if let Some((symbol, _)) = self.assigned()?.iter().find(|(_, value)| !value.is_point()) {
            let line = format!(
                "{symbol}: only cycles and margin take an interval; this command takes a number"
            );
            return Err(Failure::Usage(line));
        }
        self.applied(scene)
    }

    /// The numbers that are set.
    fn assigned(&self) -> Result<Vec<(Knob, Interval)>, Failure> {
        self.set.iter().map(|text| read("--set", text, input::assigned)).collect()
    }

    /// A scene with the values set on the command line.
    pub fn applied(&self, mut scene: Arc<Scene>) -> Result<Arc<Scene>, Failure> {
        let dials = [self.tol, self.step, self.epsilon];
        if self.set.is_empty() && self.method.is_none() && dials.iter().all(Option::is_none) {
            return Ok(scene);
        }
        let changed = Arc::make_mut(&mut scene);
        let Problem { parameters, initial, .. } = &mut changed.problem;
        for (symbol, value) in self.assigned()? {
            symbol.set(parameters, initial, value.middle());
            if symbol.is_parameter() {
                changed.terms.insert(symbol);
            }
        }
        changed.problem.method = self.method.unwrap_or(changed.problem.method);
        changed.problem.tolerance = self.tol.unwrap_or(changed.problem.tolerance);
        changed.problem.step = self.step.unwrap_or(changed.problem.step);
        changed.problem.epsilon = self.epsilon.unwrap_or(changed.problem.epsilon);
        Ok(scene)
    }

    /// The parameters, each as the interval in which it was given.
    pub fn known(&self) -> Result<ParameterBox, Failure> {
        let name = self.scene.as_deref().unwrap_or(PLAIN);
        let scene = find(name).map_err(Failure::Usage)?;
        let mut known = ParameterBox::from(&scene.problem.parameters);
        for (symbol, interval) in self.assigned()? {
            if symbol.is_parameter() {
                known.set(symbol, interval).map_err(Failure::Usage)?;
            }
        }
        Ok(known)
    }

    /// The motion of the scene with the values set on the command line.
    pub fn problem(&self) -> Result<Problem, Failure> {
        Ok(self.scene()?.problem)
    }

    /// Notes on standard error that studies of cycles ignore `--method`, if that option was given.
    pub fn note_own_method(&self) {
        if self.method.is_some() {
            tell("note: cycles are always followed by one method; --method is ignored");
        }
    }
}
