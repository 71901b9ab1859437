//! The pictures of a fit: record and residuals, damping over amplitude, phase plane, margin.

use std::f64::consts::TAU;

use super::Fitted;
use super::damping::damping;
use super::pieces::{curve, panel, with_unit};
use crate::export::figure::{Curve, Figure, Panel};
use crate::fit::motion::{Way, follow};
use crate::fit::observation::{Data, LAST, OFFSET, OMEGA0, Q0, R, Start, parameters};
use crate::fit::residuals::autocorrelations;
use crate::flow::Limits;
use crate::oscillator::{Parameters, State};
use crate::scene::{Span, Window};
use crate::study::basin::{Basin, basin};
use crate::study::cycle::Edge;
use crate::view::look::Role;

/// Most points of a record that are drawn; of longer ones every second, third, .. is.
const POINTS: usize = 4000;

/// Draws whose edge of the basin is drawn.
const EDGES: usize = 20;

/// The figure of a fit.
#[must_use]
pub fn figure(fitted: &Fitted) -> Figure {
    let estimate = &fitted.estimate;
    let p = &estimate.p;
    let velocity = if estimate.start == Start::Moving { p[LAST] } else { 0.0 };
    let mut panels = Vec::new();
    if let Data::Samples { t, x } = &estimate.data {
        let seen = Sampled::of(fitted, t, x);
        panels.extend([record(fitted, &seen), residuals(fitted, &seen), memory(fitted)]);
        panels.extend([damping(fitted), phase(fitted, Some(&seen)), margin(fitted)]);
    } else {
        panels.extend([damping(fitted), phase(fitted, None), margin(fitted)]);
    }
    Figure {
        figure: "fit".into(),
        title: format!("{}: fitted motion", fitted.name),
        program: format!("hopfscope {}", env!("CARGO_PKG_VERSION")),
        units: "lengths in the unit of the record, times in s, velocities and impulses over omega0",
        parameters: parameters(p),
        initial: State { q: p[Q0], v: velocity },
        until: duration(fitted),
        method: "half swings with exact derivatives".into(),
        tolerance: 1e-13,
        panels: panels.into_iter().flatten().collect(),
    }
}

/// The dimensionless duration of the record.
fn duration(fitted: &Fitted) -> f64 {
    let t = match &fitted.estimate.data {
        Data::Samples { t, .. } => Some(t),
        Data::Peaks { t, .. } => t.as_ref(),
    };
    let span = t.and_then(|t| Some(t.last()? - t.first()?));
    fitted.estimate.p[OMEGA0] * span.unwrap_or(0.0)
}

/// What is drawn of a sampled record.
struct Sampled {
    t: Vec<f64>,
    x: Vec<f64>,
    residual: Vec<f64>,
    /// The fitted motion: time, displacement from the offset, velocity over omega0.
    motion: Vec<[f64; 3]>,
}

impl Sampled {
    fn of(fitted: &Fitted, t: &[f64], x: &[f64]) -> Self {
        /// A step of so many usual ones is a gap.
        const GAP: f64 = 6.0;
        let every = t.len().div_ceil(POINTS);
        let mut seen = Sampled {
            t: Vec::new(),
            x: Vec::new(),
            residual: Vec::new(),
            motion: motion(fitted, t),
        };
        #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
        let step = (t[t.len() - 1] - t[0]) * every as f64 / t.len() as f64;
        for index in (0..t.len()).step_by(every) {
            if seen.t.last().is_some_and(|last| t[index] - last > GAP * step) {
                seen.push([f64::NAN; 3]);
            }
            seen.push([t[index], x[index], fitted.estimate.residuals[index]]);
        }
        seen
    }

    fn push(&mut self, [t, x, residual]: [f64; 3]) {
        self.t.push(t);
        self.x.push(x);
        self.residual.push(residual);
    }
}

