//! Certificates of limit cycles: those written by the program are accepted, and no others.

use hopfscope::check::motion::FencedField;
use hopfscope::check::{Certificate, CertificateStep, StepKind, check};
use hopfscope::model::Parameters;
use hopfscope::numerics::Interval;
use hopfscope::numerics::elementary::cbrt;
use hopfscope::proof::certificate::{certificate, text as file};
use hopfscope::proof::{ParameterBox, prove};
use serde_json::Value;

fn written(d: f64, d2: f64, d3: f64, r: f64) -> String {
    let proof = prove(&ParameterBox::from(&Parameters { d, d2, d3, r }), &[]);
    file(&certificate(&proof).unwrap()).unwrap()
}

#[test]
fn what_is_written_is_accepted() {
    for ([d, d2, d3, r], cycles) in [
        ([-0.2, 0.2, 0.5, 0.1], 2),
        ([-0.5, 0.2, 0.5, 0.1], 2),
        ([-0.3, 0.2, -0.5, 0.1], 1),
        ([-0.3, 0.5, 0.0, 0.1], 1),
        ([-0.02, 0.5, 0.0, 0.1], 0),
        ([-0.1, 0.0, 0.5, 0.1], 0),
        ([-0.1, 0.0, 0.0, 0.1], 1),
        ([0.1, 0.0, -0.5, 0.0], 1),
        ([-1.5, 0.3, -1.0, 0.1], 0),
    ] {
        let text = written(d, d2, d3, r);
        let accepted =
            check(&text).unwrap_or_else(|why| panic!("{d} {d2} {d3} {r}: {why}\n{text}"));
        assert_eq!(accepted.cycles, cycles, "{d} {d2} {d3} {r}");
        let shown = accepted.steps.iter().filter(|step| step.clearance.is_some()).count();
        let by_theorem =
            matches!(accepted.steps[..], [CertificateStep { to: None, from: 0.0, .. }]);
        assert!(by_theorem || shown == cycles);
    }
}

/// The clearance in a certificate contains the reference of thirty digits, whose leading digits are given here.
#[test]
fn the_clearance_holds_the_reference() {
    let accepted = check(&written(-0.2, 0.2, 0.5, 0.1)).unwrap();
    let stable = accepted.steps.iter().find(|step| step.kind == StepKind::Stable).unwrap();
    let [low, high] = stable.clearance.unwrap();
    assert!(low < 0.622_333_333_030_272_5 && 0.622_333_333_030_272_5 < high);
    assert!(high - low < 1e-11);
}

/// Paths of all numbers, booleans and strings in a document.
fn places(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(fields) => {
            for (key, inner) in fields {
                places(inner, &format!("{path}/{key}"), found);
            }
        }
        Value::Array(items) => {
            for (index, inner) in items.iter().enumerate() {
                places(inner, &format!("{path}/{index}"), found);
            }
        }
        _ => found.push(path.to_owned()),
    }
}

/// An invalid fence bounds nothing: without it nothing is certain from far out.
#[test]
fn a_fence_is_verified() {
    let text = written(-0.2, 0.2, 0.5, 0.1);
    let whole = check(&text).unwrap();
    let last = whole.steps.len() - 1;
    assert!(whole.steps[last].to.is_none() && whole.steps[last].fences.is_some());
    for fences in
        [None, Some([0.0, 0.0]), Some([-2.5, -2.2]), Some([0.1, 0.1]), Some([1e200, 1e200])]
    {
        let mut changed = whole.clone();
        changed.steps[last].fences = fences;
        let refusal = check(&file(&changed).unwrap()).unwrap_err();
        assert_eq!(line(&refusal), last + 5, "{fences:?}: {refusal}");
    }
}

