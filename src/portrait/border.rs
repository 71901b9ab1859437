//! What borders the basin of rest: how cycles tell its kind, and the curve that it was traced as.

use super::{Cycle, Orbit};
use crate::flow::MachineCurve;
use crate::model::{Border, Parameters, State};
use crate::numerics::{by_number, hypot, maximum, range};

impl Border {
    /// What borders the basin: the innermost cycle, else a separatrix where motions can escape.
    pub fn around(parameters: &Parameters, cycles: &[Cycle]) -> Self {
        let self_excited_node = parameters.d <= -1.0 && parameters.r > 0.0;
        // Without friction a rest that repels has no basin, and nothing borders it.
        let repels = parameters.r == 0.0 && parameters.d < 0.0;
        let escapes = parameters.d3 == 0.0 && parameters.d2 != 0.0 && !repels;
        // Positive cubic damping bounds every motion: where no cycle is left for it, it comes to rest.
        let bounded = parameters.d3 > 0.0;
        match cycles.first().map(|cycle| cycle.stable) {
            Some(false) => Border::Cycle,
            Some(true) if !self_excited_node => Border::None,
            None if bounded || !(escapes || self_excited_node) => Border::None,
            _ => Border::Separatrix,
        }
    }
}

/// A border between regions of starts, as it was traced: a graph over the displacement above `v = 0`, and one below.
#[derive(Clone, Debug)]
pub enum Edge {
    /// Two half swings, known by their clearances.
    Orbit(Box<Orbit>),
    /// A closed curve that may run along the belt's line.
    Curve(MachineCurve),
}

impl Edge {
    /// The velocities at a displacement between which the starts lie inside; `None` where none does.
    #[must_use]
    pub fn span_at(&self, q: f64) -> Option<(f64, f64)> {
        match self {
            Edge::Orbit(orbit) => orbit.span_at(q),
            Edge::Curve(curve) => {
                let (up, down) = curve.velocities_at(q);
                // Next to a turning point only one of both may be met.
                Some((down.or(up.map(|_| 0.0))?, up.unwrap_or(0.0)))
            }
        }
    }

    /// The displacements at which it may have a corner.
    #[must_use]
    pub fn corners(&self) -> Vec<f64> {
        match self {
            Edge::Orbit(_) => Vec::new(),
            Edge::Curve(curve) => curve.ends(),
        }
    }

    /// Its points, `count` on each integration step, of an orbit in the order of time; a closed one ends with its first.
    #[must_use]
    pub fn curve(&self, count: u16) -> Vec<State> {
        match self {
            Edge::Orbit(orbit) => orbit.curve(count),
            Edge::Curve(curve) => curve.closed(count),
        }
    }

    /// The area within it; `None` where it is infinite.
    #[must_use]
    pub fn area(&self) -> Option<f64> {
        match self {
            Edge::Orbit(orbit) => {
                let [area, _, _] = (orbit.upper.powers() + orbit.lower.powers()).into();
                orbit.closed.then_some(area)
            }
            Edge::Curve(curve) => Some(curve.area()),
        }
    }

    /// Its least distance from the origin, refined between the points of its curve.
    #[must_use]
    pub fn inner_radius(&self) -> Option<f64> {
        /// Points on each of its integration steps.
        const POINTS: u16 = 24;
        /// The part of the way between the neighbours of the nearest point in which the distance is flat.
        const FLAT: f64 = 1e-9;
        let curve = match self {
            Edge::Orbit(orbit) => orbit.curve(POINTS),
            Edge::Curve(curve) => curve.points((POINTS, POINTS)),
        };
        let far = |state: &State| hypot(state.q, state.v);
        let nearest = (0..curve.len()).min_by(by_number(|index: &usize| far(&curve[*index])))?;
        let State { v, .. } = curve[nearest];
        let distance = |q: f64| {
            let span = self.span_at(q);
            span.map_or(f64::INFINITY, |(low, high)| hypot(q, if v < 0.0 { low } else { high }))
        };
        let ends = [nearest.saturating_sub(1), (nearest + 1).min(curve.len() - 1)];
        let (low, high) = range(ends.map(|index| curve[index].q));
        let (low, high) = maximum(low, high, FLAT * (high - low), |q| -distance(q));
        let upright = self.span_at(0.0).map_or(f64::INFINITY, |(low, high)| high.min(-low));
        Some(distance(f64::midpoint(low, high)).min(far(&curve[nearest])).min(upright))
    }
}
