//! The closing equation in numbers of twice the working precision, for where doubles cannot decide.
//!
//! Next to a fold two cycles nearly cancel the residual between them; next to the escape point swings from
//! and to infinity differ by as little as the parameter does; beyond critical negative damping a cycle
//! may graze the sticking set. There the residual is smaller than the rounding of a double. Thirty digits tell
//! on which side of each such place a double lies, and fix the cycle itself to all digits of a double.

use super::{Direction, Equation, PreciseSwingPair, Route};
use crate::flow::{Cost, Grain, Limits, Reason, Result, half_swing};
use crate::numerics::{Twofold, ln_1p};

/// Rounding and truncation here, as a fraction of those of a double, with a few digits to spare.
pub const FINER: f64 = 1e-12;

const LOST: Reason = Reason::OutOfRange;

impl Equation<'_> {
    /// The two swings at a clearance of the first one; [`Reason::OutOfRange`] where one of them escapes or is
    /// captured, too. An evaluation counts as a hundred in doubles.
    pub fn precisely_at(&mut self, route: Route, start: Twofold) -> Result<PreciseSwingPair> {
        use Direction::{Backward, Forward};
        /// Truncation well below rounding.
        const GRAIN: Grain = Grain { order: 30, tolerance: 1e-29 };
        /// Maximum number of evaluations of one swing, and what one costs in units of one in doubles.
        const BUDGET: u64 = 20_000;
        const COSTLIER: u64 = 100;
        let limits = Limits { evaluations: BUDGET, ..self.limits };
        let gap = Twofold::from(2.0 * self.parameters.r);
        let positive = |length: Twofold| Some(length).filter(|it| it.high > 0.0).ok_or(LOST);
        let mut duration = Twofold::default();
        let mut swing = |index, direction, start| -> Result<Twofold> {
            let (field, mut cost) = (self.map(index, direction).field, Cost::default());
            let found = half_swing(field, start, GRAIN, &mut cost, &limits);
            self.charge(Cost { evaluations: COSTLIER * cost.evaluations, ..cost });
            let (end, time) = found?.ok_or(LOST)?;
            duration = duration + time;
            Ok(end)
        };
        let (second, difference, unit) = match route {
            Route::Forward => {
                let second = positive(swing(0, Forward, start)? - gap)?;
                let end = positive(swing(1, Forward, second)? - gap)?;
                (second, end - start, start)
            }
            Route::Mixed => {
                let second = swing(1, Backward, start + gap)?;
                let target = second + gap;
                (second, swing(0, Forward, start)? - target, target)
            }
            Route::Backward => {
                let second = swing(1, Backward, start + gap)?;
                let end = swing(0, Backward, second + gap)?;
                (second, start - end, end)
            }
        };
        let residual = ln_1p((difference / unit).value());
        let (second, duration) = (second.value(), duration.value());
        let sound = residual.is_finite() && second > 0.0;
        sound.then_some(PreciseSwingPair { residual, second, duration }).ok_or(LOST)
    }
}
