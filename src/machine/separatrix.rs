//! Rest whose basin only a motion that just escapes borders.
//!
//! Asymmetric damping feeds the motion in one direction the more the faster it is. Without a cycle, the escape
//! separatrix parts what comes to rest from what grows without bound ([`crate::study::orbit`]); it may turn on one
//! side only, or on neither, so that right turning points do not show it.

use super::model::Model;
use crate::flow::Limits;
use crate::portrait::{Border, Reach};
use crate::study::arc::Arc;
use crate::study::basin::{Basin, Window, basin};

/// How far the separatrix is followed, in units of `1/abs(D2)`.
const REACH: f64 = 20.0;

/// The basin of rest of a machine without a belt that a separatrix borders; `None` of any other machine.
pub fn basin_beside(model: &Model) -> Option<Basin> {
    let parameters = model.parameters()?;
    let asymmetric = parameters.d3 == 0.0 && parameters.d2 != 0.0;
    let rests = parameters.d > 0.0 || (parameters.r > 0.0 && parameters.d > -1.0);
    if !(asymmetric && rests) {
        return None;
    }
    let found = basin(&parameters, REACH / parameters.d2.abs(), &Limits::PATIENT).ok()?;
    (found.border == Border::Separatrix && found.borders.len() == 1).then_some(found)
}

/// How far kicks may go within a separatrix.
pub fn reach(basin: &Basin, model: &Model) -> Option<Reach> {
    let border = basin.borders.first()?;
    // What turns within the places that the guide holds rests there.
    let turn = |arc: &Arc| {
        let turn = arc.clearance().map_or(f64::INFINITY, |clearance| model.guide + clearance.value);
        turn.max(model.guide_static)
    };
    let (low, high) = border.span_at(0.0)?;
    Some(Reach {
        displacement: (turn(&border.lower), turn(&border.upper)),
        velocity: (high * model.omega_0, -low * model.omega_0),
    })
}

/// The fraction of a window, in m and `m omega_0`, from which the mass comes to rest.
pub fn rest_share(found: &Basin, window: &Window) -> Option<f64> {
    let reach = window.q.0.abs().max(window.q.1.abs());
    let basin = basin(&found.parameters, reach, &Limits::PATIENT).ok()?;
    Some(basin.captured_share(window).part)
}
