//! The samples of a record, those that do not count marked by what they are.

use crate::fit::Dropped;
use crate::picture::items::{Item, Marks, Picture};
use crate::picture::role::{Mark, Role};
use crate::scene::Point;

/// How samples that do not count are marked, and what legends call them.
const MARKS: [(Dropped, Mark, Role, &str); 6] = [
    (Dropped::Before, Mark::Aside, Role::Bands, "before the stroke, left out"),
    (Dropped::After, Mark::Aside, Role::Bands, "after a second stroke, left out"),
    (Dropped::Jump, Mark::Aside, Role::Bands, "at jumps, left out"),
    (Dropped::Alike, Mark::Aside, Role::Harmonic, "alike at rest, left out"),
    (Dropped::Saturated, Mark::Saturated, Role::Danger, "saturated, left out"),
    (Dropped::Outlier, Mark::Outlier, Role::Danger, "outliers, left out"),
];

/// Marks of one kind that a picture shows at most.
const MOST: usize = 500;

/// Marks the samples that do not count. What lies above or below the window is shown at its edge.
pub fn mark(picture: &mut Picture, samples: impl Iterator<Item = (Point, Dropped)>) {
    let samples: Vec<(Point, Dropped)> = samples.collect();
    for (which, mark, role, name) in MARKS {
        let of_kind = samples.iter().filter(|(_, why)| *why == which).map(|(at, _)| *at);
        let all: Vec<Point> = of_kind.collect();
        let at: Vec<Point> = all.iter().copied().step_by(all.len().div_ceil(MOST).max(1)).collect();
        if !at.is_empty() {
            let marks = Marks::new(mark, role, at);
            let marks = Marks { name: name.into(), brief: name, at_edge: true, ..marks };
            picture.items.push(Item::Marks(marks));
        }
    }
}
