//! A half swing enclosed by the plainest argument that does it.
//!
//! In the frame of a half plane a motion obeys `x' = v`, `v' = -x - g(v)`, `g(v) = a v + b v^2 + c v^3`, and runs
//! from `(-z, 0)` through `v > 0` to the next `v = 0`. All motions from a disc are carried in steps:
//!
//! 1. *Where they are.* If the box B contains the disc D and `D + [0, h] f(B)`, no motion from D leaves B within
//!    the time h (Picard).
//! 2. *The motion of the centre* is its Taylor polynomial of degree `N - 1` and a remainder, `h^N` times the
//!    coefficient N at some point of B. Coefficients are intervals, so that rounding is included.
//! 3. *The others stay near it.* The symmetric part of the Jacobian `[0 1; -1 -g'(v)]` is `diag(0, -g'(v))`: in
//!    B the distance of two motions grows at most as `exp(m h)` with `m = max(0, -g')`.
//! 4. *No return is missed.* Within a step v is positive on all of B, or changes one way only there.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison with what is not a number fails, and its negation is the safe side"
)]

use crate::numerics::Interval;
use crate::numerics::elementary::pow;

/// The coefficients a, b, c of a half plane.
#[derive(Clone, Copy, Debug)]
pub struct Field(pub [Interval; 3]);

/// A half swing, of all starts and coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    pub end: Interval,
    /// How long it takes.
    pub time: Interval,
    /// The area below it: the integral of `v^2` over time.
    pub area: Interval,
}

/// What is certain of a half swing.
#[derive(Clone, Copy, Debug)]
pub enum Passage {
    Ends(Swing),
    Never,
    Unknown,
}

const ORDER: usize = 22;

/// Size of a remainder relative to the state.
const SMALL: f64 = 2e-16;

/// Steps after which a half swing is given up.
const STEPS: usize = 2_000;

/// Taylor coefficients: of x, of v, of `v^2`.
type Series = [[Interval; 3]; ORDER + 1];

/// A box or a point: position and velocity.
type Place = [Interval; 2];

fn point(value: f64) -> Interval {
    Interval::point(value)
}

impl Field {
    /// The field of motions run against time, in the frame `y = -x`.
    pub fn reversed(&self) -> Field {
        Field(self.0.map(|it| -it))
    }

    fn acceleration(&self, [x, v]: Place) -> Interval {
        let [a, b, c] = self.0;
        -x - v * (a + v * (b + v * c))
    }

