//! The list of scenes, and what they cost: the questions of their layers, and those that a step of each number repeats.

use std::sync::Arc;

use serde::Serialize;

use super::json::{self};
use super::{Answer, Columns, Document};
use crate::flow::Cost;
use crate::scene::said::said_by;
use crate::scene::{Scene, Topic};
use crate::session::Keymap;
use crate::session::wants::named;
use crate::words::duration;
use crate::words::number::count;

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

/// Every scene; in rows one for each of its names.
pub fn scenes(scenes: &[Arc<Scene>]) -> Answer<'_> {
    let rows = move || {
        let scenes = scenes.iter().map(AsRef::as_ref);
        scenes.flat_map(|scene: &Scene| scene.names().map(move |name| (name, scene)))
    };
    let text = move || {
        let names = |scene: &Scene| scene.names().collect::<Vec<_>>().join(" ");
        let width = scenes.iter().map(|scene| names(scene).chars().count()).max().unwrap_or(0);
        let line = |scene: &Arc<Scene>| format!("{:width$}  {}\n", names(scene), scene.title);
        scenes.iter().map(line).collect()
    };
    Answer::new(move || json::text(&columns().objects(rows())), move || columns().csv(rows()), text)
}

/// A question that was answered, and what it cost.
#[derive(Clone, Debug, Serialize)]
pub struct QuestionCost {
    #[serde(rename = "question")]
    pub topic: Topic,
    /// The names of the layers that draw the answer.
    pub layers: Vec<&'static str>,
    #[serde(flatten)]
    pub cost: Cost,
    pub seconds: f64,
}

/// The cost of a step of a number.
#[derive(Clone, Debug)]
pub struct StepCost {
    pub name: &'static str,
    /// The questions that were computed again.
    pub recomputed: Vec<QuestionCost>,
    /// The questions whose answers did not change.
    pub reused: Vec<Topic>,
}

#[derive(Clone, Debug)]
pub struct SceneCost {
    pub scene: Arc<Scene>,
    /// The questions that it asks when it opens.
    pub questions: Vec<QuestionCost>,
    /// The names of the layers that are drawn from formulas, without a question.
    pub formulas: Vec<&'static str>,
    /// The cost of a step of each of its numbers.
    pub steps: Vec<StepCost>,
}

fn sum(questions: &[QuestionCost]) -> (Cost, f64) {
    questions.iter().fold((Cost::default(), 0.0), |(mut cost, seconds), question| {
        cost += question.cost;
        (cost, seconds + question.seconds)
    })
}

/// The costs of scenes: in rows one line for each question of each scene, when it opens and after each step.
pub fn costs(scenes: &[SceneCost]) -> Answer<'_> {
    let json = move || json::text(&scenes.iter().map(document).collect::<Vec<_>>());
    Answer::new(json, move || csv(scenes), move || table(scenes))
}

fn document(found: &SceneCost) -> Document {
    let step = |step: &StepCost| {
        let (cost, seconds) = sum(&step.recomputed);
        Document::default()
            .with("parameter", step.name)
            .with("recomputed", step.recomputed.iter().map(|it| it.topic).collect::<Vec<_>>())
            .with("reused", &step.reused)
            .with("evaluations", cost.evaluations)
            .with("steps", cost.steps)
            .with("seconds", seconds)
    };
    let (cost, seconds) = sum(&found.questions);
    Document::default()
        .with("scene", &found.scene.name)
        .with("questions", &found.questions)
        .with("formulas", &found.formulas)
        .with("evaluations", cost.evaluations)
        .with("seconds", seconds)
        .with("steps", found.steps.iter().map(step).collect::<Vec<_>>())
}

fn csv(scenes: &[SceneCost]) -> String {
    type QuestionRow<'a> = (&'a SceneCost, &'static str, &'a QuestionCost);
    let columns = Columns::default()
        .file("scene", |(found, ..): &QuestionRow| found.scene.name.clone())
        .file("after", |(_, after, _)| *after)
        .file("question", |(.., question)| question.topic)
        .fields(&Cost::default(), |(.., question)| Some(question.cost))
        .file("seconds", |(.., question)| question.seconds);
    let rows = scenes.iter().flat_map(|found| {
        let steps = found.steps.iter().map(|step| (step.name, &step.recomputed));
        let asked = std::iter::once(("opening", &found.questions)).chain(steps);
        asked.flat_map(move |(after, all)| all.iter().map(move |one| (found, after, one)))
    });
    columns.csv(rows)
}

/// A line of the table of a scene.
struct PriceRow {
    what: String,
    cost: Cost,
    seconds: f64,
    remark: String,
}

/// As readable text: one table for each scene.
fn table(scenes: &[SceneCost]) -> String {
    let one = |found: &SceneCost| {
        let question = |question: &QuestionCost| PriceRow {
            what: question.topic.name().to_owned(),
            cost: question.cost,
            seconds: question.seconds,
            remark: format!("for {}", question.layers.join(", ")),
        };
        let summed = |what: String, questions: &[QuestionCost], remark: String| {
            let (cost, seconds) = sum(questions);
            PriceRow { what, cost, seconds, remark }
        };
        let part = |name: &str, topics: &[Topic]| {
            (!topics.is_empty()).then(|| format!("{name} {}", named(topics, ", ")))
        };
        let step = |step: &StepCost| {
            let again: Vec<Topic> = step.recomputed.iter().map(|asked| asked.topic).collect();
            let [again, kept] = [part("recomputes", &again), part("reuses", &step.reused)];
            let remark = again.into_iter().chain(kept).collect::<Vec<_>>().join("; ");
            summed(format!("a step of {}", step.name), &step.recomputed, remark)
        };
        let all = summed("all of it".to_owned(), &found.questions, String::new());
        let rows = found.questions.iter().map(question).chain([all]);
        let table = Columns::default()
            .text("", |row: &PriceRow| format!("{:<22}", row.what))
            .text("evaluations", |row| count(row.cost.evaluations))
            .text("steps", |row| count(row.cost.steps))
            .text("time", |row| duration(row.seconds))
            .text("", |row| row.remark.clone())
            .table(rows.chain(found.steps.iter().map(step)));
        let formulas = match &found.formulas[..] {
            [] => String::new(),
            formulas => format!("by formulas: {}\n", formulas.join(", ")),
        };
        format!("{}: {}\n{table}{formulas}", found.scene.name, found.scene.title)
    };
    scenes.iter().map(one).collect::<Vec<_>>().join("\n")
}
