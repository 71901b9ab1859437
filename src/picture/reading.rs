//! Coordinates in words, to the digits that can be told apart in a window.

use crate::scene::{Point, Window};
use crate::words::number::resolved;

/// The coordinates of a point, to the digits that can be told apart in a window.
pub fn reading(point: Point, window: Window) -> (String, String) {
    (resolved(point.x, window.x.width() / CELLS), resolved(point.y, window.y.width() / CELLS))
}

/// Cells of a large plot: what a cursor can tell apart.
pub(super) const CELLS: f64 = 200.0;