    /// The Taylor coefficients of all motions from a place.
    fn series(&self, [x, v]: Place) -> Series {
        let [a, b, c] = self.0;
        let mut found = [[point(0.0); 3]; ORDER + 1];
        (found[0][0], found[0][1]) = (x, v);
        let mut degree = 0.0;
        for k in 0..=ORDER {
            let product = |found: &Series, i: usize| {
                (0..=k).fold(point(0.0), |sum, j| sum + found[j][i] * found[k - j][1])
            };
            found[k][2] = if k == 0 { v.square() } else { product(&found, 1) };
            if k < ORDER {
                degree += 1.0;
                let cube = product(&found, 2);
                let force = found[k][0] + a * found[k][1] + b * found[k][2] + c * cube;
                found[k + 1][0] = found[k][1] / point(degree);
                found[k + 1][1] = -force / point(degree);
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
}

/// A disc of motions under way, and what they have gathered.
struct Disc {
    centre: [f64; 2],
    radius: f64,
    time: Interval,
    area: Interval,
}

/// The sum of a column of coefficients times powers of the time, up to degree `ORDER - 1`.
fn sum(series: &Series, column: usize, h: Interval) -> Interval {
    (0..ORDER).rev().fold(point(0.0), |sum, k| sum * h + series[k][column])
}

impl Disc {
    fn square(&self) -> Place {
        self.centre.map(|middle| Interval::around(middle, self.radius))
    }

    /// Carries the disc over a step; `None` if no box is found, or a return might be missed.
    fn step(&mut self, field: &Field, series: &Series, h: f64) -> Option<()> {
        let (start, time) = (self.square(), Interval::new(0.0, h));
        let mut place = start;
        let mut stays = false;
        for _ in 0..12 {
            let next = [start[0] + time * place[1], start[1] + time * field.acceleration(place)];
            stays = next[0].is_within(place[0]) && next[1].is_within(place[1]);
            if stays {
                place = next;
                break;
            }
            let wider = |one: Interval, other: Interval| {
                let both = one.hull(other);
                Interval::around(both.middle(), 1.05 * both.radius())
            };
            place = [wider(place[0], next[0]), wider(place[1], next[1])];
        }
        let falls = field.acceleration(place);
        let one_way = place[1].lower() > 0.0 || falls.lower() > 0.0 || falls.upper() < 0.0;
        if !(stays && one_way) {
            return None;
        }
        let rest = field.series(place)[ORDER];
        let (step, mut power) = (point(h), point(1.0));
        for _ in 0..ORDER {
            power = power * step;
        }
        let rest = [0, 1, 2].map(|column| rest[column] * power);
        let size = self.centre[0].abs().max(self.centre[1].abs());
        // A step is short enough when its remainder is a matter of rounding.
        if rest.iter().take(2).any(|it| !(it.magnitude() <= SMALL * size)) {
            return None;
        }
        let end = [0, 1].map(|column| sum(series, column, step) + rest[column]);
        let mut area = point(0.0);
        let mut degree = 22.0;
        for k in (0..ORDER).rev() {
            area = area * step + series[k][2] / point(degree);
            degree -= 1.0;
        }
        let area = area * step + rest[2] * step / point(23.0);
        let [a, b, c] = field.0;
        let slope = a + place[1] * (b.twice() + place[1] * c * point(3.0));
        let growth = (point((-slope.lower()).max(0.0)) * step).exp();
        let spread = growth * point(self.radius);
        let speed = point(place[1].magnitude());
        let aside = (step * spread * (speed.twice() + spread)).upper();
        self.time = self.time + step;
        self.area = self.area + area + Interval::new(-aside, aside);
        self.radius = (spread + point(end[0].radius()) + point(end[1].radius())).upper();
        self.centre = end.map(Interval::middle);
        self.radius.is_finite().then_some(())
    }

    /// The end, with `abs(v) <= m` for all motions: as long as this is so, and x is within a tenth of itself, v falls at
    /// least at the rate A, so that it vanishes within the time `m/A`, before or after, and x moves `m^2/A`.
    fn end(&self, field: &Field) -> Option<Swing> {
        let [x, v] = self.square();
        let m = point(v.magnitude());
        let speeds = Interval::new(-m.upper(), m.upper());
        let nearby = x * Interval::new(0.9, 1.1);
        let rate = point((-field.acceleration([nearby, speeds])).lower());
        let lag = m / rate;
        let way = (m * lag).upper();
        if !(rate.lower() > 0.0 && x.lower() > 0.0 && way < 0.05 * x.lower()) {
            return None;
        }
        let around = |it: Interval, off: f64| it + Interval::new(-off, off);
        Some(Swing {
            end: around(x, way),
            time: around(self.time, lag.upper()),
            area: around(self.area, (m * point(way)).upper()),
        })
    }
}

/// Where the polynomial of the velocity vanishes, about; no bound rests on it.
fn arrival(series: &Series, longest: f64) -> Option<f64> {
    let velocity = |h: f64| {
        let middles = series.iter().take(ORDER).rev().map(|row| row[1].middle());
        middles.fold(0.0, |sum: f64, next| sum * h + next)
    };
    let (mut low, mut high) = (0.0, longest);
    if velocity(high) > 0.0 {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if velocity(middle) > 0.0 { low = middle } else { high = middle }
    }
    Some(high)
}

/// The half swing from rest at `-z`, for all z of an interval.
pub fn swing(field: &Field, z: Interval) -> Passage {
    let start = -z;
    if start.upper() < 0.0 {
        run(field, [start.middle(), 0.0], z.radius())
    } else {
        Passage::Unknown
    }
}

/// The half swing of all motions within `radius` of a point, which are at rest if the point is.
pub fn run(field: &Field, centre: [f64; 2], radius: f64) -> Passage {
    let mut disc = Disc { centre, radius, time: point(0.0), area: point(0.0) };
    for _ in 0..STEPS {
        let series = field.series(disc.centre.map(point));
        let size = disc.centre[0].abs().max(disc.centre[1].abs());
        let last = series[ORDER][0].magnitude().max(series[ORDER][1].magnitude());
        let longest = pow(1e-6 * SMALL * size / last, 1.0 / 22.0).min(0.4);
        let arrives = if disc.time.lower() > 0.0 { arrival(&series, longest) } else { None };
        let mut h = arrives.unwrap_or(longest);
        let mut whole = true;
        while disc.step(field, &series, h).is_none() {
            (h, whole) = (0.8 * h, false);
            if !(h > 1e-9 * longest) {
                return Passage::Unknown;
            }
        }
        if whole && arrives.is_some() {
            return disc.end(field).map_or(Passage::Unknown, Passage::Ends);
        }
        let [x, v] = disc.square();
        if !(v.lower() > 0.0) {
            return Passage::Unknown;
        }
        if field.never_returns(x.upper(), v.lower()) {
            return Passage::Never;
        }
    }
    Passage::Unknown
}
