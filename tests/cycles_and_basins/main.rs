//! All limit cycles and basins, against brute force and against numbers computed elsewhere.

#![expect(clippy::cast_precision_loss, reason = "indices of grids are small")]

mod borders;
mod branches;
mod claims;
#[path = "../data/mod.rs"]
mod data;
#[path = "../explorer/mod.rs"]
mod explorer;
mod extremes;
mod guarantee;
mod interrupts;
mod kicks_at_extremes;
mod precision;
mod properties;
mod references;
mod stiff;

use hopfscope::accuracy::extremes::sets::{LatticeCycle, SetVerdict, judge_set, sets};
use hopfscope::branch::SpecialKind;
use hopfscope::branch::along::{Points, branch};
use hopfscope::flow::trajectory::trajectory;
use hopfscope::flow::{Detail, Fate, Limits, Method, Outcome, Problem};
use hopfscope::model::{HalfPlane, Knob, Parameters, Side, State};
use hopfscope::numerics::elementary::{exp, ln};
use hopfscope::portrait::Portrait;
use hopfscope::portrait::basin::cycle::cycles;
use hopfscope::portrait::basin::{Counts, StartWindow};
use hopfscope::portrait::closing::all::closings;
use hopfscope::portrait::closing::equation::{Equation, Route};
use hopfscope::portrait::closing::half_map::{HalfMap, Length};
use hopfscope::portrait::closing::polish::polish;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};
use rayon::prelude::*;

const LIMITS: Limits = Limits::PATIENT;

/// Random parameter sets from the ranges of interest, the same in every run.
fn parameter_sets(count: usize) -> Vec<Parameters> {
    let strategy = (-0.95..0.5, -1.0..1.0, -1.0..2.0, 1e-3..0.5)
        .prop_map(|(d, d2, d3, r)| Parameters { d, d2, d3, r });
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(proptest::test_runner::Config::default(), rng);
    let mut set = || strategy.new_tree(&mut runner).expect("the ranges are not empty").current();
    (0..count).map(|_| set()).collect()
}

/// Whether a motion that starts with a clearance from the sticking set, first on one side, then on the other,
/// returns with a larger one; each turn is computed forward by two half maps.
fn turn_is_larger(parameters: Parameters, sides: [Side; 2], step: f64) -> impl FnMut(f64) -> bool {
    let mut maps = sides.map(|side| HalfMap::new(HalfPlane::new(&parameters, side), step));
    move |clearance: f64| {
        let mut length = Length::new(clearance);
        for map in &mut maps {
            let swing = map.swing(length, &Limits { evaluations: u64::MAX, ..LIMITS });
            let end = swing.unwrap_or_else(|reason| panic!("{parameters:?}: {reason}")).end.value;
            if end.is_infinite() || end <= 2.0 * parameters.r {
                return end.is_infinite();
            }
            length = Length::new(end - 2.0 * parameters.r);
        }
        length.value > clearance
    }
}

