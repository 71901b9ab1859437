//! A step within one phase, and where it reaches a switching line.
//!
//! `y'' = -y` wherever `y' = 0`: the speed has one maximum in each phase and no minimum. A step during which
//! the acceleration keeps its sign is therefore monotone in y, and one during which it changes it turns
//! exactly once. So the values at the ends of a step and at that maximum decide whether a line was reached,
//! however shallow the contact; nothing is sampled.

use super::MachineStep;
use crate::flow::StepPoint;
use crate::model::Phase;
use crate::numerics::{Bracket, PlaceTolerance, newton};

/// A step within a phase, by any method.
pub(super) struct PhaseStep {
    pub step: MachineStep,
    /// Its end: displacement from the balance of the phase, and velocity.
    pub end: StepPoint,
    /// Accelerations at its start and at its end.
    pub slopes: (f64, f64),
    /// The level at which it ends, and whether the force is unknown beyond, unless that is a switching line.
    pub level: Option<(f64, bool)>,
}

/// Where a step turns, and the first of two levels that it reaches, with the time at which it does; given that the speed
/// turns at most once, from growing to falling.
///
/// `inside` is the velocity with its derivative at a time from the start of the step, `turning` this one with the next.
pub(super) fn crossing(
    phase: Phase,
    end: f64,
    (low, high): (f64, f64),
    inside: &impl Fn(f64) -> (f64, f64),
    turning: &impl Fn(f64) -> (f64, f64),
) -> (Option<f64>, Option<(f64, f64)>) {
    let sign = phase.sign();
    let (outer, inner) = if sign > 0.0 { (high, low) } else { (low, high) };
    let grows = |slope: f64| sign * slope > 0.0;
    let beyond = |y: f64, level: f64| sign * (y - level);
    // On a bracket in which y is monotone.
    let root = |level: f64, (low, high): (f64, f64), rising: bool| {
        let settled = PlaceTolerance::Absolute(1e-16 * high);
        let ahead = |t: f64| {
            let (velocity, slope) = inside(t);
            (velocity - level, slope)
        };
        newton(Bracket { low, high, rising }, high, settled, ahead)
    };
    let (velocity, slope) = inside(end);
    let mut peak = None;
    if grows(inside(0.0).1) {
        let (until, fastest) = if grows(slope) {
            (end, velocity)
        } else {
            let bracket = Bracket { low: 0.0, high: end, rising: sign < 0.0 };
            // Where the velocity is flat, an error e in time costs only e^2 in it.
            let settled = PlaceTolerance::Absolute(1e-9 * end);
            let turn = newton(bracket, 0.5 * end, settled, turning);
            peak = Some(turn);
            (turn, inside(turn).0)
        };
        if beyond(fastest, outer) >= 0.0 {
            return (peak, Some((root(outer, (0.0, until), sign > 0.0), outer)));
        }
    }
    let falls = beyond(velocity, inner) <= 0.0 && !grows(slope);
    let begin = peak.unwrap_or(0.0);
    (peak, falls.then(|| (root(inner, (begin, end), sign < 0.0), inner)))
}
