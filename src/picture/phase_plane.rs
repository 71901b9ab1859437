//! The phase plane: where motions go, where they rest, and what separates those that do.
//!
//! Layers from back to front: directions of the flow, shading of the basin, borders of the capture bands,
//! random kicks, the line `v = 0`, the Lyapunov circle, the motion, cycles, the sticking
//! set, markers, cursor. Formulas show the present parameters; computed layers show the last answer, and the title
//! says when that is stale.

use super::{
    Dash, Item, LineStyle, Mark, Picture, Role, construction, cycle_name, ellipse, end_mark,
};
use crate::closed_form::lyapunov;
use crate::fit::{FitResult, Signal};
use crate::flow::{Outcome, Problem};
use crate::model::{Field, HalfPlane, Parameters, Side, State};
use crate::numerics::hypot;
use crate::portrait::{Border, Cycle, Distribution, Drawing, RandomKick, Ride};
use crate::question::Extent;
use crate::scene::{Finding, Layer, Point, Topic, rectangle};
use crate::session::{Session, ShownMotion, VariantTag};
use crate::words::{joined, significant, with_unit};

pub fn draw<'a>(picture: &mut Picture<'a>, session: &'a Session, index: usize) {
    picture.axes("q", "v");
    if session.scene.machine.is_some() {
        let model = if session.draws_whole() {
            "whole model"
        } else {
            "cubic expansion"
        };
        picture.add_to_title(model);
    }
    let shows = |layer| session.layers.contains(&layer);
    let shown = session.shown(index);

    if let Some(first) = shown.first() {
        let parameters = first.problem.parameters;
        if shows(Layer::Field) {
            let flow = Box::new(move |at| flow(&parameters, at));
            picture.items.push(Item::Arrows(flow));
        }
        if shows(Layer::Levels) {
            construction::levels(picture, &parameters);
        }
    }
    let all_cycles = session.found(Topic::Cycles, index, Finding::try_as_cycles_ref);
    for (variant, (found, _)) in all_cycles.iter().filter(|_| shows(Layer::Basin)) {
        basin(picture, found, variant, shows(Layer::Cycles));
    }
    if let Some(found) = session.zones() {
        if shows(Layer::Safe) {
            safe(picture, &found.safe);
        }
        if shows(Layer::Lost) {
            lost(picture, &found.hopeful);
        }
    }
    if shows(Layer::Bands) {
        for border in session.borders(index).into_iter().flatten() {
            picture.curve("border of a band of capture", border.iter().copied());
        }
    }
    kicks(picture, session, index);
    picture.level(LineStyle::guide(), 0.0);
    if shows(Layer::Lyapunov) {
        for shown in &shown {
            circle(picture, shown);
        }
    }
    if let Some(fitted) = session.fitted().filter(|_| shows(Layer::Recorded)) {
        record(picture, fitted);
    }
    if shows(Layer::Trajectory) {
        motions(picture, session, index);
    }
    // The cycle lies over the half turns that it is made of, so that its dashes are seen.
    if shows(Layer::Spirals) {
        for shown in &shown {
            construction::spirals(picture, &shown.problem.parameters);
        }
    }
    for (variant, (found, _)) in all_cycles.iter().filter(|_| shows(Layer::Cycles)) {
        cycles(picture, found, variant, session.draws_whole());
    }
    let balance = session.balance().filter(|_| shows(Layer::Balance));
    for found in balance.iter().flat_map(|balance| &balance.balanced) {
        picture.curve("cycle of N harmonics", found.curve.iter().copied());
    }
    if shows(Layer::Sticking) {
        for ShownMotion { variant, problem, .. } in &shown {
            let r = problem.parameters.r;
            picture.curve(sticking_set(r).of(variant), [[-r, 0.0], [r, 0.0]]);
        }
    }
    if shows(Layer::Belt) {
        belt(picture, session);
    }
    let told = (shows(Layer::Margin) || session.kicking) && !session.is_asked();
    if told && session.variants(index).is_none() {
        margin(picture, session);
    }
    if shows(Layer::Trajectory) {
        ends(picture, session, index, &shown);
    }
    if let Some(head) = session.head() {
        picture.mark(Mark::Head, head.state(), Role::Cursor);
    }
}

