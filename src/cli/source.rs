//! What a command is about: the motion of a scene, or a machine.

use clap::Args;

use super::failure::Failure;
use super::input::read;
use super::machine::{MachineCase, input, second};
use super::start::StartOptions;

/// What a command is about: the motion of a scene, or a machine.
#[derive(Clone, Debug, Args)]
pub struct SourceOptions {
    #[command(flatten)]
    pub start: StartOptions,
    /// Asks about a machine in place of a scene: a file, or the name of a built-in one (see hopfscope belt). All numbers
    /// are then its own, such as --set "R=2 N", with a unit or in SI units
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scene", "step", "epsilon"])]
    machine: Option<String>,
}

impl SourceOptions {
    /// The machine to which a question about all motions is put, if it is about one. These are followed by Taylor series
    /// alone.
    pub fn portrayed(&self) -> Result<Option<MachineCase>, Failure> {
        let Some(case) = self.machine()? else {
            self.start.note_own_method();
            return Ok(None);
        };
        if second(self.start.method)?.is_some() {
            let line =
                "all motions of a machine are followed by Taylor series: --method auto or taylor";
            return Err(Failure::Usage(line.to_owned()));
        }
        Ok(Some(case.checked()?))
    }

    /// The machine with the values set on the command line, if it is about one.
    pub fn machine(&self) -> Result<Option<MachineCase>, Failure> {
        let Some(name) = &self.machine else { return Ok(None) };
        let mut case = MachineCase::named(name)?;
        let set = self.start.set.iter().map(|text| read("--set", text, input::assignment));
        case.set(&set.collect::<Result<Vec<_>, _>>()?)?;
        case.problem.subject.tolerance = self.start.tol;
        Ok(Some(case))
    }
}
