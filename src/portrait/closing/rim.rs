//! Where motions go that leave the end of the sticking set, a node that repels (`D < -1`).

use super::equation::Equation;
use super::half_map::{Length, NoEnd};
use crate::flow::{Limits, Reason};
use crate::model::{Parameters, Side};
use crate::numerics::elementary::{ln, log10, pow};

/// How motions from the end of the sticking set come back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WayFromRim {
    /// By how much, as a logarithm, they come back beyond the sticking set; negative where they are captured.
    pub excess: f64,
    /// Their right turning point.
    pub q_max: f64,
}

impl Equation {
    /// Logarithm of the clearance below which no first swing of a cycle starts where the end of the sticking set
    /// is a node that repels (`D <= -1`); `None` where no swing from there comes back.
    ///
    /// Every second swing, however close to the sticking set it starts, ends beyond the one that creeps out
    /// from its rim, and the next first swing starts there.
    pub fn rim(&mut self, limits: &Limits) -> Result<Option<f64>, Reason> {
        let r = self.parameters.r;
        let rim = self.rim_start();
        let mut bound = f64::NEG_INFINITY;
        for map in &mut self.forward {
            match map.swing(rim, limits) {
                Ok(swing) => bound = ln(swing.end.value - 2.0 * r),
                Err(NoEnd::Escapes) => return Ok(None),
                Err(NoEnd::Never) => bound = f64::NEG_INFINITY,
                Err(NoEnd::Failed(reason)) => return Err(reason),
            }
        }
        Ok(Some(if bound.is_nan() { f64::NEG_INFINITY } else { bound }))
    }

    /// The way of motions that leave the end of the sticking set, a node that repels (`D < -1`), on the side on which
    /// they come further.
    pub fn way_from_rim(&mut self, limits: &Limits) -> Result<WayFromRim, Reason> {
        let Parameters { r, .. } = self.parameters;
        let gap = 2.0 * r;
        let rim = self.rim_start();
        let mut best = WayFromRim { excess: f64::NEG_INFINITY, q_max: r };
        for (side, index) in [(self.side, 0), (self.side.opposite(), 1)] {
            let (mut start, mut excess) = (rim, f64::INFINITY);
            let mut turning = 0.0;
            for map in [index, 1 - index] {
                let end = match self.forward[map].swing(start, limits) {
                    Ok(swing) => swing.end.value,
                    Err(NoEnd::Never) => 0.0,
                    Err(NoEnd::Escapes) => f64::INFINITY,
                    Err(NoEnd::Failed(reason)) => return Err(reason),
                };
                excess = excess.min(ln(end / gap));
                if map == index {
                    turning = end - gap;
                }
                if excess <= 0.0 || end.is_infinite() {
                    break;
                }
                start = Length::new(end - gap);
            }
            if excess > best.excess {
                // Above `v = 0` the first swing ends on the right, below it starts there.
                let q_max = if side == Side::Upper { r + turning.max(0.0) } else { r };
                best = WayFromRim { excess, q_max };
            }
        }
        Ok(best)
    }

    /// A start so near the end of the sticking set, a node that repels, that starting nearer changes nothing.
    ///
    /// Motions leave it along its faster direction; what is left of the slower one is the start to the power of one
    /// less the ratio of both rates.
    fn rim_start(&self) -> Length {
        /// What may be left, and the decimal exponent that is far enough where both rates are alike.
        const LEFT: f64 = 1e-17;
        const FAR: f64 = -60.0;
        let Parameters { d, d2, d3, r } = self.parameters;
        let natural = (1.0 / d2.abs()).min(1.0 / d3.abs().sqrt());
        let root = (d * d - 1.0).max(0.0).sqrt();
        let unlike = 2.0 * root / (root - d);
        let exponent = (log10(LEFT) / unlike).max(FAR);
        Length::new(pow(10.0, exponent) * natural.min(r))
    }
}
