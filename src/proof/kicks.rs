//! The edge of the basin of the sticking set, and the smallest kicks that are not captured, enclosed.
//!
//! By lemma 8, the starts at rest on one side that are captured are those nearer to the sticking set than some
//! clearance; it is that of the innermost cycle if this cycle repels. Where there is no cycle, the clearance
//! lies between one from which motions certainly come to rest and one from which they certainly do not. An
//! impulse is captured if the half swing that it starts ends nearer than this. A push is weakest where the edge is
//! lowest, which over the rest positions is at an end of the sticking set.

use super::field::ParameterBox;
use super::range::narrowed;
use super::swing::swing;
use super::{Passage, Proof, ProvedCycle, ProvedHalf, ProvedMap, StartBox, Theorem};
use crate::model::{Border, Kicks, Margin, RestKicks};
use crate::numerics::{Interval, powi};

/// The smallest kicks that are not captured: kicks below the lower bound come to rest, kicks above the upper
/// bound do not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProvedKicks {
    /// What borders the basin, where that is proved: nothing, the innermost cycle, or a separatrix.
    pub edge: Option<Border>,
    /// Their sizes; `None` where all are captured or nothing is known.
    pub sizes: Kicks<Option<Interval>>,
    /// Why part of the answer is open.
    pub open: Option<&'static str>,
}

const NO_FRICTION: &str = "without friction nothing comes to rest in a finite time";
const NO_EDGE: &str = "no start is certain not to come to rest";
const ATTRACTS: &str = "the innermost cycle attracts";

/// Turns for which a motion is followed before its fate is left open.
const TURNS: usize = 300;

/// Bounds of the kicks. `proof` is about the cycles for the same parameters; `near` has approximate values.
pub fn kicks(proof: &Proof, near: &Margin) -> ProvedKicks {
    let (map, r) = (ProvedMap::new(&proof.parameters), proof.parameters.r);
    let (edge, clearances) = match border(&map, proof, near.displacement) {
        Ok((edge, Some(clearances))) => (edge, clearances),
        Ok((edge, None)) => return ProvedKicks { edge, ..ProvedKicks::default() },
        Err(reason) => return ProvedKicks { open: Some(reason), ..ProvedKicks::default() },
    };
    let at = |x: Interval, hint| {
        let size = |half| threshold(hint, |speed| pushed(&map, half, x, speed, clearances));
        smaller([0, 1].map(size))
    };
    let impulse = at(r, near.impulse);
    // Over the rest positions the edge is lowest at an end (lemma 22).
    let ends = [Interval::point(0.0), r + r];
    let rest_impulse = smaller(ends.map(|x| at(x, near.from_rest.impulse)));
    let from_rest =
        RestKicks { displacement: smaller(clearances.map(Some)), impulse: rest_impulse };
    let displacement = smaller(clearances.map(|it| Some(it + r)));
    let open = (impulse.is_none() || rest_impulse.is_none()).then_some(NO_EDGE);
    ProvedKicks { edge, sizes: Kicks { displacement, impulse, from_rest }, open }
}

/// What certainly borders the basin; `hint` is an approximate value of the smallest displacement.
pub fn edge(proof: &Proof, hint: Option<f64>) -> Option<Border> {
    border(&ProvedMap::new(&proof.parameters), proof, hint).ok()?.0
}

/// What borders the basin, if that is certain, and the clearances of the border to the right and to the left; `None` where
/// everything comes to rest. Fails with why nothing is known.
fn border(
    map: &ProvedMap,
    proof: &Proof,
    hint: Option<f64>,
) -> Result<(Option<Border>, Option<[Interval; 2]>), &'static str> {
    let r = proof.parameters.r;
    if !(r > 0.0) {
        return Err(NO_FRICTION);
    }
    let none = proof.is_complete() && proof.cycles.is_empty();
    if none && is_bounded(map, proof) {
        return Ok((Some(Border::None), None));
    }
    let innermost = innermost(proof);
    if innermost.is_some_and(|cycle| cycle.stable) {
        return Err(ATTRACTS);
    }
    if let Some(it) = innermost.and_then(|cycle| cycle.enclosure) {
        return Ok((Some(Border::Cycle), Some([it.clearance, -it.q_min - r])));
    }
    let guess = hint.map(|hint| hint - r.middle());
    let sides = [0, 1].map(|side| {
        let mut known = Interval::new(0.0, f64::INFINITY);
        threshold(guess, |clearance| at_rest(map, side, clearance, &mut known))
    });
    let [Some(right), Some(left)] = sides else { return Err(NO_EDGE) };
    if right.upper().min(left.upper()) == f64::INFINITY {
        return Err(NO_EDGE);
    }
    Ok((none.then_some(Border::Separatrix), Some([right, left])))
}

/// The innermost cycle, if there is certainly none inside it.
fn innermost(proof: &Proof) -> Option<&ProvedCycle> {
    let first = proof.cycles.first()?;
    proof.open.iter().all(|gap| gap.lower() >= first.within.upper()).then_some(first)
}

