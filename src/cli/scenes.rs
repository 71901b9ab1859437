//! `hopfscope scenes`: the list of scenes.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, print};
use super::scene_cost;
use crate::report::{scene_cost as cost, scenes as report};
use crate::scene::{Scene, library};

/// Lists the scenes
#[derive(Debug, Args)]
pub struct Arguments {
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table, value_name = "FORMAT")]
    format: Format,
    /// Shows what each scene computes, what that costs, and what a step of each number recomputes
    #[arg(long)]
    cost: bool,
}

impl Arguments {
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
        let names = |scene: &Scene| scene.names().collect::<Vec<_>>().join(" ");
        let width = scenes.iter().map(|scene| names(scene).chars().count()).max().unwrap_or(0);
        print(&match self.format {
            Format::Table => {
                let line = |scene: &Scene| format!("{:width$}  {}\n", names(scene), scene.title);
                scenes.iter().map(|scene| line(scene)).collect()
            }
            Format::Json => report::json(scenes.iter().map(AsRef::as_ref)),
            Format::Csv => report::csv(scenes.iter().map(AsRef::as_ref)),
        })
    }
}
