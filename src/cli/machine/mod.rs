//! The machine that the command line names, the files that it comes from, and what is set in it.

pub mod input;

use std::path::Path;
use std::sync::Arc;

use super::failure::Failure;
use super::output::{Format, Output};
use super::timing::timed;
use crate::flow::Method;
use crate::flow::machine::stepped::ALLOWED;
use crate::model::unit::WithTolerance;
use crate::model::{Body, Group, Knob, MachineProblem, Tolerances};
use crate::portrait::{Portrait, Trouble};
use crate::report::belt::Head;
use crate::report::machine::MachineReport;
use crate::report::page::Source;
use crate::runtime::standard::tell;
use crate::runtime::{bounded, source_file};
use crate::scene::machine::file::parse;
use crate::scene::machine::library::{find, machines};
use crate::scene::machine::mode;
use crate::scene::machine::mode::{Mode, is_mode};
use crate::scene::machine::unlikely::unlikely;
use crate::scene::{Machine, ScaledMachine, Scene};

/// What the name on the command line refers to.
enum MachineOrMode {
    Belt(Machine),
    Mode(Mode),
}

/// The machine or mode in a file, or a built-in machine, and the files that were read.
fn named(name: &str) -> Result<(MachineOrMode, Vec<Source>), Failure> {
    let path = Path::new(name);
    // Read once: it may be a pipe.
    let text = match bounded::text(path) {
        Ok(text) => text,
        Err(error) => {
            let found = find(name).cloned().map(|machine| (MachineOrMode::Belt(machine), vec![]));
            return found.ok_or_else(|| {
                let known: Vec<&str> =
                    machines().iter().map(|machine| machine.name.as_str()).collect();
                Failure::Usage(format!(
                    "{name}: {error}; the machines of the program are {}",
                    known.join(", ")
                ))
            });
        }
    };
    let title = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    let refused = |error: &dyn std::fmt::Display| Failure::Usage(error.to_string());
    let mut sources = vec![source_file::of(path, text.as_bytes())];
    if is_mode(&text) {
        let mode = mode::parse(&title, name, &text).map_err(|error| refused(&error))?;
        return Ok((MachineOrMode::Mode(mode), sources));
    }
    let fetch = |table: &str| {
        let beside = path.with_file_name(table);
        let text = bounded::text(&beside).map_err(|why| format!("{}: {why}", beside.display()))?;
        sources.push(source_file::of(&beside, text.as_bytes()));
        Ok(text)
    };
    let machine = parse(&title, name, &text, fetch).map_err(|error| refused(&error))?;
    Ok((MachineOrMode::Belt(machine), sources))
}

/// The scene of a machine in a file or a built-in machine, for the explorer.
pub fn scene(name: &str) -> Result<Arc<Scene>, Failure> {
    let refused = |error: &dyn std::fmt::Display| Failure::Usage(format!("{name}: {error}"));
    let machine = match named(name)?.0 {
        MachineOrMode::Belt(machine) => machine,
        MachineOrMode::Mode(_) => return Err(refused(&mode::NO_BELT)),
    };
    let scaled = ScaledMachine::new(machine).map_err(|error| refused(&error))?;
    Ok(Arc::new(scaled.scene()))
}

/// A machine or mode, and the motion to compute.
pub struct MachineCase {
    pub name: String,
    pub title: String,
    pub problem: MachineProblem,
    /// The files that it was read from.
    pub sources: Vec<Source>,
    /// The machine as it was read; `None` for a mode.
    read: Option<Machine>,
}

impl MachineCase {
    /// The case that a file describes, or a built-in machine.
    pub fn named(name: &str) -> Result<Self, Failure> {
        let (found, sources) = named(name)?;
        Ok(match found {
            MachineOrMode::Belt(machine) => MachineCase {
                name: machine.name.clone(),
                title: machine.title.clone(),
                problem: MachineProblem {
                    subject: Body::Belt(Box::new(machine.belt.clone())).into(),
                    tolerances: machine.tolerances.clone(),
                    start: (machine.displacement, machine.velocity),
                    until: machine.until,
                },
                sources,
                read: Some(machine),
            },
            MachineOrMode::Mode(Mode { name, title, numbers, start, until }) => {
                let (subject, tolerances) = (Body::Mode(numbers).into(), Tolerances::default());
                let problem = MachineProblem { subject, tolerances, start, until };
                MachineCase { name, title, problem, sources, read: None }
            }
        })
    }

    /// The heading of an answer about it.
    pub fn head(&self) -> Head<'_> {
        Head::new(&self.name, &self.title, &self.problem.subject.body)
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
    pub fn scene(&self) -> Result<Option<Scene>, Failure> {
        let MachineProblem { subject, tolerances, start, .. } = &self.problem;
        let Some((read, belt)) = self.read.as_ref().zip(subject.of_belt()) else {
            return Ok(None);
        };
        let machine = Machine {
            belt: belt.clone(),
            tolerances: tolerances.clone(),
            displacement: start.0,
            velocity: start.1,
            ..read.clone()
        };
        let scaled = ScaledMachine::new(machine);
        let scaled = scaled.map_err(|why| Failure::Usage(format!("{}: {why}", self.name)))?;
        Ok(Some(scaled.scene()))
    }
}

/// Prints an answer about a machine.
pub fn print<R>(output: &Output, answer: MachineReport<R>) -> Result<(), Failure> {
    output.print(&match output.format {
        Format::Table => answer.table(),
        Format::Json => answer.json(),
        Format::Csv => answer.csv(),
    })
}

/// Why a machine has no answer; an error in the machine itself counts as bad input.
pub fn troubled(trouble: impl Into<Trouble>) -> Failure {
    let trouble: Trouble = trouble.into();
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
