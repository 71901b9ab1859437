//! `hopfscope figure`: the plots of a scene, for papers and for other programs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use super::output::terminal_width;
use super::scan::ScanCommand;
use super::study_outputs::StudyFiles;
use super::{Failure, Result, SourceOptions, print, window, write};
use crate::figure::{FigureForm, facts, file};
use crate::flow::Limits;
use crate::question::Fineness;
use crate::runtime::print::{complete, figure, unseen};
use crate::runtime::{bounded, provenance_file, tell};
use crate::scene::machine::NO_BELT;
use crate::scene::{Scene, Sheet, plain};
use crate::session::read::windows::fitted;
use crate::session::{Framing, Pane, Playback, Session, Size, save};
use crate::view::{self, Look, screen};
use crate::words::joined;

/// Writes the plots of a scene or a study as PDF, SVG, PNG, CSV or JSON, or draws them in the terminal
#[derive(Args)]
pub struct FigureCommand {
    #[command(flatten)]
    source: SourceOptions,
    /// Draws a saved session
    #[arg(long, value_name = "FILE", conflicts_with_all = OF_A_SCENE)]
    open: Option<PathBuf>,
    /// File to write; its extension sets the format: .pdf, .svg, .png, .csv or .json. A folder takes the files that a study
    /// names in `outputs`, which otherwise lie beside it
    #[arg(long, value_name = "FILE|DIR")]
    output: Option<PathBuf>,
    /// Replaces what the files hold
    #[arg(long)]
    force: bool,
    /// Format on standard output, without --output
    #[arg(long, value_enum, conflicts_with = "output")]
    format: Option<FigureForm>,
    /// Part to show of all panels or, repeated, of each, in the units of its axes
    #[arg(long, value_name = "XMIN:XMAX,YMIN:YMAX")]
    window: Vec<String>,
    #[command(flatten)]
    sheet: Sheet,
}

/// The options that say of what scene a figure is.
const OF_A_SCENE: [&str; 8] =
    ["named", "scene", "machine", "set", "method", "tol", "step", "epsilon"];

/// Size of a panel drawn with characters; a narrower terminal reduces the width.
const PANEL: (u16, u16) = (100, 30);

/// Fewest columns in which a panel is readable.
const NARROWEST: u16 = 40;

impl FigureCommand {
    pub fn run(&self) -> Result<()> {
        let mut session = self.session()?;
        let files = self.files(&session.scene)?;
        if self.sheet.caption && files.is_none() {
            return Err("--caption stands beside a picture: name one by --output".into());
        }
        window::show_windows(&mut session, &self.window)?;
        complete(&mut session, Fineness::PRINT, &Limits::PATIENT)?;
        self.keep_in_sight(&mut session)?;
        // Of a level curve that is not there.
        let has_levels = !session.levels.is_empty();
        if let Some(notice) = session.notice.as_ref().filter(|it| it.error && has_levels) {
            tell(format!("note: {}", notice.text));
        }
        let form = self.format.unwrap_or(FigureForm::Text);
        if files.is_none() && form == FigureForm::Text {
            return print(&in_letters(&session));
        }
        let plots: Vec<_> = session.on_show().collect();
        let drawn = figure(&mut session, &plots, &Limits::PATIENT);
        let drawn = drawn.from(provenance_file::of_process());
        let content = |form| file(&drawn, form).map_err(Failure::Unanswered);
        let Some(files) = files else { return print(&String::from_utf8_lossy(&content(form)?)) };
        for (path, form) in &files.outputs {
            if drawn.sheet.caption && form.is_some_and(|form| form != FigureForm::Json) {
                write(&path.with_extension("txt"), facts(&drawn).as_bytes(), self.force)?;
            }
            let notebook = || Ok(files.notebook.clone().into_bytes());
            write(path, &form.map_or_else(notebook, content)?, self.force)?;
            if *form == Some(FigureForm::Csv) {
                provenance_file::write(path, &provenance_file::of_process())?;
            }
        }
        files.scans.iter().try_for_each(ScanCommand::run)
    }

