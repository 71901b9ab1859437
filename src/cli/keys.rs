//! `hopfscope keys`: the meaning of every key, under the user's settings.

use clap::Args;
use serde::Serialize;

use super::config::Settings;
use super::failure::Failure;
use super::output::{Format, print};
use super::wrapped::on_terminal;
use crate::report::table::Table;
use crate::report::{csv, json};
use crate::runtime::standard::tell;
use crate::session::commands;
use crate::session::state::context::{ContextSpec, contexts};

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
#[derive(Default, Serialize)]
struct KeyRow<K> {
    context: &'static str,
    command: &'static str,
    keys: K,
    meaning: &'static str,
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
            Format::Table => {
                let table = Table::of(
                    &rows,
                    &[
                        ("context", &|row: &KeyRow<Vec<String>>| row.context.to_owned()),
                        ("command", &|row| row.command.to_owned()),
                        ("keys", &|row| row.keys.join(" ")),
                        ("meaning", &|row| row.meaning.to_owned()),
                    ],
                );
                on_terminal(&table.aligned_left())
            }
            Format::Json => json::text(&rows),
            Format::Csv => {
                let joined = rows.into_iter().map(|row| {
                    let KeyRow { context, command, keys, meaning } = row;
                    KeyRow { context, command, keys: keys.join(" "), meaning }
                });
                csv::sheet(&KeyRow::<String>::default(), joined)
            }
        })?;
        if let (Some(path), Format::Table) = (self.settings.path(), self.format) {
            let there = if path.exists() { "" } else { " (not there)" };
            tell(format!("settings file: {}{there}", path.display()));
        }
        Ok(())
    }
}
