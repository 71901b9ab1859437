//! Without a belt a machine is the oscillator of the paper: half swings that close are its cycles
//! ([`crate::study::closing`]), and its basin of rest is bordered by orbits ([`crate::study::basin`]).
//!
//! Half swings are computed by their clearance from where the mass rests, which the return map loses among the digits
//! of the turning point where damping is nearly critical.

use super::arc::LostMotion;
use super::model::Model;
use super::portrait::{Portrait, Traced};
use crate::closed_form::harmonic::is_centre;
use crate::flow::{Fate, Limits};
use crate::oscillator::State;
use crate::portrait::{Border, Margin, Reach};
use crate::study::arc::Arc;
use crate::study::basin::{Basin, Window, basin};
use crate::study::cycle::cycles_and_closings;

/// How far a separatrix is followed, in units of `1/abs(D2)`.
const REACH: f64 = 20.0;

/// The portrait of a machine without a belt; `None` of one with a belt, with damping of a higher power than the
/// third, with a family of periodic motions, or whose static friction holds what kinetic friction alone does not: a
/// turning point of a cycle, or a node that repels.
pub fn portrait(model: &Model) -> Option<Portrait> {
    let parameters = model.parameters()?;
    let node = parameters.d <= -1.0;
    if is_centre(&parameters) || (node && model.holds_more_at_rest()) {
        return None;
    }
    let (found, closings) = cycles_and_closings(&parameters, &Limits::PATIENT).ok()?;
    let held = model.guide_static;
    let turns = found.cycles.iter().flat_map(|cycle| [cycle.q_max, -cycle.q_min]);
    if model.holds_more_at_rest() && { turns }.any(|turn| turn <= held) {
        return None;
    }
    let reach = REACH / parameters.d2.abs().max(f64::MIN_POSITIVE);
    let basin = Basin::around(&parameters, &closings, reach, &Limits::PATIENT).ok()?;
    let rests = basin.fates.first() == Some(&Fate::Rest);
    let reach = if rests { kicks(&basin, model) } else { Some(Reach::default()) };
    let border = match basin.border {
        _ if !rests => Border::NoBasin,
        // It comes out of the node that is the end of what the guide holds.
        Border::Separatrix if node => Border::Capture,
        border => border,
    };
    let mut portrait = Portrait {
        model: model.clone(),
        cycles: found.cycles.iter().map(|cycle| cycle.scaled(1.0, model.omega_0)).collect(),
        neutral: false,
        border,
        reach,
        margin: Margin::ENDLESS,
        landmarks: None,
        stop: None,
        known: f64::INFINITY,
        unresolved: Vec::new(),
        steps: found.cost.steps + basin.cost.steps,
        gaps: Vec::new(),
        traced: Traced::Basin(Box::new(basin)),
    };
    portrait.margin = portrait.margin_within(held, model.mass);
    Some(portrait)
}

/// How far kicks may go within the border of the basin; `None` where there is none.
fn kicks(basin: &Basin, model: &Model) -> Option<Reach> {
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

/// Where a motion from displacement `x` and velocity `y` (divided by the natural frequency) ends.
pub fn fate(basin: &Basin, x: f64, y: f64) -> Fate<LostMotion> {
    match basin.fate(State { q: x, v: y }) {
        Fate::Rest => Fate::Rest,
        Fate::Cycle(index) => Fate::Cycle(index),
        Fate::Neutral => Fate::Neutral,
        Fate::Escapes => Fate::Escapes,
        Fate::Moving | Fate::Unknown(_) => Fate::Unknown(LostMotion::Steps),
    }
}

/// The fraction of a window, in m and `m omega_0`, from which the mass comes to rest.
pub fn rest_share(found: &Basin, window: &Window) -> Option<f64> {
    if found.border != Border::Separatrix {
        return Some(found.captured_share(window).part);
    }
    let reach = window.q.0.abs().max(window.q.1.abs());
    let basin = basin(&found.parameters, reach, &Limits::PATIENT).ok()?;
    Some(basin.captured_share(window).part)
}
