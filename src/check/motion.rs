//! A half swing enclosed by the plainest argument that does it.
//!
//! In the frame of a half plane a motion obeys `x' = v`, `v' = -x - f(v)`, `f(v) = a v + b v^2 + c v^3`, and runs
//! from `(-z, 0)` through `v > 0` to the next `v = 0`. All motions from a disc are carried in steps:
//!
//! 1. *Where they are.* If the box B contains the disc D and `D + [0, h] F(B)`, F the field, no motion from D leaves B
//!    within the time h (Picard).
//! 2. *The motion of the centre* is its Taylor polynomial of degree `N - 1` and a remainder, `h^N` times the
//!    coefficient N at some point of B. Coefficients are intervals, so that rounding is included.
//! 3. *The others stay near it.* The symmetric part of the Jacobian `[0 1; -1 -f'(v)]` is `diag(0, -f'(v))`: in
//!    B the distance of two motions grows at most as `exp(m h)` with `m = max(0, -f')`.
//! 4. *No return is missed.* Within a step v is positive on all of B, or changes one way only there.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison with what is not a number fails, and its negation is the safe side"
)]

use crate::numerics::Interval;
use crate::numerics::elementary::{cbrt, pow};
use crate::numerics::root::bisect;

/// The coefficients a, b, c of a half plane.
#[derive(Clone, Copy, Debug)]
pub struct Field(pub [Interval; 3]);

/// A half swing, of all starts and coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    /// Where it ends: `-inf` if no further out than the sticking set reaches, `+inf` if it never does.
    pub end: Interval,
    /// How long it takes.
    pub time: Interval,
    /// The area below it, the integral of `v^2` over time.
    pub area: Interval,
    /// The integral of `f'` over time.
    pub damping: Interval,
}

impl Swing {
    /// Of which only the end is known.
    fn only(end: Interval) -> Self {
        Swing { end, time: Interval::ALL, area: Interval::ALL, damping: Interval::ALL }
    }
}

const ORDER: usize = 22;

/// Size of a remainder relative to the state.
const SMALL: f64 = 2e-16;

/// Steps after which a half swing is given up.
const STEPS: usize = 2_500;

/// Taylor coefficients: of x, of v, of the area, and of `v^2`.
type Series = [[Interval; 4]; ORDER + 1];

/// A box or a point: position and velocity.
type Place = [Interval; 2];

fn point(value: f64) -> Interval {
    Interval::point(value)
}

impl Field {
    /// The field of the motions run backward, in the frame `y = -x`.
    pub fn reversed(&self) -> Self {
        Field(self.0.map(|it| -it))
    }

    fn force(&self, v: Interval) -> Interval {
        let [a, b, c] = self.0;
        v * (a + v * (b + v * c))
    }

    fn slope(&self, v: Interval) -> Interval {
        let [a, b, c] = self.0;
        a + v * (b.twice() + v * c * point(3.0))
    }

    fn acceleration(&self, [x, v]: Place) -> Interval {
        -x - self.force(v)
    }

    /// The integral of `f'` over a time in which x moves so far, above this area.
    pub fn damping(&self, time: Interval, way: Interval, area: Interval) -> Interval {
        let [a, b, c] = self.0;
        a * time + b.twice() * way + c * area * point(3.0)
    }

    /// The Taylor coefficients of all motions from a place.
    fn series(&self, [x, v]: Place) -> Series {
        let [a, b, c] = self.0;
        let mut found = [[point(0.0); 4]; ORDER + 1];
        (found[0][0], found[0][1]) = (x, v);
        let mut degree = 0.0;
        for k in 0..=ORDER {
            let product = |found: &Series, i: usize| {
                (0..=k).fold(point(0.0), |sum, j| sum + found[j][i] * found[k - j][1])
            };
            found[k][3] = if k == 0 { v.square() } else { product(&found, 1) };
            if k < ORDER {
                degree += 1.0;
                let force = a * found[k][1] + b * found[k][3] + c * product(&found, 3);
                let rates = [found[k][1], -(found[k][0] + force), found[k][3]];
                for (column, rate) in rates.into_iter().enumerate() {
                    found[k + 1][column] = rate / point(degree);
                }
            }
        }
        found
    }

