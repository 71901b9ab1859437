//! Scenes of the user, studies: files that stand where the name of a scene does.

use std::path::Path;
use std::sync::Arc;

use super::{CommandCase, Failure, Result};
use crate::fit::decoded;
use crate::flow::Subject;
use crate::runtime::bounded;
use crate::scene::file::study;
use crate::scene::{Layer, Scene, find};
use crate::session::{Session, Setup, Size};
use crate::words::ends_in;

/// The file that a name means: it ends in .toml or names a folder, and no scene of the program is called so.
pub fn file_of(name: &str) -> Option<&Path> {
    let path = Path::new(name);
    let is_file = ends_in(path, "toml") || path.components().nth(1).is_some();
    Some(path).filter(|_| is_file && find(name).is_err())
}

/// The scene with this name, or in this file.
pub fn scene_named(name: &str) -> Result<Arc<Scene>> {
    let Some(path) = file_of(name) else { return Ok(find(name)?) };
    let text = bounded::text(path)?;
    let title = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut fetch = |beside: &str| {
        let read = bounded::bytes(&path.with_file_name(beside));
        read.map(|bytes| decoded(&bytes)).map_err(|why| why.to_string())
    };
    let scene = study(&title, name, &text, &mut fetch).map_err(|mistake| mistake.to_string())?;
    Setup::of_scene(&scene).check().map_err(|why| Failure::file(path, why))?;
    Ok(Arc::new(scene))
}

/// The machine of a scene as a question is put to it: by the whole model, whatever is drawn.
pub fn machine(mut scene: Arc<Scene>) -> Option<CommandCase> {
    let mut described = scene.machine.as_ref()?.machine.described();
    Arc::make_mut(&mut scene).layers.insert(Layer::Whole);
    let drawn = Session::new(scene, Size::default()).subject();
    described.subject = Subject { tolerances: described.subject.tolerances, ..drawn };
    Some(CommandCase { described, sources: Vec::new() })
}
