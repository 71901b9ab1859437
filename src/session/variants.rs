//! Plots that show several variants of the present problem, one picture over another.
//!
//! A variant holds some values, the others follow the keys. What a plot of this kind needs is one
//! question with a member for each variant and each kind of answer that its layers draw.

use super::state::Session;
use crate::flow::Problem;
use crate::scene::{Answer, Layer, Request, Slot, Variant};

/// The kinds of answers that can be had of each variant.
pub(super) const MEMBERS: [Slot; 3] = [Slot::Trajectory, Slot::Cycles, Slot::Branch];

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
        let variant =
            |variant: &Variant| Shown { label: variant.label(), problem: variant.of(self.problem) };
        self.variants(plot).map_or_else(present, |all| all.iter().map(variant).collect())
    }

    /// The last answers of a kind, as a plot has them, stale or not; each with the values that are held.
    #[must_use]
    pub fn found(&self, slot: Slot, plot: usize) -> Vec<(String, &Answer)> {
        let Some(variants) = self.variants(plot) else {
            return self
                .answer(slot, plot)
                .map(|answer| (String::new(), answer))
                .into_iter()
                .collect();
        };
        let Some(answered) = self.answered(Slot::Family, plot) else { return Vec::new() };
        let (Request::Family(members), Ok(Answer::Family(answers))) =
            (&answered.request, &answered.result)
        else {
            return Vec::new();
        };
        let of_slot = members.iter().zip(answers).filter(|(member, _)| member.slot() == slot);
        let labelled = variants.iter().zip(of_slot);
        labelled
            .filter_map(|(variant, (_, answer))| Some((variant.label(), answer.as_ref().ok()?)))
            .collect()
    }

    /// The questions of a plot with variants.
    pub(super) fn members(&self, plot: usize) -> Option<Vec<Request>> {
        let variants = self.variants(plot)?;
        let needed = |slot: &&Slot| {
            let draws = |layer: &Layer| layer.spec().needs == Some(**slot);
            self.layers.iter().any(|layer| draws(layer) && self.shows_in(*layer, plot))
        };
        let questions = MEMBERS.iter().filter(needed).flat_map(|slot| {
            variants
                .iter()
                .filter_map(|variant| self.request_for(*slot, plot, variant.of(self.problem)))
        });
        Some(questions.collect::<Vec<_>>()).filter(|members| !members.is_empty())
    }
}
