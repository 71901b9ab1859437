//! Where the portrait of a machine changes while one of its numbers varies.
//!
//! Each change but the fold is the zero of a number that one or two integrations give: the damping at rest
//! (Hopf), and left turning points of the orbits that the belt's line singles out. A fold is where the return
//! map touches the diagonal: the extremum of its growth vanishes.

use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

use crate::flow::machine::turn::ContactState;
use crate::flow::{Fate, Flow, Reason};
use crate::model::{Model, Phase};
use crate::numerics::elementary::{exp, ln};
use crate::numerics::root::{PlaceTolerance, illinois, try_bisect};
use crate::portrait::return_map::machine_return::Landmarks;
use crate::portrait::return_map::zeros::GrowthSample;
use crate::portrait::{Border, Cycle, Portrait};

/// A kind of change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MachineSpecialKind {
    /// Rest changes its stability.
    Hopf,
    /// A cycle that slips touches the belt's line, and sticks beyond.
    Grazing,
    /// The stick-slip cycle and the border of rest meet as both touch the belt's line.
    Annihilation,
    /// The stick-slip cycle comes to overtake the belt.
    Overtaking,
    /// The cycle comes to overtake the belt without sticking to it.
    Unsticking,
    /// Two cycles meet.
    Fold,
}

/// A place where the portrait changes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MachineSpecial {
    /// What happens.
    pub kind: MachineSpecialKind,
    /// Value of the number that varies, in SI units.
    pub value: f64,
    /// Largest displacement of the cycle that it happens to, in m; none at rest.
    #[serde(rename = "q_max")]
    pub x_max: Option<f64>,
    /// The stable states that end there.
    pub jumps: Jumps,
}

/// The numbers whose zeros are special, at one place; `None` where they do not exist.
#[derive(Clone, Copy, Debug, Default)]
pub struct Signs {
    damping: f64,
    /// Whether the guide holds the mass.
    held: bool,
    /// Next left turning point of the orbit that touches the line, as if it slipped, less the last one.
    touching: Option<f64>,
    /// The same of the orbit that the belt releases.
    released: Option<f64>,
    /// The same less the left turning point that leads to the lower end of the stick band.
    overtaking: Option<f64>,
    /// Right turning point of what is released, less that from which motions do not stick any more.
    unsticking: Option<f64>,
    /// Logarithm of the multiplier of the orbit that touches.
    log_slope: f64,
    /// Right turning points of the orbits that touch and that are released.
    turns: (Option<f64>, Option<f64>),
    /// Whether static friction exceeds the kinetic one.
    jumps: bool,
}

impl Signs {
    /// Computes them. Fails with [`Reason`] where the friction law ends before.
    pub fn new(model: &Model) -> Result<Self, Reason> {
        let mut flow = Flow::new(model);
        let signs =
            Signs { damping: model.damping, held: model.guide_static > 0.0, ..Self::default() };
        let Some(Landmarks { lines, grazing, released, low_left, beyond }) = flow.landmarks()?
        else {
            return Ok(signs);
        };
        let mut left = |right: f64| {
            let place = ContactState::Slips(Phase::Below);
            let turn = flow.turn(place, (right, 0.0), &mut ()).ok()?;
            (!turn.rests).then_some(turn.x)
        };
        // What comes to rest on the left would have turned where the guide lets go.
        let held = -model.guide_static;
        let of =
            |right: f64, left: Option<f64>| if right > 0.0 { left.unwrap_or(held) } else { held };
        let after_touch = of(grazing.image, left(grazing.image.max(model.guide_static)));
        let after_release = released.map(|right| of(right, left(right)));
        Ok(Signs {
            touching: Some(after_touch - grazing.left),
            released: Some(after_release.unwrap_or(held) - grazing.left),
            overtaking: after_release.map(|left| left - low_left),
            unsticking: released.zip(beyond).map(|(right, beyond)| right - beyond),
            log_slope: grazing.log_slope,
            turns: (grazing.right, released),
            jumps: lines.release > lines.fold,
            ..signs
        })
    }

    /// One of the numbers.
    fn of(&self, kind: MachineSpecialKind) -> Option<f64> {
        let rides = self.released.is_some_and(|released| released <= 0.0);
        match kind {
            MachineSpecialKind::Hopf => (!self.held).then_some(self.damping),
            MachineSpecialKind::Grazing => self.touching,
            MachineSpecialKind::Annihilation => self.released.filter(|_| self.jumps),
            MachineSpecialKind::Overtaking => self.overtaking.filter(|_| rides),
            MachineSpecialKind::Unsticking => self.unsticking.filter(|_| rides),
            MachineSpecialKind::Fold => None,
        }
    }

    /// The change at a zero; a touch of an unstable cycle is where the stick-slip cycle ends.
    fn special(&self, kind: MachineSpecialKind, value: f64) -> MachineSpecial {
        let ends = kind == MachineSpecialKind::Grazing && !self.jumps && self.log_slope > 0.0;
        let x_max = match kind {
            MachineSpecialKind::Hopf => None,
            MachineSpecialKind::Grazing => self.turns.0,
            _ => self.turns.1,
        };
        let kind = if ends { MachineSpecialKind::Annihilation } else { kind };
        MachineSpecial { kind, value, x_max, jumps: Jumps::default() }
    }
}