/// The fitted motion, finely.
fn motion(fitted: &Fitted, t: &[f64]) -> Vec<[f64; 3]> {
    /// Points on each half swing.
    const FINE: usize = 40;
    let estimate = &fitted.estimate;
    let p = &estimate.p;
    let (first, last) = (t[0], t[t.len() - 1]);
    let (origin, velocity) = match estimate.start {
        Start::Release => (p[LAST], 0.0),
        Start::Moving => (first, p[LAST]),
    };
    let count = (FINE * (estimate.half_swings + 2)).min(4 * POINTS);
    #[expect(clippy::cast_precision_loss, reason = "counts of points")]
    let at = |index: usize| origin + (last - origin) * index as f64 / count as f64;
    let taus: Vec<f64> = (0..=count).map(|index| p[OMEGA0] * (at(index) - origin)).collect();
    let mut points = Vec::new();
    if first < origin {
        points.push([first, p[Q0], 0.0]);
    }
    let way = Way { linear: false, with_derivatives: false, reach: f64::MAX, turns: usize::MAX };
    let start = State { q: p[Q0], v: velocity };
    // The motion was followed through the record before, so it is not lost now.
    let _ = follow(&parameters(p), start, &taus, way, |index, point| {
        points.push([at(index), point.q, point.v]);
    });
    points
}

fn record(fitted: &Fitted, seen: &Sampled) -> Option<Panel> {
    let offset = fitted.estimate.p[OFFSET];
    let measured = seen.t.iter().zip(&seen.x).map(|(t, x)| [*t, *x]).collect();
    let fit = seen.motion.iter().map(|[t, q, _]| [*t, q + offset]).collect();
    let curves = vec![
        curve("record", Role::Ghost, "solid", measured),
        curve("fitted motion", Role::Trajectory, "solid", fit),
    ];
    panel("record and fit", ("t [s]", &with_unit("x", fitted.unit())), curves, None)
}

fn residuals(fitted: &Fitted, seen: &Sampled) -> Option<Panel> {
    let deviation = fitted.estimate.covariance.deviation;
    let points = seen.t.iter().zip(&seen.residual).map(|(t, e)| [*t, *e]).collect();
    let (first, last) = (*seen.t.first()?, *seen.t.last()?);
    let level = |height: f64| vec![[first, height], [last, height]];
    let curves = vec![
        curve("residuals", Role::Ghost, "solid", points),
        curve("+-2 standard deviations", Role::Current, "dashed", level(2.0 * deviation)),
        curve("+-2 standard deviations", Role::Current, "dashed", level(-2.0 * deviation)),
    ];
    panel("residuals", ("t [s]", &with_unit("measured - fitted", fitted.unit())), curves, None)
}

/// The autocorrelation of the residuals over two periods.
fn memory(fitted: &Fitted) -> Option<Panel> {
    /// Most lags.
    const LAGS: usize = 400;
    let estimate = &fitted.estimate;
    let Data::Samples { t, .. } = &estimate.data else { return None };
    let span = t[t.len() - 1] - t[0];
    #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
    let step = span / t.len() as f64;
    let kept: Vec<f64> = estimate
        .residuals
        .iter()
        .zip(&estimate.used)
        .filter(|(_, used)| **used)
        .map(|(residual, _)| *residual)
        .collect();
    let periods = 2.0 * TAU / estimate.p[OMEGA0];
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "capped by n")]
    let most = ((periods / step) as usize).clamp(4, (kept.len() / 2).max(4));
    let lags: Vec<usize> = (1..most).step_by(most.div_ceil(LAGS)).collect();
    let values = autocorrelations(&kept, &lags);
    #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
    let points = lags.iter().zip(values).map(|(lag, rho)| [*lag as f64 * step, rho]).collect();
    #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
    let chance = 2.0 / (kept.len() as f64).sqrt();
    let level = |height: f64| vec![[0.0, height], [periods, height]];
    let curves = vec![
        curve("autocorrelation of the residuals", Role::Energy, "solid", points),
        curve("+-2 standard deviations", Role::Current, "dashed", level(chance)),
        curve("+-2 standard deviations", Role::Current, "dashed", level(-chance)),
    ];
    let window = Window { x: Span::new(0.0, periods).ok()?, y: Span::new(-1.0, 1.0).ok()? };
    panel("memory of the residuals", ("lag [s]", "correlation"), curves, Some(window))
}

