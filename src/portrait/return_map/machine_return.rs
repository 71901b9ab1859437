//! The return map: from a right turning point to the next one.
//!
//! It never decreases, because motions in the plane may merge but not cross. On one interval it is constant: all
//! motions that come to ride on the belt leave it at the same place. So at most one cycle sticks to the belt, and its
//! multiplier is exactly 0; the fixed points order everything else.

use crate::flow::machine::arc::ArcEnd;
use crate::flow::machine::curve::{MachineCurve, MachineStep};
use crate::flow::machine::series::PhaseSeries;
use crate::flow::machine::turn::Turn;
use crate::flow::{Flow, Reason};
use crate::model::{ContactState, Lines, Phase};
use crate::numerics::elementary::ln;

/// The image of a right turning point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image {
    /// The next right turning point.
    pub x: f64,
    /// The left turning point between them.
    pub left: f64,
    /// Logarithm of the derivative of the map; minus infinity if it is constant there.
    pub log_slope: f64,
    /// Displacement at which the mass began to ride on the belt.
    pub sticks_from: Option<f64>,
    /// Displacement at which it left the belt's line upwards.
    pub overtakes_from: Option<f64>,
}

/// The result of following a motion for one return.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MachineReturn {
    /// It turns on the right again.
    Turns(Image),
    /// It comes to rest at this displacement.
    Rests(f64),
}

impl Flow<'_> {
    /// The next right turning point after the one at `x`, outside of what the guide holds. Fails with
    /// [`Reason`] if the motion does not turn; a motion that settles at an equilibrium counts as coming to rest.
    pub fn returned(&mut self, x: f64) -> Result<MachineReturn, Reason> {
        let mut divergence = 0.0;
        let mut add = |series: &PhaseSeries| divergence += series.divergence();
        let left = match self.turn(ContactState::Slips(Phase::Below), (x, 0.0), &mut add) {
            Ok(Turn { x, rests: true, .. }) => return Ok(MachineReturn::Rests(x)),
            Ok(turn) => turn,
            Err(Reason::Settles) => return Ok(MachineReturn::Rests(self.model.guide)),
            Err(stop) => return Err(stop),
        };
        match self.turn(ContactState::Slips(Phase::Between), (left.x, 0.0), &mut add) {
            Ok(Turn { x, rests: true, .. }) => Ok(MachineReturn::Rests(x)),
            Ok(Turn { x, way, .. }) => Ok(MachineReturn::Turns(Image {
                x,
                left: left.x,
                log_slope: left.way.log_ratio + way.log_ratio + divergence,
                sticks_from: way.sticks_from,
                overtakes_from: way.overtakes_from,
            })),
            Err(Reason::Settles) => Ok(MachineReturn::Rests(-self.model.guide)),
            Err(stop) => Err(stop),
        }
    }

    /// The right turning point before the left one at `left`, with the logarithm of (acceleration before the
    /// arc's end / after its start); `None` if no motion comes from one. Fails with [`Reason`] where the
    /// friction law ends or the steps run out.
    pub(crate) fn right_before(
        &mut self,
        left: f64,
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<Option<(f64, f64)>, Reason> {
        let left = left.min(-self.model.guide_static);
        match self.arc(Phase::Below, (left, 0.0), true, watch) {
            Ok(end) => Ok(Some((end.x, end.log_ratio()))),
            Err(Reason::Escapes) => Ok(None),
            Err(Reason::Settles) => Ok(Some((self.model.guide, f64::NEG_INFINITY))),
            Err(stop) => Err(stop),
        }
    }

    /// The inverse map at the right turning point `x`, for motions that always slip below the belt's speed:
    /// [`Image::x`] is the turning point before. It contracts where the map itself expands. `None` if no such motion
    /// leads to `x`. Fails with [`Reason`] where the friction law ends or the steps run out.
    pub fn preimage(&mut self, x: f64) -> Result<Option<Image>, Reason> {
        let mut divergence = 0.0;
        let mut add = |series: &PhaseSeries| divergence += series.divergence();
        let (left, entered) = match self.arc(Phase::Between, (x, 0.0), true, &mut add) {
            Ok(end) if end.on_belt => return Ok(None),
            Ok(end) => (end.x, end.log_ratio()),
            Err(Reason::Settles) => (-self.model.guide, f64::NEG_INFINITY),
            // Backward in time, damping adds energy: however far away it comes from, a motion turns before `x`.
            Err(Reason::Escapes) => return Ok(None),
            Err(stop) => return Err(stop),
        };
        let before = self.right_before(left, &mut add)?;
        Ok(before.map(|(x, ratio)| Image {
            x,
            left,
            log_slope: divergence - entered - ratio,
            sticks_from: None,
            overtakes_from: None,
        }))
    }

    /// The left turning point from which a motion between rest and the belt's speed reaches `(x, y)`; where
    /// there is none, the edge of what the guide holds. Fails with [`Reason`] where the friction law ends or the
    /// steps run out.
    pub fn left_before(
        &mut self,
        x: f64,
        y: f64,
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<f64, Reason> {
        match self.arc(Phase::Between, (x, y), true, watch) {
            Ok(end) => Ok(end.x),
            Err(Reason::Settles) => Ok(-self.model.guide),
            Err(stop) => Err(stop),
        }
    }
}

// The special motions at the belt's line: those that touch it, are released by it, or overtake it.

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
    /// The landmarks; `None` without a belt, or without a law for small slips. Fails with [`Reason`] if the
    /// friction law ends before they are reached.
    pub fn landmarks(&mut self) -> Result<Option<Landmarks>, Reason> {
        let model = self.model;
        let Some(lines) = model.lines else { return Ok(None) };
        let grazing = self.grazing(&lines)?;
        let released =
            match self.turn(ContactState::Sticks, (lines.release, model.speed), &mut |_| {}) {
                Ok(turn) => (!turn.rests).then_some(turn.x),
                Err(Reason::Settles) => None,
                Err(stop) => return Err(stop),
            };
        let low_left = self.left_before(lines.low, model.speed, &mut |_| {})?;
        let beyond = self.beyond(&lines, low_left)?;
        Ok(Some(Landmarks { lines, grazing, released, low_left, beyond }))
    }

    fn grazing(&mut self, lines: &Lines) -> Result<Grazing, Reason> {
        let (guide, speed) = (self.model.guide, self.model.speed);
        let mut divergence = 0.0;
        let mut add = |series: &PhaseSeries| divergence += series.divergence();
        let left = self.left_before(lines.fold, speed, &mut add)?;
        // If overdamped, it comes to rest without another turn.
        let after = match self.arc(Phase::Between, (lines.fold, speed), false, &mut add) {
            Ok(end) => end.x,
            Err(Reason::Settles) => -guide,
            Err(stop) => return Err(stop),
        };
        let left = left.min(-self.model.guide_static);
        let before = match self.right_before(left, &mut add) {
            Err(Reason::BeyondLaw { .. }) => None,
            before => before?,
        };
        let (right, ratio) = before.map_or((None, 0.0), |(right, ratio)| (Some(right), ratio));
        let between = (left + guide) / (after + guide);
        let log_slope =
            if after > -guide { divergence - ratio + ln(between.abs()) } else { f64::NEG_INFINITY };
        Ok(Grazing { left, right, image: after, log_slope })
    }

    /// The right turning point beyond which motions overtake the belt instead of riding on it.
    fn beyond(&mut self, lines: &Lines, low_left: f64) -> Result<Option<f64>, Reason> {
        let speed = self.model.speed;
        // The last motion that comes down on the band is followed back to where it rose above the line.
        let back = |stop| match stop {
            Reason::Escapes | Reason::Settles | Reason::BeyondLaw { .. } => Ok(None),
            _ => Err(stop),
        };
        let rose = match self.arc(Phase::Above, (lines.release, speed), true, &mut |_| {}) {
            Ok(end) => end.x,
            Err(stop) => return back(stop),
        };
        let left =
            if rose >= lines.low { low_left } else { self.left_before(rose, speed, &mut |_| {})? };
        let found =
            self.right_before(left, &mut |_| {}).or_else(|stop| back(stop).map(|_| None))?;
        Ok(found.map(|(right, _)| right))
    }
}

