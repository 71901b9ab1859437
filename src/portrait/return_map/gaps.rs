//! The gaps between the right turning points at which the return map changes, and the fate of the motions in
//! each gap.

use std::cmp::Ordering;

use super::fixed_points::{Divide, FixedPoints, NOTHING};
use super::machine_return::MachineReturn;
use crate::flow::{Fate, Flow, Reason};

/// A gap between right turning points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// Its upper end.
    pub to: f64,
    pub fate: Fate,
    /// Fate of a motion that turns exactly at the upper end.
    pub end: Fate,
}

/// The direction of motions in a gap: outward if they grow, and neither way if they are periodic; or why they leave
/// the known range.
pub(crate) type Tendency = Result<Ordering, Reason>;

/// The direction of motions in each gap.
pub(crate) fn ways(flow: &mut Flow, found: &FixedPoints) -> Result<Vec<Tendency>, Reason> {
    let mut ways = Vec::with_capacity(found.divides.len() + 1);
    let mut low = flow.model.guide_static;
    for mark in found.divides.iter().map(Some).chain([None]) {
        if let Some((x, Divide::Capture)) = mark {
            ways.push(Ok(Ordering::Less));
            low = *x;
            continue;
        }
        let end = if found.end > low { found.end } else { 2.0 * low };
        let high = mark.map_or(end, |(x, _)| *x);
        let x = low + 0.5 * (high - low);
        ways.push(match flow.returned(x) {
            Ok(MachineReturn::Turns(image)) => {
                let change = (image.x - x) / x;
                let stays = change.abs() < NOTHING;
                Ok(if stays { Ordering::Equal } else { change.total_cmp(&0.0) })
            }
            Ok(MachineReturn::Rests(_)) | Err(Reason::Settles) => Ok(Ordering::Less),
            Err(Reason::Escapes) => Ok(Ordering::Greater),
            Err(stop @ Reason::BeyondLaw { .. }) => Err(stop),
            Err(reason) => return Err(reason),
        });
        low = high;
    }
    Ok(ways)
}

/// The fate of each gap.
pub(crate) fn gaps(found: &FixedPoints, ways: &[Tendency]) -> Vec<Gap> {
    let marks = &found.divides;
    let is_cycle = |(_, divide): &&(f64, Divide)| matches!(divide, Divide::Cycle(_));
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
                None => return found.stop.map_or(Fate::Escapes, Fate::Unknown),
                Some((_, Divide::Cycle(_))) => return cycle(mark),
                // Motions continue across a jump: the map rises there and never sends them back.
                Some((_, Divide::Jump | Divide::Capture)) => here = next,
            }
        }
    };
    let gap = |(gap, mark): (usize, Option<&(f64, Divide)>)| {
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
