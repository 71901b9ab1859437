//! `hopfscope scenes`: what there is to look at.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, print};
use super::scene_cost;
use crate::report::{scene_cost as cost, scenes as report};
use crate::scene::library::library;

/// Lists the scenes
#[derive(Debug, Args)]
pub struct Scenes {
    /// Form of the list
    #[arg(long, value_enum, default_value_t = Format::Table, value_name = "FORM")]
    format: Format,
    /// Shows what each scene asks, what that costs, and what a step of each number asks again
    #[arg(long)]
    cost: bool,
}

impl Scenes {
    /// Prints the list.
    pub fn run(&self) -> Result<(), Failure> {
        if self.cost {
            let found = scene_cost::measured()?;
            return print(&match self.format {
                Format::Table => cost::table(&found),
                Format::Json => cost::json(&found),
                Format::Csv => cost::csv(&found),
            });
        }
        let scenes = library();
        let width = scenes.iter().map(|scene| scene.name.chars().count()).max().unwrap_or(0);
        print(&match self.format {
            Format::Table => {
                let line = |name: &str, title: &str| format!("{name:width$}  {title}\n");
                scenes.iter().map(|scene| line(&scene.name, &scene.title)).collect()
            }
            Format::Json => report::json(scenes.iter().map(AsRef::as_ref)),
            Format::Csv => report::csv(scenes.iter().map(AsRef::as_ref)),
        })
    }
}
