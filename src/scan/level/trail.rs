//! Following a level curve from one of its points.

use std::f64::consts::{PI, TAU};

use super::arc::{LevelArc, LevelMeter, Place};
use super::target::LevelEnd;
use crate::flow::Result;
use crate::numerics::{atan2, hypot, sin_cos};

/// The first and the longest step.
pub(super) const FIRST: f64 = 1.0 / 256.0;
const LONGEST: f64 = 1.0 / 32.0;

/// The step from which on the curve may touch the border of what has numbers, and the one at which it ends where it cannot be
/// followed.
const NEAR: f64 = 1e-3;
const LEAST: f64 = 1e-11;

/// Largest angle between two steps, and the step below which a curve has a corner.
const BEND: f64 = 0.5;
const CORNER: f64 = 1e-6;

/// Most points of a part of a curve.
const MOST: usize = 20_000;

/// A part of a curve, from a point of it on.
pub(super) struct Trail {
    pub places: Vec<Place>,
    /// Why it ends; nothing where it comes back to its beginning.
    pub end: Option<LevelEnd>,
    pub step: f64,
}

/// Distance and angle from one place to another.
pub(super) fn polar(from: Place, to: Place) -> (f64, f64) {
    let (across, up) = (to[0] - from[0], to[1] - from[1]);
    (hypot(across, up), atan2(up, across))
}

/// An angle within half a turn.
fn turned(angle: f64) -> f64 {
    angle - TAU * ((angle + PI) / TAU).floor()
}

/// Whether the curve from one place to the next goes through the beginning of an arc, in about its heading. The distance of
/// that from the chord is then less than a fifth of the chord, which no curve reaches that bends as little as these do.
pub(super) fn passes(from: Place, to: Place, arc: &LevelArc) -> bool {
    let ((length, angle), (distance, other)) = (polar(from, to), polar(from, arc.from));
    let (sin, cos) = sin_cos(other - angle);
    let is_beside = (distance * sin).abs() <= 0.2 * length;
    let is_along = (-0.1..=1.1).contains(&(distance * cos / length));
    is_beside && is_along && sin_cos(angle - arc.heading).1 > 0.0
}

impl LevelMeter<'_> {
    /// Follows a curve from the beginning of an arc, where it sets out in about its heading.
    pub fn trail(&mut self, begin: LevelArc) -> Result<Trail> {
        let mut trail = Trail { places: vec![begin.from], end: None, step: 0.0 };
        // The last step: where it ends, its angle, its length, and how much the curve bends there.
        let (mut last, mut length, mut bent) = (begin, 0.0, 0.0);
        while trail.places.len() < MOST {
            let heading = last.heading + 0.5 * bent * (length + last.reach);
            let arc = LevelArc { heading, ..last };
            let found = match self.crossing(&arc)? {
                Ok(found) => found,
                Err(end) => {
                    let place = if arc.reach < NEAR { self.end(&arc)? } else { None };
                    if place.is_some() || arc.reach < LEAST {
                        return Ok(trail.ended(end, place));
                    }
                    last.reach *= 0.5;
                    continue;
                }
            };
            if found.end.is_some() {
                trail.step = trail.step.max(found.step);
                return Ok(trail.ended(LevelEnd::Edge, Some(found.place)));
            }
            let (gone, angle) = polar(last.from, found.place);
            // The angle at which a curve sets out is not known.
            let bend = if length > 0.0 {
                turned(angle - last.heading)
            } else {
                0.0
            };
            let aside = arc.reach * bend.abs() / 8.0;
            let sharp = bend.abs() > BEND || aside > self.chord;
            if sharp && arc.reach > CORNER {
                last.reach *= 0.5;
                continue;
            }
            trail.step = trail.step.max(found.step);
            if trail.places.len() > 3 && passes(last.from, found.place, &begin) {
                trail.places.push(begin.from);
                return Ok(trail);
            }
            trail.places.push(found.place);
            bent = if sharp { 0.0 } else { 2.0 * bend / (length + gone) };
            let grown = if 5.0 * aside < self.chord {
                2.0 * arc.reach
            } else {
                arc.reach
            };
            let reach = grown.min(LONGEST);
            (last, length) = (LevelArc { from: found.place, heading: angle, reach, ..last }, gone);
        }
        Ok(trail.ended(LevelEnd::Unknown, None))
    }
}

impl Trail {
    /// The same with its end, and the last place if it is known.
    fn ended(mut self, end: LevelEnd, place: Option<Place>) -> Self {
        self.places.extend(place);
        self.places.dedup();
        Trail { end: Some(end), ..self }
    }
}
