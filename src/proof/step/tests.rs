//! The rounding counts derived by hand, verified by numbers that count their own roundings.

use std::ops::{Add, Mul, Neg, Sub};

use super::*;
use crate::numerics::{Twofold, exp, sin_cos};
use crate::proof::series::SeriesScalar;

/// A magnitude, and its possible error in units of roundoff.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CountedErrors {
    size: f64,
    roundings: f64,
}

fn exact(size: f64) -> CountedErrors {
    CountedErrors { size, roundings: 0.0 }
}

impl Add for CountedErrors {
    type Output = CountedErrors;

    fn add(self, other: CountedErrors) -> CountedErrors {
        let size = self.size + other.size;
        let own = if self.size == 0.0 || other.size == 0.0 {
            0.0
        } else {
            size
        };
        CountedErrors { size, roundings: self.roundings + other.roundings + own }
    }
}

/// For magnitudes a difference is a sum.
#[expect(clippy::suspicious_arithmetic_impl, reason = "the worst case of a difference")]
impl Sub for CountedErrors {
    type Output = CountedErrors;

    fn sub(self, other: CountedErrors) -> CountedErrors {
        self + other
    }
}

impl Mul for CountedErrors {
    type Output = CountedErrors;

    fn mul(self, other: CountedErrors) -> CountedErrors {
        let size = self.size * other.size;
        let carried = self.roundings * other.size + other.roundings * self.size;
        CountedErrors { size, roundings: carried + size }
    }
}

impl Neg for CountedErrors {
    type Output = CountedErrors;

    fn neg(self) -> CountedErrors {
        self
    }
}

thread_local! {
    /// Roundings of the coefficients finished so far, in pairs for x and v.
    static TAKEN: std::cell::RefCell<Vec<f64>> = const { std::cell::RefCell::new(Vec::new()) };
    /// Sizes that replace those of the coefficients of v, if there are any.
    static PLANTED: std::cell::RefCell<Vec<f64>> = const { std::cell::RefCell::new(Vec::new()) };
}

impl SeriesScalar for CountedErrors {
    const ZERO: CountedErrors = CountedErrors { size: 0.0, roundings: 0.0 };

    fn inverse(k: usize) -> CountedErrors {
        // Only powers of two have an exact inverse; the bound counts one rounding for every k, and so does this.
        CountedErrors { size: INVERSE[k], roundings: INVERSE[k] }
    }

    fn taken(self) -> CountedErrors {
        let place = TAKEN.with_borrow_mut(|taken| {
            taken.push(self.roundings);
            taken.len() - 1
        });
        let degree = place / 2 + 1;
        PLANTED.with_borrow(|planted| match planted.get(degree) {
            Some(&size) => exact(if place % 2 == 1 { size } else { planted[0] }),
            None => exact(self.size),
        })
    }
}

/// For each degree: the roundings of `k + 1` times the next coefficients of x and v, and the sums of magnitudes
/// that the numbers of [`ROUNDINGS`] multiply.
fn counted(field: [f64; 3], x: f64, v: f64) -> Vec<(f64, [f64; 7])> {
    let mut series = MotionSeries::<CountedErrors>::EMPTY;
    TAKEN.with_borrow_mut(Vec::clear);
    series.expand(field.map(exact), exact(x), exact(v));
    let taken = TAKEN.take();
    let [a, b, c] = field;
    let size = |k: usize| series.v[k].size;
    let square = |k: usize| (0..=k).map(|i| size(i) * size(k - i)).sum::<f64>();
    let row = |k: usize| {
        let degree = f64::from(u8::try_from(k).unwrap());
        let cube: f64 = (0..=k).map(|i| square(i) * size(k - i)).sum();
        // In sums over all degrees `v v'` is a half, and `v^2 v'` a third, of the degree times v^2 and v^3.
        let (b0, c0) = (b * square(k), c * cube);
        let sizes =
            [size(k), series.x[k].size, a * size(k), b0, 0.5 * degree * b0, c0, degree / 3.0 * c0];
        ((degree + 1.0) * (taken[2 * k] + taken[2 * k + 1]), sizes)
    };
    (0..ORDER).map(row).collect()
}

