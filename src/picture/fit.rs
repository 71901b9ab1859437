//! The pictures of a fit: record and residuals, damping over amplitude, phase plane, margin, D and r
//! together. Samples of a record that do not count are marked by what they are.

use std::f64::consts::PI;

use super::{CycleStyle, Dash, Item, LineStyle, Mark, Marks, Picture, Role, cycle_style};
use crate::fit::{
    D, D3, Dropped, Extent, Fitted, PlotPoint, Q0, R, Signal, memory as memory_of, parameters,
};
use crate::flow::Limits;
use crate::model::{Parameters, State};
use crate::numerics::count::real;
use crate::portrait::Border;
use crate::portrait::basin::{Basin, basin};
use crate::scene::{Point, Span, Window};

/// Draws whose edge of the basin is drawn.
const EDGES: usize = 20;

/// All pictures of a fit; peaks alone have no record to be drawn.
pub fn pictures(fitted: &Fitted) -> Vec<Picture<'static>> {
    let all =
        [record, residuals, memory, damping, phase, margin, together].map(|draw| draw(fitted));
    all.into_iter().flatten().collect()
}

fn record(fitted: &Fitted) -> Option<Picture<'static>> {
    let seen = fitted.curves.sampled.as_ref()?;
    let measured = seen.points.iter().map(|[t, x, _]| at(*t, *x)).collect();
    let fit = seen.motion.iter().map(|[t, .., x]| at(*t, *x)).collect();
    let curves = vec![
        curve("record", Role::Ghost, Dash::Solid, measured),
        curve("fitted motion", Role::Trajectory, Dash::Solid, fit),
    ];
    let name = ["x", "x'", "x''"][fitted.record.signal.order()];
    let names = ("t [s]".to_owned(), with_unit(name, &fitted.signal_unit()));
    let mut picture = picture("record and fit", names, curves, None)?;
    let record = &fitted.record;
    // What lies before and after the motion is seen, too.
    if let Some(times) = Span::covering(record.t.iter().flatten().copied()) {
        picture.window.x = times.scaled(times.center(), 1.06);
    }
    let all = record.t.iter().flatten().zip(&record.x).zip(&fitted.estimate.dropped);
    mark_dropped(&mut picture, all.filter_map(|((t, x), why)| Some((at(*t, *x), (*why)?))));
    Some(picture)
}

pub fn residuals(fitted: &Fitted) -> Option<Picture<'static>> {
    let seen = fitted.curves.sampled.as_ref()?;
    let deviation = fitted.estimate.covariance.deviation;
    let points = seen.points.iter().map(|[t, _, e]| at(*t, *e)).collect();
    let mut curves = vec![curve("residuals", Role::Ghost, Dash::Solid, points)];
    curves.extend(band([seen.points.first()?[0], seen.points.last()?[0]], 2.0 * deviation));
    let names = ("t [s]".to_owned(), with_unit("measured - fitted", &fitted.signal_unit()));
    let mut picture = picture("residuals", names, curves, None)?;
    let all = fitted.estimate.data.t.iter().zip(&fitted.estimate.residuals);
    let apart = all.zip(fitted.estimate.dropped_data()).filter_map(|((t, e), why)| {
        let why = why.filter(|it| matches!(it, Dropped::Outlier | Dropped::Jump))?;
        Some((at(*t, *e), why))
    });
    mark_dropped(&mut picture, apart);
    Some(picture)
}

/// Both ends of what is to be expected by chance.
fn band(along: [f64; 2], height: f64) -> [StyledPoints; 2] {
    [height, -height].map(|height| {
        let level = along.map(|x| at(x, height)).to_vec();
        curve("+-2 standard deviations", Role::Current, Dash::Dashed, level)
    })
}

/// The autocorrelation of the residuals over two periods.
fn memory(fitted: &Fitted) -> Option<Picture<'static>> {
    let memory = memory_of(&fitted.estimate);
    let [periods, _] = *memory.last()?;
    let chance = 2.0 / (real(fitted.estimate.kept_residuals().count())).sqrt();
    let name = "autocorrelation of the residuals";
    let mut curves = vec![curve(name, Role::Energy, Dash::Solid, points(&memory))];
    curves.extend(band([0.0, periods], chance));
    let names = ("lag [s]".to_owned(), "correlation".to_owned());
    picture("memory of the residuals", names, curves, window([0.0, periods, -1.0, 1.0]))
}

