//! Damping over amplitude: measured decrements, the exact curve, the averaged one with its terms and its band.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use super::Fitted;
use super::pieces::{curve, mark, panel, with_unit};
use crate::export::figure::{Area, Curve, Mark, Panel};
use crate::fit::decrements::averaged;
use crate::fit::motion::{Way, follow};
use crate::fit::observation::{D, D3, Data, OMEGA0, R, parameters};
use crate::oscillator::{Parameters, State};
use crate::scene::{Span, Window};
use crate::view::look::Role;
use crate::view::picture;

/// The relative loss of amplitude per unit of time between turning points two apart.
fn pair(q: &[f64]) -> Option<[f64; 2]> {
    let half = |k: usize| 0.5 * (q[k + 1] - q[k]).abs();
    (q.len() == 4 && half(1) > 0.0).then(|| [half(1), (half(0) - half(2)) / (TAU * half(1))])
}

/// The exact damping from motions that begin at rest at a displacement, as it is measured.
fn exact(parameters: &Parameters, from: f64) -> Option<[f64; 2]> {
    let way = Way { linear: false, with_derivatives: false, reach: 1e3 * from, turns: 3 };
    let start = State { q: from, v: 0.0 };
    let found = follow(parameters, start, &[40.0], way, |_, _| {}).ok()?;
    let turns: Vec<f64> =
        std::iter::once(from).chain(found.turns.iter().map(|turn| turn.q)).collect();
    pair(&turns)
}

/// The panel.
pub fn damping(fitted: &Fitted) -> Option<Panel> {
    const POINTS: u32 = 160;
    let estimate = &fitted.estimate;
    let p = &estimate.p;
    let (_, largest) = estimate.amplitudes();
    let to = 1.25 * largest;
    let amplitudes: Vec<f64> =
        (1..=POINTS).map(|i| to * f64::from(i) / f64::from(POINTS)).collect();
    let over = |value: &dyn Fn(f64) -> f64| amplitudes.iter().map(|&a| [a, value(a)]).collect();
    let x: Vec<f64> = estimate.extremes.iter().map(|extreme| extreme.x).collect();
    let measured: Vec<[f64; 2]> = x.windows(4).filter_map(pair).collect();
    let exact: Vec<[f64; 2]> =
        amplitudes.iter().filter_map(|&a| exact(&parameters(p), a)).collect();
    let mut curves = vec![
        curve("linear part D", Role::Asymptote, "dashed", over(&|_| p[D])),
        curve("friction 2 r/(pi A)", Role::Sticking, "dashed", over(&|a| 2.0 * p[R] / (PI * a))),
        curve(
            "cubic part (3/8) D3 A^2",
            Role::Lyapunov,
            "dashed",
            over(&|a| 0.375 * p[D3] * a * a),
        ),
        curve("averaged", Role::Harmonic, "dashed", over(&|a| averaged(p[D], p[D3], p[R], a))),
        curve("exact", Role::Trajectory, "solid", exact.clone()),
    ];
    curves.extend(measured.iter().map(|point| bar(fitted, *point)));
    let heights = measured.iter().chain(&exact).map(|point| point[1]).chain([0.0]);
    let span = Span::covering(heights.filter(|it| it.is_finite()))?;
    let window = Window { x: Span::new(0.0, to).ok()?, y: span.scaled(span.center(), 1.3) };
    let name = with_unit("amplitude A", fitted.unit());
    let mut panel =
        panel("damping over amplitude", (&name, "loss of amplitude"), curves, Some(window))?;
    panel.areas = vec![band(fitted, &amplitudes)];
    let zeros = exact.windows(2).filter(|two| two[0][1] * two[1][1] < 0.0);
    panel.marks = zeros.map(|two| zero(two[0], two[1])).collect();
    panel.marks.extend(
        measured.iter().map(|&point| mark("measured", point, picture::Mark::Turn, Role::Ghost)),
    );
    Some(panel)
}

/// The error bar of a measured decrement: each half peak to peak has the error of two turning points, which are
/// read off about a twelfth of a period of samples.
fn bar(fitted: &Fitted, [a, delta]: [f64; 2]) -> Curve {
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
    curve("measured", Role::Ghost, "solid", vec![[a, delta - error], [a, delta + error]])
}

/// Where the damping is zero there is a cycle: stable where the damping grows through zero.
fn zero(from: [f64; 2], to: [f64; 2]) -> Mark {
    let part = from[1] / (from[1] - to[1]);
    let at = [from[0] + part * (to[0] - from[0]), 0.0];
    if to[1] > from[1] {
        mark("stable cycle", at, picture::Mark::Stable, Role::Stable)
    } else {
        mark("unstable cycle", at, picture::Mark::Unstable, Role::Unstable)
    }
}

/// The averaged damping of nine tenths of the draws.
fn band(fitted: &Fitted, amplitudes: &[f64]) -> Area {
    let draws = &fitted.margins.draws;
    let at = |a: f64, part: f64| {
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
        [a, values[index.min(values.len() - 1)]]
    };
    let below = amplitudes.iter().map(|&a| at(a, 0.05));
    let above = amplitudes.iter().rev().map(|&a| at(a, 0.95));
    let mut edge: Vec<[f64; 2]> = below.chain(above).collect();
    edge.extend(edge.first().copied());
    Area {
        name: "90 % band of averaged".into(),
        role: Role::Field.name(),
        parameters: BTreeMap::new(),
        edge,
        pen: Role::Field,
    }
}
