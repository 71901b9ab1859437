//! The bifurcation diagram: a property of the cycles, over a parameter.
//!
//! Computed branches are solid where the cycle is stable and dashed where it is not; the first-order
//! harmonic answer is dotted beside them. A dotted upright stands at the present value of the
//! parameter, and the cycles there are marked. A point of the branch that is held has a cross.

use super::dots::Dash;
use super::look::Role;
use super::number::significant;
use super::phase_plane::{named, stability};
use super::picture::{Item, Line, Mark, Picture};
use super::plot::reading;
use crate::closed_form::harmonic::{
    amplitudes, damping_at, large_asymptote, mean, small_asymptote,
};
use crate::oscillator::{Parameters, Symbol};
use crate::scene::{Answer, Axes, Layer, Ordinate, Point, Slot, View};
use crate::session::{self, Session, Shown};
use crate::study::{Branch, BranchPoint, Special, SpecialKind};

/// What the plot with this index shows.
#[must_use]
pub fn picture(session: &Session, index: usize) -> Picture<'_> {
    let diagram = &session.plots[index];
    let Axes { abscissa, ordinate, .. } = diagram.axes;
    let (name, label) = (abscissa.spec().name, ordinate.spec().label);
    let eigen = abscissa == Symbol::D && session.layers.contains(&Layer::Eigenvalues);
    let label = if eigen { "Re, Im lambda" } else { label };
    let window = diagram.window;
    let mut picture = Picture::new(View::Diagram.spec().title, name, label, window);
    let pointed = held(session, diagram).or(diagram.cursor);
    picture.reading = pointed.map(|point| {
        let (value, height) = reading(point, window);
        format!("{name} {value} {label} {height}")
    });
    let shows = |layer| session.layers.contains(&layer);
    let current = session.value(abscissa);
    let found: Vec<(String, &Branch)> = session
        .found(Slot::Branch, index)
        .into_iter()
        .filter_map(|(label, answer)| match answer {
            Answer::Branch(found) if found.parameter == abscissa => Some((label, found)),
            _ => None,
        })
        .collect();

    picture.upright(Line::guide(), 0.0);
    if window.y.from() < 0.0 && window.y.to() > 0.0 {
        picture.level(Line::guide(), 0.0);
    }
    picture.upright(Line::new("present value", Role::Current, Dash::Sparse), current);
    if ordinate.spec().harmonic.is_some() {
        for shown in session.shown(index) {
            if shows(Layer::Asymptotes) {
                asymptotes(&mut picture, &shown, diagram.axes);
            }
            if shows(Layer::Harmonic) {
                let largest = largest_amplitude(diagram, &found);
                harmonic(&mut picture, &shown, diagram.axes, largest);
            }
        }
    }
    if shows(Layer::Branch) {
        for (label, found) in &found {
            for piece in &found.pieces {
                branch(&mut picture, piece, ordinate, label);
            }
        }
        for piece in found.iter().flat_map(|(_, branch)| &branch.pieces) {
            here(&mut picture, piece, ordinate, current);
        }
    }
    if shows(Layer::Extents) {
        for (label, found) in &found {
            for piece in &found.pieces {
                extents(&mut picture, piece, label);
            }
        }
    }
    if eigen {
        eigenvalues(&mut picture, current);
    }
    if shows(Layer::Special) {
        for special in found.iter().flat_map(|(_, branch)| &branch.special) {
            caption(&mut picture, special, ordinate, window.y.to());
        }
    }
    picture.cross(pointed);
    picture
}

/// Where the point that is held stands in a diagram: in every one over its parameter. A cycle that has
/// gone to infinity stands at the top.
fn held(session: &Session, diagram: &session::Plot) -> Option<Point> {
    let held = session.held?;
    let Axes { abscissa, ordinate, .. } = diagram.axes;
    let same = session.focused().is_some_and(|focused| focused.axes.abscissa == abscissa);
    let top = diagram.window.y.to();
    same.then(|| Point { x: held.value, y: held.cycle.map_or(top, |cycle| ordinate.of(&cycle)) })
}

/// The parameters of a motion, with that of a diagram at `value`.
fn at(shown: &Shown, abscissa: Symbol, value: f64) -> Parameters {
    let (mut parameters, mut initial) = (shown.problem.parameters, shown.problem.initial);
    abscissa.set(&mut parameters, &mut initial, value);
    parameters
}

/// The asymptotes A1 and A2 (51, 52), their height read out of A0 and A.
fn asymptotes(picture: &mut Picture, shown: &Shown, Axes { abscissa, ordinate, .. }: Axes) {
    let Some(height) = ordinate.spec().harmonic else { return };
    for (name, asymptote) in [
        ("asymptote A1", small_asymptote as fn(&Parameters) -> Option<f64>),
        ("asymptote A2", large_asymptote),
    ] {
        let line = Line::new(named(name, &shown.label), Role::Asymptote, Dash::Sparse);
        let shown = shown.clone();
        picture.graph(line, move |value| {
            let parameters = at(&shown, abscissa, value);
            let amplitude = asymptote(&parameters)?;
            Some(height(mean(parameters.d2, amplitude), amplitude))
        });
    }
}

