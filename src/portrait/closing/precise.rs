//! The closing equation in numbers of twice the working precision, for where doubles cannot decide.
//!
//! Next to a fold two cycles nearly cancel the residual between them; next to the escape point swings from
//! and to infinity differ by as little as the parameter does; beyond critical negative damping a cycle
//! may graze the sticking set. There the residual is smaller than the rounding of a double. Thirty digits tell
//! on which side of each such place a double lies, and fix the cycle itself to all digits of a double.

use super::equation::{Equation, Route};
use super::half_map::Direction;
use crate::flow::precise::{Grain, half_swing};
use crate::flow::trajectory::Cost;
use crate::flow::{Limits, Reason};
use crate::model::HalfPlane;
use crate::numerics::{Twofold, ln_1p};

/// Rounding and truncation here, as a fraction of those of a double, with a few digits to spare.
pub const FINER: f64 = 1e-12;

/// Truncation well below that.
const GRAIN: Grain = Grain { order: 30, tolerance: 1e-29 };

/// What an evaluation costs in units of one in doubles.
const COSTLIER: u64 = 100;

/// Maximum number of evaluations of one swing.
const BUDGET: u64 = 20_000;

/// Both swings of a turn, in either direction.
pub struct PreciseEquation<'a> {
    limits: Limits<'a>,
    fields: [HalfPlane; 2],
    gap: Twofold,
    cost: Cost,
}

/// How far two swings are from closing.
#[derive(Clone, Copy, Debug)]
pub struct ClosingResidual {
    /// The residual of the route, as a closing in doubles has it.
    pub value: f64,
    /// Clearance at which the second swing starts.
    pub second: f64,
    /// Duration of both.
    pub duration: f64,
}

impl<'a> PreciseEquation<'a> {
    /// That of an equation in doubles.
    pub fn new(equation: &Equation<'a>) -> Self {
        let Equation { parameters, side, limits, .. } = *equation;
        let fields = [side, side.opposite()].map(|side| HalfPlane::new(&parameters, side));
        let gap = Twofold::of(2.0 * parameters.r);
        PreciseEquation { limits, fields, gap, cost: Cost::default() }
    }

    /// What it cost, in evaluations of a double.
    pub fn cost(&self) -> Cost {
        Cost { evaluations: COSTLIER * self.cost.evaluations, ..self.cost }
    }

    /// Where a swing ends, and when; an error without a reason where it escapes.
    fn swing(
        &mut self,
        index: usize,
        direction: Direction,
        start: Twofold,
    ) -> Result<(Twofold, Twofold), Option<Reason>> {
        let field = self.fields[index];
        let field = if direction == Direction::Forward { field } else { field.reversed() };
        let mut cost = Cost::default();
        let limits = Limits { evaluations: BUDGET, interrupted: self.limits.interrupted };
        let found = half_swing(field, start, GRAIN, &mut cost, &limits);
        self.cost += cost;
        found.map_err(Some)?.ok_or(None)
    }

    /// The residual at a clearance of the first swing; `None` where a swing escapes or is captured.
    pub fn at(&mut self, route: Route, start: Twofold) -> Result<Option<ClosingResidual>, Reason> {
        match self.residual(route, start) {
            Ok(residual) => Ok(Some(residual)),
            Err(None) => Ok(None),
            Err(Some(reason)) => Err(reason),
        }
    }

    /// The same; an error without a reason where there is none.
    fn residual(
        &mut self,
        route: Route,
        start: Twofold,
    ) -> Result<ClosingResidual, Option<Reason>> {
        use Direction::{Backward, Forward};
        let gap = self.gap;
        let positive = |length: Twofold| Some(length).filter(|it| it.high > 0.0).ok_or(None);
        let (second, times, difference, unit) = match route {
            Route::Forward => {
                let (end, time) = self.swing(0, Forward, start)?;
                let second = positive(end - gap)?;
                let (end, other) = self.swing(1, Forward, second)?;
                let end = positive(end - gap)?;
                (second, [time, other], end - start, start)
            }
            Route::Mixed => {
                let (second, time) = self.swing(1, Backward, start + gap)?;
                let (end, other) = self.swing(0, Forward, start)?;
                let target = second + gap;
                (second, [time, other], end - target, target)
            }
            Route::Backward => {
                let (second, time) = self.swing(1, Backward, start + gap)?;
                let (end, other) = self.swing(0, Backward, second + gap)?;
                (second, [time, other], start - end, end)
            }
        };
        let value = ln_1p(difference.over(unit).value());
        let duration = (times[0] + times[1]).value();
        let residual = ClosingResidual { value, second: second.value(), duration };
        let sound = value.is_finite() && residual.second > 0.0;
        sound.then_some(residual).ok_or(None)
    }
}