/// Damping over amplitude: measured decrements, the exact curve, the averaged one with its terms and its band.
pub fn damping(fitted: &Fitted) -> Option<Picture<'static>> {
    let p = &fitted.estimate.p;
    let found = &fitted.curves.damping;
    let over = |value: &dyn Fn(f64) -> f64| {
        found.averaged.iter().map(|&[x, _]| Point { x, y: value(x) }).collect()
    };
    let friction = |a: f64| 2.0 * p[R] / (PI * a);
    let mut curves = vec![
        curve("linear part D", Role::Asymptote, Dash::Sparse, over(&|_| p[D])),
        curve("friction 2 r/(pi A)", Role::Sticking, Dash::Dotted, over(&friction)),
        curve(
            "cubic part (3/8) D3 A^2",
            Role::Lyapunov,
            Dash::DashDot,
            over(&|a| 0.375 * p[D3] * a * a),
        ),
        curve("averaged", Role::Harmonic, Dash::Dashed, points(&found.averaged)),
        curve("exact", Role::Trajectory, Dash::Thick, points(&found.exact)),
    ];
    let extent = window(found.extent)?;
    let measured: Vec<Point> = found.measured.iter().map(|&[x, y, _]| Point { x, y }).collect();
    let beyond = measured.iter().filter(|at| !extent.contains(**at)).count();
    let name = match beyond {
        0 => "measured".to_owned(),
        _ => format!("measured, {beyond} beyond the plot"),
    };
    curves.extend(found.measured.iter().map(|&[x, y, error]| {
        let bar = [y - error, y + error].map(|y| Point { x, y });
        (LineStyle::new(name.clone(), Role::Ghost, Dash::Solid), bar.to_vec())
    }));
    let amplitude = with_unit("amplitude A", fitted.unit());
    let names = (amplitude, "loss of amplitude".to_owned());
    let mut picture = picture("damping over amplitude", names, curves, Some(extent))?;
    let line = LineStyle::new("90 % band of averaged", Role::Field, Dash::Solid);
    picture.items.push(Item::Shade(line, points(&found.band)));
    let exact = points(&found.exact);
    let zeros = exact.windows(2).filter(|two| two[0].y * two[1].y < 0.0);
    picture.items.extend(zeros.map(|two| Item::Marks(zero(two[0], two[1]))));
    let marks = Marks::new(Mark::Turn, Role::Ghost, measured);
    picture.items.push(Item::Marks(Marks { name: "measured".into(), at_edge: true, ..marks }));
    Some(picture)
}

/// Where the damping is zero there is a cycle: stable where the damping grows through zero.
fn zero(from: Point, to: Point) -> Marks {
    let x = from.x + from.y / (from.y - to.y) * (to.x - from.x);
    let CycleStyle { mark, role, name, .. } = cycle_style(to.y > from.y);
    Marks { name: name.into(), brief: name, ..Marks::new(mark, role, vec![Point { x, y: 0.0 }]) }
}

/// The first border of a basin, thinned, as a curve.
fn border(found: &Basin, name: &'static str, role: Role, dash: Dash) -> Option<StyledPoints> {
    const COUNT: u16 = 24;
    if found.border == Border::None {
        return None;
    }
    let points = found.borders.first()?.curve(COUNT);
    Some(curve(name, role, dash, points.iter().map(|point| at(point.q, point.v)).collect()))
}

fn phase(fitted: &Fitted) -> Option<Picture<'static>> {
    let estimate = &fitted.estimate;
    let p = &estimate.p;
    let (_, largest) = estimate.amplitudes();
    let edge_of = |parameters: &Parameters| basin(parameters, 2.0 * largest, &Limits::PATIENT).ok();
    let every = (fitted.margins.draws.len() / EDGES).max(1);
    let drawn = fitted.margins.draws.iter().step_by(every);
    let mut curves: Vec<StyledPoints> = drawn
        .filter_map(|draw| {
            border(&edge_of(draw)?, "borders of twenty drawn basins", Role::Ghost, Dash::Dotted)
        })
        .collect();
    let own = edge_of(&parameters(p));
    curves.extend(
        own.and_then(|own| border(&own, "border of the basin", Role::Unstable, Dash::Solid)),
    );
    if let Some(seen) = &fitted.curves.sampled {
        let mut motion = seen.motion.iter().peekable();
        let mut data = Vec::new();
        for [t, x, _] in &seen.points {
            while motion.next_if(|point| point[0] < *t).is_some() {}
            if let Some([_, q, v, _]) = motion.peek() {
                data.extend(estimate.measured(*t, *x, State { q: *q, v: *v }).map(Point::from));
            }
        }
        let fit = seen.motion.iter().map(|[_, q, v, _]| at(*q, *v)).collect();
        let name = match estimate.data.signal {
            Signal::Displacement => "record (velocity by the fit)",
            _ => "record (displacement by the fit)",
        };
        if !data.is_empty() {
            curves.push(curve(name, Role::Field, Dash::Dotted, data));
        }
        curves.push(curve("fitted motion", Role::Trajectory, Dash::Solid, fit));
    }
    let reach = 1.3 * largest.max(p[Q0].abs());
    let span = Span::new(-reach, reach).ok()?;
    let q = with_unit("x - offset", fitted.unit());
    let v = with_unit("velocity/omega0", fitted.unit());
    let mut picture = picture("phase plane", (q, v), curves, Some(Window { x: span, y: span }))?;
    let line = LineStyle::new("sticking set", Role::Sticking, Dash::Solid);
    picture.bar(line, at(-p[R], 0.0), at(p[R], 0.0));
    Some(picture)
}

