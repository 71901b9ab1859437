//! The portrait of a machine by its return map: the fixed points and the jumps of the map cut the line of right turning
//! points into gaps, and the way of one motion in each gap tells the fate of all in it.

use std::cmp::Ordering;

use super::{Divide, Mark, NOTHING};
use crate::flow::{Fate, Flow, Reason, Result};
use crate::model::{ContactState, Model};
use crate::portrait::{Border, Edge, Gap, Portrait, Reach, fixed_points};

impl Portrait {
    /// The portrait of any machine by its return map.
    ///
    /// # Errors
    /// [`Reason`] if the motions near rest, or those that the belt releases, cannot be followed.
    pub fn by_return_map(model: &Model) -> Result<Self> {
        let mut flow = Flow::new(model);
        let landmarks = flow.landmarks()?;
        let mut portrait = Portrait { landmarks, known: 0.0, ..Portrait::blank(model) };
        let marks = fixed_points(&mut flow, &mut portrait)?;
        let ways = ways(&mut flow, &marks, portrait.known)?;
        for (place, (x, divide)) in marks.iter().enumerate() {
            let Divide::Cycle(image) = divide else { continue };
            let attracts = ways[place..place + 2] == [Ok(Ordering::Greater), Ok(Ordering::Less)];
            let stable = image.sticks_from.is_some() || attracts;
            portrait.cycles.push(flow.describe(*x, image, stable)?);
        }
        portrait.gaps = gaps(&marks, &ways, portrait.stop);
        portrait.settle_border(&mut flow, &marks)?;
        portrait.cost = flow.cost();
        Ok(portrait)
    }

    fn settle_border(&mut self, flow: &mut Flow, marks: &[Mark]) -> Result<()> {
        let Some(first) = self.gaps.first() else { return Ok(()) };
        let inner = if self.neutral { Fate::Neutral } else { Fate::Rest };
        if let Fate::Unknown(stop) = first.fate {
            return Err(stop);
        }
        let last = self.gaps.iter().take_while(|gap| gap.fate == inner).count();
        let divide = last.checked_sub(1).and_then(|last| marks.get(last));
        if last == 0 {
            self.border = Border::NoBasin;
            self.reach = Some(Reach::default());
        } else if let Some((x, mark)) = divide.filter(|_| last < self.gaps.len()) {
            flow.follows = true;
            let (curve, left) = match mark {
                Divide::Cycle(image) => flow.around(*x, image.slips())?,
                _ => flow.border(*x, matches!(mark, Divide::Jump), self.landmarks)?,
            };
            let touches = curve.steps.iter().any(|step| step.place == ContactState::Sticks);
            self.border = match mark {
                Divide::Cycle(_) => Border::Cycle,
                _ if touches => Border::Grazing,
                _ => Border::Capture,
            };
            let edge = Edge::Curve(curve);
            let velocity = self.kept_within(&edge, 0.0);
            self.reach = Some(Reach { displacement: (*x, -left), velocity });
            self.borders.push(edge);
        } else if let Some(stop) = self.open_end() {
            self.border = Border::Unknown(stop);
            self.reach = Some(self.covered(0.0));
        }
        self.margin = self.margin_within(self.model.guide_static, self.model.mass);
        Ok(())
    }

    /// What hides a border farther out, where none was met.
    fn open_end(&self) -> Option<Reason> {
        let Model { omega_0, speed, .. } = self.model;
        let slip = (speed - self.model.least_velocity()) * omega_0;
        let ends = self.model.law_ends().then_some(Reason::BeyondLaw { slip });
        let hides = |stop: &Reason| !matches!(stop, Reason::Escapes | Reason::Settles);
        self.stop.filter(hides).or(ends)
    }
}

/// The direction of motions in a gap: outward if they grow, and neither way if they are periodic; or why they leave
/// the known range.
type Tendency = Result<Ordering>;

/// The direction of motions in each gap.
fn ways(flow: &mut Flow, marks: &[Mark], end: f64) -> Result<Vec<Tendency>> {
    let mut ways = Vec::with_capacity(marks.len() + 1);
    let mut low = flow.model.guide_static;
    for mark in marks.iter().map(Some).chain([None]) {
        if let Some((x, Divide::Capture)) = mark {
            ways.push(Ok(Ordering::Less));
            low = *x;
            continue;
        }
        let beyond = if end > low { end } else { 2.0 * low };
        let high = mark.map_or(beyond, |(x, _)| *x);
        let x = low + 0.5 * (high - low);
        ways.push(match flow.growth(0.0, x) {
            Ok(there) if there.value.abs() < NOTHING => Ok(Ordering::Equal),
            Ok(there) => Ok(there.value.total_cmp(&0.0)),
            Err(stop @ Reason::BeyondLaw { .. }) => Err(stop),
            Err(reason) => return Err(reason),
        });
        low = high;
    }
    Ok(ways)
}

/// The fate of each gap.
fn gaps(marks: &[Mark], ways: &[Tendency], stop: Option<Reason>) -> Vec<Gap> {
    let is_cycle = |(_, divide): &&Mark| matches!(divide, Divide::Cycle(_));
    let cycle = |mark: usize| Fate::Cycle(marks[..mark].iter().filter(is_cycle).count());
    let fate = |gap: usize| {
        let mut here = gap;
        loop {
            let (mark, next) = match ways[here] {
                Err(stop) => return Fate::Unknown(stop),
                Ok(Ordering::Equal) => return Fate::Neutral,
                Ok(Ordering::Greater) => (here, here + 1),
                Ok(Ordering::Less) if here == 0 => return Fate::Rest,
                Ok(Ordering::Less) => (here - 1, here - 1),
            };
            match marks.get(mark) {
                None => return stop.map_or(Fate::Escapes, Fate::Unknown),
                Some((_, Divide::Cycle(_))) => return cycle(mark),
                // Motions continue across a jump: the map rises there and never sends them back.
                Some((_, Divide::Jump | Divide::Capture)) => here = next,
            }
        }
    };
    let gap = |(gap, mark): (usize, Option<&Mark>)| {
        let (to, mark) = mark.map_or((f64::INFINITY, Divide::Capture), |(x, mark)| (*x, *mark));
        let end = match mark {
            Divide::Cycle(_) => cycle(gap),
            // An orbit that touches the belt sticks to it.
            Divide::Jump => fate(gap + 1),
            Divide::Capture => fate(gap),
        };
        Gap { to, fate: fate(gap), end }
    };
    marks.iter().map(Some).chain([None]).enumerate().map(gap).collect()
}
