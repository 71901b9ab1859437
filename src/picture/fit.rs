//! The pictures of a fit: record and residuals, damping over amplitude, phase plane, margin, D and r
//! together. Samples of a record that do not count are marked by what they are.

use std::f64::consts::PI;

use super::units::with_unit;
use super::{
    Dash, Item, LineStyle, Mark, Marks, Picture, Role, cycle_mark, cycle_name, cycle_role,
};
use crate::fit::{
    D, D3, DropReason, FitResult, Q0, R, RISES, Runs, Signal, memory as memory_of, parameters,
};
use crate::flow::Limits;
use crate::model::Parameters;
use crate::numerics::real;
use crate::portrait::Portrait;
use crate::scene::{Point, Span, Window};

/// Draws whose edge of the basin is drawn.
const EDGES: usize = 20;

/// All pictures of a fit; peaks alone have no record to be drawn.
pub fn pictures(fitted: &FitResult) -> Vec<Picture<'static>> {
    let all =
        [record, residuals, memory, damping, phase, margin, together].map(|draw| draw(fitted));
    all.into_iter().flatten().collect()
}

fn record(fitted: &FitResult) -> Option<Picture<'static>> {
    let name = ["x", "x'", "x''"][fitted.record.signal.order()];
    let name = with_unit(name, &fitted.record.signal_unit());
    let mut picture = Picture::new("record and fit", "t [s]", name, Window::default());
    picture.curve("record", fitted.line(|it| [it.t, it.x]));
    picture.curve("fitted motion", fitted.curves.motion.iter().map(|[t, .., x]| [*t, *x]));
    picture.window = around(&picture)?;
    // What lies before and after the motion is seen, too.
    if let Some(times) = Span::covering(fitted.points.iter().map(|it| it.t)) {
        picture.window.x = times.scaled(times.center(), 1.06);
    }
    let apart = fitted.points.iter().filter_map(|it| Some(([it.t, it.x].into(), it.dropped?)));
    mark_dropped(&mut picture, apart);
    Some(picture)
}

pub fn residuals(fitted: &FitResult) -> Option<Picture<'static>> {
    let name = with_unit("measured - fitted", &fitted.record.signal_unit());
    let mut picture = Picture::new("residuals", "t [s]", name, Window::default());
    let line = fitted.line(|it| [it.t, it.residual]);
    let ends = [line.first()?[0], line.last()?[0]];
    picture.curve("residuals", line);
    band(&mut picture, ends, 2.0 * fitted.estimate.covariance.deviation);
    picture.window = around(&picture)?;
    let apart = fitted.points.iter().filter_map(|it| {
        let why = it.dropped.filter(|why| matches!(why, DropReason::Outlier | DropReason::Jump))?;
        Some(([it.t, it.residual].into(), why))
    });
    mark_dropped(&mut picture, apart);
    Some(picture)
}

/// Both ends of what is to be expected by chance.
fn band(picture: &mut Picture, along: [f64; 2], height: f64) {
    for height in [height, -height] {
        picture.curve("+-2 standard deviations", along.map(|x| [x, height]));
    }
}

/// The autocorrelation of the residuals over two periods.
fn memory(fitted: &FitResult) -> Option<Picture<'static>> {
    let memory = memory_of(&fitted.estimate);
    let [periods, _] = *memory.last()?;
    let window = Window::of([0.0, periods, -1.0, 1.0])?;
    let mut picture = Picture::new("memory of the residuals", "lag [s]", "correlation", window);
    picture.curve("autocorrelation of the residuals", memory);
    let chance = 2.0 / (real(fitted.estimate.kept_residuals().count())).sqrt();
    band(&mut picture, [0.0, periods], chance);
    Some(picture)
}

