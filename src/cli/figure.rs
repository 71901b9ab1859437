//! `hopfscope figure`: the plots of a scene, for papers and for other programs.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;

use super::output::columns;
use super::sheet::SheetOptions;
use super::{Failure, Result, SourceOptions, input, print, write};
use crate::figure::{FigureForm, file};
use crate::flow::Limits;
use crate::question::Fineness;
use crate::runtime::print::{complete, figure};
use crate::runtime::provenance_file;
use crate::scene::Scene;
use crate::scene::machine::NO_BELT;
use crate::session::{Playback, Session, Size};
use crate::view::{self, Look, screen};
use crate::words::joined;

/// Writes the plots of a scene as PDF, SVG, PNG, CSV or JSON, or draws them in the terminal
#[derive(Args)]
pub struct FigureCommand {
    #[command(flatten)]
    source: SourceOptions,
    /// File to write; its extension sets the format: .pdf, .svg, .png, .csv or .json
    #[arg(long, value_name = "FILE", value_parser = input::figure_file)]
    output: Option<(PathBuf, FigureForm)>,
    /// Replaces what FILE holds
    #[arg(long, requires = "output")]
    force: bool,
    /// Format on standard output, without --output
    #[arg(long, value_enum, default_value_t = FigureForm::Text,
          conflicts_with = "output")]
    format: FigureForm,
    #[command(flatten)]
    sheet: SheetOptions,
}

/// Size of a panel drawn with characters; a narrower terminal reduces the width.
const PANEL: (u16, u16) = (100, 30);

/// Fewest columns in which a panel is readable.
const NARROWEST: u16 = 40;

impl FigureCommand {
    pub fn run(&self) -> Result<()> {
        let mut scene = self.scene()?;
        self.sheet.apply(Arc::make_mut(&mut scene))?;
        let mut session = printed(scene);
        self.sheet.look(&mut session)?;
        let plots = complete_for_print(&mut session)?;
        let (path, form) = self.output.clone().unzip();
        let form = form.unwrap_or(self.format);
        if form == FigureForm::Text {
            return print(&in_letters(&session));
        }
        let drawn = figure(&mut session, &plots, &Limits::PATIENT);
        let drawn = drawn.from(provenance_file::of_process());
        let content = file(&drawn, form).map_err(Failure::Unanswered)?;
        match path {
            Some(path) => write(&path, &content, self.force),
            None => print(&String::from_utf8_lossy(&content)),
        }
    }

    /// The scene to show: that of a machine, or one that is named.
    fn scene(&self) -> Result<Arc<Scene>> {
        if self.source.machine_name().is_some()
            && let Some(case) = self.source.machine()?
        {
            return case.checked()?.scene()?.ok_or_else(|| NO_BELT.into());
        }
        if self.source.named.is_none() && self.source.start.scene.is_none() {
            let which =
                "which figure? Every scene has one, such as fig17; hopfscope scenes lists them";
            return Err(which.into());
        }
        self.source.scene()
    }
}

/// A session of a scene with everything on show computed for print, and its plots.
pub fn completed(scene: Arc<Scene>) -> Result<(Session, Vec<usize>)> {
    let mut session = printed(scene);
    let plots = complete_for_print(&mut session)?;
    Ok((session, plots))
}

/// A session of a scene, for print.
fn printed(scene: Arc<Scene>) -> Session {
    let width = columns().and_then(|width| u16::try_from(width).ok());
    let width = width.unwrap_or(PANEL.0).clamp(NARROWEST, PANEL.0);
    let mut session = Session::new(scene, Size { width, height: PANEL.1 });
    // On paper nothing is played: the whole motion is drawn.
    session.playback = Playback::default();
    session
}

/// Computes everything on show; the plots.
fn complete_for_print(session: &mut Session) -> Result<Vec<usize>> {
    complete(session, Fineness::PRINT, &Limits::PATIENT)?;
    Ok((0..session.plots.len()).collect())
}

/// Every plot, one above the other.
fn in_letters(session: &Session) -> String {
    let look = Look::new(session.display);
    let panels = view::panels(session, &look);
    let parts = joined(panels.iter().map(screen::text), "\n");
    format!("{}: {}\n\n{parts}", session.scene.name, session.scene.title)
}