    /// Whether what is at most at `x` and has at least the velocity `v` never comes back to `v = 0`.
    ///
    /// On the line `v = x + m` through this corner, `m > 0`, motions cross upwards where
    /// `P(v) = m - (a + 2) v - b v^2 - c v^3 >= 0`, and above it `v' >= P(v) + v`. So it is enough that P is not
    /// negative from v on, which its coefficients there show.
    fn never_returns(&self, x: f64, v: f64) -> bool {
        let [a, b, c] = self.0;
        let (at, two, three) = (point(v), point(2.0), point(3.0));
        let m = at - point(x);
        let p0 = m - at * (a + two + at * (b + at * c));
        let p1 = -(a + two + at * (two * b + at * three * c));
        let p2 = -(b + at * three * c);
        let square = p2.lower() > 0.0 && (point(4.0) * p0 * p2 - p1.square()).lower() >= 0.0;
        let linear = p1.lower() >= 0.0 && p2.lower() >= 0.0 && p0.lower() >= 0.0;
        m.lower() > 0.0 && v >= 0.0 && c.upper() <= 0.0 && (linear || square)
    }

    /// Whether the energy of what is at this place does not grow, and is too small to come further out than `reach`.
    fn stays(&self, x: Interval, v: Interval, reach: f64) -> bool {
        let [a, b, c] = self.0;
        let most = (x.square() + v.square()).sqrt().upper();
        let speeds = Interval::new(0.0, most);
        most <= reach && (a + speeds * (b + speeds * c)).lower() >= 0.0
    }

    /// A velocity e through which all motions that begin slower and become faster fall within a short piece of the line `v = e`, and that
    /// piece; for `c >= 0`. It spares the fast part of stiff motions.
    ///
    /// Let `f'` be positive at e and not fall from there on. A motion can fall through `v = e` only where `-x - f <= 0`:
    /// from `x = -f(e)` on. On the curve `Q = x + f - 2 v/f' = 0` it is `v' = -2 v/f'`, and
    /// `Q' = v (-1 + 4 (f' - v f'')/f'^3) <= 0` if `4 (a - 3 c v^2) <= f'^3`, because `f' - v f'' = a - 3 c v^2`; that
    /// holds from e on if it does there. So no motion from the left crosses this curve, which ends at
    /// `x = -f(e) + 2 e/f'(e)`.
    pub fn fence(&self) -> Option<(Interval, Interval)> {
        let [a, b, c] = self.0;
        let (three, middles) = (point(3.0), self.0.map(Interval::middle));
        let [linear, square, cube] = middles;
        // Where the slope is as large as makes the motions meet; the conditions below decide.
        let steep = 8.0_f64.max(4.0 * linear);
        let steep =
            if square < 0.0 { steep.max(6.0 * cbrt(square * square / cube)) } else { steep };
        let root = (square * square + 3.0 * cube * (steep - linear)).sqrt();
        let e = if square < 0.0 {
            (root - square) / (3.0 * cube)
        } else {
            (steep - linear) / (square + root)
        };
        let e = point(e);
        let slope = self.slope(e);
        let grows = c.lower() >= 0.0 && (b + three * c * e).lower() >= 0.0;
        let excess = point(4.0) * (a - three * c * e.square());
        let holds = grows
            && e.lower() > 0.0
            && slope.lower() > 0.0
            && excess.upper() <= (slope * slope.square()).lower();
        let left = -self.force(e);
        let right = left + e.twice() / slope;
        let piece = Interval::new(left.lower(), right.upper());
        (holds && piece.is_finite()).then_some((e, piece))
    }

