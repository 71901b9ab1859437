//! A ball of motions that is carried through a half plane, step by step.

use super::{FieldBox, INFLATE, MotionSeries, Norm, StepEnd, StepField, UNIT, scaled};
use crate::numerics::{Interval, exponent};

/// Steps after which a swing is abandoned: a smooth one takes ten, a stiff one any number.
pub const MOST_STEPS: u32 = 250;

/// The start of a half swing: any point of a box. On `v = 0` it starts left of the centre, `x < 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartBox {
    /// Position in the frame of the half plane.
    pub x: Interval,
    /// Velocity in that frame, not negative.
    pub v: Interval,
}

impl StartBox {
    /// A start at rest with this clearance from the sticking set.
    pub fn at_rest(clearance: Interval) -> Self {
        StartBox { x: -clearance, v: Interval::point(0.0) }
    }
}

/// All motions within a distance of a point, in units in which their start is near 1.
pub struct Ball {
    /// Their fields.
    pub local: StepField,
    /// The norm in which the distance is measured.
    pub norm: Norm,
    /// Position of the point.
    pub x: f64,
    /// Velocity of the point.
    pub v: f64,
    /// Norm of the distance to the motions.
    pub radius: f64,
    /// Time since the start, as the plain sum of the steps, and its largest error.
    pub time: f64,
    /// See `time`.
    pub time_error: f64,
    /// The Taylor polynomials at the point.
    pub series: MotionSeries,
    /// Exponent of the unit of length.
    pub unit: i32,
}

/// The length of a step, and where the polynomials lead in it.
pub type Ahead = (f64, (f64, f64));

impl Ball {
    /// The motions of all fields from all points of a box; `None` where there is nothing to carry.
    pub fn new(field: &FieldBox, start: &StartBox) -> Option<Self> {
        let size = start.x.magnitude().max(start.v.magnitude());
        if !(size > 0.0 && size.is_finite() && start.v.lower() >= 0.0) {
            return None;
        }
        let unit = exponent(size);
        let local = StepField::new(&field.in_units_of(unit));
        let [x, v] = [start.x, start.v].map(|it| scaled(it, -unit));
        Some(Ball {
            norm: Norm::fitting(local.field.a.middle()),
            local,
            x: x.middle(),
            v: v.middle(),
            // The norm of a vector is at most the sum of the magnitudes of its components.
            radius: (x.radius() + v.radius()) * INFLATE,
            time: 0.0,
            time_error: 0.0,
            series: MotionSeries::EMPTY,
            unit,
        })
    }

    /// Prepares a step of at most this length: the polynomials, and the norm in which errors grow least.
    pub fn prepare(&mut self, most: f64) -> Option<Ahead> {
        /// Size of the last term of a step, relative to the state: below rounding.
        const TOLERANCE: f64 = 2e-17;
        self.series.expand(self.local.middles, self.x, self.v);
        let h = self.series.step(TOLERANCE).min(most);
        if !(h > 0.0) {
            return None;
        }
        let end = self.series.at(h);
        let norm = self.local.norm(self.norm, [self.v, end.1], h);
        self.radius = self.radius * self.norm.into(norm) * INFLATE;
        self.norm = norm;
        Some((h, end))
    }

    /// The end of a step, shortened until it is certain, and its length.
    pub fn reach(&self, mut ahead: Ahead) -> Option<(f64, StepEnd)> {
        /// Attempts with successively shorter steps before giving up.
        const ATTEMPTS: usize = 12;
        for _ in 0..ATTEMPTS {
            if let Some(reached) = self.carried(ahead) {
                return Some((ahead.0, reached));
            }
            let h = 0.75 * ahead.0;
            ahead = (h, self.series.at(h));
        }
        None
    }

    /// The end of exactly this step.
    pub fn carried(&self, ahead: Ahead) -> Option<StepEnd> {
        self.local.carry(self.norm, &self.series, ahead, self.radius)
    }

    /// Moves to the end of a step of length h.
    pub fn advance(&mut self, h: f64, reached: &StepEnd) {
        (self.x, self.v, self.radius) = (reached.x, reached.v, reached.radius);
        self.time += h;
        self.time_error += UNIT * self.time;
    }

    /// The time since the start, which is known to within `lag` beside its rounding.
    pub fn elapsed(&self, lag: f64) -> Interval {
        Interval::around(self.time, (self.time_error + lag) * INFLATE)
    }