/// The smaller of two numbers, where both are known.
fn smaller([one, other]: [Option<Interval>; 2]) -> Option<Interval> {
    let (one, other) = one.zip(other)?;
    Some(Interval::new(one.lower().min(other.lower()), one.upper().min(other.upper())))
}

/// Whether no motion grows beyond all bounds.
fn is_bounded(map: &ProvedMap, proof: &Proof) -> bool {
    let ParameterBox { d2, d3, .. } = proof.parameters;
    // Every motion loses energy, the first integral of lemma 13 for D2 = 0.
    let energy = proof.theorem == Some(Theorem::OneWay) && d2 == 0.0;
    let barred = |it: &ProvedHalf| it.greatest(f64::INFINITY) < f64::INFINITY;
    energy || (d3 > 0.0 && map.forward.0.iter().all(barred))
}

/// Whether a start at rest with this clearance is captured, where that is certain; `half` is its first half swing.
///
/// `known` bounds the edge: starts below it are captured, starts above it are not. The answer updates it.
fn at_rest(map: &ProvedMap, half: usize, from: f64, known: &mut Interval) -> Option<bool> {
    let mut at = Interval::point(from);
    for _ in 0..TURNS {
        let before = at;
        for index in [half, 1 - half] {
            // Each half swing may take what it takes; nothing else counts these steps.
            map.effort.steps.set(0);
            at = map.forward.0[index].image(at);
        }
        // A motion that has not come nearer in one turn never will.
        if at.lower() >= from.min(known.upper()) {
            *known = Interval::new(known.lower(), known.upper().min(from));
            return Some(false);
        }
        if at.upper() <= known.lower() {
            *known = Interval::new(known.lower().max(from), known.upper());
            return Some(true);
        }
        if at.upper() >= before.upper() {
            return None;
        }
    }
    None
}

/// Whether an impulse at a rest position is captured, where that is certain; `x` is the distance from that end of
/// the sticking set from which the half swing leads away, `edge` holds the clearances of the edge on the right and on
/// the left.
fn pushed(
    map: &ProvedMap,
    half: usize,
    x: Interval,
    speed: f64,
    edge: [Interval; 2],
) -> Option<bool> {
    let start = StartBox { x, v: Interval::point(speed) };
    let passage = swing(&map.forward.0[half].field, &start);
    let Passage::Arrives(swing) = passage else {
        return (passage == Passage::Never).then_some(false);
    };
    let (after, edge) = (swing.end - map.gap, edge[1 - half]);
    if after < edge.lower() {
        Some(true)
    } else if after > edge.upper() {
        Some(false)
    } else {
        None
    }
}

/// Where to halve an interval of positive values: by their ratio where that is large.
fn halving(over: Interval) -> f64 {
    let (low, high) = (over.lower(), over.upper());
    if high > 4.0 * low {
        (low * high).sqrt()
    } else {
        over.middle()
    }
}

/// An interval from the largest value that is certainly captured to the smallest that certainly is not,
/// infinite where none is found.
fn threshold(hint: Option<f64>, mut captured: impl FnMut(f64) -> Option<bool>) -> Option<Interval> {
    /// Number of increasing strides from the hint in either direction; the largest is a factor of `1.5^128`.
    const STRIDES: i32 = 8;
    let hint = hint.filter(|hint| *hint > 0.0 && hint.is_finite()).unwrap_or(1.0);
    let stride = |index: i32| powi(1.5, 2_i32.pow(index.unsigned_abs()));
    let inward = |index| hint / stride(index);
    let mut safe = (0..STRIDES).map(inward).find(|&at| captured(at) == Some(true))?;
    let lost = (0..STRIDES).map(|index| hint * stride(index)).find(|&at| {
        let answer = captured(at);
        safe = if answer == Some(true) { at } else { safe };
        answer == Some(false)
    });
    let Some(high) = lost else { return Some(Interval::new(safe, f64::INFINITY)) };
    let mut between = |over, counts: fn(Option<bool>) -> Option<bool>| {
        narrowed(over, [&true, &false], halving, |at| counts(captured(at)))
    };
    let over = between(Interval::new(safe, high), |answer| answer);
    // Uncertain values count as not captured for the lower bound, and as captured for the upper.
    let lower = between(over, |answer| Some(answer == Some(true))).lower();
    let upper = between(over, |answer| Some(answer != Some(false))).upper();
    Some(Interval::new(lower, upper))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_threshold_far_below_the_hint_takes_few_halvings() {
        for edge in [0.7, 1e-9, 1e9] {
            let mut asked = 0;
            let found = threshold(Some(1.0), |at| {
                asked += 1;
                Some(at < edge)
            });
            let found = found.unwrap();
            assert!(found.contains(edge) && found.width() < 1e-15 * edge * 2.0, "{edge}: {found}");
            assert!(asked < 90, "{edge}: {asked}");
        }
    }
}
