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

use crate::numerics::{Interval, bisect, pow, powi, real};

/// The field of a half plane.
#[derive(Clone, Copy, Debug)]
pub struct FencedField {
    /// a, b and c.
    coefficients: [Interval; 3],
    fence: Option<Fence>,
}

/// A half swing, for all its starts and coefficients.
#[derive(Clone, Copy, Debug)]
pub struct SwingBounds {
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

/// Taylor coefficients: of x, of v, of the integral of `f'`, and, below the degree of the remainder, of `v^2`.
type Series = [[Interval; 4]; ORDER + 1];

/// A box or a point: position and velocity.
type StateBox = [Interval; 2];

/// A half swing about which nothing is known.
const UNKNOWN: SwingBounds =
    SwingBounds { end: Interval::ALL, time: Interval::ALL, damping: Interval::ALL };

/// A velocity e, and a short piece of the line `v = e` through which all motions fall that become faster than e.
type Fence = [Interval; 2];

impl FencedField {
    /// A field, with a fence at this velocity e if there is one (lemma 11): where `f'` is positive and does not
    /// decrease from e on, and `4 (a - 3 c v^2) <= f'^3`, motions fall through `v = e` between `x = -f(e)` and
    /// `x = -f(e) + 2 e/f'(e)`.
    pub fn new(coefficients: [Interval; 3], velocity: f64) -> Self {
        let (field, e) = (FencedField { coefficients, fence: None }, Interval::point(velocity));
        let [a, b, c] = coefficients;
        let slope = field.slope(e);
        let grows = c.lower() >= 0.0 && (b + c * e * 3.0).lower() >= 0.0;
        let excess = (a - c * e.square() * 3.0) * 4.0;
        let shields = slope > 0.0 && excess.upper() <= (slope * slope.square()).lower();
        let left = -field.force(e);
        let piece = left.hull(left + e.twice() / slope);
        let holds = velocity > 0.0 && grows && shields && piece.is_finite();
        FencedField { fence: holds.then_some([e, piece]), ..field }
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
        let mut found = [[Interval::point(0.0); 4]; ORDER + 1];
        (found[0][0], found[0][1]) = (x, v);
        for k in 0..ORDER {
            let product = |found: &Series, i: usize| {
                (0..=k).fold(Interval::point(0.0), |sum, j| sum + found[j][i] * found[k - j][1])
            };
            found[k][3] = if k == 0 { v.square() } else { product(&found, 1) };
            let [position, velocity, _, square] = found[k];
            let force = a * velocity + b * square + c * product(&found, 3);
            let constant = if k == 0 { a } else { Interval::point(0.0) };
            let damping = constant + b.twice() * velocity + c * square * 3.0;
            let rates = [velocity, -(position + force), damping, Interval::point(0.0)];
            found[k + 1] = rates.map(|rate| rate / real(k + 1));
        }
        found
    }

