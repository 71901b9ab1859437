//! The graph `D(u)` of all cycles, followed to its top.
//!
//! The slow and sure way to a fold, for where Newton's method on both of its equations fails: where D3 is
//! much weaker than D2, so that the graph is flat, and beyond critical negative damping.

use super::{CurvePoint, CycleCurve, FoldPoint, Tangent};
use crate::closed_form::harmonic;
use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::{Knob, Parameters};
use crate::numerics::{exp, ln, try_maximum};
use crate::portrait::Route;

/// Finds the cycle of the largest D, to a relative error `tolerance` of its clearance; that of D is the square, to
/// rounding. Beside it stands the logarithm of its multiplier, which is far from 0 where it is no fold.
///
/// The result may be an error: the [`Reason`] why a swing failed, or [`Reason::NoConvergence`].
pub fn highest_cycle(
    parameters: &Parameters,
    tolerance: f64,
    limits: &Limits,
) -> (Result<(FoldPoint, f64)>, Cost) {
    let Some((u, d, stride)) = start(parameters) else { return (Err(LOST), Cost::default()) };
    let curve = CycleCurve::new(parameters, Knob::D, 1.0, tolerance, limits);
    let mut graph = Graph { curve, d };
    let met = graph.meeting(u, stride).map(|CurvePoint { p, closing, log_multiplier, .. }| {
        (FoldPoint::of(&closing, &graph.curve.parameters_at(p)), log_multiplier)
    });
    (met, graph.curve.cost)
}

pub(crate) const LOST: Reason = Reason::NoConvergence { sought: "the fold", change: f64::NAN };

/// Where the search begins, and its first stride in u: the harmonic estimate where it is near, else a cycle close to the
/// sticking set, which lies below the fold.
fn start(parameters: &Parameters) -> Option<(f64, f64, f64)> {
    /// Mean shift, as a fraction of the amplitude, and damping up to which the harmonic estimate is near.
    const NEAR: (f64, f64) = (0.3, 0.8);
    /// Clearance that is small, in units of r.
    const CLOSE: f64 = 0.2;
    let estimate = harmonic::fold(parameters.d3, parameters.r)?;
    // The first swing starts where its side's D2 brakes: the turning point displaced outwards.
    let shift = harmonic::mean(parameters.d2.abs(), estimate.amplitude).abs();
    let near = shift < NEAR.0 * estimate.amplitude && estimate.d > -NEAR.1;
    let clearance = if near {
        estimate.amplitude + shift - parameters.r
    } else {
        CLOSE * parameters.r
    };
    let u = ln(clearance.max(CLOSE * parameters.r));
    Some((u, estimate.d.max(-0.5), if near { 0.2 } else { 0.5 }))
}

/// All cycles as the graph `D(u)`.
struct Graph<'a> {
    curve: CycleCurve<'a>,
    /// D of the last cycle found, the guess for the next.
    d: f64,
}

impl Graph<'_> {
    /// The cycle at which two meet.
    fn meeting(&mut self, u: f64, stride: f64) -> Result<CurvePoint> {
        let [low, high] = self.around_fold(u, stride)?;
        if low.u == high.u {
            return Ok(high);
        }
        let fold = self.curve.fold_between(&low, &high)?;
        fold.map_or_else(|| self.highest(low, high), Ok)
    }

    /// The cycle at `u`; `None` where it cannot be followed that far out.
    fn at(&mut self, u: f64) -> Result<Option<CurvePoint>> {
        let near = self.curve.correct((u, self.d), Tangent::ACROSS_P, Route::Mixed)?;
        let found = match near {
            Some(found) => Some(found),
            // Far from the guess: start over with all of the dampings that can close a cycle.
            None => match self.curve.bracketed(u, (self.lowest_damping(u), 0.0)) {
                Err(Reason::Budget { .. } | Reason::OutOfRange) => None,
                found => found?,
            },
        };
        if let Some(found) = found {
            self.d = found.p;
        }
        Ok(found)
    }

    /// A damping below that of the cycle at `u`: well beyond the harmonic one, and beyond critical.
    fn lowest_damping(&self, u: f64) -> f64 {
        let Parameters { d2, d3, r, .. } = self.curve.parameters_at(self.d);
        let harmonic = harmonic::damping_at(d3, r, exp(u) + r).unwrap_or(-1.0);
        -1.5 + 2.0 * harmonic - r * d2.abs()
    }

    /// A cycle on either side of the fold: the inner ones are unstable (multiplier above 1), the outer
    /// ones stable.
    ///
    /// Both are one where cycles grow and grow while D stays the same to rounding: the fold is where they begin to
    /// shrink, and its D is this one. So it is where D3 is much weaker than D2.
    fn around_fold(&mut self, u: f64, mut stride: f64) -> Result<[CurvePoint; 2]> {
        /// Shortest and longest stride, and strides before giving up.
        const LENGTHS: (f64, f64) = (0.01, 1.0);
        const STRIDES: usize = 60;
        let here = self.at(u)?.ok_or(LOST)?;
        let (mut low, mut high) = (here, here);
        let mut flat = false;
        for _ in 0..STRIDES {
            // Where the second swing begins at the very end of the sticking set there is no multiplier:
            // next to it it is infinite.
            let inwards = low.log_multiplier <= 0.0;
            if !inwards && high.log_multiplier <= 0.0 {
                return Ok([low, high]);
            }
            let u = if inwards { low.u - stride } else { high.u + stride };
            match self.at(u)? {
                Some(next) if inwards => low = next,
                Some(next) => {
                    // The fold lies beyond: what is behind is no longer needed.
                    if next.log_multiplier > 0.0 || next.log_multiplier.is_nan() {
                        low = next;
                    }
                    let rise = (next.p - high.p).abs();
                    flat = rise <= 4.0 * self.curve.fineness() * next.p.abs();
                    high = next;
                    if flat && stride >= LENGTHS.1 {
                        return Ok([high, high]);
                    }
                }
                // Nor can it be followed to its end.
                None if flat => return Ok([high, high]),
                None => stride *= 0.25,
            }
            stride = (1.5 * stride).min(LENGTHS.1);
            if stride < LENGTHS.0 {
                break;
            }
        }
        Err(LOST)
    }

    /// The cycle of the largest D between two, by golden section.
    ///
    /// For where the multiplier does not tell: beyond critical negative damping the second swing of a
    /// cycle may begin at the very end of the sticking set. D comes out to rounding, the amplitude to
    /// about half of the digits.
    fn highest(&mut self, low: CurvePoint, high: CurvePoint) -> Result<CurvePoint> {
        /// Width in u at which D is flat to rounding.
        const FLAT: f64 = 1e-7;
        let mut best = None::<CurvePoint>;
        try_maximum(low.u, high.u, FLAT, |u| {
            let found = self.at(u)?.ok_or(LOST)?;
            if best.is_none_or(|best| found.p >= best.p) {
                best = Some(found);
            }
            Ok(found.p)
        })?;
        best.ok_or(LOST)
    }
}