/// What was measured; the velocities are those of the fit, or if they were measured the displacements. Of an
/// acceleration nothing is seen here.
fn record(picture: &mut Picture, fitted: &FitResult) {
    if fitted.record.signal == Signal::Acceleration {
        return;
    }
    let counted = fitted.points.iter().filter(|point| point.dropped.is_none());
    let line = LineStyle { dash: Dash::Dotted, ..LineStyle::from("record") };
    picture.curve(line, counted.map(|point| [point.q, point.v]));
}

/// An arrow to the border of the basin: from where the mass was kicked in the direction of the kick, otherwise from where
/// the smallest impulse is lost.
fn margin(picture: &mut Picture, session: &Session) {
    /// Half the width and the length of its head, as parts of the window.
    const HEAD: [f64; 2] = [0.012, 0.03];
    /// How far from it its name stands, and how long it is at least where it has one, as parts of the height.
    const BEYOND: f64 = 0.08;
    const LEAST: f64 = 0.06;
    let State { q, v } = session.problem.initial;
    let kick = session.kick().filter(|_| session.kicking);
    let tried = kick.and_then(|kick| Some(State { q, v: kick.border?.copysign(v) }));
    let Some(State { q, v }) = tried.or_else(|| session.cycles()?.nearest) else { return };
    let [aside, back] = [HEAD[0] * picture.window.x.width(), HEAD[1] * picture.window.y.width()];
    let below = v - back.min(0.5 * v.abs()).copysign(v);
    let shaft = [[q, 0.0], [q, v], [q - aside, below], [q, v], [q + aside, below]];
    picture.curve("margin", shaft);
    // Beside a short arrow it would hide more than it says; the status line has the number, too.
    if v.abs() < LEAST * picture.window.y.width() {
        return;
    }
    let (one, unit) = session.unit_of_kick(false);
    let text = format!("margin {}", with_unit(v.abs() * one, 4, unit));
    // Beyond its tip, where it hides neither the axis nor what is within the border.
    let beyond = v + BEYOND * picture.window.y.width().copysign(v);
    picture.caption([q, beyond], text, Role::Special);
}

/// The velocity at which the mass sticks to its belt, and where the motion reaches it.
fn belt(picture: &mut Picture, session: &Session) {
    let Some(running) = session.running() else { return };
    let y = running.reduced.sticking_velocity;
    picture.level("speed of the belt", y);
    picture.caption([picture.window.x.from(), y], "belt", Role::Belt);
    if session.draws_whole() {
        rides(picture, session, y);
    }
    if let Some((_, q)) = session.contact() {
        picture.caption([q, y], "sticks to the belt", Role::Warning);
    }
}

/// Where the motion and the cycles ride on the belt, at this height: thick pieces of its line.
fn rides(picture: &mut Picture, session: &Session, y: f64) {
    let cycles = session.cycles().filter(|_| session.layers.contains(&Layer::Cycles));
    let cycles = cycles.iter().flat_map(|found| &found.cycles);
    for Ride { from, to, .. } in cycles.filter_map(|cycle| cycle.ride) {
        picture.curve("cycle on the belt", [[from, y], [to, y]]);
    }
    let motion = session.trajectory().filter(|_| session.layers.contains(&Layer::Trajectory));
    for stretch in motion.iter().flat_map(|motion| session.sticking(0, motion)) {
        // At rest the mark of the end tells it.
        if stretch[0].v != 0.0 {
            picture.curve("sticks", stretch.map(|end| [end.q, y]));
        }
    }
}

/// The kind of a cycle in the words of the legend, and as its own caption where it is not a plain slip.
pub fn kind(cycle: &Cycle) -> (&'static str, &'static str) {
    match (cycle.stable, cycle.sticks(), cycle.overtakes) {
        (_, true, false) => ("stick-slip cycle", "stick-slip"),
        (_, true, true) => ("overtaking stick-slip cycle", "stick-slip, overtaking"),
        (true, false, false) => ("stable slip cycle", "slip"),
        (false, false, false) => ("unstable slip cycle", ""),
        (true, false, true) => ("stable overtaking cycle", "overtaking"),
        (false, false, true) => ("unstable overtaking cycle", "overtaking, unstable"),
    }
}

