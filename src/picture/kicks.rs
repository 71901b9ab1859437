//! Random kicks over the basin: where they lead, and which part of them is lost.

use std::f64::consts::TAU;

use super::items::{LineStyle, Picture};
use super::role::{Dash, Role};
use crate::numerics::elementary::sin_cos;
use crate::scene::{Answer, Layer, Point, Topic};
use crate::session::Session;
use crate::study::kicks::{Distribution, RandomKick};
use crate::words::number::significant;

/// Lines of equal density: their names, their distances from the mean in spreads, and their dashes.
const NORMAL: [(&str, f64, Dash); 3] = [
    ("kicks, 1 standard deviation", 1.0, Dash::Solid),
    ("kicks, 2 standard deviations", 2.0, Dash::Dashed),
    ("kicks, 3 standard deviations", 3.0, Dash::Dotted),
];

/// Draws the density of the kicks into a phase plane, and tells the lost part in its title.
pub fn draw(picture: &mut Picture, session: &Session, index: usize) {
    if !session.layers.contains(&Layer::Kicks) {
        return;
    }
    let kicks = &session.kicks;
    match kicks.law {
        Distribution::Normal => {
            for (name, distance, dash) in NORMAL {
                let line = LineStyle::new(name, Role::Harmonic, dash).briefly("kicks: 1, 2, 3 sd");
                picture.curve(line, ellipse(kicks, distance));
            }
        }
        Distribution::Uniform => {
            let line = LineStyle::new("all kicks, evenly", Role::Harmonic, Dash::Solid);
            picture.curve(line, rectangle(kicks));
        }
    }
    picture.title = format!("{}, {}", picture.title, told(session, index)).into();
}

/// The lost part with its error, at the present parameters; or why it is not known.
fn told(session: &Session, index: usize) -> String {
    if session.draws_whole() {
        return "kicks lost: not known of the whole model".to_owned();
    }
    if let Some(failure) = session.failure(Topic::Kicks, index) {
        return format!("kicks lost: {failure}");
    }
    match session.answer(Topic::Kicks, index) {
        Some(Answer::Kicks(found)) if !session.is_stale(Topic::Kicks, index) => {
            let [part, error] = [(found.share.part, 6), (found.share.error, 2)]
                .map(|(value, digits)| significant(value, digits));
            let of = if session.variants(index).is_some() { " at the present values" } else { "" };
            format!("kicks lost{of}: {part} +- {error}")
        }
        _ => "kicks lost: ..".to_owned(),
    }
}

fn ellipse(kicks: &RandomKick, distance: f64) -> impl Iterator<Item = Point> {
    /// Corners of the polygon that stands for the ellipse.
    const CORNERS: u16 = 120;
    let RandomKick { q, v, .. } = *kicks;
    (0..=CORNERS).map(move |corner| {
        let (sin, cos) = sin_cos(TAU * f64::from(corner) / f64::from(CORNERS));
        Point { x: q.0 + distance * q.1 * cos, y: v.0 + distance * v.1 * sin }
    })
}

fn rectangle(kicks: &RandomKick) -> impl Iterator<Item = Point> {
    const CORNERS: [(f64, f64); 5] =
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let RandomKick { q, v, .. } = *kicks;
    CORNERS.into_iter().map(move |(x, y)| Point { x: q.0 + x * q.1, y: v.0 + y * v.1 })
}