/// D and r together: where both lie with 68 and 95 %.
fn together(fitted: &Fitted) -> Option<Picture<'static>> {
    const LINES: [(&str, Dash); 2] =
        [("delta chi^2 = 2.3 (68 %)", Dash::Solid), ("delta chi^2 = 6 (95 %)", Dash::Dashed)];
    let p = &fitted.estimate.p;
    let contours = fitted.contours.iter().zip(LINES).filter(|(points, _)| !points.is_empty());
    let contours = contours.map(|(points, (name, dash))| {
        curve(name, Role::Trajectory, dash, points.iter().map(|[d, r]| at(*d, *r)).collect())
    });
    let names = ("D".to_owned(), with_unit("r", fitted.unit()));
    let mut picture = picture("D and r together", names, contours.collect(), None)?;
    let marks = Marks::new(Mark::Stable, Role::Special, vec![at(p[D], p[R])]);
    picture.items.push(Item::Marks(Marks { name: "estimate".into(), ..marks }));
    Some(picture)
}

/// The cumulative distribution of the margin from rest; what is missing to 1 is the share in which every kick is survived.
pub fn margin(fitted: &Fitted) -> Option<Picture<'static>> {
    let (_, largest) = fitted.estimate.amplitudes();
    // A shift from rest leads this far out if it begins at the end of the sticking set.
    let largest = largest - fitted.estimate.p[R];
    let steps = points(&fitted.curves.spread);
    let ends = vec![at(largest, 0.0), at(largest, 1.0)];
    let curves = vec![
        curve("margin is less than this", Role::Danger, Dash::Thick, steps),
        curve("largest amplitude less r", Role::Current, Dash::DashDot, ends),
    ];
    let name = with_unit("smallest shift from rest not survived", fitted.unit());
    let names = (name, "probability".to_owned());
    let extent = Some(window(fitted.curves.spread_extent)?);
    picture("margin from rest, distribution", names, curves, extent)
}

/// How samples that do not count are marked, and what legends call them.
const MARKS: [(Dropped, Mark, Role, &str); 6] = [
    (Dropped::Before, Mark::Aside, Role::Bands, "before the stroke, left out"),
    (Dropped::After, Mark::Aside, Role::Bands, "after a second stroke, left out"),
    (Dropped::Jump, Mark::Aside, Role::Bands, "at jumps, left out"),
    (Dropped::Alike, Mark::Aside, Role::Harmonic, "alike at rest, left out"),
    (Dropped::Saturated, Mark::Saturated, Role::Danger, "saturated, left out"),
    (Dropped::Outlier, Mark::Outlier, Role::Danger, "outliers, left out"),
];

/// Marks of one kind that a picture shows at most.
const MOST: usize = 500;

/// Marks the samples that do not count. What lies above or below the window is shown at its edge.
pub fn mark_dropped(picture: &mut Picture, samples: impl Iterator<Item = (Point, Dropped)>) {
    let samples: Vec<(Point, Dropped)> = samples.collect();
    for (which, mark, role, name) in MARKS {
        let of_kind = samples.iter().filter(|(_, why)| *why == which).map(|(at, _)| *at);
        let all: Vec<Point> = of_kind.collect();
        let at: Vec<Point> = all.iter().copied().step_by(all.len().div_ceil(MOST).max(1)).collect();
        if !at.is_empty() {
            let marks = Marks::new(mark, role, at);
            let marks = Marks { name: name.into(), brief: name, at_edge: true, ..marks };
            picture.items.push(Item::Marks(marks));
        }
    }
}

/// A curve before it stands in a picture.
type StyledPoints = (LineStyle, Vec<Point>);

fn at(x: f64, y: f64) -> Point {
    Point { x, y }
}

fn points(places: &[PlotPoint]) -> Vec<Point> {
    places.iter().copied().map(Point::from).collect()
}

/// What is worth seeing; `None` if it has no extent.
fn window([left, right, low, high]: Extent) -> Option<Window> {
    Some(Window { x: Span::new(left, right).ok()?, y: Span::new(low, high).ok()? })
}

/// A curve through these points.
fn curve(name: &'static str, role: Role, dash: Dash, points: Vec<Point>) -> StyledPoints {
    (LineStyle::new(name, role, dash), points)
}

/// A picture of these curves; where no window is given, of one that holds them all with some room. `None` if
/// they have no extent.
fn picture(
    title: &'static str,
    (x, y): (String, String),
    curves: Vec<StyledPoints>,
    within: Option<Window>,
) -> Option<Picture<'static>> {
    let around = |place: fn(&Point) -> f64| {
        let points = curves.iter().flat_map(|(_, points)| points);
        let span = Span::covering(points.map(place).filter(|it| it.is_finite()))?;
        Some(span.scaled(span.center(), 1.06))
    };
    let window = match within {
        Some(window) => window,
        None => Window { x: around(|point| point.x)?, y: around(|point| point.y)? },
    };
    let mut picture = Picture::new(title, x, y, window);
    for (line, points) in curves {
        picture.curve(line, points);
    }
    Some(picture)
}

/// `name [unit]`.
fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.into() } else { format!("{name} [{unit}]") }
}
