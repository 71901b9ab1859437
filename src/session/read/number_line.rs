//! The number line of the selected row: where its value stands, and where on the branch over it the motions change.

use crate::branch::Special;
use crate::model::Knob;
use crate::scene::{Span, Topic, View};
use crate::session::{Plot, Session, Setup};

/// Steps to either side of the scene's value where no diagram says which values matter.
const STEPS: f64 = 10.0;

/// A line of values of one number.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberLine {
    pub knob: Knob,
    pub value: f64,
    /// The values that it shows: those of the diagram over the number, or those within some steps; and the present one.
    pub range: Span,
    /// The special points in that range; none unless a diagram has been computed for the present values of the others.
    pub special: Vec<Special>,
}

impl Session {
    /// The number line of the selected row; `None` if it is no number.
    pub fn number_line(&self) -> Option<NumberLine> {
        let knob = self.selected.stepped()?;
        let over = |plot: &usize| {
            let Plot { view, axes, .. } = self.plots[*plot];
            match view {
                View::Diagram => axes.abscissa == knob,
                View::BeltDiagram => axes.machine == knob,
                _ => false,
            }
        };
        let plot = self.on_show().find(over);
        let value = self.value(knob);
        let opened = self.value_in(&Setup::of_scene(&self.scene), knob);
        let half = STEPS * self.steps.of(knob).value();
        let near = || Span::new(opened - half, opened + half).ok();
        let shown = plot.map(|plot| self.plots[plot].window.x).or_else(near)?.allowed(knob)?;
        let range = Span::covering([shown.from(), shown.to(), value])?;
        let special = plot.into_iter().flat_map(|plot| self.special(plot)).copied();
        let special = special.filter(|point| range.contains(point.value)).collect();
        Some(NumberLine { knob, value, range, special })
    }

    /// The special points of the branch that a diagram shows for the present values; none while these are computed.
    fn special(&self, plot: usize) -> &[Special] {
        let fresh = |topic| self.is_fresh(topic, plot);
        if self.plots[plot].view == View::BeltDiagram {
            let found = self.machine_branch(plot).filter(|_| fresh(Topic::MachineBranch));
            return found.map_or(&[], |found| &found.special);
        }
        let present = self.shown(plot).iter().position(|shown| shown.present);
        let mut branches = self.branches(plot).into_iter().filter(|_| fresh(Topic::Branch));
        let own = branches.find(|(variant, _)| Some(*variant) == present);
        own.map_or(&[], |(_, branch)| &branch.special)
    }
}