/// Relative width to which a special value is narrowed.
const WIDTH: f64 = 4.0 * f64::EPSILON;

fn signs_at(family: Family, value: f64) -> Option<Signs> {
    Signs::new(&family(value)?).ok()
}

/// All special values between two neighbouring ones, with the portraits there.
pub fn between(
    family: Family,
    left: (f64, &Portrait),
    right: (f64, &Portrait),
) -> Vec<MachineSpecial> {
    /// Kinds that are zeros of [`Signs`].
    const KINDS: [MachineSpecialKind; 5] = [
        MachineSpecialKind::Hopf,
        MachineSpecialKind::Grazing,
        MachineSpecialKind::Annihilation,
        MachineSpecialKind::Overtaking,
        MachineSpecialKind::Unsticking,
    ];
    let (Some(from), Some(to)) = (signs_at(family, left.0), signs_at(family, right.0)) else {
        return Vec::new();
    };
    let mut found: Vec<MachineSpecial> = KINDS
        .into_iter()
        .filter_map(|kind| {
            let ends = (from.of(kind)?, to.of(kind)?);
            if (ends.0 > 0.0) == (ends.1 > 0.0) {
                return None;
            }
            let of = |value| signs_at(family, value)?.of(kind);
            let value = zero(&of, (left.0, ends.0), (right.0, ends.1))?;
            Some(signs_at(family, value)?.special(kind, value))
        })
        .collect();
    found.sort_by(|one, other| (one.value - left.0).abs().total_cmp(&(other.value - left.0).abs()));
    // Between these the portrait keeps its form, unless cycles fold.
    let portrait_at = |value| Portrait::of(&family(value)?).ok();
    let aside = 1e-6 * (right.0 - left.0);
    let mut stretches = Vec::new();
    let mut begin = (left.0, Some(left.1.clone()));
    for special in &found {
        let (before, after) = (special.value - aside, special.value + aside);
        stretches.push((begin, (before, portrait_at(before))));
        begin = (after, portrait_at(after));
    }
    stretches.push((begin, (right.0, Some(right.1.clone()))));
    for ((from, one), (to, other)) in stretches {
        if let (Some(one), Some(other)) = (one, other)
            && let Some(fold) = fold(family, (from, one), (to, other))
        {
            found.push(fold);
        }
    }
    for special in &mut found {
        special.jumps = Jumps::at(family, special.value, aside.abs());
    }
    found.sort_by(|one, other| (one.value - left.0).abs().total_cmp(&(other.value - left.0).abs()));
    found
}

/// The zero of a function between two values of different sign; `None` where the function does not exist on
/// the way.
fn zero(function: &dyn Fn(f64) -> Option<f64>, left: (f64, f64), right: (f64, f64)) -> Option<f64> {
    let function = |value| function(value).ok_or(());
    illinois([left, right], 0.0, PlaceTolerance::Relative(WIDTH), function)
        .ok()
        .map(|ends| ends[0].0)
}

/// How many cycles there are, of each kind; a fold takes one of each stability.
fn count(portrait: &Portrait) -> (usize, usize, bool) {
    let stable = portrait.cycles.iter().filter(|cycle| cycle.stable).count();
    (stable, portrait.cycles.len() - stable, portrait.border == Border::NoBasin)
}

/// The fold between two places where the numbers of stable and of unstable cycles both differ by one.
fn fold(family: Family, left: (f64, Portrait), right: (f64, Portrait)) -> Option<MachineSpecial> {
    /// Halvings that bring the portraits near the fold.
    const NEAR: u32 = 12;
    if count(&left.1) == count(&right.1) {
        return None;
    }
    let (with, without) =
        if left.1.cycles.len() > right.1.cycles.len() { (left, right) } else { (right, left) };
    let (wanted, mut nearest) = (count(&with.1), with.1);
    let (without, with) = try_bisect(without.0, with.0, NEAR, |value| {
        let portrait = family(value).and_then(|model| Portrait::of(&model).ok()).ok_or(())?;
        let holds = count(&portrait) == wanted;
        if holds {
            nearest = portrait;
        }
        Ok::<_, ()>(holds)
    })
    .ok()?;
    let pairs = nearest
        .cycles
        .windows(2)
        .filter(|pair| pair[0].stable != pair[1].stable && !pair.iter().any(Cycle::sticks));
    let gap = |pair: &&[Cycle]| pair[1].q_max / pair[0].q_max;
    let pair = pairs.min_by(|one, other| gap(one).total_cmp(&gap(other)))?;
    let (low, high) = (pair[0].q_max, pair[1].q_max);
    let extremum = |value: f64| -> Option<GrowthSample> {
        steepest(&family(value)?, (low * high).sqrt(), ln(high / low))
    };
    let ends = (extremum(with)?, extremum(without)?);
    let value = zero(&|value| Some(extremum(value)?.f), (with, ends.0.f), (without, ends.1.f))?;
    let x = exp(extremum(value)?.u);
    Some(MachineSpecial {
        kind: MachineSpecialKind::Fold,
        value,
        x_max: Some(x),
        jumps: Jumps::default(),
    })
}