/// The bound is never below the count, and halving any of its numbers brings it below the count somewhere: for
/// series of real motions, and for series in which only two terms are not negligible.
#[test]
fn the_bound_of_roundings_is_what_counting_gives() {
    /// Negligible, but large enough that adding it is not exact.
    const LITTLE: f64 = 1e-30;
    let sparse = |one: usize, other: usize| -> Vec<f64> {
        let size = |k| if k == one || k == other { 1.0 } else { LITTLE };
        (0..=ORDER).map(size).collect()
    };
    let pairs = (1..ORDER).flat_map(|one| (one..ORDER).map(move |other| (one, other)));
    let series = std::iter::once(Vec::new()).chain(pairs.map(|(one, other)| sparse(one, other)));
    let mut tightest = [f64::INFINITY; 7];
    for (planted, strong) in
        series.flat_map(|it| [None, Some(0), Some(1), Some(2)].map(|strong| (it.clone(), strong)))
    {
        let starts: &[_] = if planted.is_empty() {
            &[(1.0, LITTLE), (LITTLE, 1.0), (1.0, 1.0)]
        } else {
            &[(LITTLE, LITTLE)]
        };
        PLANTED.set(planted);
        let mut field = [LITTLE; 3];
        if let Some(strong) = strong {
            field[strong] = 1e3;
        }
        for &(x, v) in starts {
            for (degree, (count, sizes)) in counted(field, x, v).into_iter().enumerate() {
                let bound = |numbers: &[f64; 7]| -> f64 {
                    numbers.iter().zip(&sizes).map(|(number, size)| number * size).sum()
                };
                let whole = bound(&ROUNDINGS);
                assert!(count <= whole * (1.0 + 1e-9), "{field:?} {degree}: {count} > {whole}");
                for (index, tightest) in tightest.iter_mut().enumerate() {
                    let mut fewer = ROUNDINGS;
                    fewer[index] *= 0.5;
                    *tightest = tightest.min(bound(&fewer) / count);
                }
            }
        }
    }
    assert!(tightest.iter().all(|&ratio| ratio < 0.9), "not all are needed: {tightest:?}");
}

#[test]
fn a_polynomial_is_evaluated_with_the_roundings_counted() {
    let mut series = MotionSeries::<CountedErrors>::EMPTY;
    series.expand([0.3, 0.2, 0.5].map(exact), exact(1.0), exact(0.5));
    for h in [1e-6, 0.3, 1.0, 30.0] {
        let (x, v) = series.at(exact(h));
        let degrees = |coefficients: &[CountedErrors; LENGTH]| {
            let mut power = 1.0;
            let mut sum = 0.0;
            for (k, coefficient) in coefficients.iter().enumerate().take(ORDER + 1) {
                let degree = f64::from(u8::try_from(k).unwrap());
                sum += (HORNER[0] + HORNER[1] * degree) * coefficient.size * power;
                power *= h;
            }
            sum
        };
        for (value, bound) in [(x, degrees(&series.x)), (v, degrees(&series.v))] {
            assert!(
                value.roundings <= bound * (1.0 + 1e-9) && value.roundings > 0.4 * bound,
                "{h} {value:?} {bound}"
            );
        }
    }
}