/// Damping over amplitude: measured decrements, the exact curve, the averaged one with its terms and its band.
pub fn damping(fitted: &FitResult) -> Option<Picture<'static>> {
    let p = &fitted.estimate.p;
    let found = &fitted.curves.damping;
    let amplitude = with_unit("amplitude A", fitted.unit());
    let extent = Window::of(found.extent)?;
    let mut picture =
        Picture::new("damping over amplitude", amplitude, "loss of amplitude", extent);
    let parts = ["linear part D", "friction 2 r/(pi A)", "cubic part (3/8) D3 A^2"];
    let values = |a: f64| [p[D], 2.0 * p[R] / (PI * a), 0.375 * p[D3] * a * a];
    for (part, line) in parts.into_iter().enumerate() {
        picture.curve(line, found.averaged.iter().map(|[a, _]| [*a, values(*a)[part]]));
    }
    picture.curve("averaged", found.averaged.iter().copied());
    picture.curve("exact", found.exact.iter().copied());
    let measured: Vec<Point> = found.measured.iter().map(|&[x, y, _]| Point { x, y }).collect();
    let beyond = measured.iter().filter(|at| !extent.contains(**at)).count();
    let name = match beyond {
        0 => "measured".to_owned(),
        _ => format!("measured, {beyond} beyond the plot"),
    };
    for &[x, y, error] in &found.measured {
        let line = LineStyle::new(name.clone(), Role::Ghost, Dash::Solid);
        picture.curve(line, [y - error, y + error].map(|y| [x, y]));
    }
    picture.items.push(Item::Shade("90 % band of averaged".into(), Point::all(&found.band)));
    let exact = Point::all(&found.exact);
    let zeros = exact.windows(2).filter(|two| two[0].y * two[1].y < 0.0);
    zeros.for_each(|two| picture.marks(zero(two[0], two[1])));
    let marks = Marks::new(Mark::Turn, Role::Ghost, measured).called("measured");
    picture.marks(Marks { at_edge: true, ..marks });
    Some(picture)
}

/// Where the damping is zero there is a cycle: stable where the damping grows through zero.
fn zero(from: Point, to: Point) -> Marks {
    let x = from.x + from.y / (from.y - to.y) * (to.x - from.x);
    let stable = to.y > from.y;
    let brief = cycle_name(stable);
    let marks = Marks::new(cycle_mark(stable), cycle_role(stable), [[x, 0.0]]);
    Marks { brief, ..marks.called(brief) }
}

fn phase(fitted: &FitResult) -> Option<Picture<'static>> {
    let estimate = &fitted.estimate;
    let p = &estimate.p;
    let (_, largest) = estimate.amplitudes();
    let reach = 1.3 * largest.max(p[Q0].abs());
    let span = Span::new(-reach, reach).ok()?;
    let [q, v] = ["x - offset", "velocity/omega0"].map(|name| with_unit(name, fitted.unit()));
    let mut picture = Picture::new("phase plane", q, v, Window { x: span, y: span });
    let every = (fitted.margins.draws.len() / EDGES).max(1);
    for draw in fitted.margins.draws.iter().step_by(every) {
        border(&mut picture, draw, largest, "borders of twenty drawn basins".into());
    }
    let line = LineStyle { dash: Dash::Solid, ..LineStyle::from("border of the basin") };
    border(&mut picture, &parameters(p), largest, line);
    if !estimate.data.has_peaks() {
        let name = match estimate.data.signal {
            Signal::Displacement => Some("record (velocity by the fit)"),
            Signal::Velocity => Some("record (displacement by the fit)"),
            Signal::Acceleration => None,
        };
        if let Some(name) = name {
            picture.curve(name, fitted.line(|it| [it.q, it.v]));
        }
        let motion = fitted.curves.motion.iter();
        picture.curve("fitted motion", motion.map(|[_, q, v, _]| [*q, *v]));
    }
    picture.curve("sticking set", [[-p[R], 0.0], [p[R], 0.0]]);
    Some(picture)
}

