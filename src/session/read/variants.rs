//! Plots that show several variants of the present problem, one picture over another.
//!
//! A variant holds some values, the others follow the keys. What a plot of this kind needs is one
//! question for each kind of answer that its layers draw, with a member for each variant.

use crate::flow::Problem;
use crate::oscillator::Symbol;
use crate::scene::{Answer, Height, Request, Slot, Variant};
use crate::session::state::session::Session;
use crate::study::Branch;

/// A motion that a plot shows, and what tells it from the others there.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// The values that are held; empty for the present motion.
    pub label: String,
    /// The motion.
    pub problem: Problem,
}

impl Session {
    /// The variants that a plot shows in place of the present problem.
    #[must_use]
    pub fn variants(&self, plot: usize) -> Option<&[Variant]> {
        let family = self.plots.get(plot)?.family?;
        self.scene.families.get(family).map(Vec::as_slice)
    }

    /// What a plot shows: the present problem, or its variants.
    #[must_use]
    pub fn shown(&self, plot: usize) -> Vec<Shown> {
        let present = || vec![Shown { label: String::new(), problem: self.problem }];
        let variant = |(variant, label): (&Variant, String)| Shown {
            label,
            problem: variant.of(self.problem),
        };
        let labelled =
            |all: &[Variant]| all.iter().zip(labels(all, false)).map(variant).collect::<Vec<_>>();
        self.variants(plot).map_or_else(present, labelled)
    }

    /// The parameters that all variants of a plot hold alike, as text: what can be said of it once.
    #[must_use]
    pub fn held_alike(&self, plot: usize) -> String {
        let Some(all) = self.variants(plot) else { return String::new() };
        let held = all.iter().take(1).flat_map(|variant| &variant.held);
        text(held.filter(|(symbol, value)| is_parameter(**symbol) && alike(all, **symbol, **value)))
    }

    /// The last answers of a kind, as a plot has them, stale or not; each with its place among what the plot
    /// shows, and the values that are held.
    #[must_use]
    pub fn found(&self, slot: Slot, plot: usize) -> Vec<(usize, String, &Answer)> {
        let labels = self.variants(plot).map(|all| labels(all, slot == Slot::Trajectory));
        let label = |index: usize| match &labels {
            Some(labels) => labels.get(index).cloned(),
            None => Some(String::new()),
        };
        let numbered = self.numbered(slot, plot).into_iter();
        numbered.filter_map(|(index, answer)| Some((index, label(index)?, answer))).collect()
    }

    /// The same, each with its place among what the plot shows.
    fn numbered(&self, slot: Slot, plot: usize) -> Vec<(usize, &Answer)> {
        match self.answer(self.slot_in(slot, plot), plot) {
            Some(Answer::Family(answers)) => {
                let numbered = answers.iter().enumerate();
                numbered
                    .filter_map(|(index, answer)| Some((index, answer.as_ref().ok()?)))
                    .collect()
            }
            answer => answer.map(|answer| (0, answer)).into_iter().collect(),
        }
    }

    /// The last branches computed over the parameter of a diagram, stale or not; each with its place
    /// among what the plot shows.
    #[must_use]
    pub fn branches(&self, plot: usize) -> Vec<(usize, &Branch)> {
        let over = self.plots.get(plot).map(|plot| plot.axes.abscissa);
        let found = self.numbered(Slot::Branch, plot).into_iter();
        found
            .filter_map(|(index, answer)| match answer {
                Answer::Branch(found) if Some(found.parameter) == over => Some((index, found)),
                _ => None,
            })
            .collect()
    }

    /// How high the cycles of a variant stand in a diagram, at the friction of the branch on show, stale or
    /// not.
    #[must_use]
    pub fn height(&self, plot: usize, variant: usize) -> Height {
        let answered = self.answered(self.slot_in(Slot::Branch, plot), plot);
        let asked = match answered.map(|held| &held.request) {
            Some(Request::Family { members, .. }) => members.get(variant),
            request => request,
        };
        let friction = match asked {
            Some(Request::Branch { parameters, .. }) => parameters.r,
            _ => self.problem.parameters.r,
        };
        self.plots.get(plot).map(|plot| plot.axes).unwrap_or_default().height(friction)
    }

    /// The kind of question that a plot asks where a layer needs answers of this kind.
    pub(in crate::session) fn slot_in(&self, slot: Slot, plot: usize) -> Slot {
        let of_variants = self.variants(plot).and_then(|_| slot.of_variants());
        of_variants.unwrap_or(slot)
    }

    /// The question of a kind for each variant of a plot.
    pub(in crate::session) fn request_for_each(
        &self,
        slot: Slot,
        one: Slot,
        plot: usize,
    ) -> Option<Request> {
        let variants = self.variants(plot)?.iter();
        let members = variants.map(|variant| self.request_for(one, plot, variant.of(self.problem)));
        Some(Request::Family { slot, members: members.collect::<Option<_>>()? })
    }
}

/// What tells each of some variants from the others: the parameters that they do not hold alike, and
/// where motions are meant, from where they start.
fn labels(all: &[Variant], starts: bool) -> Vec<String> {
    let tells =
        |symbol: Symbol, value: f64| (starts || is_parameter(symbol)) && !alike(all, symbol, value);
    let label = |variant: &Variant| {
        text(variant.held.iter().filter(|(symbol, value)| tells(**symbol, **value)))
    };
    all.iter().map(label).collect()
}

/// Whether all of some variants hold this value.
fn alike(all: &[Variant], symbol: Symbol, value: f64) -> bool {
    all.iter().all(|variant| variant.held.get(&symbol) == Some(&value))
}

fn is_parameter(symbol: Symbol) -> bool {
    !matches!(symbol, Symbol::Q0 | Symbol::V0)
}

fn text<'a>(held: impl Iterator<Item = (&'a Symbol, &'a f64)>) -> String {
    held.map(|(symbol, value)| format!("{symbol} = {value}")).collect::<Vec<_>>().join(", ")
}