    /// Whether motions with position at most `x` and velocity at least `v` never return to `v = 0` (lemma 7):
    /// motions cross the line through this corner upwards, because `P(v) = m - (a + 2) v - b v^2 - c v^3` is
    /// not negative from v on.
    fn never_returns(&self, [x, v]: StateBox) -> bool {
        let [a, b, c] = self.coefficients;
        let at = Interval::point(v.lower());
        let m = at - x.upper();
        let p0 = m - at * (a + 2.0 + at * (b + at * c));
        let p1 = -(a + 2.0 + at * (b.twice() + at * c * 3.0));
        let p2 = -(b + at * c * 3.0);
        let square = p2 > 0.0 && (p0 * p2 * 4.0 - p1.square()).lower() >= 0.0;
        let linear = [p0, p1, p2].iter().all(|it| it.lower() >= 0.0);
        m > 0.0 && v.lower() >= 0.0 && c.upper() <= 0.0 && (linear || square)
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
    fn fall(&self, [e, piece]: Fence, first: SwingBounds, reach: f64) -> Option<SwingBounds> {
        let [a, b, c] = self.coefficients;
        let rate = Interval::point(a.lower().min(0.0)) / e + b.twice() + c * e * 3.0;
        let gained = (rate * (piece - first.end)).lower().max(0.0);
        let before = first.damping + gained;
        let from = |x: f64| self.follow(Disc::new([Interval::point(x), e]), reach, None);
        let (Some(low), Some(high)) = (from(piece.lower()), from(piece.upper())) else {
            return self.beyond_fold([e, piece], before);
        };
        let end = Interval::new(low.end.lower(), high.end.upper());
        let w = (Interval::point(end.upper()) * end.width() * 3.0).sqrt().upper();
        let drag = self.force(Interval::new(0.0, w)).magnitude();
        let rate = Interval::point(end.lower()) - drag;
        if !(rate > 0.0 && drag <= 0.49 * end.upper()) {
            return Some(SwingBounds { end, ..UNKNOWN });
        }
        let late = (Interval::point(w) / rate).upper();
        let time = low.time.hull(high.time).widened(late) - low.time;
        let way = (end - piece) - (low.end - piece.lower());
        let after = low.damping + a * time + b.twice() * way - c * e * piece.width() * 3.0;
        let damping = Interval::new((before + after).lower(), f64::INFINITY);
        Some(SwingBounds { end, damping, ..UNKNOWN })
    }

    /// The half swing from all z of an interval so far out that nothing slows motions down before they are
    /// faster than e: as long as `x <= -z/2`, v grows at least at the rate `z/2 - d`, where d bounds the
    /// damping below e (lemma 12).
    fn far(&self, z: Interval, [e, piece]: Fence, reach: f64) -> Option<SwingBounds> {
        let slow = Interval::new(0.0, e.upper());
        let half = Interval::point(z.lower()) / 2.0;
        let rate = Interval::point((half - self.force(slow).magnitude()).lower());
        let time = e / rate;
        let way = e * time;
        let least = time * self.slope(slow).lower().min(0.0);
        let end = (-z).hull(way - z.lower());
        let reaches = rate > 0.0 && way.upper() <= half.lower();
        let damping = Interval::new(least.lower(), f64::INFINITY);
        reaches.then(|| self.fall([e, piece], SwingBounds { end, damping, ..UNKNOWN }, reach))?
    }

    /// The end of motions that fall through a piece of `v = e > 0` at positive x, for `b < 0 < c`, where that
    /// is at a fold of `x = -f(v)` (end of lemma 12); `before` bounds the integral of `f'` until then from below.
    fn beyond_fold(&self, [e, piece]: Fence, before: Interval) -> Option<SwingBounds> {
        let [a, b, c] = self.coefficients;
        if !(b < 0.0 && c > 0.0 && piece > 0.0) {
            return None;
        }
        let k = -b * b.square() * 4.0 / (c.square() * 27.0) + e * (-a.lower()).max(0.0);
        let last = e.twice() + k.upper().max(piece.upper());
        let end = Interval::new(piece.lower(), last.upper());
        let w = (-b / (c * 3.0)).upper();
        let rate = Interval::point((self.force(Interval::new(0.0, w)) + piece.lower()).lower());
        let time =
            Interval::point((end - piece).upper()) / Interval::point(w) + Interval::point(w) / rate;
        let least = (a - b.square() / (c * 3.0)).lower().min(0.0);
        let damping = Interval::new((time * least + before).lower(), f64::INFINITY);
        (rate > 0.0).then_some(SwingBounds { end, damping, ..UNKNOWN })
    }

    /// Upper bound of all ends, however far out a motion starts: the end of the motion from the right end of
    /// the fence.
    pub fn greatest(&self) -> Interval {
        let from = |[e, piece]: Fence| {
            self.follow(Disc::new([Interval::point(piece.upper()), e]), 0.0, None)
        };
        self.fence.and_then(from).unwrap_or(UNKNOWN).end
    }

    /// Lower bound of all ends, however near to the centre a motion starts, for `a <= -2`, where the centre is
    /// a node. No motion passes below the parabola `v = x - k x^2`, `k = 2 |b| + 1`, if
    /// `x (2 k^2 + |c|) <= k - |b|` (lemma 10).
    pub fn least(&self) -> Interval {
        let [a, b, c] = self.coefficients;
        let [b, c] = [b, c].map(|it| Interval::point(it.magnitude()));
        let k = b.twice() + 1.0;
        let x = Interval::point(1e-3 * ((k - b) / (k.square().twice() + c)).lower());
        let v = Interval::point((x - k * x.square()).lower());
        let leaves = a.upper() <= -2.0 && x > 0.0 && v > 0.0;
        leaves.then(|| self.run(Disc::new([x, v]), 0.0)).flatten().unwrap_or(UNKNOWN).end
    }

    /// The half swing from rest at `-z`, for all z of an interval; `reach` is the outer edge of the sticking set.
    pub fn swing(&self, z: Interval, reach: f64) -> SwingBounds {
        if !(z > 0.0) {
            return UNKNOWN;
        }
        let near = self.run(Disc::new([-z, Interval::point(0.0)]), reach);
        let far = || self.far(z, self.fence?, reach);
        near.or_else(far).unwrap_or(UNKNOWN)
    }

    fn run(&self, disc: Disc, reach: f64) -> Option<SwingBounds> {
        let fence = self.fence.filter(|it| disc.centre[1] <= it[0].lower());
        self.follow(disc, reach, fence)
    }

    /// The half swing of all motions from a disc; they are at rest if its centre is. `None` where it is not certain.
    fn follow(&self, mut disc: Disc, reach: f64, fence: Option<Fence>) -> Option<SwingBounds> {
        for _ in 0..STEPS {
            let series = self.series(disc.centre.map(Interval::point));
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
            let shorter = |k| Some((k, disc.step(self, &series, h * powi(0.8, k))?));
            let (tried, next) = (0..90).find_map(shorter)?;
            disc = next;
            if arrives && tried == 0 {
                return disc.end(self);
            }
            let place = disc.square();
            if !(place[1] > 0.0) {
                return None;
            }
            if self.never_returns(place) {
                return Some(SwingBounds { end: Interval::point(f64::INFINITY), ..UNKNOWN });
            }
            if self.stays(place, reach) {
                return Some(SwingBounds { end: Interval::point(f64::NEG_INFINITY), ..UNKNOWN });
            }
            if let Some(fence) = fence.filter(|[e, _]| place[1] > e.upper()) {
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
        let (centre, none) = (place.map(Interval::middle), Interval::point(0.0));
        Disc { centre, radius, time: none, damping: none }
    }

    fn square(&self) -> StateBox {
        self.centre.map(|middle| Interval::around(middle, self.radius))
    }

    /// The half swing up to here.
    fn swing(&self) -> SwingBounds {
        SwingBounds { end: self.square()[0], time: self.time, damping: self.damping }
    }

    fn size(&self) -> f64 {
        self.centre[0].abs().max(self.centre[1].abs())
    }

    /// The disc after a step; `None` if no box is found, the remainder is too large, or a return might be missed.
    fn step(&self, field: &FencedField, series: &Series, h: f64) -> Option<Disc> {
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
        if !(place[1] > 0.0 || falls > 0.0 || falls < 0.0) {
            return None;
        }
        let last = field.series(place)[ORDER].map(|it| (0..ORDER).fold(it, |it, _| it * h));
        if !(last[0].magnitude().max(last[1].magnitude()) <= SMALL * self.size()) {
            return None;
        }
        let [x, v, damping] = [0, 1, 2].map(|column| {
            let sum =
                (0..ORDER).rev().fold(Interval::point(0.0), |sum, k| sum * h + series[k][column]);
            sum + last[column]
        });
        let [_, b, c] = field.coefficients;
        let growth = (Interval::point((-field.slope(place[1]).lower()).max(0.0)) * h).exp();
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
    fn end(&self, field: &FencedField) -> Option<SwingBounds> {
        let [x, v] = self.square();
        let m = Interval::point(v.magnitude());
        let slow = m.hull(-m);
        let rate =
            Interval::point(-field.acceleration([x * Interval::new(0.9, 1.1), slow]).upper());
        let lag = m / rate;
        let way = (m * lag).upper();
        if !(rate > 0.0 && x > 0.0 && way < 0.05 * x.lower()) {
            return None;
        }
        let late = (lag * field.slope(slow).magnitude()).upper();
        let time = self.time.widened(lag.upper());
        Some(SwingBounds { end: x.widened(way), time, damping: self.damping.widened(late) })
    }
}

#[cfg(test)]
mod tests {
    //! Bounds of steps, fences and arrivals in cases where they are sharp or nearly so.

    use super::*;
    use crate::numerics::elementary::{atan, exp, hypot, sin_cos};

    fn field(coefficients: [f64; 3]) -> FencedField {
        FencedField::new(coefficients.map(Interval::point), 0.0)
    }

    fn disc(x: f64, v: f64, radius: f64) -> Disc {
        Disc { centre: [x, v], radius, time: Interval::point(0.0), damping: Interval::point(0.0) }
    }

    fn stepped(field: &FencedField, disc: &Disc, h: f64) -> Option<Disc> {
        disc.step(field, &field.series(disc.centre.map(Interval::point)), h)
    }

    /// A velocity displacement of a linear swing after the time h.
    fn displaced(a: f64, h: f64) -> f64 {
        let half = a / 2.0;
        let root = (half * half - 1.0).sqrt();
        let [fast, slow] = [root - half, -root - half];
        let (one, other) = (exp(fast * h), exp(slow * h));
        hypot(one - other, fast * one - slow * other) / (fast - slow)
    }

    /// Motions of a rotation keep their distance; where a fast direction repels they separate at the maximum rate.
    #[test]
    fn a_disc_grows_as_its_motions_part() {
        let rotation = field([0.0; 3]);
        for radius in [1e-9, 1e-3, 0.1] {
            let after = stepped(&rotation, &disc(-1.0, 0.5, radius), 0.1).unwrap().radius;
            assert!(after >= radius && after < radius + 1e-14, "{radius} {after}");
        }
        for (a, h) in [(-10.0, 0.05), (-40.0, 0.012)] {
            let after = stepped(&field([a, 0.0, 0.0]), &disc(-1.0, 1.0, 1e-3), h).unwrap().radius;
            let parted = 1e-3 * displaced(a, h);
            assert!(after >= parted && after < 1.001 * parted, "{a}: {after} {parted}");
        }
    }

    /// Motions under different damping separate; the disc contains both, and its radius is their difference in velocity.
    #[test]
    fn a_disc_holds_the_motions_of_all_coefficients() {
        let wide = FencedField::new(
            [Interval::new(0.9, 1.1), Interval::point(0.0), Interval::point(0.0)],
            0.0,
        );
        let h = 0.01;
        let after = stepped(&wide, &disc(0.0, 1.0, 0.0), h).unwrap();
        let velocity = |a: f64| {
            let root = (1.0 - a * a / 4.0).sqrt();
            let (sine, cosine) = sin_cos(root * h);
            exp(-a * h / 2.0) * (cosine - a / (2.0 * root) * sine)
        };
        let apart = velocity(0.9) - velocity(1.1);
        assert!(
            2.0 * after.radius >= apart && 2.0 * after.radius < 1.05 * apart,
            "{}",
            after.radius
        );
        assert!([0.9, 1.1].iter().all(|&a| after.square()[1].contains(velocity(a))));
    }

    /// With `v' = B v^2 - 1` the integral of `f' = -2 B v` is `2 ln(cosh t - sqrt(B) v sinh t)` at the time
    /// `t/sqrt(B)`, except for the motion of x, a relative `1e-18`. Over this step the error of the polynomial
    /// alone is `4e-15`, four times its rounding error.
    #[test]
    fn a_step_holds_what_its_polynomial_leaves_out() {
        /// For `t = 0.0245`, `sqrt(B) v = 10`: the double nearest to -0.5613450494823475487, computed with 40 digits.
        const EXACT: f64 = -0.561_345_049_482_347_5;
        let root = 1e9;
        let fast = field([0.0, -root * root, 0.0]);
        let after = stepped(&fast, &disc(1.0, 1e-8, 0.0), 0.0245 / root).unwrap();
        assert!(after.damping.contains(EXACT), "{}", after.damping);
    }

    /// Of the motions around the centre, some turn one way and some the other within any time.
    #[test]
    fn motions_that_may_turn_both_ways_are_not_carried() {
        let rotation = field([0.0; 3]);
        assert!(stepped(&rotation, &disc(0.0, 0.05, 0.1), 0.1).is_none());
        assert!(stepped(&rotation, &disc(0.0, 0.5, 0.1), 0.1).is_some());
        assert!(stepped(&rotation, &disc(0.5, 0.05, 0.1), 0.1).is_some());
    }

    /// Motions not yet at rest, or at rest before, arrive further out and at another time; the closed form is a spiral.
    #[test]
    fn an_arrival_holds_what_is_left_of_the_way() {
        for a in [-0.4, 0.0, 0.6] {
            for v in [1e-3, -1e-3] {
                let found = disc(1.0, v, 0.0).end(&field([a, 0.0, 0.0])).unwrap();
                let root = (1.0 - a * a / 4.0).sqrt();
                let time = atan(root * v / (1.0 + a * v / 2.0)) / root;
                let end = exp(-a * time / 2.0) * hypot(root, v + a / 2.0);
                for (what, found, exact, slack) in [
                    ("end", found.end, end, 2.5 * 0.5e-6),
                    ("time", found.time, time, 1.2e-3),
                    ("damping", found.damping, a * time, 1.2e-3 * a.abs()),
                ] {
                    assert!(found.contains(exact), "{a} {v} {what}: {found} {exact}");
                    assert!(found.radius() <= slack + 1e-15, "{a} {v} {what}: {found}");
                }
            }
        }
    }

    /// All motions of a linear node from far out follow its slow line, on which `x = -v/lambda`,
    /// `lambda^2 - a lambda + 1 = 0`. For `a = 2` this line passes the right end of the piece.
    #[test]
    fn the_piece_of_a_fence_reaches_to_the_slow_line() {
        let (a, e) = (2.001, 0.3);
        let fence = |a: f64| FencedField::new([a, 1e-9, 0.0].map(Interval::point), e).fence;
        let [_, piece] = fence(a).unwrap();
        let slow = (a - f64::sqrt(a * a - 4.0)) / 2.0;
        let at = -e / slow;
        assert!(piece.contains(at) && piece.upper() - at < 0.07 * piece.width(), "{piece} {at}");
        assert!(piece.contains(-a * e));
        // For smaller damping there is no fence.
        assert!(fence(1.999).is_none());
    }

    /// From `v = 0` at `-m` on, `P` is `(v - 1)^2 + m - 1` for `a = 0`, `b = -1`. Where it is negative somewhere,
    /// nothing is claimed.
    #[test]
    fn what_never_returns_is_told_from_what_may() {
        for (coefficients, place, never) in [
            ([0.0, -1.0, 0.0], [-1.001, 0.0], true),
            ([0.0, -1.0, 0.0], [-0.98, 0.0], false),
            ([0.0, -1.0, 0.0], [-0.501, 0.5], true),
            ([0.0, -1.0, 0.0], [-0.48, 0.5], false),
            // `m - 0.05 v + 0.001 v^2`, at least `m - 0.625`.
            ([-1.95, -0.001, 0.0], [-0.63, 0.0], true),
            ([-1.95, -0.001, 0.0], [-0.62, 0.0], false),
            // `P = m - 2.1756.. + (v - 1.475)^2`, `m = 1 - x`.
            ([0.95, -1.0, 0.0], [-1.18, 1.0], true),
            ([0.95, -1.0, 0.0], [-1.17, 1.0], false),
            ([0.95, -1.0, 0.0], [-1.1, 1.0], false),
            // The centre is at rest, and cubic damping brings every motion back.
            ([-3.0, -1.0, 0.0], [0.0, 0.0], false),
            ([-3.0, -1.0, 1e-9], [-1.0, 0.0], false),
        ] {
            let found = field(coefficients).never_returns(place.map(Interval::point));
            assert_eq!(found, never, "{coefficients:?} {place:?}");
        }
    }

    /// Next to a node every swing, however near to the centre it starts, ends beyond the common bound. A spiral has
    /// no such bound.
    #[test]
    fn swings_from_next_to_a_node_end_beyond_their_bound() {
        for coefficients in [[-2.0, 0.5, 1.0], [-2.2, -0.5, 1.0], [-2.5, 0.0, 3.0]] {
            let node = field(coefficients);
            let least = node.least().lower();
            assert!(least > 0.0, "{coefficients:?}");
            for z in [1e-9, 1e-5, 1e-3, 0.1] {
                let end = node.swing(Interval::point(z), 0.0).end;
                assert!(
                    end.is_finite() && end.upper() >= least,
                    "{coefficients:?} {z}: {end} {least}"
                );
            }
        }
        assert!(field([-1.95, 0.5, 1.0]).least() == Interval::ALL);
    }
}
