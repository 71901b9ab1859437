//! The gaps between the right turning points at which the return map changes, and the fate of the motions in
//! each gap.

use std::cmp::Ordering;

use crate::flow::{Fate, Flow, Reason};
use crate::model::Model;
use crate::portrait::return_map::fixed_points::NOTHING;
use crate::portrait::return_map::machine_return::Landmarks;
use crate::portrait::return_map::machine_return::MachineReturn;

/// A gap between right turning points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// Its upper end.
    pub to: f64,
    pub fate: Fate,
    /// Fate of a motion that turns exactly at the upper end.
    pub end: Fate,
}

/// A right turning point at which the return map changes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Divide {
    Cycle(usize),
    Jump,
    /// The last one from which the guide catches the mass; motions from beyond grow.
    Capture,
}

/// Jumps of the return map: where a touch becomes a ride, and where the mirror band ends.
pub(crate) fn jumps(model: &Model, landmarks: Option<&Landmarks>) -> Vec<f64> {
    let Some(marks) = landmarks else { return Vec::new() };
    let mut found: Vec<f64> = marks.grazing.right.into_iter().collect();
    if marks.lines.release > marks.lines.fold {
        found.extend(marks.beyond.filter(|beyond| Some(*beyond) != marks.grazing.right));
    }
    found.retain(|x| *x > model.guide_static);
    found
}

/// The direction of motions in a gap: outward if they grow, and neither way if they are periodic; or why they leave
/// the known range.
pub(crate) type Tendency = Result<Ordering, Reason>;

/// The direction of motions in each gap.
pub(crate) fn ways(
    flow: &mut Flow,
    marks: &[(f64, Divide)],
    end: f64,
) -> Result<Vec<Tendency>, Reason> {
    let mut ways = Vec::with_capacity(marks.len() + 1);
    let held = flow.model.guide_static;
    let mut low = held;
    for mark in marks.iter().map(Some).chain([None]) {
        if let Some((x, Divide::Capture)) = mark {
            ways.push(Ok(Ordering::Less));
            low = *x;
            continue;
        }
        let high = mark.map(|(x, _)| *x);
        let high = high.unwrap_or(if end > low { end } else { 2.0 * low });
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
pub(crate) fn gaps(marks: &[(f64, Divide)], ways: &[Tendency], stop: Option<Reason>) -> Vec<Gap> {
    let fate = |gap: usize| {
        let mut here = gap;
        loop {
            let (mark, next) = match ways[here] {
                Err(stop) => return Fate::Unknown(stop),
                Ok(Ordering::Equal) => return Fate::Neutral,
                Ok(Ordering::Greater) => (marks.get(here), here + 1),
                Ok(Ordering::Less) if here == 0 => return Fate::Rest,
                Ok(Ordering::Less) => (marks.get(here - 1), here - 1),
            };
            match mark {
                None => return stop.map_or(Fate::Escapes, Fate::Unknown),
                Some((_, Divide::Cycle(index))) => return Fate::Cycle(*index),
                // Motions continue across a jump: the map rises there and never sends them back.
                Some((_, Divide::Jump | Divide::Capture)) => here = next,
            }
        }
    };
    let gap = |(gap, mark): (usize, Option<&(f64, Divide)>)| {
        let (to, mark) = mark.map_or((f64::INFINITY, Divide::Capture), |(x, mark)| (*x, *mark));
        let end = match mark {
            Divide::Cycle(index) => Fate::Cycle(index),
            // An orbit that touches the belt sticks to it.
            Divide::Jump => fate(gap + 1),
            Divide::Capture => fate(gap),
        };
        Gap { to, fate: fate(gap), end }
    };
    marks.iter().map(Some).chain([None]).enumerate().map(gap).collect()
}
