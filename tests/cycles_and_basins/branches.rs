//! Along any parameter and over any range, a branch lies in its range, follows its curves, and is made of the cycles
//! that are there.

use hopfscope::branch::along::{Points, branch};
use hopfscope::branch::fold::fold;
use hopfscope::branch::{Branch, BranchPoint, SpecialKind};
use hopfscope::flow::Limits;
use hopfscope::model::{Knob, Parameters};
use hopfscope::numerics::elementary::pow;
use hopfscope::portrait::basin::cycle::cycles;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};
use rayon::prelude::*;

const LIMITS: Limits = Limits::PATIENT;

/// A branch to be followed.
#[derive(Clone, Copy, Debug)]
struct Path {
    parameters: Parameters,
    symbol: Knob,
    range: (f64, f64),
}

fn set(parameters: &Parameters, symbol: Knob, value: f64) -> Parameters {
    parameters.with(symbol, value)
}

/// Numbers over several powers of ten, 0 and both signs among them.
fn damping() -> impl Strategy<Value = f64> {
    let size = || (-3.0..1.5).prop_map(|power: f64| pow(10.0, power));
    prop_oneof![1 => Just(0.0), 2 => size(), 2 => size().prop_map(|size| -size)]
}

fn path() -> impl Strategy<Value = Path> {
    let d = prop_oneof![-0.99..0.2, -0.3..0.0];
    let friction = (-3.0..1.0).prop_map(|power: f64| pow(10.0, power));
    let ends = (0.0..1.0, 0.0..1.0).prop_filter("a range", |(one, other): &(f64, f64)| one < other);
    let symbol = prop::sample::select(&[Knob::D, Knob::D2, Knob::D3, Knob::R][..]);
    (d, damping(), damping(), friction, symbol, ends, -1.0..1.5).prop_map(
        |(d, d2, d3, r, symbol, (one, other), power)| {
            let parameters = Parameters { d, d2, d3, r };
            let size = pow(10.0, power);
            let range = match symbol {
                Knob::D => (-0.99 + 1.2 * one, -0.99 + 1.2 * other),
                Knob::R => (size * one, size * other),
                _ => (size * (2.0 * one - 1.0), size * (2.0 * other - 1.0)),
            };
            Path { parameters, symbol, range }
        },
    )
}

/// Random branches, the same in every run, and two that once left their range.
fn paths(count: usize) -> Vec<Path> {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(proptest::test_runner::Config::default(), rng);
    let mut next = || path().new_tree(&mut runner).expect("the ranges are not empty").current();
    let mut all: Vec<Path> = (0..count).map(|_| next()).collect();
    let known = [(0.5, 0.1, (0.001, 100.0)), (0.0, -100.0, (0.1, 10.0))];
    all.extend(known.map(|(d2, d3, range)| Path {
        parameters: Parameters { d: -0.9, d2, d3, r: 0.1 },
        symbol: Knob::R,
        range,
    }));
    all
}

/// What is wrong with a branch, if anything.
fn complaint(path: &Path, points: Points) -> Option<String> {
    let Path { parameters, symbol, range } = *path;
    let found = match branch(&parameters, symbol, range, points, 1e-10, &LIMITS) {
        Err(reason) => return Some(format!("no answer: {reason}")),
        Ok(found) => found,
    };
    let inside = |value: f64| (range.0..=range.1).contains(&value);
    if let Some(point) = found.pieces.iter().flatten().find(|point| !inside(point.value)) {
        return Some(format!("a row outside: {}", point.value));
    }
    if let Some(special) = found.special.iter().find(|special| !inside(special.value)) {
        return Some(format!("outside: {special:?}"));
    }
    let strays = found.pieces.iter().find_map(|piece| out_of_order(path, piece));
    strays.or_else(|| no_cycles(path, &found, points)).or_else(|| no_folds(path, &found)).or_else(
        || {
            if points == Points::Followed {
                None
            } else {
                ends_missed(path, &found)
            }
        },
    )
}

