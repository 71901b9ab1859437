//! The cycles of a machine over the speed of its belt.

use std::sync::Arc;

use super::kind::Question;
use super::means::Means;
use crate::flow::quality::DRAFT;
use crate::flow::{Cost, Reason};
use crate::machine::branch::{
    MachineBranch, MachineBranchPoint, branch_while, points_while, spaced,
};
use crate::machine::special::MachineSpecial;
use crate::machine::varied::Varied;
use crate::machine::{MachineCycle, ORDER, Subject};
use crate::oscillator::Belt;
use crate::oscillator::belt::Quantity;

/// The cycles over the speed of the belt, and where they change.
#[derive(Clone, Debug, PartialEq)]
pub struct Speeds {
    /// What was found at each speed that has an answer.
    pub points: Vec<SpeedPoint>,
    /// The changes.
    pub special: Vec<MachineSpecial>,
    /// What the speeds took; the changes between them are not counted.
    pub cost: Cost,
}

/// The cycles at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedPoint {
    /// Speed of the belt, in m/s.
    pub v0: f64,
    /// The cycles, by amplitude.
    pub cycles: Vec<MachineCycle>,
    /// Largest displacement to the right from which the mass comes to rest, in m, where the motion that
    /// touches the belt borders it.
    pub touching: Option<f64>,
    /// Whether small motions come to rest.
    pub rests: bool,
}

/// Steps between the speeds of the belt that are looked at, beside those near changes; and speeds of a draft.
const STEPS: u8 = 32;
const FEW: usize = 7;

#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The machine; its own speed is put to 1 so that stepping it changes nothing here.
    pub belt: Arc<Belt>,
    /// From and to, in m/s; a speed without an answer is left out.
    pub range: (f64, f64),
    /// Whether few speeds are enough for now, and no changes between them.
    pub rough: bool,
}

const VARIED: Varied = Varied::Quantity(Quantity::BeltSpeed);

impl Asked {
    /// What the machine does at the speeds that are looked at, and the changes.
    fn followed(&self, go: &dyn Fn() -> bool) -> Result<MachineBranch, String> {
        let subject = Subject::from(self.belt.as_ref());
        if self.rough {
            let subject = Subject { tolerance: Some(DRAFT.tolerance), ..subject };
            let values = (0..FEW).map(|index| spaced(self.range, index, FEW));
            let points = points_while(&subject, VARIED, values, go)?;
            return Ok(MachineBranch { points, special: Vec::new() });
        }
        let mut found = branch_while(&subject, VARIED, self.range, usize::from(STEPS) + 1, go)?;
        let (from, to) = self.range;
        let beside = |special: &MachineSpecial| near(special.value, (to - from) / f64::from(STEPS));
        let values = found.special.iter().flat_map(beside);
        let values = values.filter(|value| (from..=to).contains(value));
        found.points.extend(points_while(&subject, VARIED, values, go)?);
        found.points.sort_by(|one, other| one.value.total_cmp(&other.value));
        Ok(found)
    }
}

/// Speeds on both sides of a change, where cycles end and turn as steeply as a root.
fn near(value: f64, step: f64) -> impl Iterator<Item = f64> {
    [0.5, 0.1, 0.02, 1e-4]
        .into_iter()
        .flat_map(move |part| [value - part * step, value + part * step])
}

impl Question for Asked {
    type Found = Speeds;

    fn answer(&self, means: &Means) -> Result<Speeds, Reason> {
        let go = || !(means.limits.interrupted)();
        let lost = |_| Reason::NotApplicable { needs: "a belt that runs" };
        let found = self.followed(&go).map_err(lost)?;
        if !go() {
            return Err(Reason::Interrupted);
        }
        let point = |MachineBranchPoint { value, found }: &MachineBranchPoint| {
            let found = found.as_ref().ok()?;
            let (kind, margin) = (found.border.kind(), found.margin);
            let touching = margin.filter(|_| kind == "grazing").map(|margin| margin.displacement.0);
            let rests = kind != "no-basin";
            Some(SpeedPoint { v0: *value, cycles: found.cycles.clone(), touching, rests })
        };
        let steps = found.points.iter().filter_map(|point| point.found.as_ref().ok());
        let steps = steps.map(|found| found.steps).sum::<u64>();
        let cost = Cost { evaluations: steps * ORDER as u64, steps, rejected: 0 };
        let points = found.points.iter().filter_map(point).collect();
        Ok(Speeds { points, special: found.special, cost })
    }

    fn draft(&self) -> Option<Self> {
        (!self.rough).then(|| Asked { rough: true, ..self.clone() })
    }

    fn numbers(&self) -> [f64; 8] {
        [self.range.0, self.range.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}
