//! `hopfscope completions` and `hopfscope man`: shell completions and manual pages, derived from the definition of
//! the command line.

use std::path::PathBuf;

use clap::{Args, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;

use super::Cli;
use super::failure::Failure;
use super::output::{print, write};

/// Prints shell completions
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

impl Completions {
    pub fn run(&self) -> Result<(), Failure> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "hopfscope", &mut script);
        print(&String::from_utf8_lossy(&script))
    }
}

/// Writes manual pages: one for the program, one for each command
#[derive(Debug, Args)]
pub struct Manual {
    /// Existing directory for the pages
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Replaces files that hold something else
    #[arg(long)]
    force: bool,
}

impl Manual {
    pub fn run(&self) -> Result<(), Failure> {
        if !self.folder.is_dir() {
            return Err(Failure::Usage(format!("{}: no such directory", self.folder.display())));
        }
        let mut program = Cli::command().disable_help_subcommand(true);
        program.build();
        let commands = program.get_subcommands().cloned();
        for command in std::iter::once(program.clone()).chain(commands) {
            // `hopfscope cycles` becomes the page `hopfscope-cycles`.
            let name = command.get_display_name().unwrap_or(command.get_name()).to_owned();
            let page = Man::new(command.name(name));
            let mut text = Vec::new();
            page.render(&mut text)
                .map_err(|error| Failure::Unanswered(format!("no manual: {error}")))?;
            write(&self.folder.join(page.get_filename()), &text, self.force)?;
        }
        Ok(())
    }
}
