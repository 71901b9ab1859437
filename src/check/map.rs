//! The return map G of the clearance z at the right turning point, `z = q - r > 0`, and its inverse.
//!
//! Motions of a half plane do not cross, so the end of a half swing increases with its start. Hence G
//! increases, and so does its inverse. `-inf` stands for a motion that has come to rest, `+inf` for one that
//! never turns.

use super::motion::{FencedField, SwingBounds};
use crate::numerics::Interval;

/// G or its inverse, for given parameters.
pub struct Map {
    /// The fields of the two half swings. G begins below `v = 0`, on the way from the right turning point to
    /// the left one.
    fields: [FencedField; 2],
    /// A half swing from the clearance z starts at the distance z plus this from its centre.
    before: Interval,
    /// It ends at the distance of the next clearance plus this from its centre.
    after: Interval,
}

impl Map {
    /// The map for `D`, `D2`, `D3`, `r`; `fences` has one entry for each half swing.
    pub fn new([d, d2, d3, r]: [Interval; 4], inverse: bool, fences: [f64; 2]) -> Self {
        let (gap, none) = (r.twice(), Interval::point(0.0));
        // A motion in reversed time, in the frame `y = -x`, obeys the same equation with all coefficients negated.
        let [a, c] = if inverse { [-d.twice(), -d3] } else { [d.twice(), d3] };
        let [before, after] = if inverse { [gap, none] } else { [none, gap] };
        let fields =
            [FencedField::new([a, -d2, c], fences[0]), FencedField::new([a, d2, c], fences[1])];
        Map { fields, before, after }
    }

    /// Bounds of the images of an interval of clearances, from those of its ends.
    pub fn images(&self, of: Interval) -> Interval {
        let mut at = of;
        for field in &self.fields {
            if at == f64::INFINITY || at.upper() == f64::NEG_INFINITY {
                return at;
            }
            let [low, high] = [at.lower(), at.upper()].map(|z| self.half(field, z));
            at = Interval::new(low.lower(), high.upper());
        }
        at
    }

    /// Bounds of the clearance after one half swing: only a lower bound for z = 0, only an upper one for infinite z.
    fn half(&self, field: &FencedField, z: f64) -> Interval {
        let start = self.before + z;
        let end = if z == f64::INFINITY {
            field.greatest()
        } else if z == 0.0 && self.before.upper() == 0.0 {
            field.least()
        } else {
            field.swing(start, self.after.lower()).end
        };
        let next = if end == f64::INFINITY { end } else { end - self.after };
        let rest = |bound: f64| if bound <= 0.0 { f64::NEG_INFINITY } else { bound };
        Interval::new(rest(next.lower()), rest(next.upper()))
    }

    /// The derivative over an interval of clearances; `None` where it is not certain.
    ///
    /// For a half swing it is `z/X exp(-I)` by Liouville's theorem, with its end X and the integral I of `f'`.
    pub fn slope(&self, over: Interval) -> Option<Interval> {
        let (mut at, mut slope) = (over, Interval::point(1.0));
        for field in &self.fields {
            let start = at + self.before;
            let SwingBounds { end, damping, .. } = field.swing(start, 0.0);
            if !end.is_finite() {
                return None;
            }
            slope = slope * (start / end) * (-damping).exp();
            at = end - self.after;
        }
        Some(slope)
    }
}
