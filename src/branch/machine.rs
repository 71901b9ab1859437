//! The cycles of a machine along one of its numbers, the places where its portrait changes, and the jumps there.
//!
//! Each change but the fold is the zero of a number that one or two integrations give: the damping at rest
//! (Hopf), and left turning points of the orbits that the belt's line singles out. A fold is where the return
//! map touches the diagonal: the extremum of its growth vanishes.

use rayon::prelude::*;

use super::{Jump, JumpEnd, Jumps, Special, SpecialKind};
use crate::flow::{Cost, Fate, Flow, Limits, Result};
use crate::model::{ContactState, Knob, Model, Phase, Source};
use crate::numerics::{PlaceTolerance, by_number, exp, illinois, ln, real, try_bisect};
use crate::portrait::{Border, Cycle, Landmarks, Node, Portrait, evenly};

/// A value of a number, in SI units, and what a machine does there, or why there is no answer.
#[derive(Clone, Debug, PartialEq)]
pub struct PortraitPoint {
    pub value: f64,
    pub found: Result<Portrait>,
}

/// What a machine does along a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineBranch {
    pub points: Vec<PortraitPoint>,
    /// Where the portrait changes, in the order of the points.
    pub special: Vec<Special>,
    /// Cost of the points; locating the changes between them is not counted.
    pub cost: Cost,
}

impl MachineBranch {
    /// Follows the cycles of a machine along one of its numbers, through `count` evenly spaced values on all cores. Unless
    /// `beside` is `None`, changes are located, and each has further points at these parts of the distance between two
    /// values. Ends early where it is interrupted.
    ///
    /// # Errors
    /// One line where the machine's law has no such number.
    pub fn along(
        source: &Source,
        varied: Knob,
        range: (f64, f64),
        (count, beside): (usize, Option<&[f64]>),
        limits: &Limits,
    ) -> Result<Self, String> {
        let family = Family { source, varied, limits };
        let mut points = family.portraits(evenly(range, count).collect())?;
        let changes = beside.map_or_else(Vec::new, |_| family.all_changes(&points));
        let special = changes.iter().map(|change| change.special).collect();
        if let Some(beside) = beside.filter(|parts| !parts.is_empty()) {
            let step = (range.1 - range.0) / real(count - 1);
            let around = |change: &Change| {
                let value = change.special.value;
                beside.iter().map(move |part| value + part * step).collect::<Vec<_>>()
            };
            let within = |value: &f64| (range.0..=range.1).contains(value);
            let further = changes.iter().flat_map(around).filter(within).collect();
            points.extend(family.portraits(further)?);
            // Nearer are those by which the changes were told.
            let outer = |change: Change| change.beside.into_iter().step_by(ASIDE.len() - 1);
            let known = changes.into_iter().flat_map(outer).filter(|(value, _)| within(value));
            let point = |(value, found)| Some(PortraitPoint { value, found: Ok(found?) });
            points.extend(known.filter_map(point));
            points.sort_by(by_number(|point: &PortraitPoint| point.value));
        }
        let mut cost = Cost::default();
        points.iter().flat_map(|point| &point.found).for_each(|found| cost += found.cost);
        Ok(MachineBranch { points, special, cost })
    }
}

/// A machine while one of its numbers varies.
struct Family<'a> {
    source: &'a Source,
    varied: Knob,
    limits: &'a Limits<'a>,
}

/// A value at which the portrait is known.
struct PortraitPlace<'a> {
    value: f64,
    portrait: &'a Portrait,
    functions: TestFunctions,
}

/// A change, with the portraits next to it, at the distances of [`ASIDE`].
struct Change {
    special: Special,
    beside: Vec<(f64, Option<Portrait>)>,
}

/// How far from a change one looks at what it changes, in units of the distance between two values.
const ASIDE: [f64; 4] = [-1e-4, -1e-6, 1e-6, 1e-4];

