//! What a command is about: the motion of a scene, with its method and what sets its accuracy, or a machine.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use clap::Args;

use super::input::{self, MACHINE, Numbers, OSCILLATOR};
use super::study::{self, file_of, scene_named};
use super::{CommandCase, Output, Result, read, second};
use crate::flow::{METHODS, Method};
use crate::model::{Knob, ParameterBox, TolerancedNumber};
use crate::runtime::tell;
use crate::scene::machine::library;
use crate::scene::{PLAIN, Scene, find};
use crate::words::joined;

/// What every question is about, and how its answer is printed.
#[derive(Args)]
pub struct QuestionOptions {
    #[command(flatten)]
    pub source: SourceOptions,
    #[command(flatten)]
    pub output: Output,
}

/// What a command is about: the motion of a scene, or a machine.
#[derive(Clone, Args)]
pub struct SourceOptions {
    /// Scene that sets what the options leave open, by its name or file, or the name of a built-in machine (see
    /// hopfscope belt)
    #[arg(value_name = "SCENE", conflicts_with_all = ["scene", "machine"])]
    pub named: Option<String>,
    #[command(flatten)]
    pub start: StartOptions,
    /// Asks about a machine in place of a scene: a file, or the name of a built-in one (see hopfscope belt). All numbers
    /// are then its own, such as --set "R=2 N", with a unit or in SI units
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scene", "step", "epsilon"])]
    machine: Option<String>,
    /// The machine of a caller in this process.
    #[arg(skip)]
    pub case: Option<CommandCase>,
    /// The scene, once it has been read.
    #[arg(skip)]
    found: OnceLock<Arc<Scene>>,
}

impl SourceOptions {
    /// The numbers by which the other options are read. Fails if the file of the scene is wrong.
    pub fn numbers(&self) -> Result<&'static Numbers> {
        let named = self.case.is_some() || self.machine_name().is_some();
        let is_machine = named || self.study_of_machine()?.is_some();
        Ok(if is_machine { &MACHINE } else { &OSCILLATOR })
    }

    /// The machine to which a question about all motions is put, if it is about one. These are followed by Taylor series
    /// alone.
    pub fn portrayed(&self) -> Result<Option<CommandCase>> {
        let Some(case) = self.machine()? else {
            if self.start.method.is_some() {
                tell("note: cycles are always followed by one method; --method is ignored");
            }
            return Ok(None);
        };
        if second(self.start.method)?.is_some() {
            let line =
                "all motions of a machine are followed by Taylor series: --method auto or taylor";
            return Err(line.into());
        }
        Ok(Some(case.checked()?))
    }

    /// What a question about all motions that takes no intervals is put to.
    pub fn exact(&self) -> Result<CommandCase> {
        self.portrayed()?.map_or_else(|| self.case(), Ok)
    }

    /// The motion of the scene, or the machine, with the values set on the command line.
    pub fn case(&self) -> Result<CommandCase> {
        self.machine()?.map_or_else(|| Ok(self.scene()?.problem.into()), Ok)
    }

    /// The scene with the values set on the command line.
    pub fn scene(&self) -> Result<Arc<Scene>> {
        self.start.applied(self.found()?)
    }

    /// The scene as it is named.
    pub fn found(&self) -> Result<Arc<Scene>> {
        if let Some(found) = self.found.get() {
            return Ok(Arc::clone(found));
        }
        let found = self.start.found(self.named.as_deref())?;
        Ok(Arc::clone(self.found.get_or_init(|| found)))
    }

    /// The file of the scene, if it is one of the user.
    pub fn file(&self) -> Option<&Path> {
        self.named.as_deref().or(self.start.scene.as_deref()).and_then(file_of)
    }

    /// The parameters, each as the interval in which it was given.
    pub fn known(&self) -> Result<ParameterBox> {
        let mut known = ParameterBox::from(&self.found()?.problem.parameters);
        for (symbol, value) in self.start.assigned(&OSCILLATOR)? {
            if symbol.is_parameter() {
                known.set(symbol, value.ends)?;
            }
        }
        Ok(known)
    }

    /// The machine that is named, also where a scene would stand.
    pub fn machine_name(&self) -> Option<&String> {
        let is_machine = |name: &&String| find(name).is_err() && library::find(name).is_ok();
        self.machine.as_ref().or(self.named.as_ref().filter(is_machine))
    }

    /// The scene of the user that is named, if it is about a machine.
    fn study_of_machine(&self) -> Result<Option<Arc<Scene>>> {
        let scene = self.file().map(|_| self.found()).transpose()?;
        Ok(scene.filter(|scene| scene.machine.is_some()))
    }

    /// The machine with the values set on the command line, if it is about one.
    pub fn machine(&self) -> Result<Option<CommandCase>> {
        let case = match (&self.case, self.machine_name()) {
            (Some(case), _) => Some(case.clone()),
            (None, Some(name)) => Some(CommandCase::named(name)?),
            (None, None) => self.study_of_machine()?.and_then(study::machine),
        };
        let Some(mut case) = case else { return Ok(None) };
        case.set(&self.start.assigned(&MACHINE)?)?;
        case.described.subject.source.tolerance = self.start.tol;
        Ok(Some(case))
    }
}