    /// The largest distance of a component of the motions from that of the point.
    pub fn off(&self) -> f64 {
        self.norm.stretch * self.radius * INFLATE
    }

    /// Position and velocity of the motions.
    pub fn state(&self) -> (Interval, Interval) {
        self.around(self.x, self.v, self.radius)
    }

    /// Positions and velocities within a distance of a point.
    pub fn around(&self, x: f64, v: f64, radius: f64) -> (Interval, Interval) {
        let off = self.norm.stretch * radius * INFLATE;
        (Interval::around(x, off), Interval::around(v, off))
    }
}

/// Whether no motion from positions up to `x` and velocities from `v` on ever returns to `v = 0` (lemma 7).
///
/// Motions cross the line `v = x + m` to the left where `P(v) = m - (a + 2) v - b v^2 - c v^3 >= 0`, and above
/// it the acceleration is at least `P(v) + v`. So if P is not negative from v on, motions above the line and
/// faster than v stay so.
pub fn never_returns(field: &FieldBox, x: f64, v: f64) -> bool {
    let at = Interval::point(v);
    let m = at - x;
    if !(field.c.upper() <= 0.0 && m > 0.0 && v >= 0.0) {
        return false;
    }
    let FieldBox { a, b, c } = field.strongest();
    let linear = a + 2.0;
    // Coefficients of P in powers of the velocity in excess of v.
    let p0 = m - at * (linear + at * (b + at * c));
    let p1 = -(linear + at * (b * 2.0 + at * c * 3.0));
    let p2 = -(b + at * c * 3.0);
    let p3 = -c;
    let holds = |it: Interval| it.lower() >= 0.0;
    if holds(p1) && holds(p2) {
        return holds(p0);
    }
    if p2 > 0.0 && holds(p0 * 4.0 * p2 - p1.square()) {
        return true;
    }
    if !(p3 > 0.0) {
        return false;
    }
    // Half of the cubic term compensates the square by u^3 >= 2 t u^2 - t^2 u, the other half the remaining
    // linear term by u^3 >= 3 t^2 u - 2 t^3; both hold for all u, t >= 0.
    let half = p3 / 2.0;
    let linear = if holds(p2) { p1 } else { p1 - p2.square() / (p3 * 2.0) };
    if holds(linear) {
        return holds(p0);
    }
    let t = Interval::point((-linear / (half * 3.0)).sqrt().upper());
    holds(p0 - half * 2.0 * t * t * t) && holds(linear + half * 3.0 * t * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The criterion for motions that never return, by the polynomial that decides it.
    ///
    /// `P = m - (a + 2) v - b v^2 - c v^3` is bounded from below by its coefficients. Where it is negative
    /// somewhere, nothing may be claimed.
    #[test]
    fn what_never_returns_is_told_from_what_may() {
        for (coefficients, [x, v], never) in [
            // `(v - 1)^2 + m - 1`.
            ([0.0, -1.0, 0.0], [-1.001, 0.0], true),
            ([0.0, -1.0, 0.0], [-0.98, 0.0], false),
            ([0.0, -1.0, 0.0], [-0.501, 0.5], true),
            ([0.0, -1.0, 0.0], [-0.48, 0.5], false),
            // `m - 2.1756.. + (v - 1.475)^2`, `m = 1 - x`.
            ([0.95, -1.0, 0.0], [-1.18, 1.0], true),
            ([0.95, -1.0, 0.0], [-1.17, 1.0], false),
            ([0.95, -1.0, 0.0], [-1.1, 1.0], false),
            // `m - 0.05 v + 0.001 v^2`, at least `m - 0.625`.
            ([-1.95, -0.001, 0.0], [-0.63, 0.0], true),
            ([-1.95, -0.001, 0.0], [-0.62, 0.0], false),
            // `m - 3 v + v^3`, at least `m - 2`.
            ([1.0, 0.0, -1.0], [-1.99, 0.0], false),
            // `m - 3 v^2 + v^3`, at least `m - 4`.
            ([-2.0, 3.0, -1.0], [-3.99, 0.0], false),
            // The centre is at rest, and cubic damping brings every motion back.
            ([-3.0, -1.0, 0.0], [0.0, 0.0], false),
            ([-3.0, -1.0, 1e-9], [-1.0, 0.0], false),
        ] {
            let [a, b, c] = coefficients.map(Interval::point);
            assert_eq!(
                never_returns(&FieldBox { a, b, c }, x, v),
                never,
                "{coefficients:?} {x} {v}"
            );
        }
    }
}
