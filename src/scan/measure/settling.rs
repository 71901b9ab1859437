//! How long starts over a window take to come to rest.

use crate::flow::trajectory::trajectory;
use crate::flow::{Cost, Detail, Limits, Outcome, Problem, Reason};
use crate::model::State;
use crate::portrait::basin::Window;

/// Starts along each side of the window, evenly spaced in the middles of as many cells.
const SIDE: u16 = 32;

/// When the starts of a window come to rest.
#[derive(Clone, Debug)]
pub struct Settling {
    /// Row by row; `None` for a start that is not at rest in the end.
    times: Vec<Option<f64>>,
}

impl Settling {
    /// Follows every start until the end time of the motion. Fails with the [`Reason`] why one of them was given
    /// up.
    pub fn of(problem: &Problem, window: &Window, limits: &Limits) -> Result<(Self, Cost), Reason> {
        let mut cost = Cost::default();
        let cell = |(from, to): (f64, f64), index: u16| {
            from + (to - from) * (f64::from(index) + 0.5) / f64::from(SIDE)
        };
        let starts = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (row, column)));
        let times = starts.map(|(row, column)| {
            let initial = State { q: cell(window.q, column), v: cell(window.v, row) };
            let motion = trajectory(&Problem { initial, ..*problem }, Detail::default(), limits);
            cost += motion.cost;
            match motion.outcome {
                Outcome::Captured { tau, .. } => Ok(Some(tau)),
                Outcome::GaveUp { reason, .. } => Err(reason),
                Outcome::Moving { .. } | Outcome::Escaped { .. } => Ok(None),
            }
        });
        let times = times.collect::<Result<Vec<_>, _>>()?;
        Ok((Settling { times }, cost))
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
        let rests = |row: usize, column: usize| self.times[row * side + column].is_some();
        let (mut resting, mut divided) = (0_u16, 0_u16);
        for row in 0..side {
            for column in 0..side {
                let here = rests(row, column);
                resting += u16::from(here);
                let differs = |other: Option<usize>, line: bool| {
                    let other = other.filter(|index| *index < side);
                    other.is_some_and(|at| {
                        here != if line { rests(at, column) } else { rests(row, at) }
                    })
                };
                let edge = differs(row.checked_sub(1), true)
                    || differs(Some(row + 1), true)
                    || differs(column.checked_sub(1), false)
                    || differs(Some(column + 1), false);
                divided += u16::from(edge);
            }
        }
        let part = |count: u16| f64::from(count) / f64::from(SIDE * SIDE);
        [part(resting), 0.5 * part(divided)]
    }
}
