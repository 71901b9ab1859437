//! Random kicks over the basin: their distribution, and what fraction of them is lost.

use super::{Picture, ellipse};
use crate::portrait::kicks::{Distribution, RandomKick};
use crate::scene::{Finding, Layer, Topic, rectangle};
use crate::session::Session;
use crate::words::significant;

/// Lines of equal density: their names, and their distances from the mean in spreads.
const NORMAL: [(&str, f64); 3] = [
    ("kicks, 1 standard deviation", 1.0),
    ("kicks, 2 standard deviations", 2.0),
    ("kicks, 3 standard deviations", 3.0),
];

/// Draws the density of the kicks into a phase plane, and adds the lost part to its title.
pub fn draw(picture: &mut Picture, session: &Session, index: usize) {
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
    if session.draws_whole() {
        return "kicks lost: not known of the whole model".to_owned();
    }
    if let Some(failure) = session.failure(Topic::Kicks, index) {
        return format!("kicks lost: {failure}");
    }
    match session.answer(Topic::Kicks, index) {
        Some(Finding::Kicks(found, _)) if !session.is_stale(Topic::Kicks, index) => {
            let [part, error] = [(found.part, 4), (found.error, 2)]
                .map(|(value, digits)| significant(value, digits));
            let of = if session.variants(index).is_some() { " at the present values" } else { "" };
            format!("kicks lost{of} {part} +- {error}")
        }
        _ => "kicks lost: ..".to_owned(),
    }
}
