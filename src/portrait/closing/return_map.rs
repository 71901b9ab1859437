//! The return map: from a turning point to the next one on the same side, two half swings later.
//!
//! A motion turns on `v = 0`, on the right and on the left in turn, until a turning point lies on the
//! sticking set: there it stays. So a turning point at rest is its own image, and a motion that is
//! captured on the other side has the place of its rest for its next turning point. Fixed points beyond
//! the sticking set are the limit cycles; the slope there is the Floquet multiplier.
//!
//! With D2 = D3 = 0 every half swing is the closed form (29), and nothing is integrated.

use super::{Direction, Equation, Length};
use crate::flow::{Cost, Limits, Result};
use crate::model::{Parameters, Side};
use crate::portrait::evenly;

/// Tolerance of the integration steps.
const STEP: f64 = 1e-13;

/// A turning point and the next one on the same side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return {
    /// Displacement of the turning point.
    pub from: f64,
    /// Displacement of the next one; `None` if the motion escapes, or creeps and never turns.
    pub to: Option<f64>,
}

/// The return map over an interval of displacements.
#[derive(Clone, Debug, PartialEq)]
pub struct ReturnMap {
    /// The parameters.
    pub parameters: Parameters,
    /// Turning points on the left and on the right, each side in the order of its clearance.
    pub sides: [Vec<Return>; 2],
    /// What it cost.
    pub cost: Cost,
}

/// Computes the return map of turning points within `range`, at `count` points on each side and at the
/// borders of capture: where the map has kinks.
///
/// # Errors
/// The [`Reason`](crate::model::Reason) why a half swing failed; escape is not an error.
pub fn return_map(
    parameters: &Parameters,
    range: (f64, f64),
    count: u16,
    limits: &Limits,
) -> Result<ReturnMap> {
    let mut cost = Cost::default();
    let mut side = |side: Side| {
        // Turning points on the right enter the lower half plane.
        let (near, far) = if side == Side::Lower {
            range
        } else {
            (-range.1, -range.0)
        };
        let mut equation = Equation::on_side(parameters, side, STEP, limits);
        let found = equation.returns_between(near.max(parameters.r), far, count);
        cost += equation.cost();
        found
    };
    let sides = [side(Side::Upper)?, side(Side::Lower)?];
    Ok(ReturnMap { parameters: *parameters, sides, cost })
}

