//! `hopfscope scenes`: what there is to look at.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, print};
use crate::export::csv;
use crate::export::json;
use crate::scene::library::library;

/// Lists the scenes
#[derive(Debug, Args)]
pub struct Scenes {
    /// Form of the list
    #[arg(long, value_enum, default_value_t = Format::Table, value_name = "FORM")]
    format: Format,
}

impl Scenes {
    /// Prints the list.
    pub fn run(&self) -> Result<(), Failure> {
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