// The border of the basin of rest where it is not a cycle: followed backward in time from where the return map
// jumps.

impl Flow<'_> {
    /// The closed border through a jump of the return map at the right turning point `x`, backward in time
    /// from the belt's line to the line again, and the piece of line between.
    pub(crate) fn jump_border(
        &mut self,
        x: f64,
        landmarks: Option<&Landmarks>,
    ) -> Result<(MachineCurve, f64), Reason> {
        let speed = self.model.speed;
        let Some(marks) = landmarks else { return Err(Reason::Steps) };
        // Where static friction holds what the orbit comes from, its way to the line is not on the border.
        match self.arc(Phase::Between, (x, 0.0), true, &mut |_| {}) {
            Ok(ArcEnd { on_belt: true, .. }) => {}
            Ok(_) | Err(Reason::Settles) => return self.capture_border(x, landmarks),
            Err(stop) => return Err(stop),
        }
        let mut curve = MachineCurve::default();
        let corner =
            if Some(x) == marks.grazing.right { marks.lines.fold } else { marks.lines.low };
        let left = self.left_before(corner, speed, &mut curve.keeper())?;
        let left = left.min(-self.model.guide_static);
        self.arc(Phase::Below, (left, 0.0), true, &mut curve.keeper())?;
        let mut end = self.arc(Phase::Between, (x, 0.0), true, &mut curve.keeper())?;
        if end.on_belt && end.x > marks.lines.release {
            end = self.arc(Phase::Above, (end.x, speed), true, &mut curve.keeper())?;
        }
        curve.steps.push(MachineStep::ride(corner, end.x, speed));
        Ok((curve, left))
    }

    /// The border through the right turning point `x` up to which the guide catches the mass: the motion
    /// that comes there, backward in time, and below it the one that comes to the left end of what is caught.
    pub(crate) fn capture_border(
        &mut self,
        x: f64,
        landmarks: Option<&Landmarks>,
    ) -> Result<(MachineCurve, f64), Reason> {
        let (guide, speed) = (self.model.guide, self.model.speed);
        let mut curve = MachineCurve::default();
        let rise = self.arc(Phase::Between, (x, 0.0), true, &mut curve.keeper());
        let mut left = match rise {
            Err(Reason::Settles) => -guide,
            end => {
                let end = end?;
                let lines = landmarks.map(|marks| marks.lines).filter(|_| end.on_belt);
                lines.map_or(Ok(end.x), |lines| {
                    curve.steps.push(MachineStep::ride(lines.fold, end.x, speed));
                    self.left_before(lines.fold, speed, &mut curve.keeper())
                })?
            }
        };
        left = left.min(-self.model.guide_static);
        let fall = self.arc(Phase::Below, (left, 0.0), true, &mut curve.keeper());
        match fall {
            Ok(_) | Err(Reason::Settles) => Ok((curve, left)),
            Err(stop) => Err(stop),
        }
    }
}
