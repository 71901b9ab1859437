//! How long starts over a window take to come to rest.

use crate::model::State;
use crate::portrait::basin::StartWindow;

/// Starts along each side of the window, evenly spaced in the middles of as many cells.
const SIDE: u16 = 32;

/// When the starts of a window come to rest.
#[derive(Clone, Debug)]
pub struct Settling {
    /// Row by row; `None` for a start that is not at rest in the end.
    times: Vec<Option<f64>>,
}

impl Settling {
    /// Asks when the motion from each start is at rest, if it is in the end. Fails with why one of them was given up.
    pub fn of<Why>(
        window: &StartWindow,
        mut rests: impl FnMut(State) -> Result<Option<f64>, Why>,
    ) -> Result<Self, Why> {
        let cell = |(from, to): (f64, f64), index: u16| {
            from + (to - from) * (f64::from(index) + 0.5) / f64::from(SIDE)
        };
        let starts = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (row, column)));
        let times = starts.map(|(row, column)| {
            rests(State { q: cell(window.q, column), v: cell(window.v, row) })
        });
        Ok(Settling { times: times.collect::<Result<_, _>>()? })
    }

    /// Largest and mean time to rest; `None` where a start is not at rest in the end.
    pub fn times(&self) -> Option<[f64; 2]> {
        let times: Vec<f64> = self.times.iter().copied().collect::<Option<_>>()?;
        let largest = times.iter().copied().fold(0.0, f64::max);
        let mean = times.iter().sum::<f64>() / f64::from(SIDE * SIDE);
        Some([largest, mean])
    }

    /// The fraction of the starts that is at rest in the end, and how much that may differ from the fraction of the
    /// window: half of the cells that have a neighbour of the other kind.
    pub fn rested(&self) -> [f64; 2] {
        let side = usize::from(SIDE);
        let rests = |row: usize, column: usize| {
            (row < side && column < side).then(|| self.times[row * side + column].is_some())
        };
        let (mut resting, mut divided) = (0_u16, 0_u16);
        for row in 0..side {
            for column in 0..side {
                let here = rests(row, column);
                resting += u16::from(here == Some(true));
                let around = [
                    (row.wrapping_sub(1), column),
                    (row + 1, column),
                    (row, column.wrapping_sub(1)),
                    (row, column + 1),
                ];
                let differs = |other: bool| Some(other) != here;
                let edge =
                    around.iter().any(|&(row, column)| rests(row, column).is_some_and(differs));
                divided += u16::from(edge);
            }
        }
        let part = |count: u16| f64::from(count) / f64::from(SIDE * SIDE);
        [part(resting), 0.5 * part(divided)]
    }
}
