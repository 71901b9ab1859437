//! `hopfscope completions` and `hopfscope man`: shell completions and manual pages, derived from the definition of
//! the command line.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;
use clap_mangen::Man;

use super::{Failure, Result, print, program, write};
use crate::words::wrapped;

/// Date of the manual pages, that of the version.
const DATE: &str = "2026-11-23";

/// Prints shell completions
#[derive(Args)]
pub struct CompletionsCommand {
    /// The shell
    shell: Shell,
}

impl CompletionsCommand {
    pub fn run(&self) -> Result<()> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program(), "hopfscope", &mut script);
        print(&String::from_utf8_lossy(&script))
    }
}

/// Writes manual pages: one for the program, one for each command
#[derive(Args)]
pub struct ManualCommand {
    /// Existing directory for the pages
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Replaces files that hold something else
    #[arg(long)]
    force: bool,
}

impl ManualCommand {
    pub fn run(&self) -> Result<()> {
        if !self.folder.is_dir() {
            return Err(Failure::file(&self.folder, "no such directory"));
        }
        let mut all = program().disable_help_subcommand(true);
        all.build();
        let commands = all.get_subcommands().cloned();
        for command in std::iter::once(all.clone()).chain(commands) {
            // `hopfscope cycles` becomes the page `hopfscope-cycles`.
            let name = command.get_display_name().unwrap_or(command.get_name()).to_owned();
            let page = Man::new(command.name(&name)).title(name.to_uppercase()).date(DATE);
            let page = page.source(concat!("hopfscope ", env!("CARGO_PKG_VERSION")));
            let mut text = Vec::new();
            page.render(&mut text).map_err(|why| Failure::unanswered("no manual", why))?;
            let text = tidied(&String::from_utf8_lossy(&text));
            write(&self.folder.join(page.get_filename()), text.as_bytes(), self.force)?;
        }
        Ok(())
    }
}

/// A manual page as `mandoc -Tlint` wants it: in short lines, and with one request for each space between them.
fn tidied(page: &str) -> String {
    const WIDTH: usize = 79;
    let page = page.replace("\n.br\n\n.br\n", "\n.sp\n").replace("\n\n", "\n.sp\n");
    let mut out = String::new();
    let mut is_tag = false;
    for line in page.lines() {
        // A tag is the line after `.TP`; broken, its rest would be the text that it stands beside.
        let whole = is_tag || line.starts_with(['.', '\'', ' ']);
        is_tag = line == ".TP";
        if whole {
            out += &(line.trim_end().to_owned() + "\n");
            continue;
        }
        for part in wrapped(line, WIDTH) {
            // At the start of a line a point begins a request.
            let escape = if part.starts_with('.') { "\\&" } else { "" };
            out += &format!("{escape}{part}\n");
        }
    }
    out
}
