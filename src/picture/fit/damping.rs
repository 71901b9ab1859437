//! Damping over amplitude: measured decrements, the exact curve, the averaged one with its terms and its band.

use std::f64::consts::{PI, TAU};

use super::pieces::{Curve, at, curve, picture, with_unit};
use crate::fit::Fitted;
use crate::fit::decrements::averaged;
use crate::fit::motion::{Way, follow};
use crate::fit::observation::{D, D3, Data, OMEGA0, R, parameters};
use crate::oscillator::{Parameters, State};
use crate::picture::items::{Item, Line, Marks, Picture};
use crate::picture::role::{Dash, Mark, Role};
use crate::scene::{Point, Span, Window};

/// The relative loss of amplitude per unit of time between turning points two apart.
fn pair(q: &[f64]) -> Option<Point> {
    let half = |k: usize| 0.5 * (q[k + 1] - q[k]).abs();
    (q.len() == 4 && half(1) > 0.0).then(|| at(half(1), (half(0) - half(2)) / (TAU * half(1))))
}

/// The exact damping from motions that begin at rest at a displacement, as it is measured.
fn exact(parameters: &Parameters, from: f64) -> Option<Point> {
    let way = Way { linear: false, with_derivatives: false, reach: 1e3 * from, turns: 3 };
    let start = State { q: from, v: 0.0 };
    let found = follow(parameters, start, &[40.0], way, |_, _| {}).ok()?;
    let turns: Vec<f64> =
        std::iter::once(from).chain(found.turns.iter().map(|turn| turn.q)).collect();
    pair(&turns)
}

pub fn damping(fitted: &Fitted) -> Option<Picture<'static>> {
    const POINTS: u32 = 160;
    let estimate = &fitted.estimate;
    let p = &estimate.p;
    let (_, largest) = estimate.amplitudes();
    let to = 1.25 * largest;
    let amplitudes: Vec<f64> =
        (1..=POINTS).map(|i| to * f64::from(i) / f64::from(POINTS)).collect();
    let over = |value: &dyn Fn(f64) -> f64| amplitudes.iter().map(|&a| at(a, value(a))).collect();
    let x: Vec<f64> = estimate.extremes.iter().map(|extreme| extreme.x).collect();
    let measured: Vec<Point> = x.windows(4).filter_map(pair).collect();
    let exact: Vec<Point> = amplitudes.iter().filter_map(|&a| exact(&parameters(p), a)).collect();
    let mut curves = vec![
        curve("linear part D", Role::Asymptote, Dash::Dashed, over(&|_| p[D])),
        curve(
            "friction 2 r/(pi A)",
            Role::Sticking,
            Dash::Dashed,
            over(&|a| 2.0 * p[R] / (PI * a)),
        ),
        curve(
            "cubic part (3/8) D3 A^2",
            Role::Lyapunov,
            Dash::Dashed,
            over(&|a| 0.375 * p[D3] * a * a),
        ),
        curve("averaged", Role::Harmonic, Dash::Dashed, over(&|a| averaged(p[D], p[D3], p[R], a))),
        curve("exact", Role::Trajectory, Dash::Solid, exact.clone()),
    ];
    curves.extend(measured.iter().map(|point| bar(fitted, *point)));
    let heights = measured.iter().chain(&exact).map(|point| point.y).chain([0.0]);
    let span = Span::covering(heights.filter(|it| it.is_finite()))?;
    let window = Window { x: Span::new(0.0, to).ok()?, y: span.scaled(span.center(), 1.3) };
    let name = with_unit("amplitude A", fitted.unit());
    let names = (name, "loss of amplitude".to_owned());
    let mut picture = picture("damping over amplitude", names, curves, Some(window))?;
    let line = Line::new("90 % band of averaged", Role::Field, Dash::Solid);
    picture.items.push(Item::Shade(line, band(fitted, &amplitudes)));
    let zeros = exact.windows(2).filter(|two| two[0].y * two[1].y < 0.0);
    picture.items.extend(zeros.map(|two| Item::Marks(zero(two[0], two[1]))));
    let marks = Marks::new(Mark::Turn, Role::Ghost, measured);
    picture.items.push(Item::Marks(Marks { name: "measured".into(), ..marks }));
    Some(picture)
}

/// The error bar of a measured decrement: each half peak to peak has the error of two turning points, which are
/// read off about a twelfth of a period of samples.
fn bar(fitted: &Fitted, Point { x: a, y: delta }: Point) -> Curve {
    let estimate = &fitted.estimate;
    let read = match &estimate.data {
        #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
        Data::Samples { t, .. } => {
            let rate = t.len() as f64 / (t[t.len() - 1] - t[0]);
            (rate * TAU / estimate.p[OMEGA0] / 6.0).max(1.0)
        }
        Data::Peaks { .. } => 1.0,
    };
    let error = estimate.covariance.deviation / read.sqrt() / (TAU * a);
    curve("measured", Role::Ghost, Dash::Solid, vec![at(a, delta - error), at(a, delta + error)])
}

/// Where the damping is zero there is a cycle: stable where the damping grows through zero.
fn zero(from: Point, to: Point) -> Marks {
    let x = from.x + from.y / (from.y - to.y) * (to.x - from.x);
    let (mark, role, name) = if to.y > from.y {
        (Mark::Stable, Role::Stable, "stable cycle")
    } else {
        (Mark::Unstable, Role::Unstable, "unstable cycle")
    };
    Marks { name: name.into(), ..Marks::new(mark, role, vec![at(x, 0.0)]) }
}

/// The averaged damping of nine tenths of the draws.
fn band(fitted: &Fitted, amplitudes: &[f64]) -> Vec<Point> {
    let draws = &fitted.margins.draws;
    let quantile = |a: f64, part: f64| {
        let mut values: Vec<f64> =
            draws.iter().map(|draw| averaged(draw.d, draw.d3, draw.r, a)).collect();
        values.sort_by(f64::total_cmp);
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "an index"
        )]
        let index = (part * values.len() as f64) as usize;
        at(a, values[index.min(values.len() - 1)])
    };
    let below = amplitudes.iter().map(|&a| quantile(a, 0.05));
    let above = amplitudes.iter().rev().map(|&a| quantile(a, 0.95));
    let mut edge: Vec<Point> = below.chain(above).collect();
    edge.extend(edge.first().copied());
    edge
}
