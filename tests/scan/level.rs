//! Level curves against closed forms, against bisection, and against each other.

use hopfscope::flow::{Limits, Problem};
use hopfscope::model::{Group, Parameters};
use hopfscope::portrait::{Margin, Portrait};
use hopfscope::scan::{Conditions, LevelCurve, LevelEnd, LevelTarget, Levels, Scan, Sweep};
use serde_json::Value;

use crate::program::run;

const BASE: Parameters = Parameters { d: -0.1, d2: 0.0, d3: 0.5, r: 0.1 };

/// The level curves over two of D, D2, D3 and r, with chords within a part of the ranges.
fn followed(base: Parameters, target: &str, over: [&str; 2], chord: f64) -> Levels {
    let over = over.map(|text| Sweep::read(&format!("{text}:24"), &[Group::Motion]).unwrap());
    let target = LevelTarget::read(target).unwrap();
    let problem = Problem { parameters: base, ..Problem::default() };
    let measures = vec![target.measure];
    let scan = Scan::new(problem, over.to_vec(), measures, Conditions::default()).unwrap();
    scan.curves(target, chord, &Limits::PATIENT).unwrap()
}

/// The only curve.
fn only(found: Levels) -> LevelCurve {
    let [curve] = <[LevelCurve; 1]>::try_from(found.curves).unwrap();
    curve
}

/// The margin by the search of `basin`, which knows nothing of curves.
fn margin(parameters: &Parameters) -> Margin {
    Portrait::innermost(parameters, 0.0, &Limits::PATIENT).unwrap().margin
}

/// Where a condition begins to hold between two values, by halving alone.
fn halved([mut without, mut with]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    assert!(holds(with) && !holds(without), "{without} {with}");
    for _ in 0..60 {
        let middle = f64::midpoint(without, with);
        *(if holds(middle) { &mut with } else { &mut without }) = middle;
    }
    with
}

/// Without D2 and D3 lengths scale with r: the impulse is r times a function of D alone.
#[test]
fn of_the_linear_oscillator_the_friction_is_the_value_over_a_function_of_the_damping() {
    let linear = Parameters { d3: 0.0, ..BASE };
    let found = followed(linear, "impulse=0.2", ["D=-0.9:-0.01", "r=0.001:0.5"], 1e-3);
    let curve = only(found);
    assert_eq!(curve.ends, Some([LevelEnd::Edge; 2]));
    assert!(curve.points.len() > 20);
    for [d, r] in curve.points {
        let unit = margin(&Parameters { d, r: 1.0, ..linear }).impulse.unwrap();
        assert!((r - 0.2 / unit).abs() < 1e-12, "{d} {r} {}", 0.2 / unit);
    }
}

/// How many points there are, and the largest distance, as a part of the range, between one and where bisection of the margin
/// along D finds it.
fn against_bisection(chord: f64) -> (usize, f64) {
    let (mut checked, mut worst) = (0, 0.0_f64);
    for (target, of) in [
        ("impulse=0.4", (|it: &Margin| it.impulse) as fn(&Margin) -> Option<f64>),
        ("displacement=0.3", |it| it.displacement),
        ("from_rest_impulse=0.25", |it| it.from_rest.impulse),
    ] {
        let value = LevelTarget::read(target).unwrap().value;
        let found = followed(BASE, target, ["D=-0.5:0", "D3=0:3"], chord);
        assert!(!found.curves.is_empty());
        for [d, d3] in found.curves.into_iter().flat_map(|curve| curve.points) {
            // Beyond the fold every kick is survived, which is more than any.
            let more =
                |d: f64| of(&margin(&Parameters { d, d3, ..BASE })).is_none_or(|it| it > value);
            let at = halved([(d - 1e-3).max(-0.5), (d + 1e-3).min(0.0)], more);
            worst = worst.max((at - d).abs() / 0.5);
            checked += 1;
        }
    }
    (checked, worst)
}

#[test]
fn each_point_is_where_bisection_finds_it() {
    let (checked, worst) = against_bisection(1e-3);
    assert!(checked > 50 && worst < 1e-9, "{checked} {worst}");
}

/// The same at a thousand points.
#[test]
#[ignore = "takes a minute"]
fn each_of_a_thousand_points_is_where_bisection_finds_it() {
    let (checked, worst) = against_bisection(1e-8);
    println!("{checked} points, the worst {worst:e} of the range off");
    assert!(checked > 1000 && worst < 1e-9, "{checked} {worst}");
}

/// The curve touches the fold where the fold's own cycle has the margin that is sought.
#[test]
fn a_curve_ends_on_the_fold_whose_cycle_has_the_value() {
    let curve = only(followed(BASE, "displacement=0.5", ["D=-0.5:0", "D3=0.1:3"], 1e-3));
    let [from, to] = curve.ends.unwrap();
    let points = &curve.points;
    let [d, d3] = match (from, to) {
        (LevelEnd::Ceases, LevelEnd::Edge) => points[0],
        (LevelEnd::Edge, LevelEnd::Ceases) => points[points.len() - 1],
        ends => panic!("{ends:?}"),
    };
    let fold = |d3: f64| {
        let found = hopfscope::branch::fold::fold(&Parameters { d3, ..BASE }, &Limits::PATIENT);
        found.unwrap().0.unwrap()
    };
    // The amplitude at the fold falls as D3 grows.
    let at = halved([d3 - 0.01, d3 + 0.01], |d3| fold(d3).q_max < 0.5);
    assert!((d3 - at).abs() < 1e-9 * 2.9, "{d3} {at}");
    assert!((d - fold(at).d).abs() < 1e-9 * 0.5, "{d} {}", fold(at).d);
}

