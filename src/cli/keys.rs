//! `hopfscope keys`: what every key means, with the user's settings.

use clap::Args;
use serde::Serialize;

use super::config::Settings;
use super::failure::Failure;
use super::output::{Format, print};
use crate::export::csv;
use crate::export::json;
use crate::export::table::Table;
use crate::session::COMMANDS;
use crate::session::keymap::CONTEXTS;

/// Lists the keys of the explorer, with the changes of the settings file
#[derive(Debug, Args)]
pub struct Keys {
    #[command(flatten)]
    settings: Settings,
    /// Form of the list
    #[arg(long, value_enum, default_value_t = Format::Table, value_name = "FORM")]
    format: Format,
}

/// A command in a context.
#[derive(Serialize)]
struct Row {
    context: &'static str,
    command: &'static str,
    keys: Vec<String>,
    meaning: &'static str,
}

impl Keys {
    /// Prints the list.
    pub fn run(&self) -> Result<(), Failure> {
        let keymap = self.settings.read()?.keymap;
        let mut rows = Vec::new();
        for (context, name) in CONTEXTS {
            let here = COMMANDS.iter().filter(|row| row.keys.iter().any(|(at, _)| *at == context));
            rows.extend(here.map(|command| Row {
                context: name,
                command: command.name,
                keys: keymap.keys_in(context, command).map(|key| key.to_string()).collect(),
                meaning: command.doc,
            }));
        }
        let cells = |row: &Row| {
            [row.context, row.command, &row.keys.join(" "), row.meaning].map(str::to_owned)
        };
        print(&match self.format {
            Format::Table => {
                let mut table = Table::new(&["context", "command", "keys", "meaning"]);
                for row in &rows {
                    table.row(cells(row).to_vec());
                }
                table.aligned_left()
            }
            Format::Json => json::text(&rows),
            Format::Csv => {
                let head = csv::line(&["context", "command", "keys", "meaning"].map(str::to_owned));
                std::iter::once(head).chain(rows.iter().map(|row| csv::line(&cells(row)))).collect()
            }
        })?;
        if let (Some(path), Format::Table) = (self.settings.path(), self.format) {
            let there = if path.exists() { "" } else { " (not there)" };
            eprintln!("hopfscope: settings file: {}{there}", path.display());
        }
        Ok(())
    }
}
