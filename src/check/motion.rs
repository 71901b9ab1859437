//! Encloses a half swing by the simplest argument that suffices.
//!
//! In the frame of a half plane a motion obeys `x' = v`, `v' = -x - f(v)`, `f(v) = a v + b v^2 + c v^3`, and runs
//! from `(-z, 0)` through `v > 0` to the next `v = 0`. All motions from a disc are carried in steps:
//!
//! 1. *Location.* If the box B contains the disc D and `D + [0, h] F(B)`, F the field, no motion from D leaves B
//!    within the time h (Picard).
//! 2. *The centre* moves along its Taylor polynomial of degree `N - 1` with a remainder, `h^N` times coefficient
//!    N at some point of B. Coefficients are intervals, so rounding is included.
//! 3. *The others stay near it.* The symmetric part of the Jacobian `[0 1; -1 -f'(v)]` is `diag(0, -f'(v))`, so
//!    in B the distance of two motions grows at most as `exp(m h)` with `m = max(0, -f')`.
//! 4. *No return is missed.* Within a step v is positive on all of B, or monotone there.
//!
//! The lemmas are those of `docs/proofs.md`.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison with what is not a number fails, and its negation is the safe side"
)]

use crate::numerics::Interval;
use crate::numerics::elementary::{pow, powi};
use crate::numerics::root::bisect;

/// The field of a half plane.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// a, b and c.
    coefficients: [Interval; 3],
    fence: Option<Fence>,
}

/// A half swing, for all its starts and coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    /// End position: `-inf` if no further out than the edge of the sticking set, `+inf` if the swing never ends.
    pub end: Interval,
    pub time: Interval,
    /// The integral of `f'` over time.
    pub damping: Interval,
}

/// Degree of the remainder.
const ORDER: usize = 22;

/// Size of a remainder, relative to the state, above which steps are shortened.
const SMALL: f64 = 2e-16;

/// Steps after which a half swing is abandoned.
const STEPS: usize = 1_000;

/// Taylor coefficients: of x, of v, of the integral of `f'`, and of `v^2`.
type Series = [[Interval; 4]; ORDER + 1];

/// A box or a point: position and velocity.
type StateBox = [Interval; 2];

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// A half swing about which nothing is known.
const UNKNOWN: Swing = Swing { end: Interval::ALL, time: Interval::ALL, damping: Interval::ALL };

/// A velocity e, and a short piece of the line `v = e` through which all motions fall that become faster than e.
type Fence = [Interval; 2];

impl Field {
    /// A field, with a fence at this velocity e if there is one (lemma 11): where `f'` is positive and does not
    /// decrease from e on, and `4 (a - 3 c v^2) <= f'^3`, motions fall through `v = e` between `x = -f(e)` and
    /// `x = -f(e) + 2 e/f'(e)`.
    pub fn new(coefficients: [Interval; 3], velocity: f64) -> Self {
        let (field, e) = (Field { coefficients, fence: None }, point(velocity));
        let [a, b, c] = coefficients;
        let slope = field.slope(e);
        let grows = c.lower() >= 0.0 && (b + c * e * 3.0).lower() >= 0.0;
        let excess = (a - c * e.square() * 3.0) * 4.0;
        let shields = slope.lower() > 0.0 && excess.upper() <= (slope * slope.square()).lower();
        let left = -field.force(e);
        let piece = left.hull(left + e.twice() / slope);
        let holds = velocity > 0.0 && grows && shields && piece.is_finite();
        Field { fence: holds.then_some([e, piece]), ..field }
    }

    fn force(&self, v: Interval) -> Interval {
        let [a, b, c] = self.coefficients;
        v * (a + v * (b + v * c))
    }

    fn slope(&self, v: Interval) -> Interval {
        let [a, b, c] = self.coefficients;
        a + v * (b.twice() + v * c * 3.0)
    }

    fn acceleration(&self, [x, v]: StateBox) -> Interval {
        -x - self.force(v)
    }

