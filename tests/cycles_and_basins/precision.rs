//! Cycles, branches and folds at the limits of doubles: next to folds and to escape, at large multipliers, and
//! where a cycle grazes the sticking set. Reference values: `tests/data/cycles_to_digits.csv`, from an
//! independent program in quadruple precision (Taylor series of order 40, residuals closed to 1e-29).

use hopfscope::branch::along::{Points, branch};
use hopfscope::branch::escape::escape_point;
use hopfscope::branch::fold::{border, fold};
use hopfscope::branch::{Branch, SpecialKind};
use hopfscope::flow::Limits;
use hopfscope::model::{Knob, Parameters};
use hopfscope::portrait::Cycle;
use hopfscope::portrait::basin::cycle::cycles;
use rayon::prelude::*;

const LIMITS: Limits = Limits::PATIENT;

fn set([d, d2, d3, r]: [f64; 4]) -> Parameters {
    Parameters { d, d2, d3, r }
}

fn found(parameters: [f64; 4]) -> Vec<Cycle> {
    let answer = cycles(&set(parameters), &LIMITS);
    answer.unwrap_or_else(|reason| panic!("{parameters:?}: {reason}")).cycles
}

/// Each number of each cycle is within its own error estimate of the reference, and the overall error covers each.
#[test]
fn errors_are_never_below_the_true_ones() {
    let rows: Vec<Vec<f64>> = include_str!("../data/cycles_to_digits.csv")
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert!(rows.len() > 250);
    let wrong: Vec<String> = rows
        .par_iter()
        .filter_map(|row| {
            let [d, d2, d3, r, q_min, q_max, v_min, v_max, period, log_multiplier, clearance] =
                row[..]
            else {
                return Some(format!("{row:?}"));
            };
            let all = found([d, d2, d3, r]);
            let apart = |cycle: &Cycle| (cycle.q_max - q_max).abs() + (cycle.q_min - q_min).abs();
            let near = all.iter().min_by(|one, other| apart(one).total_cmp(&apart(other)))?;
            let errors = near.errors.unwrap();
            let checks = [
                (near.q_min, q_min, errors.q_min),
                (near.q_max, q_max, errors.q_max),
                (near.v_min, v_min, errors.v_min),
                (near.v_max, v_max, errors.v_max),
                (near.period, period, errors.period),
                (near.log_multiplier, log_multiplier, errors.log_multiplier),
                (near.clearance, clearance, errors.log_clearance * clearance),
            ];
            // An error of NaN covers nothing.
            let covered =
                checks.iter().all(|(value, truth, error)| (value - truth).abs() <= *error);
            let relative = checks[..5].iter().chain(&checks[6..]);
            let uncovered = relative
                .clone()
                .any(|(value, truth, _)| (value / truth - 1.0).abs() > near.error.unwrap());
            (!covered || uncovered || near.error.unwrap() > 0.1)
                .then(|| format!("{row:?} {near:?}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{} of {}: {wrong:#?}", wrong.len(), rows.len());
}

/// With D3 = 0 one cycle repels below `D_c`, and there is none above, however near.
#[test]
fn the_cycle_lives_up_to_the_escape_point_and_no_further() {
    for (d2, r) in [(1.0, 1.0), (0.168, 0.185), (0.004_155_840_696_472_669_5, 1.0)] {
        let escape = escape_point(&set([0.0, d2, 0.0, r]), &LIMITS).unwrap().0.unwrap();
        for gap in [1e-3, 1e-7, 1e-10, 1e-13] {
            let below = found([escape * (1.0 + gap), d2, 0.0, r]);
            assert_eq!(below.len(), 1, "D2 = {d2}, {gap:e} below {escape}: {below:?}");
            assert!(!below[0].stable && below[0].error.unwrap() < 1e-6, "{below:?}");
            let above = found([escape * (1.0 - gap), d2, 0.0, r]);
            assert!(above.is_empty(), "D2 = {d2}, {gap:e} above {escape}: {above:?}");
        }
    }
    assert_eq!(found([-0.003_315_879_725_821_537_7, 0.004_155_840_696_472_669_5, 0.0, 1.0]), []);
    assert_eq!(found([-1e-30, 1.0, 0.0, 1e-18]), []);
}

/// Two cycles just below a fold and none just above.
#[test]
fn cycles_are_two_below_a_fold_and_none_above() {
    for (d2, d3, r) in [(0.0, 0.5, 0.1), (0.5, 0.1, 1.0), (-0.3, 0.01, 0.3)] {
        let at = fold(&set([0.0, d2, d3, r]), &LIMITS).unwrap().0.unwrap().d;
        for gap in [1e-3, 1e-6, 1e-9, 1e-12] {
            let stable: Vec<bool> =
                found([at * (1.0 + gap), d2, d3, r]).iter().map(|cycle| cycle.stable).collect();
            assert_eq!(stable, [false, true], "D2 = {d2}, {gap:e} below {at}");
            assert_eq!(found([at * (1.0 - gap), d2, d3, r]), [], "D2 = {d2}, {gap:e} above {at}");
        }
    }
}

/// Parameter sets for which the search once spent its budget or did not converge.
#[test]
fn the_search_ends_where_there_is_an_answer() {
    let pair = found([
        -0.166_246_507_446_349_75,
        -0.208_353_058_258_997_72,
        1.897_268_038_859_537_3e-5,
        1.0,
    ]);
    assert_eq!(pair.iter().map(|cycle| cycle.stable).collect::<Vec<_>>(), [false, true]);
    assert_eq!(found([-0.776_357_752_488_489_9, 1.0, 0.0, 1.0]).len(), 1);
    assert_eq!(found([-2.504_098_594_082_439_7, 0.0, 8.0, 1.0]).len(), 1);
}

/// Below `D = -1` a stable cycle may graze the sticking set: by 1.248e-6 here, and by 3.4e-10.
#[test]
fn a_cycle_that_grazes_the_sticking_set_is_told_from_it() {
    for (d, d3, clearance, period) in [
        (-2.742_751_4, 10.0, 1.248_000_968_756_117_7e-6, 12.483_051_110_187_528),
        (-2.051_220_81, 5.0, 3.391_737_426_271_82e-10, 17.599_286_982_444_064),
    ] {
        let [cycle] = found([d, 0.0, d3, 1.0])[..] else { panic!("one at D3 = {d3}") };
        assert!(cycle.stable);
        assert!((cycle.clearance / clearance - 1.0).abs() < 1e-9, "{cycle:?}");
        assert!((cycle.period - period).abs() < 1e-7 + cycle.errors.unwrap().period, "{cycle:?}");
        // Without D2 the two swings are mirror images.
        assert!(
            (cycle.q_max + cycle.q_min).abs()
                <= cycle.errors.unwrap().q_max + cycle.errors.unwrap().q_min
        );
    }
}

#[test]
fn strong_cubic_damping_has_its_fold_too() {
    let found = fold(&set([0.0, 0.0, 10.0, 1.0]), &LIMITS).unwrap().0.unwrap();
    assert!((found.d + 2.742_750).abs() < 5e-7 && found.grazes, "{found:?}");
    // By scaling, only r^2 D3 matters.
    let scaled = fold(&set([0.0, 0.0, 40.0, 0.5]), &LIMITS).unwrap().0.unwrap();
    assert!((scaled.d / found.d - 1.0).abs() < 1e-14, "{scaled:?}");
}

/// A point that cannot be computed gives its reason and does not affect the others.
#[test]
fn a_border_has_a_row_for_every_value() {
    let found = border(&set([0.0, 0.0, 0.0, 1.0]), Knob::D3, (0.25, 1e150), 2, &LIMITS).unwrap();
    let rows: Vec<_> =
        found.points.iter().map(|it| (it.fold.is_some(), it.reason.is_some())).collect();
    assert_eq!(rows, [(true, false), (false, true)], "{found:?}");
}

fn followed(base: [f64; 4], parameter: Knob, range: (f64, f64), count: usize) -> Branch {
    let found = branch(&set(base), parameter, range, Points::Even(count), 1e-10, &LIMITS);
    found.unwrap_or_else(|reason| panic!("{base:?} over {parameter}: {reason}"))
}

/// Every point of a branch is a cycle that the search finds there, within the errors of both.
fn assert_cycles(base: [f64; 4], found: &Branch) {
    let points: Vec<_> = found.pieces.iter().flatten().collect();
    assert!(!points.is_empty());
    points.par_iter().for_each(|point| {
        let there = set(base).with(found.parameter, point.value);
        let all = cycles(&there, &LIMITS).unwrap().cycles;
        let cycle = all.iter().find(|it| it.stable == point.cycle.stable);
        let cycle = cycle.unwrap_or_else(|| panic!("{base:?}: none like {point:?}"));
        let near = |one: f64, other: f64, errors: f64| (one - other).abs() <= errors;
        let (one, other) = (&point.cycle, cycle);
        let (a, b) = (one.errors.unwrap(), other.errors.unwrap());
        assert!(
            near(one.q_min, other.q_min, a.q_min + b.q_min)
                && near(one.q_max, other.q_max, a.q_max + b.q_max)
                && near(one.v_min, other.v_min, a.v_min + b.v_min)
                && near(one.v_max, other.v_max, a.v_max + b.v_max)
                && near(one.period, other.period, a.period + b.period)
                && a.log_clearance <= 1e-3,
            "{base:?}: {point:?} for {cycle:?}"
        );
    });
}

fn specials(found: &Branch, kind: SpecialKind) -> Vec<f64> {
    found.special.iter().filter(|it| it.kind == kind).map(|it| it.value).collect()
}

#[test]
fn a_branch_over_d2_goes_to_its_escapes_and_marks_them() {
    let base = [-0.462_806, 0.0, 0.0, 0.532_223];
    let found = followed(base, Knob::D2, (-3.65161, 2.03386), 60);
    assert_cycles(base, &found);
    let escapes = specials(&found, SpecialKind::Escape);
    assert_eq!(escapes.len(), 2, "{escapes:?}");
    assert_eq!(escapes[0], -escapes[1]);
    let at = escape_point(&set([0.0, escapes[1], 0.0, base[3]]), &LIMITS).unwrap().0.unwrap();
    assert!((at / base[0] - 1.0).abs() < 1e-12, "{at}");
    let values = || found.pieces.iter().flatten().map(|point| point.value);
    let ends = values().fold((0.0, 0.0), |(low, high): (f64, f64), it| (low.min(it), high.max(it)));
    assert!((ends.0 / escapes[0] - 1.0).abs() < 1e-6 && (ends.1 / escapes[1] - 1.0).abs() < 1e-6);
    assert!(values().all(|it| it.abs() < escapes[1]), "{ends:?} {escapes:?}");
}

#[test]
fn a_branch_over_r_marks_its_escape() {
    let found = followed([-0.5, 0.7, 0.0, 1.0], Knob::R, (0.1, 2.0), 20);
    let [escape] = specials(&found, SpecialKind::Escape)[..] else { panic!("{found:?}") };
    let at = escape_point(&set([0.0, 0.7, 0.0, escape]), &LIMITS).unwrap().0.unwrap();
    assert!((at / -0.5 - 1.0).abs() < 1e-12, "{at}");
}

/// The cycle grows tenfold within 1e-9 of D, and then continues.
#[test]
fn a_branch_is_followed_through_an_explosion() {
    let base = [-0.94486, -0.031_239_1, -4.389_05e-5, 16.4024];
    let found = followed(base, Knob::D, (-0.677_461, -0.359_712), 20);
    let last = found.pieces.iter().flatten().find(|point| point.value == -0.359_712);
    assert!((last.expect("the cycle at the end").cycle.q_max - 2_409.017_400_127).abs() < 1e-6);
    assert_cycles(base, &found);
}

#[test]
fn a_branch_ends_where_its_cycle_reaches_the_sticking_set() {
    let base = [0.0, 0.5, 0.1, 1.0];
    let found = followed(base, Knob::D, (-1.5, 0.0), 60);
    assert_eq!(specials(&found, SpecialKind::Fold).len(), 1, "{:?}", found.special);
    assert_eq!(found.pieces.len(), 1);
    assert_cycles(base, &found);
    let piece = &found.pieces[0];
    let alike = piece.windows(2).filter(|pair| {
        (pair[0].value - pair[1].value).abs() < 1e-12
            && pair[0].cycle.stable == pair[1].cycle.stable
    });
    assert_eq!(alike.count(), 0);
}

#[test]
fn no_cycle_is_an_answer() {
    let base = [-2.044_237_931_420_537, -2.129_402_215_354_76, 0.0, 1.0];
    let found = followed(base, Knob::D2, (0.665_236_599_800_346_4, -13.122_849_325_551_796), 60);
    assert!(found.pieces.is_empty() && found.special.is_empty(), "{found:?}");
}
