//! Random kicks of a machine: what fraction of them is lost, and where the others come to rest.

use crate::flow::Flow;

use crate::flow::{Cost, Fate, Reason};
use crate::model::State;
use crate::portrait::basin::stability::Share;
use crate::portrait::kicks::RandomKick;
use crate::portrait::kicks::repeated::{Kicked, Repeated};
use crate::portrait::{Border, Portrait};

/// What the parts that are lost rest on.
const NEEDS: Reason = Reason::NotApplicable {
    needs: "a basin of rest that is known, and no family of periodic motions",
};

/// The fraction of the kicks from the steady position that is lost. Fails with [`Reason::NotApplicable`] where the
/// basin is not known.
pub fn lost(portrait: &Portrait, kicks: &RandomKick) -> Result<Share, Reason> {
    let all = |part| Ok(Share { part, error: 0.0 });
    match portrait.border {
        Border::Unknown(_) => Err(NEEDS),
        _ if portrait.neutral => Err(NEEDS),
        Border::None => all(0.0),
        Border::NoBasin => all(1.0),
        _ => Ok(kicks.lost_outside(&|x| portrait.span_at(x))),
    }
}

/// Follows kicks until one is lost. Fails with [`Reason::NotApplicable`] where the basin is not known, or without
/// friction of the guide.
pub fn repeated(portrait: &Portrait, kicks: &RandomKick) -> Result<Repeated, Reason> {
    /// Error of a place of rest that matters to no cell.
    const TOLERANCE: f64 = 1e-7;
    lost(portrait, kicks)?;
    let mut model = portrait.model.clone();
    model.tolerance = TOLERANCE;
    let rest = |State { q, v }: State| {
        if portrait.fate(q, v) != Ok(Fate::Rest) {
            return Ok((None, Cost::default()));
        }
        let mut flow = Flow::new(&model);
        let place = flow.rest_of(q, model.scaled_velocity(v)).ok();
        Ok((place, Cost { steps: flow.steps, ..Cost::default() }))
    };
    let part = |kicks: &RandomKick| lost(portrait, kicks).map_or(1.0, |share| share.part);
    let kicked = Kicked { half: model.guide_static, rest: &rest, lost: &part };
    let mut found = kicked.repeated(kicks, lost(portrait, kicks)?)?;
    found.cost.steps += portrait.steps;
    Ok(found)
}