/// Every field is perturbed in turn by one part in a thousand: it is refused at its line, unless a bound of the
/// clearance has become wider and is still true.
#[test]
fn every_field_that_is_changed_is_refused() {
    let text = written(0.3, 0.2, -0.5, 0.1);
    let document: Value = serde_json::from_str(&text).unwrap();
    let mut found = Vec::new();
    places(&document, "", &mut found);
    assert!(found.len() > 20);
    let (mut true_yet, mut refused) = (Vec::new(), 0);
    for place in &found {
        for factor in [0.999, 1.001] {
            let mut changed = document.clone();
            let target = changed.pointer_mut(place).unwrap();
            *target = match target {
                Value::Number(number) if number.is_u64() => {
                    Value::from(number.as_u64().unwrap() + 1)
                }
                Value::Number(number) if number.as_f64() == Some(0.0) => Value::from(factor - 1.0),
                Value::Number(number) => Value::from(number.as_f64().unwrap() * factor),
                Value::String(word) => Value::from(format!("{word}x")),
                other => panic!("{other}"),
            };
            let text = serde_json::to_string_pretty(&changed).unwrap();
            match check(&text) {
                Err(refusal) => {
                    refused += 1;
                    assert!((1..=text.lines().count()).contains(&line(&refusal)), "{refusal}");
                }
                Ok(_) => true_yet.push(format!("{place} {factor}")),
            }
        }
    }
    let may = |place: &String| place.contains("/clearance/");
    assert!(true_yet.iter().all(may) && true_yet.len() <= 2, "{true_yet:?}");
    assert!(refused > 40, "{refused}");
}

/// The line number in a refusal.
fn line(refusal: &str) -> usize {
    refusal.strip_prefix("line ").and_then(|it| it.split_once(':')).unwrap().0.parse().unwrap()
}

#[test]
fn a_step_that_is_missing_or_out_of_place_is_refused_with_its_line() {
    let text = written(-0.2, 0.2, 0.5, 0.1);
    let whole = check(&text).unwrap();
    for gone in 0..whole.steps.len() {
        let mut steps = whole.steps.clone();
        steps.remove(gone);
        let text = file(&Certificate { steps, ..whole.clone() }).unwrap();
        let refusal = check(&text).unwrap_err();
        // Either the step now in this place or the previous one does not fit. Steps begin in line 5.
        let there = gone + 5;
        assert!((there - 1..=there).contains(&line(&refusal)), "without step {gone}: {refusal}");
    }
    let steps = vec![CertificateStep {
        kind: StepKind::OneWay,
        from: 0.0,
        to: None,
        clearance: None,
        fences: None,
    }];
    let claimed = file(&Certificate { parameters: whole.parameters, cycles: 0, steps }).unwrap();
    assert_eq!(line(&check(&claimed).unwrap_err()), 5);
    assert_eq!(line(&check("{\n\"cycles\": x").unwrap_err()), 2);
    assert!(check(&text.replace("\"cycles\"", "\"circles\"")).is_err());
    assert!(check(&text.replace("0.5,0.5", "0.5,null")).is_err());
}

/// A certificate for intervals of parameters, but none where the number of cycles is open.
#[test]
fn intervals_of_parameters_are_certified_and_what_is_open_is_not() {
    let mut wide = ParameterBox::from(&Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 });
    wide.r = Interval::new(0.099_99, 0.100_01);
    let text = file(&certificate(&prove(&wide, &[])).unwrap()).unwrap();
    assert_eq!(check(&text).unwrap().parameters[3], [0.099_99, 0.100_01]);
    wide.d = Interval::new(-0.18, -0.17);
    assert!(certificate(&prove(&wide, &[])).is_err());
}

/// Pi, bounded by neighbouring doubles.
const PI: Interval = Interval::new(std::f64::consts::PI, 3.141_592_653_589_793_6);

/// The half swing of a linear spiral in closed form, computed in intervals: end, time, and integral of the damping.
#[test]
fn swings_hold_their_closed_form() {
    for d in [-0.6, -0.2, 0.0, 0.1, 0.5] {
        let [damping, zero, one] = [d, 0.0, 1.0].map(Interval::point);
        let time = PI / ((one + damping) * (one - damping)).sqrt();
        let lost = damping.twice() * time;
        for z in [1e-3, 0.7, 31.0] {
            let found =
                FencedField::new([damping.twice(), zero, zero], 0.0).swing(Interval::point(z), 0.0);
            let end = (-lost / 2.0).exp() * z;
            for (what, found, exact) in [
                ("end", found.end, end),
                ("time", found.time, time),
                ("damping", found.damping, lost),
            ] {
                assert!(exact.intersection(found).is_some(), "{d} {z} {what}: {found} {exact}");
                assert!(found.width() < 1e-12 * z.max(1.0), "{d} {z} {what}: {found}");
            }
        }
    }
}

