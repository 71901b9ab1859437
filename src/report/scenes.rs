//! The list of scenes, and what they cost: the questions of their layers, and those that a step of each number repeats.

use std::sync::Arc;

use serde::Serialize;

use super::{Answer, Columns, Document, Quantity};
use crate::flow::Cost;
use crate::scene::said::said_by;
use crate::scene::{Scene, Topic};
use crate::session::Keymap;
use crate::session::wants::consequence;
use crate::words::number::count;

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

/// What a scene asks at once.
#[derive(Clone, Debug)]
pub struct AskedTogether {
    /// [`OPENING`], or the name of a number after whose step it asks.
    pub after: &'static str,
    pub questions: Vec<QuestionCost>,
    /// The questions whose answers did not change.
    pub reused: Vec<Topic>,
}

/// Names what a scene asks when it opens.
pub const OPENING: &str = "opening";

#[derive(Clone, Debug)]
pub struct SceneCost {
    pub scene: Arc<Scene>,
    /// The names of the layers that are drawn from formulas, without a question.
    pub formulas: Vec<&'static str>,
    pub opening: AskedTogether,
    /// What it asks again after a step of each of its numbers.
    pub steps: Vec<AskedTogether>,
}

impl SceneCost {
    fn asked(&self) -> impl Iterator<Item = &AskedTogether> {
        std::iter::once(&self.opening).chain(&self.steps)
    }
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
    let each = |found| SceneCost::asked(found).flat_map(move |asked| singly(found, asked));
    let answer = Answer::default()
        .list(scenes.iter().map(document).collect())
        .csv(&cost_columns(), scenes.iter().flat_map(each));
    scenes.iter().fold(answer, |answer, found| {
        let opening = singly(found, &found.opening);
        let all = found.asked().map(|asked| AskedRow::new(found, asked, None));
        let formulas = format!("by formulas: {}", found.formulas.join(", "));
        answer
            .lines([format!("{}: {}", found.scene.name, found.scene.title)])
            .table(cost_columns().table(opening.chain(all)).unbroken(None))
            .lines((!found.formulas.is_empty()).then_some(formulas))
    })
}

fn document(found: &SceneCost) -> Document {
    let step = |step: &AskedTogether| {
        let (cost, seconds) = sum(&step.questions);
        Document::default()
            .with("parameter", step.after)
            .with("recomputed", step.questions.iter().map(|it| it.topic).collect::<Vec<_>>())
            .with("reused", &step.reused)
            .with("evaluations", cost.evaluations)
            .with("steps", cost.steps)
            .with("seconds", seconds)
    };
    let (cost, seconds) = sum(&found.opening.questions);
    Document::default()
        .with("scene", &found.scene.name)
        .with("questions", &found.opening.questions)
        .with("formulas", &found.formulas)
        .with("evaluations", cost.evaluations)
        .with("seconds", seconds)
        .with("steps", found.steps.iter().map(step).collect::<Vec<_>>())
}

/// What a scene asks at once, and of that a question or, without one, all of it; with what that costs.
struct AskedRow<'a> {
    found: &'a SceneCost,
    asked: &'a AskedTogether,
    question: Option<&'a QuestionCost>,
    cost: Cost,
    seconds: f64,
}

impl<'a> AskedRow<'a> {
    fn new(
        found: &'a SceneCost,
        asked: &'a AskedTogether,
        question: Option<&'a QuestionCost>,
    ) -> Self {
        let (cost, seconds) = sum(question.map_or(&asked.questions, std::slice::from_ref));
        AskedRow { found, asked, question, cost, seconds }
    }

    fn what(&self) -> String {
        match (self.question, self.asked.after) {
            (Some(question), _) => question.topic.name().to_owned(),
            (None, OPENING) => "all of it".to_owned(),
            (None, number) => format!("a step of {number}"),
        }
    }

    fn remark(&self) -> String {
        let AskedTogether { after, questions, reused } = self.asked;
        let anew: Vec<Topic> = questions.iter().map(|asked| asked.topic).collect();
        match self.question {
            Some(question) => format!("for {}", question.layers.join(", ")),
            None if *after == OPENING => String::new(),
            None => consequence(reused, &anew),
        }
    }
}

fn singly<'a>(
    found: &'a SceneCost,
    asked: &'a AskedTogether,
) -> impl Iterator<Item = AskedRow<'a>> {
    asked.questions.iter().map(|question| AskedRow::new(found, asked, Some(question)))
}

fn cost_columns<'a>() -> Columns<'a, AskedRow<'a>> {
    Columns::default()
        .file("scene", |row: &AskedRow| row.found.scene.name.clone())
        .file("after", |row| row.asked.after)
        .file("question", |row| row.question.map(|asked| asked.topic))
        .text("question", AskedRow::what)
        .fields(&Cost::default(), |row| Some(row.cost))
        .text("evaluations", |row| count(row.cost.evaluations))
        .text("steps", |row| count(row.cost.steps))
        .number("seconds", Quantity::of("s", 2), |row| row.seconds)
        .text("", AskedRow::remark)
}
