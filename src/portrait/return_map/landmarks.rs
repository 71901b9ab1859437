//! The special motions at the belt's line: those that touch it, are released by it, or overtake it.

use super::machine_return::Divergence;
use crate::flow::machine::turn::ContactState;
use crate::flow::{Flow, LostMotion};
use crate::model::{Lines, Phase};
use crate::numerics::elementary::ln;

/// The orbit that touches the belt's line, as if it continued to slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grazing {
    /// Left turning point before the contact.
    pub left: f64,
    /// Right turning point before that; `None` if no motion comes from one.
    pub right: Option<f64>,
    /// Right turning point after the contact.
    pub image: f64,
    /// Logarithm of the derivative of the return map there, from below.
    pub log_slope: f64,
}

/// The places at which the return map changes its form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landmarks {
    /// The places on the belt's line.
    pub lines: Lines,
    /// The orbit that touches the line.
    pub grazing: Grazing,
    /// Right turning point after a release from the belt; `None` if the mass then comes to rest at once.
    pub released: Option<f64>,
    /// Left turning point from which the lower end of the stick band is reached.
    pub low_left: f64,
    /// Right turning point beyond which motions overtake the belt instead of ending on the band; `None` if all
    /// end on it.
    pub beyond: Option<f64>,
}

impl Flow<'_> {
    /// The landmarks; `None` without a belt, or without a law for small slips. Fails with [`LostMotion`] if the
    /// friction law ends before they are reached.
    pub fn landmarks(&mut self) -> Result<Option<Landmarks>, LostMotion> {
        let model = self.model;
        let Some(lines) = model.lines else { return Ok(None) };
        let grazing = self.grazing(&lines)?;
        let released = match self.turn(ContactState::Sticks, (lines.release, model.speed), &mut ())
        {
            Ok(turn) => (!turn.rests).then_some(turn.x),
            Err(LostMotion::Settled) => None,
            Err(stop) => return Err(stop),
        };
        let low_left = self.left_before(lines.low, model.speed, &mut ())?;
        let beyond = self.beyond(&lines, low_left)?;
        Ok(Some(Landmarks { lines, grazing, released, low_left, beyond }))
    }

    fn grazing(&mut self, lines: &Lines) -> Result<Grazing, LostMotion> {
        let (guide, speed) = (self.model.guide, self.model.speed);
        let mut divergence = Divergence::default();
        let left = self.left_before(lines.fold, speed, &mut divergence)?;
        // If overdamped, it comes to rest without another turn.
        let after = match self.arc(Phase::Between, (lines.fold, speed), false, &mut divergence) {
            Ok(end) => end.x,
            Err(LostMotion::Settled) => -guide,
            Err(stop) => return Err(stop),
        };
        let left = left.min(-self.model.guide_static);
        let before = match self.right_before(left, &mut divergence) {
            Err(LostMotion::OutsideLaw { .. }) => None,
            before => before?,
        };
        let (right, ratio) = before.map_or((None, 0.0), |(right, ratio)| (Some(right), ratio));
        let between = (left + guide) / (after + guide);
        let log_slope = if after > -guide {
            divergence.0 - ratio + ln(between.abs())
        } else {
            f64::NEG_INFINITY
        };
        Ok(Grazing { left, right, image: after, log_slope })
    }

    /// The right turning point beyond which motions overtake the belt instead of riding on it.
    fn beyond(&mut self, lines: &Lines, low_left: f64) -> Result<Option<f64>, LostMotion> {
        let speed = self.model.speed;
        // The last motion that comes down on the band is followed back to where it rose above the line.
        let back = |stop| match stop {
            LostMotion::Escaped | LostMotion::Settled | LostMotion::OutsideLaw { .. } => Ok(None),
            LostMotion::Steps => Err(LostMotion::Steps),
        };
        let rose = match self.arc(Phase::Above, (lines.release, speed), true, &mut ()) {
            Ok(end) => end.x,
            Err(stop) => return back(stop),
        };
        let left =
            if rose >= lines.low { low_left } else { self.left_before(rose, speed, &mut ())? };
        let found = self.right_before(left, &mut ()).or_else(|stop| back(stop).map(|_| None))?;
        Ok(found.map(|(right, _)| right))
    }
}