/// Along a curve the parameter turns back only where the stability changes, and for a given clearance one value of D, D3
/// or r closes a cycle.
fn out_of_order(path: &Path, piece: &[BranchPoint]) -> Option<String> {
    let ways = piece.windows(2).filter_map(|pair| {
        let [one, other] = pair else { return None };
        let blur = 1e-12 * (path.range.1 - path.range.0);
        let apart = (one.value - other.value).abs() > blur;
        let alike = one.cycle.stable == other.cycle.stable && apart;
        alike.then_some(((one.value < other.value) == one.cycle.stable, one.value))
    });
    let ways: Vec<(bool, f64)> = ways.collect();
    if let Some(turn) = ways.windows(2).find(|pair| pair[0].0 != pair[1].0) {
        return Some(format!("turns back at {}", turn[1].1));
    }
    if path.symbol == Knob::D2 {
        return None;
    }
    // The clearance of the first swing, in whose frame D2 is not negative.
    let clearance = |point: &BranchPoint| {
        let r = set(&path.parameters, path.symbol, point.value).r;
        let far = if path.parameters.d2 < 0.0 {
            point.cycle.q_max
        } else {
            -point.cycle.q_min
        };
        (far - r, 1e-12 * far + 1e-9 * (far - r))
    };
    let ways: Vec<bool> = piece
        .windows(2)
        .filter_map(|pair| {
            let [(one, blur), (other, more)] = [clearance(&pair[0]), clearance(&pair[1])];
            ((one - other).abs() > blur + more).then_some(one < other)
        })
        .collect();
    ways.windows(2).any(|pair| pair[0] != pair[1]).then(|| format!("goes back in size: {ways:?}"))
}

/// At both ends of the range every cycle is a row.
fn ends_missed(path: &Path, found: &Branch) -> Option<String> {
    [path.range.0, path.range.1].into_iter().find_map(|end| {
        let there = set(&path.parameters, path.symbol, end);
        let all = cycles(&there, &LIMITS).ok()?.cycles;
        let rows = found.pieces.iter().flatten().filter(|point| point.value == end).count();
        (rows != all.len()).then(|| format!("{rows} rows at {end} for {all:?}"))
    })
}

/// Every row is a cycle that the search finds there.
fn no_cycles(path: &Path, found: &Branch, points: Points) -> Option<String> {
    // What is followed for a picture is known as well as the parameter, which is relative to the range.
    let slack = if points == Points::Followed { 1e-3 } else { 1e-10 };
    let rows: Vec<&BranchPoint> = found.pieces.iter().flatten().collect();
    rows.into_iter().find_map(|row| {
        let there = set(&path.parameters, path.symbol, row.value);
        let all = match cycles(&there, &LIMITS) {
            Err(reason) => return Some(format!("{there:?}: {reason}")),
            Ok(found) => found.cycles,
        };
        let same = all.iter().any(|it| {
            let errors = it.errors.unwrap().log_clearance + row.cycle.errors.unwrap().log_clearance;
            (it.log_clearance - row.cycle.log_clearance).abs() <= errors + slack
        });
        (!same).then(|| format!("no such cycle: {row:?} among {all:?}"))
    })
}

/// Every fold is that of the two equations of a fold.
fn no_folds(path: &Path, found: &Branch) -> Option<String> {
    let folds = found.special.iter().filter(|special| special.kind == SpecialKind::Fold);
    folds.filter(|special| !special.kind.grazes(special.cycle.as_ref())).find_map(|special| {
        let there = set(&path.parameters, path.symbol, special.value);
        let Ok((Some(fold), _)) = fold(&there, &LIMITS) else {
            return Some(format!("no fold at {there:?}"));
        };
        let apart = (fold.d - there.d).abs();
        (apart > 1e-8 * there.d.abs()).then(|| format!("{special:?}: fold at {}", fold.d))
    })
}

#[test]
fn rows_lie_in_the_range_follow_the_curve_and_are_cycles() {
    let paths = paths(200);
    let complaints: Vec<String> = paths
        .par_iter()
        .flat_map_iter(|path| {
            [Points::Even(9), Points::Followed].into_iter().filter_map(move |points| {
                complaint(path, points).map(|what| format!("{what}\n    {path:?} {points:?}"))
            })
        })
        .collect();
    let (count, text) = (complaints.len(), complaints.join("\n"));
    assert!(complaints.is_empty(), "{count} of {}:\n{text}", 2 * paths.len());
}
