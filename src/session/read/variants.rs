//! Plots that show several variants of the present problem, drawn over each other.
//!
//! A variant holds some values; the others follow the keys.

use std::collections::BTreeMap;

use crate::branch::Branch;
use crate::flow::Problem;
use crate::model::Knob;
use crate::question;
use crate::scene::{Answer, Height, Request, Topic, Variant};
use crate::session::state::{AnswerState, Session};

/// A motion that a plot shows, and what distinguishes it from the others there.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownMotion {
    /// The held values that distinguish it; empty if the plot shows only the present motion.
    pub label: String,
    pub problem: Problem,
    /// Whether nothing is held, so that it is the present motion.
    pub present: bool,
}

impl Session {
    /// The variants that a plot shows in place of the present problem, if any.
    pub fn variants(&self, plot: usize) -> Option<&[Variant]> {
        let family = self.plots.get(plot)?.family?;
        self.scene.families.get(family).map(Vec::as_slice)
    }

    /// The problems that a plot shows: the present one, or its variants.
    pub fn shown(&self, plot: usize) -> Vec<ShownMotion> {
        let present =
            || vec![ShownMotion { label: String::new(), problem: self.problem, present: true }];
        let variant = |(variant, label): (&Variant, String)| ShownMotion {
            label,
            problem: variant.of(self.problem),
            present: variant.held.is_empty(),
        };
        let labelled = |all: &[Variant]| {
            all.iter().zip(labels(all, &self.problem, false)).map(variant).collect::<Vec<_>>()
        };
        self.variants(plot).map_or_else(present, labelled)
    }

    /// The parameters that all variants of a plot hold at the same values, as text that needs to be given only
    /// once.
    pub fn held_alike(&self, plot: usize) -> String {
        let Some(all) = self.variants(plot) else { return String::new() };
        let held = all.iter().take(1).flat_map(|variant| &variant.held);
        text(held.filter(|(symbol, value)| symbol.is_parameter() && alike(all, **symbol, **value)))
    }

    /// The answers on this topic for the problems that a plot shows, stale or not, each with its index among
    /// these and its held values.
    pub fn found(&self, topic: Topic, plot: usize) -> Vec<(usize, String, &Answer)> {
        let starts = topic == Topic::Trajectory;
        let labels = self.variants(plot).map(|all| labels(all, &self.problem, starts));
        let label = |index: usize| labels.as_ref()?.get(index).cloned();
        let found = self.answers_for_each(topic, plot);
        found.map(|(index, answer)| (index, label(index).unwrap_or_default(), answer)).collect()
    }

    /// The answers without the held values.
    fn answers_for_each(
        &self,
        topic: Topic,
        plot: usize,
    ) -> impl Iterator<Item = (usize, &Answer)> {
        let asked = self.requests(topic, plot).into_iter();
        asked
            .filter_map(|(index, request)| Some((index, self.answers.standing(&request).answer()?)))
    }

    /// The branches computed last over the parameter of a diagram, stale or not, each with its index among the
    /// problems that the plot shows.
    pub fn branches(&self, plot: usize) -> Vec<(usize, &Branch)> {
        let over = self.plots.get(plot).map(|plot| plot.axes.abscissa);
        self.answers_for_each(Topic::Branch, plot)
            .filter_map(|(index, answer)| match answer {
                Answer::Branch(found) if Some(found.parameter) == over => Some((index, found)),
                _ => None,
            })
            .collect()
    }

    /// The measure of heights for the cycles of a variant in a diagram, at the friction of the branch on show,
    /// stale or not.
    pub fn height(&self, plot: usize, variant: usize) -> Height {
        let asked = self.requests(Topic::Branch, plot).into_iter();
        let asked = asked.into_iter().find(|(index, _)| *index == variant);
        let standing = asked.map(|(_, request)| self.answers.standing(&request));
        let answered = standing.and_then(AnswerState::answered);
        let friction = match answered.map(|found| &found.request) {
            Some(Request::Branch(question::branch::Inputs { parameters, .. })) => parameters.r,
            _ => self.problem.parameters.r,
        };
        self.plots.get(plot).map(|plot| plot.axes).unwrap_or_default().height(friction)
    }
}

/// Labels that distinguish variants: the parameters that they do not all hold at the same values and, if
/// `starts`, also the starts of the motions. A variant that holds nothing has the present values.
fn labels(all: &[Variant], present: &Problem, starts: bool) -> Vec<String> {
    let tells =
        |symbol: Knob, value: f64| (starts || symbol.is_parameter()) && !alike(all, symbol, value);
    let held = all.iter().flat_map(|variant| variant.held.keys());
    let now: BTreeMap<Knob, f64> = held.map(|symbol| (*symbol, present.get(*symbol))).collect();
    let label = |variant: &Variant| {
        let values = if variant.held.is_empty() { &now } else { &variant.held };
        text(values.iter().filter(|(symbol, value)| tells(**symbol, **value)))
    };
    all.iter().map(label).collect()
}

/// Whether all of these variants hold this value.
fn alike(all: &[Variant], symbol: Knob, value: f64) -> bool {
    all.iter().all(|variant| variant.held.get(&symbol) == Some(&value))
}

fn text<'a>(held: impl Iterator<Item = (&'a Knob, &'a f64)>) -> String {
    held.map(|(symbol, value)| format!("{symbol} = {value}")).collect::<Vec<_>>().join(", ")
}
