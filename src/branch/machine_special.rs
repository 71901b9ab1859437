//! Where the portrait of a machine changes while one of its numbers varies.
//!
//! Each change but the fold is the zero of a number that one or two integrations give: the damping at rest
//! (Hopf), and left turning points of the orbits that the belt's line singles out. A fold is where the return
//! map touches the diagonal: the extremum of its growth vanishes.

use super::jump::{Family, Jumps};
use super::special::{Special, SpecialKind};
use crate::flow::{Flow, Reason};
use crate::model::{ContactState, Model, Phase};
use crate::numerics::elementary::{exp, ln};
use crate::numerics::root::{PlaceTolerance, illinois, try_bisect};
use crate::portrait::closing::search::Node;
use crate::portrait::return_map::machine_return::Landmarks;
use crate::portrait::{Border, Cycle, Portrait};

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
    fn of(&self, kind: SpecialKind) -> Option<f64> {
        let rides = self.released.is_some_and(|released| released <= 0.0);
        match kind {
            SpecialKind::Hopf => (!self.held).then_some(self.damping),
            SpecialKind::Grazing => self.touching,
            SpecialKind::Annihilation => self.released.filter(|_| self.jumps),
            SpecialKind::Overtaking => self.overtaking.filter(|_| rides),
            SpecialKind::Unsticking => self.unsticking.filter(|_| rides),
            SpecialKind::Fold | SpecialKind::Escape | SpecialKind::ZeroCrossing => None,
        }
    }

    /// The change at a zero; a touch of an unstable cycle is where the stick-slip cycle ends.
    fn special(&self, kind: SpecialKind, value: f64) -> Special {
        let ends = kind == SpecialKind::Grazing && !self.jumps && self.log_slope > 0.0;
        let q_max = match kind {
            SpecialKind::Hopf => None,
            SpecialKind::Grazing => self.turns.0,
            _ => self.turns.1,
        };
        let kind = if ends { SpecialKind::Annihilation } else { kind };
        Special { q_max, ..Special::new(kind, value, None) }
    }
}

/// Relative width to which a special value is narrowed.
const WIDTH: f64 = 4.0 * f64::EPSILON;

fn signs_at(family: Family, value: f64) -> Option<Signs> {
    Signs::new(&family(value)?).ok()
}

/// All special values between two neighbouring ones, with the portraits there.
pub fn between(family: Family, left: (f64, &Portrait), right: (f64, &Portrait)) -> Vec<Special> {
    /// Kinds that are zeros of [`Signs`].
    const KINDS: [SpecialKind; 5] = [
        SpecialKind::Hopf,
        SpecialKind::Grazing,
        SpecialKind::Annihilation,
        SpecialKind::Overtaking,
        SpecialKind::Unsticking,
    ];
    let (Some(from), Some(to)) = (signs_at(family, left.0), signs_at(family, right.0)) else {
        return Vec::new();
    };
    let mut found: Vec<Special> = KINDS
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
        special.jumps = Some(Jumps::at(family, special.value, aside.abs()));
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
fn fold(family: Family, left: (f64, Portrait), right: (f64, Portrait)) -> Option<Special> {
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
    let extremum = |value: f64| -> Option<Node> {
        steepest(&family(value)?, (low * high).sqrt(), ln(high / low))
    };
    let ends = (extremum(with)?, extremum(without)?);
    let value = zero(
        &|value| Some(extremum(value)?.difference),
        (with, ends.0.difference),
        (without, ends.1.difference),
    )?;
    let q_max = Some(exp(extremum(value)?.at));
    Some(Special { q_max, ..Special::new(SpecialKind::Fold, value, None) })
}

/// The extremum of the growth `ln(image/x)` over `u = ln x` near a place, by secants on its exact slope.
fn steepest(model: &Model, near: f64, width: f64) -> Option<Node> {
    let mut flow = Flow::new(model);
    let mut growth = |u: f64| flow.growth(u, 1.0).ok();
    let mut one = growth(ln(near))?;
    let mut other = growth(ln(near) + 0.1 * width.min(1.0))?;
    for _ in 0..50 {
        if one.slope == other.slope {
            break;
        }
        let next = other.at - other.slope * (other.at - one.at) / (other.slope - one.slope);
        one = other;
        // No further than the two cycles are apart.
        other = growth(next.clamp(other.at - width, other.at + width))?;
        if (other.at - one.at).abs() < 1e-9 {
            break;
        }
    }
    Some(other)
}
