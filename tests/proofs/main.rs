//! Proofs of limit cycles against references of thirty digits, against motions in twice the precision, and
//! against the search.

mod agreement;
mod certificates;
mod hostile;
mod motions;

#[path = "../data/mod.rs"]
mod data;

use data::references;
use hopfscope::branch::escape::escape_point;
use hopfscope::branch::fold::fold;
use hopfscope::flow::precise::{COARSE, FINE, precise};
use hopfscope::flow::{Limits, Problem};
use hopfscope::model::{Knob, Parameters, State};
use hopfscope::numerics::Interval;
use hopfscope::numerics::elementary::{exp, pow, powi};
use hopfscope::numerics::random::Random;
use hopfscope::portrait::basin::cycle::cycles;
use hopfscope::portrait::proved::proved;
use hopfscope::proof::bifurcation::{enclose_escape, enclose_fold};
use hopfscope::proof::field::FieldBox;
use hopfscope::proof::map::ProvedMap;
use hopfscope::proof::swing::{Passage, swing, swing_below};
use hopfscope::proof::{ParameterBox, Proof, StartBox, prove};

/// A number in twice the precision of a double, as a sum of two doubles.
type Long = (f64, f64);

/// Whether the interval contains the number.
fn holds(interval: Interval, (high, low): Long) -> bool {
    (high - interval.lower()) + low >= 0.0 && (interval.upper() - high) - low >= 0.0
}

fn exactly(d: f64, d2: f64, d3: f64, r: f64) -> ParameterBox {
    ParameterBox::from(&Parameters { d, d2, d3, r })
}

/// Reference cycles for these doubles: stability, and the first 32 digits of the right turning point, the
/// negative of the left one, the period and the multiplier, enclosed to 1e-30 by an independent tool.
#[rustfmt::skip]
#[expect(clippy::unreadable_literal, reason = "all digits of a reference")]
const REFERENCES: [([f64; 4], bool, [Long; 4]); 5] = [
    ([-0.2, 0.2, 0.5, 0.1], false, [(0.35005884538993726, 2.1599580319942222e-17), (0.3847819481189786, -6.086188009348503e-18), (6.374955080671314, -1.7794887135603148e-16), (2.224628281697501, 6.5653600277123e-17)]),
    ([-0.2, 0.2, 0.5, 0.1], true, [(0.7223333330302725, 4.084446244446085e-17), (0.8932028032411413, -1.3906407388974706e-17), (6.322694602883211, 4.2165509303734457e-16), (0.355865264037352, 2.5972518627244207e-17)]),
    ([-0.3, 0.0, 0.5, 0.1], false, [(0.22472936852475442, 1.2488735856304817e-17), (0.22472936852475442, 1.2488735856304817e-17), (6.559272455926867, -8.676856130515323e-17), (5.990283091814947, -6.567548208934395e-17)]),
    ([-0.3, 0.0, 0.5, 0.1], true, [(1.1583724547453083, -5.4091604151484135e-17), (1.1583724547453083, -5.4091604151484135e-17), (6.343593639766338, -3.4034078727566756e-17), (0.06208805289795733, 4.474698967702533e-19)]),
    ([-0.1, 0.0, 0.0, 0.1], false, [(0.6386823184357734, -5.547407013254875e-17), (0.6386823184357734, -5.547407013254875e-17), (6.314838833996553, 2.5473757703309967e-16), (1.8803988026214897, 4.171128497029203e-17)]),
];

#[test]
fn reference_cycles_of_thirty_digits_are_enclosed() {
    for ([d, d2, d3, r], stable, [q_max, left, period, multiplier]) in REFERENCES {
        let proof = prove(&exactly(d, d2, d3, r), &[]);
        assert!(proof.is_complete(), "{proof:?}");
        let cycle = proof.cycles.iter().find(|cycle| cycle.stable == stable).unwrap();
        let found = cycle.enclosure.unwrap();
        assert!(holds(found.q_max, q_max), "{found:?}");
        assert!(holds(-found.q_min, left), "{found:?}");
        assert!(holds(found.period, period), "{found:?}");
        assert!(holds(found.multiplier, multiplier), "{found:?}");
        assert!(found.q_max.width() < 1e-12 * q_max.0 && found.period.width() < 1e-11);
        assert!(found.multiplier.width() < 1e-10 * multiplier.0, "{found:?}");
        assert_eq!(
            [found.multiplier.upper() < 1.0, found.multiplier.lower() > 1.0],
            [stable, !stable]
        );
    }
}

