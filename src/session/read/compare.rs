//! The point that the present one is compared with: what is on show of it, and what must be known of it.

use std::collections::BTreeSet;

use crate::scene::{Layer, Request, Topic, View};
use crate::session::Session;
use crate::words::joined;

/// The topics whose answers are drawn of another point; of it nothing else is asked.
const TOPICS: [Topic; 5] =
    [Topic::Trajectory, Topic::Cycles, Topic::Branch, Topic::MachineBranch, Topic::ReturnMap];

/// The layers that are drawn of a point that was left for a mark.
const GHOST: [Layer; 3] = [Layer::Trajectory, Layer::Cycles, Layer::Whole];

/// Views in which only the present point is drawn.
const ALONE: [View; 4] = [View::Belt, View::EnergyLedger, View::Trade, View::Scan];

impl Session {
    /// The layers that are drawn of the other point.
    pub(crate) fn layers_beside(&self) -> BTreeSet<Layer> {
        let drawn = |layer: &&Layer| match self.marks.pinned {
            Some(_) => layer.spec().needs.is_none_or(|topic| TOPICS.contains(&topic)),
            None => GHOST.contains(layer),
        };
        self.layers.iter().filter(drawn).copied().collect()
    }

    /// The names of the present point and of the pinned one; `None` where none is pinned.
    pub fn letters(&self) -> Option<[&'static str; 2]> {
        self.marks.pinned.map(|pinned| [pinned.other(), pinned].map(Into::into))
    }

    /// The name of the point of this session.
    pub fn letter(&self) -> Option<&'static str> {
        self.letters().map(|[present, _]| present)
    }

    /// The present point and the pinned one, each with its name, A first.
    pub fn sides(&self) -> Option<[(&'static str, &Session); 2]> {
        let [present, pinned] = self.letters()?;
        let mut sides = [(present, self), (pinned, self.other.as_deref()?)];
        sides.sort_by_key(|(letter, _)| *letter);
        Some(sides)
    }

    /// What is written beside the motion in this place: the letter of its point, and its number.
    pub fn tag(&self, place: usize) -> Option<String> {
        let number = self.number(place).map(|number| number.to_string());
        let tag = joined(self.letter().map(str::to_owned).into_iter().chain(number), "");
        Some(tag).filter(|tag| !tag.is_empty())
    }

    /// The session whose point a plot shows beside the present one: a pinned one beside variants only if one of these is
    /// the present one, that of a mark only in a phase plane.
    pub fn beside(&self, plot: usize) -> Option<&Session> {
        let view = self.plots[plot].view;
        let shown = match self.marks.pinned {
            Some(_) => !ALONE.contains(&view) && self.shown(plot).iter().any(|it| it.present),
            None => view == View::Phase && self.variants(plot).is_none(),
        };
        self.other.as_deref().filter(|_| shown)
    }

    /// What the units of the other point are in those of the present one, along both axes of a plot: those of a machine
    /// follow from its numbers.
    pub fn units_beside(&self, plot: usize) -> [f64; 2] {
        let theirs = self.beside(plot).and_then(Session::units);
        let Some((own, theirs)) = self.units().zip(theirs) else { return [1.0; 2] };
        let length = theirs.displacement / own.displacement;
        match self.plots[plot].view {
            View::Phase => [length, theirs.velocity / own.velocity],
            View::TimeSeries => [theirs.time / own.time, length],
            View::ReturnMap => [length; 2],
            _ => [1.0; 2],
        }
    }

    /// The questions whose answers a plot draws for the other point.
    pub(crate) fn compared(&self, plot: usize) -> Vec<Request> {
        let mut asked = self.beside(plot).map(|other| other.asked_by(plot)).unwrap_or_default();
        asked.retain(|request| TOPICS.contains(&request.topic()));
        asked
    }
}