/// The motions of a plot.
fn motions(picture: &mut Picture, session: &Session, index: usize) {
    let family = session.variants(index).is_some();
    let mut found = session.found(Topic::Trajectory, index, Finding::try_as_trajectory_ref);
    if !family {
        // The present one over the others.
        found.reverse();
    }
    for (variant, found) in found {
        let place = variant.index;
        let (line, variant) = if family {
            ("motion".into(), variant)
        } else {
            (motion(session, place), VariantTag { index: 0, ..variant })
        };
        // Where the mass sticks to its belt the model ends, and the curve with it.
        let last = session.contact_of(found).map_or(f64::INFINITY, |(tau, _)| tau);
        let seen = session.seen(if family { usize::MAX } else { place }, found);
        let samples = seen.take_while(|sample| sample.tau <= last);
        let points: Vec<Point> = samples.map(|sample| sample.state().into()).collect();
        // One of several motions has its number at its end, as at its start: dashes repeat.
        let number = session.tag(place).filter(|_| !family);
        let seen = points.iter().rfind(|at| picture.window.contains(**at));
        if let Some((number, end)) = number.zip(seen) {
            picture.caption(*end, number, line.role);
        }
        picture.curve(line.of(&variant), points);
    }
}

/// How the motion in this place among those on show is drawn, and what it is called.
pub fn motion(session: &Session, place: usize) -> LineStyle {
    const DASHES: [Dash; 2] = [Dash::DashDot, Dash::Dotted];
    let own = LineStyle::from("motion");
    let Some(number) = session.number(place) else { return own };
    let name = format!("motion {number}");
    match place {
        0 => LineStyle { name: name.into(), ..own },
        // They are numbered where they begin and end.
        _ => LineStyle::new(name, Role::Beside, DASHES[place % DASHES.len()])
            .briefly("other motions"),
    }
}

/// The segment where the mass rests.
pub fn sticking_set(r: f64) -> LineStyle {
    if r == 0.0 { "equilibrium" } else { "sticking set" }.into()
}

/// Direction of the flow (equation 8); on `v = 0` it is that of the upper side.
fn flow(parameters: &Parameters, Point { x: q, y: v }: Point) -> Point {
    let side = if v < 0.0 { Side::Lower } else { Side::Upper };
    let field = HalfPlane::new(parameters, side);
    let (position, speed) = (side.position(q, parameters.r), side.sign() * v);
    Point { x: v, y: side.sign() * field.acceleration(position, speed) }
}

/// The shaded basin of the sticking set, if it has an edge; an edge that is one of the cycles is drawn
/// with these, where they are, so that its dashes are those of one curve.
fn basin(picture: &mut Picture, found: &Drawing, variant: &VariantTag, with_cycles: bool) {
    if found.edge.is_empty() {
        return;
    }
    let edge = Point::all(&found.edge);
    let area = LineStyle::from("basin of the sticking set").of(variant);
    picture.items.push(Item::Shade(area, edge.clone()));
    if !(with_cycles && found.portrait.border == Border::Cycle) {
        picture.curve(LineStyle::from("border of the basin").of(variant), edge);
    }
}

/// What no motion leaves, whatever the parameters and the disturbance are.
fn safe(picture: &mut Picture, extent: &Extent) {
    let Extent::Within(border) = extent else { return };
    let border = Point::all(border);
    picture.items.push(Item::Shade("surely safe".into(), border.clone()));
    picture.curve("border of the surely safe", border);
}

/// Beyond which nothing comes to rest, whatever the parameters and the disturbance are.
fn lost(picture: &mut Picture, extent: &Extent) {
    /// Ends of a closed border are this near to each other, as a fraction of its width.
    const CLOSED: f64 = 1e-3;
    let Extent::Within(border) = extent else { return };
    let mut border = Point::all(border);
    let (Some(first), Some(last)) = (border.first().copied(), border.last().copied()) else {
        return;
    };
    let width = border.iter().map(|at| (at.x - first.x).abs()).fold(0.0, f64::max);
    // An open border, a separatrix, has no outside that a window could be filled with.
    if hypot(last.x - first.x, last.y - first.y) <= CLOSED * width {
        border.push(first);
        picture.items.push(Item::Beyond("surely lost".into(), border.clone()));
    }
    picture.curve("border of the surely lost", border);
}

