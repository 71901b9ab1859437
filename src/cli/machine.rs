//! What the command line is about: the oscillator of the paper, or the machine that it names, with the files that this
//! comes from; and what is set in it.

use std::path::Path;
use std::sync::Arc;

use super::{Failure, Output, Result, timed};
use crate::flow::machine::stepped::ALLOWED;
use crate::flow::{Method, Problem, Reason, Subject};
use crate::model::{Body, Group, Knob, TolerancedNumber};
use crate::portrait::Portrait;
use crate::report::About;
use crate::report::page::SourceFile;
use crate::runtime::{bounded, provenance_file, tell};
use crate::scene::machine::Description;
use crate::scene::machine::file::parse;
use crate::scene::machine::library::{find, machines};
use crate::scene::machine::unlikely::unlikely;
use crate::scene::{Machine, ScaledMachine, Scene};
use crate::words::joined;

/// Why a mode takes no tolerances.
const UNCERTAIN_MODE: &str =
    "a mode takes no uncertainties and no --disturbance: its guaranteed margins are not computed";

/// What a command is about, and the motion to compute.
#[derive(Clone)]
pub struct CommandCase {
    pub described: Description,
    /// The files that it was read from.
    pub sources: Vec<SourceFile>,
}

impl From<Problem> for CommandCase {
    /// The oscillator of the paper, which has no name.
    fn from(problem: Problem) -> Self {
        let described = Description {
            name: String::new(),
            title: String::new(),
            watch: String::new(),
            subject: problem.into(),
        };
        CommandCase { described, sources: Vec::new() }
    }
}

impl CommandCase {
    /// The case that a file describes, or a built-in machine.
    pub fn named(name: &str) -> Result<Self> {
        let path = Path::new(name);
        // Read once: it may be a pipe.
        let text = bounded::text(path);
        if let (Err(_), Ok(machine)) = (&text, find(name)) {
            return Ok(CommandCase { described: machine.described(), sources: Vec::new() });
        }
        let text = text.map_err(|error| {
            let known = joined(machines().iter().map(|machine| &machine.name), ", ");
            format!("{error}; the machines of the program are {known}")
        })?;
        let title = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
        let mut sources = vec![provenance_file::source(path, text.as_bytes())];
        let fetch = |table: &str| {
            let beside = path.with_file_name(table);
            let text = bounded::text(&beside).map_err(|why| why.to_string())?;
            sources.push(provenance_file::source(&beside, text.as_bytes()));
            Ok(text)
        };
        let described = parse(&title, name, &text, fetch).map_err(|error| error.to_string())?;
        Ok(CommandCase { described, sources })
    }

    /// The case that a text describes, which names no other files.
    pub fn written(name: &str, text: &str) -> Result<Self> {
        let none = |_: &str| Err("a text has no files beside it".to_owned());
        let described = parse(name, name, text, none).map_err(|error| error.to_string())?;
        Ok(CommandCase { described, sources: Vec::new() })
    }

    /// What an answer is about.
    pub fn about(&self) -> About {
        let Description { name, title, subject, .. } = &self.described;
        About::new(name, title, &subject.source)
    }

    /// All of its motions, and the median time to find them; of the oscillator of the paper a border that is not closed is
    /// followed as far as `reach`.
    pub fn portrait(&self, output: &Output, reach: f64) -> Result<(Portrait, f64)> {
        let subject = &self.described.subject;
        if let Some(Problem { parameters, .. }) = subject.paper() {
            let find = || Portrait::of_oscillator(&parameters, reach, &output.limits());
            return output.timed("the basin could not be found", find);
        }
        let (found, seconds) = timed(output.repeat, || subject.source.portrait());
        Ok((found.map_err(troubled)?, seconds))
    }

    /// Sets numbers, each with or without a tolerance.
    pub fn set(&mut self, set: &[(Knob, TolerancedNumber)]) -> Result<()> {
        for &(knob, TolerancedNumber { middle, half_width, .. }) in set {
            self.described.subject.set(knob, middle.value)?;
            if knob.spec().group != Group::Course {
                self.described.subject.tolerances.half_widths.insert(knob.to_string(), half_width);
            }
        }
        Ok(())
    }

    /// The same if its tolerances are within their ranges; warns of numbers that are hardly those of a machine.
    pub fn checked(self) -> Result<Self> {
        let Subject { source, tolerances, .. } = &self.described.subject;
        match &source.body {
            Body::Belt(belt) => tolerances.check(belt)?,
            Body::Mode(_) if !tolerances.is_none() => return Err(UNCERTAIN_MODE.into()),
            Body::Paper(_) | Body::Mode(_) => {}
        }
        if let Some(line) = unlikely(&source.body, self.described.subject.start()) {
            tell(format!("warning: {line}"));
        }
        Ok(self)
    }

    /// The scene of the machine with its present numbers; `None` for a mode.
    pub fn scene(&self) -> Result<Option<Arc<Scene>>> {
        let Ok(machine) = Machine::try_from(self.described.clone()) else { return Ok(None) };
        let refused = |why| format!("{}: {why}", self.described.name);
        let scaled = ScaledMachine::try_from(machine).map_err(refused)?;
        Ok(Some(Arc::new(scaled.scene())))
    }
}

/// Why a machine has no answer; an error in the machine itself counts as bad input.
pub fn troubled(trouble: Reason) -> Failure {
    if trouble.is_of_the_machine() {
        trouble.to_string().into()
    } else {
        Failure::unanswered("the machine could not be computed", trouble)
    }
}

/// The method that follows a motion in place of Taylor series, if one is asked for.
pub fn second(method: Option<Method>) -> Result<Option<Method>> {
    match method {
        None | Some(Method::Auto | Method::Taylor) => Ok(None),
        Some(method) if method.follows_machines() => Ok(Some(method)),
        Some(method) => Err(format!(
            "--method {method} knows one switching line only; a machine has two: allowed are {ALLOWED}"
        )
        .into()),
    }
}
