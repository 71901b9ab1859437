//! The return map: from a right turning point to the next one.
//!
//! It never decreases, because motions in the plane may merge but not cross. On one interval it is constant: all
//! motions that come to ride on the belt leave it at the same place. So at most one cycle sticks to the belt, and its
//! multiplier is exactly 0; the fixed points order everything else.

use crate::flow::machine::arc::{SeriesStep, Watch};
use crate::flow::machine::turn::{ContactState, Turn};
use crate::flow::{Flow, LostMotion};
use crate::model::{Model, Phase};
use crate::numerics::quadrature::gauss;

/// The integral of the divergence of the field along a motion.
#[derive(Clone, Copy, Debug, Default)]
pub struct Divergence(pub f64);

impl Watch for Divergence {
    fn step(&mut self, _: &Model, step: &SeriesStep) {
        self.0 += gauss(|node| step.series.force_slope(node * step.duration)) * step.duration;
    }
}

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
    /// [`LostMotion`] if the motion does not turn; a motion that settles at an equilibrium counts as coming to rest.
    pub fn returned(&mut self, x: f64) -> Result<MachineReturn, LostMotion> {
        let mut divergence = Divergence::default();
        let left = match self.turn(ContactState::Slips(Phase::Below), (x, 0.0), &mut divergence) {
            Ok(Turn { x, rests: true, .. }) => return Ok(MachineReturn::Rests(x)),
            Ok(turn) => turn,
            Err(LostMotion::Settled) => return Ok(MachineReturn::Rests(self.model.guide)),
            Err(stop) => return Err(stop),
        };
        match self.turn(ContactState::Slips(Phase::Between), (left.x, 0.0), &mut divergence) {
            Ok(Turn { x, rests: true, .. }) => Ok(MachineReturn::Rests(x)),
            Ok(Turn { x, way, .. }) => Ok(MachineReturn::Turns(Image {
                x,
                left: left.x,
                log_slope: left.way.log_ratio + way.log_ratio + divergence.0,
                sticks_from: way.sticks_from,
                overtakes_from: way.overtakes_from,
            })),
            Err(LostMotion::Settled) => Ok(MachineReturn::Rests(-self.model.guide)),
            Err(stop) => Err(stop),
        }
    }

    /// The right turning point before the left one at `left`, with the logarithm of (acceleration before the
    /// arc's end / after its start); `None` if no motion comes from one. Fails with [`LostMotion`] where the
    /// friction law ends or the steps run out.
    pub(crate) fn right_before(
        &mut self,
        left: f64,
        watch: &mut impl Watch,
    ) -> Result<Option<(f64, f64)>, LostMotion> {
        let left = left.min(-self.model.guide_static);
        match self.arc(Phase::Below, (left, 0.0), true, watch) {
            Ok(end) => Ok(Some((end.x, end.log_ratio()))),
            Err(LostMotion::Escaped) => Ok(None),
            Err(LostMotion::Settled) => Ok(Some((self.model.guide, f64::NEG_INFINITY))),
            Err(stop) => Err(stop),
        }
    }

    /// The inverse map at the right turning point `x`, for motions that always slip below the belt's speed:
    /// [`Image::x`] is the turning point before. It contracts where the map itself expands. `None` if no such motion
    /// leads to `x`. Fails with [`LostMotion`] where the friction law ends or the steps run out.
    pub fn preimage(&mut self, x: f64) -> Result<Option<Image>, LostMotion> {
        let mut divergence = Divergence::default();
        let (left, entered) = match self.arc(Phase::Between, (x, 0.0), true, &mut divergence) {
            Ok(end) if end.on_belt => return Ok(None),
            Ok(end) => (end.x, end.log_ratio()),
            Err(LostMotion::Settled) => (-self.model.guide, f64::NEG_INFINITY),
            // Backward in time, damping adds energy: however far away it comes from, a motion turns before `x`.
            Err(LostMotion::Escaped) => return Ok(None),
            Err(stop) => return Err(stop),
        };
        let before = self.right_before(left, &mut divergence)?;
        Ok(before.map(|(x, ratio)| Image {
            x,
            left,
            log_slope: divergence.0 - entered - ratio,
            sticks_from: None,
            overtakes_from: None,
        }))
    }

    /// The left turning point from which a motion between rest and the belt's speed reaches `(x, y)`; where
    /// there is none, the edge of what the guide holds. Fails with [`LostMotion`] where the friction law ends or the
    /// steps run out.
    pub fn left_before(
        &mut self,
        x: f64,
        y: f64,
        watch: &mut impl Watch,
    ) -> Result<f64, LostMotion> {
        match self.arc(Phase::Between, (x, y), true, watch) {
            Ok(end) => Ok(end.x),
            Err(LostMotion::Settled) => Ok(-self.model.guide),
            Err(stop) => Err(stop),
        }
    }
}
