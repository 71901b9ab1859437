//! What accuracy costs: every method that can follow a machine, over its tolerances, on one and the same motion.
//!
//! Errors are measured against Taylor series whose steps end below rounding; how far these can be trusted is how far
//! they are from the other methods at their finest ([`crate::accuracy::trade`] does the same where there are formulas).

use crate::flow::{Detail, Method, MotionUnits, Problem, Trajectory, follow};
use crate::model::model::FINEST;
use crate::model::{Model, State};
use crate::numerics::elementary::powi;

/// The methods, Taylor series first.
const METHODS: [Method; 3] = [Method::Taylor, Method::Dop853, Method::Dopri5];

/// Decimal digits of the tolerances.
const DIGITS: std::ops::RangeInclusive<i32> = 2..=15;

/// One method at one tolerance.
#[derive(Clone, Debug)]
pub struct MachineTradePoint {
    pub motion: Trajectory,
    /// The largest difference in displacement from the reference, at the standstills and at the end, as a part of the
    /// largest displacement there; `None` where it has not as many standstills.
    pub error: Option<f64>,
}

/// Every method over its tolerances on one motion.
#[derive(Clone, Debug)]
pub struct MachineTrade {
    /// What the errors are measured against.
    pub reference: Trajectory,
    pub points: Vec<MachineTradePoint>,
}

impl MachineTrade {
    /// Computes every row for a motion from displacement and velocity (m, m/s) of `until` seconds.
    #[must_use]
    pub fn new(model: &Model, (q, v): (f64, f64), until: f64) -> Self {
        let initial = State { q, v };
        let follow = |method, tolerance| {
            let problem = Problem { initial, until, method, tolerance, ..Problem::default() };
            follow(model, &problem, MotionUnits::physical(model), Detail::default())
        };
        let reference = follow(Method::Taylor, FINEST);
        let point = |(method, digits): (Method, i32)| {
            let motion = follow(method, powi(10.0, -digits));
            let error = deviation(&motion, &reference);
            MachineTradePoint { motion, error }
        };
        let rows = METHODS.into_iter().flat_map(|way| DIGITS.map(move |digits| (way, digits)));
        let points = rows.map(point).collect();
        MachineTrade { reference, points }
    }
}

/// The error of a motion.
fn deviation(motion: &Trajectory, reference: &Trajectory) -> Option<f64> {
    let [places, expected] = [motion, reference].map(|it| {
        let turns = it.crossings.iter().map(|turn| turn.q);
        turns.chain([it.end().q]).collect::<Vec<f64>>()
    });
    if motion.outcome.answered().is_err() || places.len() != expected.len() {
        return None;
    }
    let size = expected.iter().map(|x| x.abs()).fold(f64::MIN_POSITIVE, f64::max);
    let far = places.iter().zip(&expected).map(|(one, other)| (one - other).abs());
    Some(far.fold(0.0, f64::max) / size)
}