    /// A session of the plots that are drawn.
    fn session(&self) -> Result<Session> {
        let mut session;
        if let Some(path) = &self.open {
            session = printed(plain());
            let text = bounded::text(path)?;
            save::open(&mut session, &text).map_err(|why| Failure::file(path, why))?;
        } else {
            session = printed(self.scene()?);
        }
        let on_show = session.on_show();
        let Scene { sheet, plots, .. } = Arc::make_mut(&mut session.scene);
        *sheet = self.sheet.clone().over(std::mem::take(sheet));
        let drawn = sheet.plots(session.plots.len(), on_show)?;
        *plots = drawn.iter().filter_map(|plot| plots.get(*plot).copied()).collect();
        session.plots = drawn.iter().map(|plot| session.plots[*plot].clone()).collect();
        (session.plot, session.focus, session.enlarged) = (0, Pane::Parameters, false);
        Ok(session)
    }

    /// The scene to show: that of a machine, or one that is named.
    fn scene(&self) -> Result<Arc<Scene>> {
        let SourceOptions { named, start, .. } = &self.source;
        if named.is_none() && start.scene.is_none() && self.source.machine_name().is_none() {
            let which =
                "which figure? Every scene has one, such as fig17; hopfscope scenes lists them";
            return Err(which.into());
        }
        let study = self.source.file();
        let case = self.source.machine()?.filter(|_| study.is_none() || !start.set.is_empty());
        let Some(case) = case else { return self.source.scene() };
        let own = case.checked()?.scene()?.ok_or(NO_BELT)?;
        if study.is_none() {
            return Ok(own);
        }
        let mut scene = self.source.found()?;
        let changed = Arc::make_mut(&mut scene);
        (changed.machine, changed.problem) = (own.machine.clone(), own.problem);
        Ok(scene)
    }

    /// The files to make; none for standard output.
    fn files(&self, scene: &Scene) -> Result<Option<StudyFiles>> {
        let names_files = scene.outputs.len() + scene.scans.len() > 0;
        let study = self.source.file().filter(|_| names_files && self.format.is_none());
        let folder = match (&self.output, study) {
            (Some(folder), Some(_)) if is_folder(folder) => folder,
            (Some(path), _) => {
                let form = FigureForm::of_file(path).map_err(|why| Failure::file(path, why))?;
                let outputs = vec![(path.clone(), Some(form))];
                return Ok(Some(StudyFiles { outputs, ..StudyFiles::default() }));
            }
            (None, Some(study)) => study.parent().unwrap_or(study),
            (None, None) => return Ok(None),
        };
        StudyFiles::of(scene, &self.source, folder, self.force).map(Some)
    }

    /// Fits the windows of a scene that values set on the command line have left behind.
    fn keep_in_sight(&self, session: &mut Session) -> Result<()> {
        let set = !self.source.start.set.is_empty();
        for plot in 0..session.plots.len() {
            let of_scene = set && session.plots[plot].framing == Framing::Scene;
            if of_scene
                && unseen(session, plot)
                && let Some(window) = fitted(session, plot)
            {
                let own = &mut session.plots[plot];
                (own.window, own.framing) = (window, Framing::Fitted);
                let why = "its window does not show all lines with these values; it is fitted";
                tell(format!("note: panel {}: {why}", plot + 1));
            }
        }
        complete(session, Fineness::PRINT, &Limits::PATIENT)
    }
}

fn is_folder(path: &Path) -> bool {
    path.is_dir() || path.as_os_str().as_encoded_bytes().ends_with(b"/")
}

/// A session of a scene, for print.
pub fn printed(scene: Arc<Scene>) -> Session {
    let width = terminal_width().and_then(|width| u16::try_from(width).ok());
    let width = width.unwrap_or(PANEL.0).clamp(NARROWEST, PANEL.0);
    let mut session = Session::new(scene, Size { width, height: PANEL.1 });
    // On paper nothing is played: the whole motion is drawn.
    session.playback = Playback::default();
    session
}

/// Every plot, one above the other.
fn in_letters(session: &Session) -> String {
    let look = Look::new(session.display);
    let panels = view::panels(session, &look);
    let parts = joined(panels.iter().map(screen::text), "\n");
    format!("{}: {}\n\n{parts}", session.scene.name, session.scene.title)
}
