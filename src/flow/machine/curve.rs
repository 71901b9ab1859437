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
    /// Where the velocity has its extremum in it.
    pub peak: Option<f64>,
    offset: f64,
    x: Box<Terms>,
    y: Box<Terms>,
}

impl Slip {
    /// Displacement and velocity (divided by the natural frequency) at a time from the start of the step.
    pub fn at(&self, t: f64) -> (f64, f64) {
        (value(&self.x[..], t) - self.offset, value(&self.y[..], t))
    }

    /// The time at which a series takes a value, in an interval at whose ends it lies on both sides.
    fn when(terms: &Terms, target: f64, (low, high): (f64, f64)) -> f64 {
        let bracket = Bracket { low, high, rising: value(terms, high) > value(terms, low) };
        let settled = PlaceTolerance::Absolute(1e-16 * span(low, high));
        let height = |t: f64| {
            let (height, slope) = value_and_slope(terms, t);
            (height - target, slope)
        };
        newton(bracket, bracket.middle(), settled, height).at
    }

    /// The velocity where the step passes a displacement; `None` where it does not.
    fn velocity_at(&self, x: f64) -> Option<f64> {
        let target = x + self.offset;
        let (from, to) = (self.x[0], value(&self.x[..], self.duration));
        if from.min(to) > target || from.max(to) < target {
            return None;
        }
        Some(value(&self.y[..], Self::when(&self.x, target, (0.0, self.duration))))
    }

    /// The parts of the step between the places where it passes these values of x and y.
    fn cuts(&self, window: &PhaseWindow) -> Vec<f64> {
        let mut cuts = vec![0.0];
        let turns = self.peak.into_iter().chain([self.duration]);
        let mut from = 0.0;
        for to in turns {
            let mut inside = |terms: &Terms, target: f64| {
                let (left, right) = (value(terms, from), value(terms, to));
                if left.min(right) < target && target < left.max(right) {
                    cuts.push(Self::when(terms, target, (from, to)));
                }
            };
            for x in [window.x.0, window.x.1] {
                inside(&self.x, x + self.offset);
            }
            for y in [window.y.0, window.y.1] {
                inside(&self.y, y);
            }
            cuts.push(to);
            from = to;
        }
        cuts.sort_by(f64::total_cmp);
        cuts
    }

    /// The integral of the clamped velocity over x, as far as x lies within the window.
    fn area(&self, window: &PhaseWindow) -> f64 {
        let cuts = self.cuts(window);
        let part = |ends: &[f64]| {
            let (from, length) = (ends[0], ends[1] - ends[0]);
            let (x, y) = self.at(from + 0.5 * length);
            if x < window.x.0 || x > window.x.1 {
                return 0.0;
            }
            if y > window.y.0 && y < window.y.1 {
                let square = |node: f64| powi(value(&self.y[..], from + node * length), 2);
                gauss(square) * length
            } else {
                let width = value(&self.x[..], ends[1]) - value(&self.x[..], from);
                y.clamp(window.y.0, window.y.1) * width.abs() * y.signum()
            }
        };
        cuts.windows(2).map(part).sum()
    }
}

fn span(low: f64, high: f64) -> f64 {
    low.abs().max(high.abs())
}

/// A rectangle of the phase plane; velocities divided by the natural frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseWindow {
    /// From which displacement to which.
    pub x: (f64, f64),
    /// From which velocity to which.
    pub y: (f64, f64),
}

impl PhaseWindow {
    pub fn area(&self) -> f64 {
        (self.x.1 - self.x.0) * (self.y.1 - self.y.0)
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
            peak: step.peak,
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

    /// The area within a closed curve.
    pub fn area(&self, speed: f64) -> f64 {
        let all = (f64::NEG_INFINITY, f64::INFINITY);
        self.area_within(&PhaseWindow { x: all, y: all }, speed)
    }

    /// Its points, `between` + 1 on each piece; velocities divided by the natural frequency.
    pub fn points(&self, between: u16, speed: f64) -> Vec<State> {
        let part = |point: u16| f64::from(point) / f64::from(between.max(1));
        let on = |piece: &CurvePiece| -> Vec<State> {
            let at = |point: u16| match piece {
                CurvePiece::Slip(slip) => slip.at(slip.duration * part(point)),
                CurvePiece::Line { from, to } => (from + part(point) * (to - from), speed),
            };
            (0..=between).map(at).map(|(q, v)| State { q, v }).collect()
        };
        self.pieces.iter().flat_map(on).collect()
    }

    /// The area that a closed curve has in common with a window: the integral of `y dx` along it, with y
    /// clamped to the window.
    pub fn area_within(&self, window: &PhaseWindow, speed: f64) -> f64 {
        let clamped = speed.clamp(window.y.0, window.y.1);
        let of = |piece: &CurvePiece| match piece {
            CurvePiece::Slip(slip) => slip.area(window),
            CurvePiece::Line { from, to } => {
                let (left, right) = (from.min(*to).max(window.x.0), from.max(*to).min(window.x.1));
                clamped * (right - left).max(0.0)
            }
        };
        self.pieces.iter().map(of).sum()
    }
}
