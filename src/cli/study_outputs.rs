//! The files that are made of a study: those of its figure, its scans, and a notebook that reads them.

use std::fs;
use std::path::{Component, Path, PathBuf};

use super::scan::ScanCommand;
use super::{Failure, Result, SourceOptions};
use crate::figure::FigureForm;
use crate::scene::Scene;
use crate::words::{ends_in, joined};

/// A notebook for Jupyter, but for the names of its data.
const NOTEBOOK: &str = include_str!("../../assets/templates/notebook.ipynb");

/// The files of a study in a folder, which it makes.
#[derive(Default)]
pub struct StudyFiles {
    /// Each with its form; without one a notebook.
    pub outputs: Vec<(PathBuf, Option<FigureForm>)>,
    pub scans: Vec<ScanCommand>,
    /// A notebook that reads the data.
    pub notebook: String,
}

impl StudyFiles {
    /// Fails if a name leads out of the folder or has no ending of a figure, or a scan is wrong.
    pub fn of(scene: &Scene, source: &SourceOptions, folder: &Path, force: bool) -> Result<Self> {
        let mut files = StudyFiles::default();
        let (mut data, mut folders) = (Vec::new(), Vec::new());
        let mut place = |name: &Path| {
            let inside = name.components().all(|part| matches!(part, Component::Normal(_)));
            let path = folder.join(name);
            let Some(parent) = path.parent().filter(|_| inside) else {
                let why = "files of a study are named from its folder, without ..";
                return Err(Failure::file(name, why));
            };
            folders.push(parent.to_owned());
            data.push(format!("'{}'", name.display()));
            Ok(path)
        };
        for name in &scene.outputs {
            let path = place(Path::new(name))?;
            let form = FigureForm::of_file(&path);
            let is_notebook = ends_in(&path, "ipynb");
            let refused = |why| format!("{name:?}: {why}, or a notebook in .ipynb");
            let form = (!is_notebook).then(|| form.map_err(refused)).transpose()?;
            files.outputs.push((path, form));
        }
        for options in &scene.scans {
            let mut scan = ScanCommand::of_scene(options, source, force)?;
            scan.output = scan.output.as_deref().map(&mut place).transpose()?;
            files.scans.push(scan);
        }
        for folder in folders {
            fs::create_dir_all(&folder).map_err(Failure::unwritten(&folder))?;
        }
        files.notebook = NOTEBOOK.replace("{files}", &joined(data, ", "));
        Ok(files)
    }
}