/// A motion that is reflected is that of the opposite D2.
#[test]
fn curves_over_d2_are_their_own_mirror_images() {
    let found = followed(BASE, "impulse=0.3", ["D2=-1:1", "D=-0.4:0"], 1e-5);
    let heights = |d2: f64| -> Vec<f64> {
        let pairs = found.curves.iter().flat_map(|curve| curve.points.windows(2));
        let over = pairs.filter(|it| (it[0][0] < d2) != (it[1][0] < d2));
        over.map(|it| it[0][1] + (it[1][1] - it[0][1]) * (d2 - it[0][0]) / (it[1][0] - it[0][0]))
            .collect()
    };
    for d2 in [0.1, 0.35, 0.7, 0.9] {
        let [right, left] = [heights(d2), heights(-d2)];
        assert_eq!((right.len(), left.len()), (1, 1), "{d2}");
        // Both are chords, which lie within 1e-5 of the range of the curve.
        assert!((right[0] - left[0]).abs() < 2e-5 * 0.4, "{d2}: {right:?} {left:?}");
    }
}

/// Where D3 < 0 the period of the only cycle is least near D = D2 = 0, and grows in every direction from there.
#[test]
fn a_curve_around_a_least_period_is_closed() {
    let base = Parameters { d3: -0.5, ..BASE };
    let curve = only(followed(base, "period_1=6.5", ["D=-0.5:0.6", "D2=-1:1"], 1e-3));
    assert_eq!((curve.ends, curve.points.first()), (None, curve.points.last()));
    let (mut low, mut high, mut turns) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
    for pair in curve.points.windows(2) {
        let [d, d2] = pair[0];
        let here = Parameters { d, d2, ..base };
        let found = Portrait::innermost(&here, 0.0, &Limits::PATIENT).unwrap();
        assert!((found.cycles[0].period - 6.5).abs() < 1e-11, "{here:?}");
        (low, high) = (low.min(d2), high.max(d2));
        turns += pair[0][0] * pair[1][1] - pair[1][0] * pair[0][1];
    }
    assert!((low + high).abs() < 2e-3 * 2.0 && high > 0.2, "{low} {high}");
    assert!(turns.abs() > 0.1, "it goes around once: {turns}");
}

#[test]
fn a_machine_has_curves_over_its_own_numbers_in_si_units() {
    let line = "level --machine clutch --of displacement=0.0002 --over v0=0.1:1 --over R=0.5:5 --format json";
    let ran = run(&line.split(' ').collect::<Vec<_>>());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    let points = found["curves"][0]["points"].as_array().unwrap();
    assert!(points.len() > 10);
    for point in points.iter().step_by(8) {
        let set = [format!("v0={}", point[0]), format!("R={}", point[1])];
        let words = [
            "margin",
            "--machine",
            "clutch",
            "--format",
            "json",
            "--set",
            &set[0],
            "--set",
            &set[1],
        ];
        let answer: Value = serde_json::from_str(&run(&words).out).unwrap();
        let displacement = answer["nominal"]["displacement"].as_f64().unwrap();
        assert!((displacement - 0.0002).abs() < 1e-9 * 0.0002, "{point} {displacement}");
    }
}

#[test]
fn what_a_curve_needs_is_said_in_one_line() {
    let over = "--over D=-1:0 --over D3=0:1";
    for (line, words) in [
        (format!("--of impuls=0.2 {over}"), "there is no column \"impuls\"; there are"),
        (format!("--of impulse {over}"), "expected COLUMN=VALUE, such as impulse=0.2"),
        (format!("--of impulse=inf {over}"), "expected COLUMN=VALUE"),
        ("--of impulse=0.2 --over D=-1:0".to_owned(), "--over twice"),
        ("--of impulse=0.2 --over D=-1:0 --over D=0:1".to_owned(), "D is scanned over twice"),
        (format!("--of D_F=-0.1 {over}"), "fold does not depend on D"),
        (format!("--of outcome=1 {over}"), "there is no column \"outcome\""),
    ] {
        let line = format!("level {line}");
        let ran = run(&line.split(' ').collect::<Vec<_>>());
        assert_eq!((ran.code, ran.out.as_str()), (2, ""), "{line}");
        assert!(ran.err.contains(words) && ran.err.lines().count() == 1, "{line}: {}", ran.err);
    }
    let none = run(&"level --of impulse=900 --set r=0.1 --over D=-0.5:-0.2 --over D3=0.1:1"
        .split(' ')
        .collect::<Vec<_>>());
    assert_eq!(none.code, 0);
    assert!(none.out.contains("no curve impulse=900: impulse is 0."), "{}", none.out);
}

/// Along two kinds of curves: what is held says on which it lies.
#[test]
fn a_point_that_is_held_names_its_curve() {
    let folder = tempfile::tempdir().unwrap();
    let keys = folder.path().join("walk.keys");
    let walk = "<run \"level impulse=0.25\"> <wait> <tab> w <wait> <expect \" · impulse=0.25\">";
    std::fs::write(&keys, format!("{walk} <tab*2> <expect \" · fold\">")).unwrap();
    let line = ["replay", keys.to_str().unwrap(), "--scene", "regimes", "--size", "100x30"];
    let ran = run(&line);
    assert_eq!(ran.code, 0, "{}", ran.err);
    // The curve is named where it is held, and nowhere else beside numbers.
    let other = walk.replace(" w <wait>", " <wait>");
    std::fs::write(&keys, other).unwrap();
    assert_ne!(run(&line).code, 0);
}