/// The coefficients against the equation in twice the precision. Each error is within what its roundings allow;
/// an error of 1e-13 in one of them would exceed that.
#[test]
fn every_coefficient_obeys_the_equation_to_rounding() {
    for field in [[-0.4, 0.2, 0.5], [0.3, -0.7, -0.2], [-0.2, 0.0, 0.0], [1.9, 3.0, 7.0]] {
        let mut series = MotionSeries::<f64>::EMPTY;
        for (x, v) in [(-0.3, 0.0), (-0.7, 1.3), (0.4, 0.9)] {
            series.expand(field, x, v);
            let of = Twofold::from;
            let product = |one: &[Twofold], other: &[f64], k: usize| {
                (0..=k).fold(of(0.0), |sum, i| sum + one[i].times(other[k - i]))
            };
            let first: Vec<Twofold> = series.v.iter().map(|&it| of(it)).collect();
            let squares: Vec<_> = (0..ORDER).map(|k| product(&first, &series.v, k)).collect();
            let sizes = series.v.map(f64::abs);
            let first_sizes: Vec<Twofold> = sizes.iter().map(|&it| of(it)).collect();
            let square_sizes: Vec<_> =
                (0..ORDER).map(|k| product(&first_sizes, &sizes, k)).collect();
            for k in 0..ORDER {
                let degree = f64::from(u8::try_from(k).unwrap());
                let terms = [
                    of(series.v[k + 1]).times(degree + 1.0),
                    of(series.x[k]),
                    of(series.v[k]).times(field[0]),
                    squares[k].times(field[1]),
                    product(&squares, &series.v, k).times(field[2]),
                ];
                let defect = terms.into_iter().fold(of(0.0), |sum, it| sum + it).high.abs();
                // Lemma 2, term by term; of three factors, two have a combined degree of at most k.
                let [a, b, c] = field.map(f64::abs);
                let cubes = product(&square_sizes, &sizes, k).high;
                let allowed = UNIT
                    * (4.0 * series.x[k].abs()
                        + 6.0 * a * sizes[k]
                        + (11.0 + 0.25 * degree) * b * square_sizes[k].high
                        + (13.0 + 0.5 * degree) * c * cubes)
                    * (1.0 + 1e-9);
                assert!(defect <= allowed, "{field:?} degree {k}: {defect:e} > {allowed:e}");
                // Lemma 3: the coefficients of v^2 themselves.
                let off = (squares[k] - of(series.square[k])).high.abs();
                assert!(off <= 28.0 * UNIT * square_sizes[k].high, "degree {k}: {off:e}");
                let off = series.x[k + 1] * (degree + 1.0) - series.v[k];
                assert!(off.abs() <= 2.1 * UNIT * series.v[k].abs(), "degree {k}");
            }
        }
    }
}

/// Growth is at least that of every member: the largest eigenvalue of the symmetric part in the norm, on a grid.
#[test]
fn errors_of_a_linear_spiral_grow_as_it_does() {
    for a in [-1.9, -0.4, 0.0, 0.7, 1.9, -3.0, 3.0] {
        let (low, high) = if f64::abs(a) < 2.0 {
            (-0.5 * a, -0.5 * a)
        } else {
            let root = (a * a / 4.0 - 1.0_f64).sqrt();
            (-0.5 * a + root, -0.5 * a + root)
        };
        let point = Interval::point;
        let field = FieldBox { a: point(a), b: point(0.0), c: point(0.0) };
        let rate = StepField::new(&field).growth(Norm::fitting(a), Interval::new(0.9, 1.1));
        assert!(rate >= low && rate <= high + 1e-9, "{a}: {rate} {high}");
    }
}

#[test]
fn growth_bounds_every_direction_and_every_slope() {
    let point = Interval::point;
    for skew in [-1.9, -0.5, 0.0, 0.8, 1.99] {
        let norm = Norm::new(skew);
        for (a, b, c) in [(-0.4, 0.3, 0.5), (1.0, -2.0, 0.0), (0.2, 0.0, -3.0)] {
            let field = FieldBox { a: point(a), b: point(b), c: point(c) };
            let (v0, reach) = (0.7, 0.4);
            let bound = StepField::new(&field).growth(norm, Interval::around(v0, reach));
            let mut most = f64::NEG_INFINITY;
            for i in 0..=20 {
                for j in 0..=20 {
                    let at = |k: i32| v0 + reach * (f64::from(k) / 10.0 - 1.0);
                    let (v, w) = (at(i), at(j));
                    let m = a + b * (v + w) + c * (v * v + v * w + w * w);
                    for k in 0..90 {
                        let (y, x) = sin_cos(f64::from(k) * std::f64::consts::PI / 90.0);
                        let size = x * x + skew * x * y + y * y;
                        let change =
                            2.0 * x * y + skew * y * y + (skew * x + 2.0 * y) * (-x - m * y);
                        most = most.max(0.5 * change / size);
                    }
                }
            }
            assert!(
                most <= bound && most > bound - 0.2 * bound.abs() - 0.05,
                "{skew} {a} {b} {c}: {most} {bound}"
            );
        }
    }
}

