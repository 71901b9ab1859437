//! The cycles of a machine over one of its numbers, each kind drawn in its own way: slip in lines, solid
//! where it is stable and dashed where it is not, stick-slip in thick ones, overtaking dotted; and where a
//! stable state ends, the jump to the one that is left.

use super::{Picture, phase_plane, units};
use crate::branch::Special;
use crate::portrait::{Border, Cycle, Portrait};
use crate::scene::Layer;
use crate::session::Session;
use crate::words::with_unit;

/// What each kind of cycle is called.
const KINDS: [&str; 5] = [
    "stable slip cycle",
    "unstable slip cycle",
    "branch of stick-slip cycles",
    "stable overtaking cycle",
    "unstable overtaking cycle",
];

/// The one of [`KINDS`] to which a cycle belongs.
fn kind(cycle: &Cycle) -> &'static str {
    if cycle.sticks() {
        "branch of stick-slip cycles"
    } else {
        phase_plane::kind(cycle).0
    }
}

pub fn draw(picture: &mut Picture, session: &Session, index: usize) {
    let varied = session.plots[index].axes.machine;
    picture.axes(units::label(varied), "x_max [m]");
    picture.add_to_title("whole model");
    super::present(picture, session, session.value(varied), picture.window.y.to());
    if session.layers.contains(&Layer::MachineBranch)
        && let Some(found) = session.machine_branch(index)
    {
        // A value without an answer is left out.
        let known = found.points.iter();
        let known = known.filter_map(|it| Some((it.value, it.found.as_ref().ok()?)));
        let points: Vec<_> = known.collect();
        for kind in KINDS {
            cycles(picture, &points, kind);
        }
        rest(picture, &points);
        for special in &found.special {
            changes(picture, special, varied.spec().unit);
        }
    }
}

/// The cycles of a kind: the smallest of it at all values are one curve, the next ones another.
fn cycles(picture: &mut Picture, points: &[(f64, &Portrait)], kind: &'static str) {
    let is = |cycle: &&Cycle| self::kind(cycle) == kind;
    let most = points.iter().map(|(_, found)| found.cycles.iter().filter(is).count()).max();
    for rank in 0..most.unwrap_or(0) {
        let place = |(at, found): &(f64, &Portrait)| {
            let cycle = found.cycles.iter().filter(is).nth(rank);
            [*at, cycle.map_or(f64::NAN, |cycle| cycle.q_max)]
        };
        picture.curve(kind, points.iter().map(place));
    }
}

/// Rest, where it is stable, and how far its basin goes where the motion that touches the belt borders it.
fn rest(picture: &mut Picture, points: &[(f64, &Portrait)]) {
    let rests = |found: &Portrait| (found.border != Border::NoBasin).then_some(0.0);
    let touching = |found: &Portrait| match found.border {
        Border::Grazing | Border::Capture => found.reach.map(|reach| reach.displacement.0),
        _ => None,
    };
    let mut curve = |name, height: &dyn Fn(&Portrait) -> Option<f64>| {
        let place = |(at, found): &(f64, &Portrait)| [*at, height(found).unwrap_or(f64::NAN)];
        picture.curve(name, points.iter().map(place));
    };
    curve("rest", &rests);
    curve("touches the belt", &touching);
}

/// A change, by its letter, and the jumps from the stable states that end there.
fn changes(picture: &mut Picture, special: &Special, unit: &str) {
    let at = special.value;
    let ways = ["jump as numbers grow", "jump as numbers fall"];
    let jumps = special.jumps.unwrap_or_default();
    for (jump, name) in [jumps.up, jumps.down].into_iter().zip(ways) {
        let Some(jump) = jump else { continue };
        // What leaves all that is known leaves the picture.
        let to = if jump.reach().is_finite() {
            jump.reach()
        } else {
            picture.window.y.to()
        };
        picture.curve(name, [[at, jump.from], [at, to]]);
    }
    let place = [at, special.q_max.unwrap_or(0.0)];
    picture.special(place, special.kind.letter(None), &with_unit(at, 4, unit));
}
