//! What the cubic Taylor polynomial of the friction law leaves out, measured.

use serde::Serialize;

use super::friction::Belt;
use super::friction::Derivatives;
use crate::numerics::root::maximum;

/// The largest difference between friction and its cubic Taylor polynomial over the velocities that a
/// motion reaches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TaylorError {
    /// Velocities of the mass over which it was measured, in m/s: those asked for, as far as the friction
    /// law reaches and the mass does not overtake the belt.
    pub range: (f64, f64),
    /// Whether that is all that was asked for.
    pub complete: bool,
    /// The smallest coefficient of friction there; one below 0 means no friction.
    pub least_mu: f64,
    /// The largest difference, in N.
    pub force: f64,
    /// The velocity of the mass at which it occurs, in m/s.
    pub at: f64,
    /// The same as a fraction of the friction of the belt at rest, `F mu(v0)`.
    pub of_friction: f64,
    /// The same as a fraction of the largest change of friction over the range; `None` where it does not
    /// change.
    pub of_change: Option<f64>,
}

impl Belt {
    /// Compares friction with its cubic Taylor polynomial over velocities `low .. high` of the mass, in m/s.
    ///
    /// The law is evaluated at 513 velocities, and the largest difference polished by golden section.
    /// `None` where the law has no derivatives at the belt speed, or where the range is empty.
    #[must_use]
    pub fn taylor_error(&self, (low, high): (f64, f64)) -> Option<TaylorError> {
        /// Intervals of the range.
        const INTERVALS: u32 = 512;
        /// Part of two intervals over which a maximum is flat.
        const FLAT: f64 = 1e-8;
        /// Rounding of a law and of its cubic, relative to them.
        const ROUNDING: f64 = 16.0 * f64::EPSILON;
        let v0 = self.belt_speed;
        let mu = self.law.at(v0).filter(Derivatives::is_finite)?;
        let (slowest, fastest) = self.law.range();
        let range = (low.max(v0 - fastest), high.min(v0 - slowest).min(v0));
        if range.0 > range.1 || !(range.0.is_finite() && range.1.is_finite()) {
            return None;
        }
        // Rounding may leave the end of the law by an ulp.
        let law = |v: f64| self.law.mu((v0 - v).clamp(slowest, fastest)).unwrap_or(f64::NAN);
        let difference = |v: f64| {
            let (exact, cubic) = (law(v), mu.cubic(-v));
            let difference = (exact - cubic).abs();
            // What rounding leaves of a law that is its own cubic is not an error of the expansion.
            if difference <= ROUNDING * (exact.abs() + cubic.abs()) { 0.0 } else { difference }
        };
        let change = |v: f64| (law(v) - mu.value).abs();
        let step = (range.1 - range.0) / f64::from(INTERVALS);
        let place = |index: u32| {
            if index == INTERVALS { range.1 } else { range.0 + f64::from(index) * step }
        };
        let places = (0..=INTERVALS).map(place);
        let worst = places
            .clone()
            .max_by(|one, other| difference(*one).total_cmp(&difference(*other)))
            .unwrap_or(range.0);
        let inside = |v: f64| v.clamp(range.0, range.1);
        let ends = (inside(worst - step), inside(worst + step));
        let ends = maximum(ends.0, ends.1, FLAT * (ends.1 - ends.0), difference);
        let polished = f64::midpoint(ends.0, ends.1);
        let at = if difference(polished) > difference(worst) { polished } else { worst };
        let force = self.normal_force * difference(at);
        let least_mu = places.clone().map(law).fold(mu.value, f64::min);
        let largest = places.map(change).fold(0.0, f64::max);
        Some(TaylorError {
            range,
            complete: range == (low, high),
            least_mu,
            force,
            at,
            of_friction: difference(at) / mu.value,
            of_change: (largest > 0.0).then(|| difference(at) / largest),
        })
    }
}
