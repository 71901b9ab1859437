//! The machine that the command line names, the files that it comes from, and what is set in it.

use std::path::Path;
use std::sync::Arc;

use super::{Failure, Output, timed};
use crate::flow::machine::stepped::ALLOWED;
use crate::flow::{Method, Reason};
use crate::model::unit::WithTolerance;
use crate::model::{Group, Knob, MachineProblem};
use crate::portrait::Portrait;
use crate::report::About;
use crate::report::page::SourceFile;
use crate::runtime::standard::tell;
use crate::runtime::{bounded, source_file};
use crate::scene::machine::Description;
use crate::scene::machine::file::parse;
use crate::scene::machine::library::{find, machines};
use crate::scene::machine::unlikely::unlikely;
use crate::scene::{Machine, ScaledMachine, Scene};

/// The machine or mode in a file, or a built-in machine, and the files that were read.
fn named(name: &str) -> Result<(Description, Vec<SourceFile>), Failure> {
    let path = Path::new(name);
    // Read once: it may be a pipe.
    let text = match bounded::text(path) {
        Ok(text) => text,
        Err(error) => {
            let found = find(name).map(Machine::described);
            return found.map(|described| (described, vec![])).map_err(|_| {
                let known: Vec<&str> =
                    machines().iter().map(|machine| machine.name.as_str()).collect();
                Failure::Usage(format!(
                    "{error}; the machines of the program are {}",
                    known.join(", ")
                ))
            });
        }
    };
    let title = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    let mut sources = vec![source_file::of(path, text.as_bytes())];
    let fetch = |table: &str| {
        let beside = path.with_file_name(table);
        let text = bounded::text(&beside).map_err(|why| why.to_string())?;
        sources.push(source_file::of(&beside, text.as_bytes()));
        Ok(text)
    };
    let described = parse(&title, name, &text, fetch);
    Ok((described.map_err(|error| Failure::Usage(error.to_string()))?, sources))
}

/// A machine or mode, and the motion to compute.
pub struct MachineCase {
    pub name: String,
    pub title: String,
    pub problem: MachineProblem,
    /// The files that it was read from.
    pub sources: Vec<SourceFile>,
    /// What its file says of it.
    watch: String,
}

impl MachineCase {
    /// The case that a file describes, or a built-in machine.
    pub fn named(name: &str) -> Result<Self, Failure> {
        let (Description { name, title, watch, problem }, sources) = named(name)?;
        Ok(MachineCase { name, title, problem, sources, watch })
    }

    /// What an answer is about.
    pub fn about(&self) -> About {
        About::machine(&self.name, &self.title, &self.problem.subject)
    }

    /// All of its motions, and the median time to find them.
    pub fn portrait(&self, output: &Output) -> Result<(Portrait, f64), Failure> {
        let (found, seconds) = timed(output.repeat, || self.problem.subject.portrait());
        Ok((found.map_err(troubled)?, seconds))
    }

    /// Sets numbers, each with or without a tolerance.
    pub fn set(&mut self, set: &[(Knob, WithTolerance)]) -> Result<(), Failure> {
        for &(knob, WithTolerance { middle, half_width, .. }) in set {
            self.problem.set(knob, middle.value).map_err(Failure::Usage)?;
            if knob.spec().group != Group::Course {
                self.problem.tolerances.half_widths.insert(knob.to_string(), half_width);
            }
        }
        Ok(())
    }

    /// The same if its tolerances are within their ranges; warns of numbers that are hardly those of a machine.
    pub fn checked(self) -> Result<Self, Failure> {
        let MachineProblem { subject, tolerances, start, .. } = &self.problem;
        let checked = match subject.of_belt() {
            Some(belt) => tolerances.check(belt),
            None if tolerances.is_none() => Ok(()),
            None => {
                Err("a mode takes no tolerances and no --disturbance: its guaranteed margins are \
                         not computed"
                    .to_owned())
            }
        };
        checked.map_err(Failure::Usage)?;
        if let Some(line) = unlikely(&subject.body, *start) {
            tell(format!("warning: {line}"));
        }
        Ok(self)
    }

    /// The scene of the machine with its present numbers; `None` for a mode.
    pub fn scene(&self) -> Result<Option<Arc<Scene>>, Failure> {
        let (name, title, watch) = (self.name.clone(), self.title.clone(), self.watch.clone());
        let described = Description { name, title, watch, problem: self.problem.clone() };
        let Ok(machine) = Machine::try_from(described) else { return Ok(None) };
        let scaled = ScaledMachine::new(machine);
        let scaled = scaled.map_err(|why| Failure::Usage(format!("{}: {why}", self.name)))?;
        Ok(Some(Arc::new(scaled.scene())))
    }
}

/// Why a machine has no answer; an error in the machine itself counts as bad input.
pub fn troubled(trouble: Reason) -> Failure {
    let line = format!("the machine could not be computed: {trouble}");
    if trouble.is_of_the_machine() {
        Failure::Usage(trouble.to_string())
    } else {
        Failure::Unanswered(line)
    }
}

/// The method that follows a motion in place of Taylor series, if one is asked for.
pub fn second(method: Option<Method>) -> Result<Option<Method>, Failure> {
    match method {
        None | Some(Method::Auto | Method::Taylor) => Ok(None),
        Some(method) if method.follows_machines() => Ok(Some(method)),
        Some(method) => Err(Failure::Usage(format!(
            "--method {method} knows one switching line only; a machine has two: allowed are {ALLOWED}"
        ))),
    }
}
