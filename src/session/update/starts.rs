//! Starts on either side of the unstable cycle: what is captured, and what is not.

use super::parameters::change;
use super::refuse;
use crate::flow::Problem;
use crate::oscillator::State;
use crate::scene::Slot;
use crate::session::message::Effect;
use crate::session::state::Session;
use crate::session::step::decimal_sum;

/// Clearance from the sticking set, in that of the cycle: near enough to stay close for a while, far
/// enough to be seen apart.
pub const INSIDE: f64 = 0.95;

/// As [`INSIDE`], on the other side.
pub const OUTSIDE: f64 = 1.05;

/// Starts the motion at rest beside the right turning point of the smallest unstable cycle.
pub fn beside_cycle(session: &mut Session, factor: f64) -> Vec<Effect> {
    match beside(session, factor) {
        Ok(q) => {
            let initial = State { q, v: 0.0 };
            change(session, Problem { initial, ..session.problem });
        }
        Err(why) => refuse(session, why),
    }
    Vec::new()
}

fn beside(session: &Session, factor: f64) -> Result<f64, &'static str> {
    if session.is_stale(Slot::Cycles) {
        return Err(if session.is_busy() {
            "the cycles are still being computed"
        } else {
            "the cycles are not computed: c shows them"
        });
    }
    let unstable =
        session.cycles().and_then(|found| found.cycles.iter().find(|cycle| !cycle.stable));
    let cycle = unstable.ok_or("there is no unstable cycle at these parameters")?;
    let (r, clearance) = (session.problem.parameters.r, cycle.clearance);
    let outside = factor > 1.0;
    let keeps_side = |q: &f64| if outside { q - r > clearance } else { q - r < clearance };
    // Three digits are enough and good to read, unless the cycle is very close to the sticking set.
    let short = format!("{:.2e}", factor * clearance).parse().unwrap_or(clearance);
    let candidates = [decimal_sum(r, short), r + factor * clearance];
    // A cycle can pass closer to r than floating point resolves: then only rest is inside of it.
    let last = if outside { (r + clearance).next_up() } else { r };
    Ok(candidates.into_iter().find(keeps_side).unwrap_or(last))
}
