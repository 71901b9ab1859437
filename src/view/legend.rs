//! What the lines of the pictures mean: a sample of each, drawn by the same pens.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::{Dash, Dots, Pen};
use super::look::{Look, Role};
use crate::scene::Layer;
use crate::session::Session;

/// Columns of a sample.
const SAMPLE: u16 = 4;

/// What a sample shows.
#[derive(Clone, Copy, PartialEq)]
enum Sample {
    Line(Dash),
    Bar,
    Shade,
    Arrow,
    Point,
}

/// What there is to explain: the layer that shows it, its role, how it is drawn, and what it is.
type Entry = (Layer, Role, Sample, &'static str);

/// Everything that there is to explain, in the order of the legend.
const ENTRIES: [Entry; 41] = [
    (Layer::Trajectory, Role::Trajectory, Sample::Line(Dash::Solid), "motion"),
    (Layer::Sticking, Role::Sticking, Sample::Bar, "sticking set, at rest"),
    (Layer::Cycles, Role::Stable, Sample::Line(Dash::Solid), "stable cycle"),
    (Layer::Cycles, Role::Unstable, Sample::Line(Dash::Dashed), "unstable cycle"),
    (Layer::Basin, Role::Basin, Sample::Shade, "comes to rest"),
    (Layer::Lyapunov, Role::Lyapunov, Sample::Line(Dash::Dotted), "Lyapunov circle"),
    (Layer::Bands, Role::Bands, Sample::Line(Dash::Dotted), "one half swing more"),
    (Layer::Ghost, Role::Ghost, Sample::Line(Dash::Dotted), "the point left"),
    (Layer::Field, Role::Field, Sample::Arrow, "direction of flow"),
    (Layer::Balance, Role::Harmonic, Sample::Line(Dash::Dotted), "N harmonics"),
    (Layer::Belt, Role::Current, Sample::Line(Dash::Dashed), "sticks to the belt"),
    (Layer::Borders, Role::Special, Sample::Line(Dash::Solid), "fold of the cycles"),
    (Layer::Borders, Role::Unstable, Sample::Line(Dash::Solid), "cycle escapes"),
    (Layer::HarmonicBorder, Role::Harmonic, Sample::Line(Dash::Dotted), "fold of one harmonic"),
    (Layer::BeltPath, Role::Velocity, Sample::Line(Dash::Solid), "over the belt's speed"),
    (Layer::Harmonic, Role::Harmonic, Sample::Line(Dash::Dotted), "first harmonic"),
    (Layer::Asymptotes, Role::Asymptote, Sample::Line(Dash::Sparse), "its asymptotes"),
    (Layer::Branch, Role::Stable, Sample::Line(Dash::Solid), "stable cycles"),
    (Layer::Branch, Role::Unstable, Sample::Line(Dash::Dashed), "unstable cycles"),
    (Layer::Branch, Role::Current, Sample::Line(Dash::Sparse), "present value"),
    (Layer::Extents, Role::Velocity, Sample::Line(Dash::Dashed), "largest velocity"),
    (Layer::Eigenvalues, Role::Stable, Sample::Line(Dash::Solid), "Re lambda"),
    (Layer::Eigenvalues, Role::Velocity, Sample::Line(Dash::Dashed), "Im lambda"),
    (Layer::Levels, Role::Basin, Sample::Shade, "energy falls"),
    (Layer::Spirals, Role::Trajectory, Sample::Line(Dash::Solid), "half turns"),
    (Layer::Position, Role::Trajectory, Sample::Line(Dash::Solid), "displacement q"),
    (Layer::Velocity, Role::Velocity, Sample::Line(Dash::Dashed), "velocity v"),
    (Layer::Friction, Role::Sticking, Sample::Line(Dash::Solid), "friction force f"),
    (Layer::Energy, Role::Energy, Sample::Line(Dash::Dotted), "energy V"),
    (Layer::Map, Role::Map, Sample::Line(Dash::Solid), "next turning point"),
    (Layer::Map, Role::Basin, Sample::Shade, "at rest there"),
    (Layer::Cobweb, Role::Trajectory, Sample::Line(Dash::Solid), "motion, turn by turn"),
    (Layer::FixedPoints, Role::Stable, Sample::Point, "cycles"),
    (Layer::Rows, Role::Trajectory, Sample::Line(Dash::Solid), "methods with events"),
    (Layer::Rows, Role::Unstable, Sample::Line(Dash::Dotted), "and without"),
    (Layer::Front, Role::Stable, Sample::Point, "best choices"),
    (Layer::Rate, Role::Energy, Sample::Line(Dash::Solid), "rate V' of the energy"),
    (Layer::Rate, Role::Velocity, Sample::Line(Dash::Dashed), "fed by damping"),
    (Layer::Rate, Role::Sticking, Sample::Line(Dash::Dotted), "taken by friction"),
    (Layer::Locus, Role::Basin, Sample::Shade, "the rest is stable"),
    (Layer::Locus, Role::Asymptote, Sample::Line(Dash::Dotted), "eigenvalues over D"),
];

/// Draws the legend of the layers that are on at the bottom of `area`, if it fits there.
pub fn draw(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let drawn = |layer: Layer| session.shows(layer) && session.not_drawn(layer).is_none();
    let mut entries: Vec<&Entry> = Vec::new();
    for entry in ENTRIES.iter().filter(|(layer, ..)| drawn(*layer)) {
        // Cycles look alike in every plot: they are explained once.
        let cycle = matches!(entry.1, Role::Stable | Role::Unstable);
        let alike = |other: &&&Entry| cycle && (other.1, other.2) == (entry.1, entry.2);
        if entries.iter().find(alike).is_none() {
            entries.push(entry);
        }
    }
    let rows = u16::try_from(entries.len()).unwrap_or(u16::MAX);
    if area.height < rows || area.width < SAMPLE + 2 {
        return;
    }
    for (y, (_, role, sample, text)) in (area.bottom() - rows..).zip(entries) {
        let place = Rect { x: area.x + 1, y, width: SAMPLE, height: 1 };
        draw_sample(place, *role, *sample, look, buffer);
        let room = usize::from(area.width - SAMPLE - 3);
        buffer.set_stringn(place.right() + 1, y, text, room, look.style(Role::Quiet));
    }
}

fn draw_sample(place: Rect, role: Role, sample: Sample, look: &Look, buffer: &mut Buffer) {
    let mut dots = Dots::new(place, look.glyphs);
    let (width, height) = dots.size();
    let mut line = |y: f64, dash| dots.stroke([(0.0, y), (width - 0.5, y)], Pen { role, dash });
    match sample {
        Sample::Line(dash) => line(height / 2.0, dash),
        Sample::Bar => {
            line(height / 2.0 - 0.5, Dash::Solid);
            line(height / 2.0, Dash::Solid);
        }
        Sample::Shade => {
            (0..SAMPLE).step_by(2).for_each(|x| dots.texture(x, 0, look.symbols().shade, role));
        }
        Sample::Point => dots.symbol(1, 0, look.symbols().points[0], role),
        Sample::Arrow => dots.texture(1, 0, look.symbols().arrows[0], role),
    }
    dots.paint(buffer, look);
}