#[test]
fn every_reference_cycle_is_proved_and_enclosed_to_twelve_digits() {
    for reference in references() {
        let proof = prove(&ParameterBox::from(&reference.parameters), &[]);
        assert!(proof.is_complete(), "{:?}", proof.open);
        let near = |value: Interval, expected: f64, within: f64| {
            let slack = within * expected.abs();
            value.lower() <= expected + slack
                && value.upper() >= expected - slack
                && value.width() <= slack
        };
        let enclosures = || proof.cycles.iter().filter_map(|cycle| cycle.enclosure);
        let same = |found: &hopfscope::proof::enclose::Enclosure| {
            near(found.q_max, reference.q_max, 1e-12)
                && near(found.q_min, reference.q_min, 1e-12)
                && near(found.v_max, reference.v_max, 1e-12)
                && near(found.v_min, reference.v_min, 1e-12)
                && near(found.period, reference.period, 1e-12)
                && near(found.multiplier, reference.multiplier, 1e-10)
        };
        let (p, q) = (reference.parameters, reference.q_max);
        assert!(enclosures().any(|it| same(&it)), "{p:?} q_max {q}: {:?}", proof.cycles);
    }
}

/// 0 in one of five cases, otherwise of either sign and between 1e-3 and 1e3.
fn magnitude(chance: &mut Random) -> f64 {
    let (kind, size) = (chance.even(), pow(10.0, 6.0 * chance.even() - 3.0));
    if kind < 0.2 { 0.0 } else { size.copysign(kind - 0.6) }
}

fn any_parameters(chance: &mut Random) -> Parameters {
    let d = 4.0 * chance.even() - 2.0;
    let (d2, d3) = (magnitude(chance), magnitude(chance));
    Parameters { d, d2, d3, r: pow(10.0, 9.0 * chance.even() - 6.0) }
}

/// Each enclosure of a half swing must contain its motion in twice the precision.
fn check_half_swings(count: usize) {
    let mut chance = Random::new(88_172_645_463_325_252);
    let (mut enclosed, mut unknown, mut wide) = (0, 0, 0);
    for _ in 0..count {
        let d = 1.6 * chance.even() - 0.9;
        let (d2, d3) = (chance.even() - 0.5, 1.2 * chance.even() - 0.4);
        let x = 1e-3 * pow(5e3, chance.even());
        let point = Interval::point;
        let field = FieldBox { a: point(2.0 * d), b: point(d2), c: point(d3) };
        let start = StartBox::at_rest(point(x));
        let found = match swing(&field, &start) {
            Passage::Arrives(found) => found,
            Passage::Never | Passage::Exceeds(_) => continue,
            Passage::Unknown => {
                unknown += 1;
                continue;
            }
        };
        let problem = Problem {
            parameters: Parameters { d, d2, d3, r: 0.0 },
            initial: State { q: -x, v: 0.0 },
            until: found.duration.upper() * (1.0 + 1e-6),
            ..Problem::default()
        };
        let [fine, coarse] = [FINE, COARSE].map(|grain| {
            precise(&problem, grain, &Limits::PATIENT).expect("a smooth motion").crossings[0]
        });
        let (q, tau) = ((fine.q.high, fine.q.low), (fine.tau.high, fine.tau.low));
        assert!((fine.q.high - coarse.q.high).abs() <= 1e-15 * x.max(q.0), "{problem:?}");
        assert!(holds(found.end, q), "{problem:?}: {} {q:?}", found.end);
        assert!(holds(found.duration, tau), "{problem:?}: {} {tau:?}", found.duration);
        enclosed += 1;
        wide += usize::from(found.end.width() > 1e-11 * q.0);
    }
    assert!(enclosed > count * 8 / 10 && unknown <= count / 100, "{enclosed} {unknown}");
    assert!(wide <= count / 50, "{wide} of {enclosed} are wide");
}