/// Number of sign changes of "the next turn is larger" in a dense scan of starting clearances: the result of a
/// naive search.
fn scanned_cycles(parameters: &Parameters, scan: usize) -> usize {
    let mut grows = turn_is_larger(*parameters, [Side::Upper, Side::Lower], 1e-9);
    let (low, high) = (ln(1e-9), ln(60.0));
    let at = |index: usize| exp(low + (high - low) * index as f64 / scan as f64);
    let signs: Vec<bool> = (0..=scan).map(|index| grows(at(index))).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

#[test]
fn no_cycle_is_missed_against_a_dense_scan() {
    let wrong: Vec<_> = parameter_sets(2000)
        .into_par_iter()
        .filter_map(|parameters| {
            let found = cycles(&parameters, &LIMITS).expect("a search within the budget");
            let inside = |cycle: &&hopfscope::portrait::Cycle| {
                -cycle.q_min - parameters.r < 59.0 && -cycle.q_min - parameters.r > 1e-8
            };
            let expected = scanned_cycles(&parameters, 600);
            let count = found.cycles.iter().filter(inside).count();
            (count != expected).then_some((parameters, count, expected))
        })
        .collect();
    // A pair closer than the scan spacing is found only by the search.
    let missed: Vec<_> = wrong.iter().filter(|(_, count, expected)| count < expected).collect();
    assert!(missed.is_empty(), "{missed:?}");
    let finer = |&(parameters, count, _): &(Parameters, usize, usize)| {
        scanned_cycles(&parameters, 60_000) != count
    };
    let doubtful: Vec<_> = wrong.iter().filter(|case| finer(case)).collect();
    assert!(doubtful.is_empty(), "{doubtful:?}");
}

/// The fate of a start according to its own motion.
fn brute_fate(parameters: &Parameters, initial: State) -> Fate {
    let problem = Problem {
        parameters: *parameters,
        initial,
        until: 2000.0,
        method: Method::Taylor,
        tolerance: 1e-8,
        ..Problem::default()
    };
    match trajectory(&problem, Detail::default(), &LIMITS).outcome {
        Outcome::Captured { .. } => Fate::Rest,
        Outcome::Escaped { .. } => Fate::Escapes,
        Outcome::Moving { .. } => Fate::Moving,
        Outcome::GaveUp { reason, .. } => Fate::Unknown(reason),
    }
}

#[test]
fn ordered_basins_agree_with_brute_force() {
    const GRID: usize = 13;
    let window = StartWindow { q: (-3.0, 3.0), v: (-3.0, 3.0) };
    parameter_sets(60).into_par_iter().for_each(|parameters| {
        let ordered = Portrait::of_oscillator(&parameters, 3.0, &LIMITS).expect("a basin");
        for index in 0..GRID * GRID {
            let place = |index: usize| -3.0 + 6.0 * index as f64 / (GRID - 1) as f64;
            let start = State { q: place(index % GRID), v: place(index / GRID) };
            if near_a_border(&ordered, start) {
                continue;
            }
            // What tends to a cycle never stops moving.
            let told = match ordered.fate(start.q, start.v).unwrap() {
                Fate::Cycle(_) => Fate::Moving,
                fate => fate,
            };
            assert_eq!(told, brute_fate(&parameters, start), "{parameters:?} {start:?}");
        }
        let counts = ordered.count(&window, (GRID, GRID), &LIMITS).unwrap();
        let one_by_one = (0..GRID * GRID).map(|index| {
            let place = |index: usize| -3.0 + 6.0 * index as f64 / (GRID - 1) as f64;
            let fate = ordered.fate(place(index % GRID), place(index / GRID));
            Counts::label(fate.unwrap())
        });
        assert_eq!(counts, Counts::of(&one_by_one.collect::<Vec<_>>()), "{parameters:?}");
    });
}

/// Whether the border passes so close that the end time of brute force cannot decide.
fn near_a_border(basin: &Portrait, start: State) -> bool {
    let fate = basin.fate(start.q, start.v);
    [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3)]
        .iter()
        .any(|(dq, dv)| basin.fate(start.q + dq, start.v + dv) != fate)
}

#[test]
fn few_starts_of_a_wide_window_come_to_rest_beside_a_large_cycle() {
    let parameters = Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 };
    let window = StartWindow { q: (-6.0, 6.0), v: (-6.0, 6.0) };
    let counts = Portrait::of_oscillator(&parameters, 6.0, &LIMITS)
        .unwrap()
        .count(&window, (320, 384), &LIMITS)
        .unwrap();
    assert_eq!(counts, Counts { captured: 358, cycle: 122_522, escaped: 0, undecided: 0 });
}

