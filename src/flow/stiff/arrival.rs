//! The last step of a half swing: shortened until it ends at `v = 0`.

use crate::flow::{Step, StepPoint, StiffStepper};
use crate::model::PlaneField;
use crate::numerics::{Bracket, PlaceTolerance, bisect, try_newton};

/// Relative change of the length of the last step below which it counts as settled; this takes about four attempts.
const SETTLED: f64 = 1e-9;

impl<F: PlaneField> StiffStepper<F> {
    /// Shortens the step just kept until it ends at the first `v = 0`; `None` where that fails.
    pub(super) fn arrive(&mut self) -> Option<Step> {
        let (scheme, whole, polynomial) = (self.scheme, self.duration, self.dense[1]);
        let at = |length: f64| scheme.interpolated(&polynomial, length / whole);
        // The polynomial of the whole step locates the arrival roughly; steps that end there locate it exactly.
        let (low, high) = self.bracket(whole);
        let (low, high) = bisect(low, high, 10, |length| at(length) <= 0.0);
        let mut last = (whole, self.end, 0.0);
        let bracket = Bracket::falling(0.0, whole);
        try_newton(bracket, 0.5 * (low + high), PlaceTolerance::Relative(SETTLED), |length| {
            let guess = self.stages(|_, node| at(node * length));
            let end = self.attempt(length, guess).ok_or(())?;
            let slope = self.field.acceleration(end.x, end.v);
            last = (length, end, -end.v / slope);
            Ok::<_, ()>((end.v, slope))
        })
        .ok()?;
        let (length, end, rest) = last;
        (rest.abs() <= SETTLED * length).then(|| {
            // The stages belong to `length`: quantities computed from them must not be stretched by `rest`.
            self.keep(length, end);
            let end = StepPoint { x: end.x + 0.5 * rest * end.v, v: 0.0 };
            Step { duration: length + rest, end, crossed: true }
        })
    }

    /// Whether the place of an arrival is accurate relative to itself, not only relative to the position where
    /// its step began: a motion that creeps in from far out may end its swing in one step.
    pub(super) fn is_sharp(&mut self, arrival: &Step) -> bool {
        let scale = self.scale(arrival.duration, arrival.end);
        let place = StepPoint {
            x: scale.x * (arrival.end.x / self.start.size().max(arrival.end.x)),
            ..scale
        };
        arrival.end.x < f64::MIN_POSITIVE || self.error(arrival.duration, place, true) <= 1.0
    }

    /// Bracket of the first zero of the velocity in the step, as far as the stages tell.
    fn bracket(&self, whole: f64) -> (f64, f64) {
        let nodes = &self.scheme.nodes;
        match (0..nodes.len()).find(|stage| self.velocity[*stage] <= 0.0) {
            Some(0) => (0.0, nodes[0] * whole),
            Some(stage) => (nodes[stage - 1] * whole, nodes[stage] * whole),
            None => (0.0, whole),
        }
    }
}
