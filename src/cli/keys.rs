//! `hopfscope keys`: the meaning of every key, under the user's settings.

use super::config::Settings;
use super::failure::Failure;
use super::output::{Format, print};
use super::wrapped::on_terminal;
use crate::report::columns::Columns;
use crate::report::json;
use crate::runtime::standard::tell;
use crate::session::commands;
use crate::session::state::context::{ContextSpec, contexts};
use clap::Args;

/// Lists the keys of the explorer, as the settings file changes them
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    settings: Settings,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table, value_name = "FORMAT")]
    format: Format,
}

/// A command in a context.
struct KeyRow {
    context: &'static str,
    command: &'static str,
    keys: Vec<String>,
    meaning: &'static str,
}

fn columns<'a>() -> Columns<'a, KeyRow> {
    Columns::default()
        .word("context", |row: &KeyRow| row.context)
        .word("command", |row| row.command)
        .word("keys", |row| row.keys.join(" "))
        // A document lists them.
        .field("keys", |row| row.keys.clone())
        .word("meaning", |row| row.meaning)
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let keymap = self.settings.read()?.keymap;
        let mut rows = Vec::new();
        for ContextSpec { context, name, .. } in contexts() {
            let here = commands().filter(|row| row.keys.iter().any(|(at, _)| *at == context));
            rows.extend(here.map(|command| KeyRow {
                context: name,
                command: command.name,
                keys: keymap.keys_in(context, command).map(|key| key.to_string()).collect(),
                meaning: command.doc,
            }));
        }
        print(&match self.format {
            Format::Table => on_terminal(&columns().table(rows).aligned_left()),
            Format::Json => json::text(&columns().objects(rows)),
            Format::Csv => columns().csv(rows),
        })?;
        if let (Some(path), Format::Table) = (self.settings.path(), self.format) {
            let there = if path.exists() { "" } else { " (not there)" };
            tell(format!("settings file: {}{there}", path.display()));
        }
        Ok(())
    }
}
