//! What scenes require, in every form of output: the questions of their layers, and what a step of each
//! number asks again.

use std::sync::Arc;

use serde::Serialize;

use super::csv::Sheet;
use super::table::Table;
use crate::flow::Cost;
use crate::scene::{Layer, Scene, Topic};
use crate::session::requirement::named;
use crate::words::number::{count, duration};

/// A question that was answered, and its price.
#[derive(Clone, Debug)]
pub struct Question {
    pub topic: Topic,
    /// The layers that draw the answer.
    pub layers: Vec<Layer>,
    /// What it cost, counted.
    pub cost: Cost,
    pub seconds: f64,
}

/// What a step of a number costs.
#[derive(Clone, Debug)]
pub struct StepCost {
    pub name: &'static str,
    /// What was asked again.
    pub recomputed: Vec<Question>,
    /// What stayed as it was.
    pub reused: Vec<Topic>,
}

#[derive(Clone, Debug)]
pub struct SceneCost {
    pub scene: Arc<Scene>,
    /// The questions with which it opens.
    pub questions: Vec<Question>,
    /// The layers that formulas draw.
    pub formulas: Vec<Layer>,
    /// What a step of each of its numbers costs.
    pub steps: Vec<StepCost>,
}

#[derive(Serialize)]
struct QuestionDocument {
    question: &'static str,
    layers: Vec<&'static str>,
    evaluations: u64,
    steps: u64,
    rejected: u64,
    seconds: f64,
}

#[derive(Serialize)]
struct StepDocument {
    parameter: &'static str,
    recomputed: Vec<&'static str>,
    reused: Vec<&'static str>,
    evaluations: u64,
    steps: u64,
    seconds: f64,
}

#[derive(Serialize)]
struct SceneDocument<'a> {
    scene: &'a str,
    questions: Vec<QuestionDocument>,
    formulas: Vec<&'static str>,
    evaluations: u64,
    seconds: f64,
    steps: Vec<StepDocument>,
}

fn sum(questions: &[Question]) -> (Cost, f64) {
    questions.iter().fold((Cost::default(), 0.0), |(mut cost, seconds), question| {
        cost += question.cost;
        (cost, seconds + question.seconds)
    })
}

fn layers(layers: &[Layer]) -> Vec<&'static str> {
    layers.iter().map(|layer| layer.spec().name).collect()
}

fn questions(questions: &[Question]) -> Vec<&'static str> {
    questions.iter().map(|question| question.topic.name()).collect()
}

fn topics(topics: &[Topic]) -> Vec<&'static str> {
    topics.iter().map(|topic| topic.name()).collect()
}

/// One document with all scenes.
pub fn json(scenes: &[SceneCost]) -> String {
    let question = |question: &Question| QuestionDocument {
        question: question.topic.name(),
        layers: layers(&question.layers),
        evaluations: question.cost.evaluations,
        steps: question.cost.steps,
        rejected: question.cost.rejected,
        seconds: question.seconds,
    };
    let step = |step: &StepCost| {
        let (cost, seconds) = sum(&step.recomputed);
        StepDocument {
            parameter: step.name,
            recomputed: questions(&step.recomputed),
            reused: topics(&step.reused),
            evaluations: cost.evaluations,
            steps: cost.steps,
            seconds,
        }
    };
    let mut documents = Vec::new();
    for found in scenes {
        let (cost, seconds) = sum(&found.questions);
        documents.push(SceneDocument {
            scene: &found.scene.name,
            questions: found.questions.iter().map(question).collect(),
            formulas: layers(&found.formulas),
            evaluations: cost.evaluations,
            seconds,
            steps: found.steps.iter().map(step).collect(),
        });
    }
    super::json::text(&documents)
}

/// One line for each question of each scene, when it opens and after each step.
pub fn csv(scenes: &[SceneCost]) -> String {
    let mut sheet = Sheet::like(&Row::default(), &[]);
    for found in scenes {
        let steps = found.steps.iter().map(|step| (step.name, &step.recomputed));
        for (after, questions) in std::iter::once(("opening", &found.questions)).chain(steps) {
            for Question { topic, cost, seconds, .. } in questions {
                sheet.row(&Row {
                    scene: &found.scene.name,
                    after,
                    question: topic.name(),
                    cost: *cost,
                    seconds: *seconds,
                });
            }
        }
    }
    sheet.into_text()
}

/// A question of a scene, when it opens or after a step.
#[derive(Default, Serialize)]
struct Row<'a> {
    scene: &'a str,
    after: &'a str,
    question: &'a str,
    #[serde(flatten)]
    cost: Cost,
    seconds: f64,
}

/// To read: one paragraph for each scene.
pub fn table(scenes: &[SceneCost]) -> String {
    let one = |found: &SceneCost| {
        let mut table = Table::new(&["", "evaluations", "steps", "time", ""]);
        let mut row = |what: String, (cost, seconds): (Cost, f64), remark: String| {
            table.row(vec![
                format!("{what:<22}"),
                count(cost.evaluations),
                count(cost.steps),
                duration(seconds),
                remark,
            ]);
        };
        for question in &found.questions {
            let price = (question.cost, question.seconds);
            let remark = format!("for {}", layers(&question.layers).join(", "));
            row(question.topic.name().to_owned(), price, remark);
        }
        row("all of it".to_owned(), sum(&found.questions), String::new());
        for step in &found.steps {
            let part = |name: &str, topics: &[Topic]| {
                (!topics.is_empty()).then(|| format!("{name} {}", named(topics)))
            };
            let again: Vec<Topic> = step.recomputed.iter().map(|asked| asked.topic).collect();
            let again = part("recomputes", &again);
            let kept = part("reuses", &step.reused);
            let remark = again.into_iter().chain(kept).collect::<Vec<_>>().join("; ");
            row(format!("a step of {}", step.name), sum(&step.recomputed), remark);
        }
        let formulas = match &found.formulas[..] {
            [] => String::new(),
            formulas => format!("by formulas: {}\n", layers(formulas).join(", ")),
        };
        format!("{}: {}\n{table}{formulas}", found.scene.name, found.scene.title)
    };
    scenes.iter().map(one).collect::<Vec<_>>().join("\n")
}
