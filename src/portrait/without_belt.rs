//! Without a belt a machine is the oscillator of the paper: half swings that close are its cycles
//! ([`crate::portrait::closing::equation`]), and its basin of rest is bordered by orbits ([`crate::portrait::basin`]).
//!
//! Half swings are computed by their clearance from where the mass rests, which the return map loses among the digits
//! of the turning point where damping is nearly critical.

use super::{Border, Cycle, Reach};
use crate::closed_form::harmonic::is_centre;
use crate::flow::{Fate, Limits};
use crate::model::Model;
use crate::portrait::basin::arc::Arc;
use crate::portrait::basin::cycle::cycles_and_closings;
use crate::portrait::basin::{Basin, StartWindow, basin};

/// How far a separatrix is followed, in units of `1/abs(D2)`.
const REACH: f64 = 20.0;

/// What is known of a machine without a belt.
pub struct WithoutBelt {
    /// Its cycles, by amplitude, in SI units.
    pub cycles: Vec<Cycle>,
    /// What borders the basin of rest.
    pub border: Border,
    /// The kicks that are survived in each direction; `None` if every kick is.
    pub reach: Option<Reach>,
    /// The orbits around rest, in m and `m omega_0`.
    pub basin: Basin,
    /// Number of integration steps.
    pub steps: u64,
}

impl WithoutBelt {
    /// Finds the cycles and the basin; `None` of a machine with a belt, with damping of a higher power than the third,
    /// with a family of periodic motions, or whose static friction holds what kinetic friction alone does not: a
    /// turning point of a cycle, or a node that repels.
    pub fn of(model: &Model) -> Option<Self> {
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
        let rests = basin.fates.first() == Some(&Fate::Rest);
        let border = match basin.border {
            _ if !rests => Border::NoBasin,
            // It comes out of the node that is the end of what the guide holds.
            Border::Separatrix if node => Border::Capture,
            border => border,
        };
        Some(WithoutBelt {
            cycles: found.cycles.iter().map(|cycle| cycle.scaled(1.0, model.omega_0)).collect(),
            border,
            reach: if rests { reach_of(&basin, model) } else { Some(Reach::default()) },
            steps: found.cost.steps + basin.cost.steps,
            basin,
        })
    }
}

/// How far kicks may go within the border of the basin; `None` where there is none.
fn reach_of(basin: &Basin, model: &Model) -> Option<Reach> {
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
pub fn rest_share(found: &Basin, window: &StartWindow) -> Option<f64> {
    if found.border != Border::Separatrix {
        return Some(found.captured_share(window).part);
    }
    let reach = window.q.0.abs().max(window.q.1.abs());
    let basin = basin(&found.parameters, reach, &Limits::PATIENT).ok()?;
    Some(basin.captured_share(window).part)
}
