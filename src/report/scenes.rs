//! The list of scenes, and what they cost: the questions of their layers, and those that a step of each number repeats.

use std::sync::Arc;

use serde::Serialize;

use super::{Answer, Columns, Document, Quantity};
use crate::flow::Cost;
use crate::scene::said::said_by;
use crate::scene::{Scene, Topic};
use crate::session::Keymap;
use crate::session::wants::named;
use crate::words::number::count;

/// A name of a scene, and the scene.
type SceneRow<'a> = (&'a str, &'a Scene);

fn columns<'a>() -> Columns<'a, SceneRow<'a>> {
    let keymap = Keymap::default();
    let sentence =
        move |scene: &Scene, text: &str| keymap.fill(&said_by(scene, text), |key| key.to_string());
    let press = sentence.clone();
    Columns::default()
        .word("name", |(name, _): &SceneRow| (*name).to_owned())
        .word("title", |(_, scene)| scene.title.clone())
        .field("look", move |(_, scene)| sentence(scene, &scene.watch))
        .field("press", move |(_, scene)| press(scene, &scene.press))
        .field("parameters", |(_, scene)| scene.problem.parameters)
        .field("initial", |(_, scene)| scene.problem.initial)
        .field("until", |(_, scene)| scene.problem.until)
}

/// Every scene: one row for each of its names.
pub fn scenes(scenes: &[Arc<Scene>]) -> Answer<'_> {
    let scenes = scenes.iter().map(AsRef::as_ref);
    let rows = scenes.flat_map(|scene: &Scene| scene.names().map(move |name| (name, scene)));
    Answer::list_of(columns(), rows.collect())
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

/// The costs of scenes: in rows one line for each question of each scene, when it opens and after each step; in text
/// one table for each scene.
pub fn costs(scenes: &[SceneCost]) -> Answer<'_> {
    let asked = scenes.iter().flat_map(|found| {
        let opening = found.questions.iter().map(|one| AskedRow::of_question(found, one));
        let steps = found.steps.iter().flat_map(|step| {
            let again = step.recomputed.chunks(1);
            again.map(|asked| AskedRow::after(found, step, asked))
        });
        opening.chain(steps)
    });
    let answer = Answer::default()
        .array(move || scenes.iter().map(document).collect::<Vec<_>>())
        .csv(cost_columns(), asked);
    scenes.iter().fold(answer, |answer, found| {
        let opening = found.questions.iter().map(|one| AskedRow::of_question(found, one));
        let steps = found.steps.iter().map(|step| AskedRow::after(found, step, &step.recomputed));
        let formulas = format!("by formulas: {}", found.formulas.join(", "));
        answer
            .lines([format!("{}: {}", found.scene.name, found.scene.title)])
            .captioned("", || {
                cost_columns()
                    .table(opening.chain([AskedRow::of_all(found)]).chain(steps))
                    .unbroken()
            })
            .lines((!found.formulas.is_empty()).then_some(formulas))
    })
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

/// Questions of a scene that are answered together.
struct AskedRow<'a> {
    scene: &'a str,
    after: &'static str,
    asked: &'a [QuestionCost],
    what: String,
    remark: String,
}

impl<'a> AskedRow<'a> {
    fn of_question(found: &'a SceneCost, question: &'a QuestionCost) -> Self {
        AskedRow {
            asked: std::slice::from_ref(question),
            what: question.topic.name().to_owned(),
            remark: format!("for {}", question.layers.join(", ")),
            ..Self::of_all(found)
        }
    }

    /// All that a scene asks when it opens.
    fn of_all(found: &'a SceneCost) -> Self {
        let what = "all of it".to_owned();
        let (scene, asked) = (&found.scene.name, &found.questions);
        AskedRow { scene, after: "opening", asked, what, remark: String::new() }
    }

    /// Some of what a step asks again.
    fn after(found: &'a SceneCost, step: &'a StepCost, asked: &'a [QuestionCost]) -> Self {
        let part = |name: &str, topics: &[Topic]| {
            (!topics.is_empty()).then(|| format!("{name} {}", named(topics, ", ")))
        };
        let again: Vec<Topic> = asked.iter().map(|asked| asked.topic).collect();
        let [again, kept] = [part("recomputes", &again), part("reuses", &step.reused)];
        let remark = again.into_iter().chain(kept).collect::<Vec<_>>().join("; ");
        let what = format!("a step of {}", step.name);
        AskedRow { after: step.name, asked, what, remark, ..Self::of_all(found) }
    }
}

fn cost_columns<'a>() -> Columns<'a, AskedRow<'a>> {
    let cost = |row: &AskedRow| sum(row.asked).0;
    Columns::default()
        .file("scene", |row: &AskedRow| row.scene.to_owned())
        .file("after", |row| row.after)
        .file("question", |row| row.asked.first().map(|asked| asked.topic))
        .text("question", |row| row.what.clone())
        .fields(&Cost::default(), move |row| Some(cost(row)))
        .text("evaluations", move |row| count(cost(row).evaluations))
        .text("steps", move |row| count(cost(row).steps))
        .number("seconds", Quantity::of("s", 2), |row| sum(row.asked).1)
        .titled("time")
        .text("", |row| row.remark.clone())
}
