//! The list of scenes.

use super::columns::Columns;
use super::json;
use crate::scene::Scene;
use crate::scene::said::said_by;
use crate::session::Keymap;

/// A name of a scene, and the scene.
type SceneRow<'a> = (&'a str, &'a Scene);

fn columns<'a>() -> Columns<'a, SceneRow<'a>> {
    let keymap = Keymap::default();
    let sentence =
        move |scene: &Scene, text: &str| keymap.fill(&said_by(scene, text), |key| key.to_string());
    let press = sentence.clone();
    Columns::default()
        .file("name", |(name, _): &SceneRow| (*name).to_owned())
        .file("title", |(_, scene)| scene.title.clone())
        .field("look", move |(_, scene)| sentence(scene, &scene.watch))
        .field("press", move |(_, scene)| press(scene, &scene.press))
        .field("parameters", |(_, scene)| scene.problem.parameters)
        .field("initial", |(_, scene)| scene.problem.initial)
        .field("until", |(_, scene)| scene.problem.until)
}

/// One row for each name of a scene.
fn rows<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> impl Iterator<Item = SceneRow<'a>> {
    scenes.into_iter().flat_map(|scene| scene.names().map(move |name| (name, scene)))
}

pub fn json<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> String {
    json::text(&columns().objects(rows(scenes)))
}

pub fn csv<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> String {
    columns().csv(rows(scenes))
}