#[test]
fn random_half_swings_hold_the_motions_of_twice_the_precision() {
    check_half_swings(300);
}

#[test]
#[ignore = "hundred thousand motions in twice the precision: minutes"]
fn a_hundred_thousand_half_swings_hold_the_motions_of_twice_the_precision() {
    check_half_swings(100_000);
}

/// Swings near the limits of the range of doubles are scaled copies of those near 1.
#[test]
fn half_swings_scale_to_the_last_bit() {
    let point = Interval::point;
    let run = |unit: i32| {
        let by = |power: i32| powi(2.0, power);
        let field = FieldBox {
            a: point(-0.4),
            b: point(0.3 * by(-unit)),
            c: point(0.5 * by(-unit) * by(-unit)),
        };
        let found =
            swing_below(&field, &StartBox::at_rest(point(0.75 * by(unit))), f64::INFINITY, true)
                .arrived()
                .unwrap();
        (
            found.end.lower() / by(unit),
            found.end.upper() / by(unit),
            found.duration,
            found.fastest.unwrap().upper() / by(unit),
        )
    };
    for unit in [-500, -37, 3, 440] {
        assert_eq!(run(unit), run(0), "2^{unit}");
    }
    // So small that only linear damping matters.
    let tiny = FieldBox { a: point(-0.4), b: point(0.3), c: point(0.5) };
    let swing = swing(&tiny, &StartBox::at_rest(point(1e-300))).arrived().unwrap();
    let growth = exp(std::f64::consts::PI * 0.2 / 0.96_f64.sqrt());
    assert!((swing.end.lower() / 1e-300 / growth - 1.0).abs() < 1e-12, "{swing:?}");
}

#[test]
fn proofs_of_mirrored_and_of_scaled_parameters_agree() {
    let turns = |proof: &Proof| -> Vec<(f64, f64)> {
        let ends = proof.cycles.iter().filter_map(|cycle| cycle.enclosure);
        ends.map(|it| (it.q_max.middle(), -it.q_min.middle())).collect()
    };
    let whole = turns(&prove(&exactly(-0.2, 0.2, 0.5, 0.1), &[]));
    let mirrored = turns(&prove(&exactly(-0.2, -0.2, 0.5, 0.1), &[]));
    assert_eq!(whole.len(), 2);
    for (one, other) in whole.iter().zip(&mirrored) {
        assert!((one.0 - other.1).abs() < 1e-12 && (one.1 - other.0).abs() < 1e-12);
    }
    for k in [-400, -30, 30, 400] {
        let by = powi(2.0, k);
        let scaled = turns(&prove(&exactly(-0.2, 0.2 / by, 0.5 / by / by, 0.1 * by), &[]));
        assert_eq!(scaled.len(), 2, "2^{k}");
        for (one, other) in whole.iter().zip(&scaled) {
            assert!((one.0 * by - other.0).abs() <= 1e-12 * other.0, "2^{k}");
        }
    }
}

/// Random parameters of all signs and sizes: what is proved agrees with the search. Returns how many proofs are open.
fn check_sets(count: usize) -> usize {
    let mut chance = Random::new(0x9e37_79b9_7f4a_7c15);
    let mut open = 0;
    for _ in 0..count {
        let parameters = any_parameters(&mut chance);
        let proof = match cycles(&parameters, &Limits::PATIENT) {
            Ok(found) => proved(&found).unwrap_or_else(|wrong| panic!("{parameters:?}: {wrong}")),
            Err(_) => prove(&ParameterBox::from(&parameters), &[]),
        };
        open += usize::from(!proof.is_complete());
    }
    open
}

#[test]
fn search_and_proof_agree_on_random_parameters() {
    let open = check_sets(60);
    assert!(open == 0, "{open} of 60 are open");
}

#[test]
#[ignore = "twenty thousand sets of parameters: minutes"]
fn search_and_proof_agree_on_twenty_thousand_sets() {
    let open = check_sets(20_000);
    assert!(open <= 200, "{open} of 20000 are open");
}