/// The extremum of the growth `ln(image/x)` over `u = ln x` near a place, by secants on its exact slope.
fn steepest(model: &Model, near: f64, width: f64) -> Option<GrowthSample> {
    let mut flow = Flow::new(model);
    let mut growth = |u: f64| flow.growth(u, 1.0).ok();
    let mut one = growth(ln(near))?;
    let mut other = growth(ln(near) + 0.1 * width.min(1.0))?;
    for _ in 0..50 {
        if one.slope == other.slope {
            break;
        }
        let next = other.u - other.slope * (other.u - one.u) / (other.slope - one.slope);
        one = other;
        // No further than the two cycles are apart.
        other = growth(next.clamp(other.u - width, other.u + width))?;
        if (other.u - one.u).abs() < 1e-9 {
            break;
        }
    }
    Some(other)
}

// Where a stable state ends along a number of a machine, and what its motions become there.

/// The model along a number: `None` where there is none.
pub type Family<'a> = &'a (dyn Fn(f64) -> Option<Model> + Sync);

/// The end of a stable state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Largest displacement of the cycle that ends, in m; 0 for rest.
    pub from: f64,
    /// What its motions become.
    pub to: Fate,
    /// Largest displacement of the cycle to which they tend, in m; 0 for rest, else infinite.
    pub x_max: f64,
}

impl Jump {
    /// How far it goes.
    fn size(&self) -> f64 {
        (self.x_max - self.from).abs()
    }
}

impl Serialize for Jump {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct To {
            kind: &'static str,
            #[serde(rename = "q_max", skip_serializing_if = "Option::is_none")]
            x_max: Option<f64>,
        }
        let (kind, x_max) = match self.to {
            Fate::Rest => ("rest", None),
            Fate::Cycle(_) => ("cycle", Some(self.x_max)),
            Fate::Escapes => ("escaped", None),
            Fate::Neutral | Fate::Moving | Fate::Unknown(_) => ("unknown", None),
        };
        let mut jump = out.serialize_struct("Jump", 2)?;
        jump.serialize_field("from", &self.from)?;
        jump.serialize_field("to", &To { kind, x_max })?;
        jump.end()
    }
}

/// The jumps at a place, on the way up and on the way down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Jumps {
    /// While the number grows.
    pub up: Option<Jump>,
    /// While it falls.
    pub down: Option<Jump>,
}

impl Jumps {
    /// The jumps at `value`, found from the states so far `aside` of it. What shrinks with the distance, as
    /// a cycle does that is born at rest, is not a jump.
    pub fn at(family: Family, value: f64, aside: f64) -> Self {
        /// How much farther one looks as well.
        const FARTHER: f64 = 100.0;
        let portrait = |value| Portrait::of(&family(value)?).ok();
        let jumps = |aside: f64| {
            let (below, above) = (portrait(value - aside)?, portrait(value + aside)?);
            Some(Jumps { up: jump(&below, &above), down: jump(&above, &below) })
        };
        let (Some(far), Some(near)) = (jumps(FARTHER * aside), jumps(aside)) else {
            return Jumps::default();
        };
        let stays = |far: Option<Jump>, near: Option<Jump>| {
            far.zip(near).filter(|(far, near)| near.size() > 0.5 * far.size()).map(|(_, near)| near)
        };
        Jumps { up: stays(far.up, near.up), down: stays(far.down, near.down) }
    }
}

/// The first stable state of one machine that its neighbour does not have.
fn jump(from: &Portrait, to: &Portrait) -> Option<Jump> {
    /// A state that has moved by less, as a fraction of the largest cycle, is the same.
    const MOVED: f64 = 1e-3;
    /// The kick that shows whether rest holds, as a fraction of the same.
    const KICK: f64 = 1e-9;
    let cycles = from.cycles.iter().chain(&to.cycles).map(|cycle| cycle.q_max);
    let size = cycles.fold(0.0, f64::max);
    let rests = !from.neutral && from.border != Border::NoBasin;
    let stable = from.cycles.iter().filter(|cycle| cycle.stable).map(|cycle| cycle.q_max);
    rests.then_some(0.0).into_iter().chain(stable).find_map(|state| {
        let fate = to.fate(state.max(KICK * size), 0.0).unwrap_or_else(Fate::Unknown);
        let x_max = match fate {
            Fate::Rest => 0.0,
            Fate::Cycle(index) => to.cycles[index].q_max,
            Fate::Neutral => return None,
            Fate::Moving | Fate::Escapes | Fate::Unknown(_) => f64::INFINITY,
        };
        Some(Jump { from: state, to: fate, x_max }).filter(|jump| jump.size() > MOVED * size)
    })
}