/// The general search, with half maps integrated by series down to sizes of 1e-9, against the closed form of
/// the piecewise linear cycle.
#[test]
fn the_general_path_gives_the_piecewise_linear_cycle_to_twelve_digits() {
    let r = 0.5;
    for d in [-0.999_999, -0.999, -0.99, -0.7, -0.1, -1e-3, -1e-6, -1e-12] {
        let parameters = Parameters { d, d2: 0.0, d3: 0.0, r };
        let mut equation = Equation::on_side(&parameters, Side::Upper, f64::EPSILON, &LIMITS);
        equation.maps.iter_mut().flatten().for_each(|map| map.linear_below = 1e-9);
        let found = closings(&mut equation, usize::MAX, &[]).unwrap();
        assert_eq!(found.len(), 1, "D = {d}");
        equation.want_fastest();
        let route = if d < -0.2 { Route::Backward } else { Route::Mixed };
        let closing = equation.at(route, found[0].node.at).unwrap();
        let cycle = closing.describe(&parameters, Side::Upper);
        let exact = &cycles(&parameters, &LIMITS).unwrap().cycles[0];
        let compare = |name: &str, one: f64, other: f64| {
            assert!((one / other - 1.0).abs() < 1e-12, "D = {d}: {name} {one:e} for {other:e}");
        };
        if exact.clearance > 0.0 {
            compare("clearance", cycle.clearance, exact.clearance);
        }
        compare("log clearance", cycle.log_clearance, exact.log_clearance);
        compare("v_max", cycle.v_max, exact.v_max);
        compare("period", cycle.period, exact.period);
        compare("log multiplier", cycle.log_multiplier, exact.log_multiplier);
    }
}

#[test]
fn folds_lie_where_they_were_computed_elsewhere() {
    let table: serde_json::Value =
        serde_json::from_str(include_str!("../data/folds.json")).expect("a table of folds");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let fold = |d2: f64, d3: f64, r: f64| {
        let parameters = Parameters { d: 0.0, d2, d3, r };
        let found =
            branch(&parameters, Knob::D, (-0.95, 0.1), Points::Even(40), 1e-10, &LIMITS).unwrap();
        *found.special.iter().find(|special| special.kind == SpecialKind::Fold).expect("a fold")
    };
    for row in table["folds"].as_array().expect("rows") {
        let (kappa, expected) = (number(&row["kappa"]), number(&row["D_F"]));
        let digits = if [0.01, 0.25].contains(&kappa) { 1e-11 } else { 1e-8 };
        for r in [0.1, 1.0] {
            let value = fold(0.0, kappa / (r * r), r).value;
            assert!((value - expected).abs() < digits, "kappa {kappa}, r {r}: {value}");
        }
    }
    let with_d2 = fold(0.2, 0.5, 0.1);
    assert!((with_d2.value - number(&table["with_D2"]["D"])).abs() < 1e-12, "{}", with_d2.value);
    assert!((with_d2.q_max.unwrap() - number(&table["with_D2"]["q_max"])).abs() < 1e-9);
    // Asymmetric damping moves the fold, which (48) ignores.
    let shifted = [0.0, 0.2, 0.5].map(|d2| fold(d2, 0.01, 0.1).value);
    assert!(shifted[0] > shifted[1] && shifted[1] > shifted[2], "{shifted:?}");
    // On either side of the fold, by motions: below, some turn grows; above, every turn shrinks.
    for (d2, value) in [(0.2, shifted[1]), (0.5, shifted[2])] {
        let grows = |d: f64| {
            let parameters = Parameters { d, d2, d3: 0.01, r: 0.1 };
            (0..800).any(|index| turn_grows(&parameters, 0.5 + 0.005 * f64::from(index)))
        };
        assert!(grows(value - 1e-5) && !grows(value + 1e-5), "D2 = {d2}");
    }
}

/// Whether a motion from rest at `q0` returns to its side further out.
fn turn_grows(parameters: &Parameters, q0: f64) -> bool {
    let problem = Problem {
        parameters: *parameters,
        initial: State { q: q0, v: 0.0 },
        until: 8.0,
        method: Method::Dop853,
        tolerance: 1e-12,
        ..Problem::default()
    };
    let motion = trajectory(&problem, Detail::default(), &LIMITS);
    motion.crossings.get(1).is_some_and(|crossing| crossing.q > q0)
}

/// A cycle whose left side separates capture and escape by less than rounding: a turn multiplies distances by 1e479.
const STEEP: Parameters = Parameters {
    d: 0.292_034_178_266_773_2,
    d2: 0.871_353_162_855_809,
    d3: -0.017_019_423_100_261_534,
    r: 0.260_314_952_809_726_05,
};

