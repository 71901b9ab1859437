//! The list of scenes.

use serde::Serialize;

use super::csv;
use super::json;
use crate::oscillator::{Parameters, State};
use crate::scene::Scene;
use crate::scene::said::said_by;
use crate::session::Keymap;

#[derive(Serialize)]
struct SceneDocument<'a> {
    name: &'a str,
    title: &'a str,
    look: String,
    press: String,
    parameters: &'a Parameters,
    initial: &'a State,
    until: f64,
}

/// A name of a scene, and its title.
#[derive(Default, Serialize)]
struct SceneRow<'a> {
    name: &'a str,
    title: &'a str,
}

pub fn json<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> String {
    let keymap = Keymap::default();
    let sentence =
        |scene: &Scene, text: &str| keymap.fill(&said_by(scene, text), |key| key.to_string());
    let document = |scene: &'a Scene, name: &'a str| SceneDocument {
        name,
        title: &scene.title,
        look: sentence(scene, &scene.watch),
        press: sentence(scene, &scene.press),
        parameters: &scene.problem.parameters,
        initial: &scene.problem.initial,
        until: scene.problem.until,
    };
    let documents = |scene: &'a Scene| scene.names().map(move |name| document(scene, name));
    json::text(&scenes.into_iter().flat_map(documents).collect::<Vec<_>>())
}

/// One row for each name of a scene.
pub fn csv<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> String {
    let rows = |scene: &'a Scene| scene.names().map(|name| SceneRow { name, title: &scene.title });
    csv::sheet(&SceneRow::default(), scenes.into_iter().flat_map(rows))
}