impl Family<'_> {
    /// The model at a value. Where the branch is interrupted there is none, and the search for a change ends at once.
    fn model(&self, value: f64) -> Option<Model> {
        self.limits.go_on().ok()?;
        self.source.with(self.varied, value).ok()?.model().ok()
    }

    fn portrait(&self, value: f64) -> Option<Portrait> {
        Portrait::of(&self.model(value)?).ok()
    }

    fn portraits(&self, values: Vec<f64>) -> Result<Vec<PortraitPoint>, String> {
        let portrait = |value| {
            let found = self.source.with(self.varied, value)?.portrait();
            Ok(PortraitPoint { value, found })
        };
        let wanted = |_: &f64| !(self.limits.interrupted)();
        values.into_par_iter().filter(wanted).map(portrait).collect()
    }

    /// The test functions at a value; `None` where there is no model, or its law ends before.
    fn test_functions(&self, value: f64) -> Option<TestFunctions> {
        let model = self.model(value)?;
        let landmarks = Flow::new(&model).landmarks().ok()?;
        Some(test_functions(&model, landmarks))
    }

    /// All changes, in the order of these portraits.
    fn all_changes(&self, portraits: &[PortraitPoint]) -> Vec<Change> {
        let places = portraits.par_iter().map(|PortraitPoint { value, found }| {
            let portrait = found.as_ref().ok()?;
            let functions = test_functions(&portrait.model, portrait.landmarks);
            Some(PortraitPlace { value: *value, portrait, functions })
        });
        let places: Vec<_> = places.collect();
        let changes = |pair: &[Option<PortraitPlace>]| match pair {
            [Some(left), Some(right)] => self.changes(left, right),
            _ => Vec::new(),
        };
        places.par_windows(2).flat_map_iter(changes).collect()
    }

    /// The changes between two neighbouring values, in their order.
    fn changes(&self, left: &PortraitPlace, right: &PortraitPlace) -> Vec<Change> {
        let step = right.value - left.value;
        let zero_of = |index: usize| {
            let ends = [left.functions[index]?, right.functions[index]?];
            if (ends[0].number > 0.0) == (ends[1].number > 0.0) {
                return None;
            }
            let of = |value| match ends[0].kind {
                // It takes no motion.
                SpecialKind::Hopf => Some(self.model(value)?.damping),
                _ => Some(self.test_functions(value)?[index]?.number),
            };
            let ends = [(left.value, ends[0].number), (right.value, ends[1].number)];
            let value = zero(&of, ends)?;
            let TestFunction { kind, q_max, .. } = self.test_functions(value)?[index]?;
            Some(self.change(&Special { q_max, ..Special::new(kind, value, None) }, step))
        };
        let distance = |change: &Change| (change.special.value - left.value).abs();
        let mut found: Vec<Change> = (0..left.functions.len()).filter_map(zero_of).collect();
        found.sort_by(by_number(distance));
        // Between these the portrait keeps its form, unless cycles fold.
        let mut folds = Vec::new();
        let mut begin = Some((left.value, left.portrait));
        let ends = found.iter().map(|Change { beside, .. }| {
            [&beside[1], &beside[2]].map(|(value, found)| Some((*value, found.as_ref()?)))
        });
        for [before, after] in ends.chain([[Some((right.value, right.portrait)), None]]) {
            folds.extend(begin.zip(before).and_then(|(one, other)| self.fold(one, other)));
            begin = after;
        }
        found.extend(folds.iter().map(|fold| self.change(fold, step)));
        found.sort_by(by_number(distance));
        found
    }

    /// A change with the portraits beside it, from which the stable states that end there are read off.
    fn change(&self, special: &Special, step: f64) -> Change {
        let beside = ASIDE.into_par_iter().map(|part| {
            let value = special.value + part * step;
            (value, self.portrait(value))
        });
        let beside: Vec<_> = beside.collect();
        let all: Option<Vec<&Portrait>> = beside.iter().map(|(_, it)| it.as_ref()).collect();
        let jumps = all.map_or_else(Jumps::default, |all| {
            let ways = [[0, 1, 2, 3], [3, 2, 1, 0]].map(|way| lasting_jump(way.map(|at| all[at])));
            let [up, down] = if step > 0.0 { ways } else { [ways[1], ways[0]] };
            Jumps { up, down }
        });
        Change { special: Special { jumps: Some(jumps), ..*special }, beside }
    }

    /// The fold between two places where the numbers of stable and of unstable cycles both differ by one.
    fn fold(&self, left: (f64, &Portrait), right: (f64, &Portrait)) -> Option<Special> {
        /// Halvings that bring the portraits near the fold.
        const NEAR: u32 = 12;
        if count(left.1) == count(right.1) {
            return None;
        }
        let falls = left.1.cycles.len() > right.1.cycles.len();
        let (with, without) = if falls { (left, right) } else { (right, left) };
        let (wanted, mut nearest) = (count(with.1), with.1.clone());
        let (without, with) = try_bisect(without.0, with.0, NEAR, |value| {
            let portrait = self.portrait(value).ok_or(())?;
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
        let pair = pairs.min_by(by_number(gap))?;
        let (low, high) = (pair[0].q_max, pair[1].q_max);
        let extremum = |value: f64| -> Option<Node> {
            steepest(&self.model(value)?, (low * high).sqrt(), ln(high / low))
        };
        let height = |value| Some(extremum(value)?.value);
        let value = zero(&height, [(with, height(with)?), (without, height(without)?)])?;
        let q_max = Some(exp(extremum(value)?.at));
        Some(Special { q_max, ..Special::new(SpecialKind::Fold, value, None) })
    }
}

/// A test function of bifurcations: its zero is a change of this kind; with the right turning point of the cycle there.
#[derive(Clone, Copy)]
struct TestFunction {
    number: f64,
    kind: SpecialKind,
    q_max: Option<f64>,
}

/// The test functions of all changes but folds, each at its own index; `None` where one does not exist.
type TestFunctions = [Option<TestFunction>; 5];

/// Computes them from the landmarks of the return map.
fn test_functions(model: &Model, landmarks: Option<Landmarks>) -> TestFunctions {
    let function =
        |kind, q_max, number: Option<f64>| Some(TestFunction { number: number?, kind, q_max });
    let unheld = model.guide_static <= 0.0;
    let hopf = function(SpecialKind::Hopf, None, unheld.then_some(model.damping));
    let Some(Landmarks { lines, touch, grazing, released, low_left, beyond }) = landmarks else {
        return [hopf, None, None, None, None];
    };
    let mut flow = Flow::new(model);
    let mut left = |right: f64| {
        let place = ContactState::Slips(Phase::Below);
        let turn = flow.turn(place, (right, 0.0), &mut |_| {}).ok()?;
        (!turn.rests).then_some(turn.x)
    };
    // What comes to rest on the left would have turned where the guide lets go.
    let held = -model.guide_static;
    let of = |right: f64, left: Option<f64>| left.filter(|_| right > 0.0).unwrap_or(held);
    let after_touch = of(grazing.x, left(grazing.x.max(model.guide_static)));
    let after_release = released.map(|right| of(right, left(right)));
    // The next left turning points of the orbit that touches the line, as if it slipped, and of the one that the belt
    // releases, less the last one.
    let touching = after_touch - grazing.left;
    let ending = after_release.unwrap_or(held) - grazing.left;
    let rides = ending <= 0.0;
    // Whether static friction exceeds the kinetic one.
    let jumps = lines.release > lines.fold;
    // A touch of an unstable cycle is where the stick-slip cycle ends.
    let ends = !jumps && grazing.log_slope > 0.0;
    let at_touch = if ends {
        SpecialKind::Annihilation
    } else {
        SpecialKind::Grazing
    };
    // What is released comes to the lower end of the stick band, or to where motions do not stick any more.
    let overtaking = after_release.filter(|_| rides).map(|left| left - low_left);
    let unsticking = released.filter(|_| rides).zip(beyond).map(|(right, last)| right - last);
    [
        hopf,
        function(at_touch, touch, Some(touching)),
        function(SpecialKind::Annihilation, released, jumps.then_some(ending)),
        function(SpecialKind::Overtaking, released, overtaking),
        function(SpecialKind::Unsticking, released, unsticking),
    ]
}

/// The zero of a function between two values of different sign; `None` where the function does not exist on
/// the way.
fn zero(function: &dyn Fn(f64) -> Option<f64>, ends: [(f64, f64); 2]) -> Option<f64> {
    /// Relative width to which a special value is narrowed.
    const WIDTH: f64 = 4.0 * f64::EPSILON;
    let function = |value| function(value).ok_or(());
    illinois(ends, 0.0, PlaceTolerance::Relative(WIDTH), function).ok().map(|ends| ends[0].0)
}

/// How many cycles there are, of each kind; a fold takes one of each stability.
fn count(portrait: &Portrait) -> (usize, usize, bool) {
    let stable = portrait.cycles.iter().filter(|cycle| cycle.stable).count();
    (stable, portrait.cycles.len() - stable, portrait.border == Border::NoBasin)
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

/// The jump from one machine to the next, of four in a row of which the middle ones are much closer to a change. What
/// shrinks with the distance, as a cycle does that is born at rest, is not a jump.
fn lasting_jump([far, near, next, beyond]: [&Portrait; 4]) -> Option<Jump> {
    let (far, near) = (jump(far, beyond)?, jump(near, next)?);
    (near.size() > 0.5 * far.size()).then_some(near)
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
        let end = match to.fate(state.max(KICK * size), 0.0).unwrap_or_else(Fate::Unknown) {
            Fate::Rest => JumpEnd::Rest,
            Fate::Cycle(index) => JumpEnd::Cycle { q_max: to.cycles[index].q_max },
            Fate::Neutral => return None,
            Fate::Escapes => JumpEnd::Escaped,
            Fate::Moving | Fate::Unknown(_) => JumpEnd::Unknown,
        };
        Some(Jump { from: state, to: end }).filter(|jump| jump.size() > MOVED * size)
    })
}
