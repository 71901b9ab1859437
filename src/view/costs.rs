//! The list of costs: what each question of the picture took, and what a step of each number asks again.

use super::content::ListContent;
use super::look::Look;
use crate::picture::role::Role;
use crate::scene::{Answered, Layer, Topic};
use crate::session::wants::{CostRow, Requirement, named};
use crate::session::{AnswerState, List, Session};
use crate::words::number::{count, duration};

/// Columns of what a row is about.
const NAME: usize = 14;

pub(super) fn content(session: &Session, list: &List, look: &Look) -> ListContent {
    let mut content = ListContent::new("what the picture costs");
    for row in session.cost_rows(list) {
        if matches!(row, CostRow::Step(..)) {
            content.group("a step of");
        }
        let (name, text) = match row {
            CostRow::Asked(requirement) => asked(session, &requirement),
            CostRow::Formulas(layers) => ("formulas", format!("nothing for {}", names(&layers))),
            CostRow::Step(row, reused, anew) => {
                (row.name_in(&session.problem), consequence(&reused, &anew))
            }
        };
        let name = format!("{name:<NAME$}");
        content.row([look.span(name, Role::Key), look.span(text, Role::Text)]);
    }
    content
}

fn names(layers: &[Layer]) -> String {
    layers.iter().map(|layer| layer.spec().name).collect::<Vec<_>>().join(", ")
}

/// What a question took, and for which layers it is asked.
fn asked(session: &Session, requirement: &Requirement) -> (&'static str, String) {
    let topic = requirement.request.topic();
    let held = match session.answers.standing(&requirement.request) {
        AnswerState::Fresh(held) => Some(held),
        _ => None,
    };
    let price = held.map_or_else(|| "not answered".to_owned(), price);
    (topic.name(), format!("{price} for {}", names(&requirement.layers)))
}

fn price(answered: &Answered) -> String {
    let cost = answered.result.as_ref().map(crate::scene::Answer::cost).unwrap_or_default();
    let (evaluations, steps) = (count(cost.evaluations), count(cost.steps));
    format!("{evaluations:>6} ev {steps:>6} steps {:>8}", duration(answered.seconds))
}

/// What a step recomputes and what it reuses.
fn consequence(reused: &[Topic], anew: &[Topic]) -> String {
    let part = |name: &str, topics: &[Topic]| {
        (!topics.is_empty()).then(|| format!("{name} {}", named(topics, ", ")))
    };
    let parts = part("recomputes", anew).into_iter().chain(part("reuses", reused));
    let parts: Vec<_> = parts.collect();
    if parts.is_empty() { "nothing is asked".to_owned() } else { parts.join("; ") }
}
