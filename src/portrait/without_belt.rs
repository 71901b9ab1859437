//! Without a belt a machine is the oscillator of the paper: half swings that close are its cycles
//! ([`crate::portrait::closing::equation`]), and its basin of rest is bordered by orbits ([`crate::portrait::basin`]).
//!
//! Half swings are computed by their clearance from where the mass rests, which the return map loses among the digits
//! of the turning point where damping is nearly critical.

use super::{Border, Cycles, Reach};
use crate::closed_form::harmonic::is_centre;
use crate::flow::{Fate, Limits};
use crate::model::Model;
use crate::portrait::basin::arc::Arc;
use crate::portrait::basin::cycle::cycles_and_closings;
use crate::portrait::basin::stability::Share;
use crate::portrait::basin::{Basin, StartWindow, basin};

/// How far a separatrix is followed, in units of `1/abs(D2)`.
const REACH: f64 = 20.0;

/// Its cycles and the orbits around rest, in m and `m omega_0`; `None` of a machine with a belt, with damping of a higher
/// power than the third, with a family of periodic motions, or whose static friction holds what kinetic friction alone
/// does not: a turning point of a cycle, or a node that repels.
pub fn orbits(model: &Model) -> Option<(Cycles, Basin)> {
    let parameters = model.parameters()?;
    let node = parameters.d <= -1.0;
    if is_centre(&parameters) || (node && model.holds_more_at_rest()) {
        return None;
    }
    let (found, closings) = cycles_and_closings(&parameters, &Limits::PATIENT).ok()?;
    let mut turns = found.cycles.iter().flat_map(|cycle| [cycle.q_max, -cycle.q_min]);
    if model.holds_more_at_rest() && turns.any(|turn| turn <= model.guide_static) {
        return None;
    }
    let reach = REACH / parameters.d2.abs().max(f64::MIN_POSITIVE);
    let basin = Basin::around(&parameters, &closings, reach, &Limits::PATIENT).ok()?;
    Some((found, basin))
}

/// What borders the basin of rest.
pub fn border(basin: &Basin) -> Border {
    match basin.border {
        _ if basin.fates.first() != Some(&Fate::Rest) => Border::NoBasin,
        // It comes out of the node that is the end of what the guide holds.
        Border::Separatrix if basin.parameters.d <= -1.0 => Border::Capture,
        border => border,
    }
}

/// How far kicks may go within the border of the basin; `None` where there is none.
pub fn reach(basin: &Basin, model: &Model) -> Option<Reach> {
    if border(basin) == Border::NoBasin {
        return Some(Reach::default());
    }
    let border = basin.borders.first().filter(|_| basin.border != Border::None)?;
    // What turns within the places that the guide holds rests there.
    let turn = |arc: &Arc| {
        let turn = arc.clearance().map_or(f64::INFINITY, |clearance| model.guide + clearance.value);
        turn.max(model.guide_static)
    };
    let (low, high) = border.span_at(0.0).unwrap_or_default();
    Some(Reach {
        displacement: (turn(&border.lower), turn(&border.upper)),
        velocity: (high * model.omega_0, -low * model.omega_0),
    })
}

/// The fraction of a window, in m and `m omega_0`, from which the mass comes to rest.
pub fn rest_share(found: &Basin, window: &StartWindow) -> Option<Share> {
    if found.border != Border::Separatrix {
        return Some(found.captured_share(window));
    }
    let reach = window.q.0.abs().max(window.q.1.abs());
    let basin = basin(&found.parameters, reach, &Limits::PATIENT).ok()?;
    Some(basin.captured_share(window))
}