#[test]
fn nothing_is_said_of_what_is_not_a_number() {
    let point = Interval::point;
    let field = FieldBox { a: point(-0.2), b: point(0.1), c: point(0.5) };
    let local = StepField::new(&field);
    let mut series = MotionSeries::<f64>::EMPTY;
    series.expand(local.middles, -0.5, 0.2);
    let norm = Norm::new(0.0);
    assert!(local.carry(norm, &series, (0.2, series.at(0.2)), 1e-15).is_some());
    assert!(local.carry(norm, &series, (0.2, series.at(0.2)), f64::NAN).is_none());
    assert!(local.carry(norm, &series, (f64::NAN, series.at(f64::NAN)), 1e-15).is_none());
    assert!(local.carry(norm, &series, (5.0, series.at(5.0)), 1e-15).is_none());
    // Zero times infinity is NaN.
    let linear = StepField::new(&FieldBox { a: point(-0.2), b: point(0.0), c: point(0.0) });
    assert_eq!(linear.growth(norm, Interval::ALL), f64::INFINITY);
    series.v[7] = f64::NAN;
    assert!(local.carry(norm, &series, (0.2, series.at(0.2)), 1e-15).is_none());
}

#[test]
fn exponentials_are_bounded_from_above() {
    for z in [-0.9, -0.3, -1e-9, 0.0, 1e-9, 0.2, 0.5, 0.9] {
        let bound = exponential(z).unwrap();
        let exact = Interval::point(z).exp();
        assert!(bound >= exact.upper() && bound < exact.upper() * 1.02, "{z}");
    }
    assert!(exponential(0.91).is_none() && exponential(f64::NAN).is_none());
}

/// A half turn takes half a period: in a longer step the velocity could become negative and positive again.
#[test]
fn no_step_is_longer_than_a_turn() {
    let point = Interval::point;
    let local = StepField::new(&FieldBox { a: point(0.0), b: point(0.0), c: point(0.0) });
    let mut series = MotionSeries::<f64>::EMPTY;
    series.expand(local.middles, -0.9, 0.2);
    for (h, held) in [(3.1, true), (3.13, true), (3.15, false), (3.4, false)] {
        assert_eq!(
            local.carry(Norm::new(0.0), &series, (h, series.at(h)), 1e-12).is_some(),
            held,
            "{h}"
        );
    }
    // Damping makes the angle turn faster, by at most half of its slope.
    let damped = StepField::new(&FieldBox { a: point(1.0), b: point(0.0), c: point(0.0) });
    series.expand(damped.middles, -0.9, 0.2);
    for (h, held) in [(2.05, true), (2.12, false)] {
        let found = damped.carry(Norm::fitting(1.0), &series, (h, series.at(h)), 1e-12);
        assert_eq!(found.is_some(), held, "{h}");
    }
    // Where the velocity is certainly positive throughout, the bound on the angle does not matter.
    let fast = StepField::new(&FieldBox { a: point(0.0), b: point(-50.0), c: point(0.0) });
    series.expand(fast.middles, 0.0, 1.0);
    assert!(fast.carry(Norm::new(0.0), &series, (1e-3, series.at(1e-3)), 1e-12).is_some());
}

/// For a series of positive terms the truncation bound equals what is truncated.
#[test]
fn truncation_is_bounded_by_all_terms_that_are_cut_off() {
    let (h, mut series) = (0.5, MotionSeries::<f64>::EMPTY);
    let terms: [f64; ORDER + 1] = std::array::from_fn(|k| 1.0 + INVERSE[k + 1]);
    let mut power = 1.0;
    for (coefficient, term) in series.v.iter_mut().zip(terms) {
        *coefficient = term / power;
        power *= h;
    }
    let (mut squares, mut cubes) = (0.0, 0.0);
    for i in 0..=ORDER {
        for j in 0..=ORDER {
            if i + j < ORDER {
                series.square[i + j] += series.v[i] * series.v[j];
            } else {
                squares += terms[i] * terms[j];
            }
            let rest = (0..=ORDER).filter(|k| i + j + k >= ORDER).map(|k| terms[k]);
            cubes += terms[i] * terms[j] * rest.sum::<f64>();
        }
    }
    let sums = Sums::of(&series, h);
    let (last, position) = (terms[ORDER], h * terms[ORDER - 1] * INVERSE[ORDER]);
    for ([a, b, c], cut) in [
        ([0.0; 3], last + position),
        ([1.0, 0.0, 0.0], 2.0 * last + position),
        ([0.0, 1.0, 0.0], last + position + squares),
        ([0.0, 0.0, 1.0], last + position + cubes),
    ] {
        let ratio = sums.truncation([a, b, c]) / cut;
        assert!((ratio - 1.0).abs() < 1e-10, "{a} {b} {c}: {ratio}");
    }
}