/// The first-order harmonic answer, its height read out of A0 and A.
///
/// Over D it is drawn along the amplitude, up to `largest`, which leads through the fold without a gap;
/// over the other parameters each amplitude is a curve of its own.
fn harmonic(
    picture: &mut Picture,
    shown: &Shown,
    Axes { abscissa, ordinate, .. }: Axes,
    largest: f64,
) {
    /// Samples along the amplitude: more than any screen has dots.
    const SAMPLES: u16 = 1000;
    let Some(height) = ordinate.spec().harmonic else { return };
    let name = named("first harmonic", &shown.label);
    let line = Line::new(name, Role::Harmonic, Dash::Dotted);
    let Parameters { d2, d3, r, .. } = shown.problem.parameters;
    if abscissa == Symbol::D {
        let points = (1..=SAMPLES).map(|sample| {
            let amplitude = largest * f64::from(sample) / f64::from(SAMPLES);
            let x = damping_at(d3, r, amplitude).unwrap_or(f64::NAN);
            Point { x, y: height(mean(d2, amplitude), amplitude) }
        });
        picture.curve(line, points);
        return;
    }
    for stable in [false, true] {
        let shown = shown.clone();
        picture.graph(line.clone(), move |value| {
            let found = amplitudes(&at(&shown, abscissa, value)).into_iter();
            let mut found = found.filter(|answer| answer.stable == stable);
            found.next().map(|answer| height(answer.mean, answer.amplitude))
        });
    }
}

/// Twice the largest amplitude that can be on show: beyond it the harmonic curve need not be followed.
///
/// Where the ordinate is no length, that is twice the largest amplitude of the computed branches.
fn largest_amplitude(diagram: &session::Plot, found: &[(String, &Branch)]) -> f64 {
    let y = diagram.window.y;
    match diagram.axes.ordinate {
        Ordinate::QMax | Ordinate::QMin | Ordinate::VMax | Ordinate::Amplitude => {
            2.0 * y.from().abs().max(y.to().abs())
        }
        Ordinate::Mean | Ordinate::Period | Ordinate::Multiplier => {
            let points = found.iter().flat_map(|(_, branch)| branch.pieces.iter().flatten());
            2.0 * points.map(|point| point.cycle.q_max).fold(0.5, f64::max)
        }
    }
}

/// Adds a piece, run by run of equal stability; neighbouring runs share their border point. One of
/// several branches has its label where it is highest in the window.
fn branch(picture: &mut Picture, piece: &[BranchPoint], ordinate: Ordinate, label: &str) {
    let place = |point: &BranchPoint| Point { x: point.value, y: ordinate.of(&point.cycle) };
    let mut rest = piece;
    while let Some(first) = rest.first() {
        let (role, dash) = stability(first.cycle.stable);
        let name = if first.cycle.stable { "stable cycles" } else { "unstable cycles" };
        let run = rest.iter().take_while(|point| point.cycle.stable == first.cycle.stable).count();
        let line = Line::new(named(name, label), role, dash);
        picture.curve(line, rest.iter().take(run + 1).map(place));
        rest = &rest[run..];
    }
    let points: Vec<Point> = piece.iter().map(place).collect();
    picture.name_curve(&points, label, Role::Special);
}

/// The largest velocities of a piece.
fn extents(picture: &mut Picture, piece: &[BranchPoint], label: &str) {
    let points = piece.iter().map(|point| Point { x: point.value, y: point.cycle.v_max });
    let name = named("largest velocity A_v", label);
    picture.curve(Line::new(name, Role::Velocity, Dash::Dashed), points);
}

/// Eigenvalues of the rest of the smooth system, `-D +- sqrt(D^2 - 1)` (9), over D: their real parts,
/// and dashed their imaginary parts. Below zero the rest is stable.
fn eigenvalues(picture: &mut Picture, current: f64) {
    let spread = |d: f64| (d * d - 1.0).max(0.0).sqrt();
    let height = |d: f64| ((1.0 - d) * (1.0 + d)).max(0.0).sqrt();
    for sign in [1.0, -1.0] {
        let line = Line::new("real part", Role::Stable, Dash::Solid);
        picture.graph(line, move |d| Some(-d + sign * spread(d)));
        let line = Line::new("imaginary part", Role::Velocity, Dash::Dashed);
        picture.graph(line, move |d| (d.abs() <= 1.0).then(|| sign * height(d)));
        let at = Point { x: current, y: -current + sign * spread(current) };
        let mark = if at.y < 0.0 { Mark::Stable } else { Mark::Unstable };
        picture.mark(mark, at, Role::Current);
    }
    picture.caption(Point { x: 0.0, y: 0.0 }, "H", Role::Special);
}

/// Marks the cycles of a piece at the present value.
fn here(picture: &mut Picture, piece: &[BranchPoint], ordinate: Ordinate, value: f64) {
    for pair in piece.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        if (a.value < value) != (b.value < value) {
            let along = (value - a.value) / (b.value - a.value);
            let (from, to) = (ordinate.of(&a.cycle), ordinate.of(&b.cycle));
            let height = from + along * (to - from);
            let mark = if a.cycle.stable { Mark::Stable } else { Mark::Unstable };
            picture.mark(mark, Point { x: value, y: height }, Role::Current);
        }
    }
}

/// Adds the letter of a special point, and its value where there is room.
fn caption(picture: &mut Picture, special: &Special, ordinate: Ordinate, top: f64) {
    let letter = match special.kind {
        SpecialKind::Fold => "F",
        SpecialKind::Escape => "Dc",
        SpecialKind::Hopf => "H",
        SpecialKind::ZeroCrossing => "Z",
    };
    // A cycle that has gone to infinity is named at the top, where its branch leaves.
    if special.cycle.is_none() {
        let line = Line::new("escape", Role::Asymptote, Dash::Dotted);
        picture.upright(line, special.value);
    }
    let height = special.cycle.map_or(top, |cycle| ordinate.of(&cycle));
    picture.items.push(Item::Caption {
        at: Point { x: special.value, y: height },
        or_at: Vec::new(),
        long: format!("{letter} {}", significant(special.value, 4)).into(),
        short: letter.into(),
        role: Role::Special,
    });
}