    /// The end of motions that are faster than e, by those from both ends of the piece at which they come back to e;
    /// they became so at `x`, after this time and with this integral of `f'`.
    ///
    /// On the way there `f'` is at least `rate v`. After it, the way in time of all is that of the two ends but for this: with
    /// `w^2 = 3 X_R (X_R - X_L)`, and a drag of at most `d < X_R/2` below the velocity w, nothing is faster than w at
    /// `X_L`, because it would need a longer way than `w^2/(3 X_R)` to come to rest; so it is there within `w/(X_L - d)`.
    fn fall(
        &self,
        (e, piece): (Interval, Interval),
        x: Interval,
        time: Interval,
        damping: Interval,
    ) -> Option<Swing> {
        let from = |x: f64| {
            let swing = follow(self, ([x, e.middle()], 0.0), 0.0, None)?;
            swing.end.is_finite().then_some(swing)
        };
        let [a, b, c] = self.0;
        let way = piece - x;
        let rate = point(a.lower().min(0.0)) / e + b.twice() + c * e * point(3.0);
        let gained = point(rate.lower().max(0.0)) * point(way.lower().max(0.0));
        let before = damping + gained;
        let (Some(low), Some(high)) = (from(piece.lower()), from(piece.upper())) else {
            return self.beyond_fold(e, piece, before.lower());
        };
        let end = Interval::new(low.end.lower(), high.end.upper());
        let w = (point(3.0 * end.upper()) * point(end.width())).sqrt().upper();
        let drag = point(self.force(Interval::new(0.0, w)).magnitude());
        let rate = point(end.lower()) - drag;
        if !(rate.lower() > 0.0 && drag.upper() <= 0.49 * end.upper()) {
            return None;
        }
        let around = |it: Interval, off: Interval| it + Interval::new(-off.upper(), off.upper());
        let late = point(w) / point(rate.lower());
        let after = around(low.time.hull(high.time), late);
        let area = around(low.area.hull(high.area), e * point(piece.width()));
        let damping = before + self.damping(after, end - piece, area);
        let fast = Interval::new(0.0, (point(way.upper().max(0.0)) / e).upper());
        Some(Swing {
            end,
            time: time + fast + after,
            area: Interval::ALL,
            damping: Interval::new(damping.lower(), f64::INFINITY),
        })
    }

    /// The half swing from all z of an interval so far out that nothing slows them down before they are faster than e: as
    /// long as `x <= -z/2`, v grows at least at the rate `z/2 - d`, d bounding the damping below e.
    fn far(&self, z: Interval, (e, piece): (Interval, Interval)) -> Option<Swing> {
        let slow = Interval::new(0.0, e.upper());
        let half = point(z.lower()) / point(2.0);
        let rate = point((half - point(self.force(slow).magnitude())).lower());
        let time = e / rate;
        let way = e * time;
        let least = point(self.slope(slow).lower().min(0.0)) * point(time.upper());
        let x = Interval::new(-z.upper(), (way - point(z.lower())).upper());
        let reaches = rate.lower() > 0.0 && way.upper() <= half.lower();
        let damping = Interval::new(least.lower(), f64::INFINITY);
        reaches.then(|| self.fall((e, piece), x, Interval::new(0.0, time.upper()), damping))?
    }

    /// The end of motions that fall through `v = e > 0` at positive x in a piece, for `b < 0 < c`, where that is at a fold of
    /// `x = -f(v)`; `before` bounds the integral of `f'` until then from below.
    ///
    /// They fall until they end: where `v' = 0` it is `v'' = -v < 0`. Below e, `-f <= k = 4 |b|^3/(27 c^2) + max(-a, 0) e`; so from
    /// the larger of k and the piece, and e, on it is `v' <= -e`, and after a further e at most they end. `f'` is at least
    /// `a - b^2/(3 c)`. With `w = |b|/(3 c)`, motions need at most `(X - x)/w` while they are faster than w, and
    /// while they are slower w by the least of `x + f`.
    fn beyond_fold(&self, e: Interval, piece: Interval, before: f64) -> Option<Swing> {
        let [a, b, c] = self.0;
        if !(b.upper() < 0.0 && c.lower() > 0.0 && piece.lower() > 0.0) {
            return None;
        }
        let pull = point((-a.lower()).max(0.0)) * e;
        let k = point(-4.0) * b * b.square() / (point(27.0) * c.square()) + pull;
        let last = point(k.upper().max(piece.upper())) + e.twice();
        let end = Interval::new(piece.lower(), last.upper());
        let w = point((-b / (point(3.0) * c)).upper());
        let rate =
            point((point(piece.lower()) + self.force(Interval::new(0.0, w.upper()))).lower());
        let time = point((end - piece).upper()) / w + w / rate;
        let least = (a - b.square() / (point(3.0) * c)).lower().min(0.0);
        let damping = (point(before) + point(least) * point(time.upper())).lower();
        let damping = Interval::new(damping, f64::INFINITY);
        (rate.lower() > 0.0).then(|| Swing { damping, ..Swing::only(end) })
    }

