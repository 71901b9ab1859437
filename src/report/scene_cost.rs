//! The cost of scenes, in every form of output: the questions of their layers, and those that a step of each
//! number repeats.

use std::sync::Arc;

use serde::Serialize;

use super::csv::CsvSheet;
use super::table::Table;
use crate::flow::Cost;
use crate::scene::{Scene, Topic};
use crate::session::requirement::named;
use crate::words::number::{count, duration};

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

#[derive(Serialize)]
struct StepDocument<'a> {
    parameter: &'static str,
    recomputed: Vec<Topic>,
    reused: &'a [Topic],
    evaluations: u64,
    steps: u64,
    seconds: f64,
}

#[derive(Serialize)]
struct SceneCostDocument<'a> {
    scene: &'a str,
    questions: &'a [QuestionCost],
    formulas: &'a [&'static str],
    evaluations: u64,
    seconds: f64,
    steps: Vec<StepDocument<'a>>,
}

fn sum(questions: &[QuestionCost]) -> (Cost, f64) {
    questions.iter().fold((Cost::default(), 0.0), |(mut cost, seconds), question| {
        cost += question.cost;
        (cost, seconds + question.seconds)
    })
}

/// One document with all scenes.
pub fn json(scenes: &[SceneCost]) -> String {
    super::json::text(&scenes.iter().map(SceneCostDocument::from).collect::<Vec<_>>())
}

impl<'a> From<&'a SceneCost> for SceneCostDocument<'a> {
    fn from(found: &'a SceneCost) -> Self {
        let (cost, seconds) = sum(&found.questions);
        SceneCostDocument {
            scene: &found.scene.name,
            questions: &found.questions,
            formulas: &found.formulas,
            evaluations: cost.evaluations,
            seconds,
            steps: found.steps.iter().map(StepDocument::from).collect(),
        }
    }
}

impl<'a> From<&'a StepCost> for StepDocument<'a> {
    fn from(StepCost { name, recomputed, reused }: &'a StepCost) -> Self {
        let (cost, seconds) = sum(recomputed);
        StepDocument {
            parameter: name,
            recomputed: recomputed.iter().map(|question| question.topic).collect(),
            reused,
            evaluations: cost.evaluations,
            steps: cost.steps,
            seconds,
        }
    }
}

/// One line for each question of each scene, when it opens and after each step.
pub fn csv(scenes: &[SceneCost]) -> String {
    let question = &QuestionCost {
        topic: Topic::Trajectory,
        layers: Vec::new(),
        cost: Cost::default(),
        seconds: 0.0,
    };
    let mut sheet = CsvSheet::like(&SceneCostRow { scene: "", after: "", question }, &[]);
    for found in scenes {
        let steps = found.steps.iter().map(|step| (step.name, &step.recomputed));
        for (after, questions) in std::iter::once(("opening", &found.questions)).chain(steps) {
            for question in questions {
                sheet.row(&SceneCostRow { scene: &found.scene.name, after, question });
            }
        }
    }
    sheet.into_text()
}

/// A question of a scene, when it opens or after a step.
#[derive(Serialize)]
struct SceneCostRow<'a> {
    scene: &'a str,
    after: &'a str,
    #[serde(flatten)]
    question: &'a QuestionCost,
}

/// As readable text: one table for each scene.
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
            let remark = format!("for {}", question.layers.join(", "));
            row(question.topic.name().to_owned(), price, remark);
        }
        row("all of it".to_owned(), sum(&found.questions), String::new());
        for step in &found.steps {
            let part = |name: &str, topics: &[Topic]| {
                (!topics.is_empty()).then(|| format!("{name} {}", named(topics, ", ")))
            };
            let again: Vec<Topic> = step.recomputed.iter().map(|asked| asked.topic).collect();
            let again = part("recomputes", &again);
            let kept = part("reuses", &step.reused);
            let remark = again.into_iter().chain(kept).collect::<Vec<_>>().join("; ");
            row(format!("a step of {}", step.name), sum(&step.recomputed), remark);
        }
        let formulas = match &found.formulas[..] {
            [] => String::new(),
            formulas => format!("by formulas: {}\n", formulas.join(", ")),
        };
        format!("{}: {}\n{table}{formulas}", found.scene.name, found.scene.title)
    };
    scenes.iter().map(one).collect::<Vec<_>>().join("\n")
}
