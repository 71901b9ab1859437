//! Level curves: where a column of a scan has a value, over two numbers.
//!
//! [`Scan::curves`](super::Scan::curves) finds curves on a lattice and follows them by continuation: each of their points is a
//! root in a bracket, to 1e-13 of the ranges, on an arc around the point before. The lattice says nothing about where a curve
//! lies, only that there is one: the column is larger than the value at one end of an edge, and smaller at the other. What can
//! be missed, are curves that separate no two neighbours on the lattice, such as a closed one within a cell.
//!
//! A column need not exist everywhere. Beyond a fold, every kick is survived, and a curve of the margin ends there: it touches
//! the fold, near which the margin changes like a square root. So its end is no root on an arc. It is where the column at the
//! border of what has numbers, extrapolated by that law, has the value.

mod arc;
mod curves;
mod target;
mod trail;

pub use target::{LevelCurve, LevelEnd, LevelTarget, Levels};