#[test]
fn theorems_decide_without_a_motion() {
    for (d, d2, d3, r, count) in [
        (0.3, 5.0, 0.5, 0.1, 0),
        (0.0, -2.0, 0.0, 0.1, 0),
        (-0.1, 1.0, 0.5, 0.1, 0),
        (-1.5, 3.0, -1.0, 0.1, 0),
        (-1.0, 0.0, 0.0, 1.0, 0),
        (-0.999_999, 0.0, 0.0, 1.0, 1),
        (-1e-12, 0.0, 0.0, 1e-300, 1),
    ] {
        let proof = prove(&exactly(d, d2, d3, r), &[]);
        assert!(proof.is_complete() && proof.cycles.len() == count && proof.swings == 0);
        assert!(proof.cycles.iter().all(|cycle| cycle.enclosure.is_some()));
    }
    // The closed form where its clearance underflows, and where its amplitude is huge.
    let steep = prove(&exactly(-0.999_999, 0.0, 0.0, 1.0), &[]).cycles[0].enclosure.unwrap();
    assert!(steep.clearance.lower() == 0.0 && steep.clearance.upper() < 1e-300);
    assert!(steep.q_max.contains(1.0) && steep.multiplier.upper() == f64::INFINITY);
    let weak = prove(&exactly(-1e-12, 0.0, 0.0, 1.0), &[]).cycles[0].enclosure.unwrap();
    let amplitude = 2.0 / (std::f64::consts::PI * 1e-12);
    assert!(
        (weak.q_max.middle() / amplitude - 1.0).abs() < 1e-11
            && weak.q_max.width() < 1e-14 * amplitude
    );
}

/// What is proved for an interval of parameters holds for those inside.
#[test]
fn intervals_of_parameters_hold_what_is_proved_inside() {
    let wide = ParameterBox {
        d: Interval::new(-0.201, -0.199),
        d2: Interval::new(0.199, 0.201),
        d3: Interval::new(0.499, 0.501),
        r: Interval::new(0.0999, 0.1001),
    };
    let all = prove(&wide, &[]);
    assert!(all.is_complete() && all.cycles.len() == 2, "{all:?}");
    for (d, d2, d3, r) in
        [(-0.201, 0.201, 0.499, 0.0999), (-0.199, 0.199, 0.501, 0.1001), (-0.2, 0.2, 0.5, 0.1)]
    {
        let one = prove(&exactly(d, d2, d3, r), &[]);
        for (cycle, around) in one.cycles.iter().zip(&all.cycles) {
            let (cycle, around) = (cycle.enclosure.unwrap(), around.enclosure.unwrap());
            assert!(cycle.q_max.is_within(around.q_max), "{} {}", cycle.q_max, around.q_max);
            assert!(cycle.period.is_within(around.period));
            assert!(cycle.multiplier.is_within(around.multiplier));
            assert!(cycle.v_min.is_within(around.v_min));
        }
    }
    // Across a fold the number of cycles is not constant.
    let across = ParameterBox { d: Interval::new(-0.18, -0.17), ..wide };
    assert!(!prove(&across, &[]).is_complete());
}

/// Folds at `D2 = 0` over `r^2 D3`, and one with `D2`, computed elsewhere to 8 to 14 digits.
#[test]
fn every_reference_fold_is_enclosed_to_twelve_digits() {
    let data: serde_json::Value = serde_json::from_str(include_str!("../data/folds.json")).unwrap();
    let number = |row: &serde_json::Value, name: &str| row[name].as_f64().unwrap();
    let mut rows: Vec<(Parameters, f64)> = Vec::new();
    for row in data["folds"].as_array().unwrap() {
        let d3 = number(row, "kappa");
        rows.push((Parameters { d: 0.0, d2: 0.0, d3, r: 1.0 }, number(row, "D_F")));
    }
    let with_d2 = &data["with_D2"];
    rows.push((Parameters { d: 0.0, d2: 0.2, d3: 0.5, r: 0.1 }, number(with_d2, "D")));
    for (parameters, expected) in rows {
        let found = fold(&parameters, &Limits::PATIENT).unwrap().0.unwrap();
        let clearance = found.q_max - parameters.r;
        let all = ParameterBox::from(&parameters);
        let proved = enclose_fold(&all, Knob::D, found.d, clearance).unwrap();
        let value = proved.value;
        assert!(value.width() <= 1e-12 * expected.abs(), "{parameters:?} {value}");
        assert!((value.middle() / expected - 1.0).abs() < 1e-7, "{value} {expected}");
        assert!(proved.clearance.width() < 1e-11 * clearance, "{}", proved.clearance);
        if parameters.d2 != 0.0 {
            assert!((value.middle() - expected).abs() < 2e-14, "{value} {expected}");
            let q_max = proved.clearance + Interval::point(parameters.r);
            assert!((q_max.middle() - number(with_d2, "q_max")).abs() < 1e-12, "{q_max}");
            // The same point is a fold with respect to every other parameter.
            let there = ParameterBox { d: value, ..all };
            for (symbol, near) in [(Knob::R, 0.1), (Knob::D3, 0.5), (Knob::D2, 0.2)] {
                let across = enclose_fold(&there, symbol, near, clearance).unwrap().value;
                assert!(across.contains(near) && across.width() < 1e-10 * near, "{across}");
            }
        }
        // Where cycles do not merge there is nothing to enclose.
        assert!(enclose_fold(&all, Knob::D, found.d * 1.1, clearance).is_none());
    }
}