/// Which motion is meant.
#[derive(Clone, Args)]
pub struct StartOptions {
    /// Scene that sets what the other options leave open: its name or file
    #[arg(long = "scene", value_name = "NAME")]
    pub scene: Option<String>,

    /// What is set is read when it is known of what.
    #[arg(long, value_name = "NAME=VALUE", help = parameters_help())]
    pub set: Vec<String>,

    #[arg(long, value_name = "NAME", value_parser = input::method, help = methods_help())]
    pub method: Option<Method>,

    /// Relative error per step, 1e-15 .. 0.01
    #[arg(long, value_name = "X", value_parser = input::tolerance)]
    pub tol: Option<f64>,

    /// Step length of the fixed-step methods, 1e-7 .. 1
    #[arg(long, value_name = "H", value_parser = |text: &str| Knob::Step.parse(text))]
    step: Option<f64>,

    /// Velocity scale over which the method `smoothed` smooths friction, 1e-12 .. 1e6
    #[arg(long, value_name = "E", value_parser = |text: &str| Knob::Epsilon.parse(text))]
    epsilon: Option<f64>,
}

fn parameters_help() -> String {
    let names = Knob::MOTION.map(|knob| format!("{knob} ({})", knob.spec().meaning));
    format!("Sets a parameter or start value; repeatable: {}", joined(names, ", "))
}

fn methods_help() -> String {
    format!("Integration method: {}", joined(METHODS.iter().map(|row| row.name), ", "))
}

impl StartOptions {
    /// The scene with this name, or of the option, with the values set on the command line.
    pub fn scene(&self, named: Option<&str>) -> Result<Arc<Scene>> {
        self.applied(self.found(named)?)
    }

    /// Whether anything is chosen.
    pub fn asks(&self) -> bool {
        let accuracy = [self.tol, self.step, self.epsilon];
        let chosen = self.scene.is_some() || self.method.is_some() || !self.set.is_empty();
        chosen || accuracy.iter().any(Option::is_some)
    }

    /// The numbers that are set.
    fn assigned(&self, numbers: &Numbers) -> Result<Vec<(Knob, TolerancedNumber)>> {
        let one = |text: &String| read("--set", text, |text| numbers.assignment(text));
        self.set.iter().map(one).collect()
    }

    /// A scene with the values set on the command line; a parameter set there is part of the scene.
    pub fn applied(&self, mut scene: Arc<Scene>) -> Result<Arc<Scene>> {
        let Scene { problem, terms, .. } = Arc::make_mut(&mut scene);
        for (symbol, value) in self.assigned(&OSCILLATOR)? {
            if !value.ends.is_point() {
                let why = "only cycles and margin take an interval; this command takes a number";
                return Err(format!("{symbol}: {why}").into());
            }
            problem.set(symbol, value.middle.value);
            if symbol.is_parameter() {
                terms.insert(symbol);
            }
        }
        problem.method = self.method.unwrap_or(problem.method);
        problem.tolerance = self.tol.unwrap_or(problem.tolerance);
        problem.step = self.step.unwrap_or(problem.step);
        problem.epsilon = self.epsilon.unwrap_or(problem.epsilon);
        Ok(scene)
    }

    fn found(&self, named: Option<&str>) -> Result<Arc<Scene>> {
        scene_named(named.or(self.scene.as_deref()).unwrap_or(PLAIN))
    }
}
