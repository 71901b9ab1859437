//! The border of the basin of rest where it is not a cycle: followed backward in time from where the return map
//! jumps.

use super::landmarks::Landmarks;
use crate::flow::machine::arc::ArcEnd;
use crate::flow::machine::curve::{CurvePiece, MachineCurve};
use crate::flow::{Flow, LostMotion};
use crate::model::Phase;

impl Flow<'_> {
    /// The closed border through a jump of the return map at the right turning point `x`, backward in time
    /// from the belt's line to the line again, and the piece of line between.
    pub(crate) fn jump_border(
        &mut self,
        x: f64,
        landmarks: Option<&Landmarks>,
        curve: &mut MachineCurve,
    ) -> Result<f64, LostMotion> {
        let speed = self.model.speed;
        let Some(marks) = landmarks else { return Err(LostMotion::Steps) };
        // Where static friction holds what the orbit comes from, its way to the line is not on the border.
        match self.arc(Phase::Between, (x, 0.0), true, &mut ()) {
            Ok(ArcEnd { on_belt: true, .. }) => {}
            Ok(_) | Err(LostMotion::Settled) => return self.capture_border(x, landmarks, curve),
            Err(stop) => return Err(stop),
        }
        let corner =
            if Some(x) == marks.grazing.right { marks.lines.fold } else { marks.lines.low };
        let left = self.left_before(corner, speed, curve)?;
        let left = left.min(-self.model.guide_static);
        self.arc(Phase::Below, (left, 0.0), true, curve)?;
        let mut end = self.arc(Phase::Between, (x, 0.0), true, curve)?;
        if end.on_belt && end.x > marks.lines.release {
            end = self.arc(Phase::Above, (end.x, speed), true, curve)?;
        }
        curve.pieces.push(CurvePiece::Line { from: corner, to: end.x });
        Ok(left)
    }

    /// The border through the right turning point `x` up to which the guide catches the mass: the motion
    /// that comes there, backward in time, and below it the one that comes to the left end of what is caught.
    pub(crate) fn capture_border(
        &mut self,
        x: f64,
        landmarks: Option<&Landmarks>,
        curve: &mut MachineCurve,
    ) -> Result<f64, LostMotion> {
        let (guide, speed) = (self.model.guide, self.model.speed);
        let mut left = match self.arc(Phase::Between, (x, 0.0), true, curve) {
            Err(LostMotion::Settled) => -guide,
            end => {
                let end = end?;
                let lines = landmarks.map(|marks| marks.lines).filter(|_| end.on_belt);
                lines.map_or(Ok(end.x), |lines| {
                    curve.pieces.push(CurvePiece::Line { from: lines.fold, to: end.x });
                    self.left_before(lines.fold, speed, curve)
                })?
            }
        };
        left = left.min(-self.model.guide_static);
        match self.arc(Phase::Below, (left, 0.0), true, curve) {
            Ok(_) | Err(LostMotion::Settled) => Ok(left),
            Err(stop) => Err(stop),
        }
    }
}
