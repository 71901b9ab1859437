//! The return map G of the clearance z at the right turning point, `z = q - r > 0`, and its inverse.
//!
//! Motions of a half plane do not cross. So where a half swing ends increases with its start, and so does the area
//! below it; G increases, as does its inverse. `-inf` stands for a motion that has come to rest, `+inf` for one that
//! never turns, every number for what is not known.

use super::motion::{Field, Swing, run, swing};
use crate::numerics::Interval;

/// G at some parameters.
pub struct Map {
    /// The fields below and above `v = 0`.
    fields: [Field; 2],
    /// `2 r`, the length of the sticking set.
    gap: Interval,
}

impl Map {
    /// The map for `D`, `D2`, `D3`, `r`.
    pub fn new([d, d2, d3, r]: [Interval; 4]) -> Self {
        let fields = [-d2, d2].map(|b| Field([d.twice(), b, d3]));
        Map { fields, gap: r.twice() }
    }

    /// The two halves of G, or of its inverse: first the one below `v = 0`, from the right turning point to the left one.
    fn halves(&self, inverse: bool) -> [Field; 2] {
        let [below, above] = self.fields;
        if inverse { [above.reversed(), below.reversed()] } else { [below, above] }
    }

    /// G at a clearance, or its inverse; at 0, next to which a node repels, lower bounds of G.
    pub fn after(&self, inverse: bool, z: f64) -> Interval {
        let mut at = Interval::point(z);
        for field in self.halves(inverse) {
            let found = match field.leaving() {
                Some(place) if at.upper() == 0.0 && !inverse => run(&field, (place, 0.0), 0.0).end,
                _ if inverse => end(&field, at + self.gap, 0.0),
                _ => end(&field, at, self.gap.lower()),
            };
            if !found.is_finite() {
                return if found.is_point() { found } else { Interval::ALL };
            }
            at = if inverse { found } else { found - self.gap };
            // All from next to 0 end above the lower bound.
            at = if z == 0.0 { Interval::point(at.lower()) } else { at };
            if at.upper() <= 0.0 && z > 0.0 {
                return Interval::point(f64::NEG_INFINITY);
            }
            if at.lower() <= 0.0 {
                return Interval::ALL;
            }
        }
        at
    }

    /// The derivative of G, or of its inverse, over an interval of clearances; `None` where it is not certain.
    ///
    /// That of a half swing is `z/X exp(-I)` by Liouville's theorem, X its end and I the integral of `f'`.
    pub fn slope(&self, inverse: bool, over: Interval) -> Option<Interval> {
        let (mut at, mut slope) = (over, Interval::point(1.0));
        for field in self.halves(inverse) {
            let start = if inverse { at + self.gap } else { at };
            let Swing { end, damping, .. } = whole(&field, start)?;
            slope = slope * (start / end) * (-damping).exp();
            at = if inverse { end } else { end - self.gap };
        }
        Some(slope)
    }

    /// Upper bound of all images of G; infinite where none is found.
    ///
    /// Of the motions of a half plane that have a fence, those that become faster than it end below the one from the right
    /// end of its piece, by the order of motions, and the others below that.
    pub fn greatest_image(&self) -> f64 {
        let finite = |end: Interval| {
            if end.is_finite() { (end - self.gap).upper() } else { f64::INFINITY }
        };
        let [first, second] = self.fields.map(|field| {
            let from = |(e, piece): (Interval, Interval)| ([piece.upper(), e.upper()], 0.0);
            field.fence().map_or(f64::INFINITY, |it| finite(run(&field, from(it), 0.0).end))
        });
        second.min(finite(swing(&self.fields[1], Interval::point(first), 0.0).end))
    }
}

/// The end of a half swing from an interval; from its ends if it is wide.
fn end(field: &Field, z: Interval, reach: f64) -> Interval {
    let end = |z: Interval| swing(field, z, reach).end;
    if z.radius() <= 1e-9 * z.lower() {
        return end(z);
    }
    let [low, high] = [z.lower(), z.upper()].map(|z| end(Interval::point(z)));
    Interval::new(low.lower(), high.upper())
}

/// A half swing from an interval: its end and its area from the motions from both ends of the interval, its time from
/// all of them at once.
fn whole(field: &Field, z: Interval) -> Option<Swing> {
    let ends = |z: Interval| Some(swing(field, z, 0.0)).filter(|it| it.end.is_finite());
    let all = ends(z)?;
    let (low, high) = (ends(Interval::point(z.lower()))?, ends(Interval::point(z.upper()))?);
    let end = Interval::new(low.end.lower(), high.end.upper());
    let area = Interval::new(low.area.lower(), high.area.upper());
    let damping = field.damping(all.time, end + z, area).intersection(all.damping)?;
    Some(Swing { end, area, damping, ..all })
}
