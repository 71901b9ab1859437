//! A piece of a motion kept as a curve: the series of its steps, and the rides on the belt between them.

use super::arc::{SeriesStep, Watch};
use super::series::Terms;
use crate::model::{Model, Phase, State};
use crate::numerics::elementary::powi;
use crate::numerics::polynomial::{value, value_and_slope};
use crate::numerics::quadrature::gauss;
use crate::numerics::root::{Bracket, PlaceTolerance, newton};

#[derive(Clone, Debug)]
pub enum CurvePiece {
    /// A step in slip: its series hold everywhere between its ends.
    Slip(Slip),
    /// A ride on the belt, or another piece of its line, from one displacement to another.
    Line {
        /// Where it begins.
        from: f64,
        /// Where it ends.
        to: f64,
    },
}

/// A step in slip.
#[derive(Clone, Debug)]
pub struct Slip {
    pub phase: Phase,
    /// Duration, in `1/omega_0`.
    pub duration: f64,
    offset: f64,
    x: Box<Terms>,
    y: Box<Terms>,
}

impl Slip {
    /// Displacement and velocity (divided by the natural frequency) at a time from the start of the step.
    pub fn at(&self, t: f64) -> (f64, f64) {
        (value(&self.x[..], t) - self.offset, value(&self.y[..], t))
    }

    /// The velocity where the step passes a displacement; `None` where it does not.
    fn velocity_at(&self, x: f64) -> Option<f64> {
        let target = x + self.offset;
        let (from, to) = (self.x[0], value(&self.x[..], self.duration));
        if from.min(to) > target || from.max(to) < target {
            return None;
        }
        let bracket = Bracket { low: 0.0, high: self.duration, rising: to > from };
        let settled = PlaceTolerance::Absolute(1e-16 * self.duration.abs());
        let height = |t: f64| {
            let (height, slope) = value_and_slope(&self.x[..], t);
            (height - target, slope)
        };
        let time = newton(bracket, bracket.middle(), settled, height).at;
        Some(value(&self.y[..], time))
    }
}

impl CurvePiece {
    /// `between` + 1 of its points.
    pub fn points(&self, between: u16, speed: f64) -> impl Iterator<Item = State> {
        let part = move |point: u16| f64::from(point) / f64::from(between.max(1));
        let at = move |point: u16| match self {
            CurvePiece::Slip(slip) => slip.at(slip.duration * part(point)),
            CurvePiece::Line { from, to } => (from + part(point) * (to - from), speed),
        };
        (0..=between).map(at).map(|(q, v)| State { q, v })
    }
}

/// A motion, or the border of a basin, as a curve in the phase plane.
#[derive(Clone, Debug, Default)]
pub struct MachineCurve {
    /// Its pieces, in the order in which they were computed, forward or backward in time.
    pub pieces: Vec<CurvePiece>,
}

impl Watch for MachineCurve {
    fn follows(&self) -> bool {
        true
    }

    fn step(&mut self, model: &Model, step: &SeriesStep) {
        self.pieces.push(CurvePiece::Slip(Slip {
            phase: step.phase,
            duration: step.duration,
            offset: model.offset(step.phase),
            x: Box::new(step.series.x),
            y: Box::new(step.series.y),
        }));
    }

    fn stick(&mut self, _: &Model, from: f64, to: f64) {
        self.pieces.push(CurvePiece::Line { from, to });
    }
}

impl MachineCurve {
    /// The velocities at which it passes a displacement, at `y > 0` and at `y < 0`; `speed` is that of the
    /// belt.
    pub fn velocities_at(&self, x: f64, speed: f64) -> (Option<f64>, Option<f64>) {
        let mut found = (None, None);
        for piece in &self.pieces {
            match piece {
                CurvePiece::Slip(slip) => {
                    if let Some(y) = slip.velocity_at(x) {
                        if slip.phase == Phase::Below {
                            found.1 = Some(y);
                        } else {
                            found.0 = Some(y);
                        }
                    }
                }
                CurvePiece::Line { from, to } => {
                    if from.min(*to) <= x && x <= from.max(*to) {
                        found.0 = Some(speed);
                    }
                }
            }
        }
        found
    }

    /// The area within a closed curve: the integral of `y dx` along it, which is that of `y^2` over time.
    pub fn area(&self, speed: f64) -> f64 {
        let of = |piece: &CurvePiece| match piece {
            CurvePiece::Slip(slip) => {
                gauss(|part| powi(slip.at(part * slip.duration).1, 2)) * slip.duration
            }
            CurvePiece::Line { from, to } => speed * (to - from).abs(),
        };
        self.pieces.iter().map(of).sum()
    }

    /// The displacements at which its pieces end: it is smooth between them.
    pub fn ends(&self) -> Vec<f64> {
        let of = |piece: &CurvePiece| match piece {
            CurvePiece::Slip(slip) => [0.0, slip.duration].map(|t| slip.at(t).0),
            CurvePiece::Line { from, to } => [*from, *to],
        };
        self.pieces.iter().flat_map(of).collect()
    }

    /// Its points, `between` + 1 on each piece; velocities divided by the natural frequency.
    pub fn points(&self, between: u16, speed: f64) -> Vec<State> {
        self.pieces.iter().flat_map(|piece| piece.points(between, speed)).collect()
    }

    /// The same as a closed curve to be drawn, on which the belt's line needs its ends alone.
    pub fn closed(&self, between: u16, speed: f64) -> Vec<State> {
        let on = |piece: &CurvePiece| match piece {
            CurvePiece::Slip(_) => between,
            CurvePiece::Line { .. } => 1,
        };
        let pieces = self.pieces.iter();
        let mut found: Vec<State> =
            pieces.flat_map(|piece| piece.points(on(piece), speed)).collect();
        found.extend(found.first().copied());
        found
    }
}