#[test]
fn every_cycle_lies_between_motions_that_come_closer_and_motions_that_go_further() {
    /// Relative distance from the cycle at which motions start, and the magnitude of the logarithm of the multiplier
    /// above which their difference exceeds their error.
    const BESIDE: f64 = 1e-4;
    const CLEAR: f64 = 1e-3;
    let wrong = |parameters: &Parameters| -> Vec<hopfscope::portrait::Cycle> {
        let found = cycles(parameters, &LIMITS).expect("a search within the budget");
        let mut grows = turn_is_larger(*parameters, [Side::Lower, Side::Upper], 1e-13);
        let clear = found.cycles.into_iter().filter(|cycle| cycle.log_multiplier.abs() > CLEAR);
        clear
            .filter(|cycle| {
                let beside = [-BESIDE, BESIDE].map(|part| grows(cycle.clearance * (1.0 + part)));
                beside != [cycle.stable, !cycle.stable]
            })
            .collect()
    };
    let sets: Vec<_> = parameter_sets(1000).into_iter().chain([STEEP]).collect();
    let all: Vec<_> = sets.par_iter().map(|set| (set, wrong(set))).collect();
    let failed: Vec<_> = all.iter().filter(|(_, wrong)| !wrong.is_empty()).collect();
    assert!(failed.is_empty(), "{failed:?}");
}

/// The cycles of the lattice of extremes. Beside each, motions are followed where possible: where the
/// multiplier keeps their difference significant and the clearance is representable.
fn check_extreme_cycles(sets: Vec<Parameters>, most_given_up: usize) {
    const BESIDE: f64 = 1e-4;
    let verdicts: Vec<SetVerdict> =
        sets.into_par_iter().map(|set| judge_set(&set, &LIMITS)).collect();
    let wrong = |verdict: &SetVerdict, found: &LatticeCycle| {
        let cycle = found.cycle;
        let mut broken = !(found.residual <= 1e-9
            && cycle.log_multiplier.is_finite()
            && cycle.period > 0.0
            && cycle.period.is_finite()
            && cycle.q_min < cycle.q_max
            && cycle.stable == (cycle.log_multiplier < 0.0));
        if (1e-3..600.0).contains(&cycle.log_multiplier.abs()) && cycle.clearance.is_normal() {
            let mut grows = turn_is_larger(verdict.parameters, [Side::Lower, Side::Upper], 1e-13);
            let beside = [-BESIDE, BESIDE].map(|part| grows(cycle.clearance * (1.0 + part)));
            broken |= beside != [cycle.stable, !cycle.stable];
        }
        broken
    };
    let failed: Vec<_> = verdicts
        .par_iter()
        .filter(|verdict| verdict.cycles().iter().any(|found| wrong(verdict, found)))
        .collect();
    assert!(failed.is_empty(), "{} of {}: {failed:#?}", failed.len(), verdicts.len());
    let gave_up = |it: &&SetVerdict| it.answer.is_err();
    let given_up: Vec<_> = verdicts.iter().filter(gave_up).collect();
    assert!(given_up.len() <= most_given_up, "{given_up:?}");
}

#[test]
fn cycles_at_the_extremes_are_answered_and_right() {
    check_extreme_cycles(sets(true).collect(), 2);
}

#[test]
#[ignore = "long: all 1,500 sets of the lattice"]
fn all_cycles_at_the_extremes_are_answered_and_right() {
    // D2 = 1e6, D3 = -1e-12, r = 1, with abs(D) next to 1 or beyond, gives up.
    check_extreme_cycles(sets(false).collect(), 8);
}