// Both half swings lead from a turning point on one side back to that side.
impl Equation<'_> {
    /// The map at evenly spaced distances from zero, both ends included, and at its kinks.
    fn returns_between(&mut self, near: f64, far: f64, count: u16) -> Result<Vec<Return>> {
        if near >= far {
            return Ok(Vec::new());
        }
        let mut starts: Vec<f64> = evenly((near, far), usize::from(count.max(2))).collect();
        // Captured on an end of the sticking set by the first half swing, and by the second; infinite where there is none.
        let gap = Length::new(2.0 * self.parameters.r);
        let once = self.swing(0, Direction::Backward, gap)?.end;
        let between = self.swing(1, Direction::Backward, gap)?.end;
        let twice = self.swing(0, Direction::Backward, between.plus(gap.value))?.end;
        let kinks = [once, twice].map(|clearance| self.parameters.r + clearance.value);
        starts.extend(kinks.iter().filter(|kink| near < **kink && **kink < far));
        starts.sort_by(f64::total_cmp);
        starts.dedup();
        let outward = -self.side.sign();
        let at = |start: f64| {
            let to = self.next(start - self.parameters.r)?;
            Ok(Return { from: outward * start, to })
        };
        starts.into_iter().map(at).collect()
    }

    /// The next turning point of a motion that starts with this clearance.
    fn next(&mut self, clearance: f64) -> Result<Option<f64>> {
        let r = self.parameters.r;
        let (mut place, mut passed) = (-self.side.sign() * r, clearance);
        for (index, side) in [self.side, self.side.opposite()].into_iter().enumerate() {
            if passed <= 0.0 {
                break;
            }
            let swing = self.swing(index, Direction::Forward, Length::new(passed))?;
            if !swing.arrives() {
                return Ok(None);
            }
            let end = swing.end.value;
            (place, passed) = (side.displacement(end, r), end - 2.0 * r);
        }
        Ok(Some(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::portrait::basin::cycle::cycles;

    const LIMITS: Limits = Limits::PATIENT;

    fn map(parameters: Parameters, range: (f64, f64)) -> ReturnMap {
        return_map(&parameters, range, 61, &LIMITS).unwrap()
    }

    /// The next turning point of one that need not be a point of a map.
    fn next(parameters: &Parameters, q: f64) -> f64 {
        let side = if q > 0.0 { Side::Lower } else { Side::Upper };
        Equation::on_side(parameters, side, STEP, &LIMITS)
            .next(q.abs() - parameters.r)
            .unwrap()
            .unwrap()
    }

    #[test]
    fn the_fixed_points_are_the_cycles_and_the_slope_there_is_the_multiplier() {
        for (d, d2, d3, r) in [
            (-0.3, 0.0, 0.5, 0.1),
            (-0.3, 0.2, 0.5, 0.1),
            (-0.2, 0.2, 0.0, 0.5),
            (-0.1, 0.0, -0.5, 0.1),
            (-0.1, 0.0, 0.5, 0.0),
            (-0.4, 0.0, 0.0, 1.0),
        ] {
            let parameters = Parameters { d, d2, d3, r };
            let found = cycles(&parameters, &LIMITS).unwrap();
            assert!(!found.cycles.is_empty());
            for cycle in &found.cycles {
                for turning in [cycle.q_max, cycle.q_min] {
                    let back = next(&parameters, turning);
                    assert!((back / turning - 1.0).abs() < 1e-10, "{turning} to {back}");
                    let step = 1e-5 * (turning.abs() - r);
                    let slope = (next(&parameters, turning + step)
                        - next(&parameters, turning - step))
                        / (2.0 * step);
                    let multiplier = cycle.multiplier.unwrap();
                    assert!((slope / multiplier - 1.0).abs() < 1e-4, "{slope} {multiplier}");
                }
            }
        }
    }

    #[test]
    fn without_damping_a_turn_loses_four_times_the_friction_and_nothing_is_integrated() {
        let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.125 };
        let found = map(parameters, (-1.0, 1.0));
        assert_eq!(found.cost.evaluations, 0);
        for Return { from, to } in found.sides.iter().flatten() {
            // Seen from the side of the turning point. Within 3 r the first half swing is captured, the
            // second within 5 r.
            let (size, to) = (from.abs(), to.unwrap() * from.signum());
            let expected = if size <= 0.375 { 0.25 - size } else { size - 0.5 };
            assert!((to - expected).abs() < 1e-14, "{from} to {to}");
        }
    }

    #[test]
    fn the_map_is_continuous_and_has_its_kinks_among_its_points() {
        let parameters = Parameters { d: -0.3, d2: 0.3, d3: 0.5, r: 0.1 };
        let found = map(parameters, (-2.0, 2.0));
        for (side, sign) in found.sides.iter().zip([-1.0, 1.0]) {
            assert!(side.windows(2).all(|pair| pair[0].from.abs() < pair[1].from.abs()));
            assert!(side.iter().all(|turn| turn.from.signum() == sign));
            let reached = |place: f64| {
                side.iter().any(|turn| turn.to.is_some_and(|to| (to - place).abs() < 1e-12))
            };
            assert!(reached(-sign * parameters.r), "captured on the far end");
            assert!(reached(sign * parameters.r), "captured on the near end");
            let farthest =
                side.windows(2).map(|pair| (pair[1].to.unwrap() - pair[0].to.unwrap()).abs());
            assert!(farthest.fold(0.0, f64::max) < 0.2);
        }
    }

    #[test]
    fn where_motions_escape_the_map_has_no_value() {
        let found = map(Parameters { d: -0.1, d2: 0.0, d3: -0.5, r: 0.1 }, (0.0, 5.0));
        let [left, right] = &found.sides;
        assert!(left.is_empty());
        assert!(right.first().unwrap().to.is_some() && right.last().unwrap().to.is_none());
    }
}
