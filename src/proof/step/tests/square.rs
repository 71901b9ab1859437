//! The roundings of `v^2` and of its integral, and a ball under a change of norm.

use super::*;

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
            let mut series = Series::<Counted>::EMPTY;
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
    let (h, mut series) = (1.0, Series::<f64>::EMPTY);
    let little = 0.999 * UNIT;
    // Four lanes: their first terms sum to 1, and the losses come later, or where the lanes are combined.
    series.square[0] = 1.0;
    for k in 1..ORDER {
        let lane_of_the_first = k % LANES == 0;
        let size = if lane_of_the_first || k == 1 || k == 2 { little } else { 0.0 };
        series.square[k] = size * f64::from(u8::try_from(k + 1).unwrap());
    }
    let sums = Sums::of(&series, h);
    let exact = (0..ORDER).fold(Twofold::of(0.0), |sum, k| {
        let degree = f64::from(u8::try_from(k + 1).unwrap());
        sum.plus(Twofold::of(series.square[k] / degree))
    });
    let off = exact.plus(Twofold::of(-sums.integral)).high;
    let bound = sums.area_roundings() * h;
    assert!(off > 0.6 * bound && off <= bound, "{off:e} {bound:e}");
}

/// A ball measured in another norm keeps its members: tested on one along the shortest direction of the new norm.
#[test]
fn a_ball_in_another_norm_keeps_its_members() {
    let damped = StepField::new(&Field {
        a: Interval::point(1.9),
        b: Interval::point(0.0),
        c: Interval::point(0.0),
    });
    let (before, radius) = (Norm::new(-1.9), 1e-3);
    let (after, wider) = damped.ball((before, radius), [1.0, 1.0], 0.6);
    assert!(after != before);
    // The diagonal `x = v`.
    let size = |norm: Norm| (2.0 + norm.skew).sqrt();
    assert!(wider >= radius * size(after) / size(before) && wider < 7.0 * radius, "{wider}");
}
