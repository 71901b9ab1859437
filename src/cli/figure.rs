//! `hopfscope figure`: the plots of a scene, for papers and for other programs.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;

use super::output::columns;
use super::{Failure, Result, SourceOptions, input, print, window, write};
use crate::figure::{FigureForm, facts, file};
use crate::flow::Limits;
use crate::question::Fineness;
use crate::runtime::print::{complete, figure};
use crate::runtime::provenance_file;
use crate::scene::machine::NO_BELT;
use crate::scene::{Scene, Sheet};
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
    /// Part to show of all panels or, repeated, of each, in the units of its axes
    #[arg(long, value_name = "XMIN:XMAX,YMIN:YMAX")]
    window: Vec<String>,
    #[command(flatten)]
    sheet: Sheet,
}

/// Size of a panel drawn with characters; a narrower terminal reduces the width.
const PANEL: (u16, u16) = (100, 30);

/// Fewest columns in which a panel is readable.
const NARROWEST: u16 = 40;

impl FigureCommand {
    pub fn run(&self) -> Result<()> {
        let mut scene = self.scene()?;
        let Scene { sheet, plots, .. } = Arc::make_mut(&mut scene);
        *sheet = self.sheet.clone().over(std::mem::take(sheet));
        let drawn = sheet.plots(plots.len())?;
        *plots = drawn.into_iter().map(|plot| plots[plot]).collect();
        let (mut session, plots) = completed(scene, &self.window)?;
        let (path, form) = self.output.clone().unzip();
        let form = form.unwrap_or(self.format);
        if form == FigureForm::Text {
            return print(&in_letters(&session));
        }
        let drawn = figure(&mut session, &plots, &Limits::PATIENT);
        let drawn = drawn.from(provenance_file::of_process());
        let content = file(&drawn, form).map_err(Failure::Unanswered)?;
        match path {
            Some(path) => {
                if drawn.sheet.caption && form.is_picture() {
                    write(&path.with_extension("txt"), facts(&drawn).as_bytes(), self.force)?;
                }
                write(&path, &content, self.force)
            }
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

/// A session of a scene with everything on show in these windows, or its own, computed for print, and its plots.
pub fn completed(scene: Arc<Scene>, windows: &[String]) -> Result<(Session, Vec<usize>)> {
    let width = columns().and_then(|width| u16::try_from(width).ok());
    let width = width.unwrap_or(PANEL.0).clamp(NARROWEST, PANEL.0);
    let mut session = Session::new(scene, Size { width, height: PANEL.1 });
    // On paper nothing is played: the whole motion is drawn.
    session.playback = Playback::default();
    window::look(&mut session, windows)?;
    complete(&mut session, Fineness::PRINT, &Limits::PATIENT)?;
    let plots = (0..session.plots.len()).collect();
    Ok((session, plots))
}

/// Every plot, one above the other.
fn in_letters(session: &Session) -> String {
    let look = Look::new(session.display);
    let panels = view::panels(session, &look);
    let parts = joined(panels.iter().map(screen::text), "\n");
    format!("{}: {}\n\n{parts}", session.scene.name, session.scene.title)
}