    /// The Taylor coefficients of all motions from a box.
    fn series(&self, [x, v]: StateBox) -> Series {
        let [a, b, c] = self.coefficients;
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
                let [position, velocity, _, square] = found[k];
                let force = a * velocity + b * square + c * product(&found, 3);
                let constant = if k == 0 { a } else { point(0.0) };
                let damping = constant + b.twice() * velocity + c * square * 3.0;
                for (column, rate) in
                    [velocity, -(position + force), damping].into_iter().enumerate()
                {
                    found[k + 1][column] = rate / degree;
                }
            }
        }
        found
    }

    /// Whether motions with position at most `x` and velocity at least `v` never return to `v = 0` (lemma 7):
    /// motions cross the line through this corner upwards, because `P(v) = m - (a + 2) v - b v^2 - c v^3` is
    /// not negative from v on.
    fn never_returns(&self, [x, v]: StateBox) -> bool {
        let [a, b, c] = self.coefficients;
        let at = point(v.lower());
        let m = at - x.upper();
        let p0 = m - at * (a + 2.0 + at * (b + at * c));
        let p1 = -(a + 2.0 + at * (b.twice() + at * c * 3.0));
        let p2 = -(b + at * c * 3.0);
        let square = p2.lower() > 0.0 && (p0 * p2 * 4.0 - p1.square()).lower() >= 0.0;
        let linear = [p0, p1, p2].iter().all(|it| it.lower() >= 0.0);
        m.lower() > 0.0 && v.lower() >= 0.0 && c.upper() <= 0.0 && (linear || square)
    }

    /// Whether the energy of motions in this box does not grow and is too small for them to go further out than
    /// `reach`.
    fn stays(&self, [x, v]: StateBox, reach: f64) -> bool {
        let [a, b, c] = self.coefficients;
        let most = (x.square() + v.square()).sqrt().upper();
        let speeds = Interval::new(0.0, most);
        most <= reach && (a + speeds * (b + speeds * c)).lower() >= 0.0
    }

    /// The end of motions faster than the fence, from the motions through both ends of its piece (lemma 12);
    /// `first` is the part until they became so fast. On the way `f'` is at least `rate v`, and the uncertainty
    /// of time and area is small.
    fn fall(&self, [e, piece]: Fence, first: Swing, reach: f64) -> Option<Swing> {
        let [a, b, c] = self.coefficients;
        let rate = point(a.lower().min(0.0)) / e + b.twice() + c * e * 3.0;
        let gained = (rate * (piece - first.end)).lower().max(0.0);
        let before = first.damping + gained;
        let from = |x: f64| self.follow(Disc::new([point(x), e]), reach, None);
        let (Some(low), Some(high)) = (from(piece.lower()), from(piece.upper())) else {
            return self.beyond_fold([e, piece], before);
        };
        let end = Interval::new(low.end.lower(), high.end.upper());
        let w = (point(end.upper()) * end.width() * 3.0).sqrt().upper();
        let drag = self.force(Interval::new(0.0, w)).magnitude();
        let rate = point(end.lower()) - drag;
        if !(rate.lower() > 0.0 && drag <= 0.49 * end.upper()) {
            return Some(Swing { end, ..UNKNOWN });
        }
        let late = (point(w) / rate).upper();
        let time = low.time.hull(high.time).widened(late) - low.time;
        let way = (end - piece) - (low.end - piece.lower());
        let after = low.damping + a * time + b.twice() * way - c * e * piece.width() * 3.0;
        let damping = Interval::new((before + after).lower(), f64::INFINITY);
        Some(Swing { end, damping, ..UNKNOWN })
    }

    /// The half swing from all z of an interval so far out that nothing slows motions down before they are
    /// faster than e: as long as `x <= -z/2`, v grows at least at the rate `z/2 - d`, where d bounds the
    /// damping below e (lemma 12).
    fn far(&self, z: Interval, [e, piece]: Fence, reach: f64) -> Option<Swing> {
        let slow = Interval::new(0.0, e.upper());
        let half = point(z.lower()) / 2.0;
        let rate = point((half - self.force(slow).magnitude()).lower());
        let time = e / rate;
        let way = e * time;
        let least = time * self.slope(slow).lower().min(0.0);
        let end = (-z).hull(way - z.lower());
        let reaches = rate.lower() > 0.0 && way.upper() <= half.lower();
        let damping = Interval::new(least.lower(), f64::INFINITY);
        reaches.then(|| self.fall([e, piece], Swing { end, damping, ..UNKNOWN }, reach))?
    }

    /// The end of motions that fall through a piece of `v = e > 0` at positive x, for `b < 0 < c`, where that
    /// is at a fold of `x = -f(v)` (end of lemma 12); `before` bounds the integral of `f'` until then from below.
    fn beyond_fold(&self, [e, piece]: Fence, before: Interval) -> Option<Swing> {
        let [a, b, c] = self.coefficients;
        if !(b.upper() < 0.0 && c.lower() > 0.0 && piece.lower() > 0.0) {
            return None;
        }
        let k = -b * b.square() * 4.0 / (c.square() * 27.0) + e * (-a.lower()).max(0.0);
        let last = e.twice() + k.upper().max(piece.upper());
        let end = Interval::new(piece.lower(), last.upper());
        let w = (-b / (c * 3.0)).upper();
        let rate = point((self.force(Interval::new(0.0, w)) + piece.lower()).lower());
        let time = point((end - piece).upper()) / point(w) + point(w) / rate;
        let least = (a - b.square() / (c * 3.0)).lower().min(0.0);
        let damping = Interval::new((time * least + before).lower(), f64::INFINITY);
        (rate.lower() > 0.0).then_some(Swing { end, damping, ..UNKNOWN })
    }

    /// Upper bound of all ends, however far out a motion starts: the end of the motion from the right end of
    /// the fence.
    pub fn greatest(&self) -> Interval {
        let from = |[e, piece]: Fence| self.follow(Disc::new([point(piece.upper()), e]), 0.0, None);
        self.fence.and_then(from).map_or(Interval::ALL, |it| it.end)
    }

    /// Lower bound of all ends, however near to the centre a motion starts, for `a <= -2`, where the centre is
    /// a node. No motion passes below the parabola `v = x - k x^2`, `k = 2 |b| + 1`, if
    /// `x (2 k^2 + |c|) <= k - |b|` (lemma 10).
    pub fn least(&self) -> Interval {
        let [a, b, c] = self.coefficients;
        let [b, c] = [b, c].map(|it| point(it.magnitude()));
        let k = b.twice() + 1.0;
        let x = point(1e-3 * ((k - b) / (k.square().twice() + c)).lower());
        let v = point((x - k * x.square()).lower());
        let leaves = a.upper() <= -2.0 && x.lower() > 0.0 && v.lower() > 0.0;
        leaves
            .then(|| self.run(Disc::new([x, v]), 0.0))
            .flatten()
            .map_or(Interval::ALL, |it| it.end)
    }

    /// The half swing from rest at `-z`, for all z of an interval; `reach` is the outer edge of the sticking set.
    pub fn swing(&self, z: Interval, reach: f64) -> Swing {
        if !(z.lower() > 0.0) {
            return UNKNOWN;
        }
        let near = self.run(Disc::new([-z, point(0.0)]), reach);
        let far = || self.far(z, self.fence?, reach);
        near.or_else(far).unwrap_or(UNKNOWN)
    }

    fn run(&self, disc: Disc, reach: f64) -> Option<Swing> {
        let fence = self.fence.filter(|it| disc.centre[1] <= it[0].lower());
        self.follow(disc, reach, fence)
    }

    /// The half swing of all motions from a disc; they are at rest if its centre is. `None` where it is not certain.
    fn follow(&self, mut disc: Disc, reach: f64, fence: Option<Fence>) -> Option<Swing> {
        for _ in 0..STEPS {
            let series = self.series(disc.centre.map(point));
            let last = series[ORDER][0].magnitude().max(series[ORDER][1].magnitude());
            let longest = pow(1e-6 * SMALL * disc.size() / last, 1.0 / 22.0).min(0.4);
            // The polynomial of the velocity gives the approximate time of its zero; no bound depends on it.
            let velocity = |h: f64| {
                let middles = series.iter().take(ORDER).rev().map(|row| row[1].middle());
                middles.fold(0.0, |sum: f64, next| sum * h + next)
            };
            let arrives = disc.centre[1] > 0.0 && velocity(longest) <= 0.0;
            let arrival = || bisect(0.0, longest, 60, |h| velocity(h) <= 0.0).1;
            let h = if arrives { arrival() } else { longest };
            let mut shorter = (0..90).map(|k| (k, h * powi(0.8, k)));
            let (tried, next) =
                shorter.find_map(|(k, h)| Some((k, disc.step(self, &series, h)?)))?;
            disc = next;
            if arrives && tried == 0 {
                return disc.end(self);
            }
            let place = disc.square();
            if !(place[1].lower() > 0.0) {
                return None;
            }
            if self.never_returns(place) {
                return Some(Swing { end: point(f64::INFINITY), ..UNKNOWN });
            }
            if self.stays(place, reach) {
                return Some(Swing { end: point(f64::NEG_INFINITY), ..UNKNOWN });
            }
            if let Some(fence) = fence.filter(|[e, _]| place[1].lower() > e.upper()) {
                return self.fall(fence, disc.swing(), reach);
            }
        }
        None
    }
}

