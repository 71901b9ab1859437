//! The chart of regimes: what becomes of kicks, over two parameters.
//!
//! Each regime has its texture and its name; computed boundaries are drawn through, the boundary by one
//! harmonic (48) is dotted. The present point is marked: stepping the two parameters moves it and nothing
//! else. The machine on show has its path, along which its belt runs slower and faster.

use super::{Fill, Item, LineStyle, Mark, Marks, Picture, Role};
use crate::branch::{Chart, ChartLine, REGIMES, Regime};
use crate::model::{Knob, Parameters};
use crate::scene::machine::path::Station;
use crate::scene::{Axes, Layer, Point, Window};
use crate::session::Session;
use crate::words::with_unit;

pub fn draw<'a>(picture: &mut Picture<'a>, session: &'a Session, index: usize) {
    let Axes { abscissa, against, .. } = session.plots[index].axes;
    let here = Point { x: session.value(abscissa), y: session.value(against) };
    let found = session.chart(index);
    picture.axes(abscissa.spec().name, against.spec().name);
    picture.varied = vec![abscissa, against];
    let regime =
        |at: Point| found.and_then(|chart| chart.regime_at(at.x, at.y)).map_or("", Regime::name);
    picture.reading = Some(match picture.cursor {
        Some(at) => format!("{} {}", picture.coordinates(at), regime(at)),
        None => regime(here).to_owned(),
    });
    let shows = |layer| session.layers.contains(&layer);

    if let Some(chart) = found.filter(|_| shows(Layer::Regimes)) {
        let texture = |point: Point| chart.regime_at(point.x, point.y).and_then(texture);
        picture.items.push(Item::Texture(Box::new(texture)));
    }
    signs(picture, abscissa, against, session.value(Knob::R));
    if let Some(chart) = found {
        let mut boundary = |place: fn(&ChartLine) -> Option<f64>, name| {
            chart.boundary(place).into_iter().for_each(|run| picture.curve(name, run));
        };
        if shows(Layer::Boundaries) {
            boundary(|line| line.fold, "fold");
            boundary(|line| line.escape, "escape");
        }
        if shows(Layer::HarmonicFold) {
            boundary(|line| line.harmonic, "fold of the first harmonic");
        }
        if shows(Layer::Regimes) {
            names_of_regimes(picture, chart);
        }
    }
    super::present(picture, session, here.x, here.y);
    picture.curve("present value", across(picture.window, here.y));
    if shows(Layer::BeltPath) {
        path(picture, session, abscissa, against);
    }
    picture.mark(Mark::Head, here, Role::Current);
    super::levels::draw(picture, session, index);
}

/// A level line from one side of the window to the other: a curve of two points in files.
fn across(window: Window, y: f64) -> [Point; 2] {
    window.x.ends().map(|x| Point { x, y })
}

/// What a regime looks like; nothing where every kick is survived.
fn texture(regime: Regime) -> Option<Fill> {
    let role = match regime {
        Regime::Global | Regime::Neutral => return None,
        Regime::Finite => Role::Danger,
        Regime::Coexisting => Role::Basin,
        Regime::Escape => Role::Field,
        Regime::Cycle => Role::Stable,
        Regime::Repelling => Role::Unstable,
    };
    Some(Fill { role, name: regime.name() })
}

/// Where a parameter changes its sign; D = 0 is the Hopf point where there is no friction.
fn signs(picture: &mut Picture, right: Knob, up: Knob, friction: f64) {
    let window = picture.window;
    picture.upright(LineStyle::guide(), 0.0);
    picture.curve(LineStyle::guide(), across(window, 0.0));
    let without = friction == 0.0;
    let hopf = match (right, up) {
        (Knob::D, Knob::R) | (Knob::R, Knob::D) => Some(Point { x: 0.0, y: 0.0 }),
        (Knob::D, _) if without => Some(Point { x: 0.0, y: window.y.to() }),
        (_, Knob::D) if without => Some(Point { x: window.x.from(), y: 0.0 }),
        _ => None,
    };
    if let Some(place) = hopf.filter(|place| window.contains(*place)) {
        picture.caption(place, "H", Role::Quiet);
    }
}

