//! The list of scenes, and what they cost: the questions of their layers, and those that a step of each number repeats.

use std::sync::Arc;

use serde::Serialize;

use super::{Answer, Columns, Document, Quantity};
use crate::flow::Cost;
use crate::scene::said::said_by;
use crate::scene::{Scene, Topic};
use crate::session::Keymap;
use crate::session::wants::consequence;
use crate::words::count;

/// A scene under one of its names.
struct SceneRow<'a> {
    name: &'a str,
    scene: &'a Scene,
}

fn columns<'a>() -> Columns<'a, SceneRow<'a>> {
    let keymap = Keymap::default();
    let sentence =
        move |scene: &Scene, text: &str| keymap.fill(&said_by(scene, text), |key| key.to_string());
    let press = sentence.clone();
    Columns::default()
        .word("name", |row: &SceneRow| row.name.to_owned())
        .word("title", |row| row.scene.title.clone())
        .field("look", move |row| sentence(row.scene, &row.scene.watch))
        .field("press", move |row| press(row.scene, &row.scene.press))
        .field("parameters", |row| row.scene.problem.parameters)
        .field("initial", |row| row.scene.problem.initial)
        .field("until", |row| row.scene.problem.until)
}

/// Every scene: one row for each of its names.
pub fn scenes(scenes: &[Arc<Scene>]) -> Answer {
    let scenes = scenes.iter().map(AsRef::as_ref);
    let rows =
        scenes.flat_map(|scene: &Scene| scene.names().map(move |name| SceneRow { name, scene }));
    Answer::list_of(&columns(), &rows.collect::<Vec<_>>(), None)
}

/// A question that was answered, and what it cost.
#[derive(Serialize)]
pub struct QuestionCost {
    #[serde(rename = "question")]
    pub topic: Topic,
    /// The names of the layers that draw the answer.
    pub layers: Vec<&'static str>,
    #[serde(flatten)]
    pub cost: Cost,
    pub seconds: f64,
}

/// What a scene asks at once.
pub struct QuestionBatch {
    /// [`OPENING`], or the name of a number after whose step it asks.
    pub after: &'static str,
    pub questions: Vec<QuestionCost>,
    /// The questions whose answers did not change.
    pub reused: Vec<Topic>,
}

/// Names what a scene asks when it opens.
pub const OPENING: &str = "opening";

pub struct SceneCost {
    pub scene: Arc<Scene>,
    /// The names of the layers that are drawn from formulas, without a question.
    pub formulas: Vec<&'static str>,
    /// What it asks when it opens, then what it asks again after a step of each of its numbers.
    pub asked: Vec<QuestionBatch>,
}

fn sum(questions: &[QuestionCost]) -> (Cost, f64) {
    questions.iter().fold((Cost::default(), 0.0), |(mut cost, seconds), question| {
        cost += question.cost;
        (cost, seconds + question.seconds)
    })
}

/// The costs of scenes: in rows one line for each question of each scene, when it opens and after each step; in text
/// one table for each scene.
pub fn costs(scenes: &[SceneCost]) -> Answer {
    let each = scenes.iter().flat_map(|SceneCost { scene, asked, .. }| {
        asked.iter().flat_map(move |asked| singly(scene, asked))
    });
    let answer =
        Answer::default().list(scenes.iter().map(document).collect()).csv(&cost_columns(), each);
    scenes.iter().fold(answer, |answer, SceneCost { scene, formulas, asked }| {
        let opening = asked.iter().take(1).flat_map(|asked| singly(scene, asked));
        let all = asked.iter().map(|asked| AskedRow { scene, asked, question: None });
        let by_formulas = format!("by formulas: {}", formulas.join(", "));
        answer
            .lines([format!("{}: {}", scene.name, scene.title)])
            .table(cost_columns().table(opening.chain(all)).unbroken(None))
            .lines((!formulas.is_empty()).then_some(by_formulas))
    })
}

fn document(found: &SceneCost) -> Document {
    let [opening, steps @ ..] = found.asked.as_slice() else { return Document::default() };
    let step = |step: &QuestionBatch| {
        let (cost, seconds) = sum(&step.questions);
        Document::of("parameter", step.after)
            .with("recomputed", step.questions.iter().map(|it| it.topic).collect::<Vec<_>>())
            .with("reused", &step.reused)
            .with("evaluations", cost.evaluations)
            .with("steps", cost.steps)
            .with("seconds", seconds)
    };
    let (cost, seconds) = sum(&opening.questions);
    Document::of("scene", &found.scene.name)
        .with("questions", &opening.questions)
        .with("formulas", &found.formulas)
        .with("evaluations", cost.evaluations)
        .with("seconds", seconds)
        .with("steps", steps.iter().map(step).collect::<Vec<_>>())
}

/// What a scene asks at once, and of that a question or, without one, all of it.
struct AskedRow<'a> {
    scene: &'a Scene,
    asked: &'a QuestionBatch,
    question: Option<&'a QuestionCost>,
}

impl AskedRow<'_> {
    fn cost(&self) -> (Cost, f64) {
        sum(self.question.map_or(&self.asked.questions, std::slice::from_ref))
    }

    fn what(&self) -> String {
        match (self.question, self.asked.after) {
            (Some(question), _) => question.topic.name().to_owned(),
            (None, OPENING) => "all of it".to_owned(),
            (None, number) => format!("a step of {number}"),
        }
    }

    fn remark(&self) -> String {
        let QuestionBatch { after, questions, reused } = self.asked;
        let anew: Vec<Topic> = questions.iter().map(|asked| asked.topic).collect();
        match self.question {
            Some(question) => format!("for {}", question.layers.join(", ")),
            None if *after == OPENING => String::new(),
            None => consequence(reused, &anew),
        }
    }
}

fn singly<'a>(scene: &'a Scene, asked: &'a QuestionBatch) -> impl Iterator<Item = AskedRow<'a>> {
    asked.questions.iter().map(move |question| AskedRow { scene, asked, question: Some(question) })
}

fn cost_columns<'a>() -> Columns<'a, AskedRow<'a>> {
    Columns::default()
        .file("scene", |row: &AskedRow| row.scene.name.clone())
        .file("after", |row| row.asked.after)
        .file("question", |row| row.question.map(|asked| asked.topic))
        .text("question", AskedRow::what)
        .fields(&Cost::default(), |row| Some(row.cost().0))
        .text("evaluations", |row| count(row.cost().0.evaluations))
        .text("steps", |row| count(row.cost().0.steps))
        .number("seconds", Quantity::of("s", 2), |row| row.cost().1)
        .text("", AskedRow::remark)
}
