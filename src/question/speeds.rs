//! The cycles of a machine over the speed of its belt.

use crate::branch::Special;
use crate::branch::machine::{MachineBranch, branch_while, points_while};
use crate::flow::quality::DRAFT;
use crate::flow::{Limits, Reason};
use crate::model::{Belt, Knob, Source};
use crate::portrait::basin::between;

/// Number of steps between evenly spaced speeds of the belt; further speeds are added near each change.
const STEPS: u8 = 32;
/// Number of speeds in a draft.
const FEW: usize = 7;

const VARIED: Knob = Knob::BeltSpeed;

/// The machine at all speeds, and the changes between them unless it is a `rough` draft.
fn followed(
    belt: &Belt,
    (from, to): (f64, f64),
    rough: bool,
    go: &(dyn Fn() -> bool + Sync),
) -> Result<MachineBranch, String> {
    let subject = Source::from(belt);
    if rough {
        let subject = Source { tolerance: Some(DRAFT.tolerance), ..subject };
        let values = (0..FEW).map(|index| between((from, to), index, FEW)).collect();
        return points_while(&subject, VARIED, values, go);
    }
    let found = branch_while(&subject, VARIED, (from, to), usize::from(STEPS) + 1, go)?;
    let beside = |special: &Special| near(special.value, (to - from) / f64::from(STEPS));
    let values = found.special.iter().flat_map(beside);
    let values = values.filter(|value| (from..=to).contains(value)).collect();
    Ok(found.with_points_of(points_while(&subject, VARIED, values, go)?))
}

/// Speeds on both sides of a change, where cycles end and their curves turn as steeply as a square root.
fn near(value: f64, step: f64) -> impl Iterator<Item = f64> {
    [0.5, 0.1, 0.02, 1e-4]
        .into_iter()
        .flat_map(move |part| [value - part * step, value + part * step])
}

/// The cycles over this range of speeds. Fails with [`Reason::Interrupted`], or where the belt does not run.
pub(super) fn speeds(
    belt: &Belt,
    range: (f64, f64),
    rough: bool,
    limits: &Limits,
) -> Result<MachineBranch, Reason> {
    let go = || !(limits.interrupted)();
    let lost = |_| Reason::NotApplicable { needs: "a belt that runs" };
    let found = followed(belt, range, rough, &go).map_err(lost)?;
    if go() { Ok(found) } else { Err(Reason::Interrupted) }
}