/// A spiral whose truncation error in a step exceeds its rounding error, against its closed form, and its area
/// with a ball around it.
#[test]
fn a_step_holds_what_its_polynomial_leaves_out() {
    let point = Interval::point;
    let local = StepField::new(&FieldBox { a: point(10.0), b: point(0.0), c: point(0.0) });
    let (h, root) = (0.5, 24.0_f64.sqrt());
    let mut series = MotionSeries::<f64>::EMPTY;
    series.expand(local.middles, -1.0, 0.0);
    let norm = Norm::fitting(10.0);
    let end = local.carry(norm, &series, (h, series.at(h)), 0.0).unwrap();
    let powers = [(root - 5.0) * h, (-root - 5.0) * h].map(exp);
    let velocity = (powers[0] - powers[1]) / (2.0 * root);
    let off = (end.v - velocity).abs();
    assert!(off > 1e-13 && off <= norm.stretch * end.radius, "{off:e} {:e}", end.radius);
    // Without damping, displaced in velocity by the radius of the ball.
    let local = StepField::new(&FieldBox { a: point(0.0), b: point(0.0), c: point(0.0) });
    let (h, ball) = (0.1, 1e-3);
    series.expand(local.middles, 0.0, 1.0);
    let end = local.carry(Norm::new(0.0), &series, (h, series.at(h)), ball).unwrap();
    let (sine, _) = sin_cos(2.0 * h);
    let area = (0.5 * h + 0.25 * sine) * (1.0 + ball) * (1.0 + ball);
    let off = (end.square - area).abs();
    assert!(off <= end.square_error && off > 0.9 * end.square_error, "{off:e}");
}

/// `v = t - t^2` is furthest from its chord in the middle of a unit of time, and `v = 1 + t` from its start at
/// the end.
#[test]
fn velocities_within_a_step_are_held() {
    let bounds = |terms: [f64; 3], v1: f64, off: f64| {
        let mut series = MotionSeries::<f64>::EMPTY;
        series.v[..3].copy_from_slice(&terms);
        velocities(&Sums::of(&series, 1.0), terms[0], v1, off)
    };
    let arch = bounds([0.0, 1.0, -1.0], 0.0, 0.0);
    assert!(arch.contains(0.25) && arch.upper() < 0.25 + 1e-9, "{arch}");
    let rising = bounds([1.0, 1.0, 0.0], 2.0, 0.0);
    assert!(rising.contains(2.0) && rising.upper() < 2.0 + 1e-9, "{rising}");
    // The motion is within a distance of these.
    let around = bounds([1.0, 1.0, 0.0], 2.0, 0.1);
    assert!(around.contains(2.1) && around.contains(0.9) && around.upper() < 2.1 + 1e-9);
}

/// Motions with the coefficients at both ends of an interval are enclosed; where `v = 1` they separate by `h`
/// times its radius.
#[test]
fn a_step_holds_the_motions_of_all_coefficients() {
    let (h, spread) = (0.01, 0.1);
    for wide in 0..3 {
        let mut coefficients = [Interval::point(0.0); 3];
        coefficients[wide] = Interval::around(0.0, spread);
        let [a, b, c] = coefficients;
        let local = StepField::new(&FieldBox { a, b, c });
        let mut series = MotionSeries::<f64>::EMPTY;
        series.expand(local.middles, 0.0, 1.0);
        let end = local.carry(Norm::new(0.0), &series, (h, series.at(h)), 0.0).unwrap();
        // `v' = -c_k v^k` from v = 1, except for x, which contributes less than `h^3`.
        let velocity =
            [exp(-spread * h), 1.0 / (1.0 + spread * h), 1.0 / (1.0 + 2.0 * spread * h).sqrt()];
        let off = 1.0 - velocity[wide];
        assert!(
            end.radius >= off - h * h * h && end.radius < 1.04 * off,
            "{wide}: {:e} {off:e}",
            end.radius
        );
    }
}

