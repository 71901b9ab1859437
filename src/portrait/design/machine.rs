//! How much friction of the guide a margin needs, by the whole model.
//!
//! As for the oscillator of the paper ([`crate::portrait::design::oscillator`]): more friction of the guide turns the field
//! inwards wherever the mass moves, so that the basin of rest grows with it.

use crate::flow::Reason;
use crate::model::{Body, Subject, Tolerances};
use crate::numerics::elementary::ln;
use crate::portrait::Border;
use crate::portrait::design::oscillator::{FrictionNeeded, Kick, least_friction};
use crate::portrait::guarantee::machine::guaranteed;
use crate::portrait::survey::Trouble;

/// The logarithm of the guaranteed margin of this kind, as a fraction of `wanted`.
fn guaranteed_excess(
    subject: &Subject,
    known: &Tolerances,
    kick: Kick,
    wanted: f64,
) -> Result<f64, Trouble> {
    // Only belts have tolerances.
    let Body::Belt(belt) = &subject.body else { return Ok(f64::MIN) };
    let found = guaranteed(belt, known)?.map_or(0.0, |margin| kick.margin(&margin));
    Ok(ln(found / wanted).max(f64::MIN))
}

/// The least friction R of the guide, in N, at which the margin, or with tolerances the guaranteed margin, is
/// `wanted` (m or N s) or more; `None` where no bracket of it was found. Fails with [`Trouble`] where a machine on
/// the way has no portrait.
pub fn friction_for(
    subject: &Subject,
    known: &Tolerances,
    kick: Kick,
    wanted: f64,
) -> Result<Option<FrictionNeeded>, Trouble> {
    let model = subject.model()?;
    let mut trouble = None;
    let machine = |held: f64| subject.with_friction(held * model.stiffness);
    // As a length: what the guide holds at rest.
    let length = match kick {
        Kick::Displacement => wanted,
        Kick::Impulse => wanted / (model.mass * model.omega_0),
    };
    let told = |held: f64| {
        let machine = machine(held);
        if !known.is_none() {
            return guaranteed_excess(&machine, known, kick, wanted);
        }
        let found = machine.portrait()?;
        Ok(match found.border {
            Border::NoBasin => f64::MIN,
            _ => ln(kick.margin(&found.margin) / wanted).max(f64::MIN),
        })
    };
    if !known.is_none() {
        // As much friction holds a displacement by itself; where even that guarantees nothing, no friction does.
        let half = known.half_widths.get("R").copied().unwrap_or(0.0);
        let ample = 8.0 * (length + (known.disturbance + half) / model.stiffness);
        if told(ample)? < 0.0 {
            return Ok(None);
        }
    }
    let mut excess = |held: f64| {
        told(held).map_err(|found| {
            trouble = Some(found);
            Reason::NotApplicable { needs: "a portrait of the machine" }
        })
    };
    let without = (model.damping > 0.0 && known.is_none()).then_some(0.0);
    let found = least_friction(length, without, &mut excess);
    if let Some(trouble) = trouble {
        return Err(trouble);
    }
    let force = |r: f64| r * model.stiffness;
    Ok(found.ok().map(|needed| match needed {
        FrictionNeeded::Any => FrictionNeeded::Any,
        FrictionNeeded::Friction { r } => FrictionNeeded::Friction { r: force(r) },
        FrictionNeeded::Fold { r, below } => {
            FrictionNeeded::Fold { r: force(r), below: below / length * wanted }
        }
    }))
}