/// Where D2 and D3 < 0 alone are decisive, the left turning point is the maximum of `D2 v^2 - abs(D3) v^3`,
/// `4 D2^3/(27 D3^2)`. The largest velocity is `D2/abs(D3)`, and the slow motions take 1/6 and 5/6 of
/// `D2^2/abs(D3)`, the integrals of `dx/v` along `D2 v^2 -+ abs(D3) v^3`.
#[test]
fn a_relaxation_by_d2_turns_where_its_slow_curve_does() {
    for d in [-0.1, 0.0, 0.5] {
        for r in [1e-12, 1.0, 1e12] {
            let parameters = Parameters { d, d2: 1e6, d3: -1e-12, r };
            let found = cycles(&parameters, &LIMITS).unwrap().cycles;
            let outermost = found.last().unwrap();
            if (d, r) == (-0.1, 1e-12) {
                // Such a small cycle is that of linear damping.
                assert!((outermost.q_max / 6.386_823e-12 - 1.0).abs() < 1e-5);
                continue;
            }
            assert!((outermost.q_min / (-4.0 / 27.0 * 1e42) - 1.0).abs() < 1e-11);
            assert!((outermost.v_max / 1e18 - 1.0).abs() < 1e-11);
            assert!((outermost.period / 1e24 - 1.0).abs() < 1e-11);
        }
    }
}

#[test]
fn a_fold_and_the_escape_point_end_the_branches_that_lead_to_them() {
    let parameters = Parameters { d: 0.0, d2: 0.3, d3: 0.0, r: 0.5 };
    let found =
        branch(&parameters, Knob::D, (-0.95, 0.2), Points::Even(60), 1e-10, &LIMITS).unwrap();
    let escape = found.special.iter().find(|special| special.kind == SpecialKind::Escape).unwrap();
    let largest = found.pieces[0].iter().map(|point| point.value).fold(f64::MIN, f64::max);
    assert!(largest < escape.value && escape.value - largest < 1e-3);
    // Points of a branch are cycles: the search finds them again at their own parameter.
    for point in found.pieces[0].iter().step_by(7) {
        let there = Parameters { d: point.value, ..parameters };
        let cycle = &cycles(&there, &LIMITS).unwrap().cycles[0];
        assert!((cycle.q_max / point.cycle.q_max - 1.0).abs() < 1e-9);
    }
}

#[test]
fn the_branch_over_cubic_damping_ends_before_its_cycles_become_uncertain() {
    // Which cycle passes D3 = 0, if any; the other one comes from infinity there.
    for (d, d2, passes) in [
        (-0.3, 0.0, Some(false)),
        (-0.3, 0.2, Some(false)),
        (0.3, -0.5, None),
        (0.3, 0.0, None),
        (0.3, 0.2, None),
        (0.0, 0.0, None),
    ] {
        let parameters = Parameters { d, d2, d3: 0.0, r: 0.1 };
        let found =
            branch(&parameters, Knob::D3, (-1.0, 1.0), Points::Even(60), 1e-10, &LIMITS).unwrap();
        assert!(!found.pieces.is_empty());
        let points = || found.pieces.iter().flatten();
        for point in points() {
            let there = Parameters { d3: point.value, ..parameters };
            let cycles = cycles(&there, &LIMITS).unwrap().cycles;
            let cycle = cycles.iter().find(|cycle| cycle.stable == point.cycle.stable).unwrap();
            for (one, other) in [(cycle.q_max, point.cycle.q_max), (cycle.q_min, point.cycle.q_min)]
            {
                assert!((one / other - 1.0).abs() < 1e-6, "D = {d}, D2 = {d2}, {point:?}");
            }
        }
        let nearest = |stable: bool| {
            let near = points().filter(|point| point.cycle.stable == stable);
            near.map(|point| point.value.abs()).fold(f64::INFINITY, f64::min)
        };
        for stable in [false, true] {
            assert!(nearest(stable) > 1e-5 || passes == Some(stable), "D = {d}, D2 = {d2}");
        }
        if passes == Some(false) {
            let smallest = |stable: bool| {
                let values = points().filter(|point| point.cycle.stable == stable);
                values.map(|point| point.value).fold(f64::INFINITY, f64::min)
            };
            assert_eq!(smallest(false), -1.0);
            assert!(smallest(true) > 0.0 && smallest(true) < 1e-3);
        }
    }
}
