//! The costs of a scene: the questions that its layers ask, and which of them must be asked again after a step.

use crate::scene::{Layer, Request, Topic};
use crate::session::state::{List, Row, Session};

/// A question and the layers for which it is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    pub request: Request,
    /// The layers that draw its answer.
    pub layers: Vec<Layer>,
}

/// A row of the list of costs.
#[derive(Clone, Debug, PartialEq)]
pub enum CostRow {
    /// A question that is asked at present.
    Asked(Requirement),
    /// Layers that are drawn by formulas.
    Formulas(Vec<Layer>),
    /// A step of this row: the topics of the questions that stay the same, and of those that are asked again.
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

    /// The questions for what is on show, each once, with the layers that need it.
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

    /// The layers on show that are drawn by formulas and need no answer.
    pub fn drawn_by_formulas(&self) -> Vec<Layer> {
        let shown = self.layers.iter().filter(|layer| self.shows(**layer));
        shown.filter(|layer| layer.spec().needs.is_none()).copied().collect()
    }

    /// The questions after a step of this row: first those that are asked at present, too, then the new ones.
    pub fn after_a_step(&self, row: Row) -> (Vec<Request>, Vec<Request>) {
        let asked = |session: &Session| -> Vec<Request> {
            session.requirements().into_iter().map(|requirement| requirement.request).collect()
        };
        let present = asked(self);
        asked(&self.stepped_once(row)).into_iter().partition(|request| present.contains(request))
    }
}

/// The names of topics as they first occur, with a count for those that occur several times.
pub fn named(topics: &[Topic], between: &str) -> String {
    let mut counted: Vec<(Topic, usize)> = Vec::new();
    for topic in topics {
        match counted.iter_mut().find(|(known, _)| known == topic) {
            Some((_, count)) => *count += 1,
            None => counted.push((*topic, 1)),
        }
    }
    let named = counted.into_iter().map(|(topic, count)| match count {
        1 => topic.name().to_owned(),
        _ => format!("{} x{count}", topic.name()),
    });
    named.collect::<Vec<_>>().join(between)
}
