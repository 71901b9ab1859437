//! The bifurcation diagram: how large the cycles are, over a parameter.
//!
//! Computed branches are solid where the cycle is stable and dashed where it is not; the first-order
//! harmonic answer is dotted beside them. A dotted upright stands at the present value of the
//! parameter, and the cycles there are marked.

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
use crate::scene::{Layer, Pane, Point};
use crate::session::Session;
use crate::study::{BranchPoint, Special, SpecialKind};

/// Plots at least this wide write the values of special points beside their letters.
const WIDE: u16 = 44;

/// Draws the pane.
pub fn draw(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let abscissa = session.abscissa.spec().name;
    let names = Names { title: pane::name(Pane::Diagram), x: abscissa, y: "q_max" };
    let mut heading = Heading::of(session, Pane::Diagram);
    let window = session.diagram.window;
    heading.reading = session.diagram.cursor.map(|cursor| {
        let (value, amplitude) = reading(cursor, window);
        format!("{abscissa} {value} q_max {amplitude}")
    });
    let mut plot = Plot::new(area, window, names, &heading, look, buffer);
    let shows = |layer| session.layers.contains(&layer);
    let current = session.value(session.abscissa);

    plot.upright(0.0, Role::Axis, Dash::Sparse);
    plot.upright(current, Role::Current, Dash::Sparse);
    if shows(Layer::Asymptotes) {
        plot.function(Role::Asymptote, Dash::Sparse, |x| small_asymptote(&at(session, x)));
        plot.function(Role::Asymptote, Dash::Sparse, |x| large_asymptote(&at(session, x)));
    }
    if shows(Layer::Harmonic) {
        harmonic(&mut plot, session);
    }
    if shows(Layer::Branch) {
        for piece in session.branch().iter().flat_map(|branch| &branch.pieces) {
            branch(&mut plot, piece);
        }
        for piece in session.branch().iter().flat_map(|branch| &branch.pieces) {
            here(&mut plot, piece, current, look);
        }
    }
    if shows(Layer::Special) {
        let with_value = plot.inner().width >= WIDE;
        for special in session.branch().iter().flat_map(|branch| &branch.special) {
            name(&mut plot, special, with_value, window.y.to());
        }
    }
    if let Some(cursor) = session.diagram.cursor {
        plot.cross(cursor);
    }
    plot.finish(buffer);
}

/// The parameters of the session, with the diagram's own at `value`.
fn at(session: &Session, value: f64) -> Parameters {
    let (mut parameters, mut initial) = (session.problem.parameters, session.problem.initial);
    session.abscissa.set(&mut parameters, &mut initial, value);
    parameters
}

/// The first-order harmonic answer, `q_max = A0 + A`.
///
/// Over D it is drawn along the amplitude, which leads through the fold without a gap; over the other
/// parameters each amplitude is a curve of its own.
fn harmonic(plot: &mut Plot, session: &Session) {
    /// Samples along the amplitude: more than any screen has dots.
    const SAMPLES: u16 = 1000;
    let Parameters { d2, d3, r, .. } = session.problem.parameters;
    if session.abscissa == Symbol::D {
        let y = session.diagram.window.y;
        let largest = 2.0 * y.from().abs().max(y.to().abs());
        let points = (1..=SAMPLES).map(|sample| {
            let amplitude = largest * f64::from(sample) / f64::from(SAMPLES);
            let x = damping_at(d3, r, amplitude).unwrap_or(f64::NAN);
            Point { x, y: amplitude + mean(d2, amplitude) }
        });
        plot.curve(points, Role::Harmonic, Dash::Dotted);
        return;
    }
    for stable in [false, true] {
        plot.function(Role::Harmonic, Dash::Dotted, |value| {
            let found = amplitudes(&at(session, value)).into_iter();
            let mut found = found.filter(|answer| answer.stable == stable);
            found.next().map(|answer| answer.mean + answer.amplitude)
        });
    }
}

fn place(point: &BranchPoint) -> Point {
    Point { x: point.value, y: point.cycle.q_max }
}

/// Draws a piece, run by run of equal stability; neighbouring runs share their border point.
fn branch(plot: &mut Plot, piece: &[BranchPoint]) {
    let mut rest = piece;
    while let Some(first) = rest.first() {
        let (role, dash) = stability(first.cycle.stable);
        let run = rest.iter().take_while(|point| point.cycle.stable == first.cycle.stable).count();
        plot.curve(rest.iter().take(run + 1).map(place), role, dash);
        rest = &rest[run..];
    }
}

/// Marks the cycles of a piece at the present value.
fn here(plot: &mut Plot, piece: &[BranchPoint], value: f64, look: &Look) {
    let [stable, unstable] = look.symbols().points;
    for pair in piece.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        if (a.value < value) != (b.value < value) {
            let along = (value - a.value) / (b.value - a.value);
            let height = a.cycle.q_max + along * (b.cycle.q_max - a.cycle.q_max);
            let symbol = if a.cycle.stable { stable } else { unstable };
            plot.mark(Point { x: value, y: height }, symbol, Role::Current);
        }
    }
}

/// Writes the letter of a special point, and its value where there is room.
fn name(plot: &mut Plot, special: &Special, with_value: bool, top: f64) {
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
    if special.q_max.is_none() {
        plot.upright(special.value, Role::Asymptote, Dash::Dotted);
    }
    let point = Point { x: special.value, y: special.q_max.unwrap_or(top) };
    plot.caption(point, &text, Role::Special);
}