/// Cells of a lattice across the window, to find room for names.
const LATTICE: u8 = 16;

/// Width and height of a name, as fractions of a window.
const NAME: (f64, f64) = (0.2, 0.1);

/// Writes each name where its regime has most room around it.
fn names_of_regimes(picture: &mut Picture, chart: &Chart) {
    let window = picture.window;
    let middle = |index: u8| (f64::from(index) + 0.5) / f64::from(LATTICE);
    let cells: Vec<(f64, f64, Option<Regime>)> = (0..LATTICE)
        .flat_map(|row| (0..LATTICE).map(move |column| (middle(column), middle(row))))
        .map(|(x, y)| (x, y, chart.regime_at(window.x.at(x), window.y.at(y))))
        .collect();
    for (regime, name) in REGIMES {
        let room = |x: f64, y: f64| {
            let others = cells.iter().filter(|cell| cell.2 != Some(regime));
            let far = |cell: &(f64, f64, Option<Regime>)| {
                ((cell.0 - x).abs() / NAME.0).max((cell.1 - y).abs() / NAME.1)
            };
            // The ends of the window are boundaries like the others.
            let ends = (x.min(1.0 - x) / NAME.0).min(y.min(1.0 - y) / NAME.1);
            others.map(far).fold(ends, f64::min)
        };
        let own = cells.iter().filter(|cell| cell.2 == Some(regime));
        let best = own.map(|&(x, y, _)| (room(x, y), x, y)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, x, y)) = best {
            // A caption stands beside its point, the name should stand around it.
            picture.caption(window.at([x - 0.5 * NAME.0, y]), name, Role::Text);
        }
    }
}

/// Distance between marks, as a fraction of the window: room for a speed with its unit.
const APART: (f64, f64) = (0.16, 0.07);

/// Distance from the present point below which a mark would lie in its cross.
const CLEAR: (f64, f64) = (0.03, 0.03);

/// What the path stands for, and the marks on it.
const PEN: Role = Role::Belt;

/// Draws the path over two parameters, if the scene is of a machine, while its belt runs slower and faster.
///
/// The speed of the belt moves all four parameters; a chart shows two of them. What else the chart draws
/// holds at the present values of the other two: where the path runs far from the present point, borders move.
fn path(picture: &mut Picture, session: &Session, right: Knob, up: Knob) {
    let Some(running) = session.running() else { return };
    let at =
        |parameters: &Parameters| Point { x: parameters.value(right), y: parameters.value(up) };
    let place = |(_, parameters): Station| parameters.as_ref().map_or(Point::NOWHERE, at);
    let line = LineStyle { varies: true, ..LineStyle::from("over the speed of the belt") };
    picture.curve(line, running.path().into_iter().map(place));
    // Round speeds have marks and their numbers, as far apart as these are wide.
    let (here, window) = (at(&session.problem.parameters), picture.window);
    let apart = |one: Point, other: Point, (x, y): (f64, f64)| {
        let (across, along) = (one.x - other.x, one.y - other.y);
        across.abs() >= x * window.x.width() || along.abs() >= y * window.y.width()
    };
    let mut kept: Vec<Point> = Vec::new();
    for station in running.milestones() {
        let (speed, at) = (station.0, place(station));
        let is_free = kept.iter().all(|other| apart(at, *other, APART));
        if window.contains(at) && is_free && apart(at, here, CLEAR) {
            kept.push(at);
            picture.marks(milestone(at, speed, PEN));
            picture.caption(at, with_unit(speed, 1, "m/s"), PEN);
        }
    }
    let present = at(&running.reduced.parameters);
    let speed = running.machine.belt.belt_speed;
    if present != here {
        // Off the belt: where its speed would have the parameters.
        picture.marks(milestone(present, speed, Role::Current));
    }
    picture.caption(present, with_unit(speed, 4, "m/s"), Role::Current);
}

/// The mark of a speed.
fn milestone(at: Point, speed: f64, role: Role) -> Marks {
    Marks::new(Mark::Turn, role, [at]).called(format!("v0 = {speed} m/s"))
}