/// A disc of motions in progress.
pub struct Disc {
    centre: [f64; 2],
    radius: f64,
    /// Elapsed time, and the integral of `f'` over it.
    time: Interval,
    damping: Interval,
}

impl Disc {
    /// The disc around a box with one side of zero width.
    fn new(place: StateBox) -> Self {
        let radius = place[0].radius().max(place[1].radius());
        Disc { centre: place.map(Interval::middle), radius, time: point(0.0), damping: point(0.0) }
    }

    fn square(&self) -> StateBox {
        self.centre.map(|middle| Interval::around(middle, self.radius))
    }

    /// The half swing up to here.
    fn swing(&self) -> Swing {
        Swing { end: self.square()[0], time: self.time, damping: self.damping }
    }

    fn size(&self) -> f64 {
        self.centre[0].abs().max(self.centre[1].abs())
    }

    /// The disc after a step; `None` if no box is found, the remainder is too large, or a return might be missed.
    fn step(&self, field: &Field, series: &Series, h: f64) -> Option<Disc> {
        let (start, time) = (self.square(), Interval::new(0.0, h));
        let next =
            |[x, v]: StateBox| [start[0] + time * v, start[1] + time * field.acceleration([x, v])];
        let mut place = start;
        let mut tries = 0..12;
        while let reached = next(place)
            && !(reached[0].is_within(place[0]) && reached[1].is_within(place[1]))
        {
            tries.next()?;
            place = [0, 1].map(|column| {
                let both = place[column].hull(reached[column]);
                both.widened(0.05 * both.radius())
            });
        }
        let place = next(place);
        let falls = field.acceleration(place);
        if !(place[1].lower() > 0.0 || falls.lower() > 0.0 || falls.upper() < 0.0) {
            return None;
        }
        let last = field.series(place)[ORDER].map(|it| (0..ORDER).fold(it, |it, _| it * h));
        if !(last[0].magnitude().max(last[1].magnitude()) <= SMALL * self.size()) {
            return None;
        }
        let [x, v, damping] = [0, 1, 2].map(|column| {
            let sum = (0..ORDER).rev().fold(point(0.0), |sum, k| sum * h + series[k][column]);
            sum + last[column]
        });
        let [_, b, c] = field.coefficients;
        let growth = (point((-field.slope(place[1]).lower()).max(0.0)) * h).exp();
        let spread = growth * self.radius;
        // How much `f'` may differ between two motions, from `f''`.
        let unlike = spread * (b + c * place[1] * 3.0).magnitude() * 2.0;
        let radius = (spread + x.radius() + v.radius()).upper();
        let damping = self.damping + damping.widened((unlike * h).upper());
        let (centre, time) = ([x, v].map(Interval::middle), self.time + h);
        radius.is_finite().then_some(Disc { centre, radius, time, damping })
    }

    /// The end, with `abs(v) <= m` for all motions. While this holds and x changes by at most a tenth, v falls
    /// at least at the rate A. It therefore vanishes within the time `m/A`, before or after, in which x moves
    /// at most `m^2/A`.
    fn end(&self, field: &Field) -> Option<Swing> {
        let [x, v] = self.square();
        let m = point(v.magnitude());
        let slow = m.hull(-m);
        let rate = point(-field.acceleration([x * Interval::new(0.9, 1.1), slow]).upper());
        let lag = m / rate;
        let way = (m * lag).upper();
        if !(rate.lower() > 0.0 && x.lower() > 0.0 && way < 0.05 * x.lower()) {
            return None;
        }
        let late = (lag * field.slope(slow).magnitude()).upper();
        let time = self.time.widened(lag.upper());
        Some(Swing { end: x.widened(way), time, damping: self.damping.widened(late) })
    }
}

#[cfg(test)]
mod tests;
