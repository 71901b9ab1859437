//! The return map G of the clearance z at the right turning point, `z = q - r > 0`, and its inverse.
//!
//! Motions of a half plane do not cross. So where a half swing ends increases with its start, and so does the area
//! below it; G increases, as does its inverse. A motion that has come to rest counts as `-inf`, one that never turns
//! as `+inf`.

use super::motion::{Field, Passage, Swing, run, swing};
use crate::numerics::Interval;
use crate::numerics::elementary::cbrt;

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

    /// G at a clearance, or its inverse.
    pub fn after(&self, inverse: bool, z: f64) -> After {
        let mut at = Interval::point(z);
        for half in order(inverse) {
            let passage = if inverse {
                swing(&self.fields[half].reversed(), at + self.gap)
            } else {
                swing(&self.fields[half], at)
            };
            at = match passage {
                Passage::Ends(swing) if inverse => swing.end,
                Passage::Ends(swing) => swing.end - self.gap,
                Passage::Never => return After::Never,
                Passage::Unknown => return After::Unknown,
            };
            if at.upper() <= 0.0 {
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
    /// The derivative of a half swing is `z/X exp(-(a T + 2 b (X + z) + 3 c W))` by Liouville's theorem: T is its time
    /// and W the area below it.
    pub fn turn(&self, inverse: bool, over: Interval) -> Option<Turn> {
        let mut at = over;
        let mut turn = Turn { slope: Interval::point(1.0), time: Interval::point(0.0), left: over };
        for (place, half) in order(inverse).into_iter().enumerate() {
            let (field, start) = if inverse {
                (self.fields[half].reversed(), at + self.gap)
            } else {
                (self.fields[half], at)
            };
            let Swing { end, time, area } = whole(&field, start)?;
            let [a, b, c] = field.0;
            let divergence = a * time + b.twice() * (end + start) + c * area * Interval::point(3.0);
            turn.slope = turn.slope * (start / end) * (-divergence).exp();
            turn.time = turn.time + time;
            at = if inverse { end } else { end - self.gap };
            if place == 0 {
                turn.left = at;
            }
        }
        Some(turn)
    }

    /// Upper bound of where all half swings of one half plane end, however far out they start, for `c > 0`; infinite
    /// where none is found.
    ///
    /// The curve `U(x) = S + 2/(c (x + 2 R))` over `-2 R < x <= -R` begins at infinity. With `U = S + y`,
    /// `U' = -c y^2/2`, motions cross it downwards if `c U^3 + b U^2 + a U - 2 R - (c/2) U y^2 >= 0`, which its
    /// coefficients by y show: `c S^3 + b S^2 + a S >= 2 R`, `3 c S^2 + 2 b S + a >= 0`, `(5/2) c S + b >= 0`. So all pass
    /// below `(-R, S + 2/(c R))`, and end below the motion from there.
    fn greatest(&self, half: usize) -> f64 {
        let Field([a, b, c]) = self.fields[half];
        let least = c.lower();
        if least <= 0.0 {
            return f64::INFINITY;
        }
        let mut best = f64::INFINITY;
        for reach in [1.0, 2.0, 4.0, 8.0] {
            let r = reach / least.sqrt();
            let mut s = cbrt(2.0 * r / least);
            for _ in 0..200 {
                let at = Interval::point(s);
                let value = at * (a + at * (b + at * c)) - Interval::point(r).twice();
                let slope = a + at * (b.twice() + at * c * Interval::point(3.0));
                let bend = at * c * Interval::point(2.5) + b;
                if [value, slope, bend].iter().all(|it| it.lower() >= 0.0) {
                    let v = at + Interval::point(2.0) / (c * Interval::point(r));
                    if let Passage::Ends(swing) = run(&self.fields[half], [-r, v.upper()], 0.0) {
                        best = best.min(swing.end.upper());
                    }
                    break;
                }
                s *= 1.05;
            }
        }
        best
    }

    /// Upper bound of all images of G; infinite where none is found.
    pub fn greatest_image(&self) -> f64 {
        (Interval::point(self.greatest(1)) - self.gap).upper()
    }
}

/// The order in which the half swings are run: 0 is below `v = 0`, from the right turning point to the left one.
fn order(inverse: bool) -> [usize; 2] {
    if inverse { [1, 0] } else { [0, 1] }
}

/// A half swing from an interval: its end and its area from the motions from both ends of the interval, its time from
/// all of them at once.
fn whole(field: &Field, z: Interval) -> Option<Swing> {
    let run = |z: Interval| match swing(field, z) {
        Passage::Ends(swing) => Some(swing),
        Passage::Never | Passage::Unknown => None,
    };
    let all = run(z)?;
    if z.is_point() {
        return Some(all);
    }
    let [low, high] = [z.lower(), z.upper()].map(|end| run(Interval::point(end)));
    let (low, high) = (low?, high?);
    let end = Interval::new(low.end.lower(), high.end.upper());
    let area = Interval::new(low.area.lower(), high.area.upper());
    Some(Swing { end, area, ..all })
}