/// The first border of a basin, thinned, as a curve.
fn border(found: &Basin, name: &str, pen: Role, style: &'static str) -> Option<Curve> {
    const COUNT: u16 = 24;
    if found.edge == Edge::None {
        return None;
    }
    let points = found.borders.first()?.curve(COUNT);
    Some(curve(name, pen, style, points.iter().map(|point| [point.q, point.v]).collect()))
}

fn phase(fitted: &Fitted, seen: Option<&Sampled>) -> Option<Panel> {
    let estimate = &fitted.estimate;
    let p = &estimate.p;
    let (_, largest) = estimate.amplitudes();
    let edge_of = |parameters: &Parameters| basin(parameters, 2.0 * largest, &Limits::PATIENT).ok();
    let every = (fitted.margins.draws.len() / EDGES).max(1);
    let drawn = fitted.margins.draws.iter().step_by(every);
    let mut curves: Vec<Curve> = drawn
        .filter_map(|draw| {
            border(&edge_of(draw)?, "edges of twenty drawn basins", Role::Ghost, "dotted")
        })
        .collect();
    let own = edge_of(&parameters(p));
    curves.extend(own.and_then(|own| border(&own, "edge of the basin", Role::Unstable, "solid")));
    if let Some(seen) = seen {
        let mut motion = seen.motion.iter().peekable();
        let mut data = Vec::new();
        for (t, x) in seen.t.iter().zip(&seen.x) {
            while motion.next_if(|point| point[0] < *t).is_some() {}
            if let Some([_, _, v]) = motion.peek() {
                data.push([x - p[OFFSET], *v]);
            }
        }
        let fit = seen.motion.iter().map(|[_, q, v]| [*q, *v]).collect();
        curves.push(curve("record (velocity by the fit)", Role::Field, "dotted", data));
        curves.push(curve("fitted motion", Role::Trajectory, "solid", fit));
    }
    curves.push(curve("sticking set", Role::Sticking, "thick", vec![[-p[R], 0.0], [p[R], 0.0]]));
    let reach = 1.3 * largest.max(p[Q0].abs());
    let span = Span::new(-reach, reach).ok()?;
    let q = with_unit("x - offset", fitted.unit());
    let v = with_unit("velocity/omega0", fitted.unit());
    panel("phase plane", (&q, &v), curves, Some(Window { x: span, y: span }))
}

/// The cumulative distribution of the margin; what is missing to 1 is the share in which every kick is survived.
fn margin(fitted: &Fitted) -> Option<Panel> {
    /// Largest amplitudes up to which margins are shown.
    const FAR: f64 = 10.0;
    let margins = &fitted.margins;
    let (_, largest) = fitted.estimate.amplitudes();
    let finite: Vec<f64> =
        margins.displacements.iter().copied().filter(|it| it.is_finite()).collect();
    #[expect(clippy::cast_precision_loss, reason = "counts of draws")]
    let share = |count: usize| count as f64 / margins.displacements.len() as f64;
    let mut steps = vec![[0.0, 0.0]];
    for (index, &at) in finite.iter().enumerate() {
        steps.extend([[at, share(index)], [at, share(index + 1)]]);
    }
    // The tail of margins far beyond the record says no more than that they are.
    let typical = margins.displacement.upper.or(margins.displacement.median);
    let far = typical.or(finite.last().copied()).unwrap_or(largest).min(FAR * largest);
    let to = far.max(largest) + 0.1 * (far.max(largest) - far.min(largest)).max(0.02 * largest);
    steps.push([to.max(finite.last().copied().unwrap_or(0.0)), share(finite.len())]);
    let curves = vec![
        curve("margin is less than this", Role::Unstable, "solid", steps),
        curve(
            "largest amplitude measured",
            Role::Current,
            "dashed",
            vec![[largest, 0.0], [largest, 1.0]],
        ),
    ];
    // A narrow distribution is looked at closely.
    let near = margins.displacement.lower.unwrap_or(0.0).min(largest);
    let from = if near > 0.7 * to { near - 0.3 * (to - near) } else { 0.0 };
    let window = Window { x: Span::new(from, to).ok()?, y: Span::new(0.0, 1.0).ok()? };
    let name = with_unit("smallest displacement not survived", fitted.unit());
    panel("distribution of the margin", (&name, "probability"), curves, Some(window))
}