fn circle(picture: &mut Picture, ShownMotion { variant, problem, .. }: &ShownMotion) {
    if let Some(radius) = lyapunov::radius(&problem.parameters) {
        let line = LineStyle::from("Lyapunov circle").of(variant);
        picture.curve(line, ellipse((0.0, radius), (0.0, radius)));
    }
}

fn cycles(picture: &mut Picture, found: &Drawing, variant: &VariantTag, whole: bool) {
    for (cycle, curve) in found.cycles.iter().zip(&found.curves) {
        let plain = cycle_name(cycle.stable);
        let (name, own) = if whole { kind(cycle) } else { (plain, "") };
        let points = Point::all(curve);
        let line = LineStyle::from(plain);
        let own = [&*variant.label, own].into_iter().filter(|word| !word.is_empty());
        let own = joined(own, " ");
        picture.name_curve(&points, &own, &own, line.role);
        // Of a machine the caption says of which kind it is.
        picture.curve(LineStyle { name: name.into(), ..line.briefly(plain) }.of(variant), points);
    }
}

/// Where motions start and where they are in the end. One of a family that rests from the start is there
/// for its cycles and has no marks; the present motion that does has the one of its rest.
fn ends(picture: &mut Picture, session: &Session, index: usize, shown: &[ShownMotion]) {
    let family = session.variants(index).is_some();
    let found = session.found(Topic::Trajectory, index, Finding::try_as_trajectory_ref);
    let own = |place| motion(session, place).role;
    let role = |place| if family { Role::Trajectory } else { own(place) };
    for (VariantTag { index: place, .. }, found) in found {
        let rests = family && matches!(found.outcome, Outcome::Captured { tau: 0.0, .. });
        let goes_on = !family && place == 0 && session.drawn_until().is_some();
        if session.contact_of(found).is_some() || rests || goes_on {
            continue;
        }
        if let (Some(mark), Some(at)) = (end_mark(&found.outcome), found.outcome.state()) {
            picture.mark(mark, at, role(place));
        }
    }
    let problems = if family {
        shown.iter().map(|shown| shown.problem).collect()
    } else {
        session.problems()
    };
    for (place, Problem { parameters, initial, .. }) in problems.iter().enumerate() {
        let role = role(place);
        if initial.v != 0.0 || initial.q.abs() > parameters.r {
            picture.mark(Mark::Start, Point::from(*initial), role);
        }
        if let Some(number) = session.number(place).filter(|_| !family) {
            picture.caption(Point::from(*initial), number.to_string(), role);
        }
    }
}

/// Lines of equal density: their names, and their distances from the mean in spreads.
const NORMAL: [(&str, f64); 3] = [
    ("kicks, 1 standard deviation", 1.0),
    ("kicks, 2 standard deviations", 2.0),
    ("kicks, 3 standard deviations", 3.0),
];

/// Draws the density of the kicks into a phase plane, and adds the lost part to its title.
fn kicks(picture: &mut Picture, session: &Session, index: usize) {
    if !session.layers.contains(&Layer::Kicks) {
        return;
    }
    let RandomKick { q, v, law, .. } = session.kicks;
    match law {
        Distribution::Normal => {
            for (name, distance) in NORMAL {
                picture.curve(name, ellipse((q.0, distance * q.1), (v.0, distance * v.1)));
            }
        }
        Distribution::Uniform => {
            let ends = |(middle, half): (f64, f64)| [middle - half, middle + half];
            picture.curve("all kicks, evenly", rectangle(ends(q), ends(v)));
        }
    }
    picture.add_to_title(&lost_part(session, index));
}

/// The lost part with its error, at the present parameters; or why it is not known.
fn lost_part(session: &Session, index: usize) -> String {
    if let Some(failure) = session.failure(Topic::Kicks, index) {
        return format!("kicks lost: {failure}");
    }
    match session.answer(Topic::Kicks, index) {
        Some(Finding::Kicks(found, _)) if !session.is_stale(Topic::Kicks, index) => {
            let (part, error) = (significant(found.part, 4), significant(found.error, 2));
            let of = if session.variants(index).is_some() {
                " at the present values"
            } else {
                ""
            };
            format!("kicks lost{of} {part} +- {error}")
        }
        _ => "kicks lost: ..".to_owned(),
    }
}
