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
use super::pane::{self, Heading};
use super::phase_plane::stability;
use super::plot::{Names, Plot, reading};
use crate::closed_form::harmonic::{
    amplitudes, damping_at, large_asymptote, mean, small_asymptote,
};
use crate::oscillator::{Parameters, Symbol};
use crate::scene::{Layer, Ordinate, Pane, Point};
use crate::session::{Session, Stop};
use crate::study::{BranchPoint, Special, SpecialKind};

/// Plots at least this wide write the values of special points beside their letters.
const WIDE: u16 = 44;

/// Draws the pane.
pub fn draw(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let abscissa = session.abscissa.spec().name;
    let ordinate = session.ordinate.spec().label;
    let names = Names { title: pane::name(Pane::Diagram), x: abscissa, y: ordinate };
    let mut heading = Heading::of(session, Pane::Diagram);
    let window = session.diagram.window;
    let pointed = session.held.map(|stop| held(session, &stop)).or(session.diagram.cursor);
    heading.reading = pointed.map(|point| {
        let (value, height) = reading(point, window);
        format!("{abscissa} {value} {ordinate} {height}")
    });
    let mut plot = Plot::new(area, window, names, &heading, look, buffer);
    let shows = |layer| session.layers.contains(&layer);
    let current = session.value(session.abscissa);

    plot.upright(0.0, Role::Axis, Dash::Sparse);
    if window.y.from() < 0.0 && window.y.to() > 0.0 {
        plot.function(Role::Axis, Dash::Sparse, |_| Some(0.0));
    }
    plot.upright(current, Role::Current, Dash::Sparse);
    if let Some(height) = session.ordinate.spec().harmonic {
        if shows(Layer::Asymptotes) {
            for asymptote in [small_asymptote, large_asymptote] {
                plot.function(Role::Asymptote, Dash::Sparse, |value| {
                    let parameters = at(session, value);
                    let amplitude = asymptote(&parameters)?;
                    Some(height(mean(parameters.d2, amplitude), amplitude))
                });
            }
        }
        if shows(Layer::Harmonic) {
            harmonic(&mut plot, session, height);
        }
    }
    if shows(Layer::Branch) {
        for piece in session.branch().iter().flat_map(|branch| &branch.pieces) {
            branch(&mut plot, piece, session.ordinate);
        }
        for piece in session.branch().iter().flat_map(|branch| &branch.pieces) {
            here(&mut plot, piece, session.ordinate, current, look);
        }
    }
    if shows(Layer::Special) {
        let with_value = plot.inner().width >= WIDE;
        for special in session.branch().iter().flat_map(|branch| &branch.special) {
            name(&mut plot, special, session.ordinate, with_value, window.y.to());
        }
    }
    if let Some(point) = pointed {
        plot.cross(point);
    }
    plot.finish(buffer);
}

/// Where a held point is drawn; a cycle that has gone to infinity at the top.
fn held(session: &Session, stop: &Stop) -> Point {
    let top = session.diagram.window.y.to();
    Point { x: stop.value, y: stop.cycle.map_or(top, |cycle| session.ordinate.of(&cycle)) }
}

/// The parameters of the session, with the diagram's own at `value`.
fn at(session: &Session, value: f64) -> Parameters {
    let (mut parameters, mut initial) = (session.problem.parameters, session.problem.initial);
    session.abscissa.set(&mut parameters, &mut initial, value);
    parameters
}

/// The first-order harmonic answer, its `height` read out of A0 and A.
///
/// Over D it is drawn along the amplitude, which leads through the fold without a gap; over the other
/// parameters each amplitude is a curve of its own.
fn harmonic(plot: &mut Plot, session: &Session, height: fn(f64, f64) -> f64) {
    /// Samples along the amplitude: more than any screen has dots.
    const SAMPLES: u16 = 1000;
    let Parameters { d2, d3, r, .. } = session.problem.parameters;
    if session.abscissa == Symbol::D {
        let largest = largest_amplitude(session);
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
            let found = amplitudes(&at(session, value)).into_iter();
            let mut found = found.filter(|answer| answer.stable == stable);
            found.next().map(|answer| height(answer.mean, answer.amplitude))
        });
    }
}

/// Twice the largest amplitude that can be on show: beyond it the harmonic curve need not be followed.
///
/// Where the ordinate is no length, that is twice the largest amplitude of the computed branch.
fn largest_amplitude(session: &Session) -> f64 {
    let y = session.diagram.window.y;
    match session.ordinate {
        Ordinate::QMax | Ordinate::QMin | Ordinate::VMax | Ordinate::Amplitude => {
            2.0 * y.from().abs().max(y.to().abs())
        }
        Ordinate::Mean | Ordinate::Period | Ordinate::Multiplier => {
            let points =
                session.branch().into_iter().flat_map(|found| found.pieces.iter().flatten());
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
fn name(plot: &mut Plot, special: &Special, ordinate: Ordinate, with_value: bool, top: f64) {
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
