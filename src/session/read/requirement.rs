//! What a scene requires: which questions its layers ask, and which of them a step of a number asks again.

use std::collections::BTreeMap;

use crate::scene::{Layer, Request, Topic};
use crate::session::act::parameters;
use crate::session::state::overlay::List;
use crate::session::state::rows::Row;
use crate::session::state::session::Session;

/// One question of what is on show, and the layers for which it is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    pub request: Request,
    /// The layers that draw its answer.
    pub layers: Vec<Layer>,
}

/// A row of the list of costs.
#[derive(Clone, Debug, PartialEq)]
pub enum CostRow {
    /// A question of what is on show.
    Asked(Requirement),
    /// Layers that formulas draw.
    Formulas(Vec<Layer>),
    /// A step of this row: what the questions are about that it leaves as they are, and asks again.
    Step(Row, Vec<Topic>, Vec<Topic>),
}

impl Session {
    pub fn cost_rows(&self, list: &List) -> Vec<CostRow> {
        let topics = |requests: Vec<Request>| requests.iter().map(Request::topic).collect();
        let asked = self.requirements().into_iter().map(CostRow::Asked);
        let formulas = Some(self.drawn_by_formulas()).filter(|layers| !layers.is_empty());
        let steps = self.rows().into_iter().map(|row| {
            let (reused, recomputed) = self.after_a_step(row);
            CostRow::Step(row, topics(reused), topics(recomputed))
        });
        let name = |row: &CostRow| match row {
            CostRow::Asked(requirement) => requirement.request.topic().name(),
            CostRow::Formulas(_) => "formulas",
            CostRow::Step(row, ..) => row.name(),
        };
        let rows = asked.chain(formulas.map(CostRow::Formulas)).chain(steps);
        rows.filter(|row| list.matches(&[name(row)])).collect()
    }

    /// What is asked for what is on show, each question once, with the layers that need it.
    pub fn requirements(&self) -> Vec<Requirement> {
        let mut found: Vec<Requirement> = Vec::new();
        for plot in self.on_show() {
            let layers = self.layers.iter().filter(|layer| self.shows_in(**layer, plot));
            for layer in layers {
                let topic = layer.spec().needs;
                let each = topic.map(|topic| self.requests(topic, plot)).unwrap_or_default();
                for (_, request) in each {
                    match found.iter_mut().find(|requirement| requirement.request == request) {
                        Some(known) if known.layers.contains(layer) => {}
                        Some(known) => known.layers.push(*layer),
                        None => found.push(Requirement { request, layers: vec![*layer] }),
                    }
                }
            }
        }
        found.sort_by_key(|requirement| requirement.request.topic());
        found
    }

    /// The layers on show that need no answer: formulas draw them.
    pub fn drawn_by_formulas(&self) -> Vec<Layer> {
        let shown = self.layers.iter().filter(|layer| self.shows(**layer));
        shown.filter(|layer| layer.spec().needs.is_none()).copied().collect()
    }

    /// The present questions that a step of this row would leave as they are, and those that it would
    /// ask again.
    pub fn after_a_step(&self, row: Row) -> (Vec<Request>, Vec<Request>) {
        let mut stepped = self.clone();
        stepped.selected = row;
        // At the end of a range the step goes the other way.
        for count in [1, -1] {
            if stepped.setup() == self.setup() {
                parameters::step(&mut stepped, count);
            }
        }
        let present: Vec<Request> =
            self.requirements().into_iter().map(|requirement| requirement.request).collect();
        stepped
            .requirements()
            .into_iter()
            .map(|requirement| requirement.request)
            .partition(|request| present.contains(request))
    }
}

/// What questions are about, as text; how many, where there are several about one.
pub fn named(topics: &[Topic]) -> String {
    let mut counted: BTreeMap<Topic, usize> = BTreeMap::new();
    for topic in topics {
        *counted.entry(*topic).or_default() += 1;
    }
    let named = counted.into_iter().map(|(topic, count)| match count {
        1 => topic.name().to_owned(),
        _ => format!("{} x{count}", topic.name()),
    });
    named.collect::<Vec<_>>().join(", ")
}
