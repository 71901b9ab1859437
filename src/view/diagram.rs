//! The bifurcation diagram: a property of the cycles, over a parameter.
//!
//! Computed branches are solid where the cycle is stable and dashed where it is not; the first-order
//! harmonic answer is dotted beside them. A dotted upright stands at the present value of the
//! parameter, and the cycles there are marked. A point of the branch that is held has a cross.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::Dash;
use super::look::{Look, Role};
use super::number::significant;
use super::pane::Heading;
use super::phase_plane::stability;
use super::plot::{Names, Plot, reading};
use crate::closed_form::harmonic::{
    amplitudes, damping_at, large_asymptote, mean, small_asymptote,
};
use crate::oscillator::{Parameters, Symbol};
use crate::scene::{Axes, Layer, Ordinate, Point, View};
use crate::session::{self, Pane, Session};
use crate::study::{BranchPoint, Special, SpecialKind};

/// Plots at least this wide write the values of special points beside their letters.
const WIDE: u16 = 44;

/// Draws the plot with this index.
pub fn draw(area: Rect, session: &Session, index: usize, look: &Look, buffer: &mut Buffer) {
    let diagram = &session.plots[index];
    let Axes { abscissa, ordinate, .. } = diagram.axes;
    let (name, label) = (abscissa.spec().name, ordinate.spec().label);
    let names = Names { title: View::Diagram.spec().title, x: name, y: label };
    let mut heading = Heading::of(session, Pane::Plot(index));
    let window = diagram.window;
    let pointed = held(session, diagram).or(diagram.cursor);
    heading.reading = pointed.map(|point| {
        let (value, height) = reading(point, window);
        format!("{name} {value} {label} {height}")
    });
    let mut plot = Plot::new(area, window, names, &heading, look, buffer);
    let shows = |layer| session.layers.contains(&layer);
    let current = session.value(abscissa);
    let found = session.branch(index);

    plot.upright(0.0, Role::Axis, Dash::Sparse);
    if window.y.from() < 0.0 && window.y.to() > 0.0 {
        plot.function(Role::Axis, Dash::Sparse, |_| Some(0.0));
    }
    plot.upright(current, Role::Current, Dash::Sparse);
    if let Some(height) = ordinate.spec().harmonic {
        if shows(Layer::Asymptotes) {
            for asymptote in [small_asymptote, large_asymptote] {
                plot.function(Role::Asymptote, Dash::Sparse, |value| {
                    let parameters = at(session, abscissa, value);
                    let amplitude = asymptote(&parameters)?;
                    Some(height(mean(parameters.d2, amplitude), amplitude))
                });
            }
        }
        if shows(Layer::Harmonic) {
            harmonic(&mut plot, session, index, height);
        }
    }
    if shows(Layer::Branch) {
        for piece in found.iter().flat_map(|branch| &branch.pieces) {
            branch(&mut plot, piece, ordinate);
        }
        for piece in found.iter().flat_map(|branch| &branch.pieces) {
            here(&mut plot, piece, ordinate, current, look);
        }
    }
    if shows(Layer::Special) {
        let with_value = plot.inner().width >= WIDE;
        for special in found.iter().flat_map(|branch| &branch.special) {
            caption(&mut plot, special, ordinate, with_value, window.y.to());
        }
    }
    if let Some(point) = pointed {
        plot.cross(point);
    }
    plot.finish(buffer);
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

/// The parameters of the session, with that of a diagram at `value`.
fn at(session: &Session, abscissa: Symbol, value: f64) -> Parameters {
    let (mut parameters, mut initial) = (session.problem.parameters, session.problem.initial);
    abscissa.set(&mut parameters, &mut initial, value);
    parameters
}

/// The first-order harmonic answer, its `height` read out of A0 and A.
///
/// Over D it is drawn along the amplitude, which leads through the fold without a gap; over the other
/// parameters each amplitude is a curve of its own.
fn harmonic(plot: &mut Plot, session: &Session, index: usize, height: fn(f64, f64) -> f64) {
    /// Samples along the amplitude: more than any screen has dots.
    const SAMPLES: u16 = 1000;
    let abscissa = session.plots[index].axes.abscissa;
    let Parameters { d2, d3, r, .. } = session.problem.parameters;
    if abscissa == Symbol::D {
        let largest = largest_amplitude(session, index);
        let points = (1..=SAMPLES).map(|sample| {
            let amplitude = largest * f64::from(sample) / f64::from(SAMPLES);
            let x = damping_at(d3, r, amplitude).unwrap_or(f64::NAN);
            Point { x, y: height(mean(d2, amplitude), amplitude) }
        });
        plot.curve(points, Role::Harmonic, Dash::Dotted);
        return;
    }
    for stable in [false, true] {
        plot.function(Role::Harmonic, Dash::Dotted, |value| {
            let found = amplitudes(&at(session, abscissa, value)).into_iter();
            let mut found = found.filter(|answer| answer.stable == stable);
            found.next().map(|answer| height(answer.mean, answer.amplitude))
        });
    }
}

/// Twice the largest amplitude that can be on show: beyond it the harmonic curve need not be followed.
///
/// Where the ordinate is no length, that is twice the largest amplitude of the computed branch.
fn largest_amplitude(session: &Session, index: usize) -> f64 {
    let y = session.plots[index].window.y;
    match session.plots[index].axes.ordinate {
        Ordinate::QMax | Ordinate::QMin | Ordinate::VMax | Ordinate::Amplitude => {
            2.0 * y.from().abs().max(y.to().abs())
        }
        Ordinate::Mean | Ordinate::Period | Ordinate::Multiplier => {
            let points =
                session.branch(index).into_iter().flat_map(|found| found.pieces.iter().flatten());
            2.0 * points.map(|point| point.cycle.q_max).fold(0.5, f64::max)
        }
    }
}

/// Draws a piece, run by run of equal stability; neighbouring runs share their border point.
fn branch(plot: &mut Plot, piece: &[BranchPoint], ordinate: Ordinate) {
    let place = |point: &BranchPoint| Point { x: point.value, y: ordinate.of(&point.cycle) };
    let mut rest = piece;
    while let Some(first) = rest.first() {
        let (role, dash) = stability(first.cycle.stable);
        let run = rest.iter().take_while(|point| point.cycle.stable == first.cycle.stable).count();
        plot.curve(rest.iter().take(run + 1).map(place), role, dash);
        rest = &rest[run..];
    }
}

/// Marks the cycles of a piece at the present value.
fn here(plot: &mut Plot, piece: &[BranchPoint], ordinate: Ordinate, value: f64, look: &Look) {
    let [stable, unstable] = look.symbols().points;
    for pair in piece.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        if (a.value < value) != (b.value < value) {
            let along = (value - a.value) / (b.value - a.value);
            let (from, to) = (ordinate.of(&a.cycle), ordinate.of(&b.cycle));
            let height = from + along * (to - from);
            let symbol = if a.cycle.stable { stable } else { unstable };
            plot.mark(Point { x: value, y: height }, symbol, Role::Current);
        }
    }
}

/// Writes the letter of a special point, and its value where there is room.
fn caption(plot: &mut Plot, special: &Special, ordinate: Ordinate, with_value: bool, top: f64) {
    let letter = match special.kind {
        SpecialKind::Fold => "F",
        SpecialKind::Escape => "Dc",
        SpecialKind::Hopf => "H",
        SpecialKind::ZeroCrossing => "Z",
    };
    let text = if with_value {
        format!("{letter} {}", significant(special.value, 4))
    } else {
        letter.into()
    };
    // A cycle that has gone to infinity is named at the top, where its branch leaves.
    if special.cycle.is_none() {
        plot.upright(special.value, Role::Asymptote, Dash::Dotted);
    }
    let height = special.cycle.map_or(top, |cycle| ordinate.of(&cycle));
    let point = Point { x: special.value, y: height };
    plot.caption(point, &text, Role::Special);
}
