//! The cycles of a machine along one of its numbers, and the places where they change.

use rayon::prelude::*;

use super::machine_special::{MachineSpecial, between};
use crate::flow::Reason;
use crate::model::{Knob, Source};
use crate::portrait::Portrait;
use crate::portrait::basin::between as evenly;

#[derive(Clone, Debug)]
pub struct MachineBranchPoint {
    /// Value of the number that varies, in SI units.
    pub value: f64,
    /// What the machine does there, or why there is no answer.
    pub found: Result<Portrait, Reason>,
}

/// The cycles along a number.
#[derive(Clone, Debug)]
pub struct MachineBranch {
    pub points: Vec<MachineBranchPoint>,
    /// Where the portrait changes, in the order of the points.
    pub special: Vec<MachineSpecial>,
}

/// Follows the cycles of a machine along one of its numbers, through `count` values. Fails with one line, where the
/// machine's law has no such number.
pub fn branch(
    subject: impl Into<Source>,
    varied: Knob,
    range: (f64, f64),
    count: usize,
) -> Result<MachineBranch, String> {
    branch_while(&subject.into(), varied, range, count, &|| true)
}

/// The same as long as it is wanted, on all cores: a branch that is not ends early. Fails with one line, where the
/// machine's law has no such number.
pub fn branch_while(
    subject: &Source,
    varied: Knob,
    range: (f64, f64),
    count: usize,
    wanted: &(dyn Fn() -> bool + Sync),
) -> Result<MachineBranch, String> {
    // Where it is not wanted any more there is no machine, and the search for a change ends at once.
    let family = |value: f64| subject.with(varied, value).ok().filter(|_| wanted())?.model().ok();
    let values = (0..count).map(|index| evenly(range, index, count)).collect();
    let points = points_while(subject, varied, values, wanted)?;
    let changes = |pair: &[MachineBranchPoint]| match (&pair[0].found, &pair[1].found) {
        (Ok(one), Ok(other)) if wanted() => {
            between(&family, (pair[0].value, one), (pair[1].value, other))
        }
        _ => Vec::new(),
    };
    let special = points.par_windows(2).flat_map_iter(changes).collect();
    Ok(MachineBranch { points, special })
}

/// What a machine does at values of one of its numbers, on all cores and as long as that is wanted. Fails with one
/// line, where the machine's law has no such number.
pub fn points_while(
    subject: &Source,
    varied: Knob,
    values: Vec<f64>,
    wanted: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<MachineBranchPoint>, String> {
    let point =
        |value| Ok(MachineBranchPoint { value, found: subject.with(varied, value)?.portrait() });
    values.into_par_iter().filter(|_| wanted()).map(point).collect()
}

/// The special values along one number, at each value of another. Fails with one line, where the machine's law has
/// no such numbers.
pub fn borders(
    subject: &Source,
    (along, range, count): (Knob, (f64, f64), usize),
    (against, values, rows): (Knob, (f64, f64), usize),
) -> Result<Vec<(f64, Vec<MachineSpecial>)>, String> {
    let row = |index| {
        let value = evenly(values, index, rows);
        let here = subject.with(against, value)?;
        Ok((value, branch(here, along, range, count)?.special))
    };
    (0..rows).map(row).collect()
}