    /// A place below which no motion passes that starts at rest next to the centre, for `a <= -2`, where this is a node.
    ///
    /// On the parabola `v = x - k x^2`, `k = 2 |b| + 1`, as long as `x (2 k^2 + |c|) <= k - |b|`, motions cross upwards:
    /// `(v - x + k x^2)' >= -x + 2 v - b v^2 - c v^3 - v + 2 k x v >= x^2 (k - |b|) - x^3 (2 k^2 + |c|)`, with `v <= x`.
    pub fn leaving(&self) -> Option<[f64; 2]> {
        let [b, c] = [self.0[1], self.0[2]].map(|it| point(it.magnitude()));
        let k = b.twice() + point(1.0);
        let x = 1e-3 * ((k - b) / (k.square().twice() + c)).lower();
        let v = (point(x) - k * point(x).square()).lower();
        (self.0[0].upper() <= -2.0 && x > 0.0 && v > 0.0).then_some([x, v])
    }
}

/// A disc of motions under way.
struct Disc {
    centre: [f64; 2],
    radius: f64,
    /// Time and area since the start, and where that was.
    time: Interval,
    area: Interval,
    from: Interval,
}

impl Disc {
    fn new(centre: [f64; 2], radius: f64) -> Self {
        let from = Interval::around(centre[0], radius);
        Disc { centre, radius, time: point(0.0), area: point(0.0), from }
    }

    fn square(&self) -> Place {
        self.centre.map(|middle| Interval::around(middle, self.radius))
    }

    /// Carries the disc over a step; `None` if no box is found, or a return might be missed.
    fn step(&mut self, field: &Field, series: &Series, h: f64) -> Option<()> {
        let (start, time) = (self.square(), Interval::new(0.0, h));
        let next =
            |[x, v]: Place| [start[0] + time * v, start[1] + time * field.acceleration([x, v])];
        let mut place = start;
        let mut tries = 0..12;
        while let reached = next(place)
            && !(reached[0].is_within(place[0]) && reached[1].is_within(place[1]))
        {
            tries.next()?;
            place = [0, 1].map(|column| {
                let both = place[column].hull(reached[column]);
                Interval::around(both.middle(), 1.05 * both.radius())
            });
        }
        let place = next(place);
        let falls = field.acceleration(place);
        if !(place[1].lower() > 0.0 || falls.lower() > 0.0 || falls.upper() < 0.0) {
            return None;
        }
        let step = point(h);
        let last = field.series(place)[ORDER];
        let power = (0..ORDER).fold(point(1.0), |power, _| power * step);
        // A step is short enough when its remainder is a matter of rounding.
        let size = self.centre[0].abs().max(self.centre[1].abs());
        if last.iter().take(2).any(|it| !((*it * power).magnitude() <= SMALL * size)) {
            return None;
        }
        let [x, v, area] = [0, 1, 2].map(|column| {
            let sum = (0..ORDER).rev().fold(point(0.0), |sum, k| sum * step + series[k][column]);
            sum + last[column] * power
        });
        let growth = (point((-field.slope(place[1]).lower()).max(0.0)) * step).exp();
        let spread = growth * point(self.radius);
        let speed = point(place[1].magnitude());
        let aside = (step * spread * (speed.twice() + spread)).upper();
        self.time = self.time + step;
        self.area = self.area + area + Interval::new(-aside, aside);
        self.radius = (spread + point(x.radius()) + point(v.radius())).upper();
        self.centre = [x, v].map(Interval::middle);
        self.radius.is_finite().then_some(())
    }

