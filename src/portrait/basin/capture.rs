//! After how many half swings a motion comes to rest: the bands of capture.
//!
//! A swing comes to rest where it arrives within the sticking set. The starts from which this happens
//! after one, two, three ... arrivals form nested bands; their borders are the preimages of the two end
//! points of the sticking set, that is, the motions that end exactly there, followed backward. In each
//! half plane they are graphs over the displacement, like the borders of the basin ([`crate::portrait::basin`]).

use super::Arc;
use crate::flow::{Cost, Limits, Result};
use crate::model::{Parameters, Side, State};
use crate::portrait::{Direction, Length};

/// The borders between one arrival more and one less.
#[derive(Clone, Debug, Default)]
pub struct Bands {
    /// Those above `v = 0` and those below, innermost first.
    pub borders: [Vec<Arc>; 2],
    /// What they cost.
    pub cost: Cost,
}

/// Clearance between borders, as a fraction of the clearance, below which bands count as one.
const RESOLVED: f64 = 1e-9;

/// Finds the borders of at most `most` bands whose turning points lie within `reach`.
///
/// They stop earlier where they accumulate at the edge of the basin. Fails with the `Reason` why a border could
/// not be computed.
pub fn bands(parameters: &Parameters, reach: f64, most: usize, limits: &Limits) -> Result<Bands> {
    let mut bands = Bands::default();
    // Clearance from which a swing on the upper, on the lower side comes to rest exactly this many arrivals
    // later; None once there is none within reach.
    let mut starts = [Some(Length::ZERO); 2];
    for _ in 0..most {
        let mut next = [None; 2];
        for (index, side) in [Side::Upper, Side::Lower].into_iter().enumerate() {
            // A swing of this side hands over to the other side, with one arrival less to come.
            let Some(clearance) = starts[1 - index] else { continue };
            let arc = Arc::new(parameters, side, Direction::Backward, clearance, limits)?;
            bands.cost += arc.cost;
            let before = starts[index].map_or(0.0, |start| start.value);
            next[index] = Some(arc.swing.end).filter(|start| {
                start.value < reach && start.value - before > RESOLVED * start.value
            });
            bands.borders[index].push(arc);
        }
        starts = next;
    }
    Ok(bands)
}

impl Bands {
    /// The borders as polylines in the order of time, `count` points on each integration step.
    pub fn curves(&self, count: u16) -> Vec<Vec<State>> {
        self.borders.iter().flatten().map(|arc| arc.points(count)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Method, Outcome, Problem};

    fn counted(parameters: &Parameters, initial: State) -> Option<usize> {
        let problem = Problem {
            parameters: *parameters,
            initial,
            until: 500.0,
            method: Method::Taylor,
            tolerance: 1e-12,
            ..Problem::default()
        };
        let motion = trajectory(&problem, Detail::default(), &Limits::PATIENT);
        matches!(motion.outcome, Outcome::Captured { .. }).then_some(motion.crossings.len())
    }

    /// How many arrivals at `v = 0` a motion has until it rests; `None` beyond the last border, unless that one hands
    /// over to a border that comes from infinity: then whatever lies beyond is one band.
    fn arrivals(found: &Bands, start: State, r: f64) -> Option<usize> {
        let Some(side) = Side::entered_from(start, r) else { return Some(0) };
        let below = |arc: &Arc| arc.speed_at(start.q).is_some_and(|speed| start.v.abs() < speed);
        let index = usize::from(side == Side::Lower);
        let (borders, others) = (&found.borders[index], &found.borders[1 - index]);
        let next = others.get(borders.len() - 1).map(|arc| arc.swing.end);
        let open = (next == Some(Length::INFINITE)).then_some(borders.len());
        borders.iter().position(below).or(open).map(|index| index + 1)
    }

    #[test]
    fn bands_count_the_half_swings_of_motions() {
        for (d, d2, d3, r) in [
            (0.05, 0.0, 0.0, 0.1),
            (-0.2, 0.2, 0.5, 0.1),
            (0.1, -0.4, 0.3, 0.2),
            (-0.05, 0.3, 0.0, 0.3),
            (0.3, 0.1, -0.4, 0.1),
        ] {
            let parameters = Parameters { d, d2, d3, r };
            let found = bands(&parameters, 10.0, 12, &Limits::PATIENT).unwrap();
            for index in 0..400 {
                let place = |step: u32| -1.5 + 3.0 * f64::from(index * step % 400) / 399.0;
                let start = State { q: place(1), v: place(37) };
                let expected = counted(&parameters, start).filter(|&arrivals| arrivals <= 12);
                let arrivals = arrivals(&found, start, r);
                // Where bands accumulate at the edge fewer are resolved than motions count.
                if arrivals.is_some() || expected.is_none_or(|count| count < 6) {
                    assert_eq!(arrivals, expected, "{parameters:?} {start:?}");
                }
            }
        }
    }

    #[test]
    fn undamped_bands_are_two_r_wide() {
        let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.25 };
        let found = bands(&parameters, 10.0, 8, &Limits::PATIENT).unwrap();
        for count in 1..=8_u8 {
            let start = State { q: 0.5 * f64::from(count), v: 0.0 };
            assert_eq!(arrivals(&found, start, 0.25), Some(usize::from(count)));
        }
    }
}
