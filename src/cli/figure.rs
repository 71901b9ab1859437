//! `hopfscope figure`: what a scene shows, for papers and for other programs.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::failure::Failure;
use super::output::print;
use super::start::Start;
use crate::export::figure::{Figure as Drawn, csv, json, svg};
use crate::export::screen;
use crate::flow::Limits;
use crate::scene::Answered;
use crate::scene::answer::{Fineness, answer_for};
use crate::scene::library::library;
use crate::session::{Msg, Session, Size, update};
use crate::view::{self, Look};

/// Writes what a scene shows as SVG, CSV or JSON, or draws it here
#[derive(Debug, Args)]
pub struct Figure {
    /// Scene to show; a scene with several plots gives as many panels
    #[arg(value_name = "NAME", conflicts_with = "scene")]
    named: Option<String>,
    #[command(flatten)]
    start: Start,
    /// File to write; its ending says in which form: .svg, .csv or .json
    #[arg(long, value_name = "FILE", value_parser = file)]
    output: Option<(PathBuf, Form)>,
    /// Form of what is written to standard output without --output
    #[arg(long, value_enum, default_value_t = Form::Text, value_name = "FORM", conflicts_with = "output")]
    format: Form,
}

/// The form of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// Drawn with characters.
    Text,
    /// One JSON document, all digits.
    Json,
    /// One row a point, all digits.
    Csv,
    /// A vector picture.
    Svg,
}

/// The endings of files, and the forms that they ask for.
const ENDINGS: [(&str, Form); 3] = [("svg", Form::Svg), ("csv", Form::Csv), ("json", Form::Json)];

/// A file with one of the known endings.
fn file(text: &str) -> Result<(PathBuf, Form), String> {
    let path = Path::new(text);
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let form = ENDINGS.iter().find(|(known, _)| known.eq_ignore_ascii_case(ending));
    form.map(|(_, form)| (path.to_owned(), *form))
        .ok_or_else(|| "a figure ends in .svg, .csv or .json".to_owned())
}

/// The size of a panel that is drawn with characters.
const PANEL: (u16, u16) = (100, 30);

impl Figure {
    /// Computes and writes.
    pub fn run(&self) -> Result<(), Failure> {
        let Some(name) = self.named.as_deref().or(self.start.scene.as_deref()) else {
            let names: Vec<_> = library().iter().map(|scene| scene.name.as_str()).collect();
            return Err(Failure::Usage(format!("which figure? There are {}", names.join(", "))));
        };
        let scene = self.start.scene_named(name)?;
        let session = answered(Session::new(scene, Size { width: PANEL.0, height: PANEL.1 }))?;
        let form = self.output.as_ref().map_or(self.format, |(_, form)| *form);
        let plots = 0..session.plots.len();
        let text = match form {
            Form::Text => drawn(&session),
            Form::Json => json(&Drawn::of(&session, plots)),
            Form::Csv => csv(&Drawn::of(&session, plots)),
            Form::Svg => svg(&Drawn::of(&session, plots)),
        };
        match &self.output {
            None => print(&text),
            Some((path, _)) => std::fs::write(path, text).map_err(|error| {
                Failure::Unanswered(format!("{} not written: {error}", path.display()))
            }),
        }
    }
}

/// A session with everything on show computed, as finely as print needs.
fn answered(mut session: Session) -> Result<Session, Failure> {
    loop {
        let open = session.wants().into_iter().find(|request| session.is_open(request));
        let Some(request) = open else { return Ok(session) };
        let slot = request.slot();
        let found = answer_for(&request, Fineness::PRINT, &Limits::PATIENT).map_err(|reason| {
            Failure::Unanswered(format!("{} not computed: {reason}", slot.name()))
        })?;
        let answered = Answered { request, result: Ok(found), seconds: 0.0, complete: true };
        update(&mut session, Msg::Answered(Box::new(answered)));
    }
}

/// Every plot, one above the other.
fn drawn(session: &Session) -> String {
    let look = Look::new(session.look);
    let panels = view::panels(session, PANEL, &look);
    let parts: Vec<String> = panels.iter().map(screen::text).collect();
    format!("{}: {}\n\n{}", session.scene.name, session.scene.title, parts.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_of_a_file_says_in_which_form() {
        assert_eq!(file("a/fig.SVG").unwrap().1, Form::Svg);
        assert_eq!(file("fig.json").unwrap().1, Form::Json);
        for wrong in ["fig", "fig.pdf", ".svg", ""] {
            assert!(file(wrong).is_err(), "{wrong}");
        }
    }
}