/// `D_c` of the cycle that escapes to infinity over `r D2`, computed elsewhere to 6 digits.
#[test]
fn every_reference_escape_point_is_enclosed() {
    for (d2, expected) in [
        (0.02, -0.015_958),
        (0.05, -0.039_892),
        (0.1, -0.079_769),
        (0.25, -0.199_164),
        (-0.5, -0.396_442),
        (1.0, -0.776_232),
    ] {
        let parameters = Parameters { d: 0.0, d2, d3: 0.0, r: 1.0 };
        let near = escape_point(&parameters, &Limits::PATIENT).unwrap().0.unwrap();
        let all = ParameterBox::from(&parameters);
        let value = enclose_escape(&all, Knob::D, near).unwrap();
        assert!(value.width() < 3e-10 * -expected, "{value}");
        assert!((value.middle() - expected).abs() < 6e-7, "{value} {expected}");
        let slack = 1e-11 * expected.abs();
        assert!(value.lower() - slack <= near && near <= value.upper() + slack, "{value} {near}");
        // On one side of it there is a cycle, on the other none.
        for (d, cycles) in [(value.lower() * 1.001, 1), (value.upper() * 0.999, 0)] {
            let proof = prove(&exactly(d, d2, 0.0, 1.0), &[]);
            assert!(proof.is_complete() && proof.cycles.len() == cycles, "{d} {proof:?}");
        }
    }
}

/// Arrivals of stiff half swings, computed by an implicit method with a tolerance of 1e-11.
#[test]
fn stiff_half_swings_arrive_where_an_implicit_method_says() {
    for (d, d2, d3, start, end, within) in [
        (-0.2, 1.0, 0.01, 1e6, 0.776_730_114_491, 1e-8),
        (0.2, -1.0, 1e-4, 1.0, 14_812_972.905_729, 1e-3),
        (0.2, -1.0, 1e-4, 1e9, 14_812_972.905_729, 1e-3),
        (-1.1, -1.0, 1e-5, 0.5, 1_481_631_989.54, 2e-4),
        (-0.2, 1.0, 0.0, 1e5, 0.785_352_438_962, 1e-8),
        (-0.15, 0.0, 1.0, 1e4, 0.762_030_453_979, 1e-7),
        (-0.25, 1.0, -1e-5, 1e7, 0.867_665_236_647, 1e-8),
    ] {
        // The second half of the map runs above v = 0, where b is D2.
        let map = ProvedMap::new(&exactly(d, d2, d3, 0.0));
        let found = map.forward.0[1].image(Interval::point(start));
        let slack = 1e-9 * end;
        assert!(found.lower() <= end + slack && end - slack <= found.upper(), "{found} {end}");
        assert!(found.width() <= within * end, "{d} {d2} {d3} {start}: {found}");
        let one = Interval::new(start, start * (1.0 + 1e-6));
        let slope = map.forward.slope(one);
        assert!(
            d2 < 0.0 || d3 <= 0.0 || slope.is_some_and(|slope| slope.upper() < 1e-6),
            "{slope:?}"
        );
    }
}