    /// The end, with `abs(v) <= m` for all motions: as long as this is so, and x is within a tenth of itself, v falls at
    /// least at the rate A, so that it vanishes within the time `m/A`, before or after, and x moves `m^2/A`.
    fn end(&self, field: &Field) -> Option<Swing> {
        let [x, v] = self.square();
        let m = point(v.magnitude());
        let rate = -field.acceleration([x * Interval::new(0.9, 1.1), m.hull(-m)]);
        let lag = m / point(rate.lower());
        let way = (m * lag).upper();
        if !(rate.lower() > 0.0 && x.lower() > 0.0 && way < 0.05 * x.lower()) {
            return None;
        }
        let around = |it: Interval, off: f64| it + Interval::new(-off, off);
        let (end, time) = (around(x, way), around(self.time, lag.upper()));
        let area = around(self.area, (m * point(way)).upper());
        let damping = field.damping(time, end - self.from, area);
        Some(Swing { end, time, area, damping })
    }
}

/// Where the polynomial of the velocity vanishes, about; no bound rests on it.
fn arrival(series: &Series, longest: f64) -> Option<f64> {
    let velocity = |h: f64| {
        let middles = series.iter().take(ORDER).rev().map(|row| row[1].middle());
        middles.fold(0.0, |sum: f64, next| sum * h + next)
    };
    (velocity(longest) <= 0.0).then(|| bisect(0.0, longest, 60, |h| velocity(h) <= 0.0).1)
}

/// The half swing from rest at `-z`, for all z of an interval; `reach` is how far the sticking set reaches.
pub fn swing(field: &Field, z: Interval, reach: f64) -> Swing {
    if !(z.lower() > 0.0) {
        return Swing::only(Interval::ALL);
    }
    let found = run(field, ([-z.middle(), 0.0], z.radius()), reach);
    let far = || field.fence().and_then(|fence| field.far(z, fence));
    if found.end == Interval::ALL { far().unwrap_or(found) } else { found }
}

/// The half swing of all motions within a radius of a point, which are at rest if the point is; stiff ones by the fence.
pub fn run(field: &Field, from: ([f64; 2], f64), reach: f64) -> Swing {
    let stiff = || follow(field, from, reach, field.fence().filter(|it| from.0[1] <= it.0.lower()));
    follow(field, from, reach, None).or_else(stiff).unwrap_or(Swing::only(Interval::ALL))
}

/// `None` where it is not certain.
fn follow(
    field: &Field,
    (centre, radius): ([f64; 2], f64),
    reach: f64,
    fence: Option<(Interval, Interval)>,
) -> Option<Swing> {
    let mut disc = Disc::new(centre, radius);
    for _ in 0..STEPS {
        let series = field.series(disc.centre.map(point));
        let size = disc.centre[0].abs().max(disc.centre[1].abs());
        let last = series[ORDER][0].magnitude().max(series[ORDER][1].magnitude());
        let longest = pow(1e-6 * SMALL * size / last, 1.0 / 22.0).min(0.4);
        let arrives = if disc.centre[1] > 0.0 { arrival(&series, longest) } else { None };
        let mut h = arrives.unwrap_or(longest);
        while disc.step(field, &series, h).is_none() {
            h *= 0.8;
            if !(h > 1e-9 * longest) {
                return None;
            }
        }
        if arrives == Some(h) {
            return disc.end(field);
        }
        let [x, v] = disc.square();
        if !(v.lower() > 0.0) {
            return None;
        }
        if field.never_returns(x.upper(), v.lower()) {
            return Some(Swing::only(point(f64::INFINITY)));
        }
        if field.stays(x, v, reach) {
            return Some(Swing::only(point(f64::NEG_INFINITY)));
        }
        if let Some(fence) = fence.filter(|(e, _)| v.lower() > e.upper()) {
            let damping = field.damping(disc.time, x - disc.from, disc.area);
            return field.fall(fence, x, disc.time, damping);
        }
    }
    None
}