/// A swing from an interval contains that of every start in it, also where motions separate.
#[test]
fn a_swing_from_an_interval_holds_all_of_them() {
    for coefficients in [[-0.8, 0.3, 0.2], [0.3, -0.5, 0.4], [-0.5, -0.3, 0.3], [0.2, 0.6, -0.1]] {
        let field = FencedField::new(coefficients.map(Interval::point), 0.0);
        let all = field.swing(Interval::new(0.99, 1.01), 0.0);
        assert!(all.end.is_finite() && all.end.width() < 0.2, "{coefficients:?}: {}", all.end);
        for start in [0.99, 0.994, 1.0, 1.004, 1.01] {
            let one = field.swing(Interval::point(start), 0.0);
            let pairs = [(one.end, all.end), (one.time, all.time), (one.damping, all.damping)];
            assert!(pairs.iter().all(|(one, all)| one.is_within(*all)), "{coefficients:?} {start}");
        }
    }
}

/// Steps are refused where their statements are slightly wrong: bounds of a clearance that miss it, a cycle
/// step so wide that the map no longer contracts, a theorem next to its condition.
#[test]
fn what_is_nearly_true_is_refused() {
    let whole = check(&written(-0.2, 0.2, 0.5, 0.1)).unwrap();
    let at = whole.steps.iter().position(|step| step.kind == StepKind::Stable).unwrap();
    let [low, high] = whole.steps[at].clearance.unwrap();
    let refused = |change: &dyn Fn(&mut Certificate)| {
        let mut changed = whole.clone();
        change(&mut changed);
        check(&file(&changed).unwrap()).unwrap_err()
    };
    let off = 1e-11;
    for (wrong, words) in [([low + off, high + off], "below"), ([low - off, high - off], "above")] {
        let why = refused(&|it| it.steps[at].clearance = Some(wrong));
        assert!(why.contains(words), "{why}");
    }
    // From inside the unstable cycle on there are two cycles.
    let first = whole.steps.iter().position(|step| step.kind == StepKind::Unstable).unwrap();
    let why = refused(&|it| {
        it.steps.drain(first..at);
        it.steps[first].from = it.steps[first - 1].to.unwrap();
    });
    assert!(why.contains("contract") || why.contains("certain"), "{why}");
    // Decided by 32 |D|^3 < 27 r^2 D3.
    let steps = vec![CertificateStep {
        kind: StepKind::OneWay,
        from: 0.0,
        to: None,
        clearance: None,
        fences: None,
    }];
    let limit = cbrt(27.0 * 0.01 * 0.5 / 32.0);
    for (d, holds) in [(-limit * (1.0 - 1e-9), true), (-limit * (1.0 + 1e-9), false)] {
        let parameters = [[d; 2], [0.2; 2], [0.5; 2], [0.1; 2]];
        let text = file(&Certificate { parameters, cycles: 0, steps: steps.clone() }).unwrap();
        assert_eq!(check(&text).is_ok(), holds, "{d}");
    }
}

/// A fence is valid where the damping is steep enough, and its piece contains every motion that falls through it.
#[test]
fn fences_hold_the_motions_that_pass_them() {
    let coefficients = [-0.5, 12.0, 0.5].map(Interval::point);
    let (plain, fenced) =
        (FencedField::new(coefficients, 0.0), FencedField::new(coefficients, 0.4));
    let greatest = fenced.greatest();
    assert!(greatest.upper() < f64::INFINITY && plain.greatest() == Interval::ALL);
    for z in [3.0, 6.0, 10.0] {
        let (one, other) =
            (plain.swing(Interval::point(z), 0.0), fenced.swing(Interval::point(z), 0.0));
        assert!(
            one.end.is_finite() && one.end.intersection(other.end).is_some(),
            "{z}: {} {}",
            one.end,
            other.end
        );
        assert!(
            other.damping.lower() <= one.damping.upper() && one.end.lower() <= greatest.upper()
        );
    }
    // Where `4 (a - 3 c v^2) <= f'^3` fails there is no fence: at a slope of 1.9 for a = 1.9.
    let flat = |e: f64| FencedField::new([1.9, 1.0, 0.0].map(Interval::point), e).greatest();
    assert!(flat(1e-3) == Interval::ALL && flat(0.5).is_finite());
}

/// From far out all motions fall onto one curve: the end of all starts equals that of one of them, and motions
/// converge.
#[test]
fn swings_from_far_out_end_together() {
    let field = FencedField::new([0.2, 25.0, 0.03].map(Interval::point), 0.16);
    let all = field.swing(Interval::new(2e6, 2.1e6), 0.0);
    let one = field.swing(Interval::point(2.05e6), 0.0);
    assert!(
        all.end.is_finite() && all.end.intersection(one.end).is_some(),
        "{} {}",
        all.end,
        one.end
    );
    assert!(all.end.width() < 1e-10 && all.damping.lower() > 1e6, "{} {}", all.end, all.damping);
}
