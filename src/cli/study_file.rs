//! The files that are made of a study: those of its figure, its scans, and a notebook that reads them.

use std::fs;
use std::path::{Component, Path, PathBuf};

use super::scan::ScanCommand;
use super::{Failure, Result, SourceOptions};
use crate::figure::FigureForm;
use crate::scene::Scene;
use crate::words::joined;

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
        let place = |name: &String| {
            let mut parts = Path::new(name).components();
            if name.is_empty() || !parts.all(|part| matches!(part, Component::Normal(_))) {
                let line =
                    format!("{name:?}: files of a study are named from its folder, without ..");
                return Err(Failure::from(line));
            }
            let path = folder.join(name);
            let parent = path.parent().unwrap_or(folder);
            fs::create_dir_all(parent).map_err(Failure::unwritten(parent))?;
            Ok(path)
        };
        let output = |name: &String| {
            let path = place(name)?;
            if path.extension().is_some_and(|ending| ending == "ipynb") {
                return Ok((path, None));
            }
            let form = FigureForm::of_file(&path);
            let form = form.map_err(|why| format!("{name:?}: {why}, or a notebook in .ipynb"))?;
            Ok((path, Some(form)))
        };
        let scan = |scan| ScanCommand::of_scene(scan, source, &place(&scan.output)?, force);
        let tables = scene.scans.iter().map(|scan| &scan.output);
        let data =
            scene.outputs.iter().chain(tables).filter(|name| {
                [".csv", ".json", ".npz"].iter().any(|ending| name.ends_with(ending))
            });
        Ok(StudyFiles {
            outputs: scene.outputs.iter().map(output).collect::<Result<_>>()?,
            notebook: NOTEBOOK.replace(
                "{files}",
                &joined(data.map(|name| format!("{name:?}")), ", ").replace('"', "'"),
            ),
            scans: scene.scans.iter().map(scan).collect::<Result<_>>()?,
        })
    }
}
