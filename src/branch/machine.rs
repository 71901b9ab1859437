//! The cycles of a machine along one of its numbers, and the places where they change.

use rayon::prelude::*;

use super::machine_special::between;
use super::special::Special;
use crate::flow::{Cost, Reason};
use crate::model::{Knob, Source};
use crate::portrait::basin::between as evenly;
use crate::portrait::{Border, Cycle, Portrait};

/// What a machine does at a value of the number that varies.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineBranchPoint {
    /// The value, in SI units.
    pub value: f64,
    /// The cycles, ordered by amplitude, or why there is no answer.
    pub cycles: Result<Vec<Cycle>, Reason>,
    /// Largest displacement to the right from which the mass comes to rest, in m; `None` unless the motion that
    /// touches the belt's line is the border of the basin.
    pub touching: Option<f64>,
    /// Whether small motions come to rest.
    pub rests: bool,
}

/// The cycles along a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineBranch {
    pub points: Vec<MachineBranchPoint>,
    /// Where the portrait changes, in the order of the points.
    pub special: Vec<Special>,
    /// Cost of the points; locating the changes between them is not counted.
    pub cost: Cost,
}

/// Values of a number, and the portrait at each.
type Portraits = Vec<(f64, Result<Portrait, Reason>)>;

impl MachineBranch {
    fn of(portraits: Portraits, special: Vec<Special>) -> Self {
        let known = portraits.iter().filter_map(|(_, found)| found.as_ref().ok());
        let mut cost = Cost::default();
        known.for_each(|found| cost += found.cost);
        let point = |(value, found): (f64, Result<Portrait, Reason>)| {
            let rests = found.as_ref().is_ok_and(|found| found.border != Border::NoBasin);
            let touching = found.as_ref().ok().and_then(|found| {
                let touches = matches!(found.border, Border::Grazing | Border::Capture);
                found.reach.filter(|_| touches).map(|reach| reach.displacement.0)
            });
            MachineBranchPoint { value, cycles: found.map(|found| found.cycles), touching, rests }
        };
        MachineBranch { points: portraits.into_iter().map(point).collect(), special, cost }
    }

    /// This one with the points of another, in order.
    #[must_use]
    pub fn with_points_of(mut self, other: Self) -> Self {
        self.points.extend(other.points);
        self.points.sort_by(|one, other| one.value.total_cmp(&other.value));
        self.cost += other.cost;
        self
    }
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
    let portraits = portraits(subject, varied, values, wanted)?;
    let changes = |pair: &[(f64, Result<Portrait, Reason>)]| match pair {
        [(from, Ok(one)), (to, Ok(other))] if wanted() => {
            between(&family, (*from, one), (*to, other))
        }
        _ => Vec::new(),
    };
    let special = portraits.par_windows(2).flat_map_iter(changes).collect();
    Ok(MachineBranch::of(portraits, special))
}

/// What a machine does at values of one of its numbers, on all cores and as long as that is wanted; changes are not
/// located. Fails with one line, where the machine's law has no such number.
pub fn points_while(
    subject: &Source,
    varied: Knob,
    values: Vec<f64>,
    wanted: &(dyn Fn() -> bool + Sync),
) -> Result<MachineBranch, String> {
    Ok(MachineBranch::of(portraits(subject, varied, values, wanted)?, Vec::new()))
}

fn portraits(
    subject: &Source,
    varied: Knob,
    values: Vec<f64>,
    wanted: &(dyn Fn() -> bool + Sync),
) -> Result<Portraits, String> {
    let portrait = |value| Ok((value, subject.with(varied, value)?.portrait()));
    values.into_par_iter().filter(|_| wanted()).map(portrait).collect()
}

/// The special values along one number, at each value of another. Fails with one line, where the machine's law has
/// no such numbers.
pub fn borders(
    subject: &Source,
    (along, range, count): (Knob, (f64, f64), usize),
    (against, values, rows): (Knob, (f64, f64), usize),
) -> Result<Vec<(f64, Vec<Special>)>, String> {
    let row = |index| {
        let value = evenly(values, index, rows);
        let here = subject.with(against, value)?;
        Ok((value, branch(here, along, range, count)?.special))
    };
    (0..rows).map(row).collect()
}