/// The largest ratio of a vector's length in two norms occurs on a diagonal.
#[test]
fn a_change_of_norm_holds_every_direction() {
    for (from, to) in [(0.0, 1.0), (0.0, -1.5), (1.9, -1.9), (-0.5, 0.7), (1.0, 1.5)] {
        let lengths = (0..=180).map(|degrees| {
            let (y, x) = sin_cos(f64::from(degrees) * std::f64::consts::PI / 180.0);
            ((1.0 + to * x * y) / (1.0 + from * x * y)).sqrt()
        });
        let most = lengths.fold(0.0, f64::max);
        let bound = Norm::new(from).into(Norm::new(to));
        assert!(bound >= most && bound < most * (1.0 + 1e-9), "{from} {to}: {bound} {most}");
    }
}

/// A coefficient of `v^2` of degree k passes as many roundings as are counted, and never more than `k + 1`.
#[test]
fn coefficients_of_the_square_pass_the_roundings_counted() {
    let mut most: f64 = 0.0;
    for other in 2..ORDER - 2 {
        let mut sizes = vec![1e-30; ORDER + 1];
        (sizes[2], sizes[other]) = (1.0, 1.0);
        for planted in [Vec::new(), sizes] {
            PLANTED.set(planted);
            TAKEN.with_borrow_mut(Vec::clear);
            let mut series = MotionSeries::<CountedErrors>::EMPTY;
            series.expand([0.3, 0.2, 0.5].map(exact), exact(1.0), exact(0.5));
            let size = |k: usize| series.v[k].size;
            for (k, square) in series.square[..ORDER].iter().enumerate() {
                let terms = (0..=k).map(|i| size(i) * size(k - i)).sum::<f64>();
                let (count, degree) =
                    (square.roundings / terms, f64::from(u8::try_from(k).unwrap()));
                assert!(count <= SQUARE.min(degree + 1.0) * (1.0 + 1e-9), "{k}: {count}");
                most = most.max(count);
            }
        }
    }
    PLANTED.set(Vec::new());
    assert!(most > 0.5 * SQUARE, "half would do: {most}");
}

/// Terms that are each a little less than half of the last place of the running sum are all lost.
#[test]
fn the_roundings_of_an_area_are_held() {
    let (h, mut series) = (1.0, MotionSeries::<f64>::EMPTY);
    let little = 0.999 * UNIT;
    // Four lanes: their first terms sum to 1, and the losses come later, or where the lanes are combined.
    series.square[0] = 1.0;
    for k in 1..ORDER {
        let lane_of_the_first = k % LANES == 0;
        let size = if lane_of_the_first || k == 1 || k == 2 {
            little
        } else {
            0.0
        };
        series.square[k] = size * f64::from(u8::try_from(k + 1).unwrap());
    }
    let sums = Sums::of(&series, h);
    let exact = (0..ORDER).fold(Twofold::from(0.0), |sum, k| {
        let degree = f64::from(u8::try_from(k + 1).unwrap());
        sum + Twofold::from(series.square[k] / degree)
    });
    let off = (exact - Twofold::from(sums.integral)).high;
    let bound = sums.area_roundings() * h;
    assert!(off > 0.6 * bound && off <= bound, "{off:e} {bound:e}");
}

/// A ball measured in another norm keeps its members: tested on one along the shortest direction of the new norm.
#[test]
fn a_ball_in_another_norm_keeps_its_members() {
    let damped = StepField::new(&FieldBox {
        a: Interval::point(1.9),
        b: Interval::point(0.0),
        c: Interval::point(0.0),
    });
    let (before, radius) = (Norm::new(-1.9), 1e-3);
    let after = damped.norm(before, [1.0, 1.0], 0.6);
    let wider = radius * before.into(after) * INFLATE;
    assert!(after != before);
    // The diagonal `x = v`.
    let size = |norm: Norm| (2.0 + norm.skew).sqrt();
    assert!(wider >= radius * size(after) / size(before) && wider < 7.0 * radius, "{wider}");
}
