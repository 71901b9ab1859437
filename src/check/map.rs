//! The return map G of the clearance z at the right turning point, `z = q - r > 0`, and its inverse.
//!
//! Motions of a half plane do not cross. So where a half swing ends increases with its start, and so does the area
//! below it; G increases, as does its inverse. A motion that has come to rest counts as `-inf`, one that never turns
//! as `+inf`.

use super::motion::{Field, Passage, Swing, run, swing};
use crate::numerics::Interval;

/// G at some parameters.
pub struct Map {
    /// The fields below and above `v = 0`.
    fields: [Field; 2],
    /// `2 r`, the length of the sticking set.
    gap: Interval,
}

/// What is known of a motion one turn later.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum After {
    Rest,
    /// It has this clearance.
    At(Interval),
    Never,
    Unknown,
}

/// A turn of all motions from an interval of clearances.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Derivative of the map that was run.
    pub slope: Interval,
    /// How long it takes.
    pub time: Interval,
    /// The clearance at the left turning point.
    pub left: Interval,
}

impl Map {
    /// The map for `D`, `D2`, `D3`, `r`.
    pub fn new([d, d2, d3, r]: [Interval; 4]) -> Self {
        let fields = [-d2, d2].map(|b| Field([d.twice(), b, d3]));
        Map { fields, gap: r.twice() }
    }

    /// The two halves of G, or of its inverse: 0 is below `v = 0`, from the right turning point to the left one.
    fn halves(&self, inverse: bool) -> [Field; 2] {
        let [below, above] = self.fields;
        if inverse { [above.reversed(), below.reversed()] } else { [below, above] }
    }

    /// G at a clearance, or its inverse; of G also next to 0, where a node may leave a lower bound.
    pub fn after(&self, inverse: bool, z: f64) -> After {
        let mut at = Interval::point(z);
        for field in self.halves(inverse) {
            let passage = match field.leaving() {
                Some(place) if at.upper() == 0.0 && !inverse => run(&field, (place, 0.0), 0.0),
                _ if inverse => swing(&field, at + self.gap, 0.0),
                _ => swing(&field, at, self.gap.lower()),
            };
            at = match passage {
                Passage::Ends(swing) if inverse => swing.end,
                // All from next to 0 end above this.
                Passage::Ends(swing) if z == 0.0 => Interval::point((swing.end - self.gap).lower()),
                Passage::Ends(swing) => swing.end - self.gap,
                Passage::Rests => return After::Rest,
                Passage::Never => return After::Never,
                Passage::Unknown => return After::Unknown,
            };
            if at.upper() <= 0.0 && z > 0.0 {
                return After::Rest;
            }
            if at.lower() <= 0.0 {
                return After::Unknown;
            }
        }
        After::At(at)
    }

    /// A turn, by G or its inverse, from all clearances of an interval; `None` where it is not certain.
    ///
    /// The derivative of a half swing is `z/X exp(-I)` by Liouville's theorem, I the integral of `f'`.
    pub fn turn(&self, inverse: bool, over: Interval) -> Option<Turn> {
        let mut at = over;
        let mut turn = Turn { slope: Interval::point(1.0), time: Interval::point(0.0), left: over };
        for (place, field) in self.halves(inverse).into_iter().enumerate() {
            let start = if inverse { at + self.gap } else { at };
            let Swing { end, time, damping, .. } = whole(&field, start)?;
            turn.slope = turn.slope * (start / end) * (-damping).exp();
            turn.time = turn.time + time;
            at = if inverse { end } else { end - self.gap };
            if place == 0 {
                turn.left = at;
            }
        }
        Some(turn)
    }

    /// Upper bound of all images of G; infinite where none is found.
    ///
    /// Of the motions of a half plane that have a fence, those that become faster than it end below the one from the right
    /// end of its piece, by the order of motions, and the others below that.
    pub fn greatest_image(&self) -> f64 {
        let [first, second] = self.fields.map(|field| {
            let from = |(e, piece): (Interval, Interval)| [piece.upper(), e.upper()];
            match field.fence().map(|fence| run(&field, (from(fence), 0.0), 0.0)) {
                Some(Passage::Ends(swing)) => (swing.end - self.gap).upper(),
                _ => f64::INFINITY,
            }
        });
        match swing(&self.fields[1], Interval::point(first), 0.0) {
            Passage::Ends(swing) => second.min((swing.end - self.gap).upper()),
            _ => second,
        }
    }
}

/// A half swing from an interval: its end and its area from the motions from both ends of the interval, its time from
/// all of them at once.
fn whole(field: &Field, z: Interval) -> Option<Swing> {
    let run = |z: Interval| match swing(field, z, 0.0) {
        Passage::Ends(swing) => Some(swing),
        Passage::Rests | Passage::Never | Passage::Unknown => None,
    };
    let all = run(z)?;
    if z.is_point() {
        return Some(all);
    }
    let [low, high] = [z.lower(), z.upper()].map(|end| run(Interval::point(end)));
    let (low, high) = (low?, high?);
    let end = Interval::new(low.end.lower(), high.end.upper());
    let area = Interval::new(low.area.lower(), high.area.upper());
    let damping = field.damping(all.time, end + z, area).intersection(all.damping)?;
    Some(Swing { end, area, damping, ..all })
}
