//! `hopfscope scenes`: what there is to look at.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, print};
use super::scene_cost;
use crate::export::csv;
use crate::export::json;
use crate::export::scene_cost as export;
use crate::scene::library::library;

/// Lists the scenes
#[derive(Debug, Args)]
pub struct Scenes {
    /// Form of the list
    #[arg(long, value_enum, default_value_t = Format::Table, value_name = "FORM")]
    format: Format,
    /// Shows what each scene asks, what that costs, and what a step of each number asks anew
    #[arg(long)]
    cost: bool,
}

impl Scenes {
    /// Prints the list.
    pub fn run(&self) -> Result<(), Failure> {
        if self.cost {
            let found = scene_cost::measured()?;
            return print(&match self.format {
                Format::Table => export::table(&found),
                Format::Json => export::json(&found),
                Format::Csv => export::csv(&found),
            });
        }
        let scenes = library();
        let width = scenes.iter().map(|scene| scene.name.chars().count()).max().unwrap_or(0);
        print(&match self.format {
            Format::Table => {
                let line = |name: &str, title: &str| format!("{name:width$}  {title}\n");
                scenes.iter().map(|scene| line(&scene.name, &scene.title)).collect()
            }
            Format::Json => json::scenes(scenes.iter().map(AsRef::as_ref)),
            Format::Csv => {
                let row = |name: &str, title: &str| csv::line(&[name.to_owned(), title.to_owned()]);
                let rows = scenes.iter().map(|scene| row(&scene.name, &scene.title));
                std::iter::once(row("name", "title")).chain(rows).collect()
            }
        })
    }
}
