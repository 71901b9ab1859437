//! Starting motions beside each other, such as one on each side of the border of the basin, and removing them.

use crate::flow::Problem;
use crate::model::State;
use crate::numerics::decimal::shortest;
use crate::portrait::Cycles;
use crate::scene::Topic;
use crate::session::act::notice::inform;
use crate::session::act::parameters::put;
use crate::session::effect::Done;
use crate::session::state::starts::MOST_MOTIONS;
use crate::session::state::step_size::decimal_sum;
use crate::session::state::{Session, Setup, Starts};

/// Clearance of a start relative to that of the border: near enough to stay close for a while, far enough to be
/// distinguished.
pub const INSIDE: f64 = 0.95;

/// Like [`INSIDE`], on the other side.
pub const OUTSIDE: f64 = 1.05;

/// Why a motion is not removed.
const ONLY: &str = "the only motion cannot be removed";

/// Starts a motion beside the present ones; if there are too many, the oldest is removed.
pub(in crate::session) fn start(session: &mut Session, initial: State) {
    let before = session.problem.initial;
    if initial == before {
        return;
    }
    let mut others = session.others.without(initial);
    if others.add(before) {
        let text = format!("{MOST_MOTIONS} motions at most: the oldest gave way");
        inform(session, text);
    }
    let problem = Problem { initial, ..session.problem };
    put(session, &Setup { problem, others, ..session.setup() });
}

/// Removes the newest motion; the previous one becomes the present one.
pub fn drop_newest(session: &mut Session) -> Done {
    let initial = *session.others.all().last().ok_or(ONLY)?;
    let problem = Problem { initial, ..session.problem };
    put(session, &Setup { problem, others: session.others.without(initial), ..session.setup() });
    let State { q, v } = initial;
    let count = session.problems().len();
    let motions = if count == 1 { "motion" } else { "motions" };
    let place = format!("q0 = {}, v0 = {}", shortest(q), shortest(v));
    inform(session, format!("{count} {motions} on show; {place}"));
    Ok(())
}

/// Removes all motions but the newest.
pub fn drop_others(session: &mut Session) -> Done {
    let differs = put(session, &Setup { others: Starts::default(), ..session.setup() });
    if differs { Ok(()) } else { Err(ONLY.to_owned()) }
}

/// Starts a motion at rest beside a turning point of the border: the right one of the smallest unstable cycle,
/// or that of the separatrix.
pub fn beside_edge(session: &mut Session, factor: f64) -> Done {
    let q = beside(session, factor)?;
    start(session, State { q, v: 0.0 });
    Ok(())
}

/// The clearance of the border from the sticking set, and the side (1 or -1) of its turning point.
fn edge(found: &Cycles) -> Option<(f64, f64)> {
    if !found.border.parts_without_cycle() {
        return found.cycles.iter().find(|cycle| !cycle.stable).map(|cycle| (cycle.clearance, 1.0));
    }
    // Motions escape to the side where D2 feeds them: for D2 > 0 to the left, from a turning point on the
    // right.
    let displacement = found.picture.as_ref()?.margin.displacement?;
    Some(((displacement - found.parameters.r).max(0.0), 1.0_f64.copysign(found.parameters.d2)))
}

fn beside(session: &Session, factor: f64) -> Result<f64, String> {
    if let Some(why) = session.failure(Topic::Cycles, session.plot) {
        return Err(format!("the cycles are not known: {why}"));
    }
    let edge = session.cycles().and_then(edge);
    let (clearance, side) =
        edge.ok_or("there is no border to start beside: neither cycle nor separatrix")?;
    let r = session.problem.parameters.r;
    let outside = factor > 1.0;
    let keeps_side = |q: &f64| if outside { q - r > clearance } else { q - r < clearance };
    // Three digits are enough and easy to read, unless the border is very close to the sticking set.
    let short = format!("{:.2e}", factor * clearance).parse().unwrap_or(clearance);
    let candidates = [decimal_sum(r, short), r + factor * clearance];
    // A border can pass closer to r than floating-point numbers resolve: only rest is then inside of it.
    let last = if outside { (r + clearance).next_up() } else { r };
    Ok(side * candidates.into_iter().find(keeps_side).unwrap_or(last))
}