/// Adds the first border of the basin of these parameters, thinned, if there is one.
fn border(picture: &mut Picture, parameters: &Parameters, largest: f64, line: LineStyle) {
    const COUNT: u16 = 24;
    let found = Portrait::of_oscillator(parameters, 2.0 * largest, &Limits::PATIENT).ok();
    if let Some(border) = found.as_ref().and_then(Portrait::edge) {
        picture.curve(line, border.curve(COUNT));
    }
}

/// D and r together: where both lie with 68 and 95 %.
fn together(fitted: &FitResult) -> Option<Picture<'static>> {
    const LINES: [&str; 2] = ["delta chi^2 = 2.3 (68 %)", "delta chi^2 = 6 (95 %)"];
    let estimate = &fitted.estimate;
    let p = &estimate.p;
    if !(estimate.free[D] && estimate.free[R]) {
        return None;
    }
    let r = with_unit("r", fitted.unit());
    let mut picture = Picture::new("D and r together", "D", r, Window::default());
    for (rise, name) in RISES.into_iter().zip(LINES) {
        let contour = estimate.contour([D, R], rise, &Runs::new(&|| false));
        if let Some(contour) = contour.filter(|it| !it.is_empty()) {
            picture.curve(name, contour);
        }
    }
    picture.window = around(&picture)?;
    picture.marks(Marks::new(Mark::Stable, Role::Special, [[p[D], p[R]]]).called("estimate"));
    Some(picture)
}

/// The cumulative distribution of the margin from rest; what is missing to 1 is the share in which every kick is survived.
pub fn margin(fitted: &FitResult) -> Option<Picture<'static>> {
    let (_, largest) = fitted.estimate.amplitudes();
    // A shift from rest leads this far out if it begins at the end of the sticking set.
    let largest = largest - fitted.estimate.p[R];
    let name = with_unit("smallest shift from rest not survived", fitted.unit());
    let extent = Window::of(fitted.curves.spread_extent)?;
    let title = "margin from rest, distribution";
    let mut picture = Picture::new(title, name, "probability", extent);
    picture.curve("margin is less than this", fitted.curves.spread.iter().copied());
    picture.curve("largest amplitude less r", [[largest, 0.0], [largest, 1.0]]);
    Some(picture)
}

/// How samples that do not count are marked, and what legends call them.
const MARKS: [(DropReason, Mark, Role, &str); 6] = [
    (DropReason::Before, Mark::Aside, Role::Bands, "before the stroke, left out"),
    (DropReason::After, Mark::Aside, Role::Bands, "after a second stroke, left out"),
    (DropReason::Jump, Mark::Aside, Role::Bands, "at jumps, left out"),
    (DropReason::Alike, Mark::Aside, Role::Harmonic, "alike at rest, left out"),
    (DropReason::Saturated, Mark::Saturated, Role::Danger, "saturated, left out"),
    (DropReason::Outlier, Mark::Outlier, Role::Danger, "outliers, left out"),
];

/// Marks of one kind that a picture shows at most.
const MOST: usize = 500;

/// Marks the samples that do not count. What lies above or below the window is shown at its edge.
pub fn mark_dropped(picture: &mut Picture, samples: impl Iterator<Item = (Point, DropReason)>) {
    let samples: Vec<(Point, DropReason)> = samples.collect();
    for (which, mark, role, brief) in MARKS {
        let of_kind = samples.iter().filter(|(_, why)| *why == which).map(|(at, _)| *at);
        let all: Vec<Point> = of_kind.collect();
        let step = all.len().div_ceil(MOST).max(1);
        let marks = Marks::new(mark, role, all.into_iter().step_by(step)).called(brief);
        picture.marks(Marks { brief, at_edge: true, ..marks });
    }
}

/// A window that holds all curves with some room; `None` if they have no extent.
fn around(picture: &Picture) -> Option<Window> {
    let curves = picture.items.iter().filter_map(|item| match item {
        Item::Curve(_, points) => Some(points),
        _ => None,
    });
    Window::around(&curves.flatten().copied().collect::<Vec<_>>(), 1.06)
}
