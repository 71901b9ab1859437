//! `hopfscope figure`: what a scene shows, for papers and for other programs.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::failure::Failure;
use super::output::{print, write};
use super::start::StartOptions;
use super::wrapped::columns;
use crate::figure::{self as forms, FileForm};
use crate::flow::Limits;
use crate::question::Fineness;
use crate::runtime::print::{complete, figure};
use crate::runtime::provenance_file;
use crate::session::{Session, Size};
use crate::view::screen;
use crate::view::{self, Look};

/// Writes what a scene shows as SVG, PNG, CSV or JSON, or draws it here
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scene to show; a scene with several plots gives as many panels
    #[arg(value_name = "NAME", conflicts_with = "scene")]
    named: Option<String>,
    #[command(flatten)]
    start: StartOptions,
    /// File to write; its ending says in which form: .svg, .png, .csv or .json
    #[arg(long, value_name = "FILE", value_parser = file)]
    output: Option<(PathBuf, FileForm)>,
    /// Replaces what FILE holds
    #[arg(long, requires = "output")]
    force: bool,
    /// Form of what is written to standard output without --output
    #[arg(long, value_enum, default_value_t = Printed::Text, value_name = "FORM",
          conflicts_with = "output")]
    format: Printed,
}

/// The form of a figure on standard output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Printed {
    /// Drawn with characters.
    Text,
    /// One JSON document, all digits.
    Json,
    /// One row per point, all digits.
    Csv,
    /// A vector picture.
    Svg,
}

/// A file with one of the known endings.
fn file(text: &str) -> Result<(PathBuf, FileForm), String> {
    let path = PathBuf::from(text);
    FileForm::of_file(&path).map(|form| (path, form))
}

/// The size of a panel that is drawn with characters, where no terminal says how wide.
const PANEL: (u16, u16) = (100, 30);

/// Fewest columns in which a panel reads.
const NARROWEST: u16 = 40;

impl Arguments {
    /// Computes and writes.
    pub fn run(&self) -> Result<(), Failure> {
        let Some(name) = self.named.as_deref().or(self.start.scene.as_deref()) else {
            let line =
                "which figure? Every scene has one, such as fig17; hopfscope scenes lists them";
            return Err(Failure::Usage(line.to_owned()));
        };
        let scene = self.start.scene_named(name)?;
        let width = columns().unwrap_or(PANEL.0).clamp(NARROWEST, PANEL.0);
        let mut session = Session::new(scene, Size { width, height: PANEL.1 });
        complete(&mut session, Fineness::PRINT, &Limits::PATIENT).map_err(|(topic, reason)| {
            Failure::Unanswered(format!("{} not computed: {reason}", topic.name()))
        })?;
        let plots: Vec<usize> = (0..session.plots.len()).collect();
        let mut drawn =
            || figure(&mut session, &plots, &Limits::PATIENT).from(provenance_file::of_process());
        if let Some((path, form)) = &self.output {
            let content = forms::file(&drawn(), *form).map_err(Failure::Unanswered)?;
            return write(path, &content, self.force);
        }
        print(&match self.format {
            Printed::Text => in_letters(&session),
            Printed::Json => forms::json(&drawn()),
            Printed::Csv => forms::csv(&drawn()),
            Printed::Svg => forms::svg(&drawn()),
        })
    }
}

/// Every plot, one above the other.
fn in_letters(session: &Session) -> String {
    let look = Look::new(session.look);
    let Size { width, height } = session.size;
    let panels = view::panels(session, (width, height), &look);
    let parts: Vec<String> = panels.iter().map(screen::text).collect();
    format!("{}: {}\n\n{}", session.scene.name, session.scene.title, parts.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_of_a_file_says_in_which_form() {
        assert_eq!(file("a/fig.SVG").unwrap().1, FileForm::Svg);
        assert_eq!(file("fig.json").unwrap().1, FileForm::Json);
        assert_eq!(file("fig.png").unwrap().1, FileForm::Png);
        for wrong in ["fig", "fig.pdf", ".svg", ""] {
            assert!(file(wrong).is_err(), "{wrong}");
        }
    }
}
