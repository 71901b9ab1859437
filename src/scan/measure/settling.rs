//! How long starts over a window take to come to rest.

use crate::model::State;
use crate::portrait::StartWindow;

/// Starts along each side of the window, evenly spaced in the middles of as many cells.
const SIDE: u16 = 32;

/// The starts of a window, row by row.
pub fn starts(window: StartWindow) -> impl Iterator<Item = State> {
    let cell = |(from, to): (f64, f64), index: u16| {
        from + (to - from) * (f64::from(index) + 0.5) / f64::from(SIDE)
    };
    let places = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (row, column)));
    places.map(move |(row, column)| State { q: cell(window.q, column), v: cell(window.v, row) })
}

/// Largest and mean time to rest, from the times of all [`starts`]; `None` where a start is not at rest in the end.
pub fn largest_and_mean(times: &[Option<f64>]) -> Option<[f64; 2]> {
    let times: Vec<f64> = times.iter().copied().collect::<Option<_>>()?;
    let largest = times.iter().copied().fold(0.0, f64::max);
    let mean = times.iter().sum::<f64>() / f64::from(SIDE * SIDE);
    Some([largest, mean])
}

/// The fraction of the starts that is at rest in the end, and how much that may differ from the fraction of the
/// window: half of the cells that have a neighbour of the other kind.
pub fn rested(times: &[Option<f64>]) -> [f64; 2] {
    let side = usize::from(SIDE);
    let rests = |row: usize, column: usize| times[row * side + column].is_some();
    let (mut resting, mut divided) = (0_u16, 0_u16);
    for row in 0..side {
        for column in 0..side {
            let here = rests(row, column);
            resting += u16::from(here);
            // At an end of a row or column the cell itself, which does not differ.
            let [left, below] = [column, row].map(|index| index.saturating_sub(1));
            let [right, above] = [column, row].map(|index| (index + 1).min(side - 1));
            let around = [(row, left), (row, right), (below, column), (above, column)];
            let edge = around.into_iter().any(|(row, column)| rests(row, column) != here);
            divided += u16::from(edge);
        }
    }
    let part = |count: u16| f64::from(count) / f64::from(SIDE * SIDE);
    [part(resting), 0.5 * part(divided)]
}
