//! The machine that the command line names, and the files that it comes from.

use std::path::Path;
use std::sync::Arc;

use crate::cli::failure::Failure;
use crate::machine::{Body, Subject, Tolerances};
use crate::report::page::Source;
use crate::runtime::{bounded, source_file};
use crate::scene::machine::file::parse;
use crate::scene::machine::library::{find, machines};
use crate::scene::machine::mode::{self, Mode, is_mode};
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
    pub subject: Subject,
    pub tolerances: Tolerances,
    /// Displacement (m) and velocity (m/s) at the start.
    pub start: (f64, f64),
    /// How long the motion is followed, in s.
    pub until: f64,
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
                subject: Body::Belt(Box::new(machine.belt.clone())).into(),
                tolerances: machine.tolerances.clone(),
                start: (machine.displacement, machine.velocity),
                until: machine.until,
                sources,
                read: Some(machine),
            },
            MachineOrMode::Mode(Mode { name, title, numbers, start, until }) => {
                let (subject, tolerances) = (Body::Mode(numbers).into(), Tolerances::default());
                MachineCase { name, title, subject, tolerances, start, until, sources, read: None }
            }
        })
    }

    /// The scene of the machine with its present numbers; `None` for a mode.
    pub fn scene(&self) -> Result<Option<Scene>, Failure> {
        let Some((read, belt)) = self.read.as_ref().zip(self.subject.of_belt()) else {
            return Ok(None);
        };
        let machine = Machine {
            belt: belt.clone(),
            tolerances: self.tolerances.clone(),
            displacement: self.start.0,
            velocity: self.start.1,
            ..read.clone()
        };
        let scaled = ScaledMachine::new(machine);
        let scaled = scaled.map_err(|why| Failure::Usage(format!("{}: {why}", self.name)))?;
        Ok(Some(scaled.scene()))
    }
}
