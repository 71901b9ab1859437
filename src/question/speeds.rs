//! The cycles of a machine over the speed of its belt.

use crate::branch::machine::{MachineBranch, MachineBranchPoint, branch_while, points_while};
use crate::branch::machine_special::MachineSpecial;
use crate::flow::machine::series::ORDER;
use crate::flow::quality::DRAFT;
use crate::flow::{Cost, Limits, Reason};
use crate::model::{Belt, Knob, Source};
use crate::portrait::basin::between;
use crate::portrait::{Border, Cycle};

/// The cycles over the speed of the belt, and where they change.
#[derive(Clone, Debug, PartialEq)]
pub struct Speeds {
    /// The results at all speeds that have an answer.
    pub points: Vec<SpeedPoint>,
    /// The speeds at which the cycles change.
    pub special: Vec<MachineSpecial>,
    /// Cost of the speeds; locating the changes between them is not counted.
    pub cost: Cost,
}

/// The cycles at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedPoint {
    /// Speed of the belt, in m/s.
    pub v0: f64,
    /// The cycles, ordered by amplitude.
    pub cycles: Vec<Cycle>,
    /// Largest displacement to the right from which the mass comes to rest, in m; `None` unless the motion that
    /// touches the belt's line is the border of the basin.
    pub touching: Option<f64>,
    /// Whether small motions come to rest.
    pub rests: bool,
}

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
        let points = points_while(&subject, VARIED, values, go)?;
        return Ok(MachineBranch { points, special: Vec::new() });
    }
    let mut found = branch_while(&subject, VARIED, (from, to), usize::from(STEPS) + 1, go)?;
    let beside = |special: &MachineSpecial| near(special.value, (to - from) / f64::from(STEPS));
    let values = found.special.iter().flat_map(beside);
    let values = values.filter(|value| (from..=to).contains(value)).collect();
    found.points.extend(points_while(&subject, VARIED, values, go)?);
    found.points.sort_by(|one, other| one.value.total_cmp(&other.value));
    Ok(found)
}

/// Speeds on both sides of a change, where cycles end and their curves turn as steeply as a square root.
fn near(value: f64, step: f64) -> impl Iterator<Item = f64> {
    [0.5, 0.1, 0.02, 1e-4]
        .into_iter()
        .flat_map(move |part| [value - part * step, value + part * step])
}

impl Speeds {
    /// The cycles over this range of speeds. Fails with [`Reason::Interrupted`], or where the belt does not run.
    pub(super) fn of(
        belt: &Belt,
        range: (f64, f64),
        rough: bool,
        limits: &Limits,
    ) -> Result<Speeds, Reason> {
        let go = || !(limits.interrupted)();
        let lost = |_| Reason::NotApplicable { needs: "a belt that runs" };
        let found = followed(belt, range, rough, &go).map_err(lost)?;
        if !go() {
            return Err(Reason::Interrupted);
        }
        let point = |MachineBranchPoint { value, found }: &MachineBranchPoint| {
            let found = found.as_ref().ok()?;
            let touches = matches!(found.border, Border::Grazing | Border::Capture);
            let touching = found.reach.filter(|_| touches).map(|reach| reach.displacement.0);
            let rests = found.border != Border::NoBasin;
            Some(SpeedPoint { v0: *value, cycles: found.cycles.clone(), touching, rests })
        };
        let steps = found.points.iter().filter_map(|point| point.found.as_ref().ok());
        let steps = steps.map(|found| found.steps).sum::<u64>();
        let cost = Cost { evaluations: steps * ORDER as u64, steps, rejected: 0 };
        let points = found.points.iter().filter_map(point).collect();
        Ok(Speeds { points, special: found.special, cost })
    }
}
